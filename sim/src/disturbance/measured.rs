//! [`Measured`]: force and torque of a record over time, played once or again and again.
//!
//! Between two rows a straight line, or a cubic spline that is not curved at its ends (natural: de Boor,
//! "A practical guide to splines", IV). Once: zero before the first and after the last row. Repeated: the
//! last row is the time of the first row of the next period, at which the record jumps to that row; it
//! also reaches back before the first row. A step of the integrator ends at each such jump, and at each row where lines
//! meet at an angle.

use super::error::MeasuredError;
use super::{COMPONENT_COUNT, COMPONENTS, Six};

/// Most rows of a record.
pub(crate) const ROWS_MAX: usize = 1_000_000;
/// Most times in a run at which a step has to end for a record.
pub(crate) const BREAKS_MAX: f64 = 2e6;
/// A time this near to the end of a period, in periods, is the end.
const SEAM: f64 = 1e-12;

/// A measured record.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// Times of the rows, s, from the start of the run; each above the one before.
    pub times: Vec<f64>,
    /// Of each component as many values as times, N and N m, or none: zero.
    pub values: Six<Vec<f64>>,
    /// What holds between two rows.
    pub interpolation: MeasuredInterpolation,
    /// Whether it is played again and again.
    pub repeats: bool,
    /// The file that a long record was read from, which its scenario names when it is written; none of one
    /// that is written out.
    pub file: Option<Box<RecordFile>>,
}

/// The file of a record, as a scenario names it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RecordFile {
    /// The file, beside the scenario.
    pub name: String,
    /// Its column of times.
    pub time: String,
    /// Its column of each component; none of one that it does not have.
    pub columns: Six<Option<String>>,
    /// Units of force and moment.
    pub units: [String; 2],
}

/// What holds between two rows of a record.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MeasuredInterpolation {
    /// A straight line.
    Linear,
    /// A cubic spline, not curved at its ends.
    Cubic,
}

impl Measured {
    /// What is wrong with it in a run of a duration, s.
    ///
    /// # Errors
    /// The first fault.
    pub fn check(&self, duration: f64) -> Result<(), MeasuredError> {
        let rows = self.times.len();
        if !(2..=ROWS_MAX).contains(&rows) {
            return Err(MeasuredError::Rows(rows));
        }
        let of = COMPONENTS.into_iter().zip(&self.values);
        for (component, values) in of.clone().filter(|(_, values)| !values.is_empty()) {
            if values.len() != rows {
                return Err(MeasuredError::Count { component, found: values.len(), rows });
            }
        }
        for (what, numbers) in of.chain([("times", &self.times)]) {
            let mut numbered = numbers.iter().zip(1..);
            if let Some((value, row)) = numbered.find(|(value, _)| !value.is_finite()) {
                return Err(MeasuredError::NotFinite { what, row, value: *value });
            }
        }
        for (pair, row) in self.times.windows(2).zip(2..) {
            if let [before, after] = pair
                && before >= after
            {
                return Err(MeasuredError::Order { row, times: [*before, *after] });
            }
        }
        #[expect(clippy::cast_precision_loss, reason = "at most ROWS_MAX")]
        let in_period =
            if self.interpolation == MeasuredInterpolation::Linear { rows as f64 } else { 2.0 };
        let periods = if self.repeats { duration / self.period() + 2.0 } else { 1.0 };
        let found = in_period * periods;
        if found <= BREAKS_MAX { Ok(()) } else { Err(MeasuredError::Breaks { found }) }
    }

    /// Rows per second, 1/s; of a checked record.
    #[must_use]
    pub fn mean_rate(&self) -> f64 {
        #[expect(clippy::cast_precision_loss, reason = "at most ROWS_MAX")]
        let rows = self.times.len().saturating_sub(1) as f64;
        rows / self.period()
    }

    fn first(&self) -> f64 {
        self.times.first().copied().unwrap_or(0.0)
    }

    /// Time from the first to the last row, s.
    fn period(&self) -> f64 {
        self.times.last().copied().unwrap_or(0.0) - self.first()
    }

    /// The times within a run at which it, or its slope, jumps, in no order; of a checked record.
    #[must_use]
    pub fn breaks(&self, duration: f64) -> Vec<f64> {
        let (first, period) = (self.first(), self.period());
        let linear = self.interpolation == MeasuredInterpolation::Linear;
        let ends = [first, first + period];
        let times = if linear { self.times.as_slice() } else { &ends[..] };
        if !self.repeats {
            return times.to_vec();
        }
        let (mut number, last) = ((-first / period).floor(), ((duration - first) / period).ceil());
        let mut breaks = Vec::new();
        while number <= last {
            let within = times.iter().map(|time| time + number * period);
            breaks.extend(within.filter(|time| (0.0..=duration).contains(time)));
            number += 1.0;
        }
        breaks
    }
}

/// A record with the curvatures of its splines.
#[derive(Clone, Debug)]
pub struct Playback<'a> {
    of: &'a Measured,
    /// Second derivatives at the rows, of each component; none of straight lines.
    curvatures: Six<Vec<f64>>,
}

impl<'a> Playback<'a> {
    /// Of a checked record.
    #[must_use]
    pub fn new(of: &'a Measured) -> Self {
        let curvatures = of.values.each_ref().map(|values| match of.interpolation {
            MeasuredInterpolation::Cubic if values.len() == of.times.len() => {
                natural(&of.times, values)
            }
            _ => Vec::new(),
        });
        Self { of, curvatures }
    }

    /// Force, N, and moment, N m, at a time, s; at a jump the values after it, or before it with
    /// `from_below`.
    #[must_use]
    pub fn at(&self, time: f64, from_below: bool) -> Six<f64> {
        let nothing = [0.0; COMPONENT_COUNT];
        let Some(time) = self.local(time, from_below) else { return nothing };
        let times = &self.of.times;
        let after = times.partition_point(|t| *t <= time).clamp(1, times.len().max(2) - 1);
        let (Some(t_0), Some(t_1)) = (times.get(after - 1), times.get(after)) else {
            return nothing;
        };
        let step = t_1 - t_0;
        let (a, b) = ((t_1 - time) / step, (time - t_0) / step);
        let mut found = nothing;
        for ((to, values), curvatures) in
            found.iter_mut().zip(&self.of.values).zip(&self.curvatures)
        {
            let (Some(y_0), Some(y_1)) = (values.get(after - 1), values.get(after)) else {
                continue;
            };
            *to = a * y_0 + b * y_1;
            if let (Some(m_0), Some(m_1)) = (curvatures.get(after - 1), curvatures.get(after)) {
                // y = a y_0 + b y_1 + ((a³ - a) y_0'' + (b³ - b) y_1'') s² / 6
                *to += ((a * a * a - a) * m_0 + (b * b * b - b) * m_1) * step * step / 6.0;
            }
        }
        found
    }

    /// The time in the record; none where it is not played.
    fn local(&self, time: f64, from_below: bool) -> Option<f64> {
        let (first, period) = (self.of.first(), self.of.period());
        if !self.of.repeats {
            let last = first + period;
            let within = if from_below {
                first < time && time <= last
            } else {
                first <= time && time < last
            };
            return within.then_some(time);
        }
        let periods = (time - first) / period;
        let seam = periods.round();
        if (periods - seam).abs() <= SEAM * seam.abs().max(1.0) {
            return Some(if from_below { first + period } else { first });
        }
        Some(first + (periods - periods.floor()) * period)
    }
}

/// Second derivatives of the natural cubic spline, by elimination of its tridiagonal equations
///
/// ```text
/// s_(i-1) m_(i-1) + 2 (s_(i-1) + s_i) m_i + s_i m_(i+1) = 6 ((y_(i+1) - y_i) / s_i - (y_i - y_(i-1)) / s_(i-1))
/// ```
fn natural(times: &[f64], values: &[f64]) -> Vec<f64> {
    let rows = times.len().min(values.len());
    let mut curvatures = vec![0.0; rows];
    // Of row i: what m_i takes of m_(i+1), and its right side, after elimination.
    let mut eliminated = vec![[0.0; 2]; rows];
    for i in 1..rows.saturating_sub(1) {
        let (before, after) = (times[i] - times[i - 1], times[i + 1] - times[i]);
        let slopes = [(values[i] - values[i - 1]) / before, (values[i + 1] - values[i]) / after];
        let [upper, right] = eliminated[i - 1];
        let pivot = 2.0 * (before + after) - before * upper;
        eliminated[i] = [after / pivot, (6.0 * (slopes[1] - slopes[0]) - before * right) / pivot];
    }
    for i in (1..rows.saturating_sub(1)).rev() {
        let [upper, right] = eliminated[i];
        curvatures[i] = right - upper * curvatures[i + 1];
    }
    curvatures
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Sums of a few numbers of order one.
    const ROUNDING: f64 = 1e-14;

    fn record(interpolation: MeasuredInterpolation, repeats: bool) -> Measured {
        let times = vec![1.0, 1.5, 2.5, 3.0];
        let mut values: Six<Vec<f64>> = Default::default();
        values[2] = vec![1.0, 3.0, 2.0, 4.0];
        Measured { times, values, interpolation, repeats, file: None }
    }

    fn z(of: &Measured, time: f64, from_below: bool) -> f64 {
        Playback::new(of).at(time, from_below)[2]
    }

    #[test]
    fn lines_go_through_the_rows_once_or_again() {
        let once = record(MeasuredInterpolation::Linear, false);
        once.check(10.0).expect("valid");
        for (time, below, expected) in [
            (0.9, false, 0.0),
            (1.0, true, 0.0),
            (1.0, false, 1.0),
            (1.25, true, 2.0),
            (2.0, false, 2.5),
            (3.0, true, 4.0),
            (3.0, false, 0.0),
        ] {
            assert_eq!(z(&once, time, below), expected, "{time} {below}");
        }
        assert_eq!(once.breaks(10.0), once.times);
        let again = record(MeasuredInterpolation::Linear, true);
        for (time, below, expected) in [
            (0.0, false, 2.5),
            (1.0, true, 4.0),
            (1.0, false, 1.0),
            (5.25, false, 2.0),
            (9.0, true, 4.0),
        ] {
            assert_eq!(z(&again, time, below), expected, "{time} {below}");
        }
        let mut breaks = again.breaks(4.0);
        breaks.sort_by(f64::total_cmp);
        breaks.dedup();
        assert_eq!(breaks, [0.5, 1.0, 1.5, 2.5, 3.0, 3.5]);
    }

    /// A spline of four rows, solved by hand: s = 0.5, 1, 0.5 and slopes 4, -1, 4 make
    /// `3 m_1 + m_2 = -30` and `m_1 + 3 m_2 = 30`, so `m_1 = -15`, `m_2 = 15`.
    #[test]
    fn a_cubic_is_the_natural_spline() {
        let cubic = record(MeasuredInterpolation::Cubic, false);
        for (time, value) in cubic.times.iter().zip(&cubic.values[2]) {
            assert!((z(&cubic, *time, *time > 1.0) - value).abs() < ROUNDING);
        }
        // In the middle of the second interval a = b = 1/2: the curvatures cancel.
        assert!((z(&cubic, 2.0, false) - 2.5).abs() < ROUNDING);
        // In the middle of the first: 2 + (1/8 - 1/2) (-15) 0.25 / 6.
        let expected = 2.0 + 0.375 * 15.0 * 0.25 / 6.0;
        assert!((z(&cubic, 1.25, false) - expected).abs() < ROUNDING);
        assert_eq!(cubic.breaks(10.0), [1.0, 3.0]);
    }

    #[test]
    fn a_seam_keeps_its_sides_after_many_periods() {
        let mut again = record(MeasuredInterpolation::Linear, true);
        again.times = vec![0.1, 0.2, 0.35, 0.4];
        let period = again.period();
        for k in 1..2000 {
            let time = again.first() + f64::from(k) * period;
            assert_eq!([z(&again, time, true), z(&again, time, false)], [4.0, 1.0], "{k}");
        }
    }

    #[test]
    fn what_cannot_be_played_is_an_error() {
        let good = || record(MeasuredInterpolation::Linear, true);
        let with = |change: fn(&mut Measured)| {
            let mut of = good();
            change(&mut of);
            of
        };
        let faults = [
            with(|of| of.times.truncate(1)),
            with(|of| of.times[2] = 1.5),
            with(|of| of.times[0] = f64::NAN),
            with(|of| of.values[2][3] = f64::INFINITY),
            with(|of| of.values[0] = vec![1.0]),
            with(|of| of.times = vec![0.0, 1e-9, 2e-9, 3e-9]),
        ];
        for fault in faults {
            let error = fault.check(10.0).expect_err("a fault");
            assert!(!error.to_string().is_empty(), "{error:?}");
        }
        assert!(good().check(10.0).is_ok());
    }
}
