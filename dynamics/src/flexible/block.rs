//! Blocks of six: a force and a moment, a velocity and an angular velocity, and what joins them.

#![expect(clippy::inline_always, reason = "six numbers at a time, in registers of the caller")]

use crate::numbers::real::Scalar;
use crate::numbers::vec3::Vec3;

/// Three components of translation, then three of rotation.
pub(crate) type Six<T> = [T; 6];

/// A matrix of six rows.
pub(crate) type Block<T> = [Six<T>; 6];

/// `a . b`.
#[inline(always)]
pub(crate) fn dot6<T: Scalar>(a: &Six<T>, b: &Six<T>) -> T {
    let [a0, a1, a2, a3, a4, a5] = *a;
    let [b0, b1, b2, b3, b4, b5] = *b;
    (a0 * b0 + a1 * b1) + (a2 * b2 + a3 * b3) + (a4 * b4 + a5 * b5)
}

/// `to += s from`.
#[inline(always)]
pub(crate) fn add_scaled<T: Scalar>(to: &mut Six<T>, s: T, from: &Six<T>) {
    for (to, from) in to.iter_mut().zip(from) {
        *to = *to + s * *from;
    }
}

/// `a - b`.
#[inline(always)]
pub(crate) fn sub6<T: Scalar>(a: &Six<T>, b: &Six<T>) -> Six<T> {
    let mut difference = *a;
    add_scaled(&mut difference, -crate::numbers::real::one::<T>(), b);
    difference
}

/// `m v`.
#[inline(always)]
pub(crate) fn times<T: Scalar>(m: &Block<T>, v: &Six<T>) -> Six<T> {
    let [a, b, c, d, e, f] = m;
    [dot6(a, v), dot6(b, v), dot6(c, v), dot6(d, v), dot6(e, v), dot6(f, v)]
}

/// `to += mᵀ v`.
#[inline(always)]
pub(crate) fn add_transposed_times<T: Scalar>(to: &mut Six<T>, m: &Block<T>, v: &Six<T>) {
    for (row, component) in m.iter().zip(v) {
        add_scaled(to, *component, row);
    }
}

/// `a b`.
#[inline(always)]
pub(crate) fn product<T: Scalar>(a: &Block<T>, b: &Block<T>) -> Block<T> {
    let mut product = zeros6(T::from_f64(0.0));
    for (to, row) in product.iter_mut().zip(a) {
        add_transposed_times(to, b, row);
    }
    product
}

/// `to += aᵀ b`.
#[inline(always)]
pub(crate) fn add_transposed_product<T: Scalar>(to: &mut Block<T>, a: &Block<T>, b: &Block<T>) {
    for (row, from) in a.iter().zip(b) {
        for (to, component) in to.iter_mut().zip(row) {
            add_scaled(to, *component, from);
        }
    }
}

/// Every entry the same.
#[inline(always)]
pub(crate) fn zeros6<T: Copy>(zero: T) -> Block<T> {
    [[zero; 6]; 6]
}

/// Translation above rotation.
#[inline(always)]
pub(crate) fn joined<T: Copy>([x, y, z]: Vec3<T>, [p, q, r]: Vec3<T>) -> Six<T> {
    [x, y, z, p, q, r]
}

/// Translation and rotation.
#[inline(always)]
pub(crate) fn parted<T: Copy>([x, y, z, p, q, r]: &Six<T>) -> (Vec3<T>, Vec3<T>) {
    ([*x, *y, *z], [*p, *q, *r])
}

/// The sum of what numbers take of columns: `Y v`.
#[inline(always)]
pub(crate) fn combined<'a, T: Scalar>(
    columns: impl IntoIterator<Item = &'a Six<T>>,
    numbers: impl IntoIterator<Item = &'a T>,
) -> Six<T> {
    let mut sum = [T::from_f64(0.0); 6];
    for (column, number) in columns.into_iter().zip(numbers) {
        add_scaled(&mut sum, *number, column);
    }
    sum
}
