//! Programs run on one core, which print JSON: once, or a line for each turn.

use std::io::{BufRead as _, BufReader, Write as _};
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::time::Instant;

use serde::Deserialize;
use serde::de::DeserializeOwned;

/// A program with its first arguments.
#[derive(Clone, Debug)]
pub(crate) struct Program(Vec<String>);

impl Program {
    /// A program on a core.
    pub(crate) fn new(path: &Path, pinned: &[String]) -> Self {
        Self::with_arguments(&[path.display().to_string()], pinned)
    }

    /// A program with arguments on a core.
    pub(crate) fn with_arguments(command: &[String], pinned: &[String]) -> Self {
        Self([pinned, command].concat())
    }

    /// What it prints, in one line of JSON.
    pub(crate) fn query<T: DeserializeOwned>(&self, arguments: &[String]) -> Result<T, String> {
        let (line, mut command) = self.command(arguments)?;
        let output = command.stdin(Stdio::null()).output();
        let output = output.map_err(|error| format!("`{line}` did not start: {error}"))?;
        if !output.status.success() {
            let errors = String::from_utf8_lossy(&output.stderr);
            return Err(format!("`{line}` failed ({}): {errors}", output.status));
        }
        // An engine may print something before its result.
        let text = String::from_utf8_lossy(&output.stdout);
        let answer = text.lines().next_back().unwrap_or_default();
        serde_json::from_str(answer)
            .map_err(|error| format!("`{line}` printed `{answer}`: {error}"))
    }

    /// Starts it and waits until it is ready for turns.
    pub(crate) fn start(&self, arguments: &[String]) -> Result<Turns, String> {
        let (line, mut command) = self.command(arguments)?;
        let child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn();
        let mut child = child.map_err(|error| format!("`{line}` did not start: {error}"))?;
        let (Some(input), Some(output)) = (child.stdin.take(), child.stdout.take()) else {
            return Err(format!("`{line}` has no input and output"));
        };
        let output = BufReader::new(output);
        let mut turns = Turns { line, child, input: Some(input), output };
        while !matches!(turns.read()?, Said { ready: Some(true), .. }) {}
        Ok(turns)
    }

    fn command(&self, arguments: &[String]) -> Result<(String, Command), String> {
        let (first, rest) = self.0.split_first().ok_or("no program")?;
        let mut command = Command::new(first);
        command.args(rest).args(arguments);
        Ok((format!("{} {}", self.0.join(" "), arguments.join(" ")), command))
    }
}

/// A program that waits for its turns.
pub(crate) struct Turns {
    line: String,
    child: Child,
    input: Option<ChildStdin>,
    output: BufReader<ChildStdout>,
}

/// A line of a program that takes turns.
#[derive(Deserialize)]
struct Said {
    ready: Option<bool>,
    ns: Option<f64>,
}

/// What a turn gave.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Turn {
    /// Nanoseconds per evaluation or step.
    pub(crate) ns: f64,
    /// The part of the turn in which no thread of the program ran; none where the system does not say.
    pub(crate) waited: Option<f64>,
}

impl Turns {
    /// One turn.
    pub(crate) fn next(&mut self) -> Result<Turn, String> {
        let (before, start) = (self.ran(), Instant::now());
        let input = self.input.as_mut().ok_or("the program has ended")?;
        let sent = input.write_all(b"\n").and_then(|()| input.flush());
        sent.map_err(|error| format!("`{}` takes no turn: {error}", self.line))?;
        let ns = self.read()?.ns.filter(|ns| ns.is_finite() && *ns > 0.0);
        let ns = ns.ok_or_else(|| format!("`{}` printed no time", self.line))?;
        let took = start.elapsed().as_secs_f64();
        let ran = self.ran().zip(before).map(|(after, before)| (after - before) / took);
        let waited = ran.map(|ran| (1.0 - ran).max(0.0));
        Ok(Turn { ns, waited })
    }

    /// Seconds of the processor in all its threads since the program began.
    fn ran(&self) -> Option<f64> {
        let tasks = std::fs::read_dir(format!("/proc/{}/task", self.child.id())).ok()?;
        let ran = |task: std::fs::DirEntry| {
            let text = std::fs::read_to_string(task.path().join("schedstat")).ok()?;
            text.split_whitespace().next()?.parse::<f64>().ok()
        };
        Some(1e-9 * tasks.filter_map(|task| ran(task.ok()?)).sum::<f64>())
    }

    /// The next line of JSON; an engine may print something else between.
    fn read(&mut self) -> Result<Said, String> {
        let mut text = String::new();
        loop {
            text.clear();
            let read = self.output.read_line(&mut text);
            match read.map_err(|error| format!("`{}`: {error}", self.line))? {
                0 => return Err(format!("`{}` ended before its turn", self.line)),
                _ => match serde_json::from_str(&text) {
                    Ok(said) => return Ok(said),
                    Err(_) => eprint!("{text}"),
                },
            }
        }
    }
}

impl Drop for Turns {
    /// It ends with its input.
    fn drop(&mut self) {
        drop(self.input.take());
        // Nothing is left to be done with a program that cannot be waited for.
        let _ = self.child.wait();
    }
}

/// What a command is led by so that it stays on one core, the last that this process may use;
/// nothing where there is no `taskset`.
pub(crate) fn pinned() -> Vec<String> {
    let words = ["taskset", "--cpu-list", &last_core()].map(str::to_owned);
    let [taskset, option, core] = &words;
    let works = Command::new(taskset).args([option, core, "true"]).status();
    if works.is_ok_and(|status| status.success()) { words.to_vec() } else { Vec::new() }
}

/// The number of the last core that this process may use.
fn last_core() -> String {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let allowed = status.lines().find_map(|line| line.strip_prefix("Cpus_allowed_list:"));
    let last = allowed.and_then(|list| list.trim().rsplit([',', '-']).next());
    last.map_or_else(
        || {
            let cores = std::thread::available_parallelism().map_or(1, usize::from);
            (cores - 1).to_string()
        },
        str::to_owned,
    )
}
