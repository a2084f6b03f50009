//! The proofs, one row each: exact equality of normal forms, or the terms that differ.

mod assumed;
mod comparison;
mod emitted;
mod factors;
mod kernel_pages;
mod kind;
mod laws;
mod modes;
mod mounted;
mod pages;
mod potential;
mod read_back;
mod stages;
mod unknowns;

pub use assumed::prove_assumed;
pub use comparison::{Comparison, Verdict};
pub use emitted::Prover;
pub use kernel_pages::KernelPages;
pub use kind::prove_kind;
pub use pages::{against_block, against_pages, zero_traces};
pub use read_back::EmittedError;
