//! [`Motion`] of the hub, [`Reference`] that it is to follow, and [`Tracking`], how far it is from that.

use nalgebra::Vector3;
use precess_dynamics::{Attitude as _, Mrp, Quaternion};

use crate::model::rotation::{inverse, product};

/// Attitude and rate of the hub, as measured, estimated or true.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// Attitude of B relative to N, of unit length.
    pub attitude: Quaternion,
    /// Angular velocity of B relative to N, expressed in B, rad/s.
    pub omega: Vector3<f64>,
}

/// Attitude, rate and its derivative of the frame R that the hub is to follow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reference {
    /// Attitude of R relative to N, of unit length.
    pub attitude: Quaternion,
    /// Angular velocity of R relative to N, expressed in R, rad/s.
    pub omega: Vector3<f64>,
    /// Its derivative, expressed in R, rad/s²: seen from R as from N the same.
    pub omega_dot: Vector3<f64>,
}

impl Reference {
    /// R at rest in N.
    #[must_use]
    pub fn at_rest(attitude: Quaternion) -> Self {
        Self { attitude, omega: Vector3::zeros(), omega_dot: Vector3::zeros() }
    }
}

/// The hub relative to its reference; everything expressed in B.
///
/// Schaub, Junkins, *Analytical Mechanics of Space Systems*, 8.4.1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tracking {
    /// Attitude of B relative to R. A quaternion and its negative are the same attitude: this one has `q0 >= 0`.
    pub attitude: Quaternion,
    /// Angular velocity of B relative to R, rad/s.
    pub omega_br: Vector3<f64>,
    /// Angular velocity of B relative to N, rad/s.
    pub omega_bn: Vector3<f64>,
    /// Angular velocity of R relative to N, rad/s.
    pub omega_rn: Vector3<f64>,
    /// Derivative of the angular velocity of R relative to N as seen from N, rad/s².
    pub omega_rn_dot: Vector3<f64>,
}

impl Tracking {
    /// Of a motion and its reference.
    #[must_use]
    pub fn new(motion: &Motion, reference: &Reference) -> Self {
        let turn = product(&inverse(&reference.attitude), &motion.attitude);
        let Quaternion { q0, q1, q2, q3 } = turn;
        let attitude =
            if q0 < 0.0 { Quaternion { q0: -q0, q1: -q1, q2: -q2, q3: -q3 } } else { turn };
        let br = attitude.dcm();
        let omega_rn = br * reference.omega;
        Self {
            attitude,
            omega_br: motion.omega - omega_rn,
            omega_bn: motion.omega,
            omega_rn,
            omega_rn_dot: br * reference.omega_dot,
        }
    }

    /// Modified Rodrigues parameters of B relative to R: the set that is not longer than one.
    #[must_use]
    pub fn sigma(&self) -> Vector3<f64> {
        Mrp::from(self.attitude).0
    }

    /// Derivative of [`omega_br`](Self::omega_br) as seen from B, for one of the angular velocity of B, rad/s²:
    /// `omega' - omega_rn' + omega x omega_rn`.
    #[must_use]
    pub fn omega_br_dot(&self, omega_bn_dot: &Vector3<f64>) -> Vector3<f64> {
        omega_bn_dot - self.feed_forward()
    }

    /// Angular acceleration of B, seen from B, with which it keeps its angular velocity relative to R, rad/s²:
    /// `omega_rn' - omega x omega_rn`.
    #[must_use]
    pub fn feed_forward(&self) -> Vector3<f64> {
        self.omega_rn_dot - self.omega_bn.cross(&self.omega_rn)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::rotation::from_vector;

    #[test]
    fn either_quaternion_of_an_attitude_gives_the_same_error() {
        let (turn, omega) =
            (from_vector(&Vector3::new(0.1, 2.9, -0.4)), Vector3::new(1.0, 2.0, 3.0));
        let minus = Quaternion { q0: -turn.q0, q1: -turn.q1, q2: -turn.q2, q3: -turn.q3 };
        let reference = Reference {
            attitude: from_vector(&Vector3::new(-0.7, 0.2, 0.6)),
            omega: Vector3::new(0.1, -0.2, 0.3),
            omega_dot: Vector3::new(0.4, 0.5, -0.6),
        };
        let of = |attitude| Tracking::new(&Motion { attitude, omega }, &reference);
        assert_eq!(of(turn), of(minus));
        assert!(of(turn).attitude.q0 >= 0.0 && of(turn).sigma().norm() <= 1.0);
    }

    /// Rate and feed-forward against central differences of the kinematics, with steps of 1e-5 s: their squares, a few
    /// times larger, beside rounding of 1e-16 / 1e-5.
    #[test]
    fn the_error_is_differentiated() {
        const H: f64 = 1e-5;
        const DIFFERENCES: f64 = 1e-9;
        let (omega, omega_dot) = (Vector3::new(0.4, -0.3, 0.8), Vector3::new(0.2, 0.7, -0.5));
        let (omega_r, omega_r_dot) = (Vector3::new(-0.6, 0.5, 0.2), Vector3::new(0.3, -0.2, 0.9));
        let at = |t: f64| {
            // Of second order in t: what is left has a factor t³, and vanishes from central differences but for t².
            let turned = |start: Vector3<f64>, rate: Vector3<f64>, dot: Vector3<f64>| {
                product(&from_vector(&start), &from_vector(&(rate * t + dot * (t * t / 2.0))))
            };
            let motion = Motion {
                attitude: turned(Vector3::new(0.3, 0.1, -0.9), omega, omega_dot),
                omega: omega + omega_dot * t,
            };
            let reference = Reference {
                attitude: turned(Vector3::new(-0.2, 1.1, 0.4), omega_r, omega_r_dot),
                omega: omega_r + omega_r_dot * t,
                omega_dot: omega_r_dot,
            };
            Tracking::new(&motion, &reference)
        };
        let (before, now, after) = (at(-H), at(0.0), at(H));
        let rate = Mrp(now.sigma()).rate(&now.omega_br);
        assert!(((after.sigma() - before.sigma()) / (2.0 * H) - rate).amax() < DIFFERENCES);
        let difference = (after.omega_br - before.omega_br) / (2.0 * H);
        assert!((difference - now.omega_br_dot(&omega_dot)).amax() < DIFFERENCES);
    }
}
