//! Accelerations for a state and inputs: elimination of the joints device by device, the hub's system, back
//! substitution.
//!
//! [`accelerations`] is the entry, [`device`] the share of one device, [`system`] the hub's six equations.

pub(crate) mod accelerations;
pub(crate) mod arithmetic;
pub(crate) mod assembly;
pub(crate) mod device;
pub(crate) mod error;
pub(crate) mod finite;
pub(crate) mod gravity;
pub(crate) mod inputs;
#[cfg(test)]
mod overflow_checks;
pub(crate) mod pivot_bound;
pub(crate) mod stability;
pub(crate) mod state;
pub(crate) mod system;
