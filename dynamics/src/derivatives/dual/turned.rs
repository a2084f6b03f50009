//! [`Turned`]: an attitude by its direction cosines, which small rotations are seeded in.
//!
//! Whatever the parameters of the state's attitude, its derivatives are by a rotation vector.

use nalgebra::{Matrix3, Vector3};

use crate::attitude::parameterisation::Attitude;
use crate::derivatives::variable::Axis;
use crate::numbers::dual::Dual;
use crate::numbers::real::{Scalar, one, zero};
use crate::numbers::vec3::{Columns, columns, cross, extreme, vector};

/// `[BN]` by its columns. Only read: it has no rate, and is not advanced.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Turned<T>(Columns<T>);

impl<T: Scalar, const N: usize> Turned<Dual<T, N>> {
    /// The attitude of a state, constant.
    pub(crate) fn of(attitude: &impl Attitude<T>) -> Self {
        Self(columns(&attitude.dcm().map(Dual::constant)))
    }

    /// Makes a variable, of which it is a multiple, of a small rotation about an axis of B: `d[BN] = -tilde(e) [BN]`.
    pub(crate) fn seed(&mut self, about: Axis, number: usize, multiple: T) {
        let unit = Axis::ALL.map(|axis| if axis == about { multiple } else { zero() });
        for column in &mut self.0 {
            let turned = cross(column.map(|element| element.value), unit);
            for (element, derivative) in column.iter_mut().zip(turned) {
                element.add_derivative(number, derivative);
            }
        }
    }
}

impl<T: Scalar> Attitude<T> for Turned<T> {
    type Rate = ();

    fn identity() -> Self {
        let (i, o) = (one(), zero());
        Self([[i, o, o], [o, i, o], [o, o, i]])
    }

    fn dcm(&self) -> Matrix3<T> {
        let [x, y, z] = self.0;
        Matrix3::from_columns(&[vector(x), vector(y), vector(z)])
    }

    fn rate(&self, _: &Vector3<T>) {}

    fn advanced(&self, _: &[(T, ())]) -> Self {
        *self
    }

    fn regular(&self) -> Self {
        *self
    }

    fn normalised(&self) -> Self {
        *self
    }

    fn is_valid(&self) -> bool {
        self.0.as_flattened().iter().all(|element| element.is_finite())
    }

    fn extreme(&self) -> T {
        extreme(self.0.map(extreme))
    }
}
