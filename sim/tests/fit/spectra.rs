//! A fit to a waterfall, whose spectra are made here by sums of sines and cosines.

use std::f64::consts::TAU;

use precess::fit::{Group, Mode, ModeGuess, Options, WaterfallRow, fit_waterfall};

use super::scene::{SEED, STEPS, U_D, U_S, rpm, wheel};
use super::synthetic::{Random, Step};

const RATE: f64 = 1000.0;
/// Samples of a segment; segments, which do not overlap.
const SEGMENT: usize = 256;
const SEGMENTS: usize = 12;
/// The acceptance, and what a segment of a quarter of the records leaves of it.
const IMBALANCE: f64 = 0.02;
const NUMBER: f64 = 5e-3;
const MODE: f64 = 0.01;

/// Mean one-sided density with Hann's window.
fn density(samples: &[f64]) -> Vec<f64> {
    let n = SEGMENT as f64;
    let window = |k: usize| 0.5 - 0.5 * (TAU * k as f64 / n).cos();
    let squares: f64 = (0..SEGMENT).map(|k| window(k) * window(k)).sum();
    let table: Vec<(f64, f64)> = (0..SEGMENT).map(|k| (TAU * k as f64 / n).sin_cos()).collect();
    let mut mean = vec![0.0; SEGMENT / 2 + 1];
    for segment in samples.chunks_exact(SEGMENT) {
        let tapered: Vec<f64> = segment.iter().enumerate().map(|(k, x)| x * window(k)).collect();
        for (bin, value) in mean.iter_mut().enumerate() {
            let (mut re, mut im) = (0.0, 0.0);
            for (k, x) in tapered.iter().enumerate() {
                let (sine, cosine) = table[bin * k % SEGMENT];
                re += x * cosine;
                im += x * sine;
            }
            *value += 2.0 * (re * re + im * im) / (RATE * squares * SEGMENTS as f64);
        }
    }
    mean
}

#[test]
fn a_waterfall_gives_the_imbalance_and_the_radial_mode() {
    let mut wheel = wheel();
    // Forward lines only, since a waterfall cannot tell; about W, in the wheel's axes.
    wheel.sources.retain(|source| source.f_backward == 0.0);
    wheel.position *= 0.0;
    wheel.axes = nalgebra::Matrix3::identity();
    let mut random = Random::new(SEED);
    let rows: Vec<WaterfallRow> = (0..STEPS)
        .map(|k| {
            let speed = rpm(1800.0 + 4200.0 * f64::from(k) / f64::from(STEPS - 1));
            let step = Step { speed, drift: 0.0, rate: RATE, length: SEGMENT * SEGMENTS };
            let written = wheel.measured(&step, &mut random);
            WaterfallRow {
                speed,
                bin: RATE / SEGMENT as f64,
                segments: SEGMENTS as f64,
                densities: written.channels.each_ref().map(|samples| density(samples)),
            }
        })
        .collect();
    let guess = |group, hertz: f64, ratio: f64| ModeGuess {
        group,
        mode: Mode { frequency: TAU * hertz, damping: 0.03, inertia_ratio: ratio, share: 1.0 },
        fit_ratio: ratio > 0.0,
        fit_share: false,
    };
    let modes =
        vec![guess(Group::RadialForce, 205.0, 0.0), guess(Group::RadialTorque, 145.0, 1.55)];
    let options = Options { modes: Some(modes), ..Options::default() };
    let fitted = fit_waterfall(&rows, &options).expect("it fits");
    let numbers: Vec<f64> = fitted.harmonics.iter().map(|h| h.number.value).collect();
    for (found, put_in) in numbers.iter().zip([1.0, 2.0, 2.86, 5.2]) {
        assert!((found / put_in - 1.0).abs() < NUMBER, "{numbers:?}");
    }
    let imbalance = [fitted.imbalance.u_s, fitted.imbalance.u_d];
    for (found, put_in) in imbalance.iter().zip([U_S, U_D]) {
        assert!((found.value / put_in - 1.0).abs() < IMBALANCE, "{found:?}");
    }
    for (mode, hertz) in fitted.modes.iter().zip([210.0, 140.0]) {
        assert!((mode.frequency.value / (TAU * hertz) - 1.0).abs() < MODE, "{mode:?}");
    }
    assert!(fitted.imbalance.phase.is_none() && fitted.imbalance.angle.is_none());
    assert!(fit_waterfall(&rows[..2], &options).is_err());
    let mut bad = rows;
    bad[1].densities[2][9] = -1.0;
    assert!(fit_waterfall(&bad, &options).is_err());
}
