//! [`Samples`]: what a run keeps of the states on the way: samples, or what they are reduced to.

use crate::Array;

/// What the samples of a number are reduced to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reduction {
    /// The smallest.
    Min,
    /// The largest.
    Max,
    /// The mean.
    Mean,
    /// The root of the mean square.
    Rms,
}

impl Reduction {
    /// Its array on the device.
    pub(crate) fn array(self) -> Array {
        match self {
            Self::Min => Array::Minimum,
            Self::Max => Array::Maximum,
            Self::Mean => Array::Mean,
            Self::Rms => Array::Rms,
        }
    }

    /// Takes a sample in.
    fn add(self, to: &mut f64, number: f64, is_first: bool) {
        *to = match self {
            Self::Min if is_first || number < *to => number,
            Self::Max if is_first || number > *to => number,
            Self::Min | Self::Max => *to,
            Self::Mean if is_first => 0.0 + number,
            Self::Rms if is_first => 0.0 + number * number,
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

/// What is kept.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SampleSettings {
    /// Steps between samples, at least one. The first sample is the state at the start, as it was given.
    pub every: usize,
    /// Whether samples are kept.
    pub history: bool,
    /// What they are reduced to.
    pub reductions: Vec<Reduction>,
}

/// What was kept, a row for each state; of a state that failed, nothing that counts.
#[derive(Clone, Debug, PartialEq)]
pub struct Samples {
    /// What they are reduced to.
    pub reductions: Vec<Reduction>,
    /// The samples of a state one after another; empty where they are not kept.
    pub history: Vec<f64>,
    /// What they were reduced to, in the order of `reductions`.
    pub reduced: Vec<Vec<f64>>,
}

impl Samples {
    pub(crate) fn new(settings: &SampleSettings, samples: usize, numbers: usize) -> Self {
        Self {
            reductions: settings.reductions.clone(),
            history: vec![f64::NAN; if settings.history { numbers * samples } else { 0 }],
            reduced: settings.reductions.iter().map(|_| vec![f64::NAN; numbers]).collect(),
        }
    }
}

/// Where the samples of one state go.
pub(crate) struct StateSamples<'a> {
    pub(crate) history: &'a mut [f64],
    pub(crate) reduced: Vec<(Reduction, &'a mut [f64])>,
    pub(crate) taken: usize,
}

impl StateSamples<'_> {
    /// Takes a state in.
    pub(crate) fn take(&mut self, row: &[f64]) {
        let start = self.taken * row.len();
        if let Some(to) = self.history.get_mut(start..start + row.len()) {
            to.copy_from_slice(row);
        }
        for (reduction, to) in &mut self.reduced {
            to.iter_mut().zip(row).for_each(|(to, x)| reduction.add(to, *x, self.taken == 0));
        }
        self.taken += 1;
    }

    /// Ends the reductions.
    #[expect(clippy::cast_precision_loss, reason = "fewer samples than 2^53")]
    pub(crate) fn end(&mut self) {
        for (reduction, to) in &mut self.reduced {
            to.iter_mut().for_each(|of| reduction.end(of, self.taken as f64));
        }
    }
}
