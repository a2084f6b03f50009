//! Spatial vectors and matrices of six components, angular part first: Featherstone, chapter 2.
//!
//! Motion vectors (velocity, acceleration, a joint's axis) and force vectors (force, momentum) are
//! of one type here; each operation states which of the two it takes. Nothing is packed: a
//! coordinate transform and an inertia are full 6x6 matrices.

use core::ops::{Add, Mul, Neg, Sub};

use precess_dynamics::Scalar;

/// A motion vector, angular and linear velocity at the origin, or a force vector, moment about the
/// origin and force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Spatial<T>(pub(super) [T; 6]);

/// A linear map of spatial vectors, by rows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Matrix<T>(pub(super) [[T; 6]; 6]);

/// A 3x3 block of a [`Matrix`], by rows.
pub(super) type Block<T> = [[T; 3]; 3];

impl<T: Scalar> Spatial<T> {
    pub(super) fn new([a, b, c]: [T; 3], [d, e, f]: [T; 3]) -> Self {
        Self([a, b, c, d, e, f])
    }

    /// The unit rotation about one coordinate axis through the origin.
    pub(super) fn turning_about(axis: usize) -> Self {
        Self(core::array::from_fn(|i| T::from_f64(if i == axis { 1.0 } else { 0.0 })))
    }

    /// Angular and linear part.
    pub(super) const fn halves(self) -> [[T; 3]; 2] {
        let [a, b, c, d, e, f] = self.0;
        [[a, b, c], [d, e, f]]
    }

    /// Scalar product of a motion with a force: power.
    pub(super) fn dot(self, other: Self) -> T {
        let products = self.0.into_iter().zip(other.0).map(|(a, b)| a * b);
        products.fold(T::from_f64(0.0), |sum, product| sum + product)
    }

    /// `self other^T`
    pub(super) fn dyad(self, other: Self) -> Matrix<T> {
        Matrix(self.0.map(|a| other.0.map(|b| a * b)))
    }
}

impl<T: Scalar> Matrix<T> {
    /// From four blocks, as they are written.
    pub(super) fn blocks([[a, b], [c, d]]: [[Block<T>; 2]; 2]) -> Self {
        let row = |i: usize| {
            let (left, right) = if i < 3 { (a[i], b[i]) } else { (c[i - 3], d[i - 3]) };
            Spatial::new(left, right).0
        };
        Self(core::array::from_fn(row))
    }

    pub(super) fn transpose(self) -> Self {
        Self(core::array::from_fn(|i| self.0.map(|row| row[i])))
    }
}

/// `[omega; v] x [m; n] = [omega x m; omega x n + v x m]`: rate of a motion vector fixed in a frame
/// that moves with `[omega; v]`.
pub(super) fn motion_cross<T: Scalar>(v: Spatial<T>, motion: Spatial<T>) -> Spatial<T> {
    let ([omega, v], [m, n]) = (v.halves(), motion.halves());
    Spatial::new(cross(omega, m), sum(cross(omega, n), cross(v, m)))
}

/// `[omega; v] x* [m; f] = [omega x m + v x f; omega x f]`: rate of a force vector fixed in that
/// frame.
pub(super) fn force_cross<T: Scalar>(v: Spatial<T>, force: Spatial<T>) -> Spatial<T> {
    let ([omega, v], [m, f]) = (v.halves(), force.halves());
    Spatial::new(sum(cross(omega, m), cross(v, f)), cross(omega, f))
}

/// The vector product of ordinary vectors.
fn cross<T: Scalar>([a, b, c]: [T; 3], [x, y, z]: [T; 3]) -> [T; 3] {
    [b * z - c * y, c * x - a * z, a * y - b * x]
}

fn sum<T: Scalar>([a, b, c]: [T; 3], [x, y, z]: [T; 3]) -> [T; 3] {
    [a + x, b + y, c + z]
}

/// The matrix of `a x` in three dimensions.
pub(super) fn cross_matrix<T: Scalar>([a, b, c]: [T; 3]) -> Block<T> {
    let o = T::from_f64(0.0);
    [[o, -c, b], [c, o, -a], [-b, a, o]]
}

impl<T: Scalar> Add for Spatial<T> {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self(core::array::from_fn(|i| self.0[i] + other.0[i]))
    }
}

impl<T: Scalar> Sub for Spatial<T> {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self(core::array::from_fn(|i| self.0[i] - other.0[i]))
    }
}

impl<T: Scalar> Neg for Spatial<T> {
    type Output = Self;

    fn neg(self) -> Self {
        Self(self.0.map(|x| -x))
    }
}

impl<T: Scalar> Mul<T> for Spatial<T> {
    type Output = Self;

    fn mul(self, factor: T) -> Self {
        Self(self.0.map(|x| x * factor))
    }
}

impl<T: Scalar> Add for Matrix<T> {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self(core::array::from_fn(|i| (Spatial(self.0[i]) + Spatial(other.0[i])).0))
    }
}

impl<T: Scalar> Sub for Matrix<T> {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self(core::array::from_fn(|i| (Spatial(self.0[i]) - Spatial(other.0[i])).0))
    }
}

impl<T: Scalar> Mul for Matrix<T> {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let columns = other.transpose();
        Self(self.0.map(|row| (columns * Spatial(row)).0))
    }
}

impl<T: Scalar> Mul<Spatial<T>> for Matrix<T> {
    type Output = Spatial<T>;

    fn mul(self, v: Spatial<T>) -> Spatial<T> {
        Spatial(self.0.map(|row| Spatial(row).dot(v)))
    }
}

#[cfg(test)]
mod tests {
    use super::{Spatial, force_cross, motion_cross};

    const V: Spatial<f64> = Spatial([1.0, -2.0, 3.0, 0.5, 4.0, -1.0]);
    const M: Spatial<f64> = Spatial([2.0, 0.0, -1.0, 3.0, 1.0, 5.0]);
    const F: Spatial<f64> = Spatial([-3.0, 2.0, 7.0, 1.0, -2.0, 4.0]);

    /// Small integers and a half: exact.
    #[test]
    fn the_two_cross_products_keep_power() {
        assert_eq!(motion_cross(V, M).dot(F), -M.dot(force_cross(V, F)));
        assert_ne!(M.dot(force_cross(V, F)), 0.0);
    }

    #[test]
    fn a_motion_is_fixed_in_its_own_flow() {
        assert_eq!(motion_cross(V, V), Spatial([0.0; 6]));
    }
}
