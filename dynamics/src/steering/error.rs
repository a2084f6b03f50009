//! [`SteeringError`]: why there is no steering.

use core::error::Error;
use core::fmt::{self, Display, Formatter};

use crate::equations::error::SolveError;
use crate::numbers::real::Scalar;

/// Why there is no steering.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum SteeringError<T = f64> {
    /// The arrays are shorter than there are joints.
    Joints {
        /// The number of joints of the spacecraft.
        expected: usize,
        /// The length of the arrays.
        found: usize,
    },
    /// A device has no emitted function `steer`: a platform.
    Platform {
        /// Index of the device.
        device: usize,
    },
    /// The commanded joints give no torque along some direction: the devices are singular.
    Singular {
        /// The pivot of `Q W Q^T`.
        pivot: T,
        /// The bound it is not above: 64 epsilons of the largest diagonal element.
        bound: T,
    },
    /// A command, weight, bound or parameter of a law is infinite or NaN, or a weight below zero, or a lower bound above
    /// its upper one.
    Argument {
        /// What it is.
        what: &'static str,
        /// Its place in the array, 0 where it is in none.
        index: usize,
        /// Its value.
        value: T,
    },
    /// Every input is finite, but they are so large (or small) that the commands are not.
    Overflow,
    /// State, inputs or result of the solver.
    Solve(SolveError<T>),
}

impl<T> From<SolveError<T>> for SteeringError<T> {
    fn from(error: SolveError<T>) -> Self {
        Self::Solve(error)
    }
}

impl<T: Scalar> Display for SteeringError<T> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Joints { expected, found } => {
                write!(f, "arrays of {found} for {expected} joints; give one element per joint")
            }
            Self::Platform { device } => write!(
                f,
                "device {device} is a platform, which has no steering terms; steer devices on the hub"
            ),
            Self::Singular { pivot, bound } => write!(
                f,
                "pivot {:?} of Q W Q^T is not above {:?}: the commanded joints give no torque along some direction; \
                 use a singularity-robust inverse, or null motion before",
                pivot.to_f64(),
                bound.to_f64()
            ),
            Self::Argument { what, index, value } => write!(
                f,
                "{what} {index} is {:?}; it must be finite, a weight not below zero, a bound in order",
                value.to_f64()
            ),
            Self::Overflow => f.write_str(
                "commands are not finite; check the units of torque, weights and reference momentum",
            ),
            Self::Solve(error) => Display::fmt(error, f),
        }
    }
}

impl<T: Scalar> Error for SteeringError<T> {}

/// Rejects a number that is not finite.
pub(super) fn finite<T: Scalar>(
    what: &'static str,
    values: impl IntoIterator<Item = T>,
) -> Result<(), SteeringError<T>> {
    let found = values.into_iter().enumerate().find(|(_, value)| !value.is_finite());
    found.map_or(Ok(()), |(index, value)| Err(SteeringError::Argument { what, index, value }))
}
