//! Modified Rodrigues parameters `sigma_{B/N}`, with the shadow set beyond a half turn.

use nalgebra::{Matrix3, Vector3};

use crate::attitude::parameterisation::Attitude;
use crate::attitude::quaternion::Quaternion;
use crate::numbers::real::{Scalar, one, two, zero};
use crate::numbers::vec3::{add, components, cross, dot, extreme, neg, scale, vector, zeros};

/// Modified Rodrigues parameters: `tan(phi / 4)` along the axis of the rotation from N to B.
///
/// ```
/// use precess_dynamics::{Attitude, Mrp, Quaternion};
///
/// let sigma = Mrp::from_components(0.0, 0.0, 0.25_f64);
/// let beta = Quaternion::from(sigma);
/// assert!((sigma.dcm() - beta.dcm()).norm() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mrp<T = f64>(pub Vector3<T>);

impl<T> Mrp<T> {
    /// The parameters from their three components (the same along B and N axes).
    #[must_use]
    pub const fn from_components(sigma_1: T, sigma_2: T, sigma_3: T) -> Self {
        Self(Vector3::new(sigma_1, sigma_2, sigma_3))
    }
}

impl<T: Scalar> Mrp<T> {
    /// The other set for the same attitude: `-sigma / |sigma|^2`. Not finite for the identity and
    /// for parameters whose square is too small to have a reciprocal.
    #[must_use]
    pub fn shadow(&self) -> Self {
        let sigma = components(&self.0);
        Self(vector(scale(-dot(sigma, sigma).recip(), sigma)))
    }
}

impl<T: Scalar> Attitude<T> for Mrp<T> {
    type Rate = Vector3<T>;

    fn identity() -> Self {
        Self(vector(zeros()))
    }

    /// `[BN] = I + (8 S S - 4 (1 - s2) S) / (1 + s2)^2` with `S = tilde(sigma)`, `s2 = |sigma|^2`.
    fn dcm(&self) -> Matrix3<T> {
        let [x, y, z] = components(&self.0);
        let (xx, yy, zz) = (x * x, y * y, z * z);
        let s2 = xx + yy + zz;
        let scale = (one::<T>() + s2).recip();
        let scale = scale * scale;
        // S S = sigma sigma^T - s2 I.
        let a = T::from_f64(8.0) * scale;
        let b = T::from_f64(4.0) * (one::<T>() - s2) * scale;
        let (xy, xz, yz) = (a * (x * y), a * (x * z), a * (y * z));
        let (bx, by, bz) = (b * x, b * y, b * z);
        Matrix3::new(
            one::<T>() - a * (yy + zz),
            xy + bz,
            xz - by,
            xy - bz,
            one::<T>() - a * (xx + zz),
            yz + bx,
            xz + by,
            yz - bx,
            one::<T>() - a * (xx + yy),
        )
    }

    /// `sigma' = ((1 - s2) omega + 2 sigma x omega + 2 (sigma . omega) sigma) / 4`.
    fn rate(&self, omega: &Vector3<T>) -> Vector3<T> {
        let (sigma, omega) = (components(&self.0), components(omega));
        let along = scale(one::<T>() - dot(sigma, sigma), omega);
        let twice = add(cross(sigma, omega), scale(dot(sigma, omega), sigma));
        vector(scale(T::from_f64(0.25), add(along, scale(two(), twice))))
    }

    fn advanced(&self, terms: &[(T, Vector3<T>)]) -> Self {
        let sum = terms.iter().fold(zeros(), |sum, (h, k)| add(sum, scale(*h, components(k))));
        Self(vector(add(components(&self.0), sum)))
    }

    /// The inner of the two sets: the rate of the outer one grows with the square of its length.
    fn regular(&self) -> Self {
        self.normalised()
    }

    /// The inner of the two sets: switches to the shadow set where `|sigma| > 1`.
    fn normalised(&self) -> Self {
        let sigma = components(&self.0);
        if dot(sigma, sigma) > one() { self.shadow() } else { *self }
    }

    /// Finite, and not so large that the products in [`Attitude::dcm`] overflow.
    fn is_valid(&self) -> bool {
        let sigma = components(&self.0);
        (T::from_f64(4.0) * dot(sigma, sigma)).is_finite()
    }

    fn extreme(&self) -> T {
        extreme(components(&self.0))
    }
}

/// The inner set, for any sign and length of the quaternion.
///
/// NaN in all three components for a quaternion of length zero and for one with a component that is
/// infinite or NaN: neither is an attitude.
impl<T: Scalar> From<Quaternion<T>> for Mrp<T> {
    fn from(beta: Quaternion<T>) -> Self {
        let (beta, _) = beta.scaled();
        // tan(phi/4) = sin(phi/2) / (1 + cos(phi/2)), with the scalar part made positive.
        let scaled = scale((beta.norm() + beta.q0.abs()).recip(), [beta.q1, beta.q2, beta.q3]);
        Self(vector(if beta.q0 < zero() { neg(scaled) } else { scaled }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::attitude::attitude_tests as checks;

    #[test]
    fn dcm_is_the_formula_of_the_conventions() {
        let sigma: Mrp = Mrp::from_components(0.1, -0.35, 0.6);
        let s = sigma.0.cross_matrix();
        let s2 = sigma.0.norm_squared();
        let formula = Matrix3::identity()
            + (s * s * 8.0 - s * (4.0 * (1.0 - s2))) / ((1.0 + s2) * (1.0 + s2));
        assert!((sigma.dcm() - formula).amax() <= checks::ROUNDING);
    }

    #[test]
    fn dcm_is_a_rotation() {
        checks::assert_rotation(Mrp::from_components(0.1, -0.35, 0.6).dcm());
        checks::assert_rotation(Mrp::from_components(3.0, -2.0, 0.5).dcm());
        assert_eq!(Mrp::<f64>::identity().dcm(), Matrix3::identity());
    }

    #[test]
    fn positive_rotation_about_z_takes_n_components_to_b() {
        // phi = 90 deg about z: n_x is seen along -b_y.
        let sigma: Mrp = Mrp::from_components(0.0, 0.0, (core::f64::consts::PI / 8.0).tan());
        let seen = sigma.dcm() * Vector3::x();
        assert!((seen + Vector3::y()).amax() <= checks::ROUNDING);
    }

    #[test]
    fn shadow_set_is_the_same_attitude_and_moves_alike() {
        let sigma: Mrp = Mrp::from_components(0.7, -0.9, 0.4);
        assert!((sigma.dcm() - sigma.shadow().dcm()).amax() <= checks::ROUNDING);
        checks::assert_rate_moves_the_dcm(sigma);
        checks::assert_rate_moves_the_dcm(sigma.shadow());
    }

    #[test]
    fn switch_happens_beyond_a_half_turn_only() {
        let outer: Mrp = Mrp::from_components(0.0, 1.25, 0.0);
        assert_eq!(outer.normalised(), Mrp::from_components(0.0, -0.8, 0.0));
        let edge: Mrp = Mrp::from_components(0.0, 1.0, 0.0);
        assert_eq!(edge.normalised(), edge);
        let inner: Mrp = Mrp::from_components(0.5, 0.5, 0.0);
        assert_eq!(inner.normalised(), inner);
    }

    #[test]
    fn conversion_gives_the_inner_set_and_comes_back() {
        for sigma in [
            Mrp::from_components(0.1, -0.35, 0.6),
            Mrp::from_components(0.0, 1.0, 0.0),
            Mrp::from_components(1e-9, 0.0, 0.0),
            Mrp::identity(),
        ] {
            let back = Mrp::from(Quaternion::from(sigma));
            assert!((back.0 - sigma.0).amax() <= checks::ROUNDING);
        }
        let outer: Mrp = Mrp::from_components(0.7, -0.9, 0.4);
        let back = Mrp::from(Quaternion::from(outer));
        assert!((back.0 - outer.shadow().0).amax() <= checks::ROUNDING);
    }

    #[test]
    fn rate_is_the_derivative_of_the_conversion() {
        // sigma = q / (1 + q0), so sigma' = (q' - sigma q0') / (1 + q0).
        let sigma: Mrp = Mrp::from_components(0.3, -0.2, 0.5);
        let omega = Vector3::new(0.4, -1.3, 0.8);
        let beta = Quaternion::from(sigma);
        let beta_dot = beta.rate(&omega);
        let q_dot = Vector3::new(beta_dot.y, beta_dot.z, beta_dot.w);
        let expected = (q_dot - sigma.0 * beta_dot.x) / (1.0 + beta.q0);
        assert!((sigma.rate(&omega) - expected).amax() <= checks::ROUNDING);
    }

    #[test]
    fn validity_asks_for_finite_numbers() {
        assert!(Mrp::<f64>::identity().is_valid());
        assert!(!Mrp::from_components(0.0, f64::NAN, 0.0).is_valid());
        assert!(!Mrp::from_components(0.0, 0.0, f64::NEG_INFINITY).is_valid());
    }

    #[test]
    fn valid_parameters_are_those_with_a_finite_dcm() {
        let mut rejected = 0;
        for x in [1.0, 1e16, 1e100, 5e153, 6.703e153, 6.705e153, 1e154, 1.3e154, 1.4e154, 1e200] {
            let sigma: Mrp = Mrp::from_components(0.0, -x, 0.0);
            let finite = sigma.dcm().iter().all(|element| element.is_finite());
            assert_eq!(sigma.is_valid(), finite, "{x:e}");
            rejected += u32::from(!finite);
        }
        assert_eq!(rejected, 5);
    }
}
