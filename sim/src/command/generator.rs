//! [`Generator`]: the program that derives kernels, `precess-bake`. This tool derives nothing: it hands over what the spacecraft
//! is, as plain numbers.

use std::ffi::OsStr;
use std::io::Write as _;
use std::path::PathBuf;
use std::process::{Command, Stdio};

use super::error::CommandError;

/// The program that derives, beside this one or on the path.
const PROGRAM: &str = "precess-bake";

/// The program with its arguments.
pub(super) struct Generator(Command);

impl Generator {
    /// Without arguments.
    pub(super) fn new() -> Self {
        Self(Command::new(program()))
    }

    pub(super) fn arguments<A: AsRef<OsStr>>(
        mut self,
        arguments: impl IntoIterator<Item = A>,
    ) -> Self {
        self.0.args(arguments);
        self
    }

    /// What it prints to standard output goes nowhere.
    pub(super) fn silent(mut self) -> Self {
        self.0.stdout(Stdio::null());
        self
    }

    /// Hands a description to the program, whose output is otherwise this command's. Returns whether it succeeded; if it did not,
    /// it has said why.
    ///
    /// # Errors
    /// It cannot be started, or does not read.
    pub(super) fn derive(mut self, description: &str) -> Result<bool, CommandError> {
        let mut child = self.0.stdin(Stdio::piped()).spawn().map_err(|error| {
            CommandError::Other(format!(
                "`{PROGRAM}` cannot be started: {error}; install it with `cargo install --path \
                 codegen/bake`"
            ))
        })?;
        let io = |source| CommandError::Io { path: PROGRAM.into(), source };
        if let Some(mut input) = child.stdin.take() {
            // A program that ends before it has read all says why itself.
            match input.write_all(description.as_bytes()) {
                Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => {
                    return Err(io(error));
                }
                _ => {}
            }
        }
        Ok(child.wait().map_err(io)?.success())
    }
}

/// Beside this program, as `cargo install` and `cargo build` put both; else by the path.
fn program() -> PathBuf {
    let name = format!("{PROGRAM}{}", std::env::consts::EXE_SUFFIX);
    let beside = std::env::current_exe().ok().map(|own| own.with_file_name(&name));
    beside.filter(|path| path.is_file()).unwrap_or_else(|| PathBuf::from(PROGRAM))
}
