//! [`Detector`]: one quantity, block after block, against what it was at first: generalised likelihood ratio of a step, and
//! cumulative sums.
//!
//! Two causes may change one series: its own quantity by the same amount in every block, and another by a signature that differs from block to
//! block. The likelier one is named; later blocks may name the other.

use std::collections::VecDeque;

use super::thresholds::{DRIFT, Thresholds};

/// Half the width of an interval of 95 %, deviations.
pub(super) const INTERVAL: f64 = 1.959_963_984_540_054;

/// Blocks after an alarm in which its cause is looked at again.
pub(super) const NAMING: usize = 30;

/// Twice the logarithm of the likelihood ratio by which the other cause must be likelier: 100 to 1.
pub(super) const LIKELIER: f64 = 9.210_340_371_976_184;

/// Which test raised an alarm.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Test {
    /// Generalised likelihood ratio of a step at one of the last blocks.
    LikelihoodRatio,
    /// Cumulative sum: a change that is slow or small.
    CumulativeSum,
}

impl Test {
    /// What it is called: `likelihood ratio`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::LikelihoodRatio => "likelihood ratio",
            Self::CumulativeSum => "cumulative sum",
        }
    }
}

/// What has changed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shift {
    /// Which test found it.
    pub test: Test,
    /// From when on, s: the start of a block.
    pub onset: f64,
    /// The reference; zero of a torque constant, which is by that of the scenario.
    pub before: f64,
    /// The mean since the onset less the reference.
    pub change: f64,
    /// Half the width of its interval of 95 %, at this onset.
    pub half_width: f64,
}

/// What changes the series.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Cause {
    /// The quantity itself, by the same amount in each block.
    Own,
    /// Another quantity, by its signature.
    Other,
}

impl Cause {
    pub(super) const ALL: [Self; 2] = [Self::Own, Self::Other];

    /// Its place in `ALL`.
    pub(super) fn index(self) -> usize {
        usize::from(self == Self::Other)
    }
}

/// What is tested.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// Steps at one of so many last blocks, and cumulative sums.
    Level,
    /// As a level; but a decrease in the last block only is looked at in the next one, too: a phase that turns within a block looks the
    /// same.
    Amplitude,
    /// One estimate by itself.
    Single,
    /// As one, whose expectation is zero.
    Centred,
    /// The drag of a wheel, whose rate goes on from block to block: not of a series of estimates.
    Drag,
}

/// An estimate of a block.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sample {
    /// Start of the block, s.
    pub(super) time: f64,
    pub(super) value: f64,
    pub(super) variance: f64,
    /// By how much the other cause changes it, by one unit; zero without another cause.
    pub(super) signature: f64,
}

/// Weighted sums since an onset.
#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    count: usize,
    weight: f64,
    value: f64,
    /// With the signature.
    signature: f64,
    square: f64,
    moment: f64,
}

impl Sums {
    fn add(&mut self, sample: &Sample, mean: f64) {
        let weight = sample.variance.recip();
        let (value, signature) = (sample.value - mean, sample.signature);
        self.count += 1;
        self.weight += weight;
        self.value += weight * value;
        self.signature += weight * signature;
        self.square += weight * signature * signature;
        self.moment += weight * signature * value;
    }

    /// Change by a cause, and its deviation.
    fn estimate(&self, cause: Cause, reference: &Reference) -> Option<[f64; 2]> {
        let variance = reference.scatter * correlated(self.count, reference.correlation);
        match cause {
            Cause::Own => {
                let deviation = (variance / self.weight + reference.variance).sqrt();
                Some([self.value / self.weight, deviation])
            }
            Cause::Other => (self.square > 0.0).then(|| {
                let lever = self.signature / self.square;
                let deviation = variance / self.square + lever * lever * reference.variance;
                [self.moment / self.square, deviation.sqrt()]
            }),
        }
    }
}

/// Variance of a mean of so many values by that of uncorrelated ones; correlation falls off geometrically.
fn correlated(count: usize, correlation: f64) -> f64 {
    let (count, rest) = (crate::spectra::float(count), 1.0 - correlation);
    (1.0 + correlation) / rest
        - 2.0 * correlation * (1.0 - correlation.powf(count)) / (count * rest * rest)
}

/// Sums while the reference is taken, about its first value, so that squares do not cancel.
#[derive(Clone, Copy, Debug, Default)]
struct Learning {
    count: usize,
    origin: f64,
    weight: f64,
    value: f64,
    square: f64,
    largest: f64,
    /// Weighted products of neighbours, and sums of what is first and second in them.
    product: f64,
    last: Option<[f64; 2]>,
}

/// What a quantity was while the reference was taken.
#[derive(Clone, Copy, Debug)]
struct Reference {
    mean: f64,
    /// Of the mean.
    variance: f64,
    /// Variance of estimates by the stated one.
    scatter: f64,
    /// Of neighbouring blocks.
    correlation: f64,
}

/// An alarm whose cause is looked at again.
#[derive(Clone, Debug)]
struct Naming {
    reference: Reference,
    /// Those of the alarm, and the blocks since then.
    window: VecDeque<Sample>,
    /// The block of the alarm, s: no onset is later.
    latest: f64,
    cause: Cause,
    left: usize,
}

/// A cause, and the root of twice the logarithm of its likelihood ratio.
type Found = (f64, Shift, Cause);

/// The likeliest onset of each cause.
fn search(window: &VecDeque<Sample>, latest: f64, reference: &Reference) -> [Option<Found>; 2] {
    let mut sums = Sums::default();
    let mut best: [Option<Found>; 2] = [None; 2];
    for sample in window.iter().rev() {
        sums.add(sample, reference.mean);
        if sample.time > latest {
            continue;
        }
        for (best, cause) in best.iter_mut().zip(Cause::ALL) {
            let Some(estimate) = sums.estimate(cause, reference) else { continue };
            let ratio = estimate[0].abs() / estimate[1];
            if best.is_none_or(|(most, ..)| ratio > most) {
                *best = Some((ratio, shift(cause, sample.time, estimate, reference), cause));
            }
        }
    }
    best
}

/// Twice the logarithm of its likelihood ratio.
fn square(of: Option<Found>) -> f64 {
    of.map_or(0.0, |(ratio, ..)| ratio * ratio)
}

/// The tests of one quantity. Its memory does not grow.
#[derive(Clone, Debug)]
pub(super) struct Detector {
    kind: Kind,
    thresholds: Thresholds,
    /// Blocks of the reference, and onsets that are tried.
    counts: [usize; 2],
    learnt: Learning,
    reference: Option<Reference>,
    window: VecDeque<Sample>,
    /// Cumulative sums upwards and downwards.
    cumulative: [f64; 2],
    naming: Option<Naming>,
}

impl Detector {
    pub(super) fn new(kind: Kind, thresholds: Thresholds, counts: [usize; 2]) -> Self {
        Self {
            kind,
            thresholds,
            counts,
            learnt: Learning::default(),
            reference: None,
            window: VecDeque::with_capacity(counts[1] + 1),
            cumulative: [0.0; 2],
            naming: None,
        }
    }

    /// The reference and the scatter about it by the stated variance; none while it is taken.
    pub(super) fn reference(&self) -> Option<[f64; 2]> {
        self.reference.map(|of| [of.mean, of.scatter])
    }

    /// Takes the estimate of a block. After an alarm a new reference is taken, and the cause is looked at again.
    pub(super) fn take(&mut self, sample: Sample) -> Option<(Shift, Cause)> {
        let sound = sample.value.is_finite()
            && sample.signature.is_finite()
            && sample.variance.is_finite()
            && sample.variance > 0.0;
        if !sound {
            return None;
        }
        let Some(reference) = self.reference else {
            self.learn(&sample);
            return self.named_otherwise(sample);
        };
        let likeliest = self.likeliest(&reference, sample);
        let above = self.is_above(&reference, &sample);
        let (ratio, shift, cause) = likeliest?;
        let sudden = shift.change < 0.0 && shift.onset.to_bits() == sample.time.to_bits();
        if self.kind == Kind::Amplitude && sudden {
            return None;
        }
        let test = if ratio > self.thresholds.ratio {
            Test::LikelihoodRatio
        } else if above {
            Test::CumulativeSum
        } else {
            return None;
        };
        let window = std::mem::take(&mut self.window);
        let naming = Naming { reference, window, latest: sample.time, cause, left: NAMING };
        *self = Self::new(self.kind, self.thresholds, self.counts);
        self.naming = Some(naming);
        Some((Shift { test, ..shift }, cause))
    }

    fn learn(&mut self, sample: &Sample) {
        let learnt = &mut self.learnt;
        if learnt.count == 0 && self.kind != Kind::Centred {
            learnt.origin = sample.value;
        }
        let (value, weight) = (sample.value - learnt.origin, sample.variance.recip());
        learnt.count += 1;
        learnt.weight += weight;
        learnt.value += weight * value;
        learnt.square += weight * value * value;
        learnt.largest = learnt.largest.max(weight * value * value);
        if let Some([before, other]) = learnt.last {
            let (both, mean) = ((weight * other).sqrt(), learnt.value / learnt.weight);
            learnt.product += both * (value - mean) * (before - mean);
        }
        learnt.last = Some([value, weight]);
        let [blocks, _] = self.counts;
        if learnt.count < blocks {
            return;
        }
        let count = crate::spectra::float(blocks);
        self.reference = Some(if self.kind == Kind::Centred {
            // The largest of so many normal numbers is about sqrt(2 ln n): modes and tones make large steps likelier than their mean square says.
            let tail = learnt.largest / (2.0 * libm::log(count)).max(1.0);
            let scatter = (learnt.square / count).max(tail).max(1.0);
            Reference { mean: 0.0, variance: 0.0, scatter, correlation: 0.0 }
        } else {
            let mean = learnt.value / learnt.weight;
            let squares = (learnt.square - learnt.weight * mean * mean).max(0.0);
            let scatter = (squares / (count - 1.0)).max(1.0);
            let correlation =
                if squares > 0.0 { (learnt.product / squares).clamp(0.0, 0.8) } else { 0.0 };
            let variance = scatter * correlated(blocks, correlation) / learnt.weight;
            Reference { mean: learnt.origin + mean, variance, scatter, correlation }
        });
    }

    /// The likeliest step at one of the last blocks, its cause, and the root of twice the logarithm of its likelihood ratio.
    fn likeliest(&mut self, reference: &Reference, sample: Sample) -> Option<Found> {
        let [_, onsets] = self.counts;
        if self.window.len() == onsets {
            self.window.pop_front();
        }
        self.window.push_back(sample);
        let [own, other] = search(&self.window, f64::INFINITY, reference);
        // Where signatures hardly differ from block to block both are as likely.
        if square(other) > square(own) + LIKELIER { other } else { own }
    }

    /// Whether a cumulative sum is above its bound.
    fn is_above(&mut self, reference: &Reference, sample: &Sample) -> bool {
        let Some(most) = self.thresholds.sum else { return false };
        // A sum of many: as if each were as variable as their mean is.
        let correlation = (1.0 + reference.correlation) / (1.0 - reference.correlation);
        let variance = reference.scatter * correlation * sample.variance;
        let z = (sample.value - reference.mean) / (variance + reference.variance).sqrt();
        for (sum, sign) in self.cumulative.iter_mut().zip([1.0, -1.0]) {
            *sum = (*sum + sign * z - DRIFT).max(0.0);
        }
        self.cumulative.iter().any(|sum| *sum > most)
    }

    /// After an alarm: the other cause with its own onset, where that has become likelier.
    fn named_otherwise(&mut self, sample: Sample) -> Option<(Shift, Cause)> {
        let naming = self.naming.as_mut()?;
        naming.window.push_back(sample);
        naming.left = naming.left.saturating_sub(1);
        let [own, other] = search(&naming.window, naming.latest, &naming.reference);
        let [now, then] = if naming.cause == Cause::Own { [own, other] } else { [other, own] };
        let found = then.filter(|_| square(then) > square(now) + LIKELIER);
        if let Some((_, _, cause)) = found {
            naming.cause = cause;
        }
        if naming.left == 0 {
            self.naming = None;
        }
        found.map(|(_, shift, cause)| (shift, cause))
    }
}

fn shift(cause: Cause, onset: f64, [change, deviation]: [f64; 2], reference: &Reference) -> Shift {
    let before = if cause == Cause::Own { reference.mean } else { 0.0 };
    let half_width = INTERVAL * deviation;
    Shift { test: Test::LikelihoodRatio, onset, before, change, half_width }
}
