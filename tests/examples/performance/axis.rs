//! A logarithmic axis for plotters, with ticks that the caller gives.

use std::ops::Range;

use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};

/// Logarithms to a base, and the numbers written at some of them.
pub(crate) struct Axis {
    base: f64,
    range: Range<f64>,
    ticks: Vec<f64>,
}

impl Axis {
    /// From one value to another; ticks are values, too.
    pub(crate) fn new(base: f64, values: &Range<f64>, ticks: impl Iterator<Item = f64>) -> Self {
        let ticks = ticks.filter(|tick| (values.start..=values.end).contains(tick));
        Self {
            base,
            range: values.start.log(base)..values.end.log(base),
            ticks: ticks.map(|tick| tick.log(base)).collect(),
        }
    }
}

impl Ranged for Axis {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    #[expect(clippy::cast_possible_truncation, reason = "a coordinate in a picture")]
    fn map(&self, value: &f64, limit: (i32, i32)) -> i32 {
        let share = (value - self.range.start) / (self.range.end - self.range.start);
        (f64::from(limit.0) + share * f64::from(limit.1 - limit.0)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, _: Hint) -> Vec<f64> {
        self.ticks.clone()
    }

    fn range(&self) -> Range<f64> {
        self.range.clone()
    }
}

impl ValueFormatter<f64> for Axis {
    fn format_ext(&self, value: &f64) -> String {
        format!("{:.0}", self.base.powf(*value))
    }
}
