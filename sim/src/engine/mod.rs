//! Runs a scenario: [`run`] to its end into a recorder, [`Run`] step by step for a program,
//! [`run_side_by_side`] several that differ in numbers.
//!
//! A run is a sequence of segments; within one, everything that acts is smooth. At the start of
//! each the changes due are applied: brakes, locks at end stops, new drives. A step never spans the
//! end of a segment, and is cut at an end stop, and where friction comes to hold a joint or no longer does.
//!
//! Memory does not grow with the length of a run: samples go to a recorder as they come, drifts are
//! running maxima, and events beyond the first ten thousand are only counted.

mod control;
mod equations;
mod error;
mod events;
mod integration;
mod quantities;
mod runs;
#[cfg(test)]
pub(crate) mod tests;

pub(crate) use precess_craft::{Craft, rigid_state};

pub(crate) use control::linear::{LinearAllocation, linear_allocation};
pub(crate) use equations::inputs::SegmentInputs;
pub(crate) use equations::kinematics::Chain;
pub(crate) use equations::packing::Layout;
pub use equations::run_quantities::RunQuantities;
#[cfg(feature = "tool")]
pub(crate) use error::device_of;
pub(crate) use quantities::member_loads::MemberLoads;
pub use runs::{
    Advance, CheckpointError, CoupledRun, Gpu, Run, SIDE_BY_SIDE, run, run_side_by_side,
    run_side_by_side_on, run_with_controllers,
};
pub(crate) use runs::{HardwareChange, run_with_change};
pub(crate) use runs::{driven_by_program, hub_input_count};

use crate::record::RunError;
use crate::scenario::Scenario;

/// The equations of motion of a scenario.
pub(crate) fn craft_of(scenario: &Scenario) -> Result<Craft, RunError> {
    Ok(match scenario.flexible() {
        Some(craft) => Craft::from(craft.map_err(RunError::Modes)?),
        None => Craft::from(scenario.spacecraft().map_err(RunError::Parameters)?),
    })
}
