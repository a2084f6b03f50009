//! [`Variation`]: a key of the scenario and the distribution of its values; [`draw`]: the samples of a Monte Carlo campaign.
//!
//! Uniform numbers are of `ChaCha` with eight rounds, whose key is the SHA-256 of seed, sample and key: a draw depends on
//! nothing else, so more samples keep the earlier ones. A Latin hypercube divides the distribution of each key into as many
//! equally probable parts as there are samples, and draws once from each, in an order drawn for each key (`McKay`, Beckman,
//! Conover, Technometrics 21(2), 1979): it depends on the number of samples, too.

use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng as _, SeedableRng as _};
use sha2::{Digest as _, Sha256};
use statrs::distribution::{ContinuousCDF as _, Normal};

use super::axis::set;
use super::{CampaignError, Plan, SAMPLES_MAX, Sample};
use crate::spectra::float;

/// A key and how its values are distributed.
#[derive(Clone, Debug, PartialEq)]
pub struct Variation {
    /// The key, as in `--set`.
    pub key: String,
    /// The unit of the values; empty of a pure number.
    pub unit: String,
    /// The distribution.
    pub distribution: Distribution,
}

/// A distribution; numbers are in the unit of the key.
#[derive(Clone, Debug, PartialEq)]
pub enum Distribution {
    /// Equally probable from one number to another.
    Uniform([f64; 2]),
    /// Gaussian.
    Normal {
        /// Mean.
        mean: f64,
        /// Standard deviation.
        deviation: f64,
    },
    /// The logarithm is Gaussian.
    Lognormal {
        /// Median.
        median: f64,
        /// Standard deviation of the natural logarithm.
        sigma: f64,
    },
    /// One of some values, equally probable.
    List(Vec<f64>),
    /// Every phase is equally probable: from zero to 360 degrees.
    Phase,
}

impl Distribution {
    /// The value that is not exceeded with a probability between zero and one, in twelve digits: the last bits of a quantile
    /// depend on the host.
    #[must_use]
    pub fn quantile(&self, probability: f64) -> f64 {
        let normal = || Normal::standard().inverse_cdf(probability);
        let value = match self {
            Self::Uniform([from, to]) => from + (to - from) * probability,
            Self::Normal { mean, deviation } => mean + deviation * normal(),
            Self::Lognormal { median, sigma } => median * libm::exp(sigma * normal()),
            Self::List(values) => {
                let places = float(values.len()) * probability;
                #[expect(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "below the number of values"
                )]
                let place = (places as usize).min(values.len().saturating_sub(1));
                values.get(place).copied().unwrap_or(f64::NAN)
            }
            Self::Phase => 360.0 * probability,
        };
        format!("{value:.11e}").parse().unwrap_or(value)
    }

    /// A value in the middle, and the standard deviation; of a list and of phases there is no derivative.
    #[must_use]
    pub fn scale(&self) -> Option<[f64; 2]> {
        match self {
            Self::Uniform([from, to]) => Some([0.5 * (from + to), (to - from) / 12.0_f64.sqrt()]),
            Self::Normal { mean, deviation } => Some([*mean, *deviation]),
            Self::Lognormal { median, sigma } => {
                let square = sigma * sigma;
                let spread = libm::sqrt(libm::expm1(square) * libm::exp(square));
                Some([*median, median * spread])
            }
            Self::List(_) | Self::Phase => None,
        }
    }
}

/// A uniform number between zero and one, ends left out.
fn uniform(seed: u64, sample: usize, key: &str) -> f64 {
    generator(seed, &format!("{sample}\n{key}")).next().unwrap_or(0.5)
}

fn generator(seed: u64, what: &str) -> impl Iterator<Item = f64> + use<> {
    let key = Sha256::digest(format!("precess montecarlo 1\n{seed}\n{what}"));
    let mut generator = ChaCha8Rng::from_seed(key.into());
    std::iter::repeat_with(move || {
        #[expect(clippy::cast_precision_loss, reason = "52 bits")]
        let bits = (generator.next_u64() >> 12) as f64;
        (bits + 0.5) / 4_503_599_627_370_496.0
    })
}

/// The parts of a Latin hypercube in the order of the samples, by Fisher and Yates.
fn parts(seed: u64, samples: usize, key: &str) -> Vec<usize> {
    let mut parts: Vec<usize> = (0..samples).collect();
    let numbers = generator(seed, &format!("order of {samples}\n{key}"));
    for (last, number) in (1..samples).rev().zip(numbers) {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "below the number of samples"
        )]
        let other = (number * float(last + 1)) as usize;
        parts.swap(last, other.min(last));
    }
    parts
}

/// Samples drawn from the distributions of some keys.
///
/// # Errors
/// No samples or too many, or two distributions of one key.
pub fn draw(
    variations: &[Variation],
    samples: usize,
    seed: u64,
    latin: bool,
) -> Result<Plan, CampaignError> {
    check(variations, samples)?;
    let orders: Vec<Vec<usize>> = variations
        .iter()
        .map(|of| if latin { parts(seed, samples, &of.key) } else { Vec::new() })
        .collect();
    let sample = |index: usize| {
        let probability = |(of, order): (&Variation, &Vec<usize>)| {
            let number = uniform(seed, index, &of.key);
            match order.get(index) {
                Some(part) => (float(*part) + number) / float(samples),
                None => number,
            }
        };
        let probabilities: Vec<f64> = variations.iter().zip(&orders).map(probability).collect();
        at(variations, &probabilities)
    };
    let count = if latin { format!(" of {samples}") } else { String::new() };
    Ok(Plan {
        labels: variations.iter().map(Variation::label).collect(),
        samples: (0..samples).map(sample).collect(),
        identity: format!("montecarlo {seed}{count} {variations:?}"),
    })
}

/// The sample at a probability of each distribution.
fn at(variations: &[Variation], probabilities: &[f64]) -> Sample {
    let pairs = variations.iter().zip(probabilities);
    let values: Vec<f64> = pairs.map(|(of, share)| of.distribution.quantile(*share)).collect();
    let pairs = variations.iter().zip(&values);
    let overrides = pairs.map(|(of, value)| set(&of.key, *value, &of.unit)).collect();
    Sample { values, overrides }
}

impl Plan {
    /// Samples at given probabilities, one for each distribution: of a low-discrepancy sequence, for example.
    ///
    /// # Errors
    /// No samples or too many, two distributions of one key, or a probability that is not between zero and one.
    pub fn of_probabilities(
        variations: &[Variation],
        probabilities: &[Vec<f64>],
    ) -> Result<Self, CampaignError> {
        check(variations, probabilities.len())?;
        let keys = variations.len();
        let within = |row: &Vec<f64>| {
            row.len() == keys && row.iter().all(|share| *share > 0.0 && *share < 1.0)
        };
        if let Some(sample) = probabilities.iter().position(|row| !within(row)) {
            return Err(CampaignError::Probabilities { sample, keys });
        }
        Ok(Self {
            labels: variations.iter().map(Variation::label).collect(),
            samples: probabilities.iter().map(|row| at(variations, row)).collect(),
            identity: format!("probabilities {probabilities:?} {variations:?}"),
        })
    }
}

/// Rejects no samples or too many, and two distributions of one key.
fn check(variations: &[Variation], samples: usize) -> Result<(), CampaignError> {
    if samples == 0 || samples > SAMPLES_MAX || variations.is_empty() {
        let found = if variations.is_empty() { 0 } else { samples };
        return Err(CampaignError::Samples { found, most: SAMPLES_MAX });
    }
    for (index, of) in variations.iter().enumerate() {
        if variations.iter().take(index).any(|other| other.key == of.key) {
            return Err(CampaignError::Twice(of.key.clone()));
        }
    }
    Ok(())
}

impl Variation {
    /// Key and unit: `device.rw.imbalance.static [g cm]`.
    #[must_use]
    pub fn label(&self) -> String {
        if self.unit.is_empty() {
            self.key.clone()
        } else {
            format!("{} [{}]", self.key, self.unit)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const COUNT: usize = 20_000;
    /// Standard errors that a moment of a fixed seed may be off by: exceeded once in 16000 seeds.
    const ERRORS: f64 = 4.0;

    fn plan(distribution: Distribution, samples: usize, latin: bool) -> Vec<f64> {
        let of = Variation { key: "hub.mass".into(), unit: "kg".into(), distribution };
        let plan = draw(&[of], samples, 11, latin).expect("a plan");
        plan.samples.iter().map(|sample| sample.values[0]).collect()
    }

    fn moments(values: &[f64]) -> [f64; 2] {
        let n = float(values.len());
        let mean = values.iter().sum::<f64>() / n;
        [mean, (values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / n).sqrt()]
    }

    #[test]
    fn moments_are_those_of_the_distribution() {
        let all = [
            Distribution::Uniform([2.0, 5.0]),
            Distribution::Normal { mean: -3.0, deviation: 0.7 },
            Distribution::Lognormal { median: 2.0, sigma: 0.25 },
        ];
        for distribution in all {
            let [_, expected] = distribution.scale().expect("a scale");
            let center = match distribution {
                Distribution::Lognormal { median, sigma } => median * (0.5 * sigma * sigma).exp(),
                _ => distribution.scale().expect("a scale")[0],
            };
            let [mean, deviation] = moments(&plan(distribution.clone(), COUNT, false));
            let error = ERRORS / float(COUNT).sqrt();
            assert!((mean - center).abs() < error * expected, "{distribution:?}: {mean}");
            // The kurtosis of the three is below 4.2: the error of a deviation is below 0.9 of that of a mean.
            assert!((deviation / expected - 1.0).abs() < error, "{distribution:?}: {deviation}");
        }
        let list = plan(Distribution::List(vec![1.0, 2.0, 4.0]), COUNT, false);
        let share = float(list.iter().filter(|v| **v == 4.0).count()) / float(COUNT);
        assert!((share - 1.0 / 3.0).abs() < ERRORS * (2.0 / 9.0 / float(COUNT)).sqrt());
        let phases = plan(Distribution::Phase, COUNT, false);
        assert!(phases.iter().all(|phase| (0.0..360.0).contains(phase)));
    }

    #[test]
    fn samples_at_probabilities_are_quantiles() {
        let distribution = Distribution::Uniform([2.0, 4.0]);
        let of = [Variation { key: "hub.mass".into(), unit: "kg".into(), distribution }];
        let plan = Plan::of_probabilities(&of, &[vec![0.5], vec![0.25]]).expect("a plan");
        assert_eq!(plan.samples[0].overrides, ["hub.mass = \"3 kg\""]);
        assert_eq!(plan.samples[1].values, [2.5]);
        assert!(Plan::of_probabilities(&of, &[vec![1.0]]).is_err());
        assert!(Plan::of_probabilities(&of, &[vec![0.5, 0.5]]).is_err());
    }

    #[test]
    fn more_samples_keep_the_earlier_ones() {
        let uniform = Distribution::Uniform([0.0, 1.0]);
        let (few, many) = (plan(uniform.clone(), 10, false), plan(uniform, 50, false));
        assert_eq!(few[..], many[..10]);
    }

    #[test]
    fn a_latin_hypercube_has_one_sample_in_each_part() {
        let mut values = plan(Distribution::Uniform([0.0, 1.0]), 500, true);
        assert!(values.windows(2).any(|pair| pair[1] < pair[0]));
        values.sort_by(f64::total_cmp);
        for (part, value) in values.iter().enumerate() {
            assert!((float(part)..=float(part + 1)).contains(&(value * 500.0)), "{part}: {value}");
        }
    }
}
