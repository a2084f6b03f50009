//! [`NoiseSweep`]: densities of lines of sight by broadband noise, at some speeds.
//!
//! Frequencies are close where a natural frequency is: the density of a mode of damping ratio zeta is as wide as
//! `2 zeta` of its frequency. Between frequencies the density is a straight line, and between speeds the mean square.

use std::f64::consts::TAU;

use nalgebra::Complex;

use super::campbell::{Oscillation, oscillations};
use super::model::Model;
use super::sources::MountNoise;
use super::transfer::Transfer;
use crate::structure::{COORDINATES, Fault};

/// Frequencies of a decade.
const PER_DECADE: f64 = 80.0;
/// Frequencies on each side of a natural frequency: the first distance in half-widths, the ratio of neighbours, their
/// number.
const BESIDE: (f64, f64, i32) = (0.2, 1.2, 32);

/// Densities at one speed.
#[derive(Clone, Debug, PartialEq)]
pub struct Densities {
    /// Speed, rad/s.
    pub speed: f64,
    /// Frequencies, Hz, rising.
    pub frequencies: Vec<f64>,
    /// One-sided density of each output at each frequency.
    pub values: Vec<Vec<f64>>,
}

/// Densities at some speeds.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NoiseSweep {
    /// By rising speed; empty without noise.
    pub speeds: Vec<Densities>,
}

impl Model {
    /// Densities of the outputs by all noises at a speed and angular frequency, rad/s: m²/Hz, rad²/Hz of what the
    /// sensitivities are of.
    ///
    /// # Errors
    /// As [`Self::lines`].
    pub fn density(&self, speed: f64, frequency: f64) -> Result<Vec<f64>, Fault> {
        if self.noises.is_empty() {
            return Ok(vec![0.0; self.outputs.len()]);
        }
        Noises::new(self, speed).density(frequency)
    }
}

/// The noises of a model at one speed.
struct Noises<'a> {
    model: &'a Model,
    transfer: Transfer<'a>,
    /// Of each noise by how much its amplitudes differ from those stated.
    factors: Vec<f64>,
    /// Of each noise the first one with the same densities: those of the devices of a layout.
    first_alike: Vec<usize>,
}

impl<'a> Noises<'a> {
    fn new(model: &'a Model, speed: f64) -> Self {
        let factor = |noise: &MountNoise| {
            let rate = noise.rotor.and_then(|[device, rotor]| {
                let (_, device) = model.devices.get(device)?;
                device.rotors.get(rotor).map(|rotor| rotor.rate(speed).abs())
            });
            match (noise.density.reference_rate, rate) {
                (Some(reference), Some(rate)) => (rate / reference).powi(2),
                (Some(_), None) => 0.0,
                (None, _) => 1.0,
            }
        };
        let alike = |noise: &MountNoise| {
            model.noises.iter().position(|other| other.density == noise.density).unwrap_or(0)
        };
        Self {
            model,
            transfer: Transfer::new(model, speed),
            factors: model.noises.iter().map(factor).collect(),
            first_alike: model.noises.iter().map(alike).collect(),
        }
    }

    fn density(&self, frequency: f64) -> Result<Vec<f64>, Fault> {
        let mut sums = vec![0.0; self.model.outputs.len()];
        let hertz = frequency / TAU;
        let by_mounts = self.transfer.at(frequency)?;
        let mut independent = Vec::with_capacity(self.model.noises.len());
        for (number, noise) in self.model.noises.iter().enumerate() {
            let known = self.first_alike.get(number).and_then(|first| independent.get(*first));
            let parts = known.copied().unwrap_or_else(|| noise.density.independent(hertz));
            independent.push(parts);
            let factor = self.factors.get(number).copied().unwrap_or(0.0);
            let own = by_mounts.columns(COORDINATES * noise.mount, COORDINATES);
            for (sum, row) in sums.iter_mut().zip(own.row_iter()) {
                // The output by each component, and then by each independent noise.
                let by = |wrench: &[f64; COORDINATES]| -> Complex<f64> {
                    row.iter().zip(wrench).map(|(by, of)| by * *of).sum()
                };
                let by = noise.wrench.each_ref().map(by);
                for part in parts {
                    let value: Complex<f64> = by.iter().zip(part).map(|(by, of)| by * of).sum();
                    *sum += value.norm_sqr() * factor * factor;
                }
            }
        }
        Ok(sums)
    }
}

impl NoiseSweep {
    /// The densities at the speed nearest to one; none without noise.
    #[must_use]
    pub fn nearest(&self, speed: f64) -> Option<&Densities> {
        let apart = |of: &Densities| (of.speed - speed).abs();
        self.speeds.iter().min_by(|a, b| apart(a).total_cmp(&apart(b)))
    }

    /// Mean square of some outputs at a speed, each frequency weighted (angular frequency, rad/s).
    #[must_use]
    pub fn mean_square(&self, speed: f64, outputs: &[usize], weight: &dyn Fn(f64) -> f64) -> f64 {
        let of = |densities: &Densities| -> f64 {
            outputs.iter().map(|output| densities.mean_square(*output, weight)).sum()
        };
        let after = self.speeds.partition_point(|densities| densities.speed < speed);
        let [before, next] = [after.checked_sub(1), Some(after)]
            .map(|index| index.and_then(|index| self.speeds.get(index)));
        match (before, next) {
            (Some(a), Some(b)) => {
                let share = (speed - a.speed) / (b.speed - a.speed);
                of(a) + share * (of(b) - of(a))
            }
            (Some(only), None) | (None, Some(only)) => of(only),
            (None, None) => 0.0,
        }
    }
}

impl Densities {
    /// Of a model at a speed, rad/s.
    ///
    /// # Errors
    /// As [`Model::density`] and [`oscillations`].
    pub fn new(model: &Model, speed: f64) -> Result<Self, Fault> {
        let natural = oscillations(model, speed)?;
        let bands: Vec<[f64; 2]> = model.noises.iter().map(|noise| noise.density.band).collect();
        let mut frequencies = grid(&bands, &natural);
        // The ends of tables are corners of the density.
        frequencies.extend(model.noises.iter().flat_map(|noise| noise.density.frequencies.clone()));
        frequencies.sort_by(f64::total_cmp);
        frequencies.dedup();
        frequencies.retain(|frequency| *frequency > 0.0);
        let noises = Noises::new(model, speed);
        let values: Result<Vec<_>, _> =
            frequencies.iter().map(|frequency| noises.density(TAU * frequency)).collect();
        Ok(Self { speed, frequencies, values: values? })
    }

    /// Frequency, Hz, and mean square of some outputs of each interval between frequencies.
    #[must_use]
    pub fn squares(&self, outputs: &[usize]) -> Vec<(f64, f64)> {
        let sum = |values: &Vec<f64>| -> f64 {
            outputs.iter().filter_map(|output| values.get(*output)).sum()
        };
        let points: Vec<[f64; 2]> = self
            .frequencies
            .iter()
            .zip(&self.values)
            .map(|(f, values)| [*f, sum(values)])
            .collect();
        points
            .windows(2)
            .map(|pair| {
                let [[f0, s0], [f1, s1]] = [pair[0], pair[1]];
                (0.5 * (f0 + f1), 0.5 * (f1 - f0) * (s0 + s1))
            })
            .collect()
    }

    /// Mean square of an output, each frequency weighted.
    #[must_use]
    pub fn mean_square(&self, output: usize, weight: &dyn Fn(f64) -> f64) -> f64 {
        let points = self.frequencies.iter().zip(&self.values);
        let points: Vec<[f64; 2]> = points
            .map(|(f, values)| [*f, values.get(output).copied().unwrap_or(0.0) * weight(TAU * f)])
            .collect();
        points
            .windows(2)
            .map(|pair| 0.5 * (pair[1][0] - pair[0][0]) * (pair[0][1] + pair[1][1]))
            .sum()
    }
}

/// Frequencies, Hz, of some bands, close around natural frequencies.
fn grid(bands: &[[f64; 2]], natural: &[Oscillation]) -> Vec<f64> {
    let from = bands.iter().map(|band| band[0]).fold(f64::INFINITY, f64::min);
    let to = bands.iter().map(|band| band[1]).fold(0.0, f64::max);
    let lowest = from.max(1e-6 * to);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most 80 * 6")]
    let count = (PER_DECADE * (to / lowest).log10()).ceil().clamp(2.0, 1000.0) as u32;
    let at = |k: u32| lowest * (to / lowest).powf(f64::from(k) / f64::from(count));
    let mut grid: Vec<f64> = (0..=count).map(at).collect();
    for of in natural {
        let centre = of.frequency / TAU;
        grid.push(centre);
        let (first, ratio, count) = BESIDE;
        for width in (0..count).map(|k| first * ratio.powi(k)) {
            let beside = [-1.0, 1.0].map(|side| centre * (1.0 + side * width * of.damping));
            grid.extend(beside.iter().filter(|f| !is_nearer_to_another(**f, centre, natural)));
        }
    }
    for band in bands {
        grid.extend(band);
    }
    grid.retain(|frequency| (lowest..=to).contains(frequency));
    grid
}

/// Whether a frequency, Hz, is so near to another natural frequency than the one at `centre` that the frequencies beside that
/// are closer.
fn is_nearer_to_another(frequency: f64, centre: f64, natural: &[Oscillation]) -> bool {
    let apart = (frequency - centre).abs();
    let (first, ratio, count) = BESIDE;
    let widest = first * ratio.powi(count - 1);
    natural.iter().any(|other| {
        let other_centre = other.frequency / TAU;
        let width = other_centre * other.damping;
        let other_apart = (frequency - other_centre).abs();
        other_apart.max(width) < apart && other_apart < widest * width
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_grid_resolves_a_lightly_damped_mode() {
        let mode = Oscillation { frequency: TAU * 40.0, damping: 0.005 };
        let mut grid = grid(&[[1.0, 400.0]], &[mode]);
        grid.sort_by(f64::total_cmp);
        let density = |f: f64| {
            let r = f / 40.0;
            1.0 / ((1.0 - r * r).powi(2) + (2.0 * 0.005 * r).powi(2))
        };
        let found: f64 = grid
            .windows(2)
            .map(|pair| 0.5 * (pair[1] - pair[0]) * (density(pair[0]) + density(pair[1])))
            .sum();
        // The integral over all frequencies: pi f / (4 zeta); what is outside the band is 0.1 %; of the straight lines 0.5 %.
        let expected = std::f64::consts::PI * 40.0 / (4.0 * 0.005);
        assert!((found / expected - 1.0).abs() < 0.01, "{found} for {expected}");
    }

    /// Twenty modes, each a tenth above the one before: every one is resolved, with fewer frequencies than each by itself.
    #[test]
    fn a_grid_resolves_modes_that_are_close() {
        let natural: Vec<Oscillation> = (0..20)
            .map(|k| Oscillation { frequency: TAU * 40.0 * 1.1_f64.powi(k), damping: 0.005 })
            .collect();
        let mut grid = grid(&[[1.0, 400.0]], &natural);
        grid.sort_by(f64::total_cmp);
        assert!(grid.len() < 20 * 50 + 220, "{} frequencies", grid.len());
        for of in &natural {
            let centre = of.frequency / TAU;
            let density = |f: f64| {
                let r = f / centre;
                1.0 / ((1.0 - r * r).powi(2) + (2.0 * of.damping * r).powi(2))
            };
            let found: f64 = grid
                .windows(2)
                .map(|pair| 0.5 * (pair[1] - pair[0]) * (density(pair[0]) + density(pair[1])))
                .sum();
            let expected = std::f64::consts::PI * centre / (4.0 * of.damping);
            assert!((found / expected - 1.0).abs() < 0.01, "{found} for {expected}");
        }
    }
}
