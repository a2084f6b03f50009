//! Several numbers at a time, in the registers of the CPU at hand. Needs the feature `lanes`.
//!
//! | to evaluate | use | result |
//! |---|---|---|
//! | one state after another, few devices | [`Spacecraft`](crate::Spacecraft) | |
//! | the same, product and sum rounded once | [`Spacecraft::fused`] | to rounding |
//! | one state after another, four or more devices of one kind | [`AcrossDevices`] | to rounding |
//! | many states of one spacecraft, or their runs | [`Batch`] | to the bit |
//! | the same, product and sum rounded once | [`Batch::fused`] | to rounding |
//! | many spacecraft of one shape, each at its state | [`ParameterBatch`] | to the bit |
//! | the same, product and sum rounded once | [`ParameterBatch::fused`] | to rounding |
//!
//! [`Spacecraft::fused`]: crate::Spacecraft::fused
//!
//! Registers are chosen at run time, AVX-512, AVX2 with FMA, NEON, or single numbers: a portable
//! build reaches them. State, inputs, accelerations and errors are those of `Spacecraft`.
//!
//! Lanes support every kind, arrays and tuples; every mode of a joint; springs and dampers; a
//! uniform field. Unsupported in lanes are a central field, wrenches on bodies, dry friction, the
//! lumped model of an imbalance, and coordinates and rates of joints beyond `2^24`; in a batch also
//! a hub that is not free and quaternions far from unit length. They fall back to the scalar
//! path. So does whatever fails in a lane, which is how its error is found; the other lanes keep
//! their results.
//!
//! Everything down to the arithmetic is part of the one function that may use the instructions. A
//! call that is not inlined costs more than what it calls, so there are plain loops and emitted
//! field-by-field functions here where elsewhere stand iterators.

mod across;
mod batch;
mod batch_inputs;
mod constants;
mod crafts;
mod evaluate;
mod gather;
mod lane;
mod motion;
mod number;
mod parameter_batch;
mod run;
mod slot;
mod states;
mod width;

pub use across::AcrossDevices;
pub use batch::{Batch, BatchAccelerations};
pub use batch_inputs::BatchInputs;
pub use parameter_batch::ParameterBatch;
pub use slot::LanedSet;
