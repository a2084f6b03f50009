//! What programs take: this program is started in place of another, waits for it, and notes its CPU time.
//!
//! Cargo starts it in place of rustc (`RUSTC_WRAPPER`), `cargo xtask test` in place of a test program. Nothing is
//! noted where the operating system keeps no `/proc`.

use std::ffi::OsString;
use std::fs::{self, OpenOptions};
use std::io::Write as _;
use std::path::Path;
use std::process::{Command, ExitCode};

/// The variable by which this program stands for another: the file that it notes the time in.
pub(crate) const VARIABLE: &str = "PRECESS_MEASURED";

/// Ticks of a second in `/proc`, on every Linux.
const TICKS: f64 = 100.0;

/// Runs the program that the arguments name, if this one was started in its place.
pub(crate) fn called() -> Option<ExitCode> {
    let file = std::env::var_os(VARIABLE)?;
    let arguments: Vec<OsString> = std::env::args_os().skip(1).collect();
    let (program, rest) = arguments.split_first()?;
    // What it starts is not measured by itself: its time is in that of the program.
    let status = Command::new(program).args(rest).env_remove(VARIABLE).status();
    if let (Some(name), Some(seconds)) = (name(program, rest), of_children()) {
        let line = format!("{seconds:.2} {name}\n");
        let opened = OpenOptions::new().append(true).create(true).open(file);
        // A time that is not noted is no reason to fail.
        let _ = opened.and_then(|mut file| file.write_all(line.as_bytes()));
    }
    Some(match status {
        Ok(status) => status
            .code()
            .and_then(|code| u8::try_from(code).ok())
            .map_or(ExitCode::FAILURE, ExitCode::from),
        Err(error) => {
            eprintln!("error: {} did not start: {error}", Path::new(program).display());
            ExitCode::FAILURE
        }
    })
}

/// Makes a command of cargo note what rustc takes, unless another program stands for rustc already.
pub(crate) fn wrap(cargo: &mut Command, file: &Path) {
    if let (None, Ok(this)) = (std::env::var_os("RUSTC_WRAPPER"), std::env::current_exe()) {
        cargo.env("RUSTC_WRAPPER", this).env(VARIABLE, file);
    }
}

/// The crate that rustc compiles, or the program; none where rustc only answers a query.
fn name(program: &OsString, arguments: &[OsString]) -> Option<String> {
    let words: Vec<&str> = arguments.iter().filter_map(|word| word.to_str()).collect();
    let program = Path::new(program).file_stem()?.to_str()?.to_owned();
    if program != "rustc" {
        return Some(program);
    }
    let at = words.iter().position(|word| *word == "--crate-name")?;
    let name = words.get(at + 1).filter(|name| **name != "___")?;
    let tests = if words.contains(&"--test") { " (tests)" } else { "" };
    Some(format!("{name}{tests}"))
}

/// CPU time of the programs that this one has waited for, and of theirs, s.
pub(crate) fn of_children() -> Option<f64> {
    let line = fs::read_to_string("/proc/self/stat").ok()?;
    // After the name, which may have spaces, come state, parent and so on; the times of children are the fourteenth.
    let (_, rest) = line.rsplit_once(") ")?;
    let mut times = rest.split(' ').skip(13).map(str::parse::<f64>);
    let (user, system) = (times.next()?.ok()?, times.next()?.ok()?);
    Some((user + system) / TICKS)
}

/// Seconds by name, summed, of a file of notes.
pub(crate) fn read(file: &Path) -> Vec<(String, f64)> {
    let text = fs::read_to_string(file).unwrap_or_default();
    let mut all = std::collections::BTreeMap::new();
    for (seconds, name) in text.lines().filter_map(|line| line.split_once(' ')) {
        *all.entry(name.to_owned()).or_insert(0.0) += seconds.parse::<f64>().unwrap_or(0.0);
    }
    let mut all: Vec<_> = all.into_iter().collect();
    all.sort_by(|a, b| b.1.total_cmp(&a.1).then_with(|| a.0.cmp(&b.0)));
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_crate_is_named_as_cargo_names_it() {
        let words = |text: &str| text.split(' ').map(OsString::from).collect::<Vec<_>>();
        let rustc = OsString::from("/usr/bin/rustc");
        let named = |text| name(&rustc, &words(text));
        assert_eq!(named("--crate-name syn --edition=2021"), Some("syn".to_owned()));
        assert_eq!(named("--crate-name precess --test"), Some("precess (tests)".to_owned()));
        assert_eq!(named("- --crate-name ___ --print=file-names"), None);
        assert_eq!(named("-vV"), None);
        assert_eq!(name(&OsString::from("/t/fit-0a1b"), &[]), Some("fit-0a1b".to_owned()));
    }

    #[test]
    fn seconds_of_a_name_are_summed_and_the_largest_is_first() {
        let file = std::env::temp_dir().join(format!("precess-measured-{}", std::process::id()));
        fs::write(&file, "1.50 a\n2.00 b (tests)\n1.00 a\n").unwrap();
        let found = read(&file);
        fs::remove_file(&file).unwrap();
        assert_eq!(found, [("a".to_owned(), 2.5), ("b (tests)".to_owned(), 2.0)]);
    }
}
