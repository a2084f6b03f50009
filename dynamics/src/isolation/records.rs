//! Records of the six joints of a platform: coordinates and rates, motors, accelerations, and a
//! value per joint, in the order from the base to the platform.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use crate::numbers::each::{Each, JointStates, Value};
use crate::numbers::real::Scalar;

/// Coordinates and relative rates of the joints.
///
/// The platform's axes are the mount's, turned about x by `alpha`, about the new y by `beta`,
/// about the new z by `gamma`. The three turns are independent while `|beta|` is below a quarter
/// turn; at it a driven turn is [singular](crate::SolveError::Singular).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joints<T = f64> {
    /// Position of P along the mount's x axis, m.
    pub x: T,
    /// Position of P along the mount's y axis, m.
    pub y: T,
    /// Position of P along the mount's z axis, m.
    pub z: T,
    /// Turn about the mount's x axis, rad.
    pub alpha: T,
    /// Turn about the y axis that `alpha` has turned, rad.
    pub beta: T,
    /// Turn about the platform's z axis, rad.
    pub gamma: T,
    /// `ẋ`, m/s.
    pub x_dot: T,
    /// `ẏ`, m/s.
    pub y_dot: T,
    /// `ż`, m/s.
    pub z_dot: T,
    /// `α̇`, rad/s.
    pub alpha_dot: T,
    /// `β̇`, rad/s.
    pub beta_dot: T,
    /// `γ̇`, rad/s.
    pub gamma_dot: T,
}

impl<T: Value> Joints<T> {
    /// From coordinates and rates in order.
    pub(crate) const fn of(q: [T; 6], rates: [T; 6]) -> Self {
        let [x, y, z, alpha, beta, gamma] = q;
        let [x_dot, y_dot, z_dot, alpha_dot, beta_dot, gamma_dot] = rates;
        Self { x, y, z, alpha, beta, gamma, x_dot, y_dot, z_dot, alpha_dot, beta_dot, gamma_dot }
    }

    /// The coordinates in order.
    #[inline(always)]
    pub(crate) const fn coordinates(&self) -> [T; 6] {
        [self.x, self.y, self.z, self.alpha, self.beta, self.gamma]
    }

    /// The rates in order.
    #[inline(always)]
    pub(crate) const fn rates(&self) -> [T; 6] {
        let Self { x_dot, y_dot, z_dot, alpha_dot, beta_dot, gamma_dot, .. } = *self;
        [x_dot, y_dot, z_dot, alpha_dot, beta_dot, gamma_dot]
    }
}

impl<T: Value> JointStates<T> for Joints<T> {
    fn states(&self) -> impl Iterator<Item = [T; 2]> {
        self.coordinates().into_iter().zip(self.rates()).map(|(q, rate)| [q, rate])
    }

    fn states_mut(&mut self) -> impl Iterator<Item = [&mut T; 2]> {
        [
            [&mut self.x, &mut self.x_dot],
            [&mut self.y, &mut self.y_dot],
            [&mut self.z, &mut self.z_dot],
            [&mut self.alpha, &mut self.alpha_dot],
            [&mut self.beta, &mut self.beta_dot],
            [&mut self.gamma, &mut self.gamma_dot],
        ]
        .into_iter()
    }
}

/// A record of six values with names: its array, and the values in order.
macro_rules! records {
    ($($(#[$doc:meta])* $record:ident { $($(#[$of:meta])* $field:ident),* })*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $record<V = f64> {
            $($(#[$of])* pub $field: V,)*
        }

        impl<V: Value> $record<V> {
            /// From the values in order, from the base to the platform.
            #[must_use]
            #[inline(always)]
            pub const fn of([$($field),*]: [V; 6]) -> Self {
                Self { $($field),* }
            }

            /// The same value at every joint.
            #[must_use]
            pub const fn all(value: V) -> Self {
                Self::of([value; 6])
            }

            /// The values in order.
            #[must_use]
            #[inline(always)]
            pub const fn array(&self) -> [V; 6] {
                [$(self.$field),*]
            }
        }

        impl<V: Value> Each<V> for $record<V> {
            fn values(&self) -> impl Iterator<Item = V> {
                self.array().into_iter()
            }

            fn values_mut(&mut self) -> impl Iterator<Item = &mut V> {
                [$(&mut self.$field),*].into_iter()
            }
        }
    )*};
}

records! {
    /// Forces and torques of the motors, each on the child body and, reversed, on the parent body:
    /// actuators of an active isolator.
    MotorTorques {
        /// Along the mount's x axis, N.
        f_x,
        /// Along the mount's y axis, N.
        f_y,
        /// Along the mount's z axis, N.
        f_z,
        /// About the axis of `alpha`, N m.
        u_x,
        /// About the axis of `beta`, N m.
        u_y,
        /// About the axis of `gamma`, N m.
        u_z
    }

    /// A value for each joint, by its child body: five without mass, and the platform.
    PerJoint {
        /// Of the slide along x.
        x_slide,
        /// Of the slide along y.
        y_slide,
        /// Of the slide along z.
        z_slide,
        /// Of the turn about x.
        x_turn,
        /// Of the turn about y.
        y_turn,
        /// Of the platform, which turns about z.
        platform
    }

    /// Second derivatives of the coordinates.
    JointAccelerations {
        /// `ẍ`, m/s².
        x_ddot,
        /// `ÿ`, m/s².
        y_ddot,
        /// `z̈`, m/s².
        z_ddot,
        /// `α̈`, rad/s².
        alpha_ddot,
        /// `β̈`, rad/s².
        beta_ddot,
        /// `γ̈`, rad/s².
        gamma_ddot
    }
}

/// Data of a [`Carrying`](crate::Carrying) set: of the carrier, and of the devices that it carries.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Data<P, C> {
    /// Of the carrier.
    pub carrier: P,
    /// Of the carried devices, in the shape of their set.
    pub carried: C,
}

impl<V: Value, P: Each<V>, C: Each<V>> Each<V> for Data<P, C> {
    fn values(&self) -> impl Iterator<Item = V> {
        self.carrier.values().chain(self.carried.values())
    }

    fn values_mut(&mut self) -> impl Iterator<Item = &mut V> {
        self.carrier.values_mut().chain(self.carried.values_mut())
    }
}

impl<T: Value, P: JointStates<T>, C: JointStates<T>> JointStates<T> for Data<P, C> {
    fn states(&self) -> impl Iterator<Item = [T; 2]> {
        self.carrier.states().chain(self.carried.states())
    }

    fn states_mut(&mut self) -> impl Iterator<Item = [&mut T; 2]> {
        self.carrier.states_mut().chain(self.carried.states_mut())
    }
}

/// All coordinates and rates zero.
pub(crate) fn at_rest<T: Scalar>() -> Joints<T> {
    let zero = crate::numbers::real::zero();
    Joints::of([zero; 6], [zero; 6])
}
