//! [`StepSearch`]: a step of a reading at any time within the last one and a half blocks, beside a parabola.
//!
//! Readings of a block, less the model, are averaged over eight bins. At the end of a block a parabola and a step are fitted to the bins of this
//! block and the one before, at each of twelve times; what the model does not have grows slowly, and is in the parabola. The largest
//! of twelve ratios z is taken as the normal one that is as rare by Bonferroni's bound, `sqrt(z² - 2 ln 12)`. Neighbouring readings are not
//! independent where the model lacks a mode or a disturbance: the mean of all twelve squares, one of white noise, is learnt over the first blocks, and
//! ratios are by its root. Where a torque from any of these times on, a
//! change of slope, is likelier it is no step.

use nalgebra::{Matrix4, Vector4};

use crate::spectra::float;

/// Bins of a block.
pub(super) const BINS: usize = 8;

/// Twice the logarithm of the number of times that are tried.
const TRIED: f64 = 4.969_813_299_576_001;

/// The ratio of what is no step.
const NONE: f64 = 0.1;

/// Readings of a bin.
#[derive(Clone, Copy, Debug, Default)]
struct Bin {
    count: f64,
    time: f64,
    value: f64,
}

/// The search in one channel.
#[derive(Clone, Debug)]
pub(super) struct StepSearch {
    bins: [Bin; BINS],
    /// Those of the block before, at times before this block.
    before: Option<[Bin; BINS]>,
    /// Blocks that the scatter is learnt of, those that were, and the sum of their mean squares.
    reference: usize,
    learnt: usize,
    squares: f64,
}

impl StepSearch {
    /// Whose scatter is learnt of so many blocks; of none it is that of white noise.
    pub(super) fn new(reference: usize) -> Self {
        Self { bins: [Bin::default(); BINS], before: None, reference, learnt: 0, squares: 0.0 }
    }

    /// Forgets the block before, and what there is of this one.
    pub(super) fn forget(&mut self) {
        self.before = None;
        self.bins = [Bin::default(); BINS];
    }

    /// Mean square of the ratios of steps at all times by that of white noise, as the reference has it.
    fn scatter(&self) -> f64 {
        let told = self.learnt > 0 && self.learnt == self.reference;
        if told { (self.squares / float(self.learnt)).max(1.0) } else { 1.0 }
    }

    /// Takes a reading, less the model's integral since the start of the block, at this share of the block.
    pub(super) fn read(&mut self, share: f64, value: f64) {
        if let Some(bin) = self.bins.get_mut(bin(share)) {
            bin.count += 1.0;
            bin.time += share;
            bin.value += value;
        }
    }

    /// The likeliest step and its variance, of readings with this variance; none without a block before, or where bins are empty. The model's
    /// integral over the block makes its readings those of the next one.
    pub(super) fn end(&mut self, variance: f64, predicted: f64) -> Option<[f64; 2]> {
        self.end_with(variance, predicted, |_| 0.0)
    }

    /// The same, less the mean over each bin of something that is known by now.
    pub(super) fn end_with(
        &mut self,
        variance: f64,
        predicted: f64,
        known: impl Fn(usize) -> f64,
    ) -> Option<[f64; 2]> {
        for (index, bin) in self.bins.iter_mut().enumerate() {
            bin.value -= known(index);
        }
        let found = self.before.and_then(|before| likeliest(&before, &self.bins));
        let scatter = self.scatter();
        if let (Some(found), true) = (&found, self.learnt < self.reference && variance > 0.0) {
            self.learnt += 1;
            self.squares += found.mean / variance;
        }
        let moved = self.bins.map(|of| Bin {
            count: of.count,
            time: of.time - of.count,
            value: of.value + predicted * of.count,
        });
        self.before = Some(moved);
        self.bins = [Bin::default(); BINS];
        found.map(|found| found.step(variance * scatter))
    }
}

/// The bin at this share of a block.
pub(super) fn bin(share: f64) -> usize {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "from zero to eight"
    )]
    let index = (share.clamp(0.0, 1.0) * float(BINS)) as usize;
    index.min(BINS - 1)
}

/// A parabola and a shape that begins after so many bins.
struct Fitted {
    /// Of the shape, and its variance by that of a reading.
    change: f64,
    square: f64,
    /// Weighted squares of what is left.
    left: f64,
}

/// Fits it, without one of the bins where that is given.
fn fit(
    bins: &[Bin],
    split: usize,
    without: Option<usize>,
    shape: impl Fn(f64) -> f64,
) -> Option<Fitted> {
    let (mut normal, mut moments, mut squares) = (Matrix4::zeros(), Vector4::zeros(), 0.0);
    for (index, bin) in bins.iter().enumerate().filter(|(index, _)| without != Some(*index)) {
        let (time, value) = (bin.time / bin.count, bin.value / bin.count);
        let last = if index < split { 0.0 } else { shape(time) };
        let row = Vector4::new(1.0, time, time * time, last);
        normal += row * row.transpose() * bin.count;
        moments += row * (value * bin.count);
        squares += value * value * bin.count;
    }
    let inverse = normal.try_inverse()?;
    let found = inverse * moments;
    let square = inverse[(3, 3)];
    (square > 0.0).then(|| Fitted { change: found[3], square, left: squares - found.dot(&moments) })
}

/// The better one of two.
fn better(one: Option<Fitted>, other: Option<Fitted>) -> Option<Fitted> {
    match (one, other) {
        (Some(one), Some(other)) => Some(if other.left < one.left { other } else { one }),
        (one, other) => one.or(other),
    }
}

/// The likeliest step of two blocks.
struct Likeliest {
    /// Squares by the variance of its size, of white noise of the readings with a variance of one: of the likeliest, and the mean over all times.
    gain: f64,
    mean: f64,
    size: f64,
    /// Weighted squares of what is left by a step, and by a change of slope; none in the last bin, of which the next block tells.
    left: Option<[f64; 2]>,
}

impl Likeliest {
    /// Its size and variance, of readings with this variance.
    fn step(&self, variance: f64) -> [f64; 2] {
        let is_step = self.left.is_some_and(|[step, slope]| step + variance < slope);
        let square = self.gain / variance - TRIED;
        let ratio = if is_step && square > NONE * NONE { square.sqrt() } else { NONE };
        [self.size, (self.size / ratio).powi(2)]
    }
}

fn likeliest(before: &[Bin; BINS], now: &[Bin; BINS]) -> Option<Likeliest> {
    let mut all: Vec<Bin> = before.iter().chain(now).copied().collect();
    if all.iter().any(|of| of.count == 0.0) {
        return None;
    }
    // About their mean, so that squares do not cancel.
    let count: f64 = all.iter().map(|of| of.count).sum();
    let mean = all.iter().map(|of| of.value).sum::<f64>() / count;
    for bin in &mut all {
        bin.value -= mean * bin.count;
    }
    let (mut best, mut slope): (Option<(f64, usize, f64)>, Option<Fitted>) = (None, None);
    let (mut squares, mut tried) = (0.0, 0.0);
    for split in BINS / 2..2 * BINS {
        let start = float(split) / float(BINS) - 1.0;
        slope = better(slope, fit(&all, split, None, |time| time - start));
        let Some(Fitted { change, square, .. }) = fit(&all, split, None, |_| 1.0) else { continue };
        let gain = change * change / square;
        (squares, tried) = (squares + gain, tried + 1.0);
        if best.is_none_or(|(most, ..)| gain > most) {
            best = Some((gain, split, change));
        }
    }
    let (gain, split, change) = best?;
    // It is in the middle of a bin, the one before or after: without that bin, whose value is one more parameter, its size is the step's.
    let step = |middle: usize| fit(&all, middle, Some(middle), |_| 1.0);
    let step = better(step(split - 1), step(split));
    let inside = split + 1 < 2 * BINS;
    let left = step.as_ref().zip(slope).filter(|_| inside).map(|(a, b)| [a.left, b.left]);
    let size = step.map_or(change, |of| of.change);
    Some(Likeliest { gain, mean: squares / tried, size, left })
}
