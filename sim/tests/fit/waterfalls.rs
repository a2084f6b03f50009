//! Waterfalls of the wheel of `scene.rs`: spectra of its time series, averaged over segments (Welch's method).

use std::f64::consts::TAU;

use precess::fit::{Group, Mode, ModeGuess, Options, WaterfallRow};
use realfft::RealFftPlanner;

use super::scene::{RATE, STEPS, rpm, wheel};
use super::synthetic::{Random, Step, Wheel};

/// Samples of a segment, and segments without overlap.
const SEGMENT: usize = 256;
const SEGMENTS: usize = 12;

/// How spectra are averaged, and how much noise there is.
#[derive(Clone, Copy)]
pub(crate) struct Averaging {
    /// Samples from one segment to the next.
    pub(crate) hop: usize,
    /// Independent segments that each counts as.
    pub(crate) counts_as: f64,
    /// Noise by that of `scene.rs`.
    pub(crate) noise: f64,
}

/// Twelve segments that do not overlap. The weakest line is 20 dB above the noise in a bin of the records of
/// `scene.rs`, so 14 dB in one of a segment, which is four times as wide.
pub(crate) const APART: Averaging = Averaging { hop: SEGMENT, counts_as: 1.0, noise: 1.0 };
/// Segments that overlap by half.
pub(crate) const HALF: Averaging = Averaging { hop: SEGMENT / 2, counts_as: 0.92, ..APART };

/// Mean one-sided density with Hann's window.
fn density(samples: &[f64], hop: usize) -> Vec<f64> {
    let n = SEGMENT as f64;
    let window: Vec<f64> = (0..SEGMENT).map(|k| 0.5 - 0.5 * (TAU * k as f64 / n).cos()).collect();
    let squares: f64 = window.iter().map(|w| w * w).sum();
    let transform = RealFftPlanner::<f64>::new().plan_fft_forward(SEGMENT);
    let mut spectrum = transform.make_output_vec();
    let mut mean = vec![0.0; spectrum.len()];
    let segments = samples.windows(SEGMENT).step_by(hop);
    let scale = 2.0 / (RATE * squares * segments.len() as f64);
    for segment in segments {
        let mut tapered: Vec<f64> = segment.iter().zip(&window).map(|(x, w)| x * w).collect();
        transform.process(&mut tapered, &mut spectrum).expect("lengths of the plan");
        for (value, x) in mean.iter_mut().zip(&spectrum) {
            *value += scale * x.norm_sqr();
        }
    }
    mean
}

/// The wheel with forward lines only, since a waterfall cannot tell; about W, in the wheel's axes.
pub(crate) fn wheel_of_spectra(averaging: Averaging) -> Wheel {
    let mut wheel = wheel();
    wheel.noise = wheel.noise.map(|deviation| averaging.noise * deviation);
    wheel.sources.retain(|source| source.f_backward == 0.0);
    wheel.position *= 0.0;
    wheel.axes = nalgebra::Matrix3::identity();
    wheel
}

/// Spectra at forty speeds from 1800 to 6000 rpm.
pub(crate) fn rows(wheel: &Wheel, averaging: Averaging, random: &mut Random) -> Vec<WaterfallRow> {
    let row = |k: u32| {
        let speed = rpm(1800.0 + 4200.0 * f64::from(k) / f64::from(STEPS - 1));
        let step = Step { speed, drift: 0.0, rate: RATE, length: SEGMENT * SEGMENTS };
        let written = wheel.measured(&step, random);
        let segments = (step.length - SEGMENT) / averaging.hop + 1;
        WaterfallRow {
            speed,
            bin: RATE / SEGMENT as f64,
            segments: averaging.counts_as * segments as f64,
            densities: written.channels.each_ref().map(|samples| density(samples, averaging.hop)),
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
