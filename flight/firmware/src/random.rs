//! Random numbers, rotations and solid bodies: the same on every machine, for ever.
//!
//! Nothing here is inlined: it is called hundreds of times, and what counts is elsewhere.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::Scalar;

/// A generator of random numbers (SplitMix64): only integers, so no target can differ.
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

    /// One of so many, from 0.
    pub const fn one_of(&mut self, many: u64) -> u64 {
        self.bits() % many
    }

    /// Uniform between two bounds.
    #[expect(clippy::cast_precision_loss, reason = "53 bits are exact")]
    pub const fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * ((self.bits() >> 11) as f64 / (1_u64 << 53) as f64)
    }

    /// Uniform between two bounds, as a `T`.
    pub fn number<T: Scalar>(&mut self, low: f64, high: f64) -> T {
        T::from_f64(self.within(low, high))
    }

    /// A vector with components between `-size` and `size`.
    #[inline(never)]
    pub fn vector<T: Scalar>(&mut self, size: f64) -> Vector3<T> {
        Vector3::from_fn(|_, _| self.number(-size, size))
    }

    /// A rotation, orthonormal to the rounding of `T`.
    #[inline(never)]
    pub fn rotation<T: Scalar>(&mut self) -> Matrix3<T> {
        turn(self.four().map(T::from_f64))
    }

    /// A quaternion's four numbers, of length one to the rounding of `T`.
    #[inline(never)]
    pub fn attitude<T: Scalar>(&mut self) -> [T; 4] {
        let [w, x, y, z] = self.four().map(T::from_f64);
        let share = (w * w + x * x + y * y + z * z).sqrt().recip();
        [w * share, x * share, y * share, z * share]
    }

    /// The inertia of a solid block of given mass with edges of 0.2 to 1 m, turned at random.
    #[inline(never)]
    pub fn block<T: Scalar>(&mut self, mass: f64) -> Matrix3<T> {
        let [x, y, z] = [(); 3].map(|()| self.within(0.2, 1.0)).map(|edge| edge * edge);
        let moments = Vector3::new(y + z, z + x, x + y) * (mass / 12.0);
        turned(moments, self.four())
    }

    /// Moments about and across the axis of a solid disc of 0.1 to 0.3 m radius.
    pub fn disc(&mut self, mass: f64) -> [f64; 2] {
        let (radius, thickness) = (self.within(0.1, 0.3), self.within(0.02, 0.1));
        let axial = mass * radius * radius / 2.0;
        [axial, axial / 2.0 + mass * thickness * thickness / 12.0]
    }

    /// The inertia of such a disc, tilted from the x axis by up to a hundredth of a radian or so.
    #[inline(never)]
    pub fn tilted_disc<T: Scalar>(&mut self, mass: f64) -> Matrix3<T> {
        let [axial, across] = self.disc(mass);
        let tilt = [1.0, 0.0, self.within(-5e-3, 5e-3), self.within(-5e-3, 5e-3)];
        turned(Vector3::new(axial, across, across), tilt)
    }

    /// The quaternion of a rotation, not normalised and not zero.
    #[inline(never)]
    fn four(&mut self) -> [f64; 4] {
        let mut q = [(); 4].map(|()| self.within(-1.0, 1.0));
        q[0] += if q[0] < 0.0 { -0.25 } else { 0.25 };
        q
    }
}

/// The rotation of a quaternion of any length.
fn turn<T: Scalar>([w, x, y, z]: [T; 4]) -> Matrix3<T> {
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

/// Principal moments along turned axes: symmetric to the last bit, in `T` too.
#[inline(never)]
fn turned<T: Scalar>(moments: Vector3<f64>, rotation: [f64; 4]) -> Matrix3<T> {
    let axes: Matrix3<f64> = turn(rotation);
    let inertia = axes * Matrix3::from_diagonal(&moments) * axes.transpose();
    let symmetric = (inertia + inertia.transpose()) * 0.5;
    Matrix3::from_fn(|row, column| T::from_f64(symmetric[(row, column)]))
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
