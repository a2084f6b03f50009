//! [`Timeline`]: readings and torques of motors in the order of time, and the longest step between them.
//!
//! An integrating gyro's reading is the mean over the period before it, whose start is an event, too. The motion begins where all
//! motors have a torque; a motor without telemetry has none. Where a motor's torque has a gap, nobody knows what acted: the record is
//! the longest piece without one, and readings outside it are counted.
//!
//! A step is at most [`TURN`] of a turn of the fastest wheel. The error of the mean of a rate that varies with the angle of a wheel is then
//! that of Simpson's rule, `(h Omega)^4 / 2880`, 3e-5 of its amplitude, and lines above half of the sampling rate are aliased in the
//! prediction as they are in the readings.

use std::f64::consts::TAU;

use precess_dynamics::JointStates as _;

use super::noise::SensorNoise;
use crate::scenario::Scenario;
use crate::telemetry::{Sensor, Series, Telemetry};

/// The longest step, as a share of a turn: 0.55 rad.
const TURN: f64 = 0.55 / TAU;
/// Times nearer than this are one, s.
const NEAR: f64 = 1e-9;
/// The longest step of a spacecraft without fast wheels, s.
const LONGEST: f64 = 0.05;

/// What happens at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Event {
    /// The period of the gyro's next reading begins.
    GyroBegins,
    Gyro([f64; 3]),
    StarTracker([f64; 4]),
    Tachometer(usize, f64),
    Encoder(usize, f64),
    Motor(usize, f64),
}

/// A record in order.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Timeline {
    pub(super) start: f64,
    pub(super) end: f64,
    pub(super) events: Vec<(f64, Event)>,
    /// The longest step, s.
    pub(super) step: f64,
    /// Readings before the start and beyond gaps of motors' torques.
    pub(super) left_out: usize,
}

impl Timeline {
    /// Of telemetry; none without a reading.
    pub(super) fn new(
        scenario: &Scenario,
        telemetry: &Telemetry,
        noise: &SensorNoise,
    ) -> Option<Self> {
        let motors: Vec<&Series> =
            telemetry.series.iter().filter(|of| matches!(of.sensor, Sensor::Motor(_))).collect();
        let mut events: Vec<(f64, Event)> = Vec::new();
        let mut readings = Vec::new();
        for of in &telemetry.series {
            for (time, value) in of.times.iter().zip(&of.values) {
                let event = match of.sensor {
                    Sensor::Gyro => Event::Gyro([value[0], value[1], value[2]]),
                    Sensor::StarTracker => Event::StarTracker(*value),
                    Sensor::Tachometer(joint) => Event::Tachometer(joint, value[0]),
                    Sensor::Encoder(joint) => Event::Encoder(joint, value[0]),
                    Sensor::Motor(joint) => {
                        events.push((*time, Event::Motor(joint, value[0])));
                        continue;
                    }
                };
                let begins = match (of.sensor, noise.mean_over) {
                    (Sensor::Gyro, Some(period)) => time - period,
                    _ => *time,
                };
                readings.push((begins, *time, event));
            }
        }
        let first = readings.iter().map(|(begins, ..)| *begins).fold(f64::INFINITY, f64::min);
        let last = readings.iter().map(|(_, time, _)| *time).fold(f64::NEG_INFINITY, f64::max);
        let [start, end] = piece(&motors, [first, last])?;
        let within = |begins: f64, time: f64| begins >= start - NEAR && time <= end + NEAR;
        let all = readings.len();
        readings.retain(|(begins, time, _)| within(*begins, *time));
        let left_out = all - readings.len();
        if readings.is_empty() {
            return None;
        }
        for (begins, time, event) in readings {
            if begins < time {
                events.push((begins, Event::GyroBegins));
            }
            events.push((time, event));
        }
        // Of one time: readings, then torques, then what begins; a stable sort keeps the rest.
        let order = |event: &Event| match event {
            Event::Motor(..) => 1,
            Event::GyroBegins => 2,
            _ => 0,
        };
        // Times that are one but for rounding are the earlier one.
        events.sort_by(|(a, _), (b, _)| a.total_cmp(b));
        let mut last = f64::NEG_INFINITY;
        for (time, _) in &mut events {
            if *time - last <= NEAR {
                *time = last;
            }
            last = *time;
        }
        events.sort_by(|(a, of), (b, other)| a.total_cmp(b).then(order(of).cmp(&order(other))));
        let own = scenario.initial.devices.states().map(|[_, rate]| rate.abs());
        let tachometers = events.iter().map(|(_, event)| match event {
            Event::Tachometer(_, rate) => rate.abs(),
            _ => 0.0,
        });
        let fastest = own.chain(tachometers).fold(0.0, f64::max);
        let step = (TURN * TAU / fastest).min(LONGEST);
        Some(Self { start, end, events, step, left_out })
    }

    /// How many numbers are read until a time, s.
    pub(super) fn numbers(&self, until: f64) -> usize {
        let count = |event: &Event| match event {
            Event::GyroBegins | Event::Motor(..) => 0,
            Event::Gyro(_) | Event::StarTracker(_) => 3,
            Event::Tachometer(..) | Event::Encoder(..) => 1,
        };
        self.events.iter().take_while(|(time, _)| *time <= until).map(|(_, of)| count(of)).sum()
    }
}

/// From when to when every motor's torque is known: the longest piece within a span; the torque of a motor is held for as long as its usual
/// interval after its last reading.
fn piece(motors: &[&Series], [first, last]: [f64; 2]) -> Option<[f64; 2]> {
    let mut cuts = vec![];
    let (mut start, mut end) = (first, last);
    for of in motors {
        start = start.max(*of.times.first()?);
        end = end.min(of.times.last()? + of.interval().unwrap_or(f64::INFINITY));
        cuts.extend(of.gaps());
    }
    cuts.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let mut pieces = Vec::new();
    let mut from = start;
    for [before, after] in cuts {
        if after > from {
            pieces.push([from, before.min(end)]);
            from = from.max(after);
        }
    }
    pieces.push([from, end]);
    let length = |of: &[f64; 2]| of[1] - of[0];
    pieces.into_iter().filter(|of| length(of) >= 0.0).max_by(|a, b| length(a).total_cmp(&length(b)))
}
