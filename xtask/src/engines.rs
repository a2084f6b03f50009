//! `engines`: the engines behind the stored values, asked again.

use std::io::ErrorKind;
use std::process::Command;

use crate::run::root;

/// What evaluates the engines and compares.
const SCRIPT: &str = "tests/engines/store.py";

/// Exit status of the script where a Python package is missing.
const MISSING: i32 = 77;

/// Set to 1, it makes a skip a failure: for machines on which everything is to be run.
const REQUIRE_ALL: &str = "PRECESS_REQUIRE_ALL";

/// `store.py --check`, or a line that says why not.
pub(crate) fn engines() -> Result<(), String> {
    let line = format!("python3 {SCRIPT} --check");
    eprintln!("$ {line}");
    // No bytecode: a check leaves nothing behind.
    let status =
        Command::new("python3").args(["-B", SCRIPT, "--check"]).current_dir(root()).status();
    match status {
        Ok(status) if status.success() => Ok(()),
        Ok(status) if status.code() == Some(MISSING) => skip(),
        Ok(status) => Err(format!("`{line}` failed ({status})")),
        Err(error) if error.kind() == ErrorKind::NotFound => skip(),
        Err(error) => Err(format!("`{line}` did not start: {error}")),
    }
}

fn skip() -> Result<(), String> {
    let skipped = "skipped: the engines behind the stored values; install with \
                   `pip install -r tests/engines/requirements.txt`";
    if std::env::var_os(REQUIRE_ALL).is_some_and(|value| value == "1") {
        return Err(format!("{skipped}; {REQUIRE_ALL}=1 allows no skip"));
    }
    eprintln!("{skipped}");
    Ok(())
}
