//! What the loads of the devices add up to for the hub and the ledger, and the axes they are
//! expressed in.

use crate::equations::suspension_forces::Forces;
use crate::model::wrench::Wrench;
use crate::numbers::real::{Scalar, zero};
use crate::numbers::symmetric::Symmetric;
use crate::numbers::vec3::{Columns, Vec3};

/// Axes for the loads of joints.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Along<T> {
    /// The body's own.
    Body,
    /// Those of the parent body.
    Parent,
    /// Those along which B axes are the columns; none for B axes themselves.
    Hub(Option<Columns<T>>),
}

/// How the hub moves, expressed in B, seen from a frame that falls with gravity.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HubAccelerations<T> {
    pub(crate) r_b_n_ddot: Vec3<T>,
    pub(crate) omega_dot: Vec3<T>,
}

/// Sums of the devices' wrenches on the hub and of the powers of their joints.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LoadSums<T> {
    /// What the devices need for their accelerations, about B, expressed in B.
    pub(crate) inertial: Wrench<T>,
    /// What acts on their bodies from outside.
    pub(crate) applied: Wrench<T>,
    /// What the gradient of gravity exerts on them.
    pub(crate) gradient: Wrench<T>,
    /// Second moment about B; only with a central field.
    pub(crate) second_moment: Symmetric<T>,
    /// Powers of the joints.
    pub(crate) power: JointPowers<T>,
    /// How many joints have been added.
    pub(crate) joints: usize,
    /// The first joint of a device whose loads, motor torques or powers are not all finite.
    pub(crate) overflow: Option<usize>,
}

/// Powers at the joints, W: the part of each source that the joints' rates take up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct JointPowers<T> {
    pub(crate) inertial: T,
    pub(crate) applied: T,
    pub(crate) gradient: T,
    pub(crate) motors: T,
    pub(crate) springs: T,
    pub(crate) friction: T,
    /// Energy of the springs, J.
    pub(crate) stored: T,
    /// Sum of the powers' magnitudes.
    pub(crate) magnitude: T,
}

/// What a carrier gets from elsewhere than its own body and joints.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Added<T> {
    /// What the carried devices need, about P, carrier axes.
    pub(crate) inertial: Wrench<T>,
    /// What acts on their bodies from outside.
    pub(crate) applied: Wrench<T>,
    /// What the gradient of gravity exerts on them.
    pub(crate) gradient: Wrench<T>,
    /// Springs and dampers that couple its joints.
    pub(crate) suspension: Forces<T>,
}

impl<T: Scalar> JointPowers<T> {
    /// Adds those of other joints.
    pub(crate) fn add(&mut self, other: &Self) {
        for (sum, power) in [
            (&mut self.inertial, other.inertial),
            (&mut self.applied, other.applied),
            (&mut self.gradient, other.gradient),
            (&mut self.motors, other.motors),
            (&mut self.springs, other.springs),
            (&mut self.friction, other.friction),
            (&mut self.stored, other.stored),
            (&mut self.magnitude, other.magnitude),
        ] {
            *sum = *sum + power;
        }
    }

    fn none() -> Self {
        Self {
            inertial: zero(),
            applied: zero(),
            gradient: zero(),
            motors: zero(),
            springs: zero(),
            friction: zero(),
            stored: zero(),
            magnitude: zero(),
        }
    }
}

impl<T: Scalar> LoadSums<T> {
    pub(crate) fn none() -> Self {
        let none = Wrench::none();
        let power = JointPowers::none();
        let second_moment = Symmetric::zero();
        Self {
            inertial: none,
            applied: none,
            gradient: none,
            second_moment,
            power,
            joints: 0,
            overflow: None,
        }
    }
}
