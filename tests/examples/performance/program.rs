//! Programs run on one core, which print JSON.

use std::path::Path;
use std::process::Command;

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
    pub(crate) fn query<T: DeserializeOwned>(&self, arguments: &[&str]) -> Result<T, String> {
        let line = format!("{} {}", self.0.join(" "), arguments.join(" "));
        let (first, rest) = self.0.split_first().ok_or("no program")?;
        let output = Command::new(first).args(rest).args(arguments).output();
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
}

/// What a command is led by so that it stays on one core, the last that this process may use;
/// nothing where there is no `taskset`.
pub(crate) fn pinned() -> Vec<String> {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let words = ["taskset", "--cpu-list", &(cores - 1).to_string()].map(str::to_owned);
    let [taskset, option, core] = &words;
    let works = Command::new(taskset).args([option, core, "true"]).status();
    if works.is_ok_and(|status| status.success()) { words.to_vec() } else { Vec::new() }
}
