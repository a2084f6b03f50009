//! [`Watch`]: a scenario's model run along its telemetry, and tests of what is left over: what has changed, when, by how much.
//!
//! ```text
//! readings --model--> residuals --least squares of a block--> quantities with variances --tests--> alarms
//! ```
//!
//! Within a block the accelerations of the coupled equations, at measured rates and motor torques, are integrated. The gyro less that is a
//! start, a constant torque from outside, noise, and a line of each rotor: linear in its static and dynamic imbalance, by exact
//! derivatives, at the angle that its tachometer integrates to. Angles of rotors are not telemetered: phases are from block to
//! block. A tachometer less that is a start, a drag torque and a torque constant. Quantities of blocks are compared with those of the first
//! blocks, the reference; steps of gyro and tachometers are searched for within blocks. Memory does not grow with the length of the telemetry.
//!
//! Lines are those of a rigid hub. Blocks across a gap are left out.
//!
//! | file | what |
//! |---|---|
//! | `model` | accelerations and lines |
//! | `body`, `joint` | the block of the gyro, that of a joint |
//! | `block` | what a block says in the end; corrections of sensors |
//! | `phase`, `drag` | phases from block to block, the drag of a wheel by its rate |
//! | `regression` | least squares, what a block does not determine |
//! | `settings` | lengths and the rate of false alarms |
//! | `sequence`, `track` | readings in the order of time, rates between them |
//! | `steps` | steps within blocks |
//! | `quantity` | names, units, what looks the same |
//! | `record` | a whole record, in memory |
//! | `detector`, `thresholds` | likelihood ratio and cumulative sums, the bounds for a rate of false alarms |

mod block;
mod body;
mod detector;
mod drag;
mod error;
mod joint;
pub(crate) mod model;
mod phase;
mod quantity;
mod record;
mod regression;
mod sequence;
mod settings;
mod steps;
#[cfg(test)]
mod tests;
mod thresholds;
mod track;

pub use block::Block;
pub use detector::{Shift, Test};
pub use error::WatchError;
pub use quantity::{Alarm, Watched};
pub use record::{RecordQuantity, WatchedRecord, watch};
pub use settings::WatchSettings;

use crate::scenario::{Scenario, body_key};
use crate::telemetry::{Reading, Sensor, SensorColumns};
use body::BodyFit;
use detector::Kind;
use joint::JointFit;
use model::{Accelerations, WatchedModel};
pub(crate) use quantity::Quantity;
use sequence::Sequence;
use thresholds::Thresholds;

/// Onsets that the likelihood ratio is searched over.
const ONSETS: usize = 60;

/// Axes of the gyro.
const AXES: [&str; 3] = ["x", "y", "z"];

/// A time without readings that is longer than this share of a block ends the block.
const GAP: f64 = 0.25;

/// The watch over one record.
pub struct Watch {
    settings: WatchSettings,
    /// Sensors that have not read anything yet.
    unseen: Vec<bool>,
    sequence: Sequence,
    /// There are no more readings.
    ended: bool,
    model: WatchedModel,
    last: f64,
    start: Option<f64>,
    body: Option<BodyFit>,
    joints: Vec<JointFit>,
    quantities: Vec<Quantity>,
    remarks: Vec<String>,
}

impl Watch {
    /// Of a scenario and the sensors that a file has.
    ///
    /// # Errors
    ///
    /// A scenario that cannot be evaluated, lengths and rates that are not in their range, and sensors from which nothing can be
    /// watched.
    pub fn new(
        scenario: &Scenario,
        sensors: &[SensorColumns],
        settings: &WatchSettings,
    ) -> Result<Self, WatchError> {
        settings.check()?;
        let block = settings.block;
        let sensors: Vec<Sensor> = sensors.iter().map(|of| of.sensor).collect();
        let has = |sensor: Sensor| sensors.contains(&sensor);
        let count = scenario.joint_count();
        let motors: Vec<usize> = (0..count).filter(|joint| has(Sensor::Motor(*joint))).collect();
        let model = WatchedModel::new(scenario, &motors)?;
        let own = |joint: &usize| has(Sensor::Tachometer(*joint)) && has(Sensor::Motor(*joint));
        let is_wheel = |joint: usize| {
            scenario.joints().nth(joint).is_some_and(|(.., info)| body_key(info) == "wheel")
        };
        let reference = settings.blocks();
        let rotor = |joint: usize| {
            let device = |joint| scenario.joints().nth(joint).map(|(device, ..)| device);
            let rotors = &mut model.rotors().iter();
            rotors.position(|of| device(of.joint) == device(joint)).filter(|_| has(Sensor::Gyro))
        };
        let of_joint =
            |joint: usize| JointFit::new(joint, is_wheel(joint), rotor(joint), block, reference);
        let joints: Vec<_> = (0..count).filter(own).map(of_joint).collect();
        let mut remarks = Vec::new();
        let turning: Vec<bool> =
            model.rotors().iter().map(|of| has(Sensor::Tachometer(of.joint))).collect();
        let body = has(Sensor::Gyro).then(|| BodyFit::new(scenario, turning, block, reference));
        if body.is_none() && joints.is_empty() {
            return Err(WatchError::Nothing);
        }
        let mut all = Vec::new();
        if body.is_some() {
            match model.signatures() {
                Ok(_) => all.extend(model.rotors().iter().flat_map(|of| {
                    let kinds = [
                        Watched::StaticImbalance,
                        Watched::DynamicImbalance,
                        Watched::StaticPhase,
                        Watched::DynamicPhase,
                    ];
                    kinds.map(|watched| (watched.clone(), of.name.clone(), watched.kind()))
                })),
                Err(error) => remarks.push(format!("imbalance is not watched: {error}")),
            }
            let jump = Watched::GyroJump;
            all.extend(AXES.map(|axis| (jump.clone(), axis.to_owned(), jump.kind())));
        }
        all.extend(joints.iter().flat_map(|of| {
            let name = joint_name(scenario, of.joint);
            let drag = if of.is_wheel() { Kind::Drag } else { Watched::Drag.kind() };
            let mut own = vec![
                (Watched::Drag, name.clone(), drag),
                (Watched::TorqueConstant, name.clone(), drag),
            ];
            if of.is_wheel() {
                let scale = Watched::TachometerScale;
                own.push((scale.clone(), name, scale.kind()));
            }
            own
        }));
        Ok(Self {
            settings: *settings,
            unseen: sensors.iter().map(|of| *of != Sensor::StarTracker).collect(),
            quantities: quantities_of(all, settings)?,
            sequence: Sequence::new(scenario, sensors, GAP * block),
            ended: false,
            model,
            last: 0.0,
            start: None,
            body,
            joints,
            remarks,
        })
    }

    /// Names and units of the quantities.
    pub fn quantities(&self) -> impl Iterator<Item = (&str, &Watched)> {
        self.quantities.iter().map(|of| (of.name.as_str(), &of.watched))
    }

    /// What is not watched, with the reason.
    #[must_use]
    pub fn remarks(&self) -> &[String] {
        &self.remarks
    }

    /// The reference of each quantity, and the scatter about it by the stated variance; none while it is taken.
    pub fn references(&self) -> impl Iterator<Item = Option<[f64; 2]>> {
        self.quantities.iter().map(Quantity::reference)
    }

    /// The tests of these quantities with other settings, for the blocks of an earlier watch.
    pub(crate) fn quantities_with(
        &self,
        settings: &WatchSettings,
    ) -> Result<Vec<Quantity>, WatchError> {
        let all = self.quantities.iter().map(|of| (of.watched.clone(), of.of.clone(), of.kind));
        quantities_of(all.collect(), settings)
    }

    /// The next block that ends in telemetry, whose readings `next` gives until there are no more; none after the last. A reading
    /// waits until each sensor of a rate has read twice from its time on, or for a quarter of a block, or to the end.
    ///
    /// # Errors
    ///
    /// A state that the model cannot solve; those of `next`.
    pub fn next_block(
        &mut self,
        mut next: impl FnMut() -> Result<Option<Reading>, WatchError>,
    ) -> Result<Option<Block>, WatchError> {
        loop {
            while let Some(reading) = self.sequence.next(self.ended) {
                if let Some(block) = self.process(&reading)? {
                    return Ok(Some(block));
                }
            }
            if self.ended {
                return Ok(None);
            }
            match next()? {
                Some(reading) => self.sequence.add(&reading),
                None => self.ended = true,
            }
        }
    }

    /// Moves on to a reading, and takes it; the block that ends before it, where one does.
    fn process(&mut self, reading: &Reading) -> Result<Option<Block>, WatchError> {
        let time = reading.time;
        let Some(sensor) = self.sequence.sensor(reading) else { return Ok(None) };
        let mut ended = None;
        if let Some(start) = self.start {
            if time - self.last > GAP * self.settings.block {
                // The angles of the rotors are lost, too.
                if let Some(body) = &mut self.body {
                    body.forget();
                }
                self.joints.iter_mut().for_each(JointFit::forget);
                self.sequence.forget(time);
                self.start = None;
            } else {
                self.advance(time)?;
                if time - start >= self.settings.block {
                    ended = Some(self.end([start, time]));
                    self.begin(time)?;
                }
            }
        }
        self.last = time;
        if let Some(unseen) = self.unseen.get_mut(reading.index) {
            *unseen = false;
        }
        self.read(sensor, reading);
        if self.start.is_none() && !self.unseen.contains(&true) {
            self.sequence.follow([time, time], &mut self.model);
            self.begin(time)?;
        }
        Ok(ended)
    }

    /// Integrates the model to a time, at the mean rates since the last one: accelerations are linear in these, or nearly.
    fn advance(&mut self, time: f64) -> Result<(), WatchError> {
        let elapsed = time - self.last;
        if elapsed <= 0.0 {
            return Ok(());
        }
        self.sequence.follow([self.last, time], &mut self.model);
        let Accelerations { hub, joints } = self.model.mean()?;
        if let Some(body) = &mut self.body {
            body.advance(elapsed, &hub, &self.model);
        }
        for joint in &mut self.joints {
            let acceleration = joints.get(joint.joint).copied().unwrap_or(0.0);
            let [torque, dry] = [self.model.motor(joint.joint), self.model.friction(joint.joint)];
            joint.advance(elapsed, acceleration, torque, dry);
        }
        Ok(())
    }

    fn read(&mut self, sensor: Sensor, reading: &Reading) {
        let value = self.sequence.corrected(reading);
        let elapsed = self.start.map(|start| reading.time - start);
        match (sensor, elapsed) {
            (Sensor::Gyro, Some(elapsed)) => {
                if let (Some(body), Some(track)) = (&mut self.body, self.sequence.track(reading)) {
                    body.read(elapsed, &value, &self.model, track);
                }
            }
            (Sensor::Tachometer(joint), Some(_)) => {
                if let Some(own) = self.joints.iter_mut().find(|of| of.joint == joint) {
                    let body = self.body.as_ref().zip(own.rotor());
                    let line = body.map(|(body, rotor)| body.of_joint(joint, rotor, &self.model));
                    own.read(value.x, &line.unwrap_or_default());
                }
            }
            (Sensor::Motor(joint), _) => self.model.set_motor(joint, value.x),
            _ => {}
        }
    }

    fn begin(&mut self, time: f64) -> Result<(), WatchError> {
        for joint in &mut self.joints {
            let by_torque = self.model.by_motor(joint.joint)?;
            joint.start(by_torque, self.model.joint_rate(joint.joint));
        }
        if let Some(body) = &mut self.body {
            // Without signatures there are no lines, which a remark says.
            body.start(self.model.signatures().unwrap_or_default());
        }
        self.start = Some(time);
        Ok(())
    }
}

/// The device of a joint; with its body where the device has several: `rw1`, `cmg1.outer_gimbal`.
fn joint_name(scenario: &Scenario, joint: usize) -> String {
    let Some((device, name, info)) = scenario.joints().nth(joint) else { return String::new() };
    let several = scenario.joints().filter(|(of, ..)| *of == device).nth(1).is_some();
    if several { format!("{name}.{}", body_key(info)) } else { name.to_owned() }
}

/// The tests of quantities.
fn quantities_of(
    all: Vec<(Watched, String, Kind)>,
    settings: &WatchSettings,
) -> Result<Vec<Quantity>, WatchError> {
    let WatchSettings { block, false_alarms, .. } = *settings;
    #[expect(clippy::cast_precision_loss, reason = "a hundred")]
    let alpha = false_alarms * block / 3600.0 / all.len() as f64;
    let reference = settings.blocks();
    let at_once = Thresholds::new(alpha, 1, reference)?;
    let over_onsets = Thresholds::new(alpha, ONSETS, reference)?;
    let quantities = all.into_iter().map(|own| {
        let single = matches!(own.2, Kind::Single | Kind::Centred);
        let (thresholds, onsets) = if single { (at_once, 1) } else { (over_onsets, ONSETS) };
        Quantity::new(own, thresholds, [reference, onsets])
    });
    Ok(quantities.collect())
}
