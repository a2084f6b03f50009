//! The proofs, one row each: exact equality of normal forms, or the terms that differ.

mod emitted;
mod pages;
mod row;

pub use emitted::{EmittedError, Prover};
pub use pages::{against_pages, zero_traces};
pub use row::{Row, Verdict};
