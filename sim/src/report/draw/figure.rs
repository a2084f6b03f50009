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
use super::ticks::{Axis, range_of};
use crate::report::error::DrawError;
use crate::report::number::power_of_ten;

/// The rules that turn the colours on dark screens, for an SVG file.
pub(in crate::report) const THEME: &str = include_str!("theme.css");

/// Ink of text, frame and axes.
pub(in crate::report) const INK: RGBColor = RGBColor(0x1c, 0x1c, 0x1e);
/// Grid lines.
pub(in crate::report) const GRID: RGBColor = RGBColor(0xe3, 0xe3, 0xe6);
/// Colours of the curves in order; they repeat.
const COLOURS: [&str; 7] =
    ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#000000", "#E69F00", "#56B4E9"];
/// Dashes of the curves in order, tenths of a unit; they repeat.
const DASHES: [&str; 8] =
    ["", "80 30", "20 25", "90 30 20 30", "140 40", "40 40", "90 30 20 30 20 30", "50 20"];

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
        let names: Vec<_> = self.lines.iter().map(|line| line.name.as_str()).collect();
        document(&self.description, style, &names, [WIDTH, PANEL], |panel| self.draw(panel))
    }

    /// Draws the axes and returns the curves.
    fn draw(&self, area: &Area) -> Result<String, DrawError> {
        title(area, &self.title)?;
        let (power, label) = self.label();
        let values = || self.lines.iter().flat_map(|line| &line.bands);
        let y = range_of(values().flat_map(|band| [band.min * power, band.max * power]));
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
    names: &[&str],
    [width, panel_height]: [f64; 2],
    draw: impl FnOnce(&Area<'_>) -> Result<String, DrawError>,
) -> Result<String, DrawError> {
    let (legend, rows) = legend(names, width);
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

/// The legend in a width, and its rows.
fn legend(names: &[&str], room: f64) -> (String, u32) {
    /// Width that a letter of a name takes, on average, and that of a line sample with its gaps.
    const LETTER: f64 = 0.52 * TYPE;
    const SAMPLE: f64 = 22.0;
    const GAP: f64 = 6.0;
    const BETWEEN: f64 = 20.0;
    #[expect(clippy::cast_precision_loss, reason = "names are short")]
    let width = |name: &str| SAMPLE + GAP + LETTER * name.chars().count() as f64;
    let mut rows: Vec<(f64, Vec<usize>)> = Vec::new();
    for (index, name) in names.iter().enumerate() {
        match rows.last_mut().filter(|(used, _)| used + BETWEEN + width(name) <= room) {
            Some((used, row)) => {
                *used += BETWEEN + width(name);
                row.push(index);
            }
            None => rows.push((width(name), vec![index])),
        }
    }
    let mut out = format!("<g font-family=\"{FONT}\" font-size=\"{}\">", px(TYPE));
    let mut y = 0.5 * LEGEND;
    for (used, row) in &rows {
        let mut x = 0.5 * (room - used);
        for (index, name) in row.iter().filter_map(|&index| names.get(index).map(|n| (index, n))) {
            let stroke = stroke(index, 20);
            let _ = write!(
                out,
                "<path d=\"M{} {}h{}\" {stroke}/><text x=\"{}\" y=\"{}\" dy=\"0.32em\" \
                 fill=\"#1C1C1E\">{}</text>",
                px(x),
                px(y),
                px(SAMPLE),
                px(x + SAMPLE + GAP),
                px(y),
                symbol(name)
            );
            x += width(name) + BETWEEN;
        }
        y += LEGEND;
    }
    out.push_str("</g>\n");
    (out, u32::try_from(rows.len()).unwrap_or(1))
}

impl Line {
    /// As many bands as the picture can show, in runs without gaps.
    fn merged(&self) -> Vec<Vec<Band>> {
        let [of_line, of_band] = POINTS_MAX;
        let is_line = self.bands.len() <= of_line && self.bands.iter().all(|b| b.min == b.max);
        let size = if is_line { 1 } else { self.bands.len().div_ceil(of_band).max(1) };
        let mut runs = vec![Vec::new()];
        for column in self.bands.chunks(size) {
            let finite = || column.iter().filter(|b| b.min.is_finite() && b.max.is_finite());
            let Some(band) = finite().copied().reduce(Band::with) else {
                runs.push(Vec::new());
                continue;
            };
            let ends = [column.first(), column.last()];
            let time = ends.into_iter().flatten().map(|b| 0.5 * b.time).sum();
            if let Some(run) = runs.last_mut() {
                run.push(Band { time, ..band });
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
    let colour = COLOURS[index % COLOURS.len()];
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

/// The attributes of the nth curve's line.
pub(in crate::report) fn stroke(index: usize, width: u32) -> String {
    let colour = COLOURS[index % COLOURS.len()];
    let dash = DASHES[index % DASHES.len()];
    let dash =
        if dash.is_empty() { String::new() } else { format!(" stroke-dasharray=\"{dash}\"") };
    format!("fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\"{dash}")
}

/// A label with what follows its `_` lowered.
fn symbol(label: &str) -> String {
    match label.split_once('_') {
        None => escaped(label),
        Some((base, index)) => {
            let (base, index) = (escaped(base), escaped(index));
            format!("{base}<tspan dy=\"0.25em\" font-size=\"{}\">{index}</tspan>", px(0.75 * TYPE))
        }
    }
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
