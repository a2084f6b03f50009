//! [`BatchHistory`]: what a run of a batch keeps of each element: samples, or what they are reduced to on the
//! way.

use pyo3::PyResult;
use pyo3::exceptions::PyValueError;

use precess_lanes::PART;

use super::engine::Failure;

/// What the samples of a number are reduced to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Reduction {
    Min,
    Max,
    Mean,
    /// Root of the mean square.
    Rms,
}

impl Reduction {
    pub(super) fn of_name(name: &str) -> PyResult<Self> {
        match name {
            "min" => Ok(Self::Min),
            "max" => Ok(Self::Max),
            "mean" => Ok(Self::Mean),
            "rms" => Ok(Self::Rms),
            _ => Err(PyValueError::new_err(format!(
                "reduction `{name}` is not known; it is min, max, mean or rms"
            ))),
        }
    }

    /// Takes a sample in.
    fn add(self, to: &mut f64, number: f64, is_first: bool) {
        *to = match self {
            Self::Min if is_first || number < *to || number.is_nan() => number,
            Self::Max if is_first || number > *to || number.is_nan() => number,
            Self::Min | Self::Max => *to,
            Self::Mean => *to + number,
            Self::Rms => *to + number * number,
        };
    }

    /// The result of so many samples.
    fn end(self, of: &mut f64, count: f64) {
        match self {
            Self::Min | Self::Max => {}
            Self::Mean => *of /= count,
            Self::Rms => *of = (*of / count).sqrt(),
        }
    }
}

/// What is kept, element by element.
pub(super) struct BatchHistory {
    samples: usize,
    size: usize,
    history: Vec<f64>,
    reductions: Vec<(Reduction, Vec<f64>)>,
    counts: Vec<u64>,
}

/// What is kept of the elements of a part.
pub(super) struct PartHistory<'a> {
    samples: usize,
    size: usize,
    history: &'a mut [f64],
    reductions: Vec<(Reduction, &'a mut [f64])>,
    counts: &'a mut [u64],
}

impl BatchHistory {
    pub(super) fn new(
        count: usize,
        samples: usize,
        size: usize,
        reductions: Vec<Reduction>,
    ) -> Self {
        let zeros = |of| (of, vec![0.0; count * size]);
        Self {
            samples,
            size,
            history: vec![f64::NAN; count * samples * size],
            reductions: reductions.into_iter().map(zeros).collect(),
            counts: vec![0; count],
        }
    }

    /// Part by part.
    pub(super) fn parts(&mut self) -> Vec<PartHistory<'_>> {
        let (samples, size) = (self.samples, self.size);
        let rows = PART * size;
        let mut histories = self.history.chunks_mut((rows * samples).max(1));
        let mut reduced: Vec<_> =
            self.reductions.iter_mut().map(|(of, all)| (*of, all.chunks_mut(rows))).collect();
        let counts = self.counts.chunks_mut(PART);
        let part = |counts| PartHistory {
            samples,
            size,
            history: histories.next().unwrap_or_default(),
            reductions: reduced
                .iter_mut()
                .map(|(of, chunks)| (*of, chunks.next().unwrap_or_default()))
                .collect(),
            counts,
        };
        counts.map(part).collect()
    }

    /// Samples, where they are kept, and reductions in order.
    pub(super) fn into_parts(self) -> (Option<Vec<f64>>, Vec<Vec<f64>>) {
        let history = (self.samples > 0).then_some(self.history);
        (history, self.reductions.into_iter().map(|(_, all)| all).collect())
    }
}

impl PartHistory<'_> {
    /// Numbers of a state.
    pub(super) fn size(&self) -> usize {
        self.size
    }

    /// Takes in the states at the start.
    pub(super) fn start(&mut self, y: &[f64]) {
        for (index, row) in y.chunks_exact(self.size).enumerate() {
            self.see(index, 0, row);
        }
    }

    /// Takes in the state of an element after so many steps.
    pub(super) fn see(&mut self, index: usize, _: usize, row: &[f64]) {
        let Some(count) = self.counts.get_mut(index) else { return };
        let sample = usize::try_from(*count).unwrap_or(usize::MAX);
        if sample < self.samples {
            let start = (index * self.samples + sample) * self.size;
            if let Some(to) = self.history.get_mut(start..start + self.size) {
                to.copy_from_slice(row);
            }
        }
        let start = index * self.size;
        for (of, all) in &mut self.reductions {
            let Some(to) = all.get_mut(start..start + self.size) else { continue };
            to.iter_mut().zip(row).for_each(|(to, number)| of.add(to, *number, *count == 0));
        }
        *count += 1;
    }

    /// Ends the reductions; what is kept of an element that failed becomes NaN.
    pub(super) fn finish(&mut self, ends: &[Result<(), Failure>]) {
        for (index, count) in self.counts.iter().enumerate() {
            let failed = ends.get(index).is_some_and(Result::is_err);
            let start = index * self.size;
            #[expect(clippy::cast_precision_loss, reason = "fewer samples than 2^53")]
            let count = *count as f64;
            for (of, all) in &mut self.reductions {
                let Some(numbers) = all.get_mut(start..start + self.size) else { continue };
                for number in numbers {
                    of.end(number, count);
                    if failed {
                        *number = f64::NAN;
                    }
                }
            }
            if failed {
                let row = self.samples * self.size;
                if let Some(rows) = self.history.get_mut(index * row..(index + 1) * row) {
                    rows.fill(f64::NAN);
                }
            }
        }
    }
}
