//! What can go wrong, with where, what, the bound and the remedy.

use std::fmt;
use std::io;
use std::path::PathBuf;

use precess_dynamics::{ParameterError, SolveError};

/// A run that could not be started or finished.
#[derive(Debug)]
pub enum RunError {
    /// The length of the run, s.
    Duration {
        /// What was asked for.
        value: f64,
        /// Shortest.
        lowest: f64,
        /// Longest.
        highest: f64,
    },
    /// The relative tolerance of a step.
    Tolerance {
        /// What was asked for.
        value: f64,
        /// Smallest that can be met.
        lowest: f64,
        /// Largest that still resolves a turn of the wheel.
        highest: f64,
    },
    /// The sampling rate, 1/s.
    Rate {
        /// What was asked for.
        value: f64,
        /// Two samples in the run.
        lowest: f64,
        /// As many samples as are kept.
        highest: f64,
    },
    /// The solver does not accept the spacecraft.
    Parameters(ParameterError),
    /// The solver cannot solve a state of the run.
    Solve {
        /// Simulated time, s.
        time: f64,
        /// What the solver says.
        source: SolveError,
    },
    /// More steps than a run of this length should need.
    TooManySteps {
        /// Simulated time reached, s.
        time: f64,
    },
    /// The step fell below what the clock resolves.
    StepTooSmall {
        /// Simulated time reached, s.
        time: f64,
    },
    /// The motion is too stiff for an explicit method.
    Stiff {
        /// Simulated time reached, s.
        time: f64,
    },
    /// Anything else the integrator reports.
    Integrator {
        /// Its own words.
        message: String,
    },
}

impl fmt::Display for RunError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Duration { value, lowest, highest } => write!(
                f,
                "duration {value} s is outside {lowest} s to {highest} s; the default is 10"
            ),
            Self::Tolerance { value, lowest, highest } => write!(
                f,
                "tolerance {value:e} is outside {lowest:e} to {highest:e}; the default is 1e-13"
            ),
            Self::Rate { value, lowest, highest } => write!(
                f,
                "rate {value} samples/s is outside {lowest} to {highest} for this duration; give \
                 one in between"
            ),
            Self::Parameters(error) => write!(f, "spacecraft refused: {error}"),
            Self::Solve { time, source } => write!(f, "at t = {time} s: {source}"),
            Self::TooManySteps { time } => write!(
                f,
                "the integrator used up its steps at t = {time} s; loosen the tolerance or \
                 shorten the duration"
            ),
            Self::StepTooSmall { time } => write!(
                f,
                "the integrator's step fell below rounding at t = {time} s; loosen the tolerance"
            ),
            Self::Stiff { time } => write!(
                f,
                "the motion turns stiff at t = {time} s, too fast for an explicit method; check \
                 torques and inertias"
            ),
            Self::Integrator { message } => write!(f, "the integrator stopped: {message}"),
        }
    }
}

impl std::error::Error for RunError {}

/// Results that could not be written.
#[derive(Debug)]
pub enum WriteError {
    /// A file of that name is there and no earlier run wrote it.
    Foreign {
        /// The file.
        path: PathBuf,
    },
    /// The operating system refused.
    Io {
        /// The file or folder.
        path: PathBuf,
        /// Its reason.
        source: io::Error,
    },
}

impl fmt::Display for WriteError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Foreign { path } => write!(
                f,
                "{} exists and no earlier run wrote it; move it away or choose another folder \
                 with --out",
                path.display()
            ),
            Self::Io { path, source } => write!(
                f,
                "cannot write {}: {source}; choose a folder you may write to with --out",
                path.display()
            ),
        }
    }
}

impl std::error::Error for WriteError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Foreign { .. } => None,
            Self::Io { source, .. } => Some(source),
        }
    }
}
