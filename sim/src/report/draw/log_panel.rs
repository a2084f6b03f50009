//! [`Panel`]: curves over frequency on logarithmic axes, in the manner of [`Figure`](super::figure::Figure).

use std::fmt::Write as _;
use std::ops::Range;

use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};

use super::axes::{Space, axes};
use super::figure::{Area, BELOW, moves};
use super::legend::stroke_of;
use crate::report::error::DrawError;
use crate::report::number::{power_of_ten, short};

/// Most decades with a tick at each.
const TICKS_MAX: i32 = 6;

/// Axes with curves over frequency.
pub(in crate::report) struct Panel<'a> {
    /// Height above the axes.
    pub(in crate::report) above: f64,
    /// Frequencies, Hz, rising, above zero.
    pub(in crate::report) frequencies: &'a [f64],
    /// The vertical axis.
    pub(in crate::report) y: Scale,
    /// What the horizontal axis shows; empty above another panel.
    pub(in crate::report) x_label: &'a str,
    /// What the vertical axis shows.
    pub(in crate::report) y_label: &'a str,
}

/// An axis.
#[derive(Clone)]
pub(in crate::report) struct Scale {
    pub(in crate::report) range: Range<f64>,
    pub(in crate::report) kind: Kind,
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub(in crate::report) enum Kind {
    /// Logarithmic, numbers as they are.
    Plain,
    /// Logarithmic, powers of ten.
    Powers,
    /// Degrees.
    Phase,
    /// Decibels.
    Decibels,
}

/// Decibels between which a scale has its ticks.
const DECIBELS: f64 = 20.0;

/// Decibels: whole steps of twenty about the values, at most so many below the largest.
pub(in crate::report) fn decibels(values: impl Iterator<Item = f64>, most: f64) -> Scale {
    let levels = values.filter(|level| level.is_finite());
    let ends = levels.fold((f64::INFINITY, f64::NEG_INFINITY), |(least, highest), level| {
        (level.min(least), level.max(highest))
    });
    let (least, highest) = if ends.0 > ends.1 { (-1.0, 1.0) } else { ends };
    let top = DECIBELS * (highest / DECIBELS + 0.1).ceil();
    let bottom = DECIBELS * (least.max(highest - most) / DECIBELS - 0.1).floor();
    Scale { range: bottom..top, kind: Kind::Decibels }
}

/// Logarithmic, powers of ten: whole decades about the positive values, at most so many decades below the largest.
pub(in crate::report) fn decades(values: impl Iterator<Item = f64>, most_decades: f64) -> Scale {
    let sizes = values.filter(|size| size.is_finite() && *size > 0.0);
    let (least, most) = sizes.fold((f64::MAX, f64::MIN_POSITIVE), |(least, most), size| {
        (least.min(size), most.max(size))
    });
    let least = least.min(most).max(most * 10_f64.powf(-most_decades));
    let range =
        10_f64.powf((least.log10() - 0.1).floor())..10_f64.powf((most.log10() + 0.1).ceil());
    Scale { range, kind: Kind::Powers }
}

impl Panel<'_> {
    /// The range of the frequency; never empty.
    fn span(&self) -> Range<f64> {
        match (self.frequencies.first(), self.frequencies.last()) {
            (Some(from), Some(to)) if from < to => *from..*to,
            (Some(only), _) => 0.5 * only..2.0 * only,
            _ => 1.0..10.0,
        }
    }

    /// The axis of the frequency.
    pub(in crate::report) fn x_axis(&self) -> Scale {
        Scale { range: self.span(), kind: Kind::Plain }
    }

    /// Draws the axes and returns the curves, each with its name and a value at every frequency; beyond the axis they follow its
    /// ends.
    pub(in crate::report) fn draw<'n, C: IntoIterator<Item = f64>>(
        self,
        area: &Area<'_>,
        curves: impl Iterator<Item = (&'n str, C)>,
    ) -> Result<String, DrawError> {
        let y = self.y.range.clone();
        let phase = self.y.kind == Kind::Phase;
        let below = if self.x_label.is_empty() { 0.45 * BELOW } else { BELOW };
        let space = Space { above: self.above, below };
        let x_axis = self.x_axis();
        let chart = axes(area, &space, x_axis, self.y, [self.x_label, self.y_label])?;
        let mut out = String::new();
        for (index, (name, values)) in curves.enumerate() {
            let mut run: Vec<[i32; 2]> = Vec::new();
            let mut last = None;
            let mut end = |run: &mut Vec<[i32; 2]>| {
                if !run.is_empty() {
                    let _ = writeln!(
                        out,
                        "<path d=\"{}\" {}/>",
                        moves(run),
                        stroke_of(name, index, 13)
                    );
                }
                run.clear();
            };
            for (frequency, value) in self.frequencies.iter().zip(values) {
                // A phase that goes beyond 180 degrees goes on at -180.
                let jumps = phase && last.is_some_and(|last: f64| (value - last).abs() > 180.0);
                if jumps || !value.is_finite() {
                    end(&mut run);
                }
                if value.is_finite() {
                    let (x, y) = chart.backend_coord(&(*frequency, value.clamp(y.start, y.end)));
                    run.push([x, y]);
                    last = Some(value);
                }
            }
            end(&mut run);
        }
        Ok(out)
    }
}

impl Scale {
    fn ticks(&self) -> Vec<f64> {
        if self.kind == Kind::Phase {
            return vec![-180.0, -90.0, 0.0, 90.0, 180.0];
        }
        if self.kind == Kind::Decibels {
            let step = DECIBELS * ((self.range.end - self.range.start) / (8.0 * DECIBELS)).ceil();
            let first = (self.range.start / step).ceil();
            let count = ((self.range.end / step).floor() - first).max(0.0);
            let ticks = std::iter::successors(Some(0.0), |k| Some(k + 1.0));
            return ticks.take_while(|k| *k <= count).map(|k| step * (first + k)).collect();
        }
        let exponent = |value: f64| {
            #[expect(clippy::cast_possible_truncation, reason = "an exponent of a double")]
            let exponent = value.log10().floor() as i32;
            exponent
        };
        let (from, to) = (exponent(self.range.start), exponent(self.range.end * (1.0 + 1e-9)));
        let decades = to - from;
        let factors: &[f64] = if decades <= 2 { &[1.0, 2.0, 5.0] } else { &[1.0] };
        let step = 1 + decades.max(0) / (TICKS_MAX + 1);
        let each = (from..=to).filter(|e| (e - from) % step == 0);
        let ticks = each.flat_map(|e| factors.iter().map(move |factor| factor * 10_f64.powi(e)));
        let inside = self.range.start * (1.0 - 1e-9)..=self.range.end * (1.0 + 1e-9);
        ticks.filter(|tick| inside.contains(tick)).collect()
    }
}

impl Ranged for Scale {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    #[expect(clippy::cast_possible_truncation, reason = "a coordinate in a picture")]
    fn map(&self, value: &f64, limit: (i32, i32)) -> i32 {
        let (Range { start, end }, value) = (self.range.clone(), *value);
        let share = match self.kind {
            Kind::Phase | Kind::Decibels => (value - start) / (end - start),
            Kind::Plain | Kind::Powers => (value / start).ln() / (end / start).ln(),
        };
        (f64::from(limit.0) + share * f64::from(limit.1 - limit.0)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, _: Hint) -> Vec<f64> {
        self.ticks()
    }

    fn range(&self) -> Range<f64> {
        self.range.clone()
    }
}

impl ValueFormatter<f64> for Scale {
    fn format_ext(&self, value: &f64) -> String {
        match self.kind {
            Kind::Plain => short(*value, 3),
            Kind::Phase | Kind::Decibels => format!("{value:.0}").replace('-', "\u{2212}"),
            Kind::Powers => {
                let exponent = value.log10().round();
                let factor = value / 10_f64.powf(exponent);
                if (factor - 1.0).abs() > 1e-9 {
                    return short(*value, 1);
                }
                #[expect(clippy::cast_possible_truncation, reason = "an exponent of a double")]
                let exponent = exponent as i32;
                power_of_ten(exponent)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_of_a_logarithmic_axis_are_decades_or_one_two_five() {
        let ticks = |from: f64, to: f64| Scale { range: from..to, kind: Kind::Plain }.ticks();
        assert_eq!(ticks(1.0, 1000.0), [1.0, 10.0, 100.0, 1000.0]);
        assert_eq!(ticks(3.0, 60.0), [5.0, 10.0, 20.0, 50.0]);
        assert!(ticks(1e-9, 1e9).len() <= 8);
    }
}
