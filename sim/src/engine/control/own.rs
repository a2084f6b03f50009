//! [`controller_of`]: the law or the program of a controller of a scenario.

use precess_dynamics::Steered;

use crate::control::{Controller, ControllerError, Greeting, LawController, ProgramController};
use crate::scenario::{CommandedJoint, ControlLaw, SampledController, Scenario, body_key};

/// The controller of a scenario.
pub(super) fn controller_of(
    scenario: &Scenario,
    of: &SampledController,
) -> Result<Box<dyn Controller>, ControllerError> {
    let law = of.law.built(|| scenario.inertia_at_start()).map_err(ControllerError::Parameter)?;
    if let Some(law) = law {
        return Ok(Box::new(LawController(law)));
    }
    let ControlLaw::Program { command, folder, time_limit } = &of.law else {
        return Err(ControllerError::Program { reason: "it has no law".to_owned() });
    };
    let all: Vec<_> = scenario.joints().collect();
    let named = |own: &CommandedJoint| {
        let (_, device, info) = all.get(own.joint)?;
        let name = format!("{device}.{}", body_key(info));
        Some((name, own.steered == Steered::Rate))
    };
    let joints: Vec<_> = of.joints.iter().filter_map(named).collect();
    let greeting = Greeting {
        name: &of.name,
        times: [of.rate, of.offset, of.delay],
        joints: &joints,
        inertia: scenario.inertia_at_start(),
    };
    Ok(Box::new(ProgramController::start(command, folder, *time_limit, &greeting)?))
}
