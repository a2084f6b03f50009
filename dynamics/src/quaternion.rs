//! Euler parameters (a quaternion, scalar first) of B with respect to N.

use nalgebra::{Matrix3, Vector3, Vector4};

use crate::attitude::Attitude;
use crate::mrp::Mrp;
use crate::real::{Scalar, half, one, two, zero};
use crate::vec3::{components, dot, scale};

/// Euler parameters `beta_{B/N}`: `cos(phi / 2)` and `sin(phi / 2)` along the axis of the rotation
/// from N to B. A quaternion and its negative are the same attitude.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quaternion<T = f64> {
    /// Scalar part, `cos(phi / 2)`.
    pub q0: T,
    /// First vector component.
    pub q1: T,
    /// Second vector component.
    pub q2: T,
    /// Third vector component.
    pub q3: T,
}

impl<T: Scalar> Quaternion<T> {
    /// Length; 1 for an attitude that has not drifted.
    #[must_use]
    pub fn norm(&self) -> T {
        self.norm_squared().sqrt()
    }

    fn norm_squared(&self) -> T {
        self.q0 * self.q0 + self.q1 * self.q1 + self.q2 * self.q2 + self.q3 * self.q3
    }
}

impl<T: Scalar> Attitude<T> for Quaternion<T> {
    type Rate = Vector4<T>;

    fn identity() -> Self {
        Self { q0: one(), q1: zero(), q2: zero(), q3: zero() }
    }

    /// `[BN]` of the quaternion divided by its length: a rotation for any length but zero, also
    /// between the stages of an integrator.
    fn dcm(&self) -> Matrix3<T> {
        let Self { q0, q1, q2, q3 } = *self;
        let scale = two::<T>() * self.norm_squared().recip();
        let (s1, s2, s3) = (scale * q1, scale * q2, scale * q3);
        let (d1, d2, d3) = (s1 * q1, s2 * q2, s3 * q3);
        let (w1, w2, w3) = (s1 * q0, s2 * q0, s3 * q0);
        let (p12, p13, p23) = (s1 * q2, s1 * q3, s2 * q3);
        Matrix3::new(
            one::<T>() - (d2 + d3),
            p12 + w3,
            p13 - w2,
            p12 - w3,
            one::<T>() - (d1 + d3),
            p23 + w1,
            p13 + w2,
            p23 - w1,
            one::<T>() - (d1 + d2),
        )
    }

    /// `beta' = (-q . omega, q0 omega + q x omega) / 2`, in the order of the fields.
    fn rate(&self, omega: &Vector3<T>) -> Vector4<T> {
        let Self { q0, q1, q2, q3 } = *self;
        let omega = components(omega);
        let [x, y, z] = scale(half(), omega);
        Vector4::new(
            -dot([q1, q2, q3], [x, y, z]),
            q0 * x - q3 * y + q2 * z,
            q3 * x + q0 * y - q1 * z,
            q1 * y - q2 * x + q0 * z,
        )
    }

    fn advanced(&self, terms: &[(T, Vector4<T>)]) -> Self {
        let mut sum = [zero::<T>(); 4];
        for (h, k) in terms {
            let [k] = k.data.0;
            sum = [sum[0] + *h * k[0], sum[1] + *h * k[1], sum[2] + *h * k[2], sum[3] + *h * k[3]];
        }
        Self {
            q0: self.q0 + sum[0],
            q1: self.q1 + sum[1],
            q2: self.q2 + sum[2],
            q3: self.q3 + sum[3],
        }
    }

    /// The quaternion of unit length. A quaternion of length zero becomes NaN.
    fn normalised(&self) -> Self {
        let scale = self.norm().recip();
        Self { q0: scale * self.q0, q1: scale * self.q1, q2: scale * self.q2, q3: scale * self.q3 }
    }

    fn is_valid(&self) -> bool {
        let n2 = self.norm_squared();
        n2.is_finite() && n2.recip().is_finite()
    }
}

/// The quaternion with `q0 >= 0` for the inner set, `q0 < 0` for the outer one.
impl<T: Scalar> From<Mrp<T>> for Quaternion<T> {
    fn from(sigma: Mrp<T>) -> Self {
        let sigma = components(&sigma.0);
        let s2 = dot(sigma, sigma);
        let scaled = (one::<T>() + s2).recip();
        let [q1, q2, q3] = scale(two::<T>() * scaled, sigma);
        Self { q0: (one::<T>() - s2) * scaled, q1, q2, q3 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::attitude_checks as checks;

    const BETA: Quaternion = Quaternion { q0: 0.5, q1: -0.7, q2: 0.1, q3: 0.5 };

    #[test]
    fn dcm_is_a_rotation_of_any_length() {
        checks::assert_rotation(BETA.dcm());
        checks::assert_rotation(Quaternion { q0: 2.0, q1: 3.0, q2: -1.0, q3: 0.1 }.dcm());
        assert_eq!(Quaternion::<f64>::identity().dcm(), Matrix3::identity());
    }

    #[test]
    fn dcm_equals_the_one_of_the_mrp() {
        for sigma in [
            Mrp::from_components(0.1, -0.35, 0.6),
            Mrp::from_components(-0.9, 0.2, 1.4),
            Mrp::from_components(0.0, 0.0, 1.0),
        ] {
            let difference = Quaternion::from(sigma).dcm() - sigma.dcm();
            assert!(difference.amax() <= checks::ROUNDING);
        }
    }

    #[test]
    fn negative_quaternion_is_the_same_attitude_and_the_same_mrp() {
        let beta = BETA.normalised();
        let minus = Quaternion { q0: -beta.q0, q1: -beta.q1, q2: -beta.q2, q3: -beta.q3 };
        assert_eq!(beta.dcm(), minus.dcm());
        assert_eq!(Mrp::from(beta), Mrp::from(minus));
    }

    #[test]
    fn rate_moves_the_dcm() {
        checks::assert_rate_moves_the_dcm(BETA.normalised());
    }

    #[test]
    fn rate_keeps_the_length() {
        let rate = BETA.rate(&Vector3::new(0.3, 0.2, -0.7));
        let change = BETA.q0 * rate.x + BETA.q1 * rate.y + BETA.q2 * rate.z + BETA.q3 * rate.w;
        assert!(change.abs() <= checks::ROUNDING);
    }

    #[test]
    fn normalised_has_unit_length() {
        assert!((BETA.normalised().norm() - 1.0).abs() <= checks::ROUNDING);
        let wide = Quaternion { q0: 0.5_f32, q1: -0.7, q2: 0.1, q3: 0.5 }.normalised();
        assert!((wide.norm() - 1.0).abs() <= 4.0 * f32::EPSILON);
    }

    #[test]
    fn validity_asks_for_a_finite_length_above_zero() {
        assert!(Quaternion::<f64>::identity().is_valid());
        assert!(!Quaternion { q0: f64::INFINITY, ..BETA }.is_valid());
        assert!(!Quaternion { q0: 0.0, q1: 0.0, q2: 0.0, q3: 0.0 }.is_valid());
    }
}
