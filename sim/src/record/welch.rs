//! [`Welch`]: mean square of a signal in a band of frequencies, in bounded memory: the mean over
//! segments that overlap by half, each with its mean removed and multiplied by Hann's window.
//!
//! A line of the spectrum is widened by the window to two bins on either side; one that is nearer
//! to an end of the band is counted in part. A segment has at least sixteen bins in the band, so
//! that is an eighth of it, as far as the length of the record and 2^20 samples a segment allow.

use std::f64::consts::TAU;
use std::sync::Arc;

use realfft::num_complex::Complex;
use realfft::{RealFftPlanner, RealToComplex};

/// Bins in the band, unless the record is too short.
const BINS: f64 = 16.0;
/// Samples of a segment at least and at most.
const SHORTEST: usize = 16;
const LONGEST: u32 = 1 << 20;

/// The mean square in a band, of samples that come one by one.
pub(crate) struct Welch {
    band: [f64; 2],
    rate: f64,
    length: usize,
    samples: Vec<f64>,
    /// Sum over segments of the mean squares.
    sum: f64,
    segments: f64,
}

impl Welch {
    /// For a band, Hz, of samples at a rate, 1/s, of which about `count` are expected.
    pub(crate) fn new(band: [f64; 2], rate: f64, count: f64) -> Self {
        let [from, to] = band;
        let wanted = (BINS * rate / (to - from)).min(f64::from(LONGEST)).min(count);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "within LONGEST"
        )]
        let length = (wanted.max(0.0) as usize).max(SHORTEST).next_multiple_of(2);
        Self { band, rate, length, samples: Vec::new(), sum: 0.0, segments: 0.0 }
    }

    pub(crate) fn add(&mut self, sample: f64) {
        self.samples.push(sample);
        if self.samples.len() == self.length {
            self.sum += mean_square(&self.samples, self.band, self.rate);
            self.segments += 1.0;
            self.samples.drain(..self.length / 2);
        }
    }

    /// The mean square; none of fewer than sixteen samples.
    pub(crate) fn mean_square(&self) -> Option<f64> {
        if self.segments > 0.0 {
            return Some(self.sum / self.segments);
        }
        let enough = self.samples.len() >= SHORTEST;
        enough.then(|| mean_square(&self.samples, self.band, self.rate))
    }
}

/// The mean square of one segment in a band.
fn mean_square(samples: &[f64], [from, to]: [f64; 2], rate: f64) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "at most LONGEST")]
    let (length, float) = (samples.len(), |n: usize| n as f64);
    let mean = samples.iter().sum::<f64>() / float(length);
    let window =
        |i: usize| 0.5 - 0.5 * precess_dynamics::Angle::sin_cos(TAU * float(i) / float(length)).1;
    let mut segment: Vec<f64> =
        samples.iter().enumerate().map(|(i, sample)| (sample - mean) * window(i)).collect();
    let transform: Arc<dyn RealToComplex<f64>> = RealFftPlanner::new().plan_fft_forward(length);
    let mut spectrum: Vec<Complex<f64>> = transform.make_output_vec();
    if transform.process(&mut segment, &mut spectrum).is_err() {
        return f64::NAN;
    }
    let squares: f64 = (0..length).map(|i| window(i) * window(i)).sum();
    let resolution = rate / float(length);
    let in_band = spectrum.iter().enumerate().filter(|(bin, _)| {
        let frequency = float(*bin) * resolution;
        from <= frequency && frequency <= to
    });
    in_band
        .map(|(bin, value)| {
            // Both halves of the spectrum, but for the bins that are their own mirror image.
            let twice = if bin == 0 || 2 * bin == length { 1.0 } else { 2.0 };
            twice * value.norm_sqr()
        })
        .sum::<f64>()
        / (float(length) * squares)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The window's sidelobes outside the band, and the ends of segments.
    const LEAKAGE: f64 = 1e-3;

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

    #[test]
    fn a_short_record_is_one_segment() {
        let mut welch = Welch::new([1.0, 40.0], 100.0, 1e9);
        (0..100).for_each(|i| welch.add((TAU * 0.1 * f64::from(i)).sin()));
        let found = welch.mean_square().expect("enough samples");
        assert!((found / 0.5 - 1.0).abs() < 0.05, "{found}");
        assert_eq!(Welch::new([1.0, 40.0], 100.0, 10.0).mean_square(), None);
    }
}
