//! [`Segment`]: one segment of Welch's method: trend removed, multiplied by the window, transformed.

use std::sync::Arc;

use realfft::num_complex::Complex;
use realfft::{RealFftPlanner, RealToComplex};

use super::{Detrend, SpectrumError, Window, float};

/// The transform of segments of one length, with its storage.
pub(crate) struct Segment {
    weights: Vec<f64>,
    /// Sum of the weights' squares.
    squares: f64,
    /// Sum of the weights.
    sum: f64,
    detrend: Detrend,
    plan: Arc<dyn RealToComplex<f64>>,
    work: Vec<f64>,
    scratch: Vec<Complex<f64>>,
    spectrum: Vec<Complex<f64>>,
}

impl Segment {
    pub(crate) fn new(length: usize, window: Window, detrend: Detrend) -> Self {
        let plan = RealFftPlanner::new().plan_fft_forward(length);
        let weights = window.weights(length);
        Self {
            squares: weights.iter().map(|w| w * w).sum(),
            sum: weights.iter().sum(),
            work: Vec::with_capacity(length),
            scratch: plan.make_scratch_vec(),
            spectrum: plan.make_output_vec(),
            weights,
            detrend,
            plan,
        }
    }

    /// Sum of the weights' squares.
    pub(super) fn squares(&self) -> f64 {
        self.squares
    }

    /// Sum of the weights.
    pub(super) fn sum(&self) -> f64 {
        self.sum
    }

    /// The transform `X_k = sum_i w_i x_i exp(-2 pi j i k / N)`, k from 0 to N / 2, of N samples.
    pub(crate) fn transform(&mut self, samples: &[f64]) -> Result<&[Complex<f64>], SpectrumError> {
        let length = samples.len();
        self.work.clear();
        match self.detrend {
            Detrend::None => self.work.extend_from_slice(samples),
            Detrend::Mean => {
                let mean = samples.iter().sum::<f64>() / float(length);
                self.work.extend(samples.iter().map(|sample| sample - mean));
            }
            Detrend::Linear => {
                let (mean, slope) = line(samples);
                let line = (0..length).map(|i| mean + slope * centred(i, length));
                self.work.extend(samples.iter().zip(line).map(|(sample, line)| sample - line));
            }
        }
        self.work.iter_mut().zip(&self.weights).for_each(|(sample, weight)| *sample *= weight);
        self.plan
            .process_with_scratch(&mut self.work, &mut self.spectrum, &mut self.scratch)
            .map_err(|_| SpectrumError::Transform { length })?;
        Ok(&self.spectrum)
    }
}

/// Two, for both halves of the spectrum, but one for the bins that are their own mirror image.
pub(crate) fn sides(bin: usize, length: usize) -> f64 {
    if bin == 0 || 2 * bin == length { 1.0 } else { 2.0 }
}

/// The place of a sample from the middle of N, in samples.
pub(crate) fn centred(index: usize, length: usize) -> f64 {
    float(index) - 0.5 * (float(length) - 1.0)
}

/// Mean and slope per sample of the least-squares line through samples; no slope of one sample.
pub(crate) fn line(samples: &[f64]) -> (f64, f64) {
    let length = samples.len();
    let n = float(length);
    let mean = samples.iter().sum::<f64>() / n;
    let moment: f64 =
        samples.iter().enumerate().map(|(i, sample)| centred(i, length) * (sample - mean)).sum();
    // sum of centred(i)^2 = n (n^2 - 1) / 12.
    let slope = if length > 1 { 12.0 * moment / (n * (n * n - 1.0)) } else { 0.0 };
    (mean, slope)
}
