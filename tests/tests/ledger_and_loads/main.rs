//! The ledger of mixed spacecraft: where the energy goes, what joints and mounts carry, what a
//! dynamometer reads, what gravity does. Against laws and Newton's own, with no emitted kernel on the
//! other side.
//!
//! Run with `--nocapture` to see the figures.

mod blocked;
mod bounds;
mod craft;
mod draw;
mod gravity;
mod loads;
mod orbit;
mod pointwise;
mod random;
mod rates;
mod run;
mod runs;
mod simplified;
mod kinematics;
