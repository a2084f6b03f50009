//! Waterfalls of the wheel of `scene.rs`: spectra that are made here by sums of sines and cosines.

use std::f64::consts::TAU;

use precess::fit::{Group, Mode, ModeGuess, Options, WaterfallRow};

use super::scene::{STEPS, rpm, wheel};
use super::synthetic::{Random, Step, Wheel};

const RATE: f64 = 1000.0;
/// Samples of a segment; segments, which do not overlap.
const SEGMENT: usize = 256;
const SEGMENTS: usize = 12;

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

/// The wheel with forward lines only, since a waterfall cannot tell; about W, in the wheel's axes.
pub(crate) fn wheel_of_spectra() -> Wheel {
    let mut wheel = wheel();
    wheel.sources.retain(|source| source.f_backward == 0.0);
    wheel.position *= 0.0;
    wheel.axes = nalgebra::Matrix3::identity();
    wheel
}

/// Spectra at forty speeds from 1800 to 6000 rpm.
pub(crate) fn rows(wheel: &Wheel, random: &mut Random) -> Vec<WaterfallRow> {
    let row = |k: u32| {
        let speed = rpm(1800.0 + 4200.0 * f64::from(k) / f64::from(STEPS - 1));
        let step = Step { speed, drift: 0.0, rate: RATE, length: SEGMENT * SEGMENTS };
        let written = wheel.measured(&step, random);
        WaterfallRow {
            speed,
            bin: RATE / SEGMENT as f64,
            segments: SEGMENTS as f64,
            densities: written.channels.each_ref().map(|samples| density(samples)),
        }
    };
    (0..STEPS).map(row).collect()
}

/// Modes near their places; lines are found, unless they are stated near theirs.
pub(crate) fn options(wheel: &Wheel, stated: bool) -> Options {
    let guess = |group, hertz: f64, ratio: f64| ModeGuess {
        group,
        mode: Mode { frequency: TAU * hertz, damping: 0.03, inertia_ratio: ratio, share: 1.0 },
        fit_ratio: ratio > 0.0,
        fit_share: false,
    };
    let modes =
        vec![guess(Group::RadialForce, 205.0, 0.0), guess(Group::RadialTorque, 145.0, 1.55)];
    let near = |h: f64| if h == 1.0 { h } else { h + 0.002 };
    let harmonics = wheel.sources.iter().map(|source| near(source.h));
    let harmonics = if stated { harmonics.collect() } else { Vec::new() };
    Options { harmonics, modes: Some(modes), ..Options::default() }
}
