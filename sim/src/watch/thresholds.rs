//! [`Thresholds`]: from a rate of false alarms to the bounds of the tests.
//!
//! Estimates of blocks are independent and normally distributed, which is the tail model. With R false alarms an hour, blocks of T
//! and n quantities, each has `alpha = R T / n` a block, half of it for each test: so many blocks are from one false alarm to the next,
//! in the mean. Of the generalised likelihood ratio over the last L onsets that is, to first order (Siegmund and Venkatraman, Ann.
//! Statist. 23(1), 1995, theorem 1),
//!
//! ```text
//! sqrt(2 pi) exp(b²/2) / (2 b D),   D = integral of x nu(x)² from b / sqrt(L) to b,   nu(x) = exp(-0.583 x)
//! ```
//!
//! of each of two cumulative sums `(exp(2 k c) - 2 k c - 1) / 2 k²`, `c = h + 1.166` (Siegmund, *Sequential Analysis*, Springer
//! 1985, eq. 10.16), with k less the deviation of the reference, which is not known exactly. Of one block it is the normal tail.

use std::f64::consts::TAU;

use statrs::distribution::{ContinuousCDF as _, Normal};

use super::error::WatchError;

/// What a cumulative sum takes off at each block, deviations: changes of twice that are found fastest.
pub(super) const DRIFT: f64 = 0.75;

/// Of a standardised estimate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Thresholds {
    /// Of the generalised likelihood ratio: the root of twice its logarithm.
    pub(super) ratio: f64,
    /// h of the cumulative sums; none where only one block is looked at.
    pub(super) sum: Option<f64>,
}

impl Thresholds {
    /// Of a probability of a false alarm at each block, with so many onsets, against a reference of so many blocks.
    pub(super) fn new(alpha: f64, onsets: usize, reference: usize) -> Result<Self, WatchError> {
        let share = if onsets > 1 { 0.5 } else { 1.0 };
        #[expect(clippy::cast_precision_loss, reason = "hundreds")]
        let (count, reference) = (onsets as f64, reference as f64);
        // Also of a NaN.
        let sound = alpha > 1e-30 && alpha < 0.1;
        if !sound {
            return Err(WatchError::Rate { alpha });
        }
        let ratio = if onsets > 1 {
            rising_to(1.0 / (share * alpha), |b| ratio_length(b, count))
        } else {
            -Normal::standard().inverse_cdf(alpha / 2.0)
        };
        let slope = DRIFT - 1.0 / reference.sqrt();
        if slope <= 0.0 {
            return Err(WatchError::Reference { blocks: reference, least: DRIFT.powi(-2) });
        }
        // One of two sums: twice as long, each.
        let blocks = 2.0 / (share * alpha);
        let sum =
            (onsets > 1).then(|| (rising_to(blocks, |c| sum_length(slope, c)) - 1.166).max(0.0));
        Ok(Self { ratio, sum })
    }
}

/// Blocks between false alarms of the likelihood ratio at a bound b, two-sided, over so many onsets.
fn ratio_length(b: f64, onsets: f64) -> f64 {
    /// Twice the exponent of nu.
    const C: f64 = 1.166;
    let primitive = |x: f64| -(x / C + 1.0 / (C * C)) * libm::exp(-C * x);
    let d = primitive(b) - primitive(b / onsets.sqrt());
    TAU.sqrt() * libm::exp(b * b / 2.0) / (2.0 * b * d)
}

/// Blocks between false alarms of one cumulative sum.
fn sum_length(slope: f64, c: f64) -> f64 {
    let x = 2.0 * slope * c;
    (libm::exp(x) - x - 1.0) / (2.0 * slope * slope)
}

/// Where a length that rises from 1 on is so many blocks, by bisection.
fn rising_to(blocks: f64, length: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (1.0, 2.0);
    while length(high) < blocks {
        high *= 2.0;
    }
    for _ in 0..60 {
        let middle = f64::midpoint(low, high);
        if length(middle) < blocks { low = middle } else { high = middle }
    }
    high
}
