//! Attitude parameterisations: quaternions and modified Rodrigues parameters.
//!
//! [`Attitude`](parameterisation::Attitude) is what a step needs of either.

#[cfg(test)]
mod attitude_tests;
pub(crate) mod mrp;
pub(crate) mod parameterisation;
pub(crate) mod quaternion;
