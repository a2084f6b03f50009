//! The random numbers, rotations and solid bodies that spacecraft are drawn from.

use core::f64::consts::PI;

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::Scalar;

/// A generator of random numbers (SplitMix64): ten lines, the same everywhere, for ever.
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Random {
    /// Starts at a seed; neighbouring seeds give unrelated numbers.
    #[must_use]
    pub const fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// The next 64 bits.
    pub const fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// Uniform between two bounds.
    #[expect(clippy::cast_precision_loss, reason = "53 bits are exact")]
    pub const fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * ((self.bits() >> 11) as f64 / (1_u64 << 53) as f64)
    }

    /// Log-uniform between two positive bounds.
    pub fn log_within(&mut self, low: f64, high: f64) -> f64 {
        libm::exp(self.within(libm::log(low), libm::log(high)))
    }

    /// Either sign, log-uniform from a hundred-thousandth of `largest`.
    pub(super) fn signed(&mut self, largest: f64) -> f64 {
        let magnitude = self.log_within(1e-5 * largest, largest);
        if self.bits() & 1 == 0 { magnitude } else { -magnitude }
    }

    /// A vector of given length in a uniform direction.
    pub fn vector(&mut self, length: f64) -> Vector3<f64> {
        loop {
            let v = Vector3::from_fn(|_, _| self.within(-1.0, 1.0));
            if (0.01..=1.0).contains(&v.norm_squared()) {
                return v * (length / v.norm());
            }
        }
    }

    /// The quaternion of a uniform rotation; not normalised.
    pub(super) fn rotation(&mut self) -> [f64; 4] {
        loop {
            let q = core::array::from_fn(|_| self.within(-1.0, 1.0));
            let squares: f64 = q.iter().map(|x| x * x).sum();
            if (0.01..=1.0).contains(&squares) {
                return q;
            }
        }
    }

    /// The inertia of a solid block of given mass, turned at random.
    pub(super) fn block(&mut self, mass: f64) -> Matrix3<f64> {
        let edges = Vector3::from_fn(|_, _| self.log_within(0.05, 3.0));
        let squares = edges.component_mul(&edges);
        let moments = Vector3::from_element(squares.sum()) - squares;
        turned(moments * (mass / 12.0), self.rotation())
    }

    /// The inertia of a solid disc about nearly the x axis, with its radius.
    pub(super) fn disc(&mut self, mass: f64) -> (Matrix3<f64>, f64) {
        let radius = self.log_within(0.02, 0.5);
        let thickness = radius * self.within(0.1, 1.0);
        let axial = mass * radius * radius / 2.0;
        let across = axial / 2.0 + mass * thickness * thickness / 12.0;
        let half_tilt = self.log_within(1e-6, 0.1) / 2.0;
        let direction = self.within(-PI, PI);
        let tilt = [1.0, 0.0, half_tilt * libm::cos(direction), half_tilt * libm::sin(direction)];
        (turned(Vector3::new(axial, across, across), tilt), radius)
    }
}

/// The rotation of a quaternion of any length, computed in this scalar: orthonormal to its
/// rounding.
pub(super) fn rotation_matrix<T: Scalar>(q: [f64; 4]) -> Matrix3<T> {
    let [w, x, y, z] = q.map(T::from_f64);
    let (one, two) = (T::from_f64(1.0), T::from_f64(2.0));
    let s = two * (w * w + x * x + y * y + z * z).recip();
    Matrix3::new(
        one - s * (y * y + z * z),
        s * (x * y - w * z),
        s * (x * z + w * y),
        s * (x * y + w * z),
        one - s * (x * x + z * z),
        s * (y * z - w * x),
        s * (x * z - w * y),
        s * (y * z + w * x),
        one - s * (x * x + y * y),
    )
}

/// Principal moments along turned axes: a matrix symmetric to the last bit.
fn turned(moments: Vector3<f64>, rotation: [f64; 4]) -> Matrix3<f64> {
    let axes: Matrix3<f64> = rotation_matrix(rotation);
    let inertia = axes * Matrix3::from_diagonal(&moments) * axes.transpose();
    (inertia + inertia.transpose()) * 0.5
}

#[cfg(test)]
mod tests {
    use super::Random;

    /// The first number of the published generator from seed 0.
    #[test]
    fn generator_is_split_mix_64() {
        assert_eq!(Random::new(0).bits(), 0xE220_A839_7B1D_CDAF);
    }
}
