//! Motors that come to one of their limits or leave it, at the start of a segment.

use super::Run;
use crate::engine::equations::motors::MotorState;
use crate::engine::events::motors::{MotorChange, beyond, due, limited};
use crate::record::RunError;
use crate::units::Plain;
use precess_dynamics::JointStates;

impl Run<'_> {
    /// Applies the change that the last step came to, and those that are due where something jumps.
    pub(super) fn settle_motors(&mut self) -> Result<(), RunError> {
        let reached = self.motor_change.take();
        if let Some(change) = reached {
            self.change_motor(change);
        }
        let joints = limited(&self.system);
        // Each change may make another one due.
        for _ in 0..=2 * joints.len() {
            let mut changed = false;
            for joint in &joints {
                let change = due(&self.system, self.time, &self.moment, *joint)?;
                if let Some(change) = change.filter(|change| !undoes(reached, *change)) {
                    self.change_motor(change);
                    changed = true;
                }
            }
            if !changed {
                break;
            }
        }
        Ok(())
    }

    fn change_motor(&mut self, MotorChange { joint, to }: MotorChange) {
        let before = self.system.acting.motors().get(joint).copied().unwrap_or_default();
        self.system.acting.set_motor(joint, to);
        let Some(place) = self.system.layout.joints.get(joint) else { return };
        let limits = self.system.acting.drive(joint).limits();
        let (name, [_, unit, ..]) = (&place.name, place.info.units());
        let [power, rate] = [limits.power, limits.rate].map(|of| Plain(of.unwrap_or(f64::NAN)));
        let text = match (before, to) {
            (_, MotorState::LargestPower) => {
                format!("{name}: the motor delivers its largest power, {power} W")
            }
            (MotorState::LargestPower, MotorState::Commanded) => {
                format!("{name}: the motor is below its largest power again")
            }
            (MotorState::LargestRate(_), MotorState::Commanded) => {
                format!("{name} leaves its largest rate, {rate} {unit}")
            }
            (_, MotorState::LargestRate(_)) => {
                format!("{name} is at its largest rate, {rate} {unit}; the motor holds it")
            }
            (_, MotorState::Beyond(_)) => format!(
                "{name} exceeds its largest rate, {rate} {unit}: the motor brakes with its largest torque"
            ),
            (MotorState::Beyond(_), MotorState::Commanded) => {
                format!("{name} is below its largest rate, {rate} {unit}, again")
            }
            (_, MotorState::Commanded) => return,
        };
        self.note(self.time, text);
    }

    /// Rejects a joint that starts beyond the largest rate of its motor.
    pub(super) fn check_rates(&self) -> Result<(), RunError> {
        let rates: Vec<f64> = self.moment.state.devices.states().map(|[_, rate]| rate).collect();
        for joint in limited(&self.system) {
            let limit = self.system.acting.drive(joint).limits().rate.unwrap_or(f64::INFINITY);
            match rates.get(joint) {
                Some(rate) if rate.abs() > limit => {
                    return Err(beyond(&self.system, self.time, joint, *rate));
                }
                _ => {}
            }
        }
        Ok(())
    }
}

/// Whether a change would undo the one that the last step came to: a joint at its largest rate leaves it within a step.
fn undoes(reached: Option<MotorChange>, change: MotorChange) -> bool {
    let comes = reached.filter(|of| matches!(of.to, MotorState::LargestRate(_)));
    comes.is_some_and(|of| of.joint == change.joint) && change.to == MotorState::Commanded
}
