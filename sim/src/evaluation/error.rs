//! [`EvaluationError`]: why an evaluation returns nothing.

use std::error::Error;
use std::fmt;

use precess_dynamics::{DerivativeError, ParameterError, SolveError};

/// Why an evaluation returns nothing.
#[derive(Clone, Debug, PartialEq)]
pub enum EvaluationError {
    /// The state and inputs have no accelerations.
    Solve(SolveError),
    /// There is no derivative.
    Derivative(DerivativeError),
    /// Derivatives by parameters of a flexible structure, which the library does not have.
    Flexible,
    /// Whether a joint at rest sticks, which only a run decides.
    Sticks {
        /// Its coordinate.
        joint: String,
    },
    /// Inputs of a joint at the largest rate of its motor or beyond it: only a run decides whether it is held there.
    AtLargestRate {
        /// Its coordinate.
        joint: String,
    },
    /// Derivatives with friction that sticks or quadratic drag.
    Friction {
        /// The coordinate of the first joint with it.
        joint: String,
    },
    /// A name is that of no parameter.
    UnknownParameter {
        /// The name.
        name: String,
        /// The nearest names there are.
        nearest: Vec<String>,
    },
}

impl fmt::Display for EvaluationError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Solve(error) => error.fmt(f),
            Self::Derivative(error) => error.fmt(f),
            Self::Flexible => f.write_str(
                "derivatives by parameters are not available for a flexible structure; use a rigid hub",
            ),
            Self::Sticks { joint } => write!(
                f,
                "whether static friction holds {joint}, which is at rest, only a run decides; give it a rate, lock \
                 it, or give it smoothed friction: `coulomb` with `coulomb_rate`"
            ),
            Self::AtLargestRate { joint } => write!(
                f,
                "whether the motor holds {joint}, which is at its largest rate or beyond it, only a run decides; give it a \
                 smaller rate, or remove the limit"
            ),
            Self::Friction { joint } => write!(
                f,
                "the friction of {joint} has no derivatives: static friction and quadratic drag are of runs only; \
                 remove them, or give it `damping`, and `coulomb` with `coulomb_rate`"
            ),
            Self::UnknownParameter { name, nearest } => {
                write!(f, "`{name}` is no parameter of the spacecraft")?;
                nearest.iter().enumerate().try_for_each(|(index, near)| {
                    let lead = if index == 0 { "; nearest: " } else { ", " };
                    write!(f, "{lead}`{near}`")
                })
            }
        }
    }
}

impl Error for EvaluationError {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        match self {
            Self::Solve(source) => Some(source),
            Self::Derivative(source) => Some(source),
            Self::Flexible
            | Self::Sticks { .. }
            | Self::AtLargestRate { .. }
            | Self::Friction { .. }
            | Self::UnknownParameter { .. } => None,
        }
    }
}

impl From<SolveError> for EvaluationError {
    fn from(error: SolveError) -> Self {
        Self::Solve(error)
    }
}

impl From<ParameterError> for EvaluationError {
    fn from(error: ParameterError) -> Self {
        Self::Derivative(DerivativeError::Parameter(error))
    }
}

impl From<DerivativeError> for EvaluationError {
    fn from(error: DerivativeError) -> Self {
        match error {
            DerivativeError::Solve(error) => Self::Solve(error),
            error => Self::Derivative(error),
        }
    }
}
