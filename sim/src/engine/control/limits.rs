//! [`limited`]: how many joints of a controller are at a limit of their motors.

use super::allocation::Available;
use crate::engine::equations::motors::POWER;

/// Of how many joints the motor is at a limit that depends on the rate, or the torque is beyond the largest one or the
/// power.
pub(super) fn limited(joints: &[Available], torques: &[f64], rates: &[f64]) -> usize {
    let beyond = |(of, torque): &(&Available, &f64)| {
        let rate = rates.get(of.joint).copied().unwrap_or_default();
        let power = of.limits.power.map_or(f64::INFINITY, |power| power * (1.0 + POWER));
        let torque_max = of.limits.torque.map_or(f64::INFINITY, f64::abs);
        of.commanded && (of.at_limit || torque.abs() > torque_max || **torque * rate > power)
    };
    joints.iter().zip(torques).filter(beyond).count()
}
