//! Checks of parameters, and wheel imbalance as catalogues state it.
//!
//! A spacecraft is made only of parameters that passed.

pub(crate) mod check;
#[cfg(test)]
mod check_tests;
pub(crate) mod imbalance;
pub(crate) mod imbalance_error;
#[cfg(test)]
mod imbalance_tests;
pub(crate) mod parameter_error;
