//! Motion of a carrier, a platform or a panel, relative to its base, and as the base of what it carries.
//!
//! Of a platform, with `R = Rx(alpha) Ry(beta) Rz(gamma)`, the platform's axes in the mount's by columns, and p
//! from B to P:
//!
//! ```text
//! (I1)  omega_P  = omega + omega_{P/B},   omega_{P/B} = sum of rates times turn axes
//! (I2)  r_P''    = r_B'' + omega' x p + sum of slide axes times accelerations
//!                  + omega x (omega x p) + 2 omega x p'
//! (I3)  omega_P' = omega' + sum of turn axes times accelerations + omega x omega_{P/B}
//!                  + alpha' beta' (a_x x a_y) + gamma' (alpha' a_x + beta' a_y) x a_z
//! ```
//!
//! The turn axes in platform axes are `a_x = (cos b cos g, -cos b sin g, sin b)`,
//! `a_y = (sin g, cos g, 0)` and `a_z = (0, 0, 1)`. A panel has only `gamma`. Over any number: lanes
//! do the same.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use crate::equations::joint_inputs::Environment;
use crate::isolation::records::Joints;
use crate::numbers::each::Value;
use crate::numbers::real::{Real, Scalar};
use crate::numbers::vec3::{Columns, Vec3, add, cross, map, rotate, rotate_transposed, scale};

/// A linear and an angular part: of a motion about P, or a force and a moment about P.
pub(crate) type Spatial<T> = [Vec3<T>; 2];

/// Coordinates of the slides, and sine and cosine of each turn.
#[derive(Clone, Copy, Debug)]
pub struct Pose<T> {
    pub(crate) slid: Vec3<T>,
    pub(crate) x: (T, T),
    pub(crate) y: (T, T),
    pub(crate) z: (T, T),
}

/// Turned about x by an angle of this sine and cosine.
#[inline(always)]
pub(crate) fn about_x<T: Real>((sin, cos): (T, T), [x, y, z]: Vec3<T>) -> Vec3<T> {
    [x, cos * y - sin * z, sin * y + cos * z]
}

/// Turned about y by an angle of this sine and cosine.
#[inline(always)]
pub(crate) fn about_y<T: Real>((sin, cos): (T, T), [x, y, z]: Vec3<T>) -> Vec3<T> {
    [cos * x + sin * z, y, cos * z - sin * x]
}

/// Turned about z by an angle of this sine and cosine.
#[inline(always)]
pub(crate) fn about_z<T: Real>((sin, cos): (T, T), [x, y, z]: Vec3<T>) -> Vec3<T> {
    [cos * x - sin * y, sin * x + cos * y, z]
}

/// A matrix with rows for columns: the inverse of a rotation.
#[inline(always)]
pub(crate) fn transposed<T: Copy>([x, y, z]: &Columns<T>) -> Columns<T> {
    [[x[0], y[0], z[0]], [x[1], y[1], z[1]], [x[2], y[2], z[2]]]
}

/// The unit matrix.
#[inline(always)]
pub(crate) fn identity<T: Real>(like: T) -> Columns<T> {
    let (one, zero) = (like.like(1.0), like.like(0.0));
    [[one, zero, zero], [zero, one, zero], [zero, zero, one]]
}

impl<T: Real> Pose<T> {
    /// The platform's axes in the mount's, by columns.
    #[inline(always)]
    pub(crate) fn turned(&self) -> Columns<T> {
        map(identity(self.x.0), |axis| about_x(self.x, about_y(self.y, about_z(self.z, axis))))
    }

    /// The axes of the three turns, expressed in the platform's.
    #[inline(always)]
    pub(crate) fn turn_axes(&self) -> Columns<T> {
        let ((sin_y, cos_y), (sin_z, cos_z)) = (self.y, self.z);
        let (one, zero) = (sin_y.like(1.0), sin_y.like(0.0));
        [[cos_y * cos_z, -(cos_y * sin_z), sin_y], [sin_z, cos_z, zero], [zero, zero, one]]
    }
}

/// The motion of a carrier on a base that turns, seen from the base.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Relative<T> {
    /// Its axes in those of the mount, by columns.
    pub(crate) turned: Columns<T>,
    /// How far its origin has slid, and how fast it slides, mount axes.
    pub(crate) slid: [Vec3<T>; 2],
    /// Relative angular velocity, its own axes.
    pub(crate) angular: Vec3<T>,
    /// How the turn axes turn: what (I3) has of the rates alone, its own axes.
    pub(crate) turning: Vec3<T>,
}

/// A carrier's motion on a base that turns.
#[derive(Clone, Copy, Debug)]
pub struct Motion<T> {
    /// The carrier's axes expressed in the base, by columns.
    pub(crate) axes: Columns<T>,
    /// p, from the origin of the base to P, base axes.
    pub(crate) p: Vec3<T>,
    /// p' seen from the base, base axes.
    pub(crate) p_prime: Vec3<T>,
    /// Angular velocity of the base, base axes.
    pub(crate) omega_base: Vec3<T>,
    /// Relative angular velocity, carrier axes.
    pub(crate) relative: Vec3<T>,
    /// (I1), carrier axes.
    pub(crate) omega: Vec3<T>,
    /// What (I2) and (I3) have without accelerations, carrier axes.
    pub(crate) bias: Spatial<T>,
}

/// A carrier's motion, and the directions of its N joints.
#[derive(Clone, Copy, Debug)]
pub struct Moving<T, const N: usize> {
    pub(crate) motion: Motion<T>,
    /// Of the joints' accelerations in (I2) and (I3), carrier axes.
    pub(crate) directions: [Spatial<T>; N],
}

impl<T, const N: usize> core::ops::Deref for Moving<T, N> {
    type Target = Motion<T>;

    #[inline(always)]
    fn deref(&self) -> &Motion<T> {
        &self.motion
    }
}

impl<T: Real + Value> Motion<T> {
    /// Of a carrier whose mount on the base is `mount`, at `origin` in it, both expressed
    /// in the base, which turns at `omega_base`.
    #[inline(always)]
    pub(crate) fn of(
        (mount, origin): (&Columns<T>, Vec3<T>),
        seen: &Relative<T>,
        omega_base: Vec3<T>,
    ) -> Self {
        let axes = map(seen.turned, |axis| rotate(mount, axis));
        let [slid, sliding] = seen.slid;
        let p = add(origin, rotate(mount, slid));
        let p_prime = rotate(mount, sliding);
        let relative = seen.angular;
        let base = rotate_transposed(&axes, omega_base);
        let two = relative[0].like(2.0);
        // (I2) and (I3)
        let centrifugal = cross(omega_base, cross(omega_base, p));
        let linear = add(centrifugal, scale(two, cross(omega_base, p_prime)));
        let angular = add(cross(base, relative), seen.turning);
        let (bias, omega) = ([rotate_transposed(&axes, linear), angular], add(base, relative));
        Self { axes, p, p_prime, omega_base, relative, omega, bias }
    }

    /// Inertial velocity of P, carrier axes, from that of the origin of the base.
    #[inline(always)]
    pub(crate) fn velocity(&self, of_base: Vec3<T>) -> Vec3<T> {
        let velocity = add(of_base, add(cross(self.omega_base, self.p), self.p_prime));
        rotate_transposed(&self.axes, velocity)
    }
}

impl<T: Real + Value> Moving<T, 6> {
    /// Of a platform, as [`Motion::of`].
    #[inline(always)]
    pub(crate) fn of_platform(
        place: (&Columns<T>, Vec3<T>),
        pose: &Pose<T>,
        joints: &Joints<T>,
        omega_base: Vec3<T>,
    ) -> Self {
        let turned = pose.turned();
        let turns = pose.turn_axes();
        let [x, y, z, alpha, beta, gamma] = joints.rates();
        let [a_x, a_y, a_z] = turns;
        // alpha' a_x + beta' a_y
        let outer = add(scale(alpha, a_x), scale(beta, a_y));
        let angular = add(outer, scale(gamma, a_z));
        let turning = add(scale(alpha * beta, cross(a_x, a_y)), scale(gamma, cross(outer, a_z)));
        let seen = Relative { turned, slid: [pose.slid, [x, y, z]], angular, turning };
        let none = [turned[0][0].like(0.0); 3];
        let [x, y, z] = transposed(&turned);
        let directions = [[x, none], [y, none], [z, none], [none, a_x], [none, a_y], [none, a_z]];
        Self { motion: Motion::of(place, &seen, omega_base), directions }
    }
}

impl<T: Real + Value, const N: usize> Moving<T, N> {
    /// (I2) and (I3) for the accelerations of base and joints, carrier axes.
    #[inline(always)]
    pub(crate) fn acceleration(&self, base: Spatial<T>, joints: [T; N]) -> Spatial<T> {
        let [linear, angular] = base;
        let moved = add(linear, cross(angular, self.p));
        let [v, w] = self.bias;
        let mut sum = [
            add(rotate_transposed(&self.axes, moved), v),
            add(rotate_transposed(&self.axes, angular), w),
        ];
        for (direction, acceleration) in self.directions.into_iter().zip(joints) {
            sum = plus_scaled(sum, acceleration, direction);
        }
        sum
    }
}

impl<T: Scalar> Motion<T> {
    /// What the carried devices need of the carrier's motion and of gravity. The uniform part of a
    /// central field, `G p`, is not in it: (I5).
    pub(crate) fn environment(&self, base: &Environment<T>) -> Environment<T> {
        let central = base.central.as_ref().map(|central| central.turned(&self.axes));
        Environment { omega: self.omega, central, impulse: base.impulse, reduction: base.reduction }
    }

    /// (I5), the field `G p` of a central one that is uniform on the carrier: at P less that at B,
    /// carrier axes, m/s².
    pub(crate) fn field(&self, base: &Environment<T>) -> Vec3<T> {
        let at_p = base.central.as_ref().map(|central| central.gradient.times(self.p));
        at_p.map_or_else(crate::numbers::vec3::zeros, |at_p| rotate_transposed(&self.axes, at_p))
    }
}

/// `a . b` of both parts.
#[inline(always)]
pub(crate) fn product<T: Real>(a: &Spatial<T>, b: &Spatial<T>) -> T {
    crate::numbers::vec3::dot(a[0], b[0]) + crate::numbers::vec3::dot(a[1], b[1])
}

/// `a + s b`.
#[inline(always)]
pub(crate) fn plus_scaled<T: Real>(a: Spatial<T>, s: T, b: Spatial<T>) -> Spatial<T> {
    [add(a[0], scale(s, b[0])), add(a[1], scale(s, b[1]))]
}
