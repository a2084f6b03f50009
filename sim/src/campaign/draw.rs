//! [`draw`]: the samples of a Monte Carlo campaign.
//!
//! Uniform numbers are of `ChaCha` with eight rounds, whose key is the SHA-256 of seed, sample and key: a draw depends on
//! nothing else, so more samples keep the earlier ones; where keys are [correlated](super::correlation), on the numbers of all of
//! them. A Latin hypercube divides the distribution of each key into as many equally probable parts as there are samples, and
//! draws once from each, in an order drawn for each key (`McKay`, Beckman, Conover, Technometrics 21(2), 1979): it depends on the
//! number of samples, too. The order of a correlated key is that of its normal scores (Stein, Technometrics 29(2), 1987).

use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng as _, SeedableRng as _};
use sha2::{Digest as _, Sha256};

use super::axis::set;
use super::correlation::Copula;
use super::{CampaignError, Plan, SAMPLES_MAX, Sample};
use crate::spectra::float;
use crate::variation::Variation;

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
/// No samples or too many, two distributions of one key, or correlations that are not positive definite.
pub fn draw(
    variations: &[Variation],
    samples: usize,
    seed: u64,
    latin: bool,
) -> Result<Plan, CampaignError> {
    check(variations, samples)?;
    let copula = Copula::from_variations(variations)?;
    let rows = if latin {
        let mut rows = hypercube(variations, samples, seed);
        reorder(&mut rows, variations, &copula, seed);
        rows.iter().map(|row| sample(variations, &quantiles(variations, row))).collect()
    } else {
        let row = |index: usize| {
            let numbers = variations.iter().map(|of| uniform(seed, index, &of.key));
            correlated(variations, &copula, &numbers.collect::<Vec<f64>>())
        };
        (0..samples).map(row).collect()
    };
    let count = if latin { format!(" of {samples}") } else { String::new() };
    Ok(Plan {
        labels: variations.iter().map(Variation::label).collect(),
        samples: rows,
        identity: format!("montecarlo {seed}{count} {variations:?}"),
    })
}

/// Probabilities of a Latin hypercube: a row for each sample.
fn hypercube(variations: &[Variation], samples: usize, seed: u64) -> Vec<Vec<f64>> {
    let orders: Vec<Vec<usize>> =
        variations.iter().map(|of| parts(seed, samples, &of.key)).collect();
    let row = |index: usize| {
        let within = |(of, order): (&Variation, &Vec<usize>)| {
            let part = order.get(index).copied().unwrap_or_default();
            (float(part) + uniform(seed, index, &of.key)) / float(samples)
        };
        variations.iter().zip(&orders).map(within).collect()
    };
    (0..samples).map(row).collect()
}

/// Gives the parts of each correlated key the order of its normal scores. Where in its part a value is, is drawn anew: the scores
/// contain the number that was drawn before.
fn reorder(rows: &mut [Vec<f64>], variations: &[Variation], copula: &Copula, seed: u64) {
    if copula.places().is_empty() {
        return;
    }
    let scores: Vec<Vec<f64>> = rows.iter().map(|row| copula.scores_at(row)).collect();
    let count = float(rows.len());
    for (column, place) in copula.places().iter().enumerate() {
        let Some(of) = variations.get(*place) else { continue };
        let score = |index: usize| scores.get(index).and_then(|row| row.get(column)).copied();
        let mut order: Vec<usize> = (0..rows.len()).collect();
        order.sort_by(|a, b| {
            let [a, b] = [*a, *b].map(|index| score(index).unwrap_or_default());
            a.total_cmp(&b)
        });
        for (part, index) in order.into_iter().enumerate() {
            let number = uniform(seed, index, &format!("{}\nin its part", of.key));
            if let Some(value) = rows.get_mut(index).and_then(|row| row.get_mut(*place)) {
                *value = (float(part) + number) / count;
            }
        }
    }
}

fn quantiles(variations: &[Variation], probabilities: &[f64]) -> Vec<f64> {
    let pairs = variations.iter().zip(probabilities);
    pairs.map(|(of, share)| of.distribution.quantile(*share)).collect()
}

/// The sample at independent probabilities, whose normal scores are correlated.
fn correlated(variations: &[Variation], copula: &Copula, probabilities: &[f64]) -> Sample {
    let mut values = quantiles(variations, probabilities);
    for (place, score) in copula.places().iter().zip(copula.scores_at(probabilities)) {
        if let (Some(value), Some(of)) = (values.get_mut(*place), variations.get(*place)) {
            *value = of.distribution.at_score(score);
        }
    }
    sample(variations, &values)
}

fn sample(variations: &[Variation], values: &[f64]) -> Sample {
    let pairs = variations.iter().zip(values);
    let overrides = pairs.map(|(of, value)| set(&of.key, *value, &of.unit)).collect();
    Sample { values: values.to_vec(), overrides }
}

impl Plan {
    /// Samples at given probabilities, one for each distribution: of a low-discrepancy sequence, for example. Of variations
    /// that are correlated these are the probabilities of independent normal scores.
    ///
    /// # Errors
    /// No samples or too many, two distributions of one key, correlations that are not positive definite, or a probability that is
    /// not between zero and one.
    pub fn of_probabilities(
        variations: &[Variation],
        probabilities: &[Vec<f64>],
    ) -> Result<Self, CampaignError> {
        check(variations, probabilities.len())?;
        let copula = Copula::from_variations(variations)?;
        let keys = variations.len();
        let within = |row: &Vec<f64>| {
            row.len() == keys && row.iter().all(|share| *share > 0.0 && *share < 1.0)
        };
        if let Some(sample) = probabilities.iter().position(|row| !within(row)) {
            return Err(CampaignError::Probabilities { sample, keys });
        }
        Ok(Self {
            labels: variations.iter().map(Variation::label).collect(),
            samples: probabilities.iter().map(|row| correlated(variations, &copula, row)).collect(),
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::campaign::spearman;
    use crate::variation::{Correlation, Distribution};

    const COUNT: usize = 20_000;
    /// Standard errors that a moment of a fixed seed may be off by: exceeded once in 16000 seeds.
    const ERRORS: f64 = 4.0;

    fn plan(distribution: Distribution, samples: usize, latin: bool) -> Vec<f64> {
        let of = Variation {
            key: "hub.mass".into(),
            unit: "kg".into(),
            distribution,
            correlations: Vec::new(),
        };
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
        let of = [Variation {
            key: "hub.mass".into(),
            unit: "kg".into(),
            distribution,
            correlations: Vec::new(),
        }];
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

    /// Two correlated values, and one that is not, of distributions.
    fn pair(
        distributions: [Distribution; 2],
        coefficient: f64,
        samples: usize,
        latin: bool,
    ) -> Plan {
        let with = |key: &str, distribution: Distribution, correlations| Variation {
            key: key.to_owned(),
            unit: String::new(),
            distribution,
            correlations,
        };
        let [a, b] = distributions;
        let correlations = vec![Correlation { key: "a".to_owned(), coefficient }];
        let correlations = if coefficient == 0.0 { Vec::new() } else { correlations };
        let other = Distribution::Normal { mean: 0.0, deviation: 1.0 };
        let of = [
            with("a", a, Vec::new()),
            with("other", other, Vec::new()),
            with("b", b, correlations),
        ];
        draw(&of, samples, 11, latin).expect("a plan")
    }

    fn values(plan: &Plan, key: usize) -> Vec<f64> {
        plan.samples.iter().map(|sample| sample.values[key]).collect()
    }

    /// Of Gaussian values the coefficient is their correlation, whose error is `(1 - r²) / sqrt(n)`; of any the rank correlation is
    /// `6 / pi asin(r / 2)`, with an error below `1 / sqrt(n)`. Each is distributed as by itself.
    #[test]
    #[ignore = "long: `cargo xtask test --all`"]
    fn a_sample_has_its_correlation_and_its_distributions() {
        const COEFFICIENT: f64 = -0.6;
        let rank = 6.0 / std::f64::consts::PI * (0.5 * COEFFICIENT).asin();
        let error = ERRORS / float(COUNT).sqrt();
        let normal = Distribution::Normal { mean: 3.0, deviation: 0.5 };
        let lognormal = Distribution::Lognormal { median: 2.0, sigma: 0.4 };
        let uniform = Distribution::Uniform([2.0, 5.0]);
        for latin in [false, true] {
            let plan = pair([normal.clone(), normal.clone()], COEFFICIENT, COUNT, latin);
            let (a, b) = (values(&plan, 0), values(&plan, 2));
            let ([m, s], [n, t]) = (moments(&a), moments(&b));
            let product = a.iter().zip(&b).map(|(a, b)| (a - m) * (b - n)).sum::<f64>();
            let found = product / float(COUNT) / (s * t);
            let bound = error * (1.0 - COEFFICIENT * COEFFICIENT);
            assert!((found - COEFFICIENT).abs() < bound, "{latin}: {found}");
            assert!((n - 3.0).abs() < error * 0.5 && (t / 0.5 - 1.0).abs() < error, "{n} {t}");

            let plan = pair([lognormal.clone(), uniform.clone()], COEFFICIENT, COUNT, latin);
            let b = values(&plan, 2);
            let found = spearman(&values(&plan, 0), &b).expect("it varies");
            assert!((found - rank).abs() < error, "{latin}: {found} for {rank}");
            let [mean, deviation] = moments(&b);
            let scale = 3.0 / 12.0_f64.sqrt();
            assert!((mean - 3.5).abs() < error * scale && (deviation / scale - 1.0).abs() < error);
            let found = spearman(&values(&plan, 1), &b).expect("it varies");
            assert!(found.abs() < error, "{latin}: {found} with one that is not correlated");
        }
    }

    #[test]
    fn keys_that_are_not_correlated_and_earlier_samples_stay() {
        let normal = Distribution::Normal { mean: 3.0, deviation: 0.5 };
        let both = [normal.clone(), normal];
        for latin in [false, true] {
            let (free, tied) =
                (pair(both.clone(), 0.0, 50, latin), pair(both.clone(), 0.6, 50, latin));
            assert_eq!(values(&free, 1), values(&tied, 1));
            assert_ne!(values(&free, 2), values(&tied, 2));
            assert_ne!(free.identity, tied.identity);
        }
        let (few, many) = (pair(both.clone(), 0.6, 10, false), pair(both, 0.6, 50, false));
        assert_eq!(few.samples[..], many.samples[..10]);
    }

    #[test]
    fn a_correlated_key_of_a_latin_hypercube_has_one_sample_in_each_part() {
        let uniform = Distribution::Uniform([0.0, 1.0]);
        let plan = pair([uniform.clone(), uniform], 0.8, 500, true);
        for key in [0, 2] {
            let mut values = values(&plan, key);
            values.sort_by(f64::total_cmp);
            for (part, value) in values.iter().enumerate() {
                assert!((float(part)..=float(part + 1)).contains(&(value * 500.0)), "{key} {part}");
            }
        }
    }

    /// What names a campaign without correlations has not changed: its journal is taken up again.
    #[test]
    fn the_text_of_a_variation_that_is_not_correlated_is_as_before() {
        let distribution = Distribution::Normal { mean: 1.0, deviation: 0.1 };
        let of = Variation {
            key: "hub.mass".into(),
            unit: "kg".into(),
            distribution,
            correlations: Vec::new(),
        };
        let plan = draw(&[of], 1, 11, false).expect("a plan");
        let text = "montecarlo 11 [Variation { key: \"hub.mass\", unit: \"kg\", \
                    distribution: Normal { mean: 1.0, deviation: 0.1 } }]";
        assert_eq!(plan.identity, text);
    }
}
