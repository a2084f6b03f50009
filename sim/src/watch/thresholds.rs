//! [`Thresholds`]: from a rate of false alarms to the bounds of the tests.
//!
//! Estimates of blocks are independent and normally distributed, with a variance that is the stated one times a scatter, which is estimated
//! from the n blocks of the reference: by chi-square with f = n - 1 degrees of freedom, so that standardised estimates have Student's
//! distribution. That is the tail model. With R false alarms an hour, blocks of T and N tests, each has `alpha = R T / N` a block, half of it
//! for the likelihood ratio and half for the sums. At a known variance the mean number of blocks between false alarms of the generalised
//! likelihood ratio over the last L onsets is, to first order (Siegmund and Venkatraman, Ann. Statist. 23(1), 1995, theorem 1),
//!
//! ```text
//! sqrt(2 pi) exp(b²/2) / (2 b D),   D = integral of x nu(x)² from b / sqrt(L) to b,   nu(x) = exp(-0.583 x)
//! ```
//!
//! of each of two cumulative sums `(exp(2 k c) - 2 k c - 1) / 2 k²`, `c = h + 1.166` (Siegmund, *Sequential Analysis*, Springer
//! 1985, eq. 10.16), with k less the deviation of the reference, which is not known exactly. Of one block it is the normal tail.
//! The rate of false alarms is the mean over the estimated scatter: with u of chi-square by f, a bound b is one of b sqrt(u).

use std::f64::consts::TAU;

use statrs::distribution::{ContinuousCDF as _, Normal};
use statrs::function::gamma::ln_gamma;

use super::error::WatchError;

/// What a cumulative sum takes off at each block, deviations: changes of twice that are found fastest.
pub(super) const DRIFT: f64 = 0.75;

/// What a cumulative sum exceeds its bound by, deviations, twice: of both ends.
const OVER: f64 = 1.166;

/// Below this bound the approximation of the likelihood ratio's length does not hold; a length is at least that.
const LEAST: f64 = 1.5;

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
        let slope = DRIFT - 1.0 / reference.sqrt();
        if slope <= 0.0 {
            return Err(WatchError::Reference { blocks: reference, least: DRIFT.powi(-2) });
        }
        let scales = scales(reference - 1.0);
        let mean = |length: &dyn Fn(f64) -> f64| -> f64 {
            let rates = scales.iter().map(|[root, weight]| weight / length(*root).max(1.0));
            rates.sum::<f64>().recip()
        };
        let single = |b: f64| 0.5 / Normal::standard().cdf(-b);
        let ratio = rising_to(1.0 / (share * alpha), |b| {
            mean(&|root| {
                if onsets > 1 {
                    ratio_length((b * root).max(LEAST), count)
                } else {
                    single(b * root)
                }
            })
        });
        // One of two sums: twice as long, each.
        let blocks = 2.0 / (share * alpha);
        let sum = (onsets > 1).then(|| {
            let of = |c: f64| mean(&|root| sum_length(slope * root, (c - OVER) * root + OVER));
            (rising_to(blocks, of) - OVER).max(0.0)
        });
        Ok(Self { ratio, sum })
    }
}

/// Roots of chi-square with so many degrees of freedom, by these, with weights whose sum is one.
fn scales(freedom: f64) -> Vec<[f64; 2]> {
    const POINTS: u32 = 400;
    let half = 0.5 * freedom;
    // Below the first the distribution has less than 1e-16, or so; above the last, too.
    let from = -libm::log(half) - 37.0 / half;
    let to = libm::log(1.0 + 12.0 / freedom.sqrt() + 80.0 / freedom);
    let point = |index: u32| {
        let log = from + (to - from) * f64::from(index) / f64::from(POINTS);
        let u = libm::exp(log);
        let density = half * (libm::log(half) + log) - half * u - ln_gamma(half);
        [u.sqrt(), libm::exp(density)]
    };
    let mut points: Vec<_> = (0..=POINTS).map(point).collect();
    let sum: f64 = points.iter().map(|[_, weight]| weight).sum();
    for [_, weight] in &mut points {
        *weight /= sum;
    }
    points
}

/// Blocks between false alarms of the likelihood ratio at a bound b, two-sided, over so many onsets.
fn ratio_length(b: f64, onsets: f64) -> f64 {
    let primitive = |x: f64| -(x / OVER + 1.0 / (OVER * OVER)) * libm::exp(-OVER * x);
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
