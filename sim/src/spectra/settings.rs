//! [`WelchSettings`] and [`Metadata`]: how a spectrum is to be computed, and how it was.

use super::confidence::equivalent_averages;
use super::{SpectrumError, Window, float};

/// Samples of a segment, at least and at most.
pub(crate) const LENGTHS: [usize; 2] = [4, 1 << 22];

/// Segments begin at most this many times in the length of one.
const HOPS_MAX: usize = 64;

/// What is subtracted from each segment before it is multiplied by the window.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Detrend {
    /// Nothing.
    None,
    /// Its mean.
    #[default]
    Mean,
    /// Its least-squares straight line.
    Linear,
}

impl Detrend {
    /// The name in files and options.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Mean => "mean",
            Self::Linear => "linear",
        }
    }
}

/// Segments of Welch's method.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WelchSettings {
    /// What a segment is multiplied by.
    pub window: Window,
    /// Samples of a segment.
    pub length: usize,
    /// Samples that two neighbouring segments share.
    pub overlap: usize,
    /// What is subtracted from each segment.
    pub detrend: Detrend,
}

/// How a spectrum was computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Metadata {
    /// The settings.
    pub settings: WelchSettings,
    /// Samples per second, 1/s.
    pub rate: f64,
    /// Samples of the record.
    pub samples: usize,
    /// Segments that were averaged.
    pub segments: usize,
    /// Samples at the end that no segment contains.
    pub unused: usize,
    /// Distance of two frequencies, rate / length, Hz.
    pub resolution: f64,
    /// Equivalent noise bandwidth `rate sum w^2 / (sum w)^2`, Hz: mean square of a line by its peak density.
    pub noise_bandwidth: f64,
    /// Number of independent segments with the same variance of the estimate; at most `segments`.
    pub averages: f64,
}

impl WelchSettings {
    /// Hann's window, half overlap, means removed: for densities.
    #[must_use]
    pub const fn hann(length: usize) -> Self {
        Self { window: Window::Hann, length, overlap: length / 2, detrend: Detrend::Mean }
    }

    /// Rectangular window without overlap, nothing removed: Parseval's theorem holds exactly.
    #[must_use]
    pub const fn rectangular(length: usize) -> Self {
        Self { window: Window::Rectangular, length, overlap: 0, detrend: Detrend::None }
    }

    /// Starts of the segments of a record.
    pub(super) fn starts(self, samples: usize) -> impl Iterator<Item = usize> + use<> {
        let hop = self.length.saturating_sub(self.overlap).max(1);
        let count = samples.checked_sub(self.length).map_or(0, |rest| rest / hop + 1);
        (0..count).map(move |segment| segment * hop)
    }
}

impl Metadata {
    /// Of a record, once its settings have been checked.
    pub(super) fn new(
        settings: WelchSettings,
        rate: f64,
        samples: usize,
    ) -> Result<Self, SpectrumError> {
        if !(rate.is_finite() && rate > 0.0) {
            return Err(SpectrumError::Rate(rate));
        }
        let WelchSettings { length, overlap, .. } = settings;
        let [least, most] = LENGTHS;
        let bounds = [least, most.min(samples)];
        if !(least..=bounds[1]).contains(&length) {
            return Err(SpectrumError::Segment { length, bounds });
        }
        if overlap >= length || (length - overlap).saturating_mul(HOPS_MAX) < length {
            return Err(SpectrumError::Overlap { overlap, length });
        }
        let (mut segments, mut end) = (0, 0);
        for start in settings.starts(samples) {
            segments += 1;
            end = start + length;
        }
        let weights = settings.window.weights(length);
        let (sum, squares) =
            (weights.iter().sum::<f64>(), weights.iter().map(|w| w * w).sum::<f64>());
        Ok(Self {
            settings,
            rate,
            samples,
            segments,
            unused: samples - end,
            resolution: rate / float(length),
            noise_bandwidth: rate * squares / (sum * sum),
            averages: equivalent_averages(&weights, length - overlap, segments),
        })
    }

    /// How many frequencies there are, from zero to half the rate: N / 2 + 1.
    #[must_use]
    pub const fn bins(&self) -> usize {
        self.settings.length / 2 + 1
    }

    /// Frequency of a bin, Hz.
    #[must_use]
    pub fn frequency(&self, bin: usize) -> f64 {
        float(bin) * self.resolution
    }

    /// Whether a bin is its own mirror image: at zero, and at half the rate of an even length.
    #[must_use]
    pub const fn is_end(&self, bin: usize) -> bool {
        bin == 0 || 2 * bin == self.settings.length
    }

    /// Rejects a band, Hz, that is not rising within 0 Hz and half the rate.
    pub(crate) fn check_band(&self, band: [f64; 2]) -> Result<(), SpectrumError> {
        let highest = 0.5 * self.rate;
        let [from, to] = band;
        if 0.0 <= from && from < to && to <= highest {
            return Ok(());
        }
        Err(SpectrumError::Band { band, highest })
    }
}
