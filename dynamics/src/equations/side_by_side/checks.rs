//! Where an elimination in lanes holds: angles whose sine is right, pivots above their bounds.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use crate::model::kernels::Kernels;
use crate::model::mode::Drive;
use crate::numbers::laned::Number;
use crate::numbers::sincos::LARGEST_ANGLE;

/// Where every angle is one whose sine is right.
#[inline(always)]
pub(crate) fn within_reach<K: Kernels, T: Number>(like: T, joints: &K::Joints<T>) -> T::Holds {
    let (limit, mut holds) = (like.like(LARGEST_ANGLE), like.same(like));
    K::zip_joints(joints, joints, |number, _| {
        holds = like.both(holds, limit.above(number.abs()));
        number
    });
    holds
}

/// Where the pivot of each joint that is driven exceeds its bound.
#[inline(always)]
pub(crate) fn regular<K: Kernels, T: Number>(
    like: T,
    eliminated: &K::Eliminated<T>,
    drives: &K::PerJoint<Drive<T>>,
    bound: &K::PerJoint<T>,
) -> T::Holds {
    let (zero, mut holds) = (like.like(0.0), like.same(like));
    // Named functions, since a closure of this size is not inlined.
    let margins = K::zip_per_joint(&K::pivots(eliminated), bound, margin::<T>);
    let margins = K::zip_per_joint(&margins, drives, of_driven::<T>);
    K::zip_per_joint(&margins, &margins, |margin, _| {
        holds = like.both(holds, margin.above(zero));
        zero
    });
    holds
}

/// By how much the pivot of a joint is above its bound; one for a joint without a pivot.
#[inline(always)]
fn margin<T: Number>(pivot: Option<[T; 2]>, bound: T) -> T {
    pivot.map_or(bound.like(1.0), |[pivot, _]| pivot - bound)
}

/// A margin; one where the joint is not driven.
#[inline(always)]
fn of_driven<T: Number>(margin: T, drive: Drive<T>) -> T {
    drive.driven.like(1.0).or(drive.driven.same(drive.driven.like(0.0)), margin)
}
