//! [`Block`]: what a block says in the end, and what tests find in that.
//!
//! A step within a block spoils the other estimates of its sensor. Where a bias of the gyro or a scale of a tachometer is found to have changed, readings
//! are corrected from then on: else the bias would be drag of gimbals, and the scale a phase that turns.

use nalgebra::Vector3;

use super::drag::DragSample;
use super::joint::JointValues;
use super::quantity::{Alarm, Watched};
use super::regression::Reduced;
use super::{AXES, Watch};
use crate::telemetry::Sensor;

/// A step within a block of so many deviations spoils the other estimates of its sensor.
const SPOILS: f64 = 6.0;

/// What a block says.
#[derive(Clone, Debug, PartialEq)]
pub struct Block {
    /// Start and end, s.
    pub times: [f64; 2],
    /// Each quantity with its variance, in the order of [`Watch::quantities`]; none where the block does not determine it.
    pub values: Vec<Option<[f64; 2]>>,
    /// What else the tests of each need.
    pub(crate) details: Vec<Detail>,
    /// What was found at its end.
    pub alarms: Vec<Alarm>,
}

/// What tests need beside an estimate.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Detail {
    /// How much of the other cause's unit is in it.
    Signature(f64),
    /// Of the drag of a wheel.
    Drag(Option<DragSample>),
}

/// Estimates of a block with what else the tests of each need, in the order of quantities.
type Estimates = Vec<(Option<[f64; 2]>, Detail)>;

impl Watch {
    /// What the block says, and what tests find in that.
    pub(super) fn end(&mut self, times: [f64; 2]) -> Block {
        let of_joints: Vec<JointValues> =
            self.joints.iter_mut().map(|joint| joint.end(times)).collect();
        let gimbals: Vec<Reduced> = of_joints.iter().filter_map(|of| of.line.clone()).collect();
        let jolted: Vec<usize> = self
            .joints
            .iter()
            .zip(&of_joints)
            .filter_map(|(joint, of)| of.scale.is_some_and(is_step).then_some(joint.joint))
            .collect();
        let (mut estimates, jumped) = self.of_body(&gimbals, &jolted);
        for (joint, found) in self.joints.iter().zip(of_joints) {
            let wheel = joint.is_wheel();
            let JointValues { drag, signature, sample, torque, scale, .. } = found;
            // A step of the reading within the block is no drag, nor is that of the gyro.
            let told = if wheel { !jolted.contains(&joint.joint) } else { !jumped };
            let detail = if wheel {
                Detail::Drag(sample.filter(|_| told))
            } else {
                Detail::Signature(signature)
            };
            estimates.push((drag.filter(|_| told), detail));
            estimates.push((torque, Detail::Signature(0.0)));
            estimates.extend(wheel.then_some((scale, Detail::Signature(0.0))));
        }
        let own = self.quantities.iter_mut().zip(&estimates);
        let alarms = own.filter_map(|(of, (value, detail))| of.take(times, (*value)?, detail));
        let alarms: Vec<Alarm> = alarms.collect();
        for alarm in &alarms {
            self.correct(alarm);
        }
        let (values, details) = estimates.into_iter().unzip();
        Block { times, values, details, alarms }
    }

    /// What the gyro says, and whether it has a step. Tachometers of these joints have one: the angles of their rotors are not known any more.
    fn of_body(&mut self, gimbals: &[Reduced], jolted: &[usize]) -> (Estimates, bool) {
        let Some(body) = &mut self.body else { return (Vec::new(), false) };
        for (rotor, of) in self.model.rotors().iter().enumerate() {
            if jolted.contains(&of.joint) {
                body.forget_phases(rotor);
            }
        }
        let (lines, jumps) = body.end(gimbals);
        let mut estimates = Vec::with_capacity(self.quantities.len());
        let watches_lines = self.quantities.iter().any(|of| of.watched == Watched::StaticImbalance);
        // A phase that turns within the block is no step of the gyro.
        let mut turned = false;
        let jumped = jumps.iter().flatten().any(|of| is_step(*of));
        for rotor in 0..if watches_lines { self.model.rotors().len() } else { 0 } {
            let values = lines.get(rotor).copied().unwrap_or([None; 4]);
            turned |= values[2..].iter().flatten().any(|of| is_step(*of));
            let speed = body.speed(rotor);
            for (kind, value) in values.into_iter().enumerate() {
                let signature = if kind == 0 { speed } else { 0.0 };
                let value = value.filter(|_| kind > 1 || !jumped);
                estimates.push((value, Detail::Signature(signature)));
            }
        }
        let jumps = jumps.map(|of| (of.filter(|_| !turned), Detail::Signature(0.0)));
        estimates.extend(jumps);
        (estimates, jumped)
    }

    /// Corrects the readings of the sensor that an alarm is of.
    fn correct(&mut self, alarm: &Alarm) {
        let change = alarm.shift.change;
        match alarm.watched {
            Watched::GyroJump => {
                let Some(axis) = AXES.iter().position(|axis| *axis == alarm.of) else { return };
                let mut offset = Vector3::zeros();
                offset[axis] = change;
                self.sequence.correct(Sensor::Gyro, offset, 1.0);
                if let Some(body) = &mut self.body {
                    body.forget_steps(axis);
                }
            }
            Watched::TachometerScale => {
                let scales =
                    self.quantities.iter().filter(|of| of.watched == Watched::TachometerScale);
                let nth = scales.take_while(|of| of.of != alarm.of).count();
                let mut wheels = self.joints.iter_mut().filter(|of| of.is_wheel());
                let Some(joint) = wheels.nth(nth) else { return };
                joint.forget();
                let sensor = Sensor::Tachometer(joint.joint);
                self.sequence.correct(sensor, Vector3::zeros(), 1.0 + change);
            }
            _ => {}
        }
    }
}

/// Whether it is as far from zero as to spoil the other estimates of its block.
fn is_step([value, variance]: [f64; 2]) -> bool {
    value * value > SPOILS * SPOILS * variance
}
