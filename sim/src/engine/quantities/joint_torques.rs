//! [`joint_torques`]: what motor and friction of each joint exert.

use precess_craft::CraftState;
use precess_dynamics::SolveError;

use super::member_loads::MemberLoads;
use crate::engine::equations::system::System;
use crate::record::RunError;

/// The torques of all joints at one time and state, evaluated where they are first needed.
#[derive(Default)]
pub(crate) struct TorquesOnce(Option<Vec<[f64; 2]>>);

impl TorquesOnce {
    /// Those of motor and friction of a joint, N m or N.
    pub(crate) fn of(
        &mut self,
        system: &System<'_>,
        time: f64,
        state: &CraftState,
        joint: usize,
    ) -> Result<[f64; 2], RunError> {
        let all = if let Some(all) = &self.0 {
            all
        } else {
            let found = joint_torques(system, time, state);
            self.0.insert(found.map_err(|source| RunError::solve(system, time, source))?)
        };
        Ok(all.get(joint).copied().unwrap_or([f64::NAN; 2]))
    }
}

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
    let motor = |joint| system.acting.motor_of_profile(joint, time);
    Ok(system.acting.friction.split(&totals, state, motor))
}
