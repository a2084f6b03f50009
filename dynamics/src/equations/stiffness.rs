//! Bounds of the stiffness of springs, dampers and dry friction, from the pivots of an evaluation;
//! [`stability`](crate::integrate::stability) compares them with the limit of a step.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use crate::equations::system::{Pivots, Scale};
use crate::model::kernels::Kernels;
use crate::model::mode::Drive;
use crate::numbers::real::{Real, Scalar};

/// `damping * dt`, and `spring * dt²`, up to which a step needs no closer look. The stability limit
/// is eleven times this, and more than twenty-seven times.
pub(crate) const ACCEPTED: f64 = 0.25;

/// Bounds of the largest `c / m`, 1/s, and `k / m`, 1/s², over all motions, from pivots: sums over
/// all joints of damping or stiffness times a bound of the joint's response.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stiffness<T> {
    pub(crate) damping: T,
    pub(crate) spring: T,
}

impl<T: Real> Stiffness<T> {
    /// No spring, no friction.
    #[inline(always)]
    pub(crate) fn none(zero: T) -> Self {
        Self { damping: zero, spring: zero }
    }

    /// Adds the joints of one device: damping and stiffness of each, its pivot with its diagonal,
    /// and its mode.
    ///
    /// With R the mass matrix scaled to unit diagonal, the element of `R⁻¹` on the diagonal of a
    /// joint is a determinant below one over that of R, and `1 / det R` is the product of diagonal
    /// over pivot of all joints. So no joint's response exceeds that to its own pivot, parents
    /// held, times this product.
    #[inline(always)]
    pub(crate) fn add<K: Kernels>(
        &mut self,
        coefficients: &K::PerJoint<[T; 2]>,
        pivots: &K::PerJoint<Option<[T; 2]>>,
        drives: &K::PerJoint<Drive<T>>,
    ) {
        let (mut damping, mut spring) = (self.damping.like(0.0), self.damping.like(0.0));
        let mut growth = self.damping.like(1.0);
        let joints = K::zip_per_joint(pivots, drives, response::<T>);
        K::zip_per_joint(coefficients, &joints, |[c, k], [response, over_pivot]| {
            (damping, spring) = (damping + c * response, spring + k * response);
            growth = growth * over_pivot;
            growth
        });
        self.damping = self.damping + damping * growth;
        self.spring = self.spring + spring * growth;
    }

    /// The same where the hub moves: the product goes on with the hub's own pivots.
    #[inline(always)]
    pub(crate) fn on_free_hub(self, pivots: Pivots<T>, (mass, [x, y, z]): Scale<T>) -> Self {
        let [a, b, c, d, e, f] = pivots;
        let slides = (mass * a.recip()) * (mass * b.recip()) * (mass * c.recip());
        let growth = slides * (x * d.recip()) * (y * e.recip()) * (z * f.recip());
        Self { damping: self.damping * growth, spring: self.spring * growth }
    }
}

/// A joint's response to a unit torque, parents held, and diagonal over pivot; zero and one unless
/// driven.
#[inline(always)]
fn response<T: Real>(pivot: Option<[T; 2]>, drive: Drive<T>) -> [T; 2] {
    let Some([pivot, diagonal]) = pivot else {
        return [drive.driven.like(0.0), drive.driven.like(1.0)];
    };
    // As in the kernel: of a joint that is not driven the pivot may be zero.
    let response = drive.driven * (pivot + drive.held).recip();
    [response, drive.held + diagonal * response]
}

impl<T: Scalar> Stiffness<T> {
    /// The larger of both estimates; one that is infinite or NaN stays.
    pub(crate) fn max(self, other: Self) -> Self {
        let larger = |a: T, b: T| if !a.is_finite() || b <= a { a } else { b };
        Self {
            damping: larger(self.damping, other.damping),
            spring: larger(self.spring, other.spring),
        }
    }

    /// Whether a step is far below the limit; NaN is not.
    pub(crate) fn accepts(&self, dt: T) -> bool {
        let (dt, accepted) = (dt.abs(), T::from_f64(ACCEPTED));
        self.damping * dt <= accepted && self.spring * dt * dt <= accepted
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stiffness_that_is_not_a_number_is_never_accepted() {
        let of = |damping: f64, spring: f64| Stiffness { damping, spring };
        let largest = of(0.0, 0.0).max(of(f64::NAN, 0.0)).max(of(1.0, 2.0));
        assert!(largest.damping.is_nan() && largest.spring == 2.0);
        assert!(!largest.accepts(1e-9));
        let largest = of(0.0, 0.0).max(of(0.0, f64::NAN));
        assert!(largest.spring.is_nan() && !largest.accepts(1e-9));
        let largest = of(3.0, f64::INFINITY).max(of(2.0, 5.0)).max(of(4.0, 1.0));
        assert_eq!((largest.damping, largest.spring), (4.0, f64::INFINITY));
    }
}
