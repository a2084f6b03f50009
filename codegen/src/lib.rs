//! Geometry to expression graph to emitted text: the derivation of Precess.

pub mod consequence;
pub mod derivation;
pub mod emit;
pub mod graph;
pub mod kernel;
pub mod kinds;
pub mod mutation;
pub mod normal;
pub mod notation;
mod outside;
pub mod page;
pub mod proof;
pub mod regen;
pub mod report;
pub mod space;
mod threads;
pub mod verdict;

pub use outside::{emit_kind, prove_kind};
