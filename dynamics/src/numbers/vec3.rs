//! Three-component vectors and rotations as arrays: the arithmetic between API and kernels.
//!
//! nalgebra's types are used at the API's edge; inside, arrays over [`Real`] keep every sum in a
//! fixed order and need no trait beyond the kernels' own.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use nalgebra::{Matrix3, Vector3};

use crate::numbers::real::{Real, Scalar, zero};

/// Components along one triad.
pub(crate) type Vec3<T> = [T; 3];

/// A matrix by its columns. For a rotation: the new axes in the old frame.
pub(crate) type Columns<T> = [[T; 3]; 3];

/// The components of a vector of the API.
#[inline(always)]
pub(crate) fn components<T: Copy>(v: &Vector3<T>) -> Vec3<T> {
    let [column] = v.data.0;
    column
}

/// The columns of a matrix of the API.
#[inline(always)]
pub(crate) fn columns<T: Copy>(m: &Matrix3<T>) -> Columns<T> {
    m.data.0
}

/// A vector of the API from its components.
#[inline(always)]
pub(crate) fn vector<T>([x, y, z]: Vec3<T>) -> Vector3<T> {
    Vector3::new(x, y, z)
}

/// The vector with each component changed. An array's own `map` is a call, which lanes must not
/// make.
#[inline(always)]
pub(crate) fn map<T, U>([x, y, z]: Vec3<T>, mut change: impl FnMut(T) -> U) -> Vec3<U> {
    [change(x), change(y), change(z)]
}

/// The zero vector.
#[inline]
pub(crate) fn zeros<T: Scalar>() -> Vec3<T> {
    [zero(); 3]
}

/// `a + b`.
#[inline(always)]
pub(crate) fn add<T: Real>(a: Vec3<T>, b: Vec3<T>) -> Vec3<T> {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// `a - b`.
#[inline(always)]
pub(crate) fn sub<T: Real>(a: Vec3<T>, b: Vec3<T>) -> Vec3<T> {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// `-a`.
#[inline(always)]
pub(crate) fn neg<T: Real>(a: Vec3<T>) -> Vec3<T> {
    [-a[0], -a[1], -a[2]]
}

/// `s a`.
#[inline(always)]
pub(crate) fn scale<T: Real>(s: T, a: Vec3<T>) -> Vec3<T> {
    [s * a[0], s * a[1], s * a[2]]
}

/// `a . b`.
#[inline(always)]
pub(crate) fn dot<T: Real>(a: Vec3<T>, b: Vec3<T>) -> T {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// `a x b`.
#[inline(always)]
pub(crate) fn cross<T: Real>(a: Vec3<T>, b: Vec3<T>) -> Vec3<T> {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// `m v`: components in the old frame of a vector expressed in the columns.
#[inline(always)]
pub(crate) fn rotate<T: Real>(m: &Columns<T>, v: Vec3<T>) -> Vec3<T> {
    let [x, y, z] = m;
    [
        x[0] * v[0] + y[0] * v[1] + z[0] * v[2],
        x[1] * v[0] + y[1] * v[1] + z[1] * v[2],
        x[2] * v[0] + y[2] * v[1] + z[2] * v[2],
    ]
}

/// `m^T v`: components in the columns of a vector expressed in the old frame.
#[inline(always)]
pub(crate) fn rotate_transposed<T: Real>(m: &Columns<T>, v: Vec3<T>) -> Vec3<T> {
    [dot(m[0], v), dot(m[1], v), dot(m[2], v)]
}

/// The largest magnitude among the components; NaN only if the first one is.
#[inline]
pub(crate) fn largest<T: Scalar>(v: Vec3<T>) -> T {
    v[0].abs().max(v[1].abs()).max(v[2].abs())
}

/// The first value that is not finite, otherwise the first one of largest magnitude; with its sign.
pub(crate) fn extreme<T: Scalar, const LENGTH: usize>(values: [T; LENGTH]) -> T {
    let ahead = |value: T, best: T| !value.is_finite() || value.abs() > best.abs();
    values.into_iter().fold(zero(), |best, value| {
        if best.is_finite() && ahead(value, best) { value } else { best }
    })
}

/// Whether all components are finite.
#[inline]
pub(crate) fn finite<T: Scalar>(v: Vec3<T>) -> bool {
    v[0].is_finite() && v[1].is_finite() && v[2].is_finite()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cross_product_is_right_handed() {
        assert_eq!(cross([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]), [0.0, 0.0, 1.0]);
        assert_eq!(cross([1.0, 2.0, 3.0], [4.0, 5.0, 6.0]), [-3.0, 6.0, -3.0]);
    }

    #[test]
    fn extreme_value_is_the_first_not_finite_or_the_largest() {
        assert_eq!(extreme([1.0, -3.0, 2.0, 3.0]), -3.0);
        assert_eq!(extreme([0.0; 4]), 0.0);
        assert_eq!(extreme([7.0, f64::NEG_INFINITY, f64::NAN]), f64::NEG_INFINITY);
        assert!(extreme([7.0, f64::NAN, f64::INFINITY]).is_nan());
    }

    #[test]
    fn rotation_agrees_with_nalgebra() {
        // A quarter turn about z followed by nothing else: exact numbers.
        let m = Matrix3::new(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
        let v = Vector3::new(1.0, 2.0, 3.0);
        assert_eq!(vector(rotate(&columns(&m), components(&v))), m * v);
        assert_eq!(vector(rotate_transposed(&columns(&m), components(&v))), m.transpose() * v);
    }
}
