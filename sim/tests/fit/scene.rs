//! The wheel of the acceptance: lines, modes, speeds, noise, and what its fit should find.
//!
//! Forty steps from 1200 to 6000 rpm, each 1024 samples at 1 kHz: 1.024 s, bins of 0.98 Hz. The noise of each
//! channel is such that the weakest line of its force or moment has, at the middle speed of 3600 rpm and
//! without amplification, 100 times (20 dB) the power that noise has in one bin of Hann's window (1.5 / 1.024
//! s). Lines 2.86 and 3.14 are 5.7 bins apart at the lowest speed, and cross the rocking mode, as 2 does; the
//! radial mode is crossed by 2, 2.86, 3.14 and 5.2.

use std::f64::consts::TAU;

use nalgebra::{Matrix3, Vector3};
use precess::fit::{Group, Measurement, Mode, ModeGuess, Options, Record, TablePose};

use super::synthetic::{Bearing, Random, Source, Step, Wheel};

/// Fixed before any trial was run.
pub(crate) const SEED: u64 = 20_261_123;
pub(crate) const RATE: f64 = 1000.0;
pub(crate) const LENGTH: usize = 1024;
pub(crate) const STEPS: u32 = 40;
pub(crate) const SLOWEST: f64 = 1200.0;
pub(crate) const FASTEST: f64 = 6000.0;
/// Power of the weakest line by that of noise in a bin at the middle speed.
const LINE_TO_NOISE: f64 = 100.0;
/// Equivalent noise bandwidth of Hann's window, bins.
const HANN: f64 = 1.5;
/// Force and moment coefficients: kg m, kg m².
pub(crate) const U_S: f64 = 1.5e-6;
pub(crate) const U_D: f64 = 2.2e-7;
pub(crate) const PHASE: f64 = 0.9;
pub(crate) const ANGLE: f64 = -0.4;
#[expect(clippy::approx_constant, reason = "a harmonic number, not pi")]
pub(crate) const H: [f64; 5] = [1.0, 2.0, 2.86, 3.14, 5.2];
const WEAKEST: [f64; 2] = [1e-6, 1.5e-7];

pub(crate) fn rpm(speed: f64) -> f64 {
    speed * TAU / 60.0
}

pub(crate) fn wheel() -> Wheel {
    let line = |h, f: f64, t: f64, backward: f64, axial: f64| Source {
        h,
        fx: axial * WEAKEST[0],
        f_forward: f * WEAKEST[0],
        f_backward: backward * WEAKEST[0],
        tx: axial * WEAKEST[1],
        t_forward: t * WEAKEST[1],
        t_backward: backward * WEAKEST[1],
        lead: 0.5,
        phase: 1.1,
    };
    let imbalance = Source {
        h: 1.0,
        f_forward: U_S,
        t_forward: U_D,
        lead: PHASE,
        phase: ANGLE,
        ..Source::default()
    };
    let sources = vec![
        imbalance,
        line(H[1], 1.0, 1.0, 0.0, 1.0),
        line(H[2], 1.2, 1.0, 0.0, 0.0),
        line(H[3], 1.0, 1.3, 1.0, 0.0),
        line(H[4], 1.1, 1.0, 0.0, 1.2),
    ];
    let middle = rpm(0.5 * (SLOWEST + FASTEST));
    let seconds = LENGTH as f64 / RATE;
    let noise = WEAKEST.map(|c| {
        // A² / 2 = 100 S 1.5 / T, S = 2 sigma² / rate.
        let power = 0.5 * (c * middle * middle).powi(2);
        (power * seconds / (LINE_TO_NOISE * HANN) * RATE / 2.0).sqrt()
    });
    // Of the table, the wheel's x is z.
    let (x, y) = (Vector3::z(), Vector3::x());
    Wheel {
        sources,
        radial: Bearing {
            inertia: 2.0,
            spin: 0.0,
            stiffness: 2.0 * (TAU * 210.0_f64).powi(2),
            damping: 2.0 * 2.0 * 0.02 * TAU * 210.0,
        },
        tilting: Bearing {
            inertia: 0.006,
            spin: 0.0096,
            stiffness: 0.006 * (TAU * 140.0_f64).powi(2),
            damping: 2.0 * 0.006 * 0.025 * TAU * 140.0,
        },
        noise,
        position: Vector3::new(0.01, -0.02, 0.08),
        axes: Matrix3::from_columns(&[x, y, x.cross(&y)]),
    }
}

/// What differs between trials.
#[derive(Clone, Copy, Default)]
pub(crate) struct Variant {
    /// Whether there are index pulses.
    pub(crate) indexed: bool,
    /// Change of the speed over a step, as a share.
    pub(crate) drift: f64,
    /// Standard deviation of the stated speeds, as a share.
    pub(crate) speeds: f64,
}

pub(crate) fn placement(wheel: &Wheel) -> TablePose {
    let axis = wheel.axes.column(0).into_owned();
    let reference = wheel.axes.column(1).into_owned();
    TablePose::new(wheel.position, axis, reference, false).expect("axes")
}

/// A measurement of the wheel.
pub(crate) fn measured(wheel: &Wheel, variant: Variant, random: &mut Random) -> Measurement {
    let placement = placement(wheel);
    let records = (0..STEPS).map(|k| {
        let share = f64::from(k) / f64::from(STEPS - 1);
        let speed = rpm(SLOWEST + share * (FASTEST - SLOWEST));
        let drift = variant.drift * speed * RATE / LENGTH as f64;
        let step = Step { speed, drift, rate: RATE, length: LENGTH };
        let written = wheel.measured(&step, random);
        Record {
            name: format!("step {k}"),
            rate: RATE,
            speed: speed * (1.0 + variant.speeds * random.normal()),
            drift: 0.0,
            pulses: if variant.indexed { written.pulses } else { Vec::new() },
            channels: placement.referred_samples(&written.channels),
        }
    });
    Measurement { records: records.collect() }
}

/// Options with lines and modes stated near their places.
pub(crate) fn stated(variant: Variant) -> Options {
    let guess = |group, hertz: f64, ratio: f64| ModeGuess {
        group,
        mode: Mode { frequency: TAU * hertz, damping: 0.03, inertia_ratio: ratio, share: 1.0 },
        fit_ratio: ratio > 0.0,
        fit_share: false,
    };
    Options {
        harmonics: H
            .iter()
            .enumerate()
            .map(|(k, h)| h + if k == 0 { 0.0 } else { 0.002 })
            .collect(),
        modes: Some(vec![
            guess(Group::RadialForce, 200.0, 0.0),
            guess(Group::RadialTorque, 150.0, 1.5),
        ]),
        speed_accuracy: variant.speeds,
        ..Options::default()
    }
}
