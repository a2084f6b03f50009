//! Blocks of six: a force and a moment, a velocity and an angular velocity, and what joins them.

#![expect(clippy::inline_always, reason = "six numbers at a time, in registers of the caller")]

use crate::numbers::real::Scalar;
use crate::numbers::vec3::{Vec3, add, dot};

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

/// A matrix of six rows whose lower left quarter is zero, as what moves the translation and the rotation of
/// one frame with those of another: the quarters that are not.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BlockTriangular<T> {
    /// The first three rows.
    pub(crate) upper: [Six<T>; 3],
    /// The right half of the others.
    pub(crate) lower: [Vec3<T>; 3],
}

impl<T: Scalar> BlockTriangular<T> {
    /// `m v`.
    #[inline(always)]
    pub(crate) fn times(&self, v: &Six<T>) -> Six<T> {
        let ([a, b, c], [d, e, f]) = (&self.upper, &self.lower);
        let (_, turning) = parted(v);
        joined(
            [dot6(a, v), dot6(b, v), dot6(c, v)],
            [dot(*d, turning), dot(*e, turning), dot(*f, turning)],
        )
    }

    /// `mᵀ v`.
    #[inline(always)]
    pub(crate) fn transposed_times(&self, v: &Six<T>) -> Six<T> {
        let (moving, turning) = parted(v);
        let (linear, angular) = parted(&combined_rows(&self.upper, moving));
        joined(linear, add(angular, combined_rows(&self.lower, turning)))
    }

    /// `to += mᵀ a m` for a symmetric `a`; only the triangle from the diagonal on is written.
    #[inline(always)]
    pub(crate) fn add_congruent(&self, to: &mut Block<T>, a: &Block<T>) {
        let [p, q, r, s, t, u] = a.map(|row| self.transposed_times(&row));
        let [a, b, c] = self.upper;
        let columns = a.into_iter().zip(b).zip(c).enumerate();
        for (to, (first, ((a, b), c))) in to.iter_mut().zip(columns) {
            let rows = p.iter().zip(&q).zip(&r);
            for (to, ((p, q), r)) in to.iter_mut().zip(rows).skip(first) {
                *to = *to + (a * *p + b * *q + c * *r);
            }
        }
        let [d, e, f] = self.lower;
        let columns = d.into_iter().zip(e).zip(f).enumerate();
        for (to, (first, ((d, e), f))) in to.iter_mut().skip(3).zip(columns) {
            let rows = s.iter().zip(&t).zip(&u);
            for (to, ((s, t), u)) in to.iter_mut().zip(rows).skip(first).skip(3) {
                *to = *to + (d * *s + e * *t + f * *u);
            }
        }
    }
}

/// The sum of what three numbers take of three rows.
#[inline(always)]
fn combined_rows<T: Scalar, const N: usize>([a, b, c]: &[[T; N]; 3], [x, y, z]: Vec3<T>) -> [T; N] {
    let mut sum = *a;
    for ((to, b), c) in sum.iter_mut().zip(b).zip(c) {
        *to = *to * x + *b * y + *c * z;
    }
    sum
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

/// Whether all numbers are finite.
pub(crate) fn finite<T: Scalar>(numbers: &[T]) -> bool {
    numbers.iter().all(|number| number.is_finite())
}
