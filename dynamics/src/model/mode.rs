//! What is given of a joint or of the hub, and what is found: [`Mode`], [`HubMode`].

use nalgebra::Vector3;

use crate::numbers::real::{Scalar, one, zero};

/// What is given of a joint at one instant. It may change from step to step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mode<T = f64> {
    /// The motor torque is given, the acceleration is found.
    Driven,
    /// The acceleration is given, rad/s² (or m/s²); the torque is found by
    /// [`Spacecraft::loads`](crate::Spacecraft::loads).
    Prescribed(T),
    /// The joint does not move: its rate must be zero. A moving one is stopped first, by
    /// [`Spacecraft::stop`](crate::Spacecraft::stop). The torque is found as for a prescribed one.
    Locked,
}

/// What is given of the hub.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum HubMode<T = f64> {
    /// External force and torque are given, the accelerations are found.
    #[default]
    Free,
    /// The hub is clamped, as on a dynamometer table: nothing of it moves, and force and torque of
    /// the clamp are found by [`Spacecraft::loads`](crate::Spacecraft::loads). Its velocities must
    /// be zero.
    Fixed,
    /// The hub's accelerations are given, expressed in B.
    Prescribed {
        /// Inertial acceleration of B, m/s².
        r_b_n_ddot: Vector3<T>,
        /// Angular acceleration, rad/s².
        omega_dot: Vector3<T>,
    },
}

/// A joint's torque and mode as an emitted kernel takes them: weights instead of a branch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drive<T> {
    /// Torque, where it is given, N m (or N).
    pub torque: T,
    /// One where the torque is given, else zero.
    pub driven: T,
    /// Zero where the torque is given, else one, in the pivot's unit: any positive number keeps the
    /// reciprocal of an unused pivot finite.
    pub held: T,
    /// The acceleration where it is given, else zero, rad/s² (or m/s²).
    pub given: T,
}

impl<T: Copy> Drive<T> {
    /// The drive with each of its numbers changed.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "lanes reach wide instructions only where inlined")]
    #[must_use]
    pub fn map<U>(&self, mut change: impl FnMut(T) -> U) -> Drive<U> {
        Drive {
            torque: change(self.torque),
            driven: change(self.driven),
            held: change(self.held),
            given: change(self.given),
        }
    }
}

impl<T: Scalar> Mode<T> {
    /// The weights for a given torque.
    pub(crate) fn drive(self, torque: T) -> Drive<T> {
        let given = match self {
            Self::Driven => {
                return Drive { torque, driven: one(), held: zero(), given: zero() };
            }
            Self::Prescribed(acceleration) => acceleration,
            Self::Locked => zero(),
        };
        Drive { torque: zero(), driven: zero(), held: one(), given }
    }
}
