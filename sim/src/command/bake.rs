//! `bake`: the kernels of the scenario's spacecraft, as Rust or C.
//!
//! This tool derives nothing: it writes what the spacecraft is, as plain numbers, and hands that to
//! `precess-bake`, which derives, proves and writes.

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use precess_dynamics::HubMode;

use super::error::CommandError;
use super::exit::Exit;
use super::generator::Generator;
use super::options::Set;
use super::outputs::Outputs;
use super::terminal::{note, print};
use crate::file::from_file;
use crate::scenario::Scenario;

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
    /// Write kernels for batches of states, too: CUDA, and C99.
    #[arg(long, requires = "general")]
    batch: bool,
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
        let mut generator = Generator::new().arguments([Path::new("--out"), out]);
        if let Some(language) = self.language {
            generator = generator
                .arguments(["--language", if language == Language::C { "c" } else { "rust" }]);
        }
        for (given, flag) in [
            (self.constants, "--constants"),
            (self.general, "--general"),
            (self.batch, "--batch"),
            (self.force, "--force"),
        ] {
            if given {
                generator = generator.arguments([flag]);
            }
        }
        Ok(if generator.derive(description)? { Exit::Success } else { Exit::Error })
    }
}
