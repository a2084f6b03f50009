//! `engines`: computes the stored values again with the engines.

use std::io::ErrorKind;
use std::process::Command;

use crate::run::root;
use crate::skip::skip;

/// What evaluates the engines and compares.
const SCRIPT: &str = "tests/engines/store.py";

/// Exit status of the script where a Python package is missing.
const MISSING: i32 = 77;

/// `store.py --check`, or a line that says why not.
pub(crate) fn engines() -> Result<(), String> {
    let line = format!("python3 {SCRIPT} --check");
    eprintln!("$ {line}");
    // No bytecode: a check leaves no files.
    let status =
        Command::new("python3").args(["-B", SCRIPT, "--check"]).current_dir(root()).status();
    match status {
        Ok(status) if status.success() => Ok(()),
        Ok(status) if status.code() == Some(MISSING) => skipped(),
        Ok(status) => Err(format!("`{line}` failed ({status})")),
        Err(error) if error.kind() == ErrorKind::NotFound => skipped(),
        Err(error) => Err(format!("`{line}` did not start: {error}")),
    }
}

fn skipped() -> Result<(), String> {
    skip("the engines of the stored values", "pip install -r tests/engines/requirements.txt")
}
