//! [`DragDetector`]: the drag of a wheel, and the torque constant of its motor, by its rate, which goes on from each block to the next.
//!
//! A block has the rate r at its start and the drag d in it, by least squares of the tachometer's readings with variances. Over the block
//!
//! ```text
//! r' = r + predicted + g (d + e) + w,   d' = d,   e' = 0.8 e + v
//! ```
//!
//! with the response g of the rate to drag, and torques that the model lacks: w is white from block to block, e fades within five blocks. A
//! Kalman filter follows r, d and e. The variances of w and e, and one scale of all variances, are those of the largest likelihood over the
//! reference, on a grid. Over the first blocks a change is known better with the power 3/2 of their number: rates at both ends of a time tell it.
//!
//! A change from an onset on is one more state: a filter of each of the last onsets and of each cause begins with what was known then. The estimate of the
//! change by its deviation is the root of twice the logarithm of the likelihood ratio. A fault begins within a block: its cause, its size and
//! the interval are by the blocks after the one of the onset, with a new rate at their start.

use std::collections::VecDeque;

use nalgebra::{Matrix2, Matrix2x4, Matrix4, Vector2, Vector4};

use super::detector::{Cause, INTERVAL, LIKELIER, NAMING, Shift, Test};

/// Variances of w by that of a rate at the start of a block, which are tried.
const WALKS: [f64; 9] = [1e-6, 1e-4, 1e-3, 1e-2, 0.1, 0.3, 1.0, 10.0, 100.0];

/// Variances of e by that of the drag of a block, which are tried. However quiet the reference is, no model is trusted to less than a tenth of that
/// deviation.
const LACKING: [f64; 6] = [0.01, 0.03, 0.1, 0.3, 1.0, 10.0];

/// What is left of e after a block.
const STAYS: f64 = 0.8;

/// What is not known has this many deviations of a block.
const UNKNOWN: f64 = 1e4;

/// What a block says of the rate of a wheel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct DragSample {
    /// Start and end, s.
    pub(super) times: [f64; 2],
    /// Whether it is the same rate as in the block before: no reading has been forgotten or corrected.
    pub(super) continues: bool,
    /// Rate at the start, rad/s, and drag, N m, with their covariance.
    pub(super) value: Vector2<f64>,
    pub(super) covariance: Matrix2<f64>,
    /// What the model adds to the rate over the block, rad/s.
    pub(super) predicted: f64,
    /// What a unit of each cause, drag and torque constant, adds to the rate over the block, and to the values.
    pub(super) added: [f64; 2],
    pub(super) seen: [Vector2<f64>; 2],
}

impl DragSample {
    fn is_sound(&self) -> bool {
        let values = self.value.iter().chain(&self.covariance).chain(&self.added);
        let all = values.chain(self.seen.iter().flatten()).chain([&self.predicted]);
        all.copied().all(f64::is_finite) && self.covariance.determinant() > 0.0
    }
}

/// Variances of what the model lacks: of w and e, by those of a block.
#[derive(Clone, Copy, Debug, Default)]
struct Lacking {
    walk: f64,
    torque: f64,
}

/// Rate, drag, change and e, with their covariance, under a change of one cause.
#[derive(Clone, Copy, Debug)]
struct Filter {
    state: Vector4<f64>,
    covariance: Matrix4<f64>,
    cause: Cause,
}

impl Filter {
    fn new(sample: &DragSample, lacking: Lacking) -> Self {
        let [rate, drag] = [0, 1].map(|of| sample.covariance[(of, of)]);
        let large = UNKNOWN * UNKNOWN;
        let variances = Vector4::new(large * rate, large * drag, 0.0, lacking.torque * drag);
        let state = Vector4::new(sample.value.x, sample.value.y, 0.0, 0.0);
        Self { state, covariance: Matrix4::from_diagonal(&variances), cause: Cause::Own }
    }

    /// The same with a change from this block on.
    fn with(&self, sample: &DragSample, cause: Cause) -> Self {
        let seen = sample.seen[cause.index()].y;
        let unit = if seen == 0.0 { 1.0 } else { seen };
        let mut with = Self { cause, ..*self };
        with.covariance[(2, 2)] = sample.covariance[(1, 1)] * (UNKNOWN / unit).powi(2);
        with
    }

    /// The rate at the start of this block is a new one.
    fn restart(&mut self, sample: &DragSample) {
        self.state.x = sample.value.x;
        self.covariance.row_mut(0).fill(0.0);
        self.covariance.column_mut(0).fill(0.0);
        self.covariance[(0, 0)] = sample.covariance[(0, 0)] * UNKNOWN * UNKNOWN;
    }

    /// Takes the values of a block: the logarithm of the determinant of the innovation's covariance, and its square by that.
    fn update(&mut self, sample: &DragSample) -> [f64; 2] {
        let seen = sample.seen[self.cause.index()];
        let by_state = Matrix2x4::new(1.0, 0.0, seen.x, 0.0, 0.0, 1.0, seen.y, 1.0);
        let innovation = sample.value - by_state * self.state;
        let variance = by_state * self.covariance * by_state.transpose() + sample.covariance;
        let Some(inverse) = variance.try_inverse() else { return [0.0; 2] };
        let gain = self.covariance * by_state.transpose() * inverse;
        let rest = Matrix4::identity() - gain * by_state;
        self.state += gain * innovation;
        self.covariance =
            rest * self.covariance * rest.transpose() + gain * sample.covariance * gain.transpose();
        [libm::log(variance.determinant()), innovation.dot(&(inverse * innovation))]
    }

    /// Moves on to the end of the block.
    fn advance(&mut self, sample: &DragSample, lacking: Lacking) {
        let [drag, _] = sample.added;
        let change = sample.added[self.cause.index()];
        let step = Matrix4::new(
            1.0, drag, change, drag, //
            0.0, 1.0, 0.0, 0.0, //
            0.0, 0.0, 1.0, 0.0, //
            0.0, 0.0, 0.0, STAYS,
        );
        self.state = step * self.state;
        self.state.x += sample.predicted;
        self.covariance = step * self.covariance * step.transpose();
        self.covariance[(0, 0)] += lacking.walk * sample.covariance[(0, 0)];
        self.covariance[(3, 3)] +=
            (1.0 - STAYS * STAYS) * lacking.torque * sample.covariance[(1, 1)];
    }

    /// Square of the change by its variance.
    fn square(&self) -> f64 {
        self.state.z * self.state.z / self.covariance[(2, 2)]
    }

    fn shift(&self, onset: f64) -> Shift {
        let before = if self.cause == Cause::Own { self.state.y } else { 0.0 };
        let half_width = INTERVAL * self.covariance[(2, 2)].sqrt();
        Shift { test: Test::LikelihoodRatio, onset, before, change: self.state.z, half_width }
    }
}

/// A change from a block on.
#[derive(Clone, Copy, Debug)]
struct Onset {
    time: f64,
    /// From its start on, by each cause.
    exact: [Filter; 2],
    /// From within it, by the blocks after it; none of the last block.
    within: Option<[Filter; 2]>,
}

impl Onset {
    fn filters(&mut self) -> impl Iterator<Item = &mut Filter> {
        self.exact.iter_mut().chain(self.within.iter_mut().flatten())
    }
}

/// An alarm whose cause is looked at again.
#[derive(Clone, Debug)]
struct Naming {
    filters: [Filter; 2],
    cause: Cause,
    onset: f64,
    left: usize,
    scale: f64,
    lacking: Lacking,
}

/// What the reference has.
#[derive(Clone, Copy, Debug)]
struct Reference {
    filter: Filter,
    /// Of all variances.
    scale: f64,
    lacking: Lacking,
}

/// The tests of one wheel. Its memory does not grow.
#[derive(Clone, Debug)]
pub(super) struct DragDetector {
    /// Of the root of twice the logarithm of the likelihood ratio.
    bound: f64,
    /// Blocks of the reference, and onsets that are tried.
    counts: [usize; 2],
    learnt: Vec<DragSample>,
    reference: Option<Reference>,
    onsets: VecDeque<Onset>,
    /// The end of the last block, s.
    last: Option<f64>,
    naming: Option<Naming>,
}

impl DragDetector {
    pub(super) fn new(bound: f64, counts: [usize; 2]) -> Self {
        Self {
            bound,
            counts,
            learnt: Vec::new(),
            reference: None,
            onsets: VecDeque::with_capacity(counts[1] + 1),
            last: None,
            naming: None,
        }
    }

    /// The drag and the scale of its variances; none while the reference is taken.
    pub(super) fn reference(&self) -> Option<[f64; 2]> {
        self.reference.map(|of| [of.filter.state.y, of.scale])
    }

    /// Takes a block. After an alarm a new reference is taken, and the cause is looked at again.
    pub(super) fn take(&mut self, sample: &DragSample) -> Option<(Shift, Cause)> {
        if !sample.is_sound() {
            return None;
        }
        let [start, end] = sample.times;
        let continues =
            sample.continues && self.last.is_none_or(|last| last.to_bits() == start.to_bits());
        self.last = Some(end);
        let sample = DragSample { continues, ..*sample };
        let Some(mut reference) = self.reference else {
            self.learnt.push(sample);
            let [blocks, _] = self.counts;
            if self.learnt.len() >= blocks {
                self.reference = learn(&std::mem::take(&mut self.learnt));
            }
            return self.named_otherwise(&sample);
        };
        let sample = scaled(&sample, reference.scale);
        self.begin(&mut reference.filter, &sample);
        let found = self.likeliest().filter(|of| of.square > self.bound * self.bound);
        let Some(Likeliest { filters, onset, .. }) = found else {
            reference.filter.advance(&sample, reference.lacking);
            for of in self.onsets.iter_mut().flat_map(Onset::filters) {
                of.advance(&sample, reference.lacking);
            }
            self.reference = Some(reference);
            return None;
        };
        let [own, other] = filters.each_ref().map(Filter::square);
        let cause = if other > own + LIKELIER { Cause::Other } else { Cause::Own };
        let shift = filters[cause.index()].shift(onset);
        let Reference { scale, lacking, .. } = reference;
        let mut naming = Naming { filters, cause, onset, left: NAMING, scale, lacking };
        naming.filters.iter_mut().for_each(|of| of.advance(&sample, lacking));
        *self = Self::new(self.bound, self.counts);
        (self.last, self.naming) = (Some(end), Some(naming));
        Some((shift, cause))
    }

    /// Takes the block into all filters, of which those of an onset in it are new.
    fn begin(&mut self, filter: &mut Filter, sample: &DragSample) {
        if !sample.continues {
            filter.restart(sample);
            self.onsets.iter_mut().flat_map(Onset::filters).for_each(|of| of.restart(sample));
        }
        let [_, most] = self.counts;
        if self.onsets.len() == most {
            self.onsets.pop_front();
        }
        let exact = Cause::ALL.map(|cause| filter.with(sample, cause));
        if let Some(before) = self.onsets.back_mut() {
            let mut within = exact;
            for of in &mut within {
                of.restart(sample);
            }
            before.within = Some(within);
        }
        self.onsets.push_back(Onset { time: sample.times[0], exact, within: None });
        filter.update(sample);
        for of in self.onsets.iter_mut().flat_map(Onset::filters) {
            of.update(sample);
        }
    }

    /// The likeliest change from the start of one of the last blocks on.
    fn likeliest(&self) -> Option<Likeliest> {
        let square = |of: &Onset| of.exact.iter().map(Filter::square).fold(0.0, f64::max);
        let all = self.onsets.iter().enumerate().map(|(place, of)| (place, square(of)));
        let (place, square) = all.max_by(|(_, a), (_, b)| a.total_cmp(b))?;
        let onset = self.onsets.get(place)?;
        // Of the last block there is none after it yet: it may have begun in the one before.
        let begun = onset.within.is_none().then(|| place.checked_sub(1)).flatten();
        let of = begun.and_then(|place| self.onsets.get(place)).unwrap_or(onset);
        Some(Likeliest { square, filters: of.within.unwrap_or(of.exact), onset: onset.time })
    }

    /// After an alarm: the other cause, where that has become likelier.
    fn named_otherwise(&mut self, sample: &DragSample) -> Option<(Shift, Cause)> {
        let naming = self.naming.as_mut()?;
        let sample = scaled(sample, naming.scale);
        for of in &mut naming.filters {
            if !sample.continues {
                of.restart(&sample);
            }
            of.update(&sample);
        }
        let filters = naming.filters;
        naming.filters.iter_mut().for_each(|of| of.advance(&sample, naming.lacking));
        naming.left = naming.left.saturating_sub(1);
        let onset = naming.onset;
        let then = if naming.cause == Cause::Own { Cause::Other } else { Cause::Own };
        let [now, other] = [naming.cause, then].map(|cause| filters[cause.index()].square());
        let found = (other > now + LIKELIER).then_some(then);
        naming.cause = found.unwrap_or(naming.cause);
        if naming.left == 0 {
            self.naming = None;
        }
        found.map(|cause| (filters[cause.index()].shift(onset), cause))
    }
}

/// A change that the last blocks have.
struct Likeliest {
    square: f64,
    /// Those from within the block of the onset.
    filters: [Filter; 2],
    onset: f64,
}

fn scaled(sample: &DragSample, scale: f64) -> DragSample {
    DragSample { covariance: sample.covariance * scale, ..*sample }
}

/// What blocks without a change have.
fn learn(blocks: &[DragSample]) -> Option<Reference> {
    let first = blocks.first()?;
    let all = WALKS.iter().flat_map(|walk| LACKING.map(|torque| Lacking { walk: *walk, torque }));
    let likely = all.map(|lacking| {
        let mut filter = Filter::new(first, lacking);
        let (mut logarithms, mut squares, mut count) = (0.0, 0.0, 0.0);
        for (index, sample) in blocks.iter().enumerate() {
            if !sample.continues {
                filter.restart(sample);
            }
            let [logarithm, square] = filter.update(sample);
            // Of the first block nothing is known before.
            if index > 0 {
                (logarithms, squares, count) =
                    (logarithms + logarithm, squares + square, count + 2.0);
            }
            filter.advance(sample, lacking);
        }
        let scale = squares / count;
        filter.covariance *= scale;
        (logarithms + count * libm::log(scale), Reference { filter, scale, lacking })
    });
    let likeliest = likely.min_by(|(a, _), (b, _)| a.total_cmp(b));
    likeliest.map(|(_, reference)| reference).filter(|of| of.scale > 0.0 && of.scale.is_finite())
}
