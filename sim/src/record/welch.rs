//! [`Welch`]: mean square of a signal in a band of frequencies, in bounded memory: the mean over
//! segments that overlap by half, each with its mean removed and multiplied by Hann's window.
//!
//! A window widens a line to several bins. The power of each bin is therefore counted at the frequency that the
//! bin has by the transforms by the window and by its derivative (reassignment: F. Auger, P. Flandrin, IEEE Trans.
//! Signal Process. 43(5), 1995). Of the transform R of a segment of N samples without a window, with `u = pi / N`,
//!
//! ```text
//! X_k = R_k / 2 - (R_k-1 + R_k+1) / 4                              by Hann's window
//! f_k = k + atan(tan u Re((R_k-1 - R_k+1) / X_k) / 4) / u          bins
//! ```
//!
//! All bins of a line that is four bins from others have its own frequency, so a line is inside of the band or
//! outside, never in part. Every bin is counted once: a band from zero to half the rate has the mean square of the
//! segments. A segment is a quarter of the record, or longer, so that it has 32 bins in the band and 32 below it, as far
//! as the length of the record and 2^20 samples a segment allow: a band from zero has the whole record.

use std::f64::consts::PI;

use realfft::num_complex::Complex;

use crate::spectra::segment::{Segment, sides};
use crate::spectra::{Detrend, Window, float};

/// Bins in the band, and below it, unless the record is too short.
const BINS: f64 = 32.0;
/// A segment has this share of the record at least.
const SHARE: f64 = 0.25;
/// Samples of a segment at least and at most.
pub(crate) const SHORTEST: usize = 16;
const LONGEST: u32 = 1 << 20;
/// A line this near to an end of the band, in bins, lies on it, which is within the band.
const ON_EDGE: f64 = 0.01;
/// The same of a bin: its frequency is rounded.
const ROUNDING: f64 = 1e-9;

/// The mean square in a band, of samples that come one by one.
pub(crate) struct Welch {
    band: [f64; 2],
    rate: f64,
    length: usize,
    samples: Vec<f64>,
    /// Made with the first segment.
    segment: Option<Segment>,
    /// Sum over segments of the mean squares.
    sum: f64,
    segments: f64,
}

impl Welch {
    /// For a band, Hz, of samples at a rate, 1/s, of which about `count` are expected.
    pub(crate) fn new(band: [f64; 2], rate: f64, count: f64) -> Self {
        let length = segment_length(band, rate, count);
        Self { band, rate, length, samples: Vec::new(), segment: None, sum: 0.0, segments: 0.0 }
    }

    pub(crate) fn add(&mut self, sample: f64) {
        self.samples.push(sample);
        if self.samples.len() == self.length {
            let segment = self.segment.get_or_insert_with(|| of_length(self.length));
            self.sum += mean_square(segment, &self.samples, self.band, self.rate);
            self.segments += 1.0;
            self.samples.drain(..self.length / 2);
        }
    }

    /// The mean square; none of fewer than sixteen samples, or of a band without a frequency of the spectrum.
    pub(crate) fn mean_square(&self) -> Option<f64> {
        let whole = self.segments > 0.0;
        let length = if whole { self.length } else { self.samples.len() };
        if length < SHORTEST || empty_band(self.band, self.rate, length).is_some() {
            return None;
        }
        Some(if whole {
            self.sum / self.segments
        } else {
            mean_square(&mut of_length(length), &self.samples, self.band, self.rate)
        })
    }
}

/// Samples of a segment for a band, Hz, of samples at a rate, 1/s, of which about `count` are expected.
fn segment_length([from, to]: [f64; 2], rate: f64, count: f64) -> usize {
    let narrowest = (to - from).min(from);
    let resolved = if narrowest > 0.0 { BINS * rate / narrowest } else { count };
    let wanted = resolved.max(SHARE * count).min(f64::from(LONGEST)).min(count);
    let wanted = wanted.max(float(SHORTEST));
    // As long as their number allows: no sample is left at the end.
    let segments = (2.0 * count / wanted - 1.0).floor().max(1.0);
    let length = (2.0 * count / (segments + 1.0)).min(f64::from(LONGEST));
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "within LONGEST")]
    let pairs = (0.5 * length.max(0.0)) as usize;
    (2 * pairs).max(SHORTEST)
}

/// Distance of the frequencies of a spectrum of so many samples at a rate, 1/s, where none of them above zero is within
/// a band, Hz; none where one is.
fn empty_band(band: [f64; 2], rate: f64, samples: usize) -> Option<f64> {
    let resolution = rate / float(samples);
    let [from, to] = band.map(|end| end / resolution);
    let first = (from - ROUNDING).ceil().max(1.0);
    (first > to + ROUNDING).then_some(resolution)
}

/// The same of a record of so many samples, of which `count` are expected, in the segments that [`Welch`] makes of it.
pub(crate) fn expected_empty_band(
    band: [f64; 2],
    rate: f64,
    count: f64,
    samples: usize,
) -> Option<f64> {
    empty_band(band, rate, segment_length(band, rate, count).min(samples))
}

/// Of a record of samples at a rate, 1/s, as [`Welch`] has them: the mean square in a band, Hz, and half its derivatives along
/// other records of the same length, with each bin at its frequency.
pub(crate) fn band_derivatives(
    (band, rate, count): ([f64; 2], f64, f64),
    record: &[f64],
    directions: &[Vec<f64>],
) -> Option<(f64, Vec<f64>)> {
    let length = segment_length(band, rate, count).min(record.len());
    if length < SHORTEST || empty_band(band, rate, length).is_some() {
        return None;
    }
    let mut segment = of_length(length);
    let (mut square, mut by) = (0.0, vec![0.0; directions.len()]);
    let (mut start, mut segments) = (0, 0.0);
    while let Some(samples) = record.get(start..start + length) {
        let bins = Bins::new(segment.transform(samples).ok()?, length);
        square += bins.product(&bins, band, rate);
        for (sum, direction) in by.iter_mut().zip(directions) {
            let samples = direction.get(start..start + length)?;
            let along = Bins::new(segment.transform(samples).ok()?, length);
            *sum += bins.product(&along, band, rate);
        }
        segments += 1.0;
        start += (length / 2).max(1);
    }
    let by = by.into_iter().map(|sum| sum / segments);
    Some((square / segments, by.collect()))
}

/// No window, which [`Bins`] applies; the mean removed.
fn of_length(length: usize) -> Segment {
    Segment::new(length, Window::Rectangular, Detrend::Mean)
}

/// The mean square of one segment in a band; NaN, which is no measurement, where there is none.
fn mean_square(segment: &mut Segment, samples: &[f64], band: [f64; 2], rate: f64) -> f64 {
    segment.transform(samples).map_or(f64::NAN, |plain| {
        let bins = Bins::new(plain, samples.len());
        bins.product(&bins, band, rate)
    })
}

/// The bins of a segment by Hann's window.
struct Bins {
    /// Samples of the segment.
    length: usize,
    /// Transform of each bin, and its frequency in bins.
    bins: Vec<(Complex<f64>, f64)>,
}

impl Bins {
    /// Of a transform without a window of so many samples.
    fn new(plain: &[Complex<f64>], length: usize) -> Self {
        let last = plain.len().saturating_sub(1);
        let at = |bin: usize| plain.get(bin).copied().unwrap_or_default();
        // The bin after the last is the mirror image of one before it.
        let beyond = if 2 * last == length { last.saturating_sub(1) } else { last };
        let count = float(length);
        let step = PI / count;
        let (sine, cosine) = precess_dynamics::Angle::sin_cos(step);
        let bin = |bin: usize| {
            let before = if bin == 0 { at(1).conj() } else { at(bin - 1) };
            let after = if bin == last { at(beyond).conj() } else { at(bin + 1) };
            let value = at(bin) * 0.5 - (before + after) * 0.25;
            let square = value.norm_sqr();
            let ratio =
                if square > 0.0 { ((before - after) * value.conj()).re / square } else { 0.0 };
            // Of `libm`: bit-identical on every host.
            let place = float(bin) + libm::atan(0.25 * ratio * sine / cosine) / step;
            // A frequency below zero, or above half the rate, is that of its mirror image.
            (value, 0.5 * count - (0.5 * count - place.abs()).abs())
        };
        Self { length, bins: (0..plain.len()).map(bin).collect() }
    }

    /// The mean product with another segment, over the bins of this one whose frequency is within a band, Hz.
    fn product(&self, other: &Self, band: [f64; 2], rate: f64) -> f64 {
        let count = float(self.length);
        let [from, to] = band.map(|end| end * count / rate);
        let pairs = self.bins.iter().zip(&other.bins).enumerate();
        let within = |place: f64| from - ON_EDGE <= place && place <= to + ON_EDGE;
        let in_band = pairs.filter(|(_, ((_, place), _))| within(*place));
        let sum: f64 = in_band
            .map(|(bin, ((a, _), (b, _)))| sides(bin, self.length) * (a.conj() * b).re)
            .sum();
        // The sum of the squares of Hann's weights is three eighths of their number.
        sum / (0.375 * count * count)
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use realfft::RealFftPlanner;

    use super::*;
    use crate::spectra::synthetic::Random;

    /// Of an amplitude: the mirror image of a line at 10 bins, and the mean of a segment that is no whole number of periods.
    const LEAKAGE: f64 = 1e-3;

    fn of_record(samples: &[f64], band: [f64; 2], rate: f64) -> Option<f64> {
        let mut welch = Welch::new(band, rate, float(samples.len()));
        for sample in samples {
            welch.add(*sample);
        }
        welch.mean_square()
    }

    fn sines(count: u32, rate: f64, lines: &[[f64; 2]]) -> Vec<f64> {
        let at = |i: u32| {
            let time = f64::from(i) / rate;
            lines.iter().map(|[f, a]| a * (TAU * f * time + 0.3).sin()).sum()
        };
        (0..count).map(at).collect()
    }

    #[test]
    fn a_sine_within_the_band_has_half_the_square_of_its_amplitude() {
        let mut within = Welch::new([8.0, 12.0], 200.0, 4000.0);
        let mut outside = Welch::new([20.0, 30.0], 200.0, 4000.0);
        for i in 0..4000 {
            let time = f64::from(i) / 200.0;
            let sample = 7.0 + 3.0 * (TAU * 10.0 * time).sin();
            within.add(sample);
            outside.add(sample);
        }
        let found = within.mean_square().expect("segments");
        assert!((found / 4.5 - 1.0).abs() < LEAKAGE, "{found}");
        assert!(outside.mean_square().expect("segments") < 4.5 * LEAKAGE);
    }

    /// A second of a line 1 Hz below the band: Hann's bins had 41 % of it in the band.
    #[test]
    fn a_line_one_bin_outside_of_the_band_does_not_leak_into_it() {
        for outside in [39.0, 38.6, 81.0, 81.37] {
            let samples = sines(1000, 1000.0, &[[outside, 1.0]]);
            let found = of_record(&samples, [40.0, 80.0], 1000.0).expect("bins").sqrt();
            assert!(found < 1e-4, "{outside} Hz: {found}");
            // Nor hides it what is inside.
            let samples = sines(1000, 1000.0, &[[outside, 1.0], [60.3, 0.01]]);
            let found = of_record(&samples, [40.0, 80.0], 1000.0).expect("bins").sqrt();
            assert!((found / (0.01 * 0.5_f64.sqrt()) - 1.0).abs() < 0.02, "{outside} Hz: {found}");
        }
        // A line on the edge is inside.
        for edge in [40.0, 80.0] {
            let samples = sines(1000, 1000.0, &[[edge, 1.0]]);
            let found = of_record(&samples, [40.0, 80.0], 1000.0).expect("bins");
            assert!((found / 0.5 - 1.0).abs() < LEAKAGE, "{edge} Hz: {found}");
        }
    }

    #[test]
    fn a_band_that_holds_everything_has_the_mean_square_of_the_windowed_segment() {
        let samples = Random::new(3).first_order(100, 1.0, 9.0);
        for count in [100, 99, 16] {
            let samples = &samples[..count];
            let mean = samples.iter().sum::<f64>() / float(count);
            let windowed = samples.iter().enumerate().map(|(i, sample)| {
                let weight = 0.5 - 0.5 * (TAU * float(i) / float(count)).cos();
                (weight * (sample - mean)).powi(2)
            });
            let expected = windowed.sum::<f64>() / (0.375 * float(count));
            let mut welch = Welch::new([0.0, 50.0], 100.0, 1e9);
            welch.length = 1000;
            for sample in samples {
                welch.add(*sample);
            }
            let found = welch.mean_square().expect("a segment");
            assert!((found / expected - 1.0).abs() < 1e-12, "{count}: {found} for {expected}");
        }
    }

    #[test]
    fn a_band_without_a_frequency_of_the_spectrum_has_no_mean_square() {
        let samples = sines(100, 1000.0, &[[50.0, 1.0]]);
        // Frequencies are 10 Hz apart; the mean is removed, so zero is none of them.
        for band in [[10.1, 10.2], [0.0, 9.0], [491.0, 499.0]] {
            assert_eq!(of_record(&samples, band, 1000.0), None, "{band:?}");
            assert!(expected_empty_band(band, 1000.0, 100.0, 100).is_some(), "{band:?}");
        }
        for band in [[10.0, 10.2], [9.0, 11.0], [495.0, 500.0]] {
            assert!(of_record(&samples, band, 1000.0).is_some(), "{band:?}");
            assert_eq!(expected_empty_band(band, 1000.0, 100.0, 100), None, "{band:?}");
        }
    }

    #[test]
    fn a_short_record_is_one_segment() {
        let mut welch = Welch::new([1.0, 40.0], 100.0, 1e9);
        (0..100).for_each(|i| welch.add((TAU * 0.1 * f64::from(i)).sin()));
        let found = welch.mean_square().expect("enough samples");
        assert!((found / 0.5 - 1.0).abs() < 0.05, "{found}");
        assert_eq!(Welch::new([1.0, 40.0], 100.0, 10.0).mean_square(), None);
    }

    /// The definition, written out: Hann's window and its derivative in time, a transform of each.
    fn written_out(samples: &[f64], [from, to]: [f64; 2], rate: f64) -> f64 {
        let length = float(samples.len());
        let mean = samples.iter().sum::<f64>() / length;
        let transformed = |weight: &dyn Fn(f64) -> f64| {
            let angle = |i: usize| TAU * float(i) / length;
            let mut segment: Vec<f64> =
                samples.iter().enumerate().map(|(i, x)| (x - mean) * weight(angle(i))).collect();
            let transform = RealFftPlanner::new().plan_fft_forward(samples.len());
            let mut spectrum = transform.make_output_vec();
            transform.process(&mut segment, &mut spectrum).expect("a transform");
            spectrum
        };
        let hann = transformed(&|angle| 0.5 - 0.5 * angle.cos());
        let slope = transformed(&|angle| 0.5 * angle.sin());
        let mut sum = 0.0;
        for (bin, (value, slope)) in hann.iter().zip(&slope).enumerate() {
            // Bins are TAU / N apart, and the derivative is by the angle.
            let place = (float(bin) - (slope / value).im).abs();
            let place = if place > 0.5 * length { length - place } else { place };
            if (from..=to).contains(&(place * rate / length)) {
                let twice = if bin == 0 || 2 * bin == samples.len() { 1.0 } else { 2.0 };
                sum += twice * value.norm_sqr();
            }
        }
        sum / (0.375 * length * length)
    }

    /// The derivative of a sampled window is that of the window but for `(pi k / N)^2` of the distance k.
    #[test]
    fn segments_have_the_power_of_the_definition_written_out() {
        let samples = Random::new(7).first_order(1000, 1.0, 9.0);
        for (count, band) in [(1000, [4.0, 20.0]), (333, [0.0, 50.0]), (400, [1.0, 30.0])] {
            let mut welch = Welch::new(band, 100.0, 1e9);
            // One segment: as long as the record where that is shorter than sixteen bins.
            let used = count.min(welch.length);
            samples[..used].iter().for_each(|sample| welch.add(*sample));
            let expected = written_out(&samples[..used], band, 100.0);
            let found = welch.mean_square().expect("a segment");
            assert!((found / expected - 1.0).abs() < 0.02, "{found} for {expected}");
        }
    }

    #[test]
    fn derivatives_are_those_of_the_mean_square() {
        let samples = Random::new(5).first_order(600, 1.0, 9.0);
        let direction = sines(600, 100.0, &[[11.0, 1e-4], [30.0, 1e-4]]);
        let of = |factor: f64| -> f64 {
            let moved: Vec<f64> =
                samples.iter().zip(&direction).map(|(x, d)| x + factor * d).collect();
            of_record(&moved, [8.0, 20.0], 100.0).expect("bins")
        };
        let settings = ([8.0, 20.0], 100.0, 600.0);
        let (square, by) =
            band_derivatives(settings, &samples, std::slice::from_ref(&direction)).expect("bins");
        assert_eq!(square.to_bits(), of(0.0).to_bits());
        let difference = (of(1.0) - of(-1.0)) / 4.0;
        // No bin crosses the ends of the band by such a step.
        assert!((by[0] / difference - 1.0).abs() < 1e-6, "{} for {difference}", by[0]);
    }
}
