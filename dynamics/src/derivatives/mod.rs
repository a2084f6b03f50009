//! Derivatives of accelerations, momenta and loads by state, inputs and parameters, exact to
//! rounding: those of accelerations by the emitted derivatives of the loads, others by the solver over
//! [`Dual`](crate::Dual) numbers, through the same kernels.
//!
//! | folder | what |
//! |---|---|
//! | `dual` | columns by dual numbers, without a heap |
//! | `loads` | columns of accelerations of devices on a rigid hub in a uniform field, by the emitted derivatives of the loads and the mass matrix |
//! | `tree` | the same with carriers and flexible structures, and under wrenches on bodies, in a central field and with lumped imbalance |
//! | `products` | derivatives along a direction and of a weighted sum, without matrices |
//! | `parameters` | columns by parameters of hub and devices |
//! | `step` | derivatives of a step of RK4, by the chain rule through its stages |
//!
//! `linearization` fills matrices with columns, with the feature `alloc`: `emitted` has those of accelerations, `slopes`
//! what the slopes of the states change by. `acceleration_derivatives` has only those of accelerations.
//! `fixed_linearization` fills matrices of fixed size, without a heap.

#[cfg(feature = "alloc")]
pub(crate) mod acceleration_derivatives;
pub(crate) mod dual;
#[cfg(feature = "alloc")]
mod emitted;
pub(crate) mod error;
pub(crate) mod fixed_linearization;
#[cfg(feature = "alloc")]
pub(crate) mod linearization;
pub(crate) mod loads;
pub(crate) mod parameters;
pub(crate) mod products;
mod slopes;
#[cfg(feature = "alloc")]
pub(crate) mod step;
pub(crate) mod structure;
#[cfg(feature = "alloc")]
pub(crate) mod tree;
pub(crate) mod variable;
#[cfg(feature = "alloc")]
mod workspace;
