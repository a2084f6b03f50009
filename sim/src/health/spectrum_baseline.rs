//! A baseline without a model: amplitude of the gyro near the rotation frequency of each wheel, steps of its mean, slope of each tachometer.

use std::f64::consts::TAU;

use super::recording::Record;
use super::statistic::Features;
use crate::scenario::{Scenario, body_key};
use crate::telemetry::Sensor;

/// Frequencies about the mean rotation frequency at which the amplitude is looked for, Hz, on either side, and their steps.
const ABOUT: [f64; 2] = [0.6, 0.1];

/// Readings of one block.
#[derive(Clone, Default)]
struct Readings {
    gyro: Vec<(f64, [f64; 3])>,
    joints: Vec<Vec<(f64, f64)>>,
}

/// Numbers of every block of a record.
pub(super) fn features(watched: &Scenario, record: &Record, block: f64) -> Features {
    let joints: Vec<String> = watched.joints().map(|(_, name, _)| name.to_owned()).collect();
    let wheels: Vec<usize> = watched
        .joints()
        .enumerate()
        .filter(|(_, (.., info))| body_key(info) == "wheel")
        .map(|(joint, _)| joint)
        .collect();
    let bodies: Vec<String> = watched.joints().map(|(.., info)| body_key(info)).collect();
    let mut names = Vec::new();
    for joint in &wheels {
        let name = joints.get(*joint).cloned().unwrap_or_default();
        names.push([format!("line of {name}"), name]);
    }
    names.extend(["x", "y", "z"].map(|axis| [format!("mean of gyro {axis}"), axis.to_owned()]));
    for (name, body) in joints.iter().zip(&bodies) {
        names.push([format!("slope of tachometer {name}.{body}"), name.clone()]);
    }
    let empty = Readings { gyro: Vec::new(), joints: vec![Vec::new(); joints.len()] };
    let mut found = Features { names, blocks: Vec::new() };
    let mut own = empty.clone();
    let mut before: Option<[f64; 3]> = None;
    let mut end = block;
    for reading in &record.readings {
        if reading.time >= end {
            found.blocks.push((end, numbers(&own, &wheels, &mut before)));
            own = empty.clone();
            end += block;
        }
        let [x, y, z, _] = reading.value;
        match record.sensors.get(reading.index).map(|of| of.sensor) {
            Some(Sensor::Gyro) => own.gyro.push((reading.time, [x, y, z])),
            Some(Sensor::Tachometer(joint)) => {
                if let Some(of) = own.joints.get_mut(joint) {
                    of.push((reading.time, x));
                }
            }
            _ => {}
        }
    }
    found
}

fn numbers(of: &Readings, wheels: &[usize], before: &mut Option<[f64; 3]>) -> Vec<Option<f64>> {
    let mut all = Vec::new();
    for joint in wheels {
        let rates = of.joints.get(*joint).map(Vec::as_slice).unwrap_or_default();
        let rate = mean(rates.iter().map(|(_, rate)| *rate));
        all.push(rate.map(|rate| {
            let [width, step] = ABOUT;
            let mut frequency = rate.abs() / TAU - width;
            let mut most = 0.0_f64;
            while frequency <= rate.abs() / TAU + width {
                most = most.max(amplitude(&of.gyro, frequency));
                frequency += step;
            }
            most
        }));
    }
    let means = [0, 1, 2].map(|axis| mean(of.gyro.iter().map(|(_, rates)| rates[axis])));
    for (axis, mean) in means.iter().enumerate() {
        all.push(mean.zip(*before).map(|(now, before)| now - before[axis]));
    }
    *before = match means {
        [Some(x), Some(y), Some(z)] => Some([x, y, z]),
        _ => None,
    };
    all.extend(of.joints.iter().map(|readings| slope(readings)));
    all
}

fn mean(of: impl Iterator<Item = f64>) -> Option<f64> {
    let (sum, count) = of.fold((0.0, 0.0), |(sum, count), value| (sum + value, count + 1.0));
    (count > 0.0).then(|| sum / count)
}

/// Root of the sum of the squared amplitudes of three axes at a frequency, Hz, with Hann's window.
fn amplitude(gyro: &[(f64, [f64; 3])], frequency: f64) -> f64 {
    let (Some((from, _)), Some((to, _))) = (gyro.first(), gyro.last()) else { return 0.0 };
    let means = [0, 1, 2].map(|axis| mean(gyro.iter().map(|(_, of)| of[axis])).unwrap_or(0.0));
    let mut sums = [[0.0; 2]; 3];
    let mut weights = 0.0;
    for (time, rates) in gyro {
        let window =
            0.5 - 0.5 * libm::cos(TAU * (time - from) / (to - from).max(f64::MIN_POSITIVE));
        let (sine, cosine) = libm::sincos(TAU * frequency * (time - from));
        for ((sum, rate), mean) in sums.iter_mut().zip(rates).zip(means) {
            sum[0] += window * (rate - mean) * cosine;
            sum[1] += window * (rate - mean) * sine;
        }
        weights += window;
    }
    let square: f64 = sums.iter().flatten().map(|of| of * of).sum();
    2.0 * square.sqrt() / weights
}

/// Of a straight line by least squares.
fn slope(readings: &[(f64, f64)]) -> Option<f64> {
    let time = mean(readings.iter().map(|(time, _)| *time))?;
    let squares: f64 = readings.iter().map(|(of, _)| (of - time).powi(2)).sum();
    let moments: f64 = readings.iter().map(|(of, rate)| (of - time) * rate).sum();
    (squares > 0.0).then(|| moments / squares)
}
