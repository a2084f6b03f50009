//! What ends a command early.

use std::fmt;
use std::path::PathBuf;

use crate::file::Diagnostics;
use crate::record::{RecordError, RunError};

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
    /// A file that the command reads and would replace.
    Input(PathBuf),
    /// An error after which files are left.
    Leaving {
        /// What ended the command.
        error: Box<CommandError>,
        /// What it has written until then.
        files: Vec<PathBuf>,
    },
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
            Self::Input(path) => write!(
                f,
                "error: {} is read by this command, which would replace it; write to another name",
                path.display()
            ),
            Self::Leaving { error, files } => {
                write!(f, "{error}\nleft in place:")?;
                let mut names = files.iter().map(|path| path.display());
                names.try_for_each(|name| write!(f, " {name}"))?;
                f.write_str("; remove what you do not need")
            }
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
            Self::Leaving { error, .. } => Some(error),
            Self::Exists(_) | Self::Input(_) | Self::Other(_) => None,
        }
    }
}

impl CommandError {
    /// The error of a command that leaves files; itself where it leaves none.
    pub(super) fn leaving(self, files: Vec<PathBuf>) -> Self {
        if files.is_empty() { self } else { Self::Leaving { error: Box::new(self), files } }
    }
}

impl From<RecordError> for CommandError {
    fn from(error: RecordError) -> Self {
        Self::Record(error)
    }
}
