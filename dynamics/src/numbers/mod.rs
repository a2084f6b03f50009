//! Number traits, sines and cosines, vectors and symmetric tensors.
//!
//! Nothing here knows of a spacecraft. Everything above computes with these.

pub(crate) mod each;
pub(crate) mod real;
pub(crate) mod sincos;
#[cfg(test)]
mod sincos_checks;
pub(crate) mod symmetric;
pub(crate) mod vec3;
