//! Energy ledger, loads and gravity of mixed spacecraft, against conservation laws and Newton and
//! Euler for each body, without emitted kernels in the reference.
//!
//! Run with `--nocapture` to see the figures.

mod blocked;
mod bounds;
mod craft;
mod draw;
mod gravity;
mod kinematics;
mod loads;
mod orbit;
mod pointwise;
mod random;
mod rates;
mod run;
mod runs;
mod simplified;
