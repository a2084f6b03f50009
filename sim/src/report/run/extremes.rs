//! [`Extremes`] and [`Magnitude`]: peak and RMS of a history from its samples as they come.
//!
//! The mean over time is by the trapezoidal rule, so a last sample that is not evenly spaced has its
//! own weight. What is no number is no small value: it becomes the peak.

/// Peak and mean square of a quantity.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(in crate::report) struct Extremes {
    /// Largest magnitude.
    pub(in crate::report) peak: f64,
    /// Time of the largest magnitude, s.
    pub(in crate::report) peak_time: f64,
    /// Integral of the square over time, and its length, s.
    integral: f64,
    length: f64,
    /// Time and square of the last sample.
    last: Option<[f64; 2]>,
}

impl Extremes {
    /// Adds a sample at a time, s.
    pub(in crate::report) fn add(&mut self, time: f64, value: f64) {
        let size = value.abs();
        if size > self.peak || size.is_nan() {
            (self.peak, self.peak_time) = (size, time);
        }
        let square = value * value;
        if let Some([before, last]) = self.last {
            self.integral += 0.5 * (time - before) * (last + square);
            self.length += time - before;
        }
        self.last = Some([time, square]);
    }

    /// Root of the mean square; the magnitude where there is one sample only.
    pub(in crate::report) fn rms(&self) -> f64 {
        if self.length > 0.0 { (self.integral / self.length).sqrt() } else { self.peak }
    }
}

/// The extremes of a vector's magnitude.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::report) struct Magnitude {
    columns: Vec<usize>,
    /// Of the magnitude.
    pub(in crate::report) extremes: Extremes,
}

impl Magnitude {
    /// That of the vector in these columns.
    pub(in crate::report) fn new(columns: Vec<usize>) -> Self {
        Self { columns, extremes: Extremes::default() }
    }

    /// Adds a sample.
    pub(in crate::report) fn add(&mut self, time: f64, row: &[f64]) {
        let values = self.columns.iter().filter_map(|column| row.get(*column));
        self.extremes.add(time, values.map(|value| value * value).sum::<f64>().sqrt());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn peak_and_rms_of_a_sine() {
        let mut extremes = Extremes::default();
        for k in 0..=4000 {
            let time = f64::from(k) * 1e-3;
            extremes.add(time, -3.0 * (std::f64::consts::TAU * time).sin());
        }
        assert!((extremes.peak - 3.0).abs() < 1e-12 && (extremes.peak_time - 0.25).abs() < 1e-12);
        assert!((extremes.rms() - 3.0 / 2_f64.sqrt()).abs() < 1e-9);
    }
}
