//! Plain vectors and tensors of three components along B axes, over any scalar.

use core::ops::{Add, Mul, Neg, Sub};

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::Scalar;

/// Three components along one set of axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vector<T>(pub [T; 3]);

/// Three rows of three components; as a rotation, its columns are the new axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tensor<T>(pub [[T; 3]; 3]);

impl<T: Scalar> Vector<T> {
    /// The zero vector.
    #[must_use]
    pub fn zero() -> Self {
        Self([T::from_f64(0.0); 3])
    }

    /// The unit vector of one axis, 0 to 2.
    #[must_use]
    pub fn unit(axis: usize) -> Self {
        let mut unit = Self::zero();
        unit.0[axis] = T::from_f64(1.0);
        unit
    }

    /// Magnitude, the square root of the sum of squares.
    #[must_use]
    pub fn norm(self) -> T {
        dot(self, self).sqrt()
    }

    /// The same three numbers as the type of the solver's interface.
    #[must_use]
    pub const fn to_nalgebra(self) -> Vector3<T> {
        let [x, y, z] = self.0;
        Vector3::new(x, y, z)
    }
}

impl<T: Scalar> From<&Vector3<T>> for Vector<T> {
    fn from(v: &Vector3<T>) -> Self {
        Self([v.x, v.y, v.z])
    }
}

impl<T: Scalar> Tensor<T> {
    /// The identity.
    #[must_use]
    pub fn identity() -> Self {
        Self([Vector::unit(0).0, Vector::unit(1).0, Vector::unit(2).0])
    }

    /// One column, 0 to 2: of a rotation, the unit vector of that axis.
    #[must_use]
    pub fn column(self, index: usize) -> Vector<T> {
        Vector(self.0.map(|row| row[index]))
    }

    /// The matrix with these columns: of unit vectors, the rotation to the axes that they are.
    #[must_use]
    pub fn of_columns(columns: [Vector<T>; 3]) -> Self {
        Self(columns.map(|column| column.0)).transpose()
    }

    /// Rows and columns exchanged.
    #[must_use]
    pub fn transpose(self) -> Self {
        Self([self.column(0).0, self.column(1).0, self.column(2).0])
    }

    /// `R I R^T`: a tensor along the axes `R`, resolved along those in which `R` is written.
    #[must_use]
    pub fn resolved_from(self, rotation: Self) -> Self {
        rotation * self * rotation.transpose()
    }
}

impl<T: Scalar> From<&Matrix3<T>> for Tensor<T> {
    fn from(m: &Matrix3<T>) -> Self {
        Self([0, 1, 2].map(|row| [0, 1, 2].map(|column| m[(row, column)])))
    }
}

/// Scalar product.
#[must_use]
pub fn dot<T: Scalar>(a: Vector<T>, b: Vector<T>) -> T {
    a.0[0] * b.0[0] + a.0[1] * b.0[1] + a.0[2] * b.0[2]
}

/// Vector product.
#[must_use]
pub fn cross<T: Scalar>(a: Vector<T>, b: Vector<T>) -> Vector<T> {
    let ([a1, a2, a3], [b1, b2, b3]) = (a.0, b.0);
    Vector([a2 * b3 - a3 * b2, a3 * b1 - a1 * b3, a1 * b2 - a2 * b1])
}

/// The matrix of `a x`.
#[must_use]
pub fn tilde<T: Scalar>(a: Vector<T>) -> Tensor<T> {
    let ([a1, a2, a3], zero) = (a.0, T::from_f64(0.0));
    Tensor([[zero, -a3, a2], [a3, zero, -a1], [-a2, a1, zero]])
}

impl<T: Scalar> Add for Vector<T> {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self(core::array::from_fn(|i| self.0[i] + other.0[i]))
    }
}

impl<T: Scalar> Sub for Vector<T> {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self(core::array::from_fn(|i| self.0[i] - other.0[i]))
    }
}

impl<T: Scalar> Neg for Vector<T> {
    type Output = Self;

    fn neg(self) -> Self {
        Self(self.0.map(|x| -x))
    }
}

impl<T: Scalar> Mul<T> for Vector<T> {
    type Output = Self;

    fn mul(self, factor: T) -> Self {
        Self(self.0.map(|x| x * factor))
    }
}

impl<T: Scalar> Add for Tensor<T> {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self(core::array::from_fn(|i| (Vector(self.0[i]) + Vector(other.0[i])).0))
    }
}

impl<T: Scalar> Sub for Tensor<T> {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self(core::array::from_fn(|i| (Vector(self.0[i]) - Vector(other.0[i])).0))
    }
}

impl<T: Scalar> Mul for Tensor<T> {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let columns = other.transpose();
        Self(self.0.map(|row| (columns * Vector(row)).0))
    }
}

impl<T: Scalar> Mul<T> for Tensor<T> {
    type Output = Self;

    fn mul(self, factor: T) -> Self {
        Self(self.0.map(|row| (Vector(row) * factor).0))
    }
}

impl<T: Scalar> Mul<Vector<T>> for Tensor<T> {
    type Output = Vector<T>;

    fn mul(self, v: Vector<T>) -> Vector<T> {
        Vector(self.0.map(|row| dot(Vector(row), v)))
    }
}
