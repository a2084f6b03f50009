//! [`ControllerError`]: why a controller has no command.

use std::fmt;

use precess_control::ControlError;
use precess_dynamics::{SolveError, SteeringError};

/// Why a controller has no command at a sample.
#[derive(Clone, Debug, PartialEq)]
pub enum ControllerError {
    /// A number of its law or reference is not in its range.
    Parameter(ControlError),
    /// Its torque cannot be divided among its joints.
    Steering(SteeringError),
    /// The motion of a node of the structure cannot be computed.
    Node(SolveError),
    /// Between two samples of an integrating gyro the hub turns by half a turn or more.
    HalfTurn {
        /// Its angular velocity, rad/s.
        rate: f64,
        /// What it must be below, rad/s.
        largest: f64,
    },
    /// It answers torques of another number of motors than it commands.
    Count {
        /// How many joints it commands.
        expected: usize,
        /// How many torques it answers.
        found: usize,
    },
    /// A number of its answer is infinite or NaN.
    NotFinite {
        /// Its place in the answer.
        index: usize,
        /// Its value.
        value: f64,
    },
    /// A program's controller says why in its own words.
    Program {
        /// Its words.
        reason: String,
    },
}

impl fmt::Display for ControllerError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Parameter(error) => error.fmt(f),
            Self::Steering(error) => error.fmt(f),
            Self::Node(error) => error.fmt(f),
            Self::HalfTurn { rate, largest } => write!(
                f,
                "the hub turns at {rate} rad/s, and an integrating gyro needs less than half a turn between samples, {largest} rad/s; sample faster"
            ),
            Self::Count { expected, found } => {
                write!(f, "{found} torques of motors for {expected} joints; answer one for each")
            }
            Self::NotFinite { index, value } => {
                write!(f, "number {} of its answer is {value}; it must be finite", index + 1)
            }
            Self::Program { reason } => f.write_str(reason),
        }
    }
}

impl std::error::Error for ControllerError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Parameter(source) => Some(source),
            Self::Steering(source) => Some(source),
            Self::Node(source) => Some(source),
            _ => None,
        }
    }
}

impl From<SteeringError> for ControllerError {
    fn from(error: SteeringError) -> Self {
        Self::Steering(error)
    }
}

impl From<SolveError> for ControllerError {
    fn from(error: SolveError) -> Self {
        Self::Node(error)
    }
}

impl From<ControlError> for ControllerError {
    fn from(error: ControlError) -> Self {
        Self::Parameter(error)
    }
}
