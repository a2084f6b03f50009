//! [`Exposure`]: displacement, smear and jitter of exposures, from a density, from lines and from a history.

use super::weights::ExposureWeights;
use super::{PointingError, samples_of};
use crate::spectra::segment::{centred, line};
use crate::spectra::{Psd, float};

/// Parts of a bin or an interval of a table, for each inverse exposure that it is wide, and at most.
const PARTS: [f64; 2] = [8.0, 256.0];
/// Fewest samples of an exposure: a straight line leaves nothing of two.
pub(crate) const EXPOSURE_SAMPLES_MIN: usize = 3;

/// Displacement, smear and jitter, each the root of a mean square over exposures, in the unit of the signal.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Exposure {
    /// RMS of the mean over an exposure.
    pub displacement: f64,
    /// RMS within and over exposures of the straight line through the motion, its mean left out.
    pub smear: f64,
    /// RMS within and over exposures of the rest.
    pub jitter: f64,
}

/// Exposures of a history.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExposureHistory {
    /// Over all exposures.
    pub rms: Exposure,
    /// The largest of each in a single exposure.
    pub worst: Exposure,
    /// Exposures.
    pub count: usize,
    /// Samples of an exposure.
    pub samples: usize,
}

impl Exposure {
    fn of_squares([displacement, smear, jitter]: [f64; 3]) -> Self {
        Self { displacement: displacement.sqrt(), smear: smear.sqrt(), jitter: jitter.sqrt() }
    }

    /// RMS of the smear's length from start to end of an exposure, unit: `sqrt 12` times the smear.
    #[must_use]
    pub fn smear_length(&self) -> f64 {
        12.0_f64.sqrt() * self.smear
    }

    /// RMS of the whole motion, unit.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.displacement.hypot(self.smear).hypot(self.jitter)
    }

    /// With that of an independent motion: roots of the sums of squares.
    #[must_use]
    pub fn with(&self, other: &Self) -> Self {
        Self {
            displacement: self.displacement.hypot(other.displacement),
            smear: self.smear.hypot(other.smear),
            jitter: self.jitter.hypot(other.jitter),
        }
    }
}

/// Of a stationary signal with this density, in exposures of a length, s. Each bin's mean square is spread evenly over
/// its width, one resolution; what the spectrum's detrending has removed is missing from the displacement. Motion
/// slower than one resolution is not resolved: choose segments of several exposures.
///
/// # Errors
///
/// An exposure that is not positive and finite, or a result that overflows.
pub fn exposure_of_psd(psd: &Psd, exposure: f64) -> Result<Exposure, PointingError> {
    check_time(exposure)?;
    let mut squares = [0.0; 3];
    for ([from, to], square) in psd.cells() {
        add_mean(&mut squares, [from, to], exposure, |_| square);
    }
    checked(squares)
}

/// Of a stationary signal with a one-sided density that is linear between points, rising frequencies in Hz and
/// densities in unit²/Hz, and zero beyond them.
///
/// # Errors
///
/// An exposure that is not positive and finite; frequencies that are negative, do not rise or are not finite; a density
/// that is negative or not finite.
pub fn exposure_of_table(points: &[[f64; 2]], exposure: f64) -> Result<Exposure, PointingError> {
    check_time(exposure)?;
    for (index, point) in points.iter().enumerate() {
        for (value, of) in point.iter().zip(["frequency", "density"]) {
            check_number(of, index, *value)?;
        }
    }
    let mut squares = [0.0; 3];
    for (index, pair) in points.windows(2).enumerate() {
        let [[from, first], [to, last]] = pair else { continue };
        if to <= from {
            return Err(PointingError::Order { index: index + 1 });
        }
        let density = |share: f64| (first + share * (last - first)) * (to - from);
        add_mean(&mut squares, [*from, *to], exposure, density);
    }
    checked(squares)
}

/// Of lines with random phases, each a frequency, Hz, and an amplitude, unit.
///
/// # Errors
///
/// An exposure that is not positive and finite; a frequency or amplitude that is negative or not finite.
pub fn exposure_of_lines(lines: &[[f64; 2]], exposure: f64) -> Result<Exposure, PointingError> {
    check_time(exposure)?;
    let mut squares = [0.0; 3];
    for (index, [frequency, amplitude]) in lines.iter().enumerate() {
        check_number("frequency", index, *frequency)?;
        check_number("amplitude", index, *amplitude)?;
        let weights = ExposureWeights::new(*frequency, exposure);
        add(&mut squares, &weights, 0.5 * amplitude * amplitude);
    }
    checked(squares)
}

/// Of a history: components, sample by sample, at a rate, 1/s, in exposures one after the other; of the components
/// together. What is left at the end is not used.
///
/// # Errors
///
/// An exposure that is not a whole number of samples, three at least; a history that is shorter than one; components of
/// different lengths; a sample that is not finite.
pub fn exposure_of_history(
    components: &[&[f64]],
    rate: f64,
    exposure: f64,
) -> Result<ExposureHistory, PointingError> {
    let samples = samples_of(exposure, rate, EXPOSURE_SAMPLES_MIN)?;
    let length = super::indices::check_run(components)?;
    if length < samples {
        return Err(PointingError::Short { samples: length, least: samples });
    }
    let mut sums = WindowSums::new(samples, components.len());
    for index in 0..length {
        sums.add(components.iter().map(|c| c.get(index).copied().unwrap_or(f64::NAN)));
    }
    let history = sums.history().ok_or(PointingError::Short { samples: length, least: samples })?;
    check_number("displacement", 0, history.rms.total())?;
    Ok(history)
}

/// Sums over exposures of samples that come one by one.
#[derive(Clone, Debug)]
pub(crate) struct WindowSums {
    samples: usize,
    /// The samples of the present exposure, component by component.
    present: Vec<Vec<f64>>,
    squares: [f64; 3],
    worst: [f64; 3],
    count: usize,
}

impl WindowSums {
    /// For exposures of some samples, of a signal with some components.
    pub(crate) fn new(samples: usize, components: usize) -> Self {
        let present = vec![Vec::new(); components];
        Self { samples, present, squares: [0.0; 3], worst: [0.0; 3], count: 0 }
    }

    /// One sample.
    pub(crate) fn add(&mut self, values: impl Iterator<Item = f64>) {
        self.present.iter_mut().zip(values).for_each(|(present, value)| present.push(value));
        if self.present.first().is_none_or(|present| present.len() < self.samples) {
            return;
        }
        let mut squares = [0.0; 3];
        for present in &mut self.present {
            let (mean, slope) = line(present);
            let n = float(present.len());
            let rest = |(i, value): (usize, &f64)| value - mean - slope * centred(i, present.len());
            let rest = present.iter().enumerate().map(rest).map(|r| r * r).sum::<f64>() / n;
            let parts = [mean * mean, slope * slope * (n * n - 1.0) / 12.0, rest];
            squares.iter_mut().zip(parts).for_each(|(sum, part)| *sum += part);
            present.clear();
        }
        for ((sum, worst), square) in self.squares.iter_mut().zip(&mut self.worst).zip(squares) {
            *sum += square;
            // A NaN is no small value.
            if square > *worst || square.is_nan() {
                *worst = square;
            }
        }
        self.count += 1;
    }

    /// What there is so far; none before the first exposure has ended.
    pub(crate) fn history(&self) -> Option<ExposureHistory> {
        (self.count > 0).then(|| ExposureHistory {
            rms: Exposure::of_squares(self.squares.map(|sum| sum / float(self.count))),
            worst: Exposure::of_squares(self.worst),
            count: self.count,
            samples: self.samples,
        })
    }
}

/// Parts that a band, Hz, is divided into for weights that vary over 1/time.
pub(super) fn parts([from, to]: [f64; 2], time: f64) -> u32 {
    let [each, most] = PARTS;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "1 to 256")]
    let parts = (each * (to - from) * time).ceil().clamp(1.0, most) as u32;
    parts
}

/// Adds the mean over a band of a mean square, by the share of the band from its start, times the weights: Simpson's
/// rule.
fn add_mean(
    squares: &mut [f64; 3],
    [from, to]: [f64; 2],
    exposure: f64,
    square: impl Fn(f64) -> f64,
) {
    let parts = 2 * parts([from, to], exposure);
    for k in 0..=parts {
        let share = f64::from(k) / f64::from(parts);
        let weights = ExposureWeights::new(from + share * (to - from), exposure);
        let simpson = if k == 0 || k == parts { 1.0 } else { f64::from(2 + 2 * (k % 2)) };
        add(squares, &weights, square(share) * simpson / (3.0 * f64::from(parts)));
    }
}

fn add(squares: &mut [f64; 3], weights: &ExposureWeights, square: f64) {
    let parts = [weights.displacement, weights.smear, weights.jitter];
    squares.iter_mut().zip(parts).for_each(|(sum, weight)| *sum += weight * square);
}

fn checked(squares: [f64; 3]) -> Result<Exposure, PointingError> {
    for (index, square) in squares.iter().enumerate() {
        check_number("mean square", index, *square)?;
    }
    Ok(Exposure::of_squares(squares))
}

/// Rejects a time that is not positive and finite.
pub(super) fn check_time(time: f64) -> Result<(), PointingError> {
    if time.is_finite() && time > 0.0 { Ok(()) } else { Err(PointingError::Time(time)) }
}

/// Rejects a number that is negative or not finite.
pub(super) fn check_number(
    of: &'static str,
    index: usize,
    value: f64,
) -> Result<(), PointingError> {
    if value.is_finite() && value >= 0.0 {
        return Ok(());
    }
    Err(PointingError::Number { of, index, value })
}
