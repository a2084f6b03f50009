//! [`Index`]: the pointing error indices of ECSS, as they are formed along a history.
//!
//! ECSS-E-ST-60-10C, 3.2.2 to 3.2.12 and annex A.1.4, defines them: absolute (APE, instantaneous), mean (MPE, over a
//! window), relative (RPE, instantaneous less the mean of a window that contains the instant), drift (PDE, difference of
//! the means of two windows in one observation period), reproducibility (PRE, of two windows in different ones).
//! Errors are magnitudes, of one axis or of several together. Windows have one length and follow one another from the
//! start of a run, so each sample is in one window; a run is an observation period.

use std::collections::VecDeque;

use super::exposure::check_time;
use super::{PointingError, samples_of};
use crate::spectra::{SpectrumError, float};

/// Means that are kept for a stability time, at most.
const MEANS_MAX: f64 = 1_048_576.0;

/// An index of the pointing error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Index {
    /// Absolute performance error: the error at any time.
    Ape,
    /// Mean performance error: the mean over a window.
    Mpe {
        /// Length of the window, s.
        window: f64,
    },
    /// Relative performance error: the error less the mean over its window.
    Rpe {
        /// Length of the window, s.
        window: f64,
    },
    /// Performance drift error: difference of the means of two windows of one run.
    Pde {
        /// Length of the windows, s.
        window: f64,
        /// From the start of one to the start of the other, s: a whole multiple of the window.
        stability: f64,
    },
    /// Performance reproducibility error: difference of the means of two windows at the same time of two successive
    /// runs.
    Pre {
        /// Length of the windows, s.
        window: f64,
    },
}

impl Index {
    /// As ECSS abbreviates it.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Ape => "APE",
            Self::Mpe { .. } => "MPE",
            Self::Rpe { .. } => "RPE",
            Self::Pde { .. } => "PDE",
            Self::Pre { .. } => "PRE",
        }
    }

    /// The window, s; none of an instantaneous error.
    #[must_use]
    pub const fn window(&self) -> Option<f64> {
        match self {
            Self::Ape => None,
            Self::Mpe { window }
            | Self::Rpe { window }
            | Self::Pde { window, .. }
            | Self::Pre { window } => Some(*window),
        }
    }

    /// From one window to the other, in windows; zero where there is no other.
    fn lag(&self) -> Result<usize, PointingError> {
        let Self::Pde { window, stability } = *self else { return Ok(0) };
        let exact = stability / window;
        let whole = exact.round();
        if !(1.0..=MEANS_MAX).contains(&whole) || (whole / exact - 1.0).abs() > 1e-6 {
            return Err(PointingError::Stability { stability, window });
        }
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "within 1 and MEANS_MAX"
        )]
        let lag = whole as usize;
        Ok(lag)
    }

    /// Rejects windows that are not positive and finite.
    pub(super) fn check(&self) -> Result<(), PointingError> {
        self.window().map_or(Ok(()), check_time)?;
        self.lag().map(|_| ())
    }
}

/// The values of an index along a run, of samples that come one by one.
#[derive(Clone, Debug)]
pub(crate) struct IndexStream {
    index: Index,
    /// Samples of a window.
    samples: usize,
    lag: usize,
    /// The samples of the present window, one after the other, each with all components.
    present: Vec<f64>,
    /// Means of the last windows.
    means: VecDeque<Vec<f64>>,
}

impl IndexStream {
    /// Of an index, of samples at a rate, 1/s.
    pub(crate) fn new(index: Index, rate: f64) -> Result<Self, PointingError> {
        let samples = match (index, index.window()) {
            (_, None) => 1,
            (Index::Rpe { .. }, Some(window)) => samples_of(window, rate, 2)?,
            (_, Some(window)) => samples_of(window, rate, 1)?,
        };
        let lag = index.lag()?;
        Ok(Self { index, samples, lag, present: Vec::new(), means: VecDeque::new() })
    }

    /// One sample, not empty; the values that it completes go to `to`. The PRE has none of one run; see
    /// [`means_of_run`].
    pub(crate) fn add(&mut self, sample: &[f64], to: &mut impl FnMut(f64)) {
        if self.index == Index::Ape {
            return to(norm(sample.iter().copied()));
        }
        self.present.extend_from_slice(sample);
        let components = sample.len();
        if self.present.len() < self.samples * components {
            return;
        }
        let mean = mean_of(&self.present, components);
        match self.index {
            Index::Ape | Index::Pre { .. } => {}
            Index::Mpe { .. } => to(norm(mean.iter().copied())),
            Index::Rpe { .. } => {
                for sample in self.present.chunks_exact(components.max(1)) {
                    to(norm(sample.iter().zip(&mean).map(|(value, mean)| value - mean)));
                }
            }
            Index::Pde { .. } => {
                self.means.push_back(mean.clone());
                if self.means.len() > self.lag
                    && let Some(earlier) = self.means.pop_front()
                {
                    to(norm(mean.iter().zip(&earlier).map(|(value, earlier)| value - earlier)));
                }
            }
        }
        self.present.clear();
    }
}

/// The values of an index along a run.
pub(super) fn values_of_run(
    index: Index,
    components: &[&[f64]],
    rate: f64,
) -> Result<Vec<f64>, PointingError> {
    let length = check_run(components)?;
    let mut stream = IndexStream::new(index, rate)?;
    let mut values = Vec::new();
    for i in 0..length {
        let sample: Vec<f64> =
            components.iter().map(|c| c.get(i).copied().unwrap_or(f64::NAN)).collect();
        stream.add(&sample, &mut |value| values.push(value));
    }
    if values.is_empty() {
        let least = stream.samples.saturating_mul(1 + stream.lag);
        return Err(PointingError::Short { samples: length, least });
    }
    Ok(values)
}

/// Means over the windows of a run, for the PRE.
pub(super) fn means_of_run(
    window: f64,
    components: &[&[f64]],
    rate: f64,
) -> Result<Vec<Vec<f64>>, PointingError> {
    let length = check_run(components)?;
    let samples = samples_of(window, rate, 1)?;
    if length < samples {
        return Err(PointingError::Short { samples: length, least: samples });
    }
    let mean = |part: &[f64]| part.iter().sum::<f64>() / float(part.len());
    let window = |start: usize| {
        let part = |c: &&[f64]| mean(c.get(start..start + samples).unwrap_or_default());
        components.iter().map(part).collect()
    };
    Ok((0..length / samples).map(|k| window(k * samples)).collect())
}

/// Samples of a run, of which all components have as many; all are finite.
pub(super) fn check_run(components: &[&[f64]]) -> Result<usize, PointingError> {
    let length = components.first().map_or(0, |component| component.len());
    for (signal, component) in components.iter().enumerate() {
        if component.len() != length {
            let (expected, found) = (length, component.len());
            return Err(SpectrumError::Lengths { signal, expected, found }.into());
        }
        if let Some((index, value)) = component.iter().enumerate().find(|(_, v)| !v.is_finite()) {
            return Err(SpectrumError::Sample { signal, index, value: *value }.into());
        }
    }
    Ok(length)
}

/// Mean of samples that are one after the other, each with some components.
fn mean_of(samples: &[f64], components: usize) -> Vec<f64> {
    let mut mean = vec![0.0; components];
    let count = float(samples.len() / components.max(1));
    for sample in samples.chunks_exact(components.max(1)) {
        mean.iter_mut().zip(sample).for_each(|(sum, value)| *sum += value);
    }
    mean.into_iter().map(|sum| sum / count).collect()
}

/// The magnitude of components.
pub(super) fn norm(components: impl Iterator<Item = f64>) -> f64 {
    components.map(|component| component * component).sum::<f64>().sqrt()
}
