//! [`Options`]: in which language kernels are emitted, and with which constants.

use clap::ValueEnum;

/// What is written of a spacecraft.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// In which language.
    pub language: Language,
    /// Whether the values are folded, too: constants instead of a constructor.
    pub constants: bool,
}

/// The language of the emitted files, also as an option of a command.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Language {
    /// A crate without dependencies
    Rust,
    /// C99
    C,
}
