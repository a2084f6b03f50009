//! [`Response`]: magnitude and phase over frequency as SVG: logarithmic axes for frequency and magnitude, the
//! phase below, in the manner of [`Figure`](super::figure::Figure).

use std::fmt::Write as _;
use std::ops::Range;

use nalgebra::Complex;
use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::error::DrawError;
use super::figure::{
    ABOVE, Area, BELOW, GRID, INK, LEFT, PANEL, RIGHT, THEME, TYPE, TYPE_SMALL, document, moves,
    px, stroke, text, whole,
};
use super::number::{power_of_ten, short};

/// Height of the panel of the phase.
const PHASE: f64 = 150.0;
/// Above the panel of the phase.
const ABOVE_PHASE: f64 = 8.0;
/// Decades below the largest magnitude that are shown.
const DECADES_MAX: f64 = 9.0;
/// Most decades with a tick at each.
const TICKS_MAX: i32 = 6;

/// Complex curves over frequency.
#[derive(Clone, Debug)]
pub(crate) struct Response {
    /// What the picture shows, for readers who cannot see it.
    pub(crate) description: String,
    /// The text above it.
    pub(crate) title: String,
    /// What the magnitude is, with its unit.
    pub(crate) axis: String,
    /// Frequencies, Hz, rising, above zero.
    pub(crate) frequencies: Vec<f64>,
    /// Name of each curve, `_` before a subscript, and its values.
    pub(crate) curves: Vec<(String, Vec<Complex<f64>>)>,
}

/// An axis.
#[derive(Clone)]
struct Scale {
    range: Range<f64>,
    kind: Kind,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    /// Logarithmic, numbers as they are.
    Plain,
    /// Logarithmic, powers of ten.
    Powers,
    /// Degrees.
    Phase,
}

impl Response {
    /// The picture as an SVG file of its own.
    pub(crate) fn file(&self) -> Result<String, DrawError> {
        let style = format!("<style>\n{THEME}</style>\n");
        let names: Vec<_> = self.curves.iter().map(|(name, _)| name.as_str()).collect();
        let drawn = document(&self.description, &style, &names, PANEL + PHASE, |panel| {
            let (above, below) = panel.split_vertically(px(PANEL));
            Ok(self.magnitudes(&above)? + &self.phases(&below)?)
        })?;
        Ok(format!("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n{drawn}"))
    }

    /// The range of the frequency; never empty.
    fn span(&self) -> Range<f64> {
        match (self.frequencies.first(), self.frequencies.last()) {
            (Some(from), Some(to)) if from < to => *from..*to,
            (Some(only), _) => 0.5 * only..2.0 * only,
            _ => 1.0..10.0,
        }
    }

    fn magnitudes(&self, area: &Area<'_>) -> Result<String, DrawError> {
        let style = text(TYPE, INK).pos(Pos::new(HPos::Left, VPos::Center));
        area.draw_text(&self.title, &style, (px(LEFT), px(0.62 * ABOVE)))?;
        let sizes = || self.curves.iter().flat_map(|(_, values)| values).map(|value| value.norm());
        let sizes = || sizes().filter(|size| size.is_finite() && *size > 0.0);
        let most = sizes().fold(f64::MIN_POSITIVE, f64::max);
        let least = sizes().fold(most, f64::min).max(most * 10_f64.powf(-DECADES_MAX));
        let range =
            10_f64.powf((least.log10() - 0.1).floor())..10_f64.powf((most.log10() + 0.1).ceil());
        let axes = Scale { range: range.clone(), kind: Kind::Powers };
        let value = |value: &Complex<f64>| value.norm().clamp(range.start, range.end);
        self.panel(area, ABOVE, axes, "", &self.axis, value)
    }

    fn phases(&self, area: &Area<'_>) -> Result<String, DrawError> {
        let axes = Scale { range: -180.0..180.0, kind: Kind::Phase };
        // Adding zero makes the phase of a negative number with -0 as imaginary part 180.
        let value = |value: &Complex<f64>| (value.im + 0.0).atan2(value.re).to_degrees();
        self.panel(area, ABOVE_PHASE, axes, "Frequency f (Hz)", "Phase (deg)", value)
    }

    /// Draws the axes of a panel and returns its curves.
    fn panel(
        &self,
        area: &Area<'_>,
        above: f64,
        y: Scale,
        x_label: &str,
        y_label: &str,
        value: impl Fn(&Complex<f64>) -> f64,
    ) -> Result<String, DrawError> {
        let x = self.span();
        let phase = y.kind == Kind::Phase;
        let corners = [(x.start, y.range.start), (x.end, y.range.end)];
        let below = if phase { BELOW } else { 0.45 * BELOW };
        let mut chart = ChartBuilder::on(area)
            .margin_top(px(above))
            .margin_right(px(RIGHT))
            .x_label_area_size(px(below))
            .y_label_area_size(px(LEFT))
            .build_cartesian_2d(Scale { range: x.clone(), kind: Kind::Plain }, y)?;
        chart
            .configure_mesh()
            .light_line_style(TRANSPARENT)
            .bold_line_style(GRID.stroke_width(whole(0.8)))
            .axis_style(INK.stroke_width(whole(0.8)))
            .set_all_tick_mark_size(px(4.0))
            .label_style(text(TYPE_SMALL, INK))
            .axis_desc_style(text(TYPE, INK))
            .x_desc(x_label)
            .y_desc(y_label)
            .draw()?;
        chart.draw_series([Rectangle::new(corners, INK.stroke_width(8))])?;
        let mut out = String::new();
        for (index, (_, values)) in self.curves.iter().enumerate() {
            let points = self.frequencies.iter().zip(values).map(|(f, v)| (*f, value(v)));
            let mut run: Vec<[i32; 2]> = Vec::new();
            let mut last = None;
            let mut end = |run: &mut Vec<[i32; 2]>| {
                if !run.is_empty() {
                    let _ = writeln!(out, "<path d=\"{}\" {}/>", moves(run), stroke(index, 13));
                }
                run.clear();
            };
            for (frequency, value) in points {
                // A phase that goes beyond 180 degrees goes on at -180.
                let jumps = phase && last.is_some_and(|last: f64| (value - last).abs() > 180.0);
                if jumps || !value.is_finite() {
                    end(&mut run);
                }
                if value.is_finite() {
                    let (x, y) = chart.backend_coord(&(frequency, value));
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
            Kind::Phase => (value - start) / (end - start),
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
            Kind::Phase => format!("{value:.0}").replace('-', "\u{2212}"),
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

    #[test]
    fn a_curve_through_zero_and_an_empty_one_are_drawn() {
        let zero = Complex::new(0.0, 0.0);
        for (frequencies, values) in [(vec![1.0, 2.0], vec![zero, zero]), (vec![], vec![])] {
            let response = Response {
                description: String::new(),
                title: "a".into(),
                axis: "b".into(),
                frequencies,
                curves: vec![("c".into(), values)],
            };
            assert!(response.file().expect("it is drawn").contains("</svg>"));
        }
    }
}
