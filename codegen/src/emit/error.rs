//! [`EmitError`]: why a file could not be laid out.

use std::fmt;

use super::text::LINE;

/// Why a file could not be laid out: a fault of the generator, not of its input.
#[derive(Debug)]
pub enum EmitError {
    /// A template failed.
    Template(tera::Error),
    /// The result is not Rust.
    Syntax(String, syn::Error),
    /// A name stands for two values of parameters.
    Ambiguous(&'static str, String),
    /// A line is too wide.
    Width(String, String),
    /// A statement that C has not.
    NoC {
        /// The function that it is in.
        function: String,
        /// As Rust.
        statement: String,
    },
}

impl fmt::Display for EmitError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Template(error) => write!(f, "template: {error}"),
            Self::Syntax(path, error) => write!(f, "{path} would not parse: {error}"),
            Self::Ambiguous(kind, name) => {
                write!(f, "kind `{kind}`: `{name}` would stand for two values; rename a link")
            }
            Self::Width(path, line) => {
                write!(f, "{path}: `{line}` would be wider than {LINE} columns; shorten its name")
            }
            Self::NoC { function, statement } => {
                write!(f, "{function}: `{statement}` cannot be written as C")
            }
        }
    }
}

impl std::error::Error for EmitError {}

impl From<tera::Error> for EmitError {
    fn from(error: tera::Error) -> Self {
        Self::Template(error)
    }
}
