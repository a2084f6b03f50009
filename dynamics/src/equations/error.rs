//! Why the solver gives no result: [`SolveError`], and the names it uses for what is at fault.

use core::error::Error;
use core::fmt::{self, Display, Formatter};

use crate::numbers::real::Scalar;

/// An input of the solver, or a result of it. Devices count from 0, as in the set.
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
    /// A coordinate or rate in `State::devices`.
    Joint {
        /// Index of the device.
        device: usize,
        /// Which one: `gamma_i`, `spin`.
        field: &'static str,
    },
    /// `Inputs::force`.
    Force,
    /// `Inputs::torque_b`.
    TorqueB,
    /// A motor torque in `Inputs::motors`.
    Motor {
        /// Index of the device.
        device: usize,
        /// The body that the motor drives.
        joint: &'static str,
    },
    /// A joint's acceleration: prescribed, required of [`loads`](crate::Spacecraft::loads), or
    /// found.
    JointAcceleration {
        /// Index of the device.
        device: usize,
        /// The child body of the joint.
        joint: &'static str,
    },
    /// An acceleration of the hub: prescribed, required of [`loads`](crate::Spacecraft::loads), or
    /// found.
    HubAcceleration,
    /// `Inputs::gravity`.
    Gravity,
    /// An external wrench in `Inputs::bodies`.
    Wrench {
        /// Index of the device.
        device: usize,
        /// The body it acts on.
        body: &'static str,
    },
    /// The step's length `dt`.
    TimeStep,
    /// The point of [`About::Point`](crate::About::Point).
    ReferencePoint,
    /// Kinetic or potential energy, or the energy lost in a stop.
    Energy,
    /// Linear or angular momentum.
    Momentum,
    /// The centre of mass or its velocity seen from B.
    CentreOfMass,
    /// Force and moment that the hub needs: `Loads::hub`.
    HubLoad,
    /// Load, motor torque or power of a joint in [`Loads`](crate::Loads), or the load of the mount.
    Load {
        /// Index of the device.
        device: usize,
        /// The body outboard of the joint.
        joint: &'static str,
    },
    /// A power or a rate of the [`Ledger`](crate::Ledger).
    Power,
    /// The work of a step: `Stepped::work`.
    Work,
    /// `ModalState::eta`.
    ModalCoordinate {
        /// Its mode.
        mode: usize,
    },
    /// `ModalState::eta_dot`.
    ModalRate {
        /// Its mode.
        mode: usize,
    },
    /// `ModalInputs::forces`.
    ModalForce {
        /// Its mode.
        mode: usize,
    },
    /// `ModalInputs::mounts`.
    MountWrench {
        /// The mount.
        mount: usize,
    },
    /// `ModalAccelerations::eta_ddot`.
    ModalAcceleration,
}

/// Why a state gives no accelerations, energy, momentum or next state.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum SolveError<T = f64> {
    /// The mass matrix is singular: a pivot of its elimination is not above rounding.
    Singular {
        /// Index of the device, or `None` for the hub's six equations.
        device: Option<usize>,
        /// The joint whose pivot it is, by its child body, or `None` for the hub.
        joint: Option<&'static str>,
        /// The pivot: the inertia left to that joint, kg m^2 (hub, sliding joint: also kg).
        pivot: T,
        /// The bound it is not above: 64 epsilons of the mass or inertia that was there before any
        /// joint was eliminated (of a joint, in the pose that makes the most of it), and of what
        /// the rounding of earlier pivots makes of it.
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
    /// A joint is locked while it moves.
    LockedJointMoves {
        /// Index of the device.
        device: usize,
        /// The child body of the joint.
        joint: &'static str,
        /// Its rate, rad/s (or m/s).
        rate: T,
    },
    /// The hub is fixed while it moves.
    FixedHubMoves {
        /// The largest component of its velocities, m/s or rad/s.
        value: T,
    },
    /// A mode that the joint's kind does not have: it keeps the joint's rate constant.
    NotDriven {
        /// Index of the device.
        device: usize,
        /// The child body of the joint.
        joint: &'static str,
    },
    /// The field of a central body has no value at its centre, where B is.
    AtCentre,
    /// A list has data for another number of devices, or of joints, than there are.
    Count {
        /// The number of devices, or of joints.
        expected: usize,
        /// The length of the list.
        found: usize,
    },
    /// Springs, dampers or friction of the joints are too stiff for the step: Runge-Kutta's method
    /// of fourth order is unstable with them, and would make energy or lose it without end.
    Unstable {
        /// Index of the device with the joint that has most of the energy of the fastest vibration.
        device: usize,
        /// The body outboard of that joint.
        joint: &'static str,
        /// The step's length, s.
        dt: T,
        /// The longest step that is stable at this state, s.
        longest: T,
    },
    /// What the model of a structure contains at its mounts, and is subtracted, leaves a direction
    /// of its modes without mass.
    ModalMass {
        /// The pivot of the modal mass, 1 where nothing stands on the mounts.
        pivot: T,
        /// The bound it is not above: 64 epsilons of the mass that was there before any joint was
        /// eliminated, and of what the rounding of earlier pivots makes of it.
        bound: T,
    },
    /// A structure vibrates too fast for the step, with what stands on it: Runge-Kutta's method of
    /// fourth order is unstable with it. The modes have most of the energy of that vibration.
    UnstableModes {
        /// The step's length, s.
        dt: T,
        /// The longest step that is stable at this state, s.
        longest: T,
    },
    /// Modal coordinates, rates or forces are not one per mode, or wrenches not one per mount.
    ModalCount {
        /// The number of modes, or of mounts.
        expected: usize,
        /// The length of the list.
        found: usize,
    },
    /// Every input is finite, but they are so large (or small) that the result is not.
    Overflow {
        /// The first result that is not finite; of accelerations, a joint's before the hub's.
        what: Quantity,
    },
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
            Self::JointAcceleration { device, joint } => {
                write!(f, "acceleration of device {device} ({joint})")
            }
            Self::HubAcceleration => f.write_str("acceleration of the hub"),
            Self::Gravity => f.write_str("gravity"),
            Self::Wrench { device, body } => write!(f, "wrench on device {device} ({body})"),
            Self::TimeStep => f.write_str("time step dt"),
            Self::ReferencePoint => f.write_str("reference point"),
            Self::Energy => f.write_str("energy"),
            Self::Momentum => f.write_str("momentum"),
            Self::CentreOfMass => f.write_str("centre of mass"),
            Self::HubLoad => f.write_str("load of the hub"),
            Self::Load { device, joint } => write!(f, "load of device {device} ({joint})"),
            Self::Power => f.write_str("power"),
            Self::Work => f.write_str("work of the step"),
            Self::ModalCoordinate { mode } => write!(f, "modal coordinate {mode}"),
            Self::ModalRate { mode } => write!(f, "rate of modal coordinate {mode}"),
            Self::ModalForce { mode } => write!(f, "force of mode {mode}"),
            Self::MountWrench { mount } => write!(f, "wrench on mount {mount}"),
            Self::ModalAcceleration => f.write_str("acceleration of a modal coordinate"),
        }
    }
}

impl<T: Scalar> Display for SolveError<T> {
    #[expect(clippy::too_many_lines, reason = "one arm for each cause")]
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
                match joint {
                    None => f.write_str(
                        "check the hub's mass and inertia, and that its centre of mass is not far \
                         from B",
                    ),
                    Some(joint) => {
                        write!(
                            f,
                            "check mass and inertia of the {joint} and of all bodies outboard of it"
                        )?;
                        if joint.ends_with("gimbal") {
                            f.write_str(
                                "; a massless gimbal is singular where it would turn about the \
                                 spin axis",
                            )?;
                        }
                        if joint == "x turn" {
                            f.write_str(
                                "; with the y turn at 90 degrees the x turn is about the axis of \
                                 the z turn: both are singular there if they are free, and one is \
                                 if nothing has inertia about that axis",
                            )?;
                        }
                        Ok(())
                    }
                }
            }
            Self::NotFinite { what: Quantity::Attitude, value } => {
                let value = value.to_f64();
                if value.is_finite() {
                    write!(f, "largest attitude parameter {value:?} leaves no usable length")
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
            Self::LockedJointMoves { device, joint, rate } => write!(
                f,
                "locked joint of device {device} ({joint}) moves at {:?}, not 0; stop it first, \
                 or unlock it",
                rate.to_f64(),
            ),
            Self::FixedHubMoves { value } => write!(
                f,
                "fixed hub moves at {:?} m/s or rad/s, not 0; set its velocities to zero, or stop \
                 it first",
                value.to_f64(),
            ),
            Self::NotDriven { device, joint } => write!(
                f,
                "joint of device {device} ({joint}) is held at its rate by its kind and takes no \
                 other mode; use a kind that drives it"
            ),
            Self::AtCentre => f.write_str(
                "B is 0.0 m from the centre of gravity, where there is no field; set r_b_n to its \
                 position from that centre",
            ),
            Self::Count { expected, found } => write!(
                f,
                "a list has {found} entries, not {expected}; give one for each device, and in it one \
                 for each joint"
            ),
            Self::Unstable { device, joint, dt, longest } => write!(
                f,
                "step of {:?} s is too long for spring and friction of device {device} ({joint}): \
                 the method is stable up to {:?} s; shorten the step, or raise coulomb_rate",
                dt.to_f64(),
                longest.to_f64(),
            ),
            Self::ModalMass { pivot, bound } => write!(
                f,
                "pivot {:?} of the modal mass is not above {:?}; check the bodies that the model \
                 contains at its mounts, and that its shapes are mass-normalised",
                pivot.to_f64(),
                bound.to_f64(),
            ),
            Self::UnstableModes { dt, longest } => write!(
                f,
                "step of {:?} s is too long for the modes of the structure: the method is stable up \
                 to {:?} s; shorten the step, or leave the fastest mode out",
                dt.to_f64(),
                longest.to_f64(),
            ),
            Self::ModalCount { expected, found } => write!(
                f,
                "a list has {found} entries, not {expected}; give one for each mode, and one wrench \
                 for each mount"
            ),
            Self::Overflow { what } => write!(
                f,
                "{what} is not finite although every input is; check the units of large or tiny \
                 inputs",
            ),
        }
    }
}

impl<T: Scalar> Error for SolveError<T> {}
