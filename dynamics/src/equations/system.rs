//! The hub's six equations, `M [r_b_n_ddot; omega_dot] = h`, by LDL^T without a square root.
//!
//! `M` is symmetric, in 3x3 blocks `vv`, `vw`, `ww`; all components expressed in B. Taking three
//! columns at a time is the same factorisation in the same order of operations as taking one, and
//! leaves no index to go out of range.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use crate::equations::error::SolveError;
use crate::numbers::real::{Real, Scalar};
use crate::numbers::symmetric::Symmetric;
use crate::numbers::vec3::{Columns, Vec3, add, dot, finite, map, rotate, scale, sub};

/// A pivot must exceed this many epsilons of its scale: of the largest numbers that were added up
/// and cancelled in it.
///
/// What is left at the bound has at most some bits that are not rounding; a state that close to
/// singular has no meaningful accelerations.
pub(crate) const PIVOT_EPSILONS: f64 = 64.0;

/// Where every pivot exceeds this share of its own scale, none is near its bound, however much the
/// rounding of one grows in those after it.
pub(crate) const WELL_SCALED: f64 = 1.0 / 1024.0;

/// The symmetric system: row of `vw` = force, column = angular acceleration; `vw` by its columns.
#[derive(Clone, Copy, Debug)]
pub(crate) struct System<T> {
    pub(crate) m_vv: Symmetric<T>,
    pub(crate) m_vw: Columns<T>,
    pub(crate) m_ww: Symmetric<T>,
    pub(crate) h_v: Vec3<T>,
    pub(crate) h_w: Vec3<T>,
}

/// What the pivots are checked against: mass, kg, of the first three rows; inertia, kg m², of each
/// of the last three. Both before any joint is eliminated.
pub(crate) type Scale<T> = (T, Vec3<T>);

/// The solution of a [`System`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Solution<T> {
    pub(crate) r_b_n_ddot: Vec3<T>,
    pub(crate) omega_dot: Vec3<T>,
}

/// The six pivots in order.
pub(crate) type Pivots<T> = [T; 6];

/// A pivot that is not above its bound.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SmallPivot<T> {
    pub(crate) pivot: T,
    pub(crate) bound: T,
}

impl<T> SmallPivot<T> {
    /// Its error: of a joint of a device, or of the hub.
    pub(crate) fn of(self, device: Option<usize>, joint: Option<&'static str>) -> SolveError<T> {
        let Self { pivot, bound } = self;
        SolveError::Singular { device, joint, pivot, bound }
    }
}

impl<T: Scalar> Solution<T> {
    /// Whether every acceleration is finite.
    pub(crate) fn is_finite(&self) -> bool {
        finite(self.r_b_n_ddot) && finite(self.omega_dot)
    }
}

/// What a pivot of this scale must exceed.
#[inline]
pub(crate) fn bound<T: Scalar>(scale: T) -> T {
    T::from_f64(PIVOT_EPSILONS) * T::EPSILON * scale
}

/// Passes a pivot that exceeds its bound; NaN never does.
#[inline]
pub(crate) fn check_pivot<T: Scalar>(pivot: T, bound: T) -> Result<(), SmallPivot<T>> {
    if pivot > bound { Ok(()) } else { Err(SmallPivot { pivot, bound }) }
}

impl<T: Scalar> System<T> {
    /// Solves the system.
    #[inline]
    pub(crate) fn solve(&self, scale: &Scale<T>) -> Result<Solution<T>, SmallPivot<T>> {
        let (solution, pivots) = self.solved();
        let (share, (mass, [x, y, z])) = (T::from_f64(WELL_SCALED), *scale);
        let (mass, x, y, z) = (share * mass, share * x, share * y, share * z);
        let [a, b, c, d, e, f] = pivots;
        if !(a > mass && b > mass && c > mass && d > x && e > y && f > z) {
            self.check_pivots(pivots, scale)?;
        }
        Ok(solution)
    }

    /// Checks each pivot against its scale, grown by the rounding of those before it.
    #[cold]
    fn check_pivots(&self, pivots: Pivots<T>, scale: &Scale<T>) -> Result<(), SmallPivot<T>> {
        let mut pivots = pivots.into_iter().zip(self.grown_scales(scale));
        pivots.try_for_each(|(pivot, scale)| check_pivot(pivot, bound(scale)))
    }
}

impl<T: Real> System<T> {
    /// What is left without `other`.
    #[inline(always)]
    pub(crate) fn less(&self, other: &Self) -> Self {
        let ([x, y, z], [ox, oy, oz]) = (self.m_vw, other.m_vw);
        Self {
            m_vv: self.m_vv.less(other.m_vv),
            m_vw: [sub(x, ox), sub(y, oy), sub(z, oz)],
            m_ww: self.m_ww.less(other.m_ww),
            h_v: sub(self.h_v, other.h_v),
            h_w: sub(self.h_w, other.h_w),
        }
    }

    /// Factors of rows one to three, rows four to six of L by columns, factors of the Schur
    /// complement.
    #[inline(always)]
    fn factorised(&self) -> (Factors<T>, Columns<T>, Factors<T>) {
        let vv = Factors::of(&self.m_vv);

        // Rows four to six of L times D, and of L: f = L_vv^-1 M_vw, z = D_vv^-1 f.
        let f = map(self.m_vw, |column| vv.forward(column));
        let z = map(f, |column| vv.divide(column));
        let [fx, fy, fz] = f;
        let [zx, zy, zz] = z;
        let schur = Symmetric {
            xx: self.m_ww.xx - dot(fx, zx),
            xy: self.m_ww.xy - dot(fx, zy),
            xz: self.m_ww.xz - dot(fx, zz),
            yy: self.m_ww.yy - dot(fy, zy),
            yz: self.m_ww.yz - dot(fy, zz),
            zz: self.m_ww.zz - dot(fz, zz),
        };
        (vv, z, Factors::of(&schur))
    }

    /// Scale of each pivot: what is rounded in M, as it comes together in that pivot.
    ///
    /// Pivot k is `v · M v` with `Lᵀ v = e_k`, so rounding of `M_ii` counts `v_i²` times. Small
    /// pivots before it make v long.
    #[inline(always)]
    pub(crate) fn grown_scales(&self, scales: &Scale<T>) -> [T; 6] {
        let (vv, z, ww) = self.factorised();
        let (mass, moments) = *scales;
        let weighed = |weights: Vec3<T>, v: Vec3<T>| {
            weights[0] * (v[0] * v[0]) + weights[1] * (v[1] * v[1]) + weights[2] * (v[2] * v[2])
        };
        let [a, b, c] = map(vv.columns(), |v| weighed([mass; 3], v));
        let [first, second, third] = ww.columns();
        // Of each only what was eliminated before it: what follows a pivot of zero is no number.
        let [zx, zy, _] = z;
        let before = [zx, add(scale(second[0], zx), zy), rotate(&z, third)];
        let [x, y, z] = map(before, |coupled| weighed([mass; 3], vv.backward(coupled)));
        let own = map([first, second, third], |v| weighed(moments, v));
        [a, b, c, x + own[0], y + own[1], z + own[2]]
    }

    /// The solution, valid only if each of the pivots, in order, exceeds the bound of its scale.
    #[inline(always)]
    pub(crate) fn solved(&self) -> (Solution<T>, Pivots<T>) {
        let (vv, z, ww) = self.factorised();
        let [zx, zy, zz] = z;
        let y_v = vv.forward(self.h_v);
        let y_w = ww.forward(sub(self.h_w, [dot(zx, y_v), dot(zy, y_v), dot(zz, y_v)]));
        let omega_dot = ww.backward(ww.divide(y_w));
        let [x, y, z] = omega_dot;
        let coupled = [
            zx[0] * x + zy[0] * y + zz[0] * z,
            zx[1] * x + zy[1] * y + zz[1] * z,
            zx[2] * x + zy[2] * y + zz[2] * z,
        ];
        let r_b_n_ddot = vv.backward(sub(vv.divide(y_v), coupled));
        let ([a, b, c], [d, e, f]) = (vv.pivots, ww.pivots);
        (Solution { r_b_n_ddot, omega_dot }, [a, b, c, d, e, f])
    }
}

/// `L D L^T` of a symmetric 3x3 block: `L` below its unit diagonal, reciprocals of `D`.
struct Factors<T> {
    l_21: T,
    l_31: T,
    l_32: T,
    pivots: Vec3<T>,
    reciprocals: Vec3<T>,
}

impl<T: Real> Factors<T> {
    /// Factorises `a`.
    #[inline(always)]
    fn of(a: &Symmetric<T>) -> Self {
        let d_1 = a.xx;
        let r_1 = d_1.recip();
        let (l_21, l_31) = (a.xy * r_1, a.xz * r_1);

        let d_2 = a.yy - l_21 * a.xy;
        let r_2 = d_2.recip();
        let below = a.yz - l_31 * a.xy;
        let l_32 = below * r_2;

        let d_3 = a.zz - l_31 * a.xz - l_32 * below;
        let reciprocals = [r_1, r_2, d_3.recip()];
        Self { l_21, l_31, l_32, pivots: [d_1, d_2, d_3], reciprocals }
    }

    /// `L^-1 b`.
    #[inline(always)]
    fn forward(&self, b: Vec3<T>) -> Vec3<T> {
        let y_2 = b[1] - self.l_21 * b[0];
        let y_3 = b[2] - self.l_31 * b[0] - self.l_32 * y_2;
        [b[0], y_2, y_3]
    }

    /// `D^-1 b`.
    #[inline(always)]
    fn divide(&self, b: Vec3<T>) -> Vec3<T> {
        let [r_1, r_2, r_3] = self.reciprocals;
        [b[0] * r_1, b[1] * r_2, b[2] * r_3]
    }

    /// The columns of `L^-T`.
    #[inline(always)]
    fn columns(&self) -> Columns<T> {
        let (zero, one) = (self.l_21.like(0.0), self.l_21.like(1.0));
        let last = [self.l_21 * self.l_32 - self.l_31, -self.l_32, one];
        [[one, zero, zero], [-self.l_21, one, zero], last]
    }

    /// `L^-T b`.
    #[inline(always)]
    fn backward(&self, b: Vec3<T>) -> Vec3<T> {
        let x_2 = b[1] - self.l_32 * b[2];
        let x_1 = b[0] - self.l_21 * x_2 - self.l_31 * b[2];
        [x_1, x_2, b[2]]
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Matrix6, Vector6};

    use super::*;

    /// Backward error of a 6x6 solve in units of `|M| |x| + |h|`: some operations per element.
    const BACKWARD: f64 = 20.0 * f64::EPSILON;

    fn system(m: &Matrix6<f64>, h: &Vector6<f64>) -> System<f64> {
        let block = |r: usize, c: usize| m.fixed_view::<3, 3>(r, c).into_owned();
        let part = |r: usize| [h[r], h[r + 1], h[r + 2]];
        System {
            m_vv: Symmetric::part_of(&block(0, 0)),
            m_vw: crate::numbers::vec3::columns(&block(0, 3)),
            m_ww: Symmetric::part_of(&block(3, 3)),
            h_v: part(0),
            h_w: part(3),
        }
    }

    fn scale_of(m: &Matrix6<f64>) -> Scale<f64> {
        let mass = (0..3).fold(0.0, |sum: f64, k| sum.max(m[(k, k)]));
        (mass, [m[(3, 3)], m[(4, 4)], m[(5, 5)]])
    }

    fn solve(m: &Matrix6<f64>, h: &Vector6<f64>) -> Result<Vector6<f64>, SmallPivot<f64>> {
        let Solution { r_b_n_ddot: [x, y, z], omega_dot: [p, q, r] } =
            system(m, h).solve(&scale_of(m))?;
        Ok(Vector6::new(x, y, z, p, q, r))
    }

    /// Integers, unsymmetric on purpose; `G^T G + 1` is positive definite and exact.
    fn definite() -> Matrix6<f64> {
        let g =
            Matrix6::from_fn(|r, c| f64::from(u8::try_from((3 * r + 5 * c * c + 1) % 7).unwrap()));
        g.transpose() * g + Matrix6::identity()
    }

    #[test]
    fn integer_system_gives_back_its_integer_solution() {
        let x = Vector6::new(1.0, -2.0, 3.0, -4.0, 5.0, -6.0);
        let m = definite();
        let h = m * x;
        let solution = solve(&m, &h).unwrap();
        // Forward error: the backward error times a condition number of some thousands.
        assert!((solution - x).amax() <= 1e-10, "{solution}");
        let residual = (m * solution - h).abs();
        let scale = m.abs() * solution.abs() + h.abs();
        assert!(residual.iter().zip(&scale).all(|(r, s)| *r <= BACKWARD * s), "{residual}");
    }

    #[test]
    fn diagonal_system_is_solved_exactly() {
        let m = Matrix6::from_diagonal(&Vector6::new(1.0, 2.0, 4.0, 8.0, 16.0, 32.0));
        let h = Vector6::new(3.0, 3.0, 3.0, 3.0, 3.0, 3.0);
        let solution = solve(&m, &h).unwrap();
        assert_eq!(solution, Vector6::new(3.0, 1.5, 0.75, 0.375, 0.1875, 0.09375));
    }

    #[test]
    fn singular_system_is_rejected_at_each_pivot() {
        for zeroed in 0..6 {
            let mut m = Matrix6::identity() * 2.0;
            m[(zeroed, zeroed)] = 0.0;
            let rejected = solve(&m, &Vector6::zeros());
            assert!(matches!(rejected, Err(SmallPivot { pivot: 0.0, .. })), "pivot {zeroed}");
        }
        // A point mass off B: no inertia about the line from B to it.
        let r = nalgebra::Vector3::new(0.0, 0.0, 3.0);
        let s = r.cross_matrix();
        let mut m = Matrix6::identity();
        m.fixed_view_mut::<3, 3>(0, 3).copy_from(&-s);
        m.fixed_view_mut::<3, 3>(3, 0).copy_from(&s);
        m.fixed_view_mut::<3, 3>(3, 3).copy_from(&(-s * s));
        assert!(solve(&m, &Vector6::zeros()).is_err());
    }

    #[test]
    fn rounding_that_a_small_pivot_before_it_makes_grow_is_rejected() {
        // 1 - n nᵀ with n nearly in the plane of the first two axes: the second pivot is small.
        let n = nalgebra::Vector3::new(0.6, 0.8, 3e-3).normalize();
        let mut m = Matrix6::identity();
        let block = (nalgebra::Matrix3::identity() - n * n.transpose()) * 0.3;
        m.fixed_view_mut::<3, 3>(3, 3).copy_from(&block);
        let system = system(&m, &Vector6::zeros());
        let [.., fifth, sixth] = system.solved().1;
        assert!(fifth < 1e-4 && sixth.abs() < 1e-9);
        let [.., grown] = system.grown_scales(&scale_of(&m));
        assert!(grown > 1e4 * 0.3, "{grown}");
        assert!(solve(&m, &Vector6::zeros()).is_err());
        // Its own scale is that of the row where nothing is coupled.
        let diagonal = Matrix6::from_diagonal(&Vector6::new(1.0, 2.0, 3.0, 4.0, 5.0, 6.0));
        let scales = self::system(&diagonal, &Vector6::zeros()).grown_scales(&scale_of(&diagonal));
        assert_eq!(scales, [3.0, 3.0, 3.0, 4.0, 5.0, 6.0]);
    }

    #[test]
    fn pivot_that_is_rounding_of_its_scale_is_rejected() {
        let bound = bound(1.0);
        assert_eq!(bound, 64.0 * f64::EPSILON);
        assert_eq!(check_pivot(bound, bound), Err(SmallPivot { pivot: bound, bound }));
        assert_eq!(check_pivot(2.0 * bound, bound), Ok(()));
        assert_eq!(check_pivot(1e-300, super::bound(1e-290)), Ok(()));
    }

    #[test]
    fn pivot_that_is_not_a_number_is_rejected() {
        assert!(check_pivot(f64::NAN, 1.0).is_err());
        assert!(check_pivot(1.0, f64::NAN).is_err());
        let mut m = Matrix6::identity();
        m[(4, 4)] = f64::NAN;
        assert!(solve(&m, &Vector6::zeros()).is_err());
    }
}
