//! What of a scenario is not in the solver in C.

use super::error::FmuError;
use crate::scenario::{Scenario, StopAction, Target, WrenchAxes};

/// Refuses the first thing that acts in the scenario and cannot act in the unit.
pub(super) fn check(scenario: &Scenario) -> Result<(), FmuError> {
    let joint = |number: usize| {
        let found = scenario.joints().nth(number);
        found.map_or_else(String::new, |(_, name, info)| format!("{name}.{}", info.coordinate))
    };
    if let Some(of) = scenario.controllers.first() {
        return Err(FmuError::Controller(of.name.clone()));
    }
    if let Some(of) = scenario.disturbances.first() {
        return Err(FmuError::Source(of.name.clone()));
    }
    if let Some(of) = scenario.friction.first() {
        return Err(FmuError::Friction(joint(of.joint)));
    }
    if let Some(of) = scenario.stops.iter().find(|of| of.action == StopAction::Lock) {
        return Err(FmuError::LockingStop(joint(of.joint)));
    }
    let limited = |drive: &crate::scenario::Drive| drive.limits().depend_on_rate();
    if let Some(number) = scenario.drives.iter().position(limited) {
        return Err(FmuError::MotorLimit(joint(number)));
    }
    if let Some(of) = scenario.changes.first() {
        return Err(FmuError::Change { joint: joint(of.joint), time: of.time });
    }
    let turned = |of: &crate::scenario::AppliedWrench| {
        matches!(of.body, Target::Joint(_)) && of.axes == WrenchAxes::Inertial
    };
    if let Some(index) = scenario.wrenches.iter().position(turned) {
        return Err(FmuError::InertialWrench(index + 1));
    }
    if scenario.joint_count() == 0 && scenario.structure.is_none() {
        return Err(FmuError::NoDevice);
    }
    Ok(())
}
