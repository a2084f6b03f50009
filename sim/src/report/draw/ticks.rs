//! The range of an axis, the ticks on it and how they are written.

use std::ops::Range;

use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};

/// Beside the largest value and its negative, an empty share of the range.
const PADDING: f64 = 0.06;
/// A range is divided into this many parts, at most.
const PARTS: f64 = 6.5;
/// A range is at least this share of its largest magnitude, so that ticks have few digits.
const SPAN_MIN: f64 = 2e-4;

/// Values beyond it are drawn at the edge: a range of more has no length.
const MOST: f64 = 1e307;

/// The range of an axis that shows every value.
pub(in crate::report) fn range_of(values: impl Iterator<Item = f64>) -> Range<f64> {
    let (mut from, mut to) = (f64::MAX, f64::MIN);
    let shown = values.filter(|value| value.is_finite()).map(|value| value.clamp(-MOST, MOST));
    for value in shown {
        (from, to) = (from.min(value), to.max(value));
    }
    if from > to {
        return 0.0..1.0;
    }
    let least = SPAN_MIN * from.abs().max(to.abs());
    let padding = match to - from {
        0.0 => from.abs().max(1.0),
        span if span < least => 0.5 * least,
        span => PADDING * span,
    };
    from - padding..to + padding
}

/// The distance between two ticks: one, two or five times a power of ten.
fn spacing(range: &Range<f64>) -> f64 {
    let least = (range.end - range.start) / PARTS;
    let decade = 10_f64.powf(least.log10().floor());
    let fits = |n: f64| (n * decade >= least * (1.0 - 1e-9)).then_some(n * decade);
    [1.0, 2.0, 5.0].into_iter().find_map(fits).unwrap_or(10.0 * decade)
}

/// The ticks in a range.
pub(in crate::report) fn ticks(range: &Range<f64>) -> Vec<f64> {
    let spacing = spacing(range);
    let mut ticks = Vec::new();
    let mut n = (range.start / spacing - 1e-9).ceil();
    while n * spacing <= range.end + 1e-9 * spacing {
        ticks.push(n * spacing);
        n += 1.0;
    }
    ticks
}

/// A tick with the digits that its distance to the next one requires.
fn words(tick: f64, spacing: f64) -> String {
    let decimals = (-(spacing * 1.000_001).log10().floor()).clamp(0.0, 12.0);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "clamped to 0 to 12"
    )]
    let decimals = decimals as usize;
    let tick = if tick.abs() < 1e-9 * spacing { 0.0 } else { tick };
    format!("{tick:.decimals$}").replace('-', "\u{2212}")
}

/// An axis for plotters: a range, and our ticks and words on it.
pub(in crate::report) struct Axis(pub(in crate::report) Range<f64>);

impl Ranged for Axis {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    #[expect(clippy::cast_possible_truncation, reason = "a coordinate in a picture")]
    fn map(&self, value: &f64, limit: (i32, i32)) -> i32 {
        let share = (value - self.0.start) / (self.0.end - self.0.start);
        (f64::from(limit.0) + share * f64::from(limit.1 - limit.0)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, _: Hint) -> Vec<f64> {
        ticks(&self.0)
    }

    fn range(&self) -> Range<f64> {
        self.0.clone()
    }
}

impl ValueFormatter<f64> for Axis {
    fn format_ext(&self, value: &f64) -> String {
        words(*value, spacing(&self.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_numbers() {
        assert_eq!(ticks(&(0.0..10.0)), [0.0, 2.0, 4.0, 6.0, 8.0, 10.0]);
        assert_eq!(ticks(&(-60.0..60.0)), [-60.0, -40.0, -20.0, 0.0, 20.0, 40.0, 60.0]);
    }

    #[test]
    fn words_have_the_digits_that_tell_neighbours_apart() {
        assert_eq!(words(-0.04, 0.02), "\u{2212}0.04");
        assert_eq!(words(4.0, 2.0), "4");
        assert_eq!(words(0.0, 0.5), "0.0");
    }

    #[test]
    fn a_curve_that_is_flat_or_nearly_so_has_a_range() {
        let range = range_of([3.0, 3.0].into_iter());
        assert!(range.start < 3.0 && 3.0 < range.end);
        let range = range_of([4000.0, 4_000.000_1].into_iter());
        assert!(spacing(&range) > 0.01);
    }
}
