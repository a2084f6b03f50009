//! Estimates of the stiffness of springs, dampers and dry friction, from the pivots of an
//! evaluation; [`stability`](crate::integrate::stability) compares them with the limit of a step.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use crate::equations::system::{Pivots, Scale};
use crate::model::kernels::Kernels;
use crate::model::mode::Drive;
use crate::numbers::real::{Real, Scalar};

/// `damping * dt`, and `spring * dt²`, up to which a step needs no closer look. The stability limit
/// is eleven times this, and more than thirty times.
pub(crate) const ACCEPTED: f64 = 0.25;

/// Estimates of the sums over all joints of `a`, 1/s, and `b`, 1/s², from pivots.
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
    /// and its mode. How much a joint's response grows because its parents move shows in how far
    /// their pivots are below their diagonals.
    #[inline(always)]
    pub(crate) fn add<K: Kernels>(
        &mut self,
        coefficients: &K::PerJoint<[T; 2]>,
        pivots: &K::PerJoint<Option<[T; 2]>>,
        drives: &K::PerJoint<Drive<T>>,
    ) {
        let (mut damping, mut spring) = (self.damping.like(0.0), self.damping.like(0.0));
        let mut growth = damping;
        let joints = K::zip_per_joint(pivots, drives, response::<T>);
        K::zip_per_joint(coefficients, &joints, |[c, k], [response, over_pivot]| {
            (damping, spring) = (damping + c * response, spring + k * response);
            growth = growth + over_pivot;
            growth
        });
        self.damping = self.damping + damping * growth;
        self.spring = self.spring + spring * growth;
    }

    /// The same where the hub moves: the response grows with it, which shows in the hub's pivots.
    #[inline(always)]
    pub(crate) fn on_free_hub(self, pivots: Pivots<T>, (mass, [x, y, z]): Scale<T>) -> Self {
        let [a, b, c, d, e, f] = pivots;
        let of_mass = mass * (a.recip() + b.recip() + c.recip());
        let growth = of_mass + x * d.recip() + y * e.recip() + z * f.recip();
        let growth = growth * growth.like(1.0 / 6.0);
        Self { damping: self.damping * growth, spring: self.spring * growth }
    }
}

/// A joint's response to a unit torque, parents held, and diagonal over pivot; zero unless driven.
#[inline(always)]
fn response<T: Real>(pivot: Option<[T; 2]>, drive: Drive<T>) -> [T; 2] {
    let Some([pivot, diagonal]) = pivot else { return [drive.driven.like(0.0); 2] };
    // As in the kernel: of a joint that is not driven the pivot may be zero.
    let response = drive.driven * (pivot + drive.held).recip();
    [response, diagonal * response]
}

impl<T: Scalar> Stiffness<T> {
    /// The larger of both estimates.
    pub(crate) fn max(self, other: Self) -> Self {
        Self { damping: self.damping.max(other.damping), spring: self.spring.max(other.spring) }
    }

    /// Whether a step is far below the limit; NaN is not.
    pub(crate) fn accepts(&self, dt: T) -> bool {
        let (dt, accepted) = (dt.abs(), T::from_f64(ACCEPTED));
        self.damping * dt <= accepted && self.spring * dt * dt <= accepted
    }
}
