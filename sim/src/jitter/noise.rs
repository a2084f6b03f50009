//! [`NoiseSweep`]: densities of lines of sight by broadband noise, at some speeds, and their integrals over frequency
//! (`intervals`). Between speeds the mean square is a straight line of logarithms.

use std::f64::consts::TAU;

use nalgebra::Complex;

use super::campbell::{Oscillation, oscillations};
use super::intervals::{Density, NODES, intervals, nodes};
use super::model::Model;
use super::sources::MountNoise;
use super::transfer::Transfer;
use super::weight::Weight;
use crate::structure::accelerance::ComplexMatrix;
use crate::structure::{COORDINATES, Fault};

/// Densities at one speed.
#[derive(Clone, Debug, PartialEq)]
pub struct Densities {
    /// Speed, rad/s.
    pub speed: f64,
    /// Intervals of frequency, Hz, rising, within the bands of the noises.
    pub intervals: Vec<[f64; 2]>,
    /// Frequencies, Hz, rising: five in each interval.
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

/// Mean squares by noise over the speed.
#[derive(Clone, Debug, PartialEq)]
pub struct NoiseSquares {
    /// Speed, rad/s, and mean square, by rising speed; empty without noise.
    points: Vec<[f64; 2]>,
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
        let by_mounts = Transfer::new(self, speed).at(frequency)?;
        Ok(Noises::new(self, speed).density(frequency / TAU, &by_mounts))
    }
}

/// The noises of a model at one speed.
pub(crate) struct Noises<'a> {
    model: &'a Model,
    /// Of each noise by how much its amplitudes differ from those stated.
    factors: Vec<f64>,
    /// Of each noise the first one with the same densities: those of the devices of a layout.
    first_alike: Vec<usize>,
}

impl<'a> Noises<'a> {
    pub(crate) fn new(model: &'a Model, speed: f64) -> Self {
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
            factors: model.noises.iter().map(factor).collect(),
            first_alike: model.noises.iter().map(alike).collect(),
        }
    }

    /// Densities of outputs at a frequency, Hz, from what forces and moments on the mounts do to them, six columns for each mount.
    pub(crate) fn density(&self, hertz: f64, by_mounts: &ComplexMatrix) -> Vec<f64> {
        let mut sums = vec![0.0; by_mounts.nrows()];
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
        sums
    }
}

impl NoiseSweep {
    /// The densities at the speed nearest to one; none without noise.
    #[must_use]
    pub fn nearest(&self, speed: f64) -> Option<&Densities> {
        let apart = |of: &Densities| (of.speed - speed).abs();
        self.speeds.iter().min_by(|a, b| apart(a).total_cmp(&apart(b)))
    }

    /// Mean square of some outputs at a speed, weighted.
    #[must_use]
    pub fn mean_square(&self, speed: f64, outputs: &[usize], weight: &Weight) -> f64 {
        let after = self.speeds.partition_point(|densities| densities.speed < speed);
        let beside = self.speeds.iter().skip(after.saturating_sub(1)).take(2);
        squares(beside, outputs, weight).at(speed)
    }

    /// Mean squares of some outputs over the speed, weighted.
    #[must_use]
    pub fn squares(&self, outputs: &[usize], weight: &Weight) -> NoiseSquares {
        squares(self.speeds.iter(), outputs, weight)
    }

    /// Whether a weight has a share in an interval of frequency at any speed.
    pub(super) fn has_share(&self, weight: &Weight) -> bool {
        let mut intervals = self.speeds.iter().flat_map(|densities| &densities.intervals);
        intervals.any(|interval| weight.has_share(*interval))
    }
}

fn squares<'a>(
    speeds: impl Iterator<Item = &'a Densities>,
    outputs: &[usize],
    weight: &Weight,
) -> NoiseSquares {
    let point = |of: &Densities| [of.speed, of.mean_square(outputs, weight)];
    NoiseSquares { points: speeds.map(point).collect() }
}

impl NoiseSquares {
    /// The mean square at a speed, rad/s: between two speeds a straight line of logarithms, or of numbers where one is zero.
    #[must_use]
    pub fn at(&self, speed: f64) -> f64 {
        let after = self.points.partition_point(|[known, _]| *known < speed);
        let [before, next] = [after.checked_sub(1), Some(after)]
            .map(|index| index.and_then(|index| self.points.get(index)));
        match (before, next) {
            (_, Some([known, only])) if *known == speed => *only,
            (Some([v0, s0]), Some([v1, s1])) if *v0 > 0.0 && *s0 > 0.0 && *s1 > 0.0 => {
                let share = libm::log(speed / v0) / libm::log(v1 / v0);
                s0 * libm::exp(share * libm::log(s1 / s0))
            }
            (Some([v0, s0]), Some([v1, s1])) => s0 + (s1 - s0) * (speed - v0) / (v1 - v0),
            (Some([_, only]), None) | (None, Some([_, only])) => *only,
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
        // The frequencies of tables are corners of the density.
        let corners = model.noises.iter().flat_map(|noise| noise.density.frequencies.clone());
        let (noises, transfer) = (Noises::new(model, speed), Transfer::new(model, speed));
        let density = |hertz: f64| -> Result<Vec<f64>, Fault> {
            Ok(noises.density(hertz, &transfer.at(TAU * hertz)?))
        };
        Self::over(speed, (&bands, corners), &natural, density)
    }

    /// Of a density by the frequency, Hz, within some bands, Hz, with corners, and short intervals at natural frequencies.
    ///
    /// # Errors
    /// Those of the density.
    pub(crate) fn over(
        speed: f64,
        (bands, corners): (&[[f64; 2]], impl Iterator<Item = f64>),
        natural: &[Oscillation],
        density: impl Fn(f64) -> Result<Vec<f64>, Fault>,
    ) -> Result<Self, Fault> {
        let intervals = intervals(bands, corners, natural);
        let frequencies: Vec<f64> = intervals.iter().copied().flat_map(nodes).collect();
        let values: Result<Vec<_>, _> = frequencies.iter().map(|hertz| density(*hertz)).collect();
        Ok(Self { speed, intervals, frequencies, values: values? })
    }

    /// The density of some outputs together in each interval.
    fn of_outputs(&self, outputs: &[usize]) -> impl Iterator<Item = Density> {
        let sum = |values: &Vec<f64>| -> f64 {
            outputs.iter().filter_map(|output| values.get(*output)).sum()
        };
        let of = self.intervals.iter().zip(self.values.chunks(NODES));
        let density = move |(ends, values): (&[f64; 2], &[Vec<f64>])| {
            let values = std::array::from_fn(|node| values.get(node).map_or(0.0, sum));
            Density { ends: *ends, values }
        };
        of.map(density).collect::<Vec<_>>().into_iter()
    }

    /// Mean square of some outputs, weighted.
    #[must_use]
    pub fn mean_square(&self, outputs: &[usize], weight: &Weight) -> f64 {
        self.of_outputs(outputs).map(|density| density.integral(density.ends, weight)).sum()
    }

    /// Middle frequency, Hz, and mean square of some outputs, weighted, of each interval.
    #[must_use]
    pub fn squares(&self, outputs: &[usize], weight: &Weight) -> Vec<(f64, f64)> {
        let of = |density: Density| {
            let [from, to] = density.ends;
            (0.5 * (from + to), density.integral(density.ends, weight))
        };
        self.of_outputs(outputs).map(of).collect()
    }

    /// Mean square of some outputs, weighted, of all frequencies up to each of [`Self::frequencies`].
    #[must_use]
    pub fn cumulative(&self, outputs: &[usize], weight: &Weight) -> Vec<f64> {
        let (mut sum, mut all) = (0.0, Vec::with_capacity(self.frequencies.len()));
        for density in self.of_outputs(outputs) {
            let [mut from, to] = density.ends;
            for node in nodes(density.ends) {
                sum += density.integral([from, node], weight);
                all.push(sum);
                from = node;
            }
            sum += density.integral([from, to], weight);
        }
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_power_of_the_speed_is_exact_between_speeds() {
        let squares =
            NoiseSquares { points: vec![[60.0, 60.0_f64.powi(4)], [90.0, 90.0_f64.powi(4)]] };
        for speed in [60.0, 70.0, 90.0] {
            assert!((squares.at(speed) / speed.powi(4) - 1.0).abs() < 1e-13, "{speed}");
        }
    }
}
