//! Programs of the workbench that link much: built when a command of theirs is called for.

use std::path::{Path, PathBuf};
use std::process::Command;

use xtask::run::{built, program, run};

use crate::measured;

/// A package and its one program.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) struct Program {
    pub(crate) package: &'static str,
    name: &'static str,
}

/// `regen`, `bake` and `mutate`: links the generator.
pub(crate) const DERIVE: Program = Program { package: "precess-derive", name: "derive" };
/// `flight`, `dist`, `dependencies` and `python`: reads object files, packs.
pub(crate) const DISTRIBUTE: Program =
    Program { package: "precess-distribute", name: "distribute" };
/// `site`: sets Markdown and formulas.
pub(crate) const SITE: Program = Program { package: "precess-site", name: "site" };

impl Program {
    /// The program with this command.
    pub(crate) fn of_command(command: &str) -> Option<Self> {
        match command {
            "regen" | "bake" | "mutate" => Some(DERIVE),
            "flight" | "dist" | "dependencies" | "python" => Some(DISTRIBUTE),
            "site" => Some(SITE),
            _ => None,
        }
    }

    /// Whether a command is its own, or starts one of its own.
    pub(crate) fn is_needed_by(self, command: &str) -> bool {
        Self::of_command(command) == Some(self) || (self == DERIVE && command == "demo")
    }

    /// Builds it with options of cargo; what rustc takes is noted in a file, if there is one.
    pub(crate) fn build<'a>(
        self,
        options: impl Iterator<Item = &'a str>,
        notes: Option<&Path>,
    ) -> Result<(), String> {
        let mut cargo = Command::new(program());
        if let Some(notes) = notes {
            measured::wrap(&mut cargo, notes);
        }
        run(cargo.args(["build", "--package", self.package]).args(options))
    }

    /// Where it is once it is built: started without cargo, it waits for no other build.
    pub(crate) fn path(self) -> Result<PathBuf, String> {
        built(self.name)
    }

    /// Builds it and runs a command of it.
    pub(crate) fn run(self, arguments: &[&str]) -> Result<(), String> {
        self.build(std::iter::empty(), None)?;
        self.start(arguments)
    }

    /// Runs a command of it, once it is built.
    pub(crate) fn start(self, arguments: &[&str]) -> Result<(), String> {
        run(Command::new(self.path()?).args(arguments))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_demonstration_needs_the_program_that_derives() {
        assert!(DERIVE.is_needed_by("demo") && DERIVE.is_needed_by("regen"));
        assert!(!DERIVE.is_needed_by("flight") && DISTRIBUTE.is_needed_by("flight"));
        assert!(!DISTRIBUTE.is_needed_by("demo"));
    }
}
