//! Derivatives of a step of RK4.

pub(crate) mod along;
mod by_devices;
pub(crate) mod device_chain;
pub(crate) mod hub_accelerations;
pub(crate) mod linearization;
pub(crate) mod stage_chain;
pub(crate) mod stage_product;
mod workspace;
