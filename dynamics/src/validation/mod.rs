//! Checks of parameters, and wheel imbalance as catalogues state it.
//!
//! A spacecraft is made only of parameters that passed.

pub(crate) mod check;
#[cfg(test)]
mod check_checks;
pub(crate) mod imbalance;
#[cfg(test)]
mod imbalance_checks;
pub(crate) mod imbalance_error;
pub(crate) mod parameter_error;
