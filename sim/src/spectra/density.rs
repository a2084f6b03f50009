//! [`psd`]: one-sided power spectral density by Welch's method, its RMS over frequency, and intervals.

use super::confidence::chi_square_factors;
use super::segment::{Segment, sides};
use super::{Metadata, SpectrumError, WelchSettings};

/// A one-sided power spectral density.
#[derive(Clone, Debug, PartialEq)]
pub struct Psd {
    /// How it was computed.
    pub metadata: Metadata,
    /// `G_k`, unit²/Hz, at `k rate / N`, k from 0 to N / 2. Their sum times the resolution is the mean
    /// square of the segments (with a rectangular window exactly, otherwise in the mean).
    pub density: Vec<f64>,
}

/// One-sided power spectral density of a signal at a rate, 1/s, by Welch's method:
/// `G_k = c_k / (K rate sum w^2) sum_s |X_k,s|^2` over K segments, `c_k` two but at zero and half the rate.
///
/// Source: P. D. Welch, IEEE Trans. Audio Electroacoust. 15(2), 1967.
///
/// # Errors
///
/// Rate, segment, overlap, or a sample that is not finite.
pub fn psd(samples: &[f64], rate: f64, settings: &WelchSettings) -> Result<Psd, SpectrumError> {
    let metadata = Metadata::new(*settings, rate, samples.len())?;
    check_samples(0, samples)?;
    let mut segment = Segment::new(settings.length, settings.window, settings.detrend);
    let mut density = vec![0.0; metadata.bins()];
    for start in settings.starts(samples.len()) {
        let part = samples.get(start..start + settings.length).unwrap_or_default();
        let spectrum = segment.transform(part)?;
        density.iter_mut().zip(spectrum).for_each(|(sum, x)| *sum += x.norm_sqr());
    }
    let scale = super::float(metadata.segments) * rate * segment.squares();
    for (bin, value) in density.iter_mut().enumerate() {
        *value *= sides(bin, settings.length) / scale;
    }
    finite(&density)?;
    Ok(Psd { metadata, density })
}

/// Rejects the first sample of a signal that is not finite.
pub(super) fn check_samples(signal: usize, samples: &[f64]) -> Result<(), SpectrumError> {
    let wrong = samples.iter().enumerate().find(|(_, value)| !value.is_finite());
    wrong.map_or(Ok(()), |(index, value)| {
        Err(SpectrumError::Sample { signal, index, value: *value })
    })
}

/// Rejects squares that overflow.
pub(super) fn finite(values: &[f64]) -> Result<(), SpectrumError> {
    check_samples(0, values)
}

impl Psd {
    /// Frequency and density of each bin, Hz and unit²/Hz.
    pub fn iter(&self) -> impl Iterator<Item = (f64, f64)> {
        self.density.iter().enumerate().map(|(bin, value)| (self.metadata.frequency(bin), *value))
    }

    /// Mean square over all frequencies, unit².
    #[must_use]
    pub fn mean_square(&self) -> f64 {
        self.density.iter().sum::<f64>() * self.metadata.resolution
    }

    /// RMS in a band, Hz, unit: the mean square of each bin is spread evenly over its width, one resolution, and
    /// counts by the share of it that lies in the band. Squares of neighbouring bands add up.
    ///
    /// # Errors
    ///
    /// A band that is not rising within 0 Hz and half the rate.
    pub fn band_rms(&self, band: [f64; 2]) -> Result<f64, SpectrumError> {
        self.metadata.check_band(band)?;
        let squares = self.cells().map(|([from, to], square)| {
            let inside = to.min(band[1]) - from.max(band[0]);
            square * (inside / (to - from)).clamp(0.0, 1.0)
        });
        Ok(squares.sum::<f64>().sqrt())
    }

    /// The bins as bands, Hz, with their mean squares. Those at zero and half the rate of an even length are half as wide.
    pub(crate) fn cells(&self) -> impl Iterator<Item = ([f64; 2], f64)> {
        let resolution = self.metadata.resolution;
        let half = 0.5 * self.metadata.rate;
        self.iter().map(move |(frequency, density)| {
            let from = (frequency - 0.5 * resolution).max(0.0);
            ([from, (frequency + 0.5 * resolution).min(half)], density * resolution)
        })
    }

    /// RMS of all bins from zero to each one, unit: the last is the RMS of the signal.
    #[must_use]
    pub fn cumulative_rms_forward(&self) -> Vec<f64> {
        running(self.density.iter(), self.metadata.resolution)
    }

    /// RMS of all bins from each one to half the rate, unit: the first is the RMS of the signal.
    #[must_use]
    pub fn cumulative_rms_backward(&self) -> Vec<f64> {
        let mut rms = running(self.density.iter().rev(), self.metadata.resolution);
        rms.reverse();
        rms
    }

    /// Factors by which a bin's density is multiplied for the ends of the interval that contains the density of
    /// a Gaussian signal with probability `level`: `nu / chi2_nu(1/2 ± level/2)` with `nu` twice the
    /// equivalent number of averages, and once at zero and half the rate (Bendat and Piersol, 8.5.1).
    ///
    /// # Errors
    ///
    /// A level that is not above zero and at most 0.9999.
    pub fn interval(&self, bin: usize, level: f64) -> Result<[f64; 2], SpectrumError> {
        let twice = if self.metadata.is_end(bin) { 1.0 } else { 2.0 };
        chi_square_factors(twice * self.metadata.averages, level)
    }
}

/// Roots of the running sums, times a resolution.
fn running<'a>(values: impl Iterator<Item = &'a f64>, resolution: f64) -> Vec<f64> {
    let sums = values.scan(0.0, |sum, value| {
        *sum += value;
        Some(*sum)
    });
    sums.map(|sum: f64| (sum * resolution).sqrt()).collect()
}
