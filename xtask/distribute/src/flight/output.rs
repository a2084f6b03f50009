//! What programs print: taken within a time limit, checked to be whole, compared line by line.

use std::io::Read;
use std::process::{Command, Stdio};
use std::thread::{sleep, spawn};
use std::time::{Duration, Instant};

/// What ends a program that hangs. The slowest board needs a minute and a half, several times that on a busy machine.
const LIMIT: Duration = Duration::from_secs(1800);

/// The lines that a program prints, to either stream; a semihosting console writes to the second.
pub(super) fn lines(command: &mut Command) -> Result<Vec<String>, String> {
    let program = command.get_program().to_string_lossy().into_owned();
    let failed = |error: std::io::Error| format!("{program}: {error}");
    command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().map_err(failed)?;
    let streams = [
        child.stdout.take().map(|stream| Box::new(stream) as Box<dyn Read + Send>),
        child.stderr.take().map(|stream| Box::new(stream) as Box<dyn Read + Send>),
    ];
    // Each is read while the program runs: a full pipe would stop it.
    let readers = streams.into_iter().flatten().map(|mut stream| {
        spawn(move || {
            let mut bytes = Vec::new();
            stream.read_to_end(&mut bytes).map(|_| bytes)
        })
    });
    let readers: Vec<_> = readers.collect();
    let start = Instant::now();
    let status = loop {
        if let Some(status) = child.try_wait().map_err(failed)? {
            break status;
        }
        if start.elapsed() > LIMIT {
            // It may just have ended; then it ends by itself.
            let _ = child.kill();
            let _ = child.wait();
            return Err(format!("{program}: no end within {} s", LIMIT.as_secs()));
        }
        sleep(Duration::from_millis(20));
    };
    let mut text = String::new();
    for reader in readers {
        let bytes = reader.join().map_err(|_| format!("{program}: its output was not read"))?;
        text.push_str(&String::from_utf8_lossy(&bytes.map_err(failed)?));
    }
    let lines: Vec<String> = text.lines().map(|line| line.trim_end().to_owned()).collect();
    if status.success() {
        return Ok(lines);
    }
    Err(format!("{program} ended with {status}; its last line: {}", last(&lines)))
}

/// The lines before the last, which has to say how many there are.
pub(super) fn whole(mut lines: Vec<String>) -> Result<Vec<String>, String> {
    let end = lines.pop().unwrap_or_default();
    let expected = format!("end: {} lines", lines.len());
    if lines.is_empty() || end != expected {
        return Err(format!("the output is not whole: `{end}` instead of `{expected}`"));
    }
    Ok(lines)
}

/// Whether a board prints what this machine prints.
pub(super) fn same(here: &[String], there: &[String]) -> Result<(), String> {
    if here.len() != there.len() {
        return Err(format!("{} lines, {} on this machine", there.len(), here.len()));
    }
    match here.iter().zip(there).find(|(here, there)| here != there) {
        Some((here, there)) => Err(format!("other bits:\n  here  {here}\n  there {there}")),
        None => Ok(()),
    }
}

fn last(lines: &[String]) -> &str {
    lines.last().map_or("none", String::as_str)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines_of(lines: &[&str]) -> Vec<String> {
        lines.iter().map(|&line| line.to_owned()).collect()
    }

    #[test]
    fn output_that_is_empty_or_short_is_rejected() {
        for lines in [&[][..], &["end: 0 lines"], &["a: 1"], &["a: 1", "end: 2 lines"]] {
            assert!(whole(lines_of(lines)).is_err(), "{lines:?}");
        }
        assert_eq!(whole(lines_of(&["a: 1", "end: 1 lines"])), Ok(lines_of(&["a: 1"])));
    }

    #[test]
    fn one_digit_or_one_line_more_is_a_difference() {
        let here = lines_of(&["a: 1f", "b: 2e"]);
        assert_eq!(same(&here, &here), Ok(()));
        assert!(same(&here, &lines_of(&["a: 1f", "b: 2f"])).is_err());
        assert!(same(&here, &lines_of(&["a: 1f"])).is_err());
    }

    #[test]
    fn a_program_that_fails_is_rejected_whatever_it_printed() {
        let printed = lines(Command::new("sh").args(["-c", "echo end: 0 lines; exit 1"]));
        assert!(printed.unwrap_err().contains("end: 0 lines"));
    }
}
