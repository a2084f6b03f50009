//! What follows from a solution: loads at every joint and mount, momenta and energy, the energy
//! ledger.
//!
//! Evaluated only where they are called for; a step does not pass here.

pub(crate) mod carried_loads;
pub(crate) mod ledger;
pub(crate) mod loads;
pub(crate) mod momentum;
pub(crate) mod structure;
