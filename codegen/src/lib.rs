//! Geometry to expression graph to emitted text: the derivation of Precess.

pub mod derivation;
pub mod emit;
pub mod graph;
pub mod kernel;
pub mod kinds;
pub mod normal;
pub mod page;
pub mod proof;
pub mod regen;
pub mod space;
pub mod verdict;
