//! [`record`]: the readings of a case, each sensor by its own clock, and as CSV with the columns of a scenario's telemetry.
//!
//! The gyro is that of the controller, 100 Hz, with random walks of angle and rate. A wheel's electronics telemeter its tachometer and the torque
//! that is commanded, 50 Hz, at a time of their own between the samples of the gyro; those of gimbals 100 Hz, with an encoder. A torque is the
//! mean from its time to that of the next one: a servo's torque has lines of the wheels, and samples of it would alias them. Clocks
//! are off by 0.1 ms and 1 ppm a joint. What the controller reads of a tachometer is the rate itself.

use std::ops::ControlFlow;

use nalgebra::Vector3;
use precess_control::Noise;

use super::case::{HealthCase, Loop, Spacecraft, Timing};
use super::error::HealthError;
use super::fault::Fault;
use crate::control::{Command, Controller, ControllerError, ControllerSample};
use crate::engine::{HardwareChange, run_with_change};
use crate::record::{End, Header, Outcome, RecordError, Recorder, RunError};
use crate::scenario::{Scenario, body_key};
use crate::telemetry::{Reading, Sensor, SensorColumns, TelemetryLayout};

/// Rows a second, of the bus and of the pyramid, whose servo has as many samples.
const RATES: [u64; 2] = [200, 500];
/// Readings a second of the gyro and of gimbals, and of wheels.
const READINGS: [u64; 2] = [100, 50];
/// Standard deviations of the tachometers of wheels and gimbals, rad/s, and of the encoders, rad.
const NOISE: [f64; 3] = [0.01, 2e-5, 1e-6];
/// Times nearer than this are one, s.
const NEAR: f64 = 1e-6;
/// By which the clock of each joint is off more than the one before, s, and s/s.
const CLOCK: [f64; 2] = [1e-4, 1e-6];

/// A record.
#[derive(Clone, Debug)]
pub struct Record {
    /// The sensors, as [`Reading::index`] counts them.
    pub sensors: Vec<SensorColumns>,
    /// Readings in the order of time.
    pub readings: Vec<Reading>,
}

/// The readings of a case, from a seed.
///
/// # Errors
///
/// A run that does not start, or ends early: none of the cases as they are.
pub fn record(case: &HealthCase, seed: u32, timing: &Timing) -> Result<Record, HealthError> {
    let [mut before, mut after] = case.truths(seed, timing)?;
    let watched = case.spacecraft.watched()?;
    let layout = TelemetryLayout::of_scenario(&watched, None)?;
    let mut sampler = Sampler::new(*case, seed, timing, &watched, &layout);
    for scenario in [&mut before, &mut after] {
        #[expect(clippy::cast_precision_loss, reason = "hundreds")]
        let rate = rows(case.spacecraft) as f64;
        scenario.output.rate = rate;
        scenario.output.columns.clone_from(&sampler.columns);
        scenario.requirements.clear();
    }
    let joint = |name: &str, body: &str| {
        let mut joints = before.joints().enumerate();
        joints.find(|(_, (_, of, info))| *of == name && body_key(info) == body).map(|(k, _)| k)
    };
    let mut change = HardwareChange {
        time: case.onset(seed, timing),
        scenario: &after,
        motors: Vec::new(),
        angles: Vec::new(),
        gyro_bias: Vector3::zeros(),
    };
    if let Some((name, angle)) = case.turn(seed) {
        change.angles.extend(joint(&name, "wheel").map(|joint| (joint, angle)));
    }
    if let Some((fault, size)) = case.fault {
        let value = fault.change(case.spacecraft, size);
        let device = case.spacecraft.device(case.number(seed));
        match fault {
            Fault::TorqueConstant => {
                let bus = case.spacecraft == Spacecraft::Bus;
                let body = if bus { "wheel" } else { "outer_gimbal" };
                change.motors.extend(joint(&device, body).map(|joint| (joint, 1.0 + value)));
            }
            Fault::GyroBias => change.gyro_bias.y = value,
            _ => {}
        }
    }
    let controllers: Vec<(String, Box<dyn Controller>)> = match case.of {
        Loop::Closed => Vec::new(),
        Loop::Open => {
            let torque = if case.spacecraft == Spacecraft::Bus { 0.015 } else { 0.2 };
            vec![("aocs".to_owned(), Box::new(TorqueByTime(torque)))]
        }
    };
    let change = case.fault.map(|_| &change);
    let progress = &mut |_| ControlFlow::Continue(());
    let outcome = run_with_change(&before, controllers, change, &mut sampler, progress)?;
    if let End::Failed(error) = &outcome.end {
        let (case, time, reason) = (case.name(), outcome.end_time, error.to_string());
        return Err(HealthError::Ended { case, time, reason });
    }
    let Sampler { sensors, mut readings, .. } = sampler;
    readings.sort_by(|a, b| a.time.total_cmp(&b.time));
    Ok(Record { sensors, readings })
}

/// Rows a second.
fn rows(of: Spacecraft) -> u64 {
    let [bus, pyramid] = RATES;
    if of == Spacecraft::Bus { bus } else { pyramid }
}

impl Record {
    /// Rows with the columns of the sensors; a cell that is no reading is empty.
    #[must_use]
    pub fn csv(&self) -> String {
        let mut text = "time".to_owned();
        let mut places = Vec::new();
        let mut count = 0;
        for of in &self.sensors {
            places.push(count);
            count += of.columns.len();
            of.columns.iter().for_each(|name| text.extend([",", name.as_str()]));
        }
        text.push('\n');
        let mut digits = zmij::Buffer::new();
        let mut row = self.readings.iter().peekable();
        let mut cells: Vec<Option<f64>> = vec![None; count];
        while let Some(Reading { time, .. }) = row.peek() {
            let time = *time;
            cells.fill(None);
            while let Some(of) = row.next_if(|of| of.time.to_bits() == time.to_bits()) {
                let own = self.sensors.get(of.index).map_or(0, |sensor| sensor.columns.len());
                let from = places.get(of.index).copied().unwrap_or_default();
                for (cell, value) in cells.iter_mut().skip(from).zip(of.value).take(own) {
                    *cell = Some(value);
                }
            }
            text.push_str(digits.format(time));
            for cell in &cells {
                text.push(',');
                if let Some(value) = cell {
                    text.push_str(digits.format(*value));
                }
            }
            text.push('\n');
        }
        text
    }
}

/// A torque on the spacecraft by the time: three sines, N m.
struct TorqueByTime(f64);

impl Controller for TorqueByTime {
    fn sample(&mut self, sample: &ControllerSample<'_>) -> Result<Command, ControllerError> {
        let of = |period: f64, phase: f64| {
            self.0 * libm::sin(std::f64::consts::TAU * sample.time / period + phase)
        };
        Ok(Command::Torque(Vector3::new(of(31.0, 0.0), of(37.0, 1.0), of(43.0, 2.0))))
    }
}

/// What is read at a row.
struct Source {
    /// Columns of the run.
    columns: Vec<usize>,
    /// Rows from one reading to the next, and the first one.
    every: [u64; 2],
    /// Times off by this, s, and this share.
    clock: [f64; 2],
    noise: Option<(Noise, f64)>,
    /// From a time on, the reading is this multiple: tachometer.
    scale: Option<[f64; 2]>,
    /// From a time on, the torque is that which is exerted by this: what was commanded.
    motor: Option<[f64; 2]>,
    /// Of a torque, which is a mean: the time of the reading, and sum and number of rows since then.
    mean: Option<[f64; 3]>,
}

/// Makes readings of rows.
struct Sampler {
    columns: Vec<String>,
    sources: Vec<Source>,
    sensors: Vec<SensorColumns>,
    readings: Vec<Reading>,
    count: u64,
}

impl Sampler {
    fn new(
        case: HealthCase,
        seed: u32,
        timing: &Timing,
        watched: &Scenario,
        layout: &TelemetryLayout,
    ) -> Self {
        let onset = case.onset(seed, timing);
        let device = case.spacecraft.device(case.number(seed));
        let value = case.fault.map_or(0.0, |(fault, size)| fault.change(case.spacecraft, size));
        let of_fault = |fault: Fault, name: &str, body: &str| {
            let hit = case.fault.is_some_and(|(of, _)| of == fault) && name == device;
            let own = match fault {
                Fault::TorqueConstant if case.spacecraft == Spacecraft::Pyramid => "outer_gimbal",
                _ => "wheel",
            };
            (hit && body == own).then_some([onset, 1.0 + value])
        };
        let joints: Vec<_> = watched.joints().collect();
        let (mut columns, mut sources, mut sensors) = (Vec::new(), Vec::new(), Vec::new());
        for of in &layout.sensors {
            if of.sensor == Sensor::StarTracker {
                continue;
            }
            let joint = match of.sensor {
                Sensor::Tachometer(joint) | Sensor::Motor(joint) | Sensor::Encoder(joint) => joint,
                Sensor::Gyro | Sensor::StarTracker => 0,
            };
            let (name, body) = joints
                .get(joint)
                .map_or(("", String::new()), |(_, name, info)| (*name, body_key(info)));
            let wheel = body == "wheel";
            let noise = |deviation: f64, what: &str| {
                Some((
                    Noise::new(u64::from(seed), &format!("{what} {joint} of {}", case.name())),
                    deviation,
                ))
            };
            let [of_wheel, of_gimbal, of_angle] = NOISE;
            let [often, seldom] = READINGS.map(|of| rows(case.spacecraft) / of);
            let every = if wheel { seldom } else { often };
            let number = joint as u64 + 1;
            #[expect(clippy::cast_precision_loss, reason = "a dozen")]
            let clock = CLOCK.map(|of| of * number as f64);
            let source = match of.sensor {
                Sensor::Gyro | Sensor::StarTracker => Source {
                    columns: Vec::new(),
                    every: [often, 0],
                    clock: [0.0; 2],
                    noise: None,
                    scale: None,
                    motor: None,
                    mean: None,
                },
                Sensor::Tachometer(_) => Source {
                    columns: Vec::new(),
                    every: [every, number % every],
                    clock,
                    noise: noise(if wheel { of_wheel } else { of_gimbal }, "tachometer"),
                    scale: of_fault(Fault::Tachometer, name, &body),
                    motor: None,
                    mean: None,
                },
                Sensor::Encoder(_) => Source {
                    columns: Vec::new(),
                    every: [every, number % every],
                    clock,
                    noise: noise(of_angle, "encoder"),
                    scale: None,
                    motor: None,
                    mean: None,
                },
                Sensor::Motor(_) => Source {
                    columns: Vec::new(),
                    every: [every, number % every],
                    clock,
                    noise: None,
                    scale: None,
                    motor: of_fault(Fault::TorqueConstant, name, &body),
                    mean: Some([f64::NAN, 0.0, 0.0]),
                },
            };
            columns.extend(of.columns.iter().cloned());
            sources.push(source);
            sensors.push(of.clone());
        }
        Self { columns, sources, sensors, readings: Vec::new(), count: 0 }
    }
}

impl Recorder for Sampler {
    fn begin(&mut self, header: &Header) -> Result<(), RecordError> {
        for (source, sensor) in self.sources.iter_mut().zip(&self.sensors) {
            for name in &sensor.columns {
                source.columns.extend(header.quantity(name)?);
            }
        }
        Ok(())
    }

    fn sample(&mut self, row: &[f64]) -> Result<(), RecordError> {
        let time = row.first().copied().unwrap_or_default();
        for (index, source) in self.sources.iter_mut().enumerate() {
            let [every, first] = source.every;
            let due = self.count % every == first;
            if !due && source.mean.is_none() {
                continue;
            }
            let mut value = [0.0; 4];
            for (to, column) in value.iter_mut().zip(&source.columns) {
                *to = row.get(*column).copied().unwrap_or(f64::NAN);
            }
            // The state at the time of the change is that before it; a torque is that after it.
            if let Some([_, scale]) = source.scale.filter(|[from, _]| time > *from + NEAR) {
                value[0] *= scale;
            }
            if let Some([_, factor]) = source.motor.filter(|[from, _]| time > *from - NEAR) {
                value[0] /= factor;
            }
            if let Some((noise, deviation)) = &source.noise {
                let [drawn, ..] = noise.at(self.count);
                value[0] += deviation * drawn;
            }
            let [offset, drift] = source.clock;
            let mut time = time;
            if let Some([from, sum, count]) = &mut source.mean {
                let whole = [*from, *sum / *count];
                if due {
                    (*from, *sum, *count) = (time, 0.0, 0.0);
                }
                *sum += value[0];
                *count += 1.0;
                // None before the first.
                if !due || whole.iter().any(|of| of.is_nan()) {
                    continue;
                }
                [time, value[0]] = whole;
            }
            self.readings.push(Reading { index, time: time + offset + drift * time, value });
        }
        self.count += 1;
        Ok(())
    }

    fn finish(&mut self, _: &Outcome) -> Result<(), RecordError> {
        Ok(())
    }
}

impl From<RecordError> for HealthError {
    fn from(error: RecordError) -> Self {
        Self::Run(RunError::Record(error))
    }
}
