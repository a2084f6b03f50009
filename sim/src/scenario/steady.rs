//! Devices of a scenario in steady spin: which joints turn, which are free, which are held, for small motions
//! about it.

use super::{Drive, Member, Scenario, members};
use crate::structure::dynamic_mass::Motor;

/// The body of a rotor, in all kinds.
const WHEEL: &str = "wheel";

/// Joints of some devices, in the order of the set.
#[derive(Clone, Debug, Default)]
pub struct SteadyJoints {
    /// Coordinate and rate; the rate is zero where a joint does not spin.
    pub states: Vec<[f64; 2]>,
    /// What the motor of each does to small motions.
    pub motors: Vec<Motor>,
    /// The name of each: device, body.
    pub names: Vec<String>,
    /// Names of wheels that could spin and are at rest.
    pub at_rest: Vec<String>,
    /// Joints that move at first but are taken as at rest, with their rates.
    pub stopped: Vec<(String, f64)>,
}

impl SteadyJoints {
    /// Of the devices and platforms of a scenario with these numbers, at their initial coordinates: of a settled run those of
    /// its mean motion.
    ///
    /// The last joint of a device spins, with its initial rate and the motor that is stated. Of the others, those with
    /// a spring are free if `sprung`; all others, and all that the scenario locks or prescribes, are held.
    #[must_use]
    pub fn new(scenario: &Scenario, chosen: &[usize], motor: Motor, sprung: bool) -> Self {
        let (mut joints, members) = (Self::default(), members(&scenario.devices));
        let states = scenario.mean_joints().zip(&scenario.drives);
        for ((device, name, info), ([coordinate, rate], drive)) in scenario.joints().zip(states) {
            if !chosen.contains(&device) {
                continue;
            }
            let member = members.get(device);
            let name = format!("{name}.{}", info.body);
            let spins = info.tip && !info.slides && member.is_some_and(|of| of.device().is_some());
            let passive = member.map(Member::passive).unwrap_or_default();
            let passive = passive.get(info.index);
            let on_spring = passive.is_some_and(|passive| passive.stiffness > 0.0)
                || member.is_some_and(Member::has_suspension);
            let spins = spins && !on_spring;
            if rate != 0.0 && !spins {
                joints.stopped.push((format!("{name}, {}", info.rate), rate));
            }
            if rate == 0.0 && spins && info.body == WHEEL {
                joints.at_rest.push(name.clone());
            }
            // What its kind keeps at its rate has no motor torque, whatever drives it.
            let is_driven = info.driven && matches!(drive, Drive::Torque { .. });
            joints.motors.push(match motor {
                _ if !is_driven => Motor::ConstantRate,
                Motor::ConstantTorque if spins => Motor::ConstantTorque,
                _ if sprung && on_spring => Motor::ConstantTorque,
                _ => Motor::ConstantRate,
            });
            joints.states.push([coordinate, if spins { rate } else { 0.0 }]);
            joints.names.push(name);
        }
        joints
    }

    /// The same with more joints free, by their numbers among those of the scenario: those that a controller commands.
    #[must_use]
    pub(crate) fn with_free(
        mut self,
        scenario: &Scenario,
        chosen: &[usize],
        free: &[usize],
    ) -> Self {
        let own = scenario.joints().enumerate().filter(|(_, (device, ..))| chosen.contains(device));
        for ((joint, (.., info)), motor) in own.zip(&mut self.motors) {
            if info.driven && free.contains(&joint) {
                *motor = Motor::ConstantTorque;
            }
        }
        self
    }
}
