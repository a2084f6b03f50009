//! What follows from a solution: loads at every joint and mount, momenta and energy, the energy
//! ledger, what the devices contribute to a hub that another program has.
//!
//! Evaluated only where they are called for; a step does not pass here.

pub(crate) mod carried_loads;
pub(crate) mod contributions;
pub(crate) mod joint_by_joint;
pub(crate) mod ledger;
pub(crate) mod loads;
pub(crate) mod momentum;
pub(crate) mod structure;
