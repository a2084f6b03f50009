//! Symmetric 3x3 tensors (inertias): storage of six numbers, rotation, principal moments.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use nalgebra::Matrix3;

use crate::numbers::real::{Real, Scalar, half, one, reciprocal_in_two, zero};
use crate::numbers::vec3::{Columns, Vec3, columns, dot, rotate, scale};

/// A symmetric tensor by its upper triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Symmetric<T> {
    pub(crate) xx: T,
    pub(crate) xy: T,
    pub(crate) xz: T,
    pub(crate) yy: T,
    pub(crate) yz: T,
    pub(crate) zz: T,
}

impl<T: Scalar> Symmetric<T> {
    /// The tensor that is zero.
    pub(crate) fn zero() -> Self {
        Self::scalar(zero())
    }

    /// The symmetric part of a matrix. Exact where the matrix is symmetric already.
    pub(crate) fn part_of(m: &Matrix3<T>) -> Self {
        let [x, y, z] = columns(m);
        // Half the smallest number would be zero, and the sum of the largest ones infinite.
        let mean = |a: T, b: T| {
            if (a - b).vanishes() { a } else { half::<T>() * a + half::<T>() * b }
        };
        Self {
            xx: x[0],
            xy: mean(y[0], x[1]),
            xz: mean(z[0], x[2]),
            yy: y[1],
            yz: mean(z[1], y[2]),
            zz: z[2],
        }
    }

    /// Principal moments in ascending order, by Jacobi's rotations.
    ///
    /// A fixed number of sweeps, so time is bounded and nothing can fail to converge: the method is
    /// quadratic, and eight sweeps leave a 3x3 matrix diagonal in any precision up to 200 bits.
    /// The tensor is scaled to its largest element first, so nothing overflows or vanishes on the
    /// way; a moment beyond the largest number is infinite.
    pub(crate) fn principal_moments(self) -> Vec3<T> {
        const SWEEPS: usize = 8;
        let largest = self.largest_element();
        if largest == zero() {
            return [zero(); 3];
        }
        let (first, second) = reciprocal_in_two(largest);
        let mut s = self.scaled(first).scaled(second);
        for _ in 0..SWEEPS {
            let turn = Turn::zeroing(s.xx, s.yy, s.xy);
            turn.apply(&mut s.xx, &mut s.yy, &mut s.xy, &mut s.xz, &mut s.yz);
            let turn = Turn::zeroing(s.xx, s.zz, s.xz);
            turn.apply(&mut s.xx, &mut s.zz, &mut s.xz, &mut s.xy, &mut s.yz);
            let turn = Turn::zeroing(s.yy, s.zz, s.yz);
            turn.apply(&mut s.yy, &mut s.zz, &mut s.yz, &mut s.xy, &mut s.xz);
        }
        let (a, b) = ordered(s.xx, s.yy);
        let (b, c) = ordered(b, s.zz);
        let (a, b) = ordered(a, b);
        scale(largest, [a, b, c])
    }

    /// The largest magnitude among the elements.
    pub(crate) fn largest_element(&self) -> T {
        let diagonal = self.xx.abs().max(self.yy.abs()).max(self.zz.abs());
        diagonal.max(self.xy.abs()).max(self.xz.abs()).max(self.yz.abs())
    }
}

impl<T: Copy> Symmetric<T> {
    /// Two tensors joined number by number.
    #[inline(always)]
    pub(crate) fn zip<U: Copy, W>(
        self,
        other: Symmetric<U>,
        mut join: impl FnMut(T, U) -> W,
    ) -> Symmetric<W> {
        Symmetric {
            xx: join(self.xx, other.xx),
            xy: join(self.xy, other.xy),
            xz: join(self.xz, other.xz),
            yy: join(self.yy, other.yy),
            yz: join(self.yz, other.yz),
            zz: join(self.zz, other.zz),
        }
    }
}

impl<T: Real> Symmetric<T> {
    /// `s` times the identity.
    #[inline(always)]
    pub(crate) fn scalar(s: T) -> Self {
        let zero = s.like(0.0);
        Self { xx: s, xy: zero, xz: zero, yy: s, yz: zero, zz: s }
    }

    /// `s` times the tensor.
    #[inline(always)]
    pub(crate) fn scaled(self, s: T) -> Self {
        Self {
            xx: s * self.xx,
            xy: s * self.xy,
            xz: s * self.xz,
            yy: s * self.yy,
            yz: s * self.yz,
            zz: s * self.zz,
        }
    }

    /// The sum of two tensors.
    #[inline(always)]
    pub(crate) fn plus(self, other: Self) -> Self {
        Self {
            xx: self.xx + other.xx,
            xy: self.xy + other.xy,
            xz: self.xz + other.xz,
            yy: self.yy + other.yy,
            yz: self.yz + other.yz,
            zz: self.zz + other.zz,
        }
    }

    /// Every entry the same.
    #[inline(always)]
    pub(crate) fn filled(value: T) -> Self {
        Self { xx: value, xy: value, xz: value, yy: value, yz: value, zz: value }
    }

    /// What is left without `other`.
    #[inline(always)]
    pub(crate) fn less(self, other: Self) -> Self {
        Self {
            xx: self.xx - other.xx,
            xy: self.xy - other.xy,
            xz: self.xz - other.xz,
            yy: self.yy - other.yy,
            yz: self.yz - other.yz,
            zz: self.zz - other.zz,
        }
    }

    /// `v vᵀ`.
    #[inline(always)]
    pub(crate) fn dyad(v: Vec3<T>) -> Self {
        let [x, y, z] = v;
        Self { xx: x * x, xy: x * y, xz: x * z, yy: y * y, yz: y * z, zz: z * z }
    }

    /// The moments, without the products.
    #[inline(always)]
    pub(crate) fn diagonal(&self) -> Vec3<T> {
        [self.xx, self.yy, self.zz]
    }

    /// The sum of the diagonal.
    #[inline(always)]
    pub(crate) fn trace(&self) -> T {
        self.xx + self.yy + self.zz
    }

    /// `self : other`, the sum of the products of all nine elements.
    #[inline(always)]
    pub(crate) fn double_dot(&self, other: &Self) -> T {
        let diagonal = self.xx * other.xx + self.yy * other.yy + self.zz * other.zz;
        let beside = self.xy * other.xy + self.xz * other.xz + self.yz * other.yz;
        diagonal + beside + beside
    }

    /// The tensor applied to a vector.
    #[inline(always)]
    pub(crate) fn times(&self, v: Vec3<T>) -> Vec3<T> {
        rotate(&self.columns(), v)
    }

    /// `m self m^T`: components in the old frame of a tensor expressed in the columns of `m`.
    #[inline(always)]
    pub(crate) fn rotated(&self, m: &Columns<T>) -> Self {
        let s = self.columns();
        let ms = [rotate(m, s[0]), rotate(m, s[1]), rotate(m, s[2])];
        let row = |i: usize| -> Vec3<T> { [ms[0][i], ms[1][i], ms[2][i]] };
        let (x, y, z) = (row(0), row(1), row(2));
        let (mx, my, mz) =
            ([m[0][0], m[1][0], m[2][0]], [m[0][1], m[1][1], m[2][1]], [m[0][2], m[1][2], m[2][2]]);
        Self {
            xx: dot(x, mx),
            xy: dot(x, my),
            xz: dot(x, mz),
            yy: dot(y, my),
            yz: dot(y, mz),
            zz: dot(z, mz),
        }
    }

    /// `mass (r . r 1 - r r^T)`: the parallel-axis term of a mass at `r`.
    #[inline(always)]
    pub(crate) fn parallel_axis(mass: T, r: Vec3<T>) -> Self {
        let m = [mass * r[0], mass * r[1], mass * r[2]];
        Self {
            xx: m[1] * r[1] + m[2] * r[2],
            xy: -(m[0] * r[1]),
            xz: -(m[0] * r[2]),
            yy: m[0] * r[0] + m[2] * r[2],
            yz: -(m[1] * r[2]),
            zz: m[0] * r[0] + m[1] * r[1],
        }
    }

    /// The three columns.
    #[inline(always)]
    pub(crate) fn columns(&self) -> Columns<T> {
        [[self.xx, self.xy, self.xz], [self.xy, self.yy, self.yz], [self.xz, self.yz, self.zz]]
    }
}

/// One of Jacobi's plane rotations, by its tangent.
struct Turn<T> {
    tangent: T,
    cosine: T,
    sine: T,
}

impl<T: Scalar> Turn<T> {
    /// The smaller rotation that makes the off-diagonal element `pq` zero, in a tensor whose
    /// largest element is 1. Below epsilon squared the element is nothing against it, and none is
    /// made.
    fn zeroing(pp: T, qq: T, pq: T) -> Self {
        if pq.abs() <= T::EPSILON * T::EPSILON {
            return Self { tangent: zero(), cosine: one(), sine: zero() };
        }
        let cotangent_of_double = half::<T>() * (qq - pp) * pq.recip();
        let square = cotangent_of_double * cotangent_of_double + one();
        let magnitude = (cotangent_of_double.abs() + square.sqrt()).recip();
        let tangent = if cotangent_of_double < zero() { -magnitude } else { magnitude };
        let cosine = (tangent * tangent + one()).sqrt().recip();
        Self { tangent, cosine, sine: tangent * cosine }
    }

    /// Turns the axes p and q; `rp` and `rq` are the couplings with the third axis.
    fn apply(&self, pp: &mut T, qq: &mut T, pq: &mut T, rp: &mut T, rq: &mut T) {
        *pp = *pp - self.tangent * *pq;
        *qq = *qq + self.tangent * *pq;
        *pq = zero();
        (*rp, *rq) = (self.cosine * *rp - self.sine * *rq, self.sine * *rp + self.cosine * *rq);
    }
}

fn ordered<T: Scalar>(a: T, b: T) -> (T, T) {
    if b < a { (b, a) } else { (a, b) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Rotation3;

    /// Eigenvalues result from a few dozen rounded operations on numbers of size 1 to 10.
    const ROUNDING: f64 = 1e-14;

    fn assert_close(actual: [f64; 3], expected: [f64; 3]) {
        for (a, e) in actual.iter().zip(&expected) {
            assert!((a - e).abs() <= ROUNDING * 10.0, "{actual:?} is not {expected:?}");
        }
    }

    #[test]
    fn principal_moments_of_a_turned_diagonal_are_the_diagonal() {
        let turn = *Rotation3::from_euler_angles(0.3, -1.1, 2.7).matrix();
        let tensor = turn * Matrix3::from_diagonal(&[7.0, 2.0, 3.0].into()) * turn.transpose();
        assert_close(Symmetric::part_of(&tensor).principal_moments(), [2.0, 3.0, 7.0]);
    }

    #[test]
    fn principal_moments_of_known_matrices() {
        // Eigenvalues of the second-difference matrix: 2 - sqrt 2, 2, 2 + sqrt 2.
        let m = Matrix3::new(2.0, -1.0, 0.0, -1.0, 2.0, -1.0, 0.0, -1.0, 2.0);
        let root = 2.0_f64.sqrt();
        assert_close(Symmetric::part_of(&m).principal_moments(), [2.0 - root, 2.0, 2.0 + root]);
        // All ones: rank one, and the 45-degree turns of equal diagonals.
        assert_close(
            Symmetric::part_of(&Matrix3::repeat(1.0)).principal_moments(),
            [0.0, 0.0, 3.0],
        );
        let zero = Symmetric::scalar(0.0_f64);
        assert_eq!(zero.principal_moments(), [0.0; 3]);
    }

    #[test]
    fn principal_moments_survive_extreme_sizes() {
        let m = Matrix3::new(2.0, -1.0, 0.0, -1.0, 2.0, -1.0, 0.0, -1.0, 2.0);
        let root = 2.0_f64.sqrt();
        for size in [1e-300, 1e300] {
            let moments = Symmetric::part_of(&(m * size)).principal_moments();
            assert_close(moments.map(|i| i / size), [2.0 - root, 2.0, 2.0 + root]);
        }
        // Subnormal, down to the smallest number of all: elements and moments are exact.
        let m = Matrix3::new(0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 3.0);
        for size in [f64::from_bits(1), f64::from_bits(1 << 40)] {
            let moments = Symmetric::part_of(&(m * size)).principal_moments();
            assert_eq!(moments, [-size, size, 3.0 * size]);
        }
        let single = Symmetric::part_of(&Matrix3::from_diagonal(&[-1e-44_f32, 0.0, 0.0].into()));
        assert_eq!(single.principal_moments(), [-1e-44, 0.0, 0.0]);
        // Three times the largest element is beyond f64, the other two are rounding of it.
        let [least, middle, most] =
            Symmetric::part_of(&Matrix3::repeat(1.7e308)).principal_moments();
        assert!(least.abs().max(middle.abs()) <= ROUNDING * 1.7e308 && most == f64::INFINITY);
        let tiny_coupling = Matrix3::new(1.0, 1e-310, 0.0, 1e-310, 1.0, 0.0, 0.0, 0.0, 1.0);
        assert_eq!(Symmetric::part_of(&tiny_coupling).principal_moments(), [1.0; 3]);
    }

    #[test]
    fn rotation_and_parallel_axis_agree_with_matrices() {
        let turn = *Rotation3::from_euler_angles(-0.4, 0.9, 0.2).matrix();
        let tensor = Matrix3::new(4.0, 0.3, -0.2, 0.3, 5.0, 0.6, -0.2, 0.6, 6.0);
        let rotated = Symmetric::part_of(&tensor).rotated(&columns(&turn));
        let expected = turn * tensor * turn.transpose();
        let difference = Matrix3::from(rotated.columns()) - expected;
        assert!(difference.amax() <= 10.0 * ROUNDING);
        // A mass of 2 kg at (1, 2, 3) m.
        let term = Symmetric::parallel_axis(2.0, [1.0, 2.0, 3.0]);
        let expected = Symmetric { xx: 26.0, xy: -4.0, xz: -6.0, yy: 20.0, yz: -12.0, zz: 10.0 };
        assert_eq!(term, expected);
    }
}
