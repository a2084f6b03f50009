//! [`Sweep`]: the lines of a model at many speeds, on any number of threads; the result does not depend on it.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

use super::campbell::Crossing;
use super::model::{Contributor, Line, Model};
use super::noise::{Densities, NoiseSweep};
use super::weight::Weight;
use crate::structure::Fault;

/// Speeds at which the density of noise is computed, about.
const NOISE_SPEEDS: usize = 24;
/// Speeds on each side of a crossing, how far they go in half-widths, and the least half-width, of the speed.
const BESIDE: i32 = 16;
const WIDTHS: f64 = 6.0;
const WIDTH_MIN: f64 = 1e-5;
/// Speeds that a sweep may have.
pub const SPEEDS_MAX: usize = 1_000_000;

/// Lines over speeds.
#[derive(Clone, Debug)]
pub struct Sweep {
    /// Speeds, rad/s, rising.
    pub speeds: Vec<f64>,
    /// Names of the outputs.
    pub outputs: Vec<String>,
    /// What the lines are of.
    pub contributors: Vec<Contributor>,
    /// At each speed, a line for each contributor.
    pub lines: Vec<Vec<Line>>,
    /// Densities by broadband noise, at some speeds.
    pub noise: NoiseSweep,
}

/// How lines of one frequency are added.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Phases {
    /// Phases between rotors are unknown and independent: mean squares are added.
    #[default]
    Unknown,
    /// Phases are those of the scenario's initial angles: amplitudes are added before they are squared.
    Given,
    /// The worst phases: magnitudes are added.
    Worst,
}

impl Phases {
    /// The assumption as a budget has it: `unknown`, `given`, `worst`.
    #[must_use]
    pub const fn word(self) -> &'static str {
        match self {
            Self::Unknown => "unknown",
            Self::Given => "given",
            Self::Worst => "worst",
        }
    }

    /// The assumption in words.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::Unknown => "phases unknown (expected)",
            Self::Given => "phases as given",
            Self::Worst => "worst phases",
        }
    }
}

/// Equal steps from one speed to another, both included.
#[must_use]
pub fn speeds([from, to]: [f64; 2], count: usize) -> Vec<f64> {
    let last = count.saturating_sub(1).max(1);
    #[expect(clippy::cast_precision_loss, reason = "at most SPEEDS_MAX")]
    let at = |index: usize| from + (to - from) * (index as f64 / last as f64);
    (0..count).map(at).collect()
}

/// Speeds with more around each crossing of an order and a natural frequency, so that a peak between two of them is not
/// missed: to a twentieth of its half-power width.
#[must_use]
pub fn refined(mut speeds: Vec<f64>, [from, to]: [f64; 2], crossings: &[Crossing]) -> Vec<f64> {
    for crossing in crossings {
        let width = crossing.oscillation.damping.max(WIDTH_MIN) * crossing.speed;
        for k in -BESIDE..=BESIDE {
            let share = f64::from(k) / f64::from(BESIDE);
            // Close at the peak, wider beside it.
            speeds.push(crossing.speed + WIDTHS * width * share * share.abs());
        }
    }
    speeds.retain(|speed| (from..=to).contains(speed));
    speeds.sort_by(f64::total_cmp);
    speeds.dedup();
    speeds
}

/// The speeds at which the density of noise is computed, about [`NOISE_SPEEDS`] of them; none without noise.
fn noise_speeds(model: &Model, speeds: &[f64]) -> Vec<f64> {
    if model.noises.is_empty() { Vec::new() } else { some_of(speeds) }
}

/// About [`NOISE_SPEEDS`] of some speeds, first and last among them.
pub(crate) fn some_of(speeds: &[f64]) -> Vec<f64> {
    let step = speeds.len().div_ceil(NOISE_SPEEDS).max(1);
    let mut some: Vec<f64> = speeds.iter().copied().step_by(step).collect();
    some.extend(speeds.last().filter(|last| Some(*last) != some.last()));
    some
}

/// The parts of the work of [`sweep`], which its `progress` counts.
#[must_use]
pub fn parts(model: &Model, speeds: &[f64]) -> usize {
    speeds.len() + noise_speeds(model, speeds).len()
}

/// What a thread computes.
enum Part {
    Lines(Vec<Line>),
    Noise(Densities),
}

/// The lines of a model at some speeds, and the noise. `progress` is called with the number of [`parts`] that are done.
///
/// # Errors
/// The fault of the lowest speed that has one; [`Fault::Number`] for no speed, or too many.
pub fn sweep(
    model: &Model,
    speeds: &[f64],
    threads: usize,
    progress: &(dyn Fn(usize) + Sync),
) -> Result<Sweep, Fault> {
    if speeds.is_empty() || speeds.len() > SPEEDS_MAX {
        let (what, range) = (String::from("speeds"), [1, SPEEDS_MAX]);
        return Err(Fault::Number { what, found: speeds.len(), range });
    }
    let of_noise = noise_speeds(model, speeds);
    let next = AtomicUsize::new(0);
    let done = AtomicUsize::new(0);
    // The noise first: a speed of it takes longest.
    let part = |index: usize| -> Option<Result<Part, Fault>> {
        if let Some(speed) = of_noise.get(index) {
            return Some(Densities::new(model, *speed).map(Part::Noise));
        }
        let speed = speeds.get(index - of_noise.len())?;
        Some(model.lines(*speed).map(Part::Lines))
    };
    let work = || {
        let mut found = Vec::new();
        loop {
            let index = next.fetch_add(1, Ordering::Relaxed);
            let Some(part) = part(index) else { return found };
            found.push((index, part));
            progress(done.fetch_add(1, Ordering::Relaxed) + 1);
        }
    };
    let mut found = thread::scope(|scope| {
        // No more than there are parts: another would have nothing to do.
        let threads = threads.clamp(1, parts(model, speeds).max(1));
        let threads: Vec<_> = (1..threads).map(|_| scope.spawn(work)).collect();
        let mut found = work();
        for thread in threads {
            match thread.join() {
                Ok(of_thread) => found.extend(of_thread),
                Err(panic) => std::panic::resume_unwind(panic),
            }
        }
        found
    });
    found.sort_by_key(|(index, _)| *index);
    let mut sweep = Sweep {
        noise: NoiseSweep::default(),
        speeds: speeds.to_vec(),
        outputs: model.outputs.clone(),
        contributors: model.contributors(),
        lines: Vec::with_capacity(speeds.len()),
    };
    for (_, part) in found {
        match part? {
            Part::Lines(lines) => sweep.lines.push(lines),
            Part::Noise(densities) => sweep.noise.speeds.push(densities),
        }
    }
    Ok(sweep)
}

impl Sweep {
    /// Mean square of some outputs at a speed, weighted: of lines and noise.
    #[must_use]
    pub fn mean_square(
        &self,
        speed: usize,
        outputs: &[usize],
        phases: Phases,
        weight: &Weight,
    ) -> f64 {
        self.line_square(speed, outputs, phases, weight) + self.noise_square(speed, outputs, weight)
    }

    /// The part of [`Self::mean_square`] that is of lines.
    #[must_use]
    pub fn line_square(
        &self,
        speed: usize,
        outputs: &[usize],
        phases: Phases,
        weight: &Weight,
    ) -> f64 {
        self.squares(speed, outputs, phases, weight).iter().map(|(_, square)| square).sum()
    }

    /// The part of [`Self::mean_square`] that is of broadband noise.
    #[must_use]
    pub fn noise_square(&self, speed: usize, outputs: &[usize], weight: &Weight) -> f64 {
        let speed = self.speeds.get(speed).copied().unwrap_or(0.0);
        self.noise.mean_square(speed, outputs, weight)
    }

    /// Whether a line or noise has a share by a weight, at any speed.
    #[must_use]
    pub fn has_share(&self, weight: &Weight) -> bool {
        let mut lines = self.lines.iter().flatten();
        lines.any(|line| weight.at(line.frequency) > 0.0) || self.noise.has_share(weight)
    }
}
