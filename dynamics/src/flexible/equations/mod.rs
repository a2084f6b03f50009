//! Accelerations of a flexible structure: motion of the mounts, equations of the devices condensed onto hub and modal
//! coordinates, one factorisation; what is checked and computed once before.

pub(crate) mod accelerations;
pub(crate) mod basis;
pub(crate) mod block;
pub(crate) mod check;
pub(crate) mod condense;
pub(crate) mod devices;
pub(crate) mod factor;
pub(crate) mod gravity;
pub(crate) mod mount;
pub(crate) mod residual;
pub(crate) mod spacecraft;
pub(crate) mod stability;
pub(crate) mod turn;
