//! How lines of one frequency are added, by what is assumed of their phases, and the share of each line in the mean square.
//!
//! With the amplitudes `v_k` of an output at one frequency, its mean square `s` and the share `s_k` of a line are
//!
//! | phases | `2 s` | `2 s_k` |
//! |---|---|---|
//! | unknown | `sum of \|v_k\|^2` | `\|v_k\|^2` |
//! | given | `\|v\|^2`, `v = sum of v_k` | `Re(v_k v*)`, the projection on the sum |
//! | worst | `v^2`, `v = sum of \|v_k\|` | `\|v_k\| v` |
//!
//! times the weight of the metric. The shares add up to the mean square, and each is half its derivative with respect to the
//! logarithm of the amplitude of the line: `ln sqrt s` changes by `s_k / s` of that of the amplitude. A share of given phases is below
//! zero where the line opposes the sum.

use nalgebra::Complex;

use super::model::Line;
use super::sweep::{Phases, Sweep};
use super::weight::Weight;

impl Phases {
    /// Twice the mean square of amplitudes at one frequency.
    fn square<'a>(self, values: impl Iterator<Item = &'a Complex<f64>>) -> f64 {
        match self {
            Self::Unknown => values.map(Complex::norm_sqr).sum(),
            Self::Given => values.sum::<Complex<f64>>().norm_sqr(),
            Self::Worst => values.map(|value| value.norm()).sum::<f64>().powi(2),
        }
    }

    /// What a share is, to be read after a percentage.
    #[must_use]
    pub const fn share(self) -> &'static str {
        match self {
            Self::Unknown => "of the mean square",
            Self::Given => "of the mean square, by its projection on the sum of the amplitudes",
            Self::Worst => "of the mean square, by its part of the sum of the magnitudes",
        }
    }
}

/// Numbers of the lines of each frequency, by rising frequency.
fn by_frequency(lines: &[Line]) -> Vec<Vec<usize>> {
    let mut sorted: Vec<(f64, usize)> =
        lines.iter().enumerate().map(|(number, line)| (line.frequency, number)).collect();
    sorted.sort_by(|a, b| a.0.total_cmp(&b.0));
    let shared = sorted.chunk_by(|a, b| a.0.to_bits() == b.0.to_bits());
    shared.map(|shared| shared.iter().map(|(_, number)| *number).collect()).collect()
}

impl Sweep {
    /// Frequency, rad/s, and mean square of some outputs, weighted, of all lines of it at a speed, by rising frequency.
    #[must_use]
    pub fn squares(
        &self,
        speed: usize,
        outputs: &[usize],
        phases: Phases,
        weight: &Weight,
    ) -> Vec<(f64, f64)> {
        let lines = self.lines.get(speed).map_or(&[][..], Vec::as_slice);
        let of = |shared: Vec<usize>| {
            let frequency = shared.first().and_then(|number| lines.get(*number));
            let frequency = frequency.map_or(0.0, |line| line.frequency);
            let square = |output: &usize| {
                let lines = shared.iter().filter_map(|number| lines.get(*number));
                phases.square(lines.filter_map(|line| line.values.get(*output)))
            };
            (frequency, 0.5 * outputs.iter().map(square).sum::<f64>() * weight.at(frequency))
        };
        by_frequency(lines).into_iter().map(of).collect()
    }

    /// Share of each contributor in [`Self::line_square`]: they add up to it.
    #[must_use]
    pub fn shares(
        &self,
        speed: usize,
        outputs: &[usize],
        phases: Phases,
        weight: &Weight,
    ) -> Vec<f64> {
        let lines = self.lines.get(speed).map_or(&[][..], Vec::as_slice);
        let mut shares = vec![0.0; lines.len()];
        for shared in by_frequency(lines) {
            for output in outputs {
                let value = |number: &usize| lines.get(*number)?.values.get(*output);
                let values = || shared.iter().filter_map(value);
                let sum: Complex<f64> = values().sum();
                let magnitudes: f64 = values().map(|value| value.norm()).sum();
                for number in &shared {
                    let Some((line, share)) = lines.get(*number).zip(shares.get_mut(*number))
                    else {
                        continue;
                    };
                    let Some(own) = line.values.get(*output) else { continue };
                    let square = match phases {
                        Phases::Unknown => own.norm_sqr(),
                        Phases::Given => own.re * sum.re + own.im * sum.im,
                        Phases::Worst => own.norm() * magnitudes,
                    };
                    *share += 0.5 * square * weight.at(line.frequency);
                }
            }
        }
        shares
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::jitter::noise::NoiseSweep;

    /// Two lines of one frequency and one of another, of two outputs.
    fn sweep() -> Sweep {
        let values =
            [[(3.0, 0.0), (0.0, 1.0)], [(-1.0, 2.0), (0.0, -4.0)], [(0.5, 0.5), (2.0, 0.0)]];
        let frequencies = [10.0, 10.0, 7.0];
        let line = |contributor: usize| Line {
            contributor,
            frequency: frequencies[contributor],
            values: values[contributor].map(|(re, im)| Complex::new(re, im)).to_vec(),
        };
        Sweep {
            speeds: vec![10.0],
            outputs: Vec::new(),
            contributors: Vec::new(),
            lines: vec![(0..values.len()).map(line).collect()],
            noise: NoiseSweep::default(),
        }
    }

    #[test]
    fn shares_add_up_to_the_mean_square_and_are_its_derivatives() {
        for phases in [Phases::Unknown, Phases::Given, Phases::Worst] {
            let weight = Weight::one();
            let square = |sweep: &Sweep| sweep.line_square(0, &[0, 1], phases, &weight);
            let whole = square(&sweep());
            let shares = sweep().shares(0, &[0, 1], phases, &weight);
            assert!((shares.iter().sum::<f64>() / whole - 1.0).abs() < 1e-14, "{phases:?}");
            for (number, share) in shares.iter().enumerate() {
                let scaled = |factor: f64| {
                    let mut changed = sweep();
                    for value in &mut changed.lines[0][number].values {
                        *value *= factor;
                    }
                    square(&changed)
                };
                // Of a square the central difference has no error but rounding.
                let half = 0.5 * (scaled(1.0 + 1e-3) - scaled(1.0 - 1e-3)) / 2e-3;
                assert!((share - half).abs() < 1e-11 * whole, "{phases:?}: {share} for {half}");
            }
        }
    }

    #[test]
    fn squares_are_by_rising_frequency_and_add_up_as_the_phases_say() {
        let found = |phases| sweep().squares(0, &[0, 1], phases, &Weight::one());
        // (2, 2) and (0, -3): half of 8 + 9.
        assert_eq!(found(Phases::Given), [(7.0, 2.25), (10.0, 8.5)]);
        assert_eq!(found(Phases::Unknown), [(7.0, 2.25), (10.0, 15.5)]);
    }
}
