//! [`RecordError`]: what cannot be recorded, or could not be written.

use std::fmt;
use std::io;
use std::path::PathBuf;

use crate::pointing::PointingError;
use crate::units::Plain;

/// Samples that cannot be recorded.
#[derive(Debug)]
pub enum RecordError {
    /// A name is that of no column and of no group of columns.
    UnknownColumn {
        /// The name.
        name: String,
        /// The nearest names there are.
        nearest: Vec<String>,
    },
    /// A requirement is of a group that is neither one column nor a vector.
    NoQuantity {
        /// The name.
        name: String,
    },
    /// A band of frequencies is not below half the sampling rate.
    Band {
        /// The requirement.
        requirement: String,
        /// The band, Hz.
        band: [f64; 2],
        /// Half the sampling rate, Hz.
        highest: f64,
    },
    /// A requirement's exposure, window or level has no value at the sampling rate.
    Metric {
        /// The requirement.
        requirement: String,
        /// Why.
        source: PointingError,
    },
    /// A sample has another number of columns than the header.
    Row {
        /// Columns of the header.
        expected: usize,
        /// Numbers of the sample.
        found: usize,
    },
    /// The operating system returned an error.
    Io {
        /// The file.
        path: PathBuf,
        /// Its reason.
        source: io::Error,
    },
    /// A library of a file format returned an error.
    Format {
        /// The file.
        path: PathBuf,
        /// Its reason, in its own words.
        reason: String,
    },
}

impl RecordError {
    /// An error of the operating system at a file.
    pub(crate) fn io(path: &std::path::Path) -> impl FnOnce(io::Error) -> Self + use<> {
        let path = path.to_owned();
        |source| Self::Io { path, source }
    }
}

impl fmt::Display for RecordError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UnknownColumn { name, nearest } => {
                write!(f, "`{name}` is no column and no group of columns")?;
                nearest.iter().enumerate().try_for_each(|(index, near)| {
                    let lead = if index == 0 { "; nearest: " } else { ", " };
                    write!(f, "{lead}`{near}`")
                })
            }
            Self::NoQuantity { name } => write!(
                f,
                "`{name}` is neither one column nor a vector of three; name a column or a vector \
                 such as `omega`"
            ),
            Self::Band { requirement, band: [from, to], highest } => write!(
                f,
                "requirement `{requirement}`: the band {from} Hz to {to} Hz is not within 0 Hz to \
                 {highest} Hz, half the sampling rate; raise output.rate",
                from = Plain(*from),
                to = Plain(*to),
                highest = Plain(*highest)
            ),
            Self::Metric { requirement, source } => {
                write!(f, "requirement `{requirement}`: {source}")
            }
            Self::Row { expected, found } => write!(
                f,
                "a sample has {found} numbers for {expected} columns; this is a fault of the \
                 program"
            ),
            Self::Io { path, source } => write!(
                f,
                "cannot write {}: {source}; choose a folder you may write to, with room for the \
                 file",
                path.display()
            ),
            Self::Format { path, reason } => write!(f, "cannot write {}: {reason}", path.display()),
        }
    }
}

impl std::error::Error for RecordError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Io { source, .. } => Some(source),
            Self::Metric { source, .. } => Some(source),
            _ => None,
        }
    }
}
