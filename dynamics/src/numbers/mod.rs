//! Number traits, dual numbers, sines and cosines, vectors and symmetric tensors, lanes of numbers.
//!
//! Nothing here knows of a spacecraft. Everything above computes with these.

pub(crate) mod dual;
pub(crate) mod each;
#[cfg(feature = "lanes")]
pub(crate) mod lane;
#[cfg(feature = "lanes")]
pub(crate) mod laned;
mod map_and_zip;
pub(crate) mod real;
pub(crate) mod sincos;
#[cfg(test)]
mod sincos_tests;
pub(crate) mod symmetric;
pub(crate) mod vec3;
