//! `engines`: computes the stored values again with the engines.

use std::io::ErrorKind;
use std::process::Command;

use crate::run::root;
use crate::skip::skip;

/// What evaluates the engines and compares: Pinocchio and `MuJoCo`; Basilisk.
const SCRIPTS: [&str; 2] = ["tests/engines/store.py", "tests/engines/wheels.py"];

/// Exit status of the script where a Python package is missing.
const MISSING: i32 = 77;

/// Each script with `--check`, or a line that says why not.
pub(crate) fn engines() -> Result<(), String> {
    SCRIPTS.iter().try_for_each(|script| check(script))
}

fn check(script: &str) -> Result<(), String> {
    let line = format!("python3 {script} --check");
    eprintln!("$ {line}");
    // No bytecode: a check leaves no files.
    let status =
        Command::new("python3").args(["-B", script, "--check"]).current_dir(root()).status();
    match status {
        Ok(status) if status.success() => Ok(()),
        Ok(status) if status.code() == Some(MISSING) => skipped(script),
        Ok(status) => Err(format!("`{line}` failed ({status})")),
        Err(error) if error.kind() == ErrorKind::NotFound => skipped(script),
        Err(error) => Err(format!("`{line}` did not start: {error}")),
    }
}

fn skipped(script: &str) -> Result<(), String> {
    let what = format!("the engines of {script}");
    skip(&what, "pip install -r tests/engines/requirements.txt")
}
