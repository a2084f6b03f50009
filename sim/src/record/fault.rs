//! [`Fault`]: what the integrator reports that no run of this program should cause.

use std::fmt;

use crate::units::Plain;

/// A report of the integrator that is a fault of this program.
#[derive(Clone, Debug, PartialEq)]
pub enum Fault {
    /// It rejects the span or the first step; the reason is known in its own words only.
    Input {
        /// Its words.
        reason: String,
    },
    /// The interpolant was evaluated outside the last step.
    Interpolation {
        /// The time of the state, s.
        time: f64,
        /// Start of the last step, s.
        from: f64,
        /// End of the last step, s.
        to: f64,
    },
    /// It takes the equations for ones with a delay.
    Delay,
    /// It solved linear equations and failed; the reason is known in its own words only.
    LinearAlgebra {
        /// Its words.
        reason: String,
    },
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Input { reason } => write!(f, "its input is rejected ({reason})"),
            Self::Interpolation { time, from, to } => {
                write!(
                    f,
                    "a state at {time} s, outside its last step, {from} s to {to} s",
                    time = Plain(*time)
                )
            }
            Self::Delay => f.write_str("equations without a delay are taken for ones with one"),
            Self::LinearAlgebra { reason } => write!(f, "linear equations failed ({reason})"),
        }
    }
}
