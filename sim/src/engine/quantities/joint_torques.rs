//! [`joint_torques`]: what motor and friction of each joint exert.

use precess_dynamics::SolveError;

use super::member_loads::MemberLoads;
use crate::engine::equations::system::System;
use precess_craft::CraftState;

/// Torques of motor and friction of each joint, by its number, N m or N: of a joint that sticks the loads less the motor's
/// torque are friction, of one whose motion is prescribed the loads less friction are the motor's.
pub(crate) fn joint_torques(
    system: &System<'_>,
    time: f64,
    state: &CraftState,
) -> Result<Vec<[f64; 2]>, SolveError> {
    let inputs = system.inputs(time, state);
    let found = system.craft.accelerations(state, &inputs)?;
    system.count(1);
    let loads = system.craft.loads(state, &inputs, &found)?;
    let totals = MemberLoads::new(&loads, system.acting.chains()).motors;
    let motor = |joint| system.acting.motor(joint, time);
    Ok(system.acting.friction.split(&totals, state, motor))
}
