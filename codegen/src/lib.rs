//! Geometry to expression graph to emitted text: the derivation of Precess.

pub mod graph;
pub mod normal;
pub mod page;
pub mod space;
