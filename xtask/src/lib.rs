//! What the programs of the workbench share: how cargo and others are run, what is skipped, how files are compared
//! and written, and the library for flight software.

pub mod capi;
pub mod files;
pub mod run;
pub mod skip;

use std::process::ExitCode;

/// How a command ends: what went wrong is said on the error output.
#[must_use]
pub fn ended(done: Result<(), String>) -> ExitCode {
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::FAILURE
        }
    }
}
