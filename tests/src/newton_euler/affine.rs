//! Vectors that depend linearly on the accelerations still to be found.
//!
//! One body's motion involves nine of them: the hub's six and the three of the device it belongs
//! to. Every step of the derivation is linear, so it is applied to each coefficient alike.

use core::ops::{Add, Mul, Sub};

use precess_dynamics::Scalar;

use super::vector::{Vector, dot};

/// First of the three components of the inertial acceleration of B along B axes.
pub const R_B_N_DDOT: usize = 0;
/// First of the three components of `omega_dot` along B axes.
pub const OMEGA_DOT: usize = 3;
/// The second derivative of the outer gimbal's angle.
pub const GAMMA_O_DDOT: usize = 6;
/// The second derivative of the inner gimbal's angle.
pub const GAMMA_I_DDOT: usize = 7;
/// The derivative of the wheel's relative speed.
pub const SPIN_DOT: usize = 8;
/// How many accelerations there are for one body.
pub const UNKNOWNS: usize = 9;

/// `sum_i coefficients[i] * unknown_i + rest`, a vector.
#[derive(Clone, Copy, Debug)]
pub struct Affine<T> {
    /// What multiplies each unknown.
    pub coefficients: [Vector<T>; UNKNOWNS],
    /// What is known.
    pub rest: Vector<T>,
}

impl<T: Scalar> Affine<T> {
    /// A known vector.
    #[must_use]
    pub fn known(rest: Vector<T>) -> Self {
        Self { coefficients: [Vector::zero(); UNKNOWNS], rest }
    }

    /// `direction * unknown`.
    #[must_use]
    pub fn unknown(index: usize, direction: Vector<T>) -> Self {
        let mut affine = Self::known(Vector::zero());
        affine.coefficients[index] = direction;
        affine
    }

    /// The vector whose three components are the unknowns `first`, `first + 1`, `first + 2`.
    #[must_use]
    pub fn unknown_vector(first: usize) -> Self {
        let mut affine = Self::known(Vector::zero());
        for axis in 0..3 {
            affine.coefficients[first + axis] = Vector::unit(axis);
        }
        affine
    }

    /// A linear operation on vectors, applied to all parts.
    #[must_use]
    pub fn map(self, operation: impl Fn(Vector<T>) -> Vector<T>) -> Self {
        Self { coefficients: self.coefficients.map(&operation), rest: operation(self.rest) }
    }

    /// The component along `direction`: nine coefficients and the known part.
    #[must_use]
    pub fn along(self, direction: Vector<T>) -> ([T; UNKNOWNS], T) {
        (self.coefficients.map(|c| dot(c, direction)), dot(self.rest, direction))
    }

    /// The vector itself, once the nine unknowns are known.
    #[must_use]
    pub fn value(self, unknowns: &[T; UNKNOWNS]) -> Vector<T> {
        let terms = self.coefficients.iter().zip(unknowns);
        terms.fold(self.rest, |sum, (coefficient, unknown)| sum + *coefficient * *unknown)
    }
}

impl<T: Scalar> Add for Affine<T> {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let coefficients = core::array::from_fn(|i| self.coefficients[i] + other.coefficients[i]);
        Self { coefficients, rest: self.rest + other.rest }
    }
}

impl<T: Scalar> Sub for Affine<T> {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + other * -T::from_f64(1.0)
    }
}

impl<T: Scalar> Mul<T> for Affine<T> {
    type Output = Self;

    fn mul(self, factor: T) -> Self {
        self.map(|v| v * factor)
    }
}
