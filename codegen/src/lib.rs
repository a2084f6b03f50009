//! Geometry to expression graph to emitted text: the derivation of Precess, and its proof.

pub mod derivation;
pub mod emit;
mod external_kind;
pub mod graph;
pub mod kernel;
pub mod kinds;
pub mod normal;
pub mod page;
pub mod proof;
pub mod space;
pub mod threads;
pub mod unit;

pub use external_kind::{emit_kind, prove_kind};

/// The page whose Rust blocks are compiled and run as documentation tests.
#[cfg(doctest)]
mod pages {
    #[doc = include_str!("../../docs/adding-a-kind.md")]
    struct AddingAKind;
}
