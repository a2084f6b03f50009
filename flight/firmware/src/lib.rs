//! What the bare-metal programs share: seeded spacecraft of every kind, runs of them printed as
//! bits, and the boards they run on.
//!
//! One source for every target: on this machine the same text is an ordinary program, whose output
//! is what a board has to print. Nothing here allocates; `unsafe` is only in [`board`].

#![cfg_attr(target_os = "none", no_std)]
// LEON3 is a SPARC, whose inline assembly is not stable yet.
#![cfg_attr(target_arch = "sparc", feature(asm_experimental_arch))]

pub mod bits;
pub mod board;
pub mod conformance;
// The timer is a Cortex-M's.
#[cfg(any(feature = "count", feature = "count-linearization"))]
pub mod count;
pub mod craft;
pub mod devices;
pub mod random;
pub mod sets;
pub mod structure;
