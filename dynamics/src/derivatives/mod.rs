//! Derivatives of accelerations, momenta and loads by state, inputs and parameters, exact to
//! rounding: the solver runs over [`Dual`](crate::Dual) numbers, through the same kernels.
//!
//! [`evaluation`] computes columns without a heap, [`parameters`] those by parameters;
//! `linearization`, with the feature `alloc`, fills matrices with them, `step` carries them through a
//! step. Of a rigid hub's accelerations `linearization` needs no dual numbers: `by_loads` has the columns from the
//! emitted derivatives of the loads (`load_columns`) and the mass matrix (`mass_system`).

#[cfg(feature = "alloc")]
mod by_loads;
pub(crate) mod column;
mod elimination;
pub(crate) mod error;
pub(crate) mod evaluation;
#[cfg(feature = "alloc")]
pub(crate) mod linearization;
#[cfg(feature = "alloc")]
mod load_columns;
#[cfg(feature = "alloc")]
mod mass_system;
pub(crate) mod parameters;
mod point;
#[cfg(feature = "alloc")]
pub(crate) mod step;
pub(crate) mod structure;
mod turned;
pub(crate) mod variable;
mod with_numbers;
