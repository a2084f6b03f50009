//! What ends a command early.

use std::fmt;
use std::path::PathBuf;

use crate::engine::RunError;
use crate::file::Diagnostics;
use crate::record::RecordError;

/// What ends a command early.
#[derive(Debug)]
pub enum CommandError {
    /// Scenario files that cannot be read.
    Scenario(Diagnostics),
    /// The same for programs.
    ScenarioJson(Diagnostics),
    /// A run that could not be started, or whose results could not be written.
    Run {
        /// The scenario's name.
        name: String,
        /// Why.
        source: RunError,
    },
    /// Columns that are not there, or files that cannot be written.
    Record(RecordError),
    /// A file that is there and that may not be replaced.
    Exists(PathBuf),
    /// A file that cannot be read or written.
    Io {
        /// The file or folder.
        path: PathBuf,
        /// The operating system's reason.
        source: std::io::Error,
    },
    /// Standard output that cannot be written.
    Output(std::io::Error),
    /// Anything else, in a sentence with its remedy.
    Other(String),
}

impl fmt::Display for CommandError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Scenario(errors) => errors.fmt(f),
            Self::ScenarioJson(errors) => f.write_str(&errors.json()),
            Self::Run { name, source } => write!(f, "error: {name}: {source}"),
            Self::Record(error) => write!(f, "error: {error}"),
            Self::Exists(path) => write!(
                f,
                "error: {} exists; choose another place, or replace it with --force",
                path.display()
            ),
            Self::Io { path, source } => write!(f, "error: {}: {source}", path.display()),
            Self::Output(source) => {
                write!(f, "error: standard output: {source}; what was printed is not complete")
            }
            Self::Other(text) => write!(f, "error: {text}"),
        }
    }
}

impl std::error::Error for CommandError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Scenario(source) | Self::ScenarioJson(source) => Some(source),
            Self::Run { source, .. } => Some(source),
            Self::Record(source) => Some(source),
            Self::Io { source, .. } | Self::Output(source) => Some(source),
            Self::Exists(_) | Self::Other(_) => None,
        }
    }
}

impl From<RecordError> for CommandError {
    fn from(error: RecordError) -> Self {
        Self::Record(error)
    }
}
