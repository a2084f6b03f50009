//! Equations of one device and of the hub: elimination of the joints into the hub's system, its
//! solution, gravity, loads, energy and momentum.
//!
//! [`device`] is the entry for a device, [`assembly`] adds the devices to the hub, [`system`]
//! solves the hub's six equations. Nothing here knows of sets of devices.

pub(crate) mod arithmetic;
pub(crate) mod assembly;
#[cfg(feature = "lanes")]
pub(crate) mod cpu;
pub(crate) mod device;
pub(crate) mod device_loads;
#[cfg(feature = "lanes")]
pub(crate) mod dispatched;
pub(crate) mod eliminate;
pub(crate) mod error;
#[cfg(test)]
mod error_tests;
pub(crate) mod gravity;
pub(crate) mod hub;
pub(crate) mod joint_inputs;
pub(crate) mod load_sums;
pub(crate) mod mass_reduction;
pub(crate) mod motor_torques;
pub(crate) mod pivot_bound;
#[cfg(feature = "lanes")]
pub(crate) mod side_by_side;
#[cfg(feature = "lanes")]
pub(crate) mod sines;
pub(crate) mod stiffness;
pub(crate) mod suspension_forces;
pub(crate) mod system;
