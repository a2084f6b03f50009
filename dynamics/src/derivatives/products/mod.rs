//! Derivatives of accelerations along a direction and of a weighted sum, without matrices.

mod device_products;
pub(crate) mod joint_order;
pub(crate) mod jvp_and_vjp;
pub(crate) mod load_products;
pub(crate) mod mass_solution;
#[cfg(feature = "lanes")]
mod products_in_lanes;
