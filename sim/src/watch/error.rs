//! [`WatchError`]: why telemetry is not watched.

use std::fmt;

use precess_dynamics::SolveError;

use crate::record::RunError;
use crate::telemetry::TelemetryError;
use crate::units::Plain;

/// Why telemetry is not watched.
#[derive(Debug)]
pub enum WatchError {
    /// A scenario that cannot be evaluated.
    Scenario(RunError),
    /// A state that cannot be solved.
    Solve(SolveError),
    /// A probability of a false alarm at each block of each quantity for which there is no bound.
    Rate {
        /// It.
        alpha: f64,
    },
    /// A reference of too few blocks.
    Reference {
        /// How many there are.
        blocks: f64,
        /// How many there must be more than.
        least: f64,
    },
    /// A length of time that is not positive and finite.
    Length {
        /// Which.
        what: &'static str,
        /// It, s.
        value: f64,
    },
    /// No sensor from which something can be watched.
    Nothing,
    /// Telemetry that cannot be read.
    Telemetry(TelemetryError),
    /// It was interrupted.
    Interrupted,
}

impl fmt::Display for WatchError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Scenario(error) => error.fmt(f),
            Self::Solve(error) => write!(f, "the model has no accelerations at what was measured: {error}"),
            Self::Rate { alpha } => write!(
                f,
                "a false alarm has a probability of {} at each block of each quantity, and there is a bound for 1e-30 to 0.1; \
                 choose another rate of false alarms or length of blocks",
                Plain(*alpha)
            ),
            Self::Reference { blocks, least } => write!(
                f,
                "the reference has {} blocks, and must have more than {}; learn for longer, or make blocks shorter",
                Plain(*blocks),
                Plain(*least)
            ),
            Self::Length { what, value } => {
                write!(f, "{what} is {} s; it must be finite and positive", Plain(*value))
            }
            Self::Telemetry(error) => error.fmt(f),
            Self::Interrupted => f.write_str("it was interrupted"),
            Self::Nothing => f.write_str(
                "the telemetry has neither a gyro nor a joint with tachometer and motor: nothing can be watched",
            ),
        }
    }
}

impl std::error::Error for WatchError {}
