//! Faults that users reported: each input as it was sent in, with the right answer. By subject:

mod extremes;
mod files;
mod fits;
mod frequencies;
mod inputs;
mod layouts;
mod loads;
mod motions;
mod names;
mod orbits;
mod requirements;
mod rotors;
mod tables;
mod units;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// What a command ended with.
struct CommandResult {
    code: Option<i32>,
    out: String,
    error: String,
}

/// The command `precess` with these arguments.
fn precess(arguments: &[&str]) -> CommandResult {
    let mut command = Command::new(env!("CARGO_BIN_EXE_precess"));
    let output = command.args(arguments).output().expect("the command starts");
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("text");
    CommandResult {
        code: output.status.code(),
        out: text(output.stdout),
        error: text(output.stderr),
    }
}

/// An empty folder.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("reported").join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("a folder");
    folder
}

/// A file of the suite, `sim/tests/reported/cases/NAME`.
fn case(name: &str) -> String {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/reported/cases");
    format!("{folder}/{name}")
}
