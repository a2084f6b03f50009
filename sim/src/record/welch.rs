//! [`Welch`]: mean square of a signal in a band of frequencies, in bounded memory: the mean over
//! segments that overlap by half, each with its mean removed and multiplied by Hann's window.
//!
//! A line of the spectrum is widened by the window to two bins on either side; one that is nearer
//! to an end of the band is counted in part. A segment has at least sixteen bins in the band, so
//! that is an eighth of it, as far as the length of the record and 2^20 samples a segment allow.

use crate::spectra::segment::Segment;
use crate::spectra::{Detrend, Window};

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
    /// Made with the first segment.
    segment: Option<Segment>,
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

    /// The mean square; none of fewer than sixteen samples.
    pub(crate) fn mean_square(&self) -> Option<f64> {
        if self.segments > 0.0 {
            return Some(self.sum / self.segments);
        }
        let enough = self.samples.len() >= SHORTEST;
        enough.then(|| {
            let mut segment = of_length(self.samples.len());
            mean_square(&mut segment, &self.samples, self.band, self.rate)
        })
    }
}

/// Hann's window, the mean removed.
fn of_length(length: usize) -> Segment {
    Segment::new(length, Window::Hann, Detrend::Mean)
}

/// The mean square of one segment in a band; NaN, which meets no limit, where there is none.
fn mean_square(segment: &mut Segment, samples: &[f64], band: [f64; 2], rate: f64) -> f64 {
    segment.mean_square(samples, band, rate).unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use realfft::RealFftPlanner;

    use super::*;
    use crate::spectra::synthetic::Random;

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

    /// The sum over bins, written out: Hann's window, the mean removed, both halves of the spectrum.
    fn written_out(samples: &[f64], [from, to]: [f64; 2], rate: f64) -> f64 {
        let float = |n: usize| f64::from(u32::try_from(n).expect("short"));
        let length = float(samples.len());
        let mean = samples.iter().sum::<f64>() / length;
        let window =
            |i: usize| 0.5 - 0.5 * precess_dynamics::Angle::sin_cos(TAU * float(i) / length).1;
        let mut segment: Vec<f64> =
            samples.iter().enumerate().map(|(i, sample)| (sample - mean) * window(i)).collect();
        let transform = RealFftPlanner::new().plan_fft_forward(samples.len());
        let mut spectrum = transform.make_output_vec();
        transform.process(&mut segment, &mut spectrum).expect("a transform");
        let squares: f64 = (0..samples.len()).map(|i| window(i) * window(i)).sum();
        let in_band = spectrum.iter().enumerate().filter(|(bin, _)| {
            let frequency = float(*bin) * (rate / length);
            from <= frequency && frequency <= to
        });
        let twice = |bin: usize| if bin == 0 || 2 * bin == samples.len() { 1.0 } else { 2.0 };
        in_band.map(|(bin, value)| twice(bin) * value.norm_sqr()).sum::<f64>() / (length * squares)
    }

    #[test]
    fn segments_are_bit_identical_to_the_sum_written_out() {
        let samples = Random::new(7).first_order(1000, 1.0, 9.0);
        for (count, band) in [(1000, [4.0, 20.0]), (333, [0.0, 50.0]), (17, [1.0, 50.0])] {
            let mut welch = Welch::new(band, 100.0, 1e9);
            // One segment: as long as the record where that is shorter than sixteen bins.
            let used = count.min(welch.length);
            samples[..used].iter().for_each(|sample| welch.add(*sample));
            let expected = written_out(&samples[..used], band, 100.0);
            assert_eq!(welch.mean_square().map(f64::to_bits), Some(expected.to_bits()));
        }
    }
}
