//! Noise densities and Allan variances of what sensors read, against the stated ones, within statistical bands.

use nalgebra::Vector3;
use precess_control::rotation::{from_vector, inverse, product, to_vector};
use precess_control::{
    Accelerometer, AccelerometerParameters, Gyro, GyroOutput, GyroParameters, StarTracker,
};
use precess_dynamics::{Attitude as _, Quaternion};
use std::f64::consts::PI;

use crate::welch::density;

/// Standard deviations of a mean that are allowed: exceeded once in two million seeds.
const DEVIATIONS: f64 = 5.0;
/// Of a single bin: of 3 x 255 of them exceeded once in a thousand seeds.
const DEVIATIONS_OF_BIN: f64 = 5.5;

const LENGTH: usize = 512;
const SEGMENTS: usize = 64;

fn count(number: usize) -> f64 {
    f64::from(u32::try_from(number).unwrap())
}

/// The density is flat: each bin has chi-square with two degrees a segment, neighbours are correlated by the window.
fn assert_white(signal: &[f64], rate: f64, stated: f64) {
    let found = density(signal, LENGTH, rate);
    let bins: f64 = found.iter().sum::<f64>() / count(found.len()) / stated;
    let bin = 1.0 / count(SEGMENTS).sqrt();
    // Hann's window correlates neighbours: 1.9 bins are as one.
    let mean = bin * (1.9 / count(found.len())).sqrt();
    println!("mean density {bins:.4} of the stated, one deviation is {mean:.4}");
    assert!((bins - 1.0).abs() < DEVIATIONS * mean, "{bins}");
    for (k, density) in found.iter().enumerate() {
        assert!((density / stated - 1.0).abs() < DEVIATIONS_OF_BIN * bin, "{k}: {density:e}");
    }
    // No slope: the lower half against the upper one.
    let (low, high) = found.split_at(found.len() / 2);
    let ratio = low.iter().sum::<f64>() / high.iter().sum::<f64>();
    assert!((ratio - 1.0).abs() < 2.1 * DEVIATIONS * mean, "{ratio}");
}

fn parameters(output: GyroOutput, angle_random_walk: f64, rate_random_walk: f64) -> GyroParameters {
    GyroParameters {
        output,
        period: 0.05,
        angle_random_walk,
        rate_random_walk,
        bias: Vector3::zeros(),
        quantum: 0.0,
    }
}

/// Readings at rest, by axis.
fn at_rest(parameters: &GyroParameters, samples: usize) -> [Vec<f64>; 3] {
    let mut gyro = Gyro::new(parameters, 39, "imu").unwrap();
    let read: Vec<_> = (0..samples).map(|_| gyro.measure(&Vector3::zeros())).collect();
    [0, 1, 2].map(|axis| read.iter().map(|reading| reading[axis]).collect())
}

#[test]
fn angle_random_walk_is_white_rate_noise() {
    for output in [GyroOutput::Sampled, GyroOutput::Integrating] {
        let gyro = parameters(output, 3e-5, 0.0);
        for axis in at_rest(&gyro, LENGTH * SEGMENTS) {
            assert_white(&axis, 1.0 / gyro.period, 2.0 * 3e-5 * 3e-5);
        }
    }
}

/// Steps of the bias are white; where the frequency is low its density is `2 s_u² / (2 pi f)²`.
#[test]
fn rate_random_walk_has_the_stated_slope() {
    let walk = 2e-6;
    let gyro = parameters(GyroOutput::Sampled, 0.0, walk);
    for axis in at_rest(&gyro, LENGTH * SEGMENTS + 1) {
        let steps: Vec<f64> = axis.windows(2).map(|pair| pair[1] - pair[0]).collect();
        // A step of variance s_u² T; its one-sided density is that times 2 T.
        assert_white(&steps, 1.0 / gyro.period, 2.0 * (walk * gyro.period).powi(2));
        // Of the walk itself, from 10 to 30 bins, where the window's leakage from lower ones is small.
        let found = density(&axis, LENGTH, 1.0 / gyro.period);
        let ratios = (10..30).map(|bin| {
            let frequency = count(bin) / (count(LENGTH) * gyro.period);
            found[bin - 1] / (2.0 * (walk / (2.0 * PI * frequency)).powi(2))
        });
        let mean = ratios.sum::<f64>() / 20.0;
        let deviation = (1.9 / 20.0 / count(SEGMENTS)).sqrt();
        // Sampling adds (pi f T)² / 3 to the density at most: 1.1 %.
        assert!((mean - 1.0).abs() < DEVIATIONS * deviation + 1.1e-2, "{mean}");
    }
}

/// Of an integrating gyro the Allan variance is `s_v² / tau + s_u² tau / 3`, at any tau (Farrenkopf's model is exact).
#[test]
fn allan_variances_are_those_of_both_walks() {
    assert_allan(1e-5, 4e-6, &[1, 20, 100]);
    assert_allan(0.0, 4e-6, &[1, 2, 20]);
}

fn assert_allan(angle: f64, rate: f64, averages: &[usize]) {
    let gyro = parameters(GyroOutput::Integrating, angle, rate);
    let samples = at_rest(&gyro, 50_000);
    for averaged in averages.iter().copied() {
        let tau = gyro.period * count(averaged);
        let stated = angle * angle / tau + rate * rate * tau / 3.0;
        let (mut sum, mut pairs) = (0.0, 0);
        for axis in &samples {
            let means: Vec<f64> = axis
                .chunks_exact(averaged)
                .map(|part| part.iter().sum::<f64>() / count(averaged))
                .collect();
            sum += means.windows(2).map(|pair| 0.5 * (pair[1] - pair[0]).powi(2)).sum::<f64>();
            pairs += means.len() - 1;
        }
        let found = sum / count(pairs);
        // Squares of normal differences, which share a mean with their neighbour: 3 / n of white noise, less else.
        let deviation = (3.0 / count(pairs)).sqrt();
        println!("tau {tau} s: {:.4} of the stated, one deviation {deviation:.4}", found / stated);
        assert!(
            (found / stated - 1.0).abs() < DEVIATIONS * deviation,
            "{tau} {found:e} {stated:e}"
        );
    }
}

#[test]
fn an_accelerometer_has_its_one_sided_density_and_bias() {
    let parameters = AccelerometerParameters {
        period: 0.002,
        noise_density: 5e-6,
        bias: Vector3::new(1e-4, 0.0, -2e-4),
        quantum: 0.0,
    };
    let mut sensor = Accelerometer::new(&parameters, 4, "acc").unwrap();
    let force = Vector3::new(0.0, 9.0, 1.0);
    let read: Vec<_> = (0..LENGTH * SEGMENTS).map(|_| sensor.measure(&force)).collect();
    for axis in 0..3 {
        let noise: Vec<f64> =
            read.iter().map(|of| of[axis] - force[axis] - parameters.bias[axis]).collect();
        assert_white(&noise, 500.0, 5e-6 * 5e-6);
    }
}

/// Noise about the axes of the sensor, the covariance about those of B.
#[test]
fn a_star_tracker_has_its_deviations_about_its_axes() {
    const SAMPLES: usize = 10_000;
    let mount = from_vector(&Vector3::new(0.4, -1.1, 0.6));
    let deviations = Vector3::new(1e-5, 2e-5, 1.5e-4);
    let mut sensor = StarTracker::new(mount, deviations, 8, "st").unwrap();
    let truth = from_vector(&Vector3::new(-0.3, 0.9, 1.4));
    let errors: Vec<_> = (0..SAMPLES)
        .map(|_| to_vector(&product(&inverse(&truth), &sensor.measure(&truth))))
        .collect();
    let covariance =
        errors.iter().map(|error| error * error.transpose()).sum::<nalgebra::Matrix3<f64>>()
            / count(SAMPLES);
    let stated = sensor.covariance();
    for i in 0..3 {
        for j in 0..3 {
            let variance = stated[(i, i)] * stated[(j, j)] + stated[(i, j)].powi(2);
            let bound = DEVIATIONS * (variance / count(SAMPLES)).sqrt();
            assert!((covariance[(i, j)] - stated[(i, j)]).abs() < bound, "{i} {j}");
        }
    }
    // Seen in S it is diagonal.
    let to_s = mount.dcm();
    let seen = to_s * stated * to_s.transpose();
    let squares = nalgebra::Matrix3::from_diagonal(&deviations.component_mul(&deviations));
    assert!((seen - squares).amax() < 1e-14 * squares.amax());
    let identity = StarTracker::new(Quaternion::identity(), deviations, 8, "st").unwrap();
    assert!((identity.covariance() - squares).amax() <= 1e-16 * squares.amax());
}
