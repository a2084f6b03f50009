//! The equations of motion of a scenario, as an integrator evaluates them: the state as one flat vector, what acts on
//! the spacecraft at a time, and the poses of its bodies.

pub(super) mod commands;
mod disturbances;
pub(super) mod friction;
pub(super) mod inputs;
pub(super) mod kinematics;
pub(super) mod motors;
pub(super) mod packing;
pub(crate) mod points;
pub(super) mod run_quantities;
pub(super) mod system;
