//! Modes of a joint and of the hub, which say what is an input and what is computed: [`Mode`],
//! [`HubMode`].

use nalgebra::Vector3;

use crate::numbers::real::{Scalar, one, zero};

/// Mode of one joint: driven, prescribed or locked. It may change from step to step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mode<T = f64> {
    /// The motor torque is an input, the acceleration is computed.
    Driven,
    /// The acceleration is an input, rad/s² (or m/s²); the torque is computed by
    /// [`Spacecraft::loads`](crate::Spacecraft::loads).
    Prescribed(T),
    /// The joint does not move: its rate must be zero. A moving one is stopped first, by
    /// [`Spacecraft::stop`](crate::Spacecraft::stop). The torque is computed as for a prescribed
    /// one.
    Locked,
}

/// Mode of the hub: free, fixed or prescribed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum HubMode<T = f64> {
    /// External force and torque are inputs, the accelerations are computed.
    #[default]
    Free,
    /// The hub is clamped, as on a dynamometer table: it is at rest, and force and torque of the
    /// clamp are computed by [`Spacecraft::loads`](crate::Spacecraft::loads). Its velocities must
    /// be zero.
    Fixed,
    /// The hub's accelerations are inputs, expressed in B.
    Prescribed {
        /// Inertial acceleration of B, m/s².
        r_b_n_ddot: Vector3<T>,
        /// Angular acceleration, rad/s².
        omega_dot: Vector3<T>,
    },
}

/// A joint's torque and mode as the emitted kernels use them: weights instead of a branch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drive<T> {
    /// Torque of a driven joint, N m (or N).
    pub torque: T,
    /// One of a driven joint, else zero.
    pub driven: T,
    /// Zero of a driven joint, else one, in the pivot's unit: any positive number keeps the
    /// reciprocal of an unused pivot finite.
    pub held: T,
    /// The acceleration of a joint that is not driven, else zero, rad/s² (or m/s²).
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
    /// The weights for a motor torque.
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
