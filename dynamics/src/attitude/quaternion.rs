//! Euler parameters (a quaternion, scalar first) of B with respect to N.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use nalgebra::{Matrix3, Vector3, Vector4};

use crate::attitude::mrp::Mrp;
use crate::attitude::parameterisation::Attitude;
use crate::numbers::real::{Real, Scalar, one, reciprocal_in_two, two, zero};
use crate::numbers::vec3::{Columns, Vec3, components, dot, extreme, largest, scale, vector};

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
        let (scaled, size) = self.scaled();
        size * scaled.norm_squared().sqrt()
    }

    /// The quaternion by a size that its squares can bear, and that size: quaternions of about unit
    /// length stay as they are, bit for bit, others are divided by their largest component. NaN
    /// where the length is zero or not finite.
    pub(crate) fn scaled(&self) -> (Self, T) {
        let Self { q0, q1, q2, q3 } = *self;
        let size = largest([q1, q2, q3]).max(q0.abs());
        // A square of either limit, and a sum of four, is far from overflow and underflow.
        if size >= T::EPSILON && size <= T::EPSILON.recip() {
            return (*self, one());
        }
        let (first, second) = reciprocal_in_two(size);
        let by_size = |q: T| q * first * second;
        (Self { q0: by_size(q0), q1: by_size(q1), q2: by_size(q2), q3: by_size(q3) }, size)
    }

    fn norm_squared(&self) -> T {
        norm_squared([self.q0, self.q1, self.q2, self.q3])
    }
}

/// The square of a quaternion's length.
#[inline(always)]
pub(crate) fn norm_squared<T: Real>([q0, q1, q2, q3]: [T; 4]) -> T {
    q0 * q0 + q1 * q1 + q2 * q2 + q3 * q3
}

/// The columns of `[BN]` of a quaternion of about unit length, divided by its length.
#[inline(always)]
pub(crate) fn bn<T: Real>([q0, q1, q2, q3]: [T; 4]) -> Columns<T> {
    let one = q0.like(1.0);
    let scale = q0.like(2.0) * norm_squared([q0, q1, q2, q3]).recip();
    let (s1, s2, s3) = (scale * q1, scale * q2, scale * q3);
    let (d1, d2, d3) = (s1 * q1, s2 * q2, s3 * q3);
    let (w1, w2, w3) = (s1 * q0, s2 * q0, s3 * q0);
    let (p12, p13, p23) = (s1 * q2, s1 * q3, s2 * q3);
    [
        [one - (d2 + d3), p12 - w3, p13 + w2],
        [p12 + w3, one - (d1 + d3), p23 - w1],
        [p13 - w2, p23 + w1, one - (d1 + d2)],
    ]
}

/// `beta' = (-q . omega, q0 omega + q x omega) / 2`.
#[inline(always)]
pub(crate) fn rate<T: Real>([q0, q1, q2, q3]: [T; 4], omega: Vec3<T>) -> [T; 4] {
    let [x, y, z] = scale(q0.like(0.5), omega);
    [
        -dot([q1, q2, q3], [x, y, z]),
        q0 * x - q3 * y + q2 * z,
        q3 * x + q0 * y - q1 * z,
        q1 * y - q2 * x + q0 * z,
    ]
}

impl<T: Scalar> Attitude<T> for Quaternion<T> {
    type Rate = Vector4<T>;

    fn identity() -> Self {
        Self { q0: one(), q1: zero(), q2: zero(), q3: zero() }
    }

    /// `[BN]` of the quaternion divided by its length: a rotation for any finite length but zero,
    /// also between the stages of an integrator. NaN otherwise.
    fn dcm(&self) -> Matrix3<T> {
        let (Self { q0, q1, q2, q3 }, _) = self.scaled();
        let [x, y, z] = bn([q0, q1, q2, q3]);
        Matrix3::from_columns(&[vector(x), vector(y), vector(z)])
    }

    /// `beta' = (-q . omega, q0 omega + q x omega) / 2`, in the order of the fields.
    fn rate(&self, omega: &Vector3<T>) -> Vector4<T> {
        let Self { q0, q1, q2, q3 } = *self;
        Vector4::from(rate([q0, q1, q2, q3], components(omega)))
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

    /// The quaternion as it is, or divided by its largest component where that is below an epsilon
    /// or above its reciprocal.
    fn regular(&self) -> Self {
        self.scaled().0
    }

    /// The quaternion of unit length. One whose length is zero or not finite becomes NaN.
    fn normalised(&self) -> Self {
        let (scaled, _) = self.scaled();
        let scale = scaled.norm_squared().sqrt().recip();
        let Self { q0, q1, q2, q3 } = scaled;
        Self { q0: scale * q0, q1: scale * q1, q2: scale * q2, q3: scale * q3 }
    }

    fn is_valid(&self) -> bool {
        self.scaled().0.norm_squared().is_finite()
    }

    fn extreme(&self) -> T {
        extreme([self.q0, self.q1, self.q2, self.q3])
    }
}

/// The quaternion with `q0 >= 0` for the inner set, `q0 < 0` for the outer one.
///
/// Of unit length for any finite MRPs, zero (the identity) and the largest included; NaN in all
/// four components where one of the MRPs is infinite or NaN.
impl<T: Scalar> From<Mrp<T>> for Quaternion<T> {
    fn from(sigma: Mrp<T>) -> Self {
        let sigma = components(&sigma.0);
        // Numerator and denominator over a square, so that large parameters do not overflow.
        let size = largest(sigma);
        let unit = if size > T::EPSILON.recip() { size.recip() } else { one() };
        let sigma = scale(unit, sigma);
        let (u2, s2) = (unit * unit, dot(sigma, sigma));
        let scaled = (u2 + s2).recip();
        let [q1, q2, q3] = scale(two::<T>() * unit * scaled, sigma);
        Self { q0: (u2 - s2) * scaled, q1, q2, q3 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::attitude::attitude_tests as checks;

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

    /// `beta` times `size`, component by component.
    fn sized(size: f64, beta: Quaternion) -> Quaternion {
        let Quaternion { q0, q1, q2, q3 } = beta;
        Quaternion { q0: size * q0, q1: size * q1, q2: size * q2, q3: size * q3 }
    }

    #[test]
    fn attitude_does_not_depend_on_the_length() {
        // Powers of two, so that nothing is rounded but what the length itself brings.
        for size in [2.0_f64.powi(1020), 2.0_f64.powi(100), 2.0_f64.powi(-60), 2.0_f64.powi(-960)] {
            let beta = sized(size, BETA);
            assert!(beta.is_valid());
            assert!((beta.norm() / size - 1.0).abs() <= checks::ROUNDING, "{size:e}");
            assert!((beta.dcm() - BETA.dcm()).amax() <= checks::ROUNDING, "{size:e}");
            let (unit, expected) = (beta.normalised(), BETA.normalised());
            assert!((unit.dcm() - expected.dcm()).amax() <= checks::ROUNDING, "{size:e}");
            assert!((unit.norm() - 1.0).abs() <= checks::ROUNDING, "{size:e}");
            assert!((Mrp::from(beta).0 - Mrp::from(BETA).0).amax() <= checks::ROUNDING, "{size:e}");
        }
        // Subnormal, where the components themselves are exact.
        for size in [1e200, 1e-200, f64::from_bits(1)] {
            let half_turn = Quaternion { q0: 0.0, q1: size, q2: 0.0, q3: 0.0 };
            assert_eq!(Mrp::from(half_turn), Mrp::from_components(1.0, 0.0, 0.0));
            assert_eq!(half_turn.normalised(), Quaternion { q1: 1.0, ..half_turn });
            assert_eq!(half_turn.dcm(), Matrix3::from_diagonal(&[1.0, -1.0, -1.0].into()));
        }
    }

    #[test]
    fn quaternion_without_a_length_becomes_nan_everywhere() {
        let zero = Quaternion { q0: 0.0, q1: 0.0, q2: 0.0, q3: 0.0 };
        for bad in [
            zero,
            Quaternion { q0: f64::NAN, ..BETA },
            Quaternion { q3: f64::NAN, ..BETA },
            Quaternion { q0: f64::INFINITY, ..zero },
            Quaternion { q2: f64::NEG_INFINITY, ..BETA },
            Quaternion { q1: 1e200, q2: f64::NAN, ..zero },
        ] {
            let Quaternion { q0, q1, q2, q3 } = bad.normalised();
            assert!([q0, q1, q2, q3].iter().any(|q| q.is_nan()), "{bad:?}");
            assert!(bad.dcm().iter().any(|x| x.is_nan()), "{bad:?}");
            assert!(Mrp::from(bad).0.iter().any(|x| x.is_nan()), "{bad:?}");
            assert!(!bad.is_valid() && !bad.norm().is_normal(), "{bad:?}");
        }
    }

    #[test]
    fn conversion_of_any_finite_mrps_has_unit_length() {
        for size in [1e20, 1e154, 1e200, 1.7e308] {
            let beta = Quaternion::from(Mrp::from_components(size, 0.0, -size));
            assert!((beta.norm() - 1.0).abs() <= checks::ROUNDING, "{size:e}");
            // A whole turn, but for 4 / |sigma|.
            assert_eq!(beta.q0, -1.0);
            let along = [beta.q1, -beta.q3].map(|q| q * size);
            assert!(along.iter().all(|q| (q - 1.0).abs() <= checks::ROUNDING), "{size:e}");
        }
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            for sigma in [
                Mrp::from_components(0.1, bad, 0.2),
                Mrp::from_components(1e200, 0.0, bad),
                Mrp::from_components(bad, 0.0, 0.0),
            ] {
                let Quaternion { q0, q1, q2, q3 } = Quaternion::from(sigma);
                assert!([q0, q1, q2, q3].iter().all(|q| q.is_nan()), "{sigma:?}");
            }
        }
    }

    #[test]
    fn validity_asks_for_a_finite_length_above_zero() {
        assert!(Quaternion::<f64>::identity().is_valid());
        assert!(!Quaternion { q0: f64::INFINITY, ..BETA }.is_valid());
        assert!(!Quaternion { q0: 0.0, q1: 0.0, q2: 0.0, q3: 0.0 }.is_valid());
    }
}
