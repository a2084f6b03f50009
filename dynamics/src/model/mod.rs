//! What a spacecraft consists of: hub, device kinds, joints with their modes, springs and friction.
//!
//! Parameters and precomputed constants, which never change during a run. The equations of a kind
//! are emitted, under [`generated`](crate::generated).

pub(crate) mod joint_array;
pub(crate) mod kernels;
pub mod kind;
pub(crate) mod mode;
pub(crate) mod parameter_info;
#[cfg(test)]
mod parameter_info_tests;
pub(crate) mod parameters;
pub(crate) mod passive;
pub mod units;
pub(crate) mod wrench;
