//! [`amplitude_spectrum`]: amplitudes over frequency, right at lines; and the strongest lines.
//!
//! A density tells nothing about the amplitude of a line, whose peak grows with the length of a segment. Here the
//! transform is divided by the sum of the window's weights (its coherent gain times N), so that the peak of a line
//! on a bin is its amplitude (Heinzel, Rüdiger, Schilling, 2002, section 9).

use std::f64::consts::PI;

use super::density::{check_samples, finite};
use super::segment::{Segment, sides};
use super::{Metadata, SpectrumError, WelchSettings, Window, float};

/// Bins on either side whose median is the floor about a line.
const FLOOR_BINS: usize = 32;
/// A line is this much above the floor: 12 dB.
const ABOVE_FLOOR: f64 = 4.0;
/// A peak is a sidelobe unless it is this much above what a stronger line leaks there.
const ABOVE_LEAKAGE: f64 = 2.0;

/// Amplitudes over frequency.
#[derive(Clone, Debug, PartialEq)]
pub struct AmplitudeSpectrum {
    /// How it was computed.
    pub metadata: Metadata,
    /// Amplitude of a steady line at each bin, unit: `c_k / sum w` times the RMS of `|X_k|` over segments.
    pub amplitude: Vec<f64>,
}

/// A line of a spectrum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// Hz, between bins.
    pub frequency: f64,
    /// Amplitude (not RMS), unit.
    pub amplitude: f64,
    /// The bin of its peak.
    pub bin: usize,
    /// Its peak by the median of the bins about it; infinite where that is zero.
    pub above_floor: f64,
}

/// Amplitudes of a signal at a rate, 1/s.
///
/// # Errors
///
/// As of [`psd`](super::psd).
pub fn amplitude_spectrum(
    samples: &[f64],
    rate: f64,
    settings: &WelchSettings,
) -> Result<AmplitudeSpectrum, SpectrumError> {
    let metadata = Metadata::new(*settings, rate, samples.len())?;
    check_samples(0, samples)?;
    let mut segment = Segment::new(settings.length, settings.window, settings.detrend);
    let mut amplitude = vec![0.0; metadata.bins()];
    for start in settings.starts(samples.len()) {
        let part = samples.get(start..start + settings.length).unwrap_or_default();
        let spectrum = segment.transform(part)?;
        amplitude.iter_mut().zip(spectrum).for_each(|(sum, x)| *sum += x.norm_sqr());
    }
    for (bin, value) in amplitude.iter_mut().enumerate() {
        *value = sides(bin, settings.length) * (*value / float(metadata.segments)).sqrt()
            / segment.sum();
    }
    finite(&amplitude)?;
    Ok(AmplitudeSpectrum { metadata, amplitude })
}

impl AmplitudeSpectrum {
    /// The strongest lines, at most `count`, the strongest first: peaks that are 12 dB above the median of the bins
    /// about them, that are no sidelobes of stronger lines, and that have as many periods in a segment as half the
    /// window's main lobe has bins: what is slower is not distinguished from a drift. Frequency and amplitude are those of a single line
    /// between bins: by the ratio of the two highest bins (rectangular, Hann), by the centroid of the squares
    /// (flat-top, whose peak is the amplitude).
    #[must_use]
    pub fn strongest(&self, count: usize) -> Vec<Line> {
        let value = |bin: usize| self.amplitude.get(bin).copied().unwrap_or(0.0);
        let window = self.metadata.settings.window;
        let mut peaks: Vec<usize> = (window.half_width()..self.amplitude.len().saturating_sub(1))
            .filter(|&bin| value(bin) > value(bin - 1) && value(bin) >= value(bin + 1))
            .collect();
        peaks.sort_by(|a, b| value(*b).total_cmp(&value(*a)).then(a.cmp(b)));
        let mut lines: Vec<Line> = Vec::new();
        for bin in peaks {
            if lines.len() >= count {
                break;
            }
            let is_leakage = |line: &Line| {
                let distance = (line.frequency / self.metadata.resolution - float(bin)).abs();
                value(bin) <= ABOVE_LEAKAGE * line.amplitude * leakage(window, distance)
            };
            let above_floor = value(bin) / self.floor(bin);
            if above_floor >= ABOVE_FLOOR && !lines.iter().any(is_leakage) {
                lines.push(self.line(bin, above_floor));
            }
        }
        lines
    }

    /// Median of the bins about a bin, its main lobe left out.
    fn floor(&self, bin: usize) -> f64 {
        let half = self.metadata.settings.window.half_width();
        let first = bin.saturating_sub(FLOOR_BINS + half);
        let about = self.amplitude.iter().enumerate().skip(first).take(2 * (FLOOR_BINS + half) + 1);
        let mut about: Vec<f64> = about
            .filter(|(other, _)| other.abs_diff(bin) >= half)
            .map(|(_, value)| *value)
            .collect();
        about.sort_by(f64::total_cmp);
        about.get(about.len() / 2).copied().unwrap_or(0.0)
    }

    fn line(&self, bin: usize, above_floor: f64) -> Line {
        let value = |bin: usize| self.amplitude.get(bin).copied().unwrap_or(0.0);
        let [before, peak, after] = [value(bin - 1), value(bin), value(bin + 1)];
        let side = if after >= before { 1.0 } else { -1.0 };
        let ratio = before.max(after) / peak;
        let (offset, gain) = match self.metadata.settings.window {
            Window::Rectangular => {
                let d = (ratio / (1.0 + ratio)).clamp(0.0, 0.5);
                (side * d, sinc(PI * d))
            }
            Window::Hann => {
                let d = ((2.0 * ratio - 1.0) / (1.0 + ratio)).clamp(0.0, 0.5);
                (side * d, sinc(PI * d) / (1.0 - d * d))
            }
            Window::FlatTop => {
                let half = Window::FlatTop.half_width().min(bin);
                let about = (bin - half..=bin + half).map(|k| (float(k), value(k) * value(k)));
                let (moment, sum) = about.fold((0.0, 0.0), |(m, s), (k, v)| (m + k * v, s + v));
                (moment / sum - float(bin), 1.0)
            }
        };
        let frequency = (float(bin) + offset) * self.metadata.resolution;
        Line { frequency, amplitude: peak / gain, bin, above_floor }
    }
}

/// Bound of a window's response to a line some bins away, by that on it. Hann's is `sinc d / (1 - d^2)`.
fn leakage(window: Window, distance: f64) -> f64 {
    let d = distance;
    match window {
        _ if d < 1.0 => 1.0,
        Window::Rectangular => 1.0 / (PI * d),
        Window::Hann if d >= 1.5 => 1.0 / (PI * d * (d * d - 1.0)),
        Window::FlatTop if d >= 4.5 => 1e-4,
        Window::Hann | Window::FlatTop => 1.0,
    }
}

/// `sin(u) / u`.
fn sinc(u: f64) -> f64 {
    if u == 0.0 { 1.0 } else { precess_dynamics::Angle::sin_cos(u).0 / u }
}
