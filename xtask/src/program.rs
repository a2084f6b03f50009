//! Programs of the workbench that link much: built when a command of theirs is called for.

use xtask::run::cargo;

/// A package and its one program.
#[derive(Clone, Copy)]
pub(crate) struct Program {
    package: &'static str,
}

/// `regen`, `bake` and `mutate`: links the generator.
pub(crate) const DERIVE: Program = Program { package: "precess-derive" };
/// `flight`, `dist` and `python`: reads object files, packs.
pub(crate) const DISTRIBUTE: Program = Program { package: "precess-distribute" };

impl Program {
    /// Builds it and runs a command of it.
    pub(crate) fn run(self, arguments: &[&str]) -> Result<(), String> {
        cargo(&[&["run", "--package", self.package, "--"], arguments].concat())
    }
}
