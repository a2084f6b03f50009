//! Numbers of several joints or devices, side by side in lanes.
//!
//! A register is put together from registers. Written to memory one by one and read back at once,
//! its numbers would have to wait for each other.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use crate::model::kernels::Kernels;
use crate::model::kind::Kind;
use crate::numbers::laned::{Block, Number, WIDEST};
use crate::numbers::real::Scalar;

/// Numbers for the lower or the upper half of the widest lanes.
type Half = [f64; WIDEST / 2];

/// Coordinates and rates, a device or a state in each lane.
#[inline(always)]
pub(crate) fn joints_in_lanes<K: Kind, T: Number>(
    like: T,
    [a, b, c, d, e, f, g, h]: [&K::Joints<K::Scalar>; WIDEST],
) -> K::Joints<T> {
    let two = |a, b| K::zip_joints(a, b, |a: K::Scalar, b: K::Scalar| [a.to_f64(), b.to_f64()]);
    let four = |a, b, c, d| K::zip_joints(&two(a, b), &two(c, d), |[a, b], [c, d]| [a, b, c, d]);
    let low = four(a, b, c, d);
    let high = if wide::<T>() { four(e, f, g, h) } else { low };
    K::zip_joints(&low, &high, |low, high| joined(like, low, high))
}

/// Accelerations of the joints, a device in each lane.
#[inline(always)]
pub(crate) fn accelerations_in_lanes<K: Kind, T: Number>(
    like: T,
    [a, b, c, d, e, f, g, h]: [&K::Accelerations<K::Scalar>; WIDEST],
) -> K::Accelerations<T> {
    let two =
        |a, b| K::zip_accelerations(a, b, |a: K::Scalar, b: K::Scalar| [a.to_f64(), b.to_f64()]);
    let four =
        |a, b, c, d| K::zip_accelerations(&two(a, b), &two(c, d), |[a, b], [c, d]| [a, b, c, d]);
    let low = four(a, b, c, d);
    let high = if wide::<T>() { four(e, f, g, h) } else { low };
    K::zip_accelerations(&low, &high, |low, high| joined(like, low, high))
}

/// Values at joints, a device or a state in each lane.
#[inline(always)]
pub(crate) fn values_in_lanes<K: Kernels, T: Number>(
    like: T,
    [a, b, c, d, e, f, g, h]: [&K::PerJoint<f64>; WIDEST],
) -> K::PerJoint<T> {
    let two = |a, b| K::zip_per_joint(a, b, |a, b| [a, b]);
    let four = |a, b, c, d| K::zip_per_joint(&two(a, b), &two(c, d), |[a, b], [c, d]| [a, b, c, d]);
    let low = four(a, b, c, d);
    let high = if wide::<T>() { four(e, f, g, h) } else { low };
    K::zip_per_joint(&low, &high, |low, high| joined(like, low, high))
}

/// Whether both halves are wanted.
pub(crate) const fn wide<T: Number>() -> bool {
    T::WIDTH > WIDEST / 2
}

/// Both halves side by side.
#[inline(always)]
pub(crate) fn joined<T: Number>(like: T, [a, b, c, d]: Half, [e, f, g, h]: Half) -> T {
    like.load(&Block([a, b, c, d, e, f, g, h]))
}
