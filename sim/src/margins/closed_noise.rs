//! [`ClosedNoise`]: densities of outputs by noise through the loop of a controller: of sources, and of what sensors read.
//!
//! Samples show noise at f and at all `f + k rate` at one frequency, and the torque that is held between them has components at all
//! of these. At a frequency nu
//!
//! ```text
//! S(nu) = sum over k of |H_k(nu)|² S_f(|nu + k rate|) + 2 T |H_n(nu)|² Sigma(e^(i 2 pi nu T))
//! ```
//!
//! `H_k` is from a force at `nu + k rate` to the output at nu: of k = 0 with the force itself, of the others by what the controller does, for
//! nu up to half the rate; what the held torque has of these above, smaller by the hold and by the inertia, is left out. `Sigma` is the spectrum of the readings' noise, two-sided, per sample: a covariance where it is white
//! (Astrom, Wittenmark, 3rd edition, chapter 11).

use std::f64::consts::{PI, TAU};

use nalgebra::{Complex, Matrix3};
use precess_control::GyroOutput;

use super::MarginsError;
use super::analysis::{ControlLoop, alias};
use super::measurement::{READ, ReadingNoise};
use super::sampled::Forced;
use crate::jitter::campbell::Oscillation;
use crate::jitter::noise::{Densities, Noises};
use crate::scenario::SampledController;
use crate::structure::accelerance::{ComplexMatrix, complex};
use crate::structure::{COORDINATES, Fault};

/// The lowest frequency, as a share of that of the slowest pole: below it a thousandth of the mean square at most is of a loop.
const LOWEST: f64 = 1e-3;
/// The highest frequency of noise of sensors, as a multiple of the rate of samples.
const HIGHEST: f64 = 4.0;
/// A pole that is slower than this share of the rate of samples is none of the loop.
const SLOWEST: f64 = 1e-6;
/// A pole of a smaller magnitude is over within a sample.
const FAST: f64 = 1e-3;

/// What is summed: noise of sources at its own frequency; what the samples alias of it; noise of what sensors read.
pub const CLOSED_NOISE: [&str; 3] = ["sources", "sources, aliased", "sensors"];

/// Densities by noise through a loop at one speed.
#[derive(Clone, Debug, PartialEq)]
pub struct ClosedNoise {
    /// All together.
    pub whole: Densities,
    /// Each of [`CLOSED_NOISE`].
    pub parts: [Densities; 3],
}

/// Noise of the readings by frequency.
#[derive(Clone, Copy, Debug)]
pub struct ReadingSpectrum {
    /// What is white.
    white: ReadingNoise,
    /// Variance that the bias of the gyro's rate gains in a sample, (rad/s)².
    walk: f64,
}

impl ReadingSpectrum {
    /// That of a controller's sensors. The bias of a gyro that walks has a part where an estimator follows it: without one its
    /// variance has no end.
    ///
    /// # Errors
    /// [`MarginsError::Control`].
    pub fn of_sensors(of: &SampledController) -> Result<Self, MarginsError> {
        let mut white = ReadingNoise::of_sensors(of)?;
        let mut walk = 0.0;
        if let Some(gyro) = of.sensors.gyro
            && of.estimator.is_some()
        {
            walk = gyro.rate_random_walk.powi(2) / of.rate;
            // The mean over a sample of the walk within it is not the bias at its end; its white part is in the spectrum of the walk.
            if gyro.output == GyroOutput::Integrating {
                white.rate = gyro.angle_random_walk * of.rate.sqrt();
            }
        }
        Ok(Self { white, walk })
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        self.white == ReadingNoise::default() && self.walk == 0.0
    }

    /// `Sigma` of attitude and of the rate about each axis, for a turn of z of w T, rad.
    fn at(&self, angle: f64) -> (Matrix3<f64>, f64) {
        let half = 2.0 * libm::sin(0.5 * angle);
        let walk = if self.walk > 0.0 { self.walk / (half * half) } else { 0.0 };
        (self.white.attitude, self.white.rate * self.white.rate + walk)
    }
}

/// A loop, and what acts on it.
struct NoiseLoop<'a> {
    of: &'a ControlLoop,
    reading: ReadingSpectrum,
    noises: Noises<'a>,
    /// Bands of the sources, Hz.
    bands: Vec<[f64; 2]>,
    /// Loads by forces and moments on the mounts.
    loads: ComplexMatrix,
}

impl ControlLoop {
    /// Densities by noise of the model's sources and of the readings.
    ///
    /// # Errors
    /// Those of [`Self::lines`]; poles that do not converge.
    pub fn closed_noise(&self, reading: ReadingSpectrum) -> Result<ClosedNoise, MarginsError> {
        let model = &self.plant.model;
        let mounts = model.mounts.len();
        let mut loads = ComplexMatrix::zeros(self.plant.reduced.ncols(), COORDINATES * mounts);
        for mount in 0..mounts {
            let own = complex(&self.plant.mount_loads(mount));
            loads.columns_mut(COORDINATES * mount, COORDINATES).copy_from(&own);
        }
        let bands: Vec<[f64; 2]> = model.noises.iter().map(|noise| noise.density.band).collect();
        let folded = 0.5 * self.rate;
        let highest = bands.iter().map(|[_, to]| *to).fold(HIGHEST * self.rate, f64::max);
        let natural = self.natural(folded)?;
        let angular = natural.iter().map(|of| of.frequency.hypot(of.damping * of.frequency));
        let slowest = angular.fold(PI * self.rate, f64::min) / TAU;
        let lowest = LOWEST * slowest;
        let tables = model.noises.iter().flat_map(|noise| noise.density.frequencies.clone());
        // The ends of bands are seen folded, too.
        let ends = bands.iter().flatten().flat_map(|end| [*end, alias(*end, self.rate).abs()]);
        let within: Vec<f64> = tables
            .chain(ends)
            .chain([folded])
            .filter(|hertz| *hertz > lowest && *hertz < highest)
            .collect();
        let own = NoiseLoop {
            of: self,
            reading,
            noises: Noises::new(model, self.plant.speed),
            bands,
            loads,
        };
        let count = model.outputs.len();
        let all = Densities::over(
            self.plant.speed,
            (&[[lowest, highest]], within.into_iter()),
            &natural,
            |hertz| own.density(hertz, hertz <= folded),
        )?;
        let part = |number: usize| {
            let values = all.values.iter();
            let values =
                values.map(|of| of.iter().skip(number * count).take(count).copied().collect());
            Densities { values: values.collect(), ..all.clone() }
        };
        let parts = [part(0), part(1), part(2)];
        let sum = |of: &Vec<f64>| {
            let sum = |output: usize| of.iter().skip(output).step_by(count.max(1)).sum();
            (0..count).map(sum).collect()
        };
        let whole = Densities { values: all.values.iter().map(sum).collect(), ..all.clone() };
        Ok(ClosedNoise { whole, parts })
    }

    /// Oscillations of the spacecraft above half the rate of samples, Hz, and poles of the loop.
    fn natural(&self, folded: f64) -> Result<Vec<Oscillation>, MarginsError> {
        let above = self.plant.oscillations().into_iter().filter(|[hertz, _]| *hertz > folded);
        let mut found: Vec<Oscillation> =
            above.map(|[hertz, damping]| Oscillation { frequency: TAU * hertz, damping }).collect();
        for z in self.closed.poles()?.into_iter().filter(|z| z.norm() > FAST && z.im >= 0.0) {
            let s = z.ln() * self.rate;
            // One that does not oscillate has no peak: of it the size counts.
            found.push(if s.im < 1e-9 * s.norm() {
                Oscillation { frequency: s.norm(), damping: 1.0 }
            } else {
                Oscillation { frequency: s.im, damping: -s.re / s.im }
            });
        }
        found.retain(|of| of.frequency > SLOWEST * self.rate);
        Ok(found)
    }
}

impl NoiseLoop<'_> {
    /// Densities of the outputs by each of [`CLOSED_NOISE`], at a frequency, Hz, with what other frequencies are seen at it or
    /// without.
    fn density(&self, hertz: f64, folds: bool) -> Result<Vec<f64>, Fault> {
        let (of, count) = (self.of, self.of.plant.model.outputs.len());
        let omega = TAU * hertz;
        let unbounded = || Fault::Unbounded { frequency: omega };
        let (at, samples) = (of.plant.at_frequency(omega), of.at_samples(omega));
        let mut values = vec![0.0; 3 * count];
        let mut add = |part: usize, found: Vec<f64>| {
            let own = values.iter_mut().skip(part * count);
            own.zip(found).for_each(|(to, value)| *to += value);
        };
        for (k, w) in self.seen_at(hertz, folds) {
            let own = (k == 0).then_some(&at);
            let other = own.is_none().then(|| of.plant.at_frequency(w));
            let Some(plant) = own.or(other.as_ref()) else { continue };
            let forced = of.forced(plant, (w, &self.loads), false)?;
            let sampled = samples.through(&forced).ok_or_else(unbounded)?;
            let mut states = at.driven(&of.torques_at(&forced, (omega, &sampled)))?;
            let found = if k == 0 {
                states += &forced.states;
                at.outputs(&states, &self.loads)
            } else {
                at.outputs(&states, &ComplexMatrix::zeros(self.loads.nrows(), states.ncols()))
            };
            // Components that share noise have the conjugate phases at a negative frequency.
            let found = if w < 0.0 { found.map(|value| value.conj()) } else { found };
            add(usize::from(k != 0), self.noises.density(w.abs() / TAU, &found));
        }
        if !self.reading.is_zero() {
            let period = of.samples.sampling.period;
            let (states, loads) = (of.plant.a.nrows(), self.loads.nrows());
            let forced = Forced {
                frequency: omega,
                known: ComplexMatrix::zeros(of.plant.reduced.nrows(), READ),
                states: ComplexMatrix::zeros(states, READ),
                noise: ComplexMatrix::identity(READ, READ),
            };
            let sampled = samples.through(&forced).ok_or_else(unbounded)?;
            let states = at.driven(&of.torques_at(&forced, (omega, &sampled)))?;
            let by = at.outputs(&states, &ComplexMatrix::zeros(loads, READ));
            let (attitude, rate) = self.reading.at(omega * period);
            let attitude = attitude.map(|value| Complex::new(value, 0.0));
            let square = |row: usize| {
                let own = by.fixed_view::<1, 3>(row, 0);
                let of_attitude = (own * attitude * own.adjoint())[(0, 0)].re;
                let of_rate: f64 = (3..READ).map(|k| by[(row, k)].norm_sqr()).sum();
                2.0 * period * (of_attitude + of_rate * rate)
            };
            add(2, (0..count).map(square).collect());
        }
        Ok(values)
    }

    /// Angular frequencies, rad/s, at which sources act and that are seen at one, Hz, with the number of the image: that one is 0.
    fn seen_at(&self, hertz: f64, folds: bool) -> Vec<(i32, f64)> {
        let acts = |of: f64| self.bands.iter().any(|[from, to]| *from <= of && of <= *to);
        let highest = self.bands.iter().map(|[_, to]| *to).fold(0.0, f64::max);
        #[expect(clippy::cast_possible_truncation, reason = "a cast from floating point saturates")]
        let most = if folds { ((highest + hertz) / self.of.rate).ceil() as i32 } else { 0 };
        let at = |k: i32| (k, hertz + f64::from(k) * self.of.rate);
        let all = (-most..=most).map(at).filter(|(_, of)| acts(of.abs()));
        all.map(|(k, of)| (k, TAU * of)).collect()
    }
}
