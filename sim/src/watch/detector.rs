//! [`Detector`]: one quantity, block after block, against what it was at first: generalised likelihood ratio of a step, and
//! cumulative sums.

use std::collections::VecDeque;

use statrs::distribution::{ChiSquared, ContinuousCDF as _};

use super::thresholds::{DRIFT, Thresholds};

/// Half the width of an interval of 95 %, deviations.
pub(super) const INTERVAL: f64 = 1.959_963_984_540_054;

/// A scatter that pure noise exceeds once in a thousand references is not noise as stated.
const SCATTER: f64 = 1e-3;

/// Which test raised an alarm.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Test {
    /// Generalised likelihood ratio of a step at one of the last blocks.
    LikelihoodRatio,
    /// Cumulative sum: a change that is slow or small.
    CumulativeSum,
}

/// What has changed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shift {
    /// Which test found it.
    pub test: Test,
    /// From when on, s: the start of a block.
    pub onset: f64,
    /// The reference.
    pub before: f64,
    /// The mean since the onset less the reference.
    pub change: f64,
    /// Half the width of its interval of 95 %, at this onset.
    pub half_width: f64,
}

/// An estimate of a block.
#[derive(Clone, Copy, Debug)]
struct Sample {
    time: f64,
    value: f64,
    weight: f64,
}

/// Weighted sums.
#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    weight: f64,
    value: f64,
    square: f64,
    count: usize,
}

impl Sums {
    fn add(&mut self, sample: &Sample) {
        self.weight += sample.weight;
        self.value += sample.weight * sample.value;
        self.square += sample.weight * sample.value * sample.value;
        self.count += 1;
    }

    fn mean(&self) -> f64 {
        self.value / self.weight
    }
}

/// What a quantity was while the reference was taken.
#[derive(Clone, Copy, Debug)]
struct Reference {
    mean: f64,
    variance: f64,
}

/// The tests of one quantity. Its memory does not grow.
#[derive(Clone, Debug)]
pub(super) struct Detector {
    thresholds: Thresholds,
    /// Blocks of the reference, and onsets that are tried.
    counts: [usize; 2],
    learnt: Sums,
    /// About the first value, so that squares do not cancel.
    origin: f64,
    reference: Option<Reference>,
    /// Variance of estimates by the stated one.
    scatter: f64,
    window: VecDeque<Sample>,
    /// Cumulative sums upwards and downwards.
    cumulative: [f64; 2],
}

impl Detector {
    pub(super) fn new(thresholds: Thresholds, counts: [usize; 2]) -> Self {
        Self {
            thresholds,
            counts,
            learnt: Sums::default(),
            origin: 0.0,
            reference: None,
            scatter: 1.0,
            window: VecDeque::with_capacity(counts[1] + 1),
            cumulative: [0.0; 2],
        }
    }

    /// The reference and the scatter about it by the stated variance; none while it is taken.
    pub(super) fn reference(&self) -> Option<[f64; 2]> {
        self.reference.map(|of| [of.mean, self.scatter])
    }

    /// Takes the estimate of the block that starts at a time. After an alarm a new reference is taken.
    pub(super) fn take(&mut self, time: f64, value: f64, variance: f64) -> Option<Shift> {
        let sound = value.is_finite() && variance.is_finite() && variance > 0.0;
        if !sound {
            return None;
        }
        let Some(reference) = self.reference else {
            self.learn(time, value, variance);
            return None;
        };
        let sample = Sample { time, value, weight: 1.0 / (self.scatter * variance) };
        let (ratio, likeliest) = self.likeliest(&reference, sample)?;
        let test = if ratio > self.thresholds.ratio {
            Some(Test::LikelihoodRatio)
        } else if self.is_above(&reference, &sample) {
            Some(Test::CumulativeSum)
        } else {
            None
        };
        let found = test.map(|test| Shift { test, ..likeliest });
        if found.is_some() {
            *self = Self::new(self.thresholds, self.counts);
        }
        found
    }

    fn learn(&mut self, time: f64, value: f64, variance: f64) {
        if self.learnt.count == 0 {
            self.origin = value;
        }
        let value = value - self.origin;
        self.learnt.add(&Sample { time, value, weight: 1.0 / variance });
        let [blocks, _] = self.counts;
        if self.learnt.count < blocks {
            return;
        }
        let mean = self.learnt.mean();
        #[expect(clippy::cast_precision_loss, reason = "hundreds")]
        let freedom = (blocks - 1) as f64;
        let squares = (self.learnt.square - self.learnt.weight * mean * mean).max(0.0);
        let most =
            ChiSquared::new(freedom).map_or(f64::INFINITY, |of| of.inverse_cdf(1.0 - SCATTER));
        self.scatter = if squares > most { squares / freedom } else { 1.0 };
        let variance = self.scatter / self.learnt.weight;
        self.reference = Some(Reference { mean: self.origin + mean, variance });
    }

    /// The likeliest step at one of the last blocks, and the root of twice the logarithm of its likelihood ratio.
    fn likeliest(&mut self, reference: &Reference, sample: Sample) -> Option<(f64, Shift)> {
        let [_, onsets] = self.counts;
        if self.window.len() == onsets {
            self.window.pop_front();
        }
        self.window.push_back(sample);
        let mut sums = Sums::default();
        let mut best: Option<(f64, Shift)> = None;
        for sample in self.window.iter().rev() {
            sums.add(sample);
            let deviation = (1.0 / sums.weight + reference.variance).sqrt();
            let change = sums.mean() - reference.mean;
            let ratio = change.abs() / deviation;
            if best.as_ref().is_none_or(|(most, _)| ratio > *most) {
                let shift = Shift {
                    test: Test::LikelihoodRatio,
                    onset: sample.time,
                    before: reference.mean,
                    change,
                    half_width: INTERVAL * deviation,
                };
                best = Some((ratio, shift));
            }
        }
        best
    }

    /// Whether a cumulative sum is above its bound.
    fn is_above(&mut self, reference: &Reference, sample: &Sample) -> bool {
        let Some(most) = self.thresholds.sum else { return false };
        let deviation = (1.0 / sample.weight + reference.variance).sqrt();
        let z = (sample.value - reference.mean) / deviation;
        for (sum, sign) in self.cumulative.iter_mut().zip([1.0, -1.0]) {
            *sum = (*sum + sign * z - DRIFT).max(0.0);
        }
        self.cumulative.iter().any(|sum| *sum > most)
    }
}
