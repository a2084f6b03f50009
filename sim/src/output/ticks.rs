//! Scales, the ticks on them and how they are written; and as many points as a picture can show.

use std::ops::Range;

use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};

/// A vertical or horizontal scale.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// Proportional.
    Linear,
    /// Decades.
    Logarithmic,
}

/// Beside the largest value and its negative, an empty share of the range.
const PADDING: f64 = 0.06;
/// A range is divided into this many parts, at most.
const PARTS: f64 = 6.5;

impl Scale {
    /// The value in the units of the axis; not a number if it is not on the axis.
    #[must_use]
    pub fn apply(self, value: f64) -> f64 {
        match self {
            Self::Linear => value,
            Self::Logarithmic if value > 0.0 => value.log10(),
            Self::Logarithmic => f64::NAN,
        }
    }

    /// The range of the axis that shows every value.
    #[must_use]
    pub fn range(self, values: impl Iterator<Item = f64>) -> Range<f64> {
        let (mut from, mut to) = (f64::MAX, f64::MIN);
        for value in values.map(|v| self.apply(v)).filter(|v| v.is_finite()) {
            (from, to) = (from.min(value), to.max(value));
        }
        if from > to {
            return 0.0..1.0;
        }
        match self {
            Self::Linear => {
                let padding = match to - from {
                    0.0 => from.abs().max(1.0),
                    span => PADDING * span,
                };
                from - padding..to + padding
            }
            // The topmost decade leaves room for the name of a level line.
            Self::Logarithmic => from.floor()..(to + 0.5).ceil(),
        }
    }

    /// The distance between two ticks: one, two or five times a power of ten.
    #[must_use]
    pub fn spacing(self, range: &Range<f64>) -> f64 {
        let least = (range.end - range.start) / PARTS;
        let decade = 10_f64.powf(least.log10().floor());
        let spacing = [1.0, 2.0, 5.0, 10.0]
            .into_iter()
            .map(|n| n * decade)
            .find(|&spacing| spacing >= least * (1.0 - 1e-9))
            .unwrap_or(10.0 * decade);
        match self {
            Self::Linear => spacing,
            Self::Logarithmic => spacing.max(1.0),
        }
    }

    /// The ticks in a range.
    #[must_use]
    pub fn ticks(self, range: &Range<f64>) -> Vec<f64> {
        let spacing = self.spacing(range);
        let mut ticks = Vec::new();
        let mut n = (range.start / spacing - 1e-9).ceil();
        while n * spacing <= range.end + 1e-9 * spacing {
            ticks.push(n * spacing);
            n += 1.0;
        }
        ticks
    }

    /// A tick in words, with the digits that its distance to the next one calls for.
    #[must_use]
    pub fn words(self, tick: f64, spacing: f64) -> String {
        match self {
            Self::Linear => {
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
            Self::Logarithmic => {
                format!("{tick:.0}").chars().fold(String::from("10"), |mut words, c| {
                    words.push(superscript(c));
                    words
                })
            }
        }
    }
}

/// An axis for plotters: a range, and our ticks and words on it.
pub(super) struct Axis {
    scale: Scale,
    range: Range<f64>,
}

impl Axis {
    pub(super) fn new(scale: Scale, range: Range<f64>) -> Self {
        Self { scale, range }
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
        self.scale.ticks(&self.range)
    }

    fn range(&self) -> Range<f64> {
        self.range.clone()
    }
}

impl ValueFormatter<f64> for Axis {
    fn format_ext(&self, value: &f64) -> String {
        self.scale.words(*value, self.scale.spacing(&self.range))
    }
}

fn superscript(c: char) -> char {
    match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        '0' => '⁰',
        '4'..='9' => char::from_u32('⁴' as u32 + (c as u32 - '4' as u32)).unwrap_or(c),
        _ => c,
    }
}

/// A picture shows no more columns than this.
const COLUMNS: usize = 400;

/// The points that a picture can show: of each column the first, lowest, highest and last, in the
/// order of time. The envelope of an oscillation too fast for the picture is kept.
#[must_use]
pub(super) fn decimated(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let size = points.len().div_ceil(COLUMNS);
    if size <= 4 {
        return points.to_vec();
    }
    let mut kept = Vec::with_capacity(4 * COLUMNS);
    for column in points.chunks(size) {
        let by_value = |a: &usize, b: &usize| column[*a].1.total_cmp(&column[*b].1);
        let lowest = (0..column.len()).min_by(by_value).unwrap_or(0);
        let highest = (0..column.len()).max_by(by_value).unwrap_or(0);
        let mut indices = [0, lowest, highest, column.len() - 1];
        indices.sort_unstable();
        let mut last = None;
        for i in indices {
            if last != Some(i) {
                kept.push(column[i]);
            }
            last = Some(i);
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_numbers() {
        assert_eq!(Scale::Linear.ticks(&(0.0..10.0)), [0.0, 2.0, 4.0, 6.0, 8.0, 10.0]);
        let ticks = [-60.0, -40.0, -20.0, 0.0, 20.0, 40.0, 60.0];
        assert_eq!(Scale::Linear.ticks(&(-60.0..60.0)), ticks);
    }

    #[test]
    fn words_have_the_digits_that_tell_neighbours_apart() {
        assert_eq!(Scale::Linear.words(-0.04, 0.02), "\u{2212}0.04");
        assert_eq!(Scale::Linear.words(4.0, 2.0), "4");
        assert_eq!(Scale::Linear.words(0.0, 0.5), "0.0");
        assert_eq!(Scale::Logarithmic.words(-16.0, 1.0), "10⁻¹⁶");
    }

    #[test]
    fn a_flat_curve_still_has_a_range() {
        let range = Scale::Linear.range([3.0, 3.0].into_iter());
        assert!(range.start < 3.0 && 3.0 < range.end);
    }

    #[test]
    fn decimation_keeps_the_envelope_and_the_ends() {
        let points: Vec<_> =
            (0..20_000).map(|i| (f64::from(i), (f64::from(i) * 0.7).sin())).collect();
        let kept = decimated(&points);
        assert!(kept.len() <= 4 * COLUMNS);
        assert_eq!((kept[0], kept[kept.len() - 1]), (points[0], points[19_999]));
        assert!(kept.windows(2).all(|pair| pair[0].0 < pair[1].0));
        let most = |p: &[(f64, f64)]| p.iter().map(|p| p.1).fold(f64::MIN, f64::max);
        assert_eq!(most(&kept), most(&points));
    }
}
