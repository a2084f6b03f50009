//! A baseline with the model, its wheels balanced: an observer of body and joint rates by measured torques; mean and root mean square of its
//! innovations, by block. Rates of gimbals in the equations are those that were measured last: nutation at rates of its own, integrated from
//! reading to reading, would grow.

use nalgebra::Vector3;

use super::error::HealthError;
use super::recording::Record;
use super::statistic::Features;
use crate::scenario::{Scenario, body_key};
use crate::telemetry::Sensor;
use crate::watch::model::WatchedModel;

/// Share of an innovation that a state takes over at each reading.
const GAIN: f64 = 0.05;

/// Sums of the innovations of one channel in a block.
#[derive(Clone, Copy, Default)]
struct Sums {
    sum: f64,
    square: f64,
    count: f64,
}

impl Sums {
    fn add(&mut self, innovation: f64) {
        self.sum += innovation;
        self.square += innovation * innovation;
        self.count += 1.0;
    }

    fn numbers(&self) -> [Option<f64>; 2] {
        let has = |value: f64| (self.count > 0.0).then_some(value);
        [has(self.sum / self.count), has((self.square / self.count).sqrt())]
    }
}

/// Numbers of every block of a record.
///
/// # Errors
///
/// A state that the model cannot solve.
pub(super) fn features(
    watched: &Scenario,
    record: &Record,
    block: f64,
) -> Result<Features, HealthError> {
    let motor = |sensor: Sensor| match sensor {
        Sensor::Motor(joint) => Some(joint),
        _ => None,
    };
    let motors: Vec<usize> = record.sensors.iter().filter_map(|of| motor(of.sensor)).collect();
    let mut model = WatchedModel::new(watched, &motors)?;
    let mut names = Vec::new();
    for axis in ["x", "y", "z"] {
        names.push([format!("mean innovation of gyro {axis}"), axis.to_owned()]);
        names.push([format!("RMS of innovations of gyro {axis}"), axis.to_owned()]);
    }
    for (_, name, info) in watched.joints() {
        let joint = format!("{name}.{}", body_key(info));
        names.push([format!("mean innovation of tachometer {joint}"), name.to_owned()]);
        names.push([format!("RMS of innovations of tachometer {joint}"), name.to_owned()]);
    }
    let wheels: Vec<bool> = watched.joints().map(|(.., info)| body_key(info) == "wheel").collect();
    let count = watched.joint_count();
    let mut found = Features { names, blocks: Vec::new() };
    let mut sums = vec![Sums::default(); 3 + count];
    let mut omega: Option<Vector3<f64>> = None;
    let mut rates: Vec<Option<f64>> = vec![None; count];
    let (mut end, mut last, mut present) = (block, 0.0, None);
    for reading in &record.readings {
        if reading.time >= end {
            found.blocks.push((end, sums.iter().flat_map(Sums::numbers).collect()));
            sums.fill(Sums::default());
            end += block;
        }
        let accelerations = match present.take() {
            Some(accelerations) => accelerations,
            None => model.mean()?,
        };
        let elapsed = reading.time - last;
        if let Some(omega) = &mut omega {
            *omega += accelerations.hub * elapsed;
        }
        for (rate, acceleration) in rates.iter_mut().zip(&accelerations.joints) {
            *rate = rate.map(|rate| rate + acceleration * elapsed);
        }
        last = reading.time;
        let [x, y, z, _] = reading.value;
        match record.sensors.get(reading.index).map(|of| of.sensor) {
            Some(Sensor::Gyro) => {
                let measured = Vector3::new(x, y, z);
                let innovation = omega.map_or_else(Vector3::zeros, |omega| measured - omega);
                omega = Some(omega.map_or(measured, |omega| omega + innovation * GAIN));
                sums.iter_mut().zip(innovation.iter()).for_each(|(sum, of)| sum.add(*of));
                model.set_rate(omega.unwrap_or(measured));
            }
            Some(Sensor::Tachometer(joint)) => {
                let own = rates.get(joint).copied().flatten();
                let innovation = own.map_or(0.0, |rate| x - rate);
                let rate = own.map_or(x, |rate| rate + GAIN * innovation);
                if let Some(place) = rates.get_mut(joint) {
                    *place = Some(rate);
                }
                if let Some(sum) = sums.get_mut(3 + joint) {
                    sum.add(innovation);
                }
                let is_wheel = wheels.get(joint) == Some(&true);
                model.set_joint_rate(joint, if is_wheel { rate } else { x });
            }
            Some(Sensor::Encoder(joint)) => model.set_coordinate(joint, x),
            Some(Sensor::Motor(joint)) => model.set_motor(joint, x),
            Some(Sensor::StarTracker) | None => present = Some(accelerations),
        }
    }
    Ok(found)
}
