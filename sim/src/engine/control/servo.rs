//! [`motor_torques`]: torques of motors for commanded rates and accelerations.
//!
//! By an evaluation in which the commanded joints have their accelerations prescribed, and its loads, as
//! [`Spacecraft::servo`](precess_dynamics::Spacecraft::servo) does it, for any number of joints: a gimbal accelerates by
//! `gain (commanded rate - rate)`, a wheel as commanded. Wrenches and sources from outside are not known to it; gravity,
//! springs, friction and the torques of all other motors are.

use nalgebra::Vector3;
use precess_dynamics::kind::Each;
use precess_dynamics::{JointStates, Mode, SolveError, Steered, Wrench};

use super::allocation::Available;
use crate::engine::equations::system::System;
use crate::engine::integration::Moment;
use crate::engine::quantities::member_loads::MemberLoads;

/// The torques of the joints of a controller, N m, before they are clipped; zero of one that it does not command at
/// present.
pub(super) fn motor_torques(
    system: &System<'_>,
    (time, moment): (f64, &Moment),
    joints: &[Available],
    commands: &[f64],
    gain: f64,
) -> Result<Vec<f64>, SolveError> {
    let state = &moment.state;
    let mut inputs = system.inputs(time, state);
    (inputs.force, inputs.torque_b) = (Vector3::zeros(), Vector3::zeros());
    inputs.bodies = None;
    inputs.modal.forces.fill(0.0);
    inputs.modal.mounts.fill(Wrench::none());
    let rates: Vec<f64> = state.devices.states().map(|[_, rate]| rate).collect();
    for (of, command) in joints.iter().zip(commands).filter(|(of, _)| of.commanded) {
        let rate = rates.get(of.joint).copied().unwrap_or_default();
        let acceleration = match of.steered {
            Steered::Rate => gain * (command - rate),
            Steered::Acceleration => *command,
            Steered::Nothing => continue,
        };
        if let Some(mode) = inputs.modes.values_mut().nth(of.joint) {
            *mode = Mode::Prescribed(acceleration);
        }
    }
    let found = system.craft.accelerations(state, &inputs)?;
    system.count(1);
    let loads = system.craft.loads(state, &inputs, &found)?;
    let totals = MemberLoads::new(&loads, system.acting.chains()).motors;
    let commanded = |joint: usize| joints.iter().any(|of| of.joint == joint && of.commanded);
    let motor = |joint| {
        if commanded(joint) { None } else { system.acting.motor_of_profile(joint, time) }
    };
    let split = system.acting.friction.split(&totals, state, motor);
    let torque = |of: &Available| {
        let [motor, _] = split.get(of.joint).copied().unwrap_or_default();
        if of.commanded { motor } else { 0.0 }
    };
    Ok(joints.iter().map(torque).collect())
}
