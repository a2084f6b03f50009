//! What a rotor does, followed on board from sample to sample: [`LineTracker`] its imbalance, [`DragTracker`] its drag torque.
//!
//! Memory is fixed, nothing is allocated, nothing panics, and a sample takes the same operations whatever its numbers are, but
//! for one that is rejected or does not determine anything yet. The same inputs give the same bits on every host. A crate of its
//! own: the flight library links it, which has no heap.

#![no_std]

mod drag;
mod error;
mod line;
mod recursion;

pub use drag::{DragEstimate, DragSample, DragTracker};
pub use error::TrackerError;
pub use line::{LineEstimate, LineTracker};
