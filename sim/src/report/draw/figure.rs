//! [`Figure`]: curves over time as SVG. plotters draws the axes; the curves are paths of ours, which
//! are shorter than its polylines and can be bands.
//!
//! A curve of decimated samples is a band between least and greatest value, so no spike is lost.
//! Everything is drawn in tenths of a unit, because plotters rounds to whole ones. Colours are those
//! of paper, so a viewer that knows no CSS shows a right picture; `theme.css` turns them for dark
//! screens by selecting on the attribute, which is why each colour below has one meaning.

use std::fmt::Write as _;

use plotters::coord::Shift;
use plotters::prelude::*;

use super::axes::{Space, axes, svg_file, title};
use super::legend::{Entry, Sample, colour, legend, limit_stroke, stroke};
use super::ticks::{Axis, range_of};
use crate::report::error::DrawError;
use crate::report::number::power_of_ten;

/// The rules that turn the colours on dark screens, for an SVG file.
pub(in crate::report) const THEME: &str = include_str!("theme.css");

/// Ink of text, frame and axes.
pub(in crate::report) const INK: RGBColor = RGBColor(0x1c, 0x1c, 0x1e);
/// Grid lines.
pub(in crate::report) const GRID: RGBColor = RGBColor(0xe3, 0xe3, 0xe6);
pub(in crate::report) const FONT: &str =
    "STIX Two Text, Libertinus Serif, Georgia, Times New Roman, serif";
/// Tenths of a unit, see above.
const FINE: f64 = 10.0;
/// plotters writes this share of the size it is passed.
const FONT_SHARE: f64 = 1.24;
pub(in crate::report) const WIDTH: f64 = 450.0;
pub(in crate::report) const PANEL: f64 = 224.0;
pub(in crate::report) const LEGEND: f64 = 20.0;
/// Around a figure: names and titles in a reader's wider font.
const MARGIN: f64 = 12.0;
/// Around the axes.
pub(in crate::report) const LEFT: f64 = 60.0;
pub(in crate::report) const BELOW: f64 = 42.0;
pub(in crate::report) const ABOVE: f64 = 34.0;
pub(in crate::report) const RIGHT: f64 = 12.0;
/// Type sizes: labels and legend, ticks.
pub(in crate::report) const TYPE: f64 = 13.0;
pub(in crate::report) const TYPE_SMALL: f64 = 12.0;
/// Most points of a line, and of the edge of a band.
const POINTS_MAX: [usize; 2] = [600, 190];
/// The largest power of a thousand that is a number.
const EXPONENT_MAX: i32 = 306;
/// What is no thicker is drawn as a line, tenths of a unit: about a line's own width.
const THIN: i32 = 12;

/// Curves over time.
#[derive(Clone, Debug)]
pub(in crate::report) struct Figure {
    /// What the picture shows, for readers who cannot see it.
    pub(in crate::report) description: String,
    /// The text above it.
    pub(in crate::report) title: String,
    /// What the vertical axis shows.
    pub(in crate::report) axis: &'static str,
    /// Of all values; may be empty.
    pub(in crate::report) unit: &'static str,
    /// Start and end, s.
    pub(in crate::report) span: [f64; 2],
    /// The curves.
    pub(in crate::report) lines: Vec<Line>,
    /// Limits on them.
    pub(in crate::report) limits: Vec<LimitLine>,
}

/// A limit: horizontal lines over a time.
#[derive(Clone, Debug)]
pub(in crate::report) struct LimitLine {
    /// Its name in the legend.
    pub(in crate::report) name: String,
    /// Where the lines are; none where they would leave no room for the curves.
    pub(in crate::report) values: Vec<f64>,
    /// Where they begin and end, s.
    pub(in crate::report) window: [f64; 2],
}

/// One curve.
#[derive(Clone, Debug)]
pub(in crate::report) struct Line {
    /// Its name in the legend; `_` before a subscript.
    pub(in crate::report) name: String,
    /// In the order of time.
    pub(in crate::report) bands: Vec<Band>,
}

/// Least and greatest value at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::report) struct Band {
    /// s.
    pub(in crate::report) time: f64,
    /// Least value.
    pub(in crate::report) min: f64,
    /// Greatest value.
    pub(in crate::report) max: f64,
}

/// Where a band is in the picture, tenths of a unit: time, greatest, least.
type BandPosition = [i32; 3];

pub(in crate::report) type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

impl Figure {
    /// The figure as an SVG file of its own.
    pub(in crate::report) fn file(&self) -> Result<String, DrawError> {
        svg_file(|style| self.document(style))
    }

    /// The figure as part of a page that turns its colours.
    pub(in crate::report) fn inline(&self) -> Result<String, DrawError> {
        self.document("")
    }

    fn document(&self, style: &str) -> Result<String, DrawError> {
        let mut entries = Entry::curves(self.lines.iter().map(|line| line.name.as_str()));
        let limits = self.limits.iter().filter(|limit| !limit.values.is_empty());
        entries.extend(limits.map(|limit| Entry { name: &limit.name, sample: Sample::Limit }));
        document(&self.description, style, &entries, [WIDTH, PANEL], |panel| self.draw(panel))
    }

    /// Draws the axes and returns the curves.
    fn draw(&self, area: &Area) -> Result<String, DrawError> {
        title(area, &self.title)?;
        let (power, label) = self.label();
        let values = || self.lines.iter().flat_map(|line| &line.bands);
        let limits = self.limits.iter().flat_map(|limit| limit.values.iter().copied());
        let all = values().flat_map(|band| [band.min, band.max]).chain(limits);
        let y = range_of(all.map(|value| value * power));
        let [from, to] = self.span;
        let x = if from < to { from..to } else { from - 0.5..from + 0.5 };
        let labels = ["Time t (s)", label.as_str()];
        let chart = axes(area, &Space { above: ABOVE, below: BELOW }, Axis(x), Axis(y), labels)?;
        let place = |band: &Band| {
            let at = |value: f64| chart.backend_coord(&(band.time, value * power));
            let ((time, greatest), (_, least)) = (at(band.max), at(band.min));
            [time, greatest, least]
        };
        let mut out = String::new();
        for limit in &self.limits {
            for value in &limit.values {
                let ends = limit.window.map(|time| chart.backend_coord(&(time, value * power)));
                let ends = ends.map(<[i32; 2]>::from);
                let _ = writeln!(out, "<path d=\"{}\" {}/>", moves(&ends), limit_stroke(10));
            }
        }
        for (index, line) in self.lines.iter().enumerate() {
            for run in line.merged() {
                let placed: Vec<_> = run.iter().map(place).collect();
                path(&mut out, &placed, index);
            }
        }
        Ok(out)
    }

    /// What values are multiplied by for the axis, and the axis' label with that power of ten.
    fn label(&self) -> (f64, String) {
        let values = self.lines.iter().flat_map(|line| &line.bands);
        let sizes = values.map(|band| band.min.abs().max(band.max.abs()));
        let peak = sizes.filter(|size| size.is_finite()).fold(0.0, f64::max);
        let plain = peak == 0.0 || (1e-2..1e5).contains(&peak);
        #[expect(clippy::cast_possible_truncation, reason = "an exponent of a double")]
        let exponent = if plain { 0 } else { 3 * (peak.log10() / 3.0).floor() as i32 };
        // Below it, the power that they are multiplied by is no number.
        let exponent = exponent.max(-EXPONENT_MAX);
        let factor = if plain { String::new() } else { power_of_ten(exponent) };
        let unit = [factor.as_str(), self.unit].join(" ");
        let label = match unit.trim() {
            "" => self.axis.to_owned(),
            unit => format!("{} ({unit})", self.axis),
        };
        (10_f64.powi(-exponent), label)
    }
}

/// A drawing with a legend of some names, and below it a panel of a width and height whose curves `draw` returns.
pub(in crate::report) fn document(
    description: &str,
    style: &str,
    entries: &[Entry<'_>],
    [width, panel_height]: [f64; 2],
    draw: impl FnOnce(&Area<'_>) -> Result<String, DrawError>,
) -> Result<String, DrawError> {
    let (legend, rows) = legend(entries, width);
    let height = LEGEND * f64::from(rows) + panel_height;
    let mut axes = String::new();
    let curves;
    {
        let area = SVGBackend::with_string(&mut axes, (whole(width), whole(height)));
        let area = area.into_drawing_area();
        let (_, panel) = area.split_vertically(px(LEGEND * f64::from(rows)));
        curves = draw(&panel)?;
        area.present()?;
    }
    // plotters' own root element says nothing of the units: ours replaces it.
    let body = axes.split_once('>').map_or("", |(_, rest)| rest);
    let body = body.rsplit_once("</svg>").map_or(body, |(body, _)| body);
    let body: String = body.lines().filter(|line| !line.is_empty()).collect();
    let (width, height) = (width + 2.0 * MARGIN, height + 2.0 * MARGIN);
    let (x, w, h) = (-px(MARGIN), px(width), px(height));
    let description = escaped(description);
    Ok(format!(
        "<svg class=\"figure\" xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" \
         width=\"{width}\" height=\"{height}\" viewBox=\"{x} {x} {w} {h}\">\n\
         <title>{description}</title>\n{style}\
         <rect x=\"{x}\" y=\"{x}\" width=\"{w}\" height=\"{h}\" fill=\"#FFFFFF\"/>\n\
         {legend}<g stroke-linejoin=\"round\">{body}</g>\n{curves}</svg>\n"
    ))
}

impl Line {
    /// Whether there is anything to draw.
    pub(in crate::report) fn is_drawn(&self) -> bool {
        self.bands.iter().any(|band| band.min.is_finite() && band.max.is_finite())
    }

    /// As many bands as the picture can show, in runs without gaps.
    fn merged(&self) -> Vec<Vec<Band>> {
        let [of_line, of_band] = POINTS_MAX;
        let is_finite = |band: &Band| band.min.is_finite() && band.max.is_finite();
        let is_line = self.bands.len() <= of_line
            && self.bands.iter().all(|band| band.min == band.max || !is_finite(band));
        let size = if is_line { 1 } else { self.bands.len().div_ceil(of_band).max(1) };
        let mut runs = vec![Vec::new()];
        for column in self.bands.chunks(size) {
            // What is not finite interrupts the curve, also within a chunk.
            for (index, part) in column.split(|band| !is_finite(band)).enumerate() {
                if index > 0 {
                    runs.push(Vec::new());
                }
                let Some(band) = part.iter().copied().reduce(Band::with) else { continue };
                let ends = [part.first(), part.last()];
                let time = ends.into_iter().flatten().map(|b| 0.5 * b.time).sum();
                if let Some(run) = runs.last_mut() {
                    run.push(Band { time, ..band });
                }
            }
        }
        runs.retain(|run| !run.is_empty());
        runs
    }
}

impl Band {
    fn with(self, other: Self) -> Self {
        Self { time: self.time, min: self.min.min(other.min), max: self.max.max(other.max) }
    }
}

/// A curve without gaps: a line where it is thin throughout, otherwise a closed band.
fn path(out: &mut String, run: &[BandPosition], index: usize) {
    if run.iter().all(|[_, greatest, least]| least.saturating_sub(*greatest) <= THIN) {
        let middle =
            |[time, greatest, least]: &BandPosition| [*time, i32::midpoint(*greatest, *least)];
        let middles: Vec<_> = run.iter().map(middle).collect();
        let _ = writeln!(out, "<path d=\"{}\" {}/>", moves(&middles), stroke(index, 13));
        return;
    }
    let greatest: Vec<_> = run.iter().map(|[time, greatest, _]| [*time, *greatest]).collect();
    let least = run.iter().rev().map(|[time, _, least]| [*time, *least]);
    let points: Vec<_> = greatest.into_iter().chain(least).collect();
    let colour = colour(index);
    let _ = writeln!(
        out,
        "<path d=\"{}z\" fill=\"{colour}\" fill-opacity=\"0.45\" stroke=\"{colour}\" \
         stroke-width=\"6\"/>",
        moves(&points)
    );
}

/// A path through points by relative moves; points within a horizontal line are left out.
pub(in crate::report) fn moves(points: &[[i32; 2]]) -> String {
    let Some(mut at) = points.first().copied() else { return String::new() };
    let mut out = format!("M{} {}l", at[0], at[1]);
    for (index, point) in points.iter().enumerate().skip(1) {
        if points.get(index + 1).is_some_and(|next| next[1] == point[1]) && at[1] == point[1] {
            continue;
        }
        for number in [point[0].saturating_sub(at[0]), point[1].saturating_sub(at[1])] {
            if number >= 0 && !out.ends_with('l') {
                out.push(' ');
            }
            let _ = write!(out, "{number}");
        }
        at = *point;
    }
    if points.len() == 1 { out + "0 0" } else { out }
}

pub(in crate::report) fn text(size: f64, colour: RGBColor) -> TextStyle<'static> {
    (FONT, size * FINE * FONT_SHARE).into_font().color(&colour)
}

#[expect(clippy::cast_possible_truncation, reason = "sizes of a picture")]
pub(in crate::report) fn px(value: f64) -> i32 {
    (value * FINE).round() as i32
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "positive sizes of a picture"
)]
pub(in crate::report) fn whole(value: f64) -> u32 {
    (value * FINE).round() as u32
}

pub(in crate::report) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
