//! [`Variation`]: a key of the scenario and the distribution of its values.

use std::fmt;

use statrs::distribution::{ContinuousCDF as _, Normal};

use crate::spectra::float;

/// A key and how its values are distributed.
#[derive(Clone, PartialEq)]
pub struct Variation {
    /// The key, as in `--set`.
    pub key: String,
    /// The unit of the values; empty of a pure number.
    pub unit: String,
    /// The distribution.
    pub distribution: Distribution,
    /// Correlations with other variations; each pair is stated at one of the two.
    pub correlations: Vec<Correlation>,
}

/// The text names campaigns: one without correlations has that of earlier versions.
impl fmt::Debug for Variation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut text = f.debug_struct("Variation");
        text.field("key", &self.key).field("unit", &self.unit);
        text.field("distribution", &self.distribution);
        if !self.correlations.is_empty() {
            text.field("correlations", &self.correlations);
        }
        text.finish()
    }
}

/// A correlation with another variation.
#[derive(Clone, Debug, PartialEq)]
pub struct Correlation {
    /// The key of the other one.
    pub key: String,
    /// Of the normal scores: above -1, below 1.
    pub coefficient: f64,
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
        self.at(probability, || normal_score(probability))
    }

    /// The value at a normal score: Gaussian ones do not lose digits by its probability.
    pub(crate) fn at_score(&self, score: f64) -> f64 {
        let probability = 0.5 * libm::erfc(-score * std::f64::consts::FRAC_1_SQRT_2);
        self.at(probability, || score)
    }

    /// The value at a probability whose normal score is `normal`.
    fn at(&self, probability: f64, normal: impl Fn() -> f64) -> f64 {
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

/// `Phi^-1`: the standard Gaussian number that is not exceeded with a probability.
pub(crate) fn normal_score(probability: f64) -> f64 {
    Normal::standard().inverse_cdf(probability)
}

/// A key and its unit, for tables and pictures: `device.rw.wheel.rate [rpm]`; the key where it has none.
pub(crate) fn label(key: &str, unit: &str) -> String {
    if unit.is_empty() { key.to_owned() } else { format!("{key} [{unit}]") }
}

impl Variation {
    /// Key and unit: `device.rw.imbalance.static [g cm]`.
    #[must_use]
    pub fn label(&self) -> String {
        label(&self.key, &self.unit)
    }
}
