//! Geometry to expression graph to emitted text: the derivation of Precess.
