//! Derivatives of accelerations, momenta and loads by state, inputs and parameters, exact to
//! rounding: those of accelerations by the emitted derivatives of the loads, others by the solver over
//! [`Dual`](crate::Dual) numbers, through the same kernels.
//!
//! [`evaluation`] computes columns without a heap, [`parameters`] those by parameters;
//! `linearization`, with the feature `alloc`, fills matrices with them, `step` carries them through a
//! step. `products` has the derivatives along a direction and of a weighted sum, without matrices. Of accelerations
//! `linearization` and `step` need no dual numbers: `by_loads` has the columns of devices on a rigid hub in a uniform
//! field from the emitted derivatives of the loads (`load_columns`) and the mass matrix (`mass_system`); `by_tree` has
//! them with carriers and flexible structures, and under wrenches on bodies, in a central field and with lumped imbalance
//! (`device_loads`, `applied_columns`, `base_motion`, `tree_members`, `tree_system`). Where `by_loads` has columns,
//! `products` (`load_products`, `mass_solution`) and [`parameters`] need no dual numbers either, the latter also under
//! wrenches on bodies: `parameter_loads` has the loads of one device change with its bodies (`device_motion`,
//! `rigid_body`).

#[cfg(feature = "alloc")]
mod applied_columns;
#[cfg(feature = "alloc")]
pub(crate) mod base_motion;
#[cfg(feature = "alloc")]
mod by_loads;
#[cfg(feature = "alloc")]
mod by_tree;
pub(crate) mod column;
pub(crate) mod device_kernel;
#[cfg(feature = "alloc")]
mod device_loads;
#[cfg(feature = "alloc")]
mod device_motion;
mod elimination;
#[cfg(feature = "alloc")]
mod emitted;
pub(crate) mod error;
pub(crate) mod evaluation;
#[cfg(feature = "alloc")]
mod field_columns;
mod joint_order;
#[cfg(feature = "alloc")]
pub(crate) mod linearization;
#[cfg(feature = "alloc")]
pub(crate) mod load_columns;
mod load_products;
mod mass_solution;
#[cfg(feature = "alloc")]
mod mass_system;
#[cfg(feature = "alloc")]
pub(crate) mod modal_columns;
mod parameter_change;
#[cfg(feature = "alloc")]
mod parameter_loads;
pub(crate) mod parameters;
mod point;
mod products;
#[cfg(feature = "alloc")]
mod rigid_body;
#[cfg(feature = "alloc")]
mod slopes;
#[cfg(feature = "alloc")]
mod stage_chain;
#[cfg(feature = "alloc")]
mod stage_product;
#[cfg(feature = "alloc")]
pub(crate) mod step;
pub(crate) mod structure;
#[cfg(feature = "alloc")]
mod tree_changes;
#[cfg(feature = "alloc")]
mod tree_mass;
#[cfg(feature = "alloc")]
pub(crate) mod tree_members;
#[cfg(feature = "alloc")]
mod tree_system;
mod turned;
pub(crate) mod variable;
mod with_numbers;
