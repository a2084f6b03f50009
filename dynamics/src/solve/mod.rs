//! A spacecraft, its state and inputs, and the accelerations that follow.
//!
//! [`accelerations`] is the entry: eliminate every device, solve the hub's system, substitute back.

pub(crate) mod accelerations;
pub(crate) mod diagnosis;
pub(crate) mod elimination;
pub(crate) mod finite;
pub(crate) mod inputs;
#[cfg(test)]
mod overflow_tests;
#[cfg(feature = "lanes")]
pub(crate) mod row_substitution;
#[cfg(feature = "lanes")]
pub(crate) mod rows;
pub(crate) mod spacecraft;
#[cfg(test)]
mod spacecraft_tests;
pub(crate) mod state;
pub(crate) mod structure;
