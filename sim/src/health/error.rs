//! [`HealthError`]: why a case of the benchmark has no record or no score.

use std::fmt;

use crate::file::Diagnostics;
use crate::record::RunError;
use crate::telemetry::LayoutError;
use crate::units::Plain;
use crate::watch::WatchError;

/// Why a case has no record or no score.
#[derive(Debug)]
pub enum HealthError {
    /// A scenario of the benchmark that is not read: an override that a program passes.
    Scenario(Diagnostics),
    /// A run that does not start.
    Run(RunError),
    /// A run that ended before its time, s.
    Ended {
        /// Of which case.
        case: String,
        /// When.
        time: f64,
        /// Why.
        reason: String,
    },
    /// A scenario without the sensors.
    Layout(LayoutError),
    /// A record that is not watched.
    Watch(WatchError),
    /// A table of others, by its line.
    Table {
        /// From 1.
        line: usize,
        /// What is wrong, with the remedy.
        reason: String,
    },
}

impl fmt::Display for HealthError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Scenario(errors) => errors.fmt(f),
            Self::Run(error) => error.fmt(f),
            Self::Ended { case, time, reason } => {
                write!(f, "the run of {case} ended at {} s: {reason}", Plain(*time))
            }
            Self::Layout(error) => error.fmt(f),
            Self::Watch(error) => error.fmt(f),
            Self::Table { line, reason } => write!(f, "line {line}: {reason}"),
        }
    }
}

impl std::error::Error for HealthError {}

impl From<Diagnostics> for HealthError {
    fn from(errors: Diagnostics) -> Self {
        Self::Scenario(errors)
    }
}

impl From<RunError> for HealthError {
    fn from(error: RunError) -> Self {
        Self::Run(error)
    }
}

impl From<LayoutError> for HealthError {
    fn from(error: LayoutError) -> Self {
        Self::Layout(error)
    }
}

impl From<WatchError> for HealthError {
    fn from(error: WatchError) -> Self {
        Self::Watch(error)
    }
}
