//! [`motor_torques`]: torques of motors for commanded rates and accelerations.
//!
//! By an evaluation in which the commanded joints have their accelerations prescribed, and its loads, as
//! [`Spacecraft::servo`](precess_dynamics::Spacecraft::servo) does it, for any number of joints: a gimbal accelerates by
//! `gain (commanded rate - rate)`, a wheel as commanded. Of what acts from outside it knows gravity and the torque of
//! controllers; springs, friction and the torques of all other motors are known, wrenches and sources are not.

use nalgebra::Vector3;
use precess_dynamics::kind::Each;
use precess_dynamics::{Mode, SolveError, Steered, Wrench};

use super::allocation::Available;
use crate::engine::equations::system::System;
use crate::engine::integration::Moment;
use crate::engine::quantities::member_loads::MemberLoads;

/// What a servo is to do.
#[derive(Clone, Copy, Debug)]
pub(super) struct ServoCommands<'a> {
    /// The joints of the controller.
    pub(super) joints: &'a [Available],
    /// Rates of all joints, as they are read.
    pub(super) rates: &'a [f64],
    /// Rates and accelerations that are commanded.
    pub(super) commands: &'a [f64],
    /// Feedback of the rate of gimbals, 1/s.
    pub(super) gain: f64,
}

/// The torques of the joints of a controller, N m, before they are clipped, with an external torque of controllers on the
/// hub; zero of one that it does not command at present.
pub(super) fn motor_torques(
    system: &System<'_>,
    (time, moment): (f64, &Moment),
    &ServoCommands { joints, rates, commands, gain }: &ServoCommands<'_>,
    external: &Vector3<f64>,
) -> Result<Vec<f64>, SolveError> {
    let state = &moment.state;
    let mut inputs = system.inputs(time, state);
    (inputs.force, inputs.torque_b) = (Vector3::zeros(), *external);
    inputs.bodies = None;
    inputs.modal.forces.fill(0.0);
    inputs.modal.mounts.fill(Wrench::none());
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
