//! [`Sequence`]: readings in the order of time, each held back until the rates about it are known, and the rates and angles between them.
//!
//! A reading waits until each sensor of a rate or an angle has read twice from its time on, and not for longer than a bound: a sensor that has
//! stopped is held at its last reading from then on.

use std::collections::VecDeque;

use nalgebra::Vector3;
use precess_control::GyroOutput;

use super::model::WatchedModel;
use super::track::{Kind, Track};
use crate::scenario::Scenario;
use crate::telemetry::{Reading, Sensor};

/// What has been found to be wrong in the readings of a sensor.
#[derive(Clone, Copy, Debug)]
struct Correction {
    offset: Vector3<f64>,
    scale: f64,
}

impl Correction {
    const NONE: Self = Self { offset: Vector3::new(0.0, 0.0, 0.0), scale: 1.0 };

    fn apply(&self, value: Vector3<f64>) -> Vector3<f64> {
        (value - self.offset) / self.scale
    }
}

/// Readings of all sensors.
#[derive(Clone, Debug)]
pub(super) struct Sequence {
    sensors: Vec<Sensor>,
    /// Of each sensor of a rate or an angle.
    tracks: Vec<Option<Track>>,
    corrections: Vec<Correction>,
    waiting: VecDeque<Reading>,
    /// How long a reading waits, s.
    longest: f64,
    /// Time of the latest reading, s.
    latest: f64,
}

impl Sequence {
    pub(super) fn new(scenario: &Scenario, sensors: Vec<Sensor>, longest: f64) -> Self {
        let mut gyros = scenario.controllers.iter().filter_map(|of| of.sensors.gyro.as_ref());
        let integrates = gyros.any(|of| of.output == GyroOutput::Integrating);
        let of = |sensor: &Sensor| match sensor {
            Sensor::Gyro if integrates => Some(Kind::Mean),
            Sensor::Gyro | Sensor::Tachometer(_) => Some(Kind::Sample),
            Sensor::Encoder(_) => Some(Kind::Angle),
            Sensor::Motor(_) | Sensor::StarTracker => None,
        };
        let tracks = sensors.iter().map(|sensor| of(sensor).map(Track::new)).collect();
        let corrections = vec![Correction::NONE; sensors.len()];
        Self { sensors, tracks, corrections, waiting: VecDeque::new(), longest, latest: 0.0 }
    }

    /// The sensor of a reading; none of what is not watched.
    pub(super) fn sensor(&self, reading: &Reading) -> Option<Sensor> {
        self.sensors.get(reading.index).copied().filter(|of| *of != Sensor::StarTracker)
    }

    /// What follows the sensor of a reading.
    pub(super) fn track(&self, reading: &Reading) -> Option<&Track> {
        self.tracks.get(reading.index).and_then(Option::as_ref)
    }

    /// Takes a reading. Times do not fall.
    pub(super) fn add(&mut self, reading: &Reading) {
        if self.sensor(reading).is_none() {
            return;
        }
        if let Some(track) = self.tracks.get_mut(reading.index).and_then(Option::as_mut) {
            track.add(reading.time, reading.value);
        }
        self.waiting.push_back(*reading);
        self.latest = reading.time;
    }

    /// The next reading about which the rates are known; at the end of the telemetry the next one.
    pub(super) fn next(&mut self, ended: bool) -> Option<Reading> {
        let time = self.waiting.front()?.time;
        let reached = || self.tracks.iter().flatten().all(|of| of.reaches(time));
        let due = ended || self.latest - time > self.longest || reached();
        if due { self.waiting.pop_front() } else { None }
    }

    /// A reading without what has been found to be wrong in it.
    pub(super) fn corrected(&self, reading: &Reading) -> Vector3<f64> {
        let [x, y, z, _] = reading.value;
        let correction = self.corrections.get(reading.index).unwrap_or(&Correction::NONE);
        correction.apply(Vector3::new(x, y, z))
    }

    /// From now on takes an offset off the readings of a sensor, and divides them by a scale.
    pub(super) fn correct(&mut self, sensor: Sensor, offset: Vector3<f64>, scale: f64) {
        let all = self.sensors.iter().zip(&mut self.corrections);
        for (_, correction) in all.filter(|(of, _)| **of == sensor) {
            correction.offset += offset * correction.scale;
            correction.scale *= scale;
        }
    }

    /// Forgets rates and angles before a time: there is a gap.
    pub(super) fn forget(&mut self, time: f64) {
        self.tracks.iter_mut().flatten().for_each(|of| of.forget(time));
    }

    /// Sets the model's rates and angles to their means over an interval without a reading inside.
    pub(super) fn follow(&mut self, interval: [f64; 2], model: &mut WatchedModel) {
        let all = self.sensors.iter().zip(&mut self.tracks).zip(&self.corrections);
        for ((sensor, track), correction) in all {
            let Some(mean) = track.as_mut().and_then(|of| of.mean(interval)) else { continue };
            let mean = correction.apply(mean);
            match sensor {
                Sensor::Gyro => model.set_rate(mean),
                Sensor::Tachometer(joint) => model.set_joint_rate(*joint, mean.x),
                Sensor::Encoder(joint) => model.set_coordinate(*joint, mean.x),
                Sensor::Motor(_) | Sensor::StarTracker => {}
            }
        }
    }
}
