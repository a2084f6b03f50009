//! [`CellMap`]: a number over two parameters as SVG: a filled cell for each pair of values, a scale of colours, contours.
//!
//! Contours are of the number, or of its logarithm where the scale is logarithmic.

mod colours;
mod contour;

use std::fmt::Write as _;
use std::ops::Range;

use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};

use self::colours::colour;
use self::contour::segments;
use super::axes::{Space, axes, svg_file, title};
use super::figure::{ABOVE, Area, BELOW, FONT, PANEL, TYPE_SMALL, WIDTH, document, escaped, px};
use super::legend::{Entry, Sample};
use super::log_panel::{Kind, Scale};
use super::scale_bar::{SCALE_WIDTH, ScaleBar};
use super::ticks::{Axis, ticks};
use crate::report::error::DrawError;
use crate::report::number::short;

/// Height of the panel by that of a figure of a run.
const HEIGHT: f64 = 1.5;
/// Steps of the scale.
const STEPS: u32 = 64;
/// Decades that a logarithmic scale shows, below the largest number.
const DECADES_MAX: f64 = 6.0;

/// An axis of a map.
#[derive(Clone, Debug, PartialEq)]
pub struct MapAxis {
    /// What it shows, with its unit.
    pub label: String,
    /// The values, each once; all above zero on a logarithmic axis.
    pub values: Vec<f64>,
    /// Whether the axis is logarithmic.
    pub logarithmic: bool,
}

/// A number over two parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct CellMap {
    /// What the picture shows, for readers who cannot see it.
    pub description: String,
    /// The text above it.
    pub title: String,
    /// To the right, and upwards.
    pub axes: [MapAxis; 2],
    /// The numbers, the second axis fastest; one that is not finite is a cross.
    pub numbers: Vec<f64>,
    /// What the scale of colours shows, with its unit.
    pub scale: String,
    /// Whether that is logarithmic.
    pub logarithmic: bool,
    /// Name and number of each contour.
    pub contours: Vec<(String, f64)>,
}

/// A coordinate of a picture.
enum Coordinate {
    Linear(Axis),
    Logarithmic(Scale),
}

impl Ranged for Coordinate {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, limit: (i32, i32)) -> i32 {
        match self {
            Self::Linear(axis) => axis.map(value, limit),
            Self::Logarithmic(scale) => scale.map(value, limit),
        }
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        match self {
            Self::Linear(axis) => axis.key_points(hint),
            Self::Logarithmic(scale) => scale.key_points(hint),
        }
    }

    fn range(&self) -> Range<f64> {
        match self {
            Self::Linear(axis) => axis.range(),
            Self::Logarithmic(scale) => scale.range(),
        }
    }
}

impl ValueFormatter<f64> for Coordinate {
    fn format_ext(&self, value: &f64) -> String {
        match self {
            Self::Linear(axis) => axis.format_ext(value),
            Self::Logarithmic(scale) => scale.format_ext(value),
        }
    }
}

impl MapAxis {
    /// Numbers of the values, by rising value.
    fn order(&self) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.values.len()).collect();
        order.sort_by(|a, b| self.values[*a].total_cmp(&self.values[*b]));
        order
    }

    /// The ends of the cells of rising values: halfway between them.
    fn edges(&self, rising: &[f64]) -> Vec<f64> {
        let to = |value: f64| if self.logarithmic { value.log10() } else { value };
        let back = |value: f64| if self.logarithmic { 10_f64.powf(value) } else { value };
        let places: Vec<f64> = rising.iter().copied().map(to).collect();
        let halves: Vec<f64> = places.windows(2).map(|pair| 0.5 * (pair[1] - pair[0])).collect();
        let (Some(first), Some(last)) = (places.first(), places.last()) else { return Vec::new() };
        let usual = if self.logarithmic { 0.1 } else { 0.5 * first.abs().max(1.0) };
        let (before, after) =
            (halves.first().copied().unwrap_or(usual), halves.last().copied().unwrap_or(usual));
        let middles = places.iter().zip(&halves).map(|(place, half)| place + half);
        let ends = std::iter::once(first - before).chain(middles).chain([last + after]);
        ends.map(back).collect()
    }

    fn coordinate(&self, edges: &[f64]) -> Coordinate {
        let range = match (edges.first(), edges.last()) {
            (Some(from), Some(to)) if from < to => *from..*to,
            _ => 1.0..10.0,
        };
        if self.logarithmic {
            let decades = (range.end / range.start).log10();
            let kind = if decades > 3.0 { Kind::Powers } else { Kind::Plain };
            Coordinate::Logarithmic(Scale { range, kind })
        } else {
            Coordinate::Linear(Axis(range))
        }
    }
}

impl CellMap {
    /// The picture as an SVG file of its own.
    ///
    /// # Errors
    /// As the drawing library.
    pub fn file(&self) -> Result<String, DrawError> {
        svg_file(|style| self.document(style))
    }

    /// The picture as part of a page that turns its colours.
    pub(crate) fn inline(&self) -> Result<String, DrawError> {
        self.document("")
    }

    fn document(&self, style: &str) -> Result<String, DrawError> {
        let size = [WIDTH, HEIGHT * PANEL];
        let failed = self.numbers.iter().any(|number| !number.is_finite());
        let entry = Entry { name: "failed", sample: Sample::Failed };
        let entries = if failed { &[entry][..] } else { &[] };
        document(&self.description, style, entries, size, |panel| self.draw(panel))
    }

    /// Numbers that the scale of colours shows.
    fn range(&self) -> Range<f64> {
        let finite = || self.numbers.iter().copied().filter(|number| number.is_finite());
        let most = finite().fold(f64::NEG_INFINITY, f64::max);
        let positive = finite().filter(|number| *number > 0.0 || !self.logarithmic);
        let least = positive.fold(f64::INFINITY, f64::min);
        if self.logarithmic {
            let most = if most > 0.0 { most } else { 1.0 };
            let least = least.min(most).max(most * 10_f64.powf(-DECADES_MAX));
            return if least < most { least..most } else { 0.1 * most..most };
        }
        // A scale of one sign begins at zero.
        let least = if least > 0.0 { 0.0 } else { least };
        if least < most { least..most } else { 0.0..1.0 }
    }

    /// Where a number is on the scale of colours, zero to one.
    fn share(&self, number: f64) -> f64 {
        let Range { start, end } = self.range();
        let share = if self.logarithmic {
            (number.max(start) / start).ln() / (end / start).ln()
        } else {
            (number - start) / (end - start)
        };
        share.clamp(0.0, 1.0)
    }

    fn draw(&self, area: &Area<'_>) -> Result<String, DrawError> {
        title(area, &self.title)?;
        let orders = self.axes.each_ref().map(MapAxis::order);
        let rising: [Vec<f64>; 2] = std::array::from_fn(|k| {
            orders[k].iter().map(|index| self.axes[k].values[*index]).collect()
        });
        let edges: [Vec<f64>; 2] = std::array::from_fn(|k| self.axes[k].edges(&rising[k]));
        let [x, y] = [0, 1].map(|k| self.axes[k].coordinate(&edges[k]));
        let (plot, _) = area.split_horizontally(px(WIDTH - SCALE_WIDTH));
        let labels = self.axes.each_ref().map(|axis| axis.label.as_str());
        let chart = axes(&plot, &Space { above: ABOVE, below: BELOW }, x, y, labels)?;
        let at = |x: f64, y: f64| chart.backend_coord(&(x, y));
        let count = self.axes[1].values.len();
        let grid: Vec<Vec<f64>> = orders[0]
            .iter()
            .map(|a| {
                let number = |b: &usize| self.numbers.get(a * count + b).copied();
                orders[1].iter().map(|b| number(b).unwrap_or(f64::NAN)).collect()
            })
            .collect();
        let mut out = String::new();
        for (numbers, x) in grid.iter().zip(edges[0].windows(2)) {
            for (number, y) in numbers.iter().zip(edges[1].windows(2)) {
                let ((x1, y1), (x2, y2)) = (at(x[0], y[1]), at(x[1], y[0]));
                if number.is_finite() {
                    let fill = colour(self.share(*number));
                    // A seam of its own colour: edges between cells would show.
                    let _ = writeln!(
                        out,
                        "<path d=\"M{x1} {y1}H{x2}V{y2}H{x1}z\" fill=\"{fill}\" stroke=\"{fill}\" stroke-width=\"4\"/>"
                    );
                } else {
                    let (cx, cy, r) = (i32::midpoint(x1, x2), i32::midpoint(y1, y2), px(3.0));
                    let _ = writeln!(
                        out,
                        "<path d=\"M{} {}l{d} {d}M{} {}l{d} -{d}\" fill=\"none\" stroke=\"#1C1C1E\" stroke-width=\"10\"/>",
                        cx - r,
                        cy - r,
                        cx - r,
                        cy + r,
                        d = 2 * r
                    );
                }
            }
        }
        for (name, level) in &self.contours {
            self.contour(&mut out, &grid, &rising, (name, *level), &at);
        }
        self.bar(
            &mut out,
            at(edges[0].last().copied().unwrap_or(1.0), 0.0).0,
            [
                at(0.0, edges[1].last().copied().unwrap_or(1.0)).1,
                at(0.0, edges[1].first().copied().unwrap_or(0.0)).1,
            ],
        );
        Ok(out)
    }

    /// A contour, dark on a light seam, and its name at its right end.
    fn contour(
        &self,
        out: &mut String,
        grid: &[Vec<f64>],
        rising: &[Vec<f64>; 2],
        (name, level): (&str, f64),
        at: &dyn Fn(f64, f64) -> (i32, i32),
    ) {
        let to = |number: f64| {
            if self.logarithmic { number.max(f64::MIN_POSITIVE).ln() } else { number }
        };
        let place = |i: usize, j: usize| {
            let (x, y) = at(rising[0][i], rising[1][j]);
            [f64::from(x), f64::from(y)]
        };
        let above: Vec<Vec<f64>> = grid
            .iter()
            .map(|column| column.iter().map(|number| to(*number) - to(level)).collect())
            .collect();
        let segments = segments(&above, &place);
        if segments.is_empty() {
            return;
        }
        let mut path = String::new();
        for [from, to] in &segments {
            let _ = write!(path, "M{:.0} {:.0}L{:.0} {:.0}", from[0], from[1], to[0], to[1]);
        }
        for (colour, width) in [("#FEFEFE", 26), ("#010101", 11)] {
            let _ = writeln!(
                out,
                "<path d=\"{path}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\" stroke-linecap=\"round\"/>"
            );
        }
        let ends = segments.iter().flatten();
        if let Some([x, y]) = ends.copied().max_by(|a, b| a[0].total_cmp(&b[0])) {
            let _ = writeln!(
                out,
                "<text x=\"{:.0}\" y=\"{:.0}\" text-anchor=\"end\" font-family=\"{FONT}\" font-size=\"{}\" \
                 paint-order=\"stroke\" stroke=\"#FEFEFE\" stroke-width=\"34\" fill=\"#010101\">{}</text>",
                x - f64::from(px(3.0)),
                y - f64::from(px(4.0)),
                px(TYPE_SMALL),
                escaped(name)
            );
        }
    }

    /// The scale of colours right of the axes, from the top to the bottom of them.
    fn bar(&self, out: &mut String, right: i32, [top, bottom]: [i32; 2]) {
        let range = self.range();
        let step = |step: u32| {
            let fill = colour((f64::from(step) + 0.5) / f64::from(STEPS));
            format!("fill=\"{fill}\" stroke=\"{fill}\" stroke-width=\"3\"")
        };
        let marks = if self.logarithmic {
            let kind = Kind::Powers;
            let scale = Scale { range, kind };
            scale.key_points(plotters::coord::ranged1d::BoldPoints(9))
        } else {
            ticks(&range)
        };
        let marks = marks.into_iter().map(|mark| (self.share(mark), short(mark, 3))).collect();
        let bar = ScaleBar { steps: (0..STEPS).map(step).collect(), marks, label: &self.scale };
        bar.draw(out, right, [top, bottom]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_map_has_cells_contour_and_scale() {
        let axis = |label: &str, logarithmic| MapAxis {
            label: label.to_owned(),
            values: vec![3.0, 1.0, 2.0],
            logarithmic,
        };
        let map = CellMap {
            description: "x".to_owned(),
            title: "y".to_owned(),
            axes: [axis("a", false), axis("b", true)],
            // By the second axis: 3, 1, 2 as values.
            numbers: vec![9.0, 3.0, 6.0, 3.0, 1.0, 2.0, f64::NAN, 2.0, 4.0],
            scale: "c (rad)".to_owned(),
            logarithmic: false,
            contours: vec![("limit".to_owned(), 2.5)],
        };
        let svg = map.file().expect("drawn");
        for part in ["limit</text>", "c (rad)</text>", "#FEE838", "l60 60M"] {
            assert!(svg.contains(part), "{part}: {svg}");
        }
    }
}
