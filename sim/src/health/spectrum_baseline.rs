//! A baseline without a model: RMS of the gyro near the rotation frequency of each wheel, by FFT with Hann's window, steps of its mean, slope of each tachometer.

use std::f64::consts::TAU;

use super::recording::Record;
use super::statistic::Features;
use crate::scenario::{Scenario, body_key};
use crate::spectra::{Detrend, WelchSettings, float, psd};
use crate::telemetry::Sensor;

/// Half the width of the band about the mean rotation frequency, Hz.
const ABOUT: f64 = 0.6;

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
        all.push(rate.and_then(|rate| near(&of.gyro, rate.abs() / TAU)));
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

/// Root of the sum of the mean squares of three axes near a frequency, Hz; none of a frequency that the readings do not have.
fn near(gyro: &[(f64, [f64; 3])], frequency: f64) -> Option<f64> {
    let ((from, _), (to, _)) = (gyro.first()?, gyro.last()?);
    let rate = float(gyro.len().checked_sub(1)?) / (to - from);
    let settings = WelchSettings { detrend: Detrend::Mean, ..WelchSettings::hann(gyro.len()) };
    let mut square = 0.0;
    for axis in 0..3 {
        let samples: Vec<f64> = gyro.iter().map(|(_, rates)| rates[axis]).collect();
        let found = psd(&samples, rate, &settings).ok()?;
        square += found.band_rms([frequency - ABOUT, frequency + ABOUT]).ok()?.powi(2);
    }
    Some(square.sqrt())
}

/// Of a straight line by least squares.
fn slope(readings: &[(f64, f64)]) -> Option<f64> {
    let time = mean(readings.iter().map(|(time, _)| *time))?;
    let squares: f64 = readings.iter().map(|(of, _)| (of - time).powi(2)).sum();
    let moments: f64 = readings.iter().map(|(of, rate)| (of - time) * rate).sum();
    (squares > 0.0).then(|| moments / squares)
}
