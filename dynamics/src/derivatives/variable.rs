//! [`Variable`]: what a derivative is taken by, apart from parameters, and its name.

use core::fmt::{self, Display, Formatter};

use crate::derivatives::structure::StructureDerivatives;
use crate::model::kind::JointInfo;
use crate::model::mode::{HubMode, Mode};
use crate::numbers::each::Each;
use crate::numbers::vec3::Vec3;
use crate::sets::devices::Devices;
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;

/// One of three axes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Axis {
    /// The first.
    X,
    /// The second.
    Y,
    /// The third.
    Z,
}

/// A coordinate, rate or input that a derivative is taken by. Joints count from 0 through the whole
/// spacecraft, in the order of [`Spacecraft::joints`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Variable {
    /// Of the position of B, N axes, m.
    Position(Axis),
    /// Of a small rotation `dtheta` of the hub about the axes of B, rad:
    /// `[BN](dtheta) = (1 - tilde(dtheta)) [BN]`.
    Attitude(Axis),
    /// Of the velocity of B, N axes, m/s.
    Velocity(Axis),
    /// Of the angular velocity, B axes, rad/s.
    Omega(Axis),
    /// The coordinate of a joint, rad or m.
    Coordinate(usize),
    /// The rate of a joint, rad/s or m/s.
    Rate(usize),
    /// Of the external force through B, B axes, N.
    Force(Axis),
    /// Of the external torque about B, B axes, N m.
    TorqueB(Axis),
    /// The motor torque of a joint, N m (force, N, of a sliding joint).
    Motor(usize),
    /// The prescribed acceleration of a joint, rad/s² or m/s².
    Acceleration(usize),
    /// Of the prescribed acceleration of B, B axes, m/s².
    HubAcceleration(Axis),
    /// Of the prescribed angular acceleration of the hub, B axes, rad/s².
    HubAngularAcceleration(Axis),
    /// Of the external force on the child body of a joint, the body's axes, N.
    BodyForce(usize, Axis),
    /// Of the external moment on the child body of a joint about the joint's origin, the body's
    /// axes, N m.
    BodyMoment(usize, Axis),
    /// Of a uniform field of gravity, N axes, m/s².
    Gravity(Axis),
    /// The gravitational parameter of a central field, m³/s².
    Mu,
    /// A modal coordinate of a flexible structure, m sqrt(kg).
    ModalCoordinate(usize),
    /// Its rate, m sqrt(kg)/s.
    ModalRate(usize),
    /// The force on a mode, N/sqrt(kg).
    ModalForce(usize),
    /// Of the external force on the structure at a mount, the axes of the mount, N.
    MountForce(usize, Axis),
    /// Of the external moment on the structure at a mount about the mount, the axes of the mount, N m.
    MountMoment(usize, Axis),
}

/// The name of a [`Variable`]: `omega.x`, `devices[1].spin`, `motors[1].u_w`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct VariableName {
    variable: Variable,
    /// Number of the device, and the joint, of a variable that belongs to one.
    joint: Option<(usize, &'static JointInfo)>,
}

impl Axis {
    /// All three in order.
    pub const ALL: [Self; 3] = [Self::X, Self::Y, Self::Z];

    /// The component along it.
    pub(crate) fn of<T>(self, [x, y, z]: Vec3<T>) -> T {
        match self {
            Self::X => x,
            Self::Y => y,
            Self::Z => z,
        }
    }

    /// The component along it, to be changed.
    pub(crate) fn of_mut<T>(self, v: &mut nalgebra::Vector3<T>) -> &mut T {
        let [[x, y, z]] = &mut v.data.0;
        match self {
            Self::X => x,
            Self::Y => y,
            Self::Z => z,
        }
    }

    /// Its letter.
    const fn letter(self) -> char {
        match self {
            Self::X => 'x',
            Self::Y => 'y',
            Self::Z => 'z',
        }
    }
}

impl Variable {
    /// The joint that it belongs to.
    #[must_use]
    pub fn joint(self) -> Option<usize> {
        match self {
            Self::Coordinate(joint)
            | Self::Rate(joint)
            | Self::Motor(joint)
            | Self::Acceleration(joint)
            | Self::BodyForce(joint, _)
            | Self::BodyMoment(joint, _) => Some(joint),
            _ => None,
        }
    }
}

/// The states of a hub, in order: none of one that is fixed.
pub(crate) fn hub_states<T>(mode: &HubMode<T>) -> &'static [Variable] {
    const STATES: [Variable; 12] = {
        let [x, y, z] = Axis::ALL;
        [
            Variable::Position(x),
            Variable::Position(y),
            Variable::Position(z),
            Variable::Attitude(x),
            Variable::Attitude(y),
            Variable::Attitude(z),
            Variable::Velocity(x),
            Variable::Velocity(y),
            Variable::Velocity(z),
            Variable::Omega(x),
            Variable::Omega(y),
            Variable::Omega(z),
        ]
    };
    if matches!(mode, HubMode::Fixed) { &[] } else { &STATES }
}

/// The inputs of a hub, in order: none of one that is fixed.
pub(crate) fn hub_inputs<T>(mode: &HubMode<T>) -> &'static [Variable] {
    const LOADS: [Variable; 6] = {
        let [x, y, z] = Axis::ALL;
        [
            Variable::Force(x),
            Variable::Force(y),
            Variable::Force(z),
            Variable::TorqueB(x),
            Variable::TorqueB(y),
            Variable::TorqueB(z),
        ]
    };
    const GIVEN: [Variable; 6] = {
        let [x, y, z] = Axis::ALL;
        [
            Variable::HubAcceleration(x),
            Variable::HubAcceleration(y),
            Variable::HubAcceleration(z),
            Variable::HubAngularAcceleration(x),
            Variable::HubAngularAcceleration(y),
            Variable::HubAngularAcceleration(z),
        ]
    };
    match mode {
        HubMode::Free => &LOADS,
        HubMode::Fixed => &[],
        HubMode::Prescribed { .. } => &GIVEN,
    }
}

impl<D: Devices, S: StructureDerivatives> Spacecraft<D, S> {
    /// The states of the linearised system, in this order: position, attitude, velocity and angular
    /// velocity of the hub, coordinates of the joints, rates of the joints; modal coordinates of a
    /// flexible structure, their rates.
    ///
    /// What does not move is no state: those of a [fixed](HubMode::Fixed) hub and of
    /// [locked](Mode::Locked) joints are left out. [`Self::derivatives`] takes them nevertheless.
    pub fn state_variables(&self, inputs: &Inputs<D, S>) -> impl Iterator<Item = Variable> {
        let moving = || inputs.modes.values().enumerate().filter(|(_, mode)| *mode != Mode::Locked);
        let of_hub = hub_states(&inputs.hub).iter().copied();
        of_hub
            .chain(moving().map(|(joint, _)| Variable::Coordinate(joint)))
            .chain(moving().map(|(joint, _)| Variable::Rate(joint)))
            .chain((0..S::modes(self)).map(Variable::ModalCoordinate))
            .chain((0..S::modes(self)).map(Variable::ModalRate))
    }

    /// The inputs of the linearised system, in this order: of a free hub its force and torque, of a
    /// prescribed one its accelerations; of each joint its motor torque if it is driven, its
    /// acceleration if that is prescribed; if there are wrenches on bodies, force and moment on the
    /// child body of each joint; of a flexible structure the force on each mode, force and moment on
    /// each mount.
    pub fn input_variables(&self, inputs: &Inputs<D, S>) -> impl Iterator<Item = Variable> {
        let of_hub = hub_inputs(&inputs.hub).iter().copied();
        let modes = inputs.modes.values().zip(self.joints()).enumerate();
        let of_joints = modes.filter_map(|(joint, (mode, (_, info)))| match mode {
            Mode::Driven => Some(Variable::Motor(joint)),
            Mode::Prescribed(_) if info.driven => Some(Variable::Acceleration(joint)),
            Mode::Prescribed(_) | Mode::Locked => None,
        });
        let bodies = inputs.bodies.iter().flat_map(Each::values).enumerate();
        let on_bodies = bodies.flat_map(|(joint, _)| {
            let force = Axis::ALL.map(|axis| Variable::BodyForce(joint, axis));
            force.into_iter().chain(Axis::ALL.map(|axis| Variable::BodyMoment(joint, axis)))
        });
        let on_mounts = (0..S::mounts(self)).flat_map(|mount| {
            let force = Axis::ALL.map(|axis| Variable::MountForce(mount, axis));
            force.into_iter().chain(Axis::ALL.map(|axis| Variable::MountMoment(mount, axis)))
        });
        let on_modes = (0..S::modes(self)).map(Variable::ModalForce);
        of_hub.chain(of_joints).chain(on_bodies).chain(on_modes).chain(on_mounts)
    }

    /// How many [states](Self::state_variables) and [inputs](Self::input_variables) there are.
    pub(crate) fn variable_counts(&self, inputs: &Inputs<D, S>) -> [usize; 2] {
        let (mut moving, mut acting) = (0_usize, 0_usize);
        let mut infos = self.joints();
        for mode in inputs.modes.values() {
            let driven = infos.next().is_some_and(|(_, info)| info.driven);
            moving = moving.wrapping_add(usize::from(mode != Mode::Locked));
            let acts = mode == Mode::Driven || driven && matches!(mode, Mode::Prescribed(_));
            acting = acting.wrapping_add(usize::from(acts));
        }
        let bodies = inputs.bodies.iter().flat_map(Each::values).count();
        let (modes, mounts) = (S::modes(self), S::mounts(self));
        let of_bodies = bodies.saturating_add(mounts).saturating_mul(6).saturating_add(modes);
        let (of_hub, on_hub) = (hub_states(&inputs.hub).len(), hub_inputs(&inputs.hub).len());
        let states = moving.saturating_add(modes).saturating_mul(2).saturating_add(of_hub);
        [states, acting.saturating_add(of_bodies).saturating_add(on_hub)]
    }

    /// The name of a variable, by the fields of [`State`](crate::State) and [`Inputs`].
    #[must_use]
    pub fn variable_name(&self, variable: Variable) -> VariableName {
        let joint = variable.joint().and_then(|joint| self.joints().nth(joint));
        VariableName { variable, joint }
    }
}

impl Display for VariableName {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        if let Some((device, info)) = self.joint {
            let body = Body(info.body);
            return match self.variable {
                Variable::Coordinate(_) => write!(f, "devices[{device}].{}", info.coordinate),
                Variable::Rate(_) => write!(f, "devices[{device}].{}", info.rate),
                Variable::Motor(_) => write!(f, "motors[{device}].{}", info.motor),
                Variable::BodyForce(_, axis) => {
                    write!(f, "bodies[{device}].{body}.force.{}", axis.letter())
                }
                Variable::BodyMoment(_, axis) => {
                    write!(f, "bodies[{device}].{body}.moment.{}", axis.letter())
                }
                _ => write!(f, "modes[{device}].{body}"),
            };
        }
        self.variable.fmt(f)
    }
}

/// Without the names of joints, which only a spacecraft knows.
impl Display for Variable {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let (field, axis) = match *self {
            Self::Position(axis) => ("r_b_n", axis),
            Self::Attitude(axis) => ("attitude", axis),
            Self::Velocity(axis) => ("r_b_n_dot", axis),
            Self::Omega(axis) => ("omega", axis),
            Self::Force(axis) => ("force", axis),
            Self::TorqueB(axis) => ("torque_b", axis),
            Self::HubAcceleration(axis) => ("hub.r_b_n_ddot", axis),
            Self::HubAngularAcceleration(axis) => ("hub.omega_dot", axis),
            Self::Gravity(axis) => ("gravity", axis),
            Self::Mu => return f.write_str("gravity.mu"),
            Self::ModalCoordinate(mode) => return write!(f, "modal.eta[{mode}]"),
            Self::ModalRate(mode) => return write!(f, "modal.eta_dot[{mode}]"),
            Self::ModalForce(mode) => return write!(f, "modal.forces[{mode}]"),
            Self::MountForce(mount, axis) => {
                return write!(f, "modal.mounts[{mount}].force.{}", axis.letter());
            }
            Self::MountMoment(mount, axis) => {
                return write!(f, "modal.mounts[{mount}].moment.{}", axis.letter());
            }
            Self::Coordinate(joint) => return write!(f, "coordinate of joint {joint}"),
            Self::Rate(joint) => return write!(f, "rate of joint {joint}"),
            Self::Motor(joint) => return write!(f, "motor of joint {joint}"),
            Self::Acceleration(joint) => return write!(f, "acceleration of joint {joint}"),
            Self::BodyForce(joint, axis) => {
                return write!(f, "force on the body of joint {joint}.{}", axis.letter());
            }
            Self::BodyMoment(joint, axis) => {
                return write!(f, "moment on the body of joint {joint}.{}", axis.letter());
            }
        };
        write!(f, "{field}.{}", axis.letter())
    }
}

/// A body's name as an identifier: `inner_gimbal`.
struct Body(&'static str);

impl Display for Body {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let mut words = self.0.split(' ');
        f.write_str(words.next().unwrap_or_default())?;
        words.try_for_each(|word| write!(f, "_{word}"))
    }
}
