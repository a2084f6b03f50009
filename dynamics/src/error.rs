//! Why the solver gives no result: [`SolveError`], and the names it uses for what is at fault.

use core::error::Error;
use core::fmt::{self, Display, Formatter};

use crate::real::Scalar;

/// A joint of a device.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Joint {
    /// The outer gimbal's, between hub and outer gimbal.
    OuterGimbal,
    /// The inner gimbal's, between outer and inner gimbal.
    InnerGimbal,
    /// The wheel's, between inner gimbal and wheel.
    Wheel,
}

/// A quantity of one joint in a [`Joints`](crate::Joints).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JointField {
    /// Outer gimbal angle.
    GammaO,
    /// Inner gimbal angle.
    GammaI,
    /// Wheel angle.
    Theta,
    /// Outer gimbal rate.
    GammaODot,
    /// Inner gimbal rate.
    GammaIDot,
    /// Wheel rate.
    Spin,
}

/// An input of the solver. Devices count from 0, as in the arrays given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Quantity {
    /// `State::r_b_n`.
    Position,
    /// `State::r_b_n_dot`.
    Velocity,
    /// `State::attitude`; also a quaternion of length zero, and MRPs whose square overflows.
    Attitude,
    /// `State::omega`.
    BodyRate,
    /// An angle or rate in `State::devices`.
    Joint {
        /// Index of the device.
        device: usize,
        /// Which angle or rate.
        field: JointField,
    },
    /// `Torques::force`.
    Force,
    /// `Torques::torque_b`.
    TorqueB,
    /// A motor torque in `Torques::motors`.
    Motor {
        /// Index of the device.
        device: usize,
        /// The joint that the motor drives.
        joint: Joint,
    },
    /// The step's length `dt`.
    TimeStep,
    /// The point of [`About::Point`](crate::About::Point).
    ReferencePoint,
}

/// Why a state gives no accelerations, energy, momentum or next state.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum SolveError<T = f64> {
    /// The mass matrix is singular: a pivot of its elimination is not above rounding.
    Singular {
        /// Index of the device, or `None` for the hub's six equations.
        device: Option<usize>,
        /// The joint whose pivot it is, or `None` for the hub.
        joint: Option<Joint>,
        /// The pivot: the inertia left to that joint, kg m^2 (hub: kg or kg m^2).
        pivot: T,
        /// The bound it is not above: 64 epsilons of the diagonal before the elimination.
        bound: T,
    },
    /// An input is infinite or NaN, or an attitude without a usable length.
    NotFinite {
        /// The first such input, in the order state, torques, rest.
        what: Quantity,
        /// The first component that is not finite; of an attitude, [`Attitude::extreme`].
        ///
        /// [`Attitude::extreme`]: crate::Attitude::extreme
        value: T,
    },
    /// Every input is finite, but they are so large (or small) that the result is not.
    Overflow,
}

impl Display for Joint {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::OuterGimbal => "outer gimbal",
            Self::InnerGimbal => "inner gimbal",
            Self::Wheel => "wheel",
        })
    }
}

impl Display for JointField {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::GammaO => "gamma_o",
            Self::GammaI => "gamma_i",
            Self::Theta => "theta",
            Self::GammaODot => "gamma_o_dot",
            Self::GammaIDot => "gamma_i_dot",
            Self::Spin => "spin",
        })
    }
}

impl Display for Quantity {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Position => f.write_str("position r_b_n"),
            Self::Velocity => f.write_str("velocity r_b_n_dot"),
            Self::Attitude => f.write_str("attitude"),
            Self::BodyRate => f.write_str("angular velocity omega"),
            Self::Joint { device, field } => write!(f, "{field} of device {device}"),
            Self::Force => f.write_str("force"),
            Self::TorqueB => f.write_str("torque_b"),
            Self::Motor { device, joint } => {
                write!(f, "motor torque of device {device} ({joint})")
            }
            Self::TimeStep => f.write_str("time step dt"),
            Self::ReferencePoint => f.write_str("reference point"),
        }
    }
}

impl<T: Scalar> Display for SolveError<T> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Singular { device, joint, pivot, bound } => {
                write!(f, "pivot {:?} of ", pivot.to_f64())?;
                match (device, joint) {
                    (Some(device), Some(joint)) => write!(f, "device {device} ({joint})")?,
                    (Some(device), None) => write!(f, "device {device}")?,
                    (None, _) => f.write_str("the hub")?,
                }
                write!(f, " is not above {:?}; ", bound.to_f64())?;
                f.write_str(match (device, joint) {
                    (None, _) => "check the hub's mass and inertia",
                    (_, Some(Joint::OuterGimbal)) => {
                        "massless gimbals are singular at gamma_i = 90 deg, check its inertias"
                    }
                    (_, Some(Joint::InnerGimbal) | None) => {
                        "check the inertias of its inner gimbal and wheel"
                    }
                    (_, Some(Joint::Wheel)) => {
                        "the wheel needs inertia about its spin axis, check i_w_wc"
                    }
                })
            }
            Self::NotFinite { what: Quantity::Attitude, value } => {
                let value = value.to_f64();
                if value.is_finite() {
                    write!(f, "{value:?} as largest parameter of the attitude has no usable length")
                } else {
                    write!(f, "{value:?} in the attitude is not finite")
                }?;
                f.write_str("; give a unit quaternion, or MRPs up to 1")
            }
            Self::NotFinite { what, value } => write!(
                f,
                "{:?} in {what} is not finite; give finite numbers in SI units",
                value.to_f64(),
            ),
            Self::Overflow => f.write_str(
                "the result is not finite although every input is; check the units of large \
                 or tiny inputs",
            ),
        }
    }
}

impl<T: Scalar> Error for SolveError<T> {}

#[cfg(test)]
mod tests {
    use std::string::ToString;

    use super::*;

    #[test]
    fn singular_pivot_tells_value_bound_and_remedy() {
        let mut error = SolveError::Singular {
            device: Some(2),
            joint: Some(Joint::OuterGimbal),
            pivot: 3e-19,
            bound: 1e-12,
        };
        assert_eq!(
            error.to_string(),
            "pivot 3e-19 of device 2 (outer gimbal) is not above 1e-12; massless gimbals are \
             singular at gamma_i = 90 deg, check its inertias"
        );
        for (joint, remedy) in [(Joint::InnerGimbal, "inner gimbal and"), (Joint::Wheel, "i_w_wc")]
        {
            error = SolveError::Singular {
                device: Some(0),
                joint: Some(joint),
                pivot: 0.0,
                bound: 0.0,
            };
            assert!(error.to_string().contains(remedy), "{error}");
        }
        error = SolveError::Singular { device: None, joint: None, pivot: -1.0, bound: 0.5 };
        assert_eq!(
            error.to_string(),
            "pivot -1.0 of the hub is not above 0.5; check the hub's mass and inertia"
        );
    }

    #[test]
    fn input_that_is_not_finite_is_named() {
        let text = |what, value| SolveError::NotFinite { what, value }.to_string();
        assert_eq!(
            text(Quantity::Joint { device: 3, field: JointField::GammaIDot }, f64::NAN),
            "NaN in gamma_i_dot of device 3 is not finite; give finite numbers in SI units"
        );
        assert_eq!(
            text(Quantity::Motor { device: 1, joint: Joint::Wheel }, f64::NEG_INFINITY),
            "-inf in motor torque of device 1 (wheel) is not finite; give finite numbers in SI \
             units"
        );
    }

    #[test]
    fn attitude_tells_what_spoils_it() {
        let text =
            |value: f32| SolveError::NotFinite { what: Quantity::Attitude, value }.to_string();
        assert_eq!(
            text(f32::INFINITY),
            "inf in the attitude is not finite; give a unit quaternion, or MRPs up to 1"
        );
        assert_eq!(
            text(0.0),
            "0.0 as largest parameter of the attitude has no usable length; give a unit \
             quaternion, or MRPs up to 1"
        );
    }

    #[test]
    fn overflow_tells_the_remedy() {
        assert!(SolveError::<f32>::Overflow.to_string().contains("check the units"));
    }
}
