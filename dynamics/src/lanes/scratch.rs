//! Slots that a thread keeps from one call of a batch to the next, until it evaluates another shape or ends.
//!
//! Invariant: an evaluation writes every number of a slot before it reads it, or rejects the lane. So what a call leaves in
//! them reaches no result of the next.
//!
//! Those of 64 DGVSCMGs take half a megabyte. An allocator that returns as much to the system at the
//! end of each call has every page of it mapped again in the next one, which took longer than the
//! evaluation of 64 states.

use core::any::Any;
use core::cell::Cell;
use std::boxed::Box;

use super::laned_set::LanedSet;
use super::slot::{Slots, SlotsOf, forget_constants};
use crate::numbers::laned::Number;

std::thread_local! {
    /// The slots of the last call of a batch on this thread.
    static KEPT: Cell<Option<Box<dyn Any>>> = const { Cell::new(None) };
}

/// Slots for these devices: those of the last call if they have the same shape, with the numbers that
/// it left in them.
#[inline(never)]
pub(super) fn take<D: LanedSet, T: Number>(devices: &D::Prepared, zero: T) -> SlotsOf<D, T> {
    let kept = KEPT.try_with(Cell::take).ok().flatten();
    match kept.and_then(|kept| kept.downcast::<SlotsOf<D, T>>().ok()) {
        Some(slots) if D::fits::<Slots<T>>(devices, &slots) => *slots,
        _ => D::new_data(devices, &Slots(zero)),
    }
}

/// Keeps slots for the next call, without the constants of a group of spacecraft.
#[inline(never)]
pub(super) fn keep<D: LanedSet, T: Number>(devices: &D::Prepared, mut slots: SlotsOf<D, T>) {
    forget_constants::<D, T>(devices, &mut slots);
    let slots: Box<dyn Any> = Box::new(slots);
    // A thread that ends keeps none.
    let _ = KEPT.try_with(|kept| kept.set(Some(slots)));
}
