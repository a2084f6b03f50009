//! `bake`: the kernels of the scenario's spacecraft, as Rust or C.
//!
//! This tool derives nothing: it writes what the spacecraft is, as plain numbers, and hands that to
//! `precess-bake`, which derives, proves and writes.

use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use clap::{Args, ValueEnum};
use precess_dynamics::HubMode;

use super::error::CommandError;
use super::exit::Exit;
use super::options::Set;
use super::outputs::Outputs;
use super::terminal::{note, print};
use crate::file::from_file;
use crate::scenario::Scenario;

/// The program that derives, beside this one or on the path.
const PROGRAM: &str = "precess-bake";

/// What is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Language {
    /// A crate without dependencies.
    Rust,
    /// C99.
    C,
}

/// The options of `bake`.
#[expect(clippy::struct_excessive_bools, reason = "each is a flag of the command")]
#[derive(Debug, Args)]
pub(super) struct Bake {
    /// The scenario file.
    file: PathBuf,
    #[command(flatten)]
    overrides: Set,
    /// The folder to write; beside the scenario, by its name, without this option.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// What to write; a crate without this option, C with `--general`.
    #[arg(long, value_enum)]
    language: Option<Language>,
    /// Fold the values, too: constants instead of a constructor that takes them.
    #[arg(long)]
    constants: bool,
    /// Assume nothing: the solver of every spacecraft with these kinds of devices, as C99.
    #[arg(long, conflicts_with_all = ["constants", "unlock"])]
    general: bool,
    /// Joints that the scenario locks stay joints.
    #[arg(long)]
    unlock: bool,
    /// Print the description that the kernels are derived from, and write nothing.
    #[arg(long)]
    description: bool,
    /// Replace a folder that is there.
    #[arg(long)]
    force: bool,
}

impl Bake {
    pub(super) fn execute(&self) -> Result<Exit, CommandError> {
        let (scenario, _) =
            from_file(&self.file, &self.overrides.overrides()).map_err(CommandError::Scenario)?;
        let other = |error: &dyn std::fmt::Display| CommandError::Other(error.to_string());
        let description = if self.general {
            // What holds a hub or a joint is an input.
            Scenario { hub_mode: HubMode::Free, ..scenario.clone() }.description(true)
        } else {
            scenario.description(self.unlock)
        };
        let description = description.map_err(|error| other(&error))?;
        let text = description.write().map_err(|error| other(&error))?;
        if self.description {
            print(&text)?;
            return Ok(Exit::Success);
        }
        let left = if self.general { scenario.not_in_c_solver() } else { scenario.not_described() };
        for left in left {
            note(&format!("note: {left} is not part of the kernels; add it to torques and forces"));
        }
        let out = self.out.clone().unwrap_or_else(|| self.file.with_file_name(&description.name));
        let _reserved = Outputs::of_folder(&out)?;
        self.derive(&text, &out)
    }

    /// Hands a description to the program, whose output is this command's.
    fn derive(&self, description: &str, out: &Path) -> Result<Exit, CommandError> {
        let mut command = Command::new(program());
        command.arg("--out").arg(out);
        if let Some(language) = self.language {
            command.args(["--language", if language == Language::C { "c" } else { "rust" }]);
        }
        for (given, flag) in
            [(self.constants, "--constants"), (self.general, "--general"), (self.force, "--force")]
        {
            if given {
                command.arg(flag);
            }
        }
        let mut child = command.stdin(Stdio::piped()).spawn().map_err(|error| {
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
        let status = child.wait().map_err(io)?;
        Ok(if status.success() { Exit::Success } else { Exit::Error })
    }
}

/// Beside this program, as `cargo install` and `cargo build` put both; else by the path.
fn program() -> PathBuf {
    let name = format!("{PROGRAM}{}", std::env::consts::EXE_SUFFIX);
    let beside = std::env::current_exe().ok().map(|own| own.with_file_name(&name));
    beside.filter(|path| path.is_file()).unwrap_or_else(|| PathBuf::from(PROGRAM))
}
