//! Several numbers at a time, in the registers of the CPU at hand. Needs the feature `lanes`.
//!
//! | to evaluate | use |
//! |---|---|
//! | one state | [`Spacecraft`](crate::Spacecraft) |
//! | many states, or their runs, of one spacecraft or of one each | [`Batch`] |
//! | their runs, recorded or reduced on the way | `run_observed`, with [`Observers`] |
//! | a batch on several threads, with the feature `threads` | `on_threads` |
//!
//! All have the same bits.
//!
//! Registers are chosen at run time, AVX-512 with the feature `avx512`, AVX2 with FMA, or NEON: a portable
//! build reaches them. On another CPU batches take the scalar path. State, inputs, accelerations and
//! errors are those of `Spacecraft`.
//!
//! Lanes support every kind, arrays, tuples and vectors; every mode of a joint; springs, dampers and dry
//! friction; wrenches on bodies; a uniform and a central field; the lumped model of an imbalance.
//! Unsupported in lanes are coordinates and rates of joints beyond `2^24`; in a batch also a hub
//! that is not free, quaternions far from unit length, a central body nearer than 5e-32 m or
//! farther than 2e31 m, steps in which a joint with dry friction comes to rest or reverses, and
//! steps that a single step looks at closer for its springs and friction. They fall back to the
//! scalar path: of a run, at most 32 steps at a time. So does whatever fails in a lane, which is how
//! its error is found; the other lanes keep their results. So do groups of spacecraft of which one has
//! a vector of another length than the first of the batch: all of them, for the whole run.
//!
//! A `Batch` takes no flexible structure, no isolated platform, no `BuiltIn`, no `Option` of a device, no
//! attitude but a `Quaternion`, and no `f32`: evaluate these by `Spacecraft`, one state after another.
//!
//! Wrenches, a central field, the lumped model and dry friction are computed before the elimination,
//! for those groups of lanes of which one has them: where none has, they cost nothing.
//!
//! On several threads a batch is split where groups of lanes begin. Which states share lanes, and
//! which thread evaluates them, changes no number: results do not depend on the number of threads.
//!
//! Everything down to the arithmetic is part of the one function that may use the instructions. A
//! call that is not inlined costs more than what it calls, so there are plain loops and emitted
//! field-by-field functions here instead of iterators.

mod accelerations;
mod batch;
mod batch_inputs;
mod batch_spacecraft;
mod calls;
mod constants;
mod evaluate;
mod fallback;
#[cfg(test)]
mod fallback_tests;
mod group;
mod laned_set;
mod loads;
mod motion;
mod observers;
mod part;
mod run;
mod scratch;
mod slot;
mod states;

pub use batch::{Batch, BatchAccelerations};
pub use batch_inputs::BatchInputs;
pub use laned_set::LanedSet;
pub use observers::Observers;
