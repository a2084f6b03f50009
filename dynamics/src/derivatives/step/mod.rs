//! Derivatives of a step of RK4.

pub(crate) mod along;
pub(crate) mod linearization;
pub(crate) mod stage_chain;
pub(crate) mod stage_product;
mod workspace;
