//! What is computed for known accelerations: loads, ledger, momenta, the motion of a point, impulsive stops.

pub(crate) mod ledger;
pub(crate) mod loads;
pub(crate) mod momentum;
pub(crate) mod point;
pub(crate) mod stop;
