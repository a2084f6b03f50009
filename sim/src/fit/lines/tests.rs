//! Variances of the lines of one record against their scatter over many.

use std::f64::consts::TAU;

use super::super::measurement::Record;
use super::super::rotation::Rotation;
use super::*;

const LENGTH: usize = 512;
const RATE: f64 = 500.0;
const RECORDS: u32 = 400;
/// Of 400 draws a variance is known to 7 %; this is more than three of that.
const SCATTER: f64 = 0.25;
/// Of the mean of 400 draws: four of its standard deviations.
const MEAN: f64 = 4.0 / 20.0;
const NOISE: f64 = 0.1;

/// Uniform numbers of `SplitMix64`, twelve to a normal one.
fn normal(state: &mut u64) -> f64 {
    let mut sum = -6.0;
    for _ in 0..12 {
        *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = *state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        sum += f64::from(u32::try_from((z ^ (z >> 31)) >> 32).unwrap_or(0)) / 4_294_967_296.0;
    }
    sum
}

#[test]
fn amplitudes_and_steps_scatter_as_they_say() {
    // 20 Hz, and a line 3 bins from it that is ten times as large.
    let speed = 20.0 * TAU;
    let near = 1.0 + 3.0 * RATE / float(LENGTH) / 20.0;
    let rotation = Rotation::stated(speed, 0.0);
    let mut transforms = Transforms::default();
    let mut state = 20_261_123;
    let mut found = Vec::new();
    for _ in 0..RECORDS {
        let channels = std::array::from_fn(|_| {
            (0..LENGTH)
                .map(|index| {
                    let t = time(index, LENGTH, RATE);
                    (speed * t).cos() + 10.0 * (near * speed * t).sin() + NOISE * normal(&mut state)
                })
                .collect()
        });
        let record =
            Record { name: String::new(), rate: RATE, speed, drift: 0.0, pulses: vec![], channels };
        let all = lines(&record, &rotation, &[1.0, near], &[], &mut transforms).expect("lines");
        found.push(all.sets[0].expect("a line").channels[2]);
    }
    let mean = |of: &dyn Fn(&Line) -> f64| found.iter().map(of).sum::<f64>() / f64::from(RECORDS);
    let by_stated = [
        mean(&|line| (line.amplitude - 1.0).norm_sqr() / line.noise),
        mean(&|line| line.step * line.step / line.step_variance),
        mean(&|line| line.bend * line.bend / line.bend_variance),
    ];
    assert!(by_stated.iter().all(|ratio| (ratio - 1.0).abs() < SCATTER), "{by_stated:?}");
    let means = [
        mean(&|line| (line.amplitude.re - 1.0) / (0.5 * line.noise).sqrt()),
        mean(&|line| line.step / line.step_variance.sqrt()),
    ];
    assert!(means.iter().all(|mean| mean.abs() < MEAN), "{means:?}");
    // E|dA|² of white noise in closed form: 4 v sum w² / (sum w)² is 4 v (3 / 8) / (n / 4).
    let closed = 4.0 * NOISE * NOISE * 1.5 / float(LENGTH);
    assert!((mean(&|line| line.noise) / closed - 1.0).abs() < 0.5 * SCATTER);
}

#[test]
fn a_frequency_that_is_off_is_met_by_its_step() {
    let (speed, off) = (20.0 * TAU, 0.02);
    let channels = std::array::from_fn(|_| {
        let sample = |index: usize| ((speed + off) * time(index, LENGTH, RATE)).cos();
        (0..LENGTH).map(sample).collect()
    });
    let record =
        Record { name: String::new(), rate: RATE, speed, drift: 0.0, pulses: vec![], channels };
    let rotation = Rotation::stated(speed, 0.0);
    let all = lines(&record, &rotation, &[1.0], &[], &mut Transforms::default()).expect("lines");
    let step = all.sets[0].expect("a line").channels[0].step;
    // Gauss and Newton's step errs by the square of the phase at the ends, 0.01 rad.
    assert!((step / off - 1.0).abs() < 1e-3, "{step}");
}
