//! [`Plane`]: curves, lines and dots over linear axes, or one that is logarithmic, as SVG, in the manner of [`Figure`](super::figure::Figure):
//! a quantity over the speed, a waterfall, a Campbell diagram.

use std::fmt::Write as _;
use std::ops::Range;

use super::axes::{Space, axes, svg_file, title};
use super::curves::{ChartCurve, CurveAxis, CurveChart};
use super::figure::{
    ABOVE, Area, BELOW, FONT, PANEL, TYPE_SMALL, WIDTH, document, escaped, moves, px,
};
use super::legend::{Entry, stroke, stroke_of};
use super::log_panel::{Scale, decades};
use super::ticks::{Axis, range_of};
use crate::report::error::DrawError;

/// Largest radius of a dot, and smallest that is drawn.
const RADII: [f64; 2] = [5.0, 0.35];
/// Radius of a circle.
const MARK: f64 = 3.5;
/// Width and height of a large picture.
const LARGE: [f64; 2] = [780.0, 480.0];
/// Places along a line at which its label is tried.
const LABEL_PLACES: i32 = 24;
/// Left, top, right and bottom, tenths of a unit.
type Rectangle = [i32; 4];
/// Most decades of a logarithmic axis.
const DECADES_MAX: f64 = 6.0;
/// Most points of a curve; of more, every nth and the largest between are drawn.
const POINTS_MAX: usize = 700;

/// Curves, dots and labelled lines.
#[derive(Clone, Debug)]
pub(crate) struct Plane {
    /// What the picture shows, for readers who cannot see it.
    pub(crate) description: String,
    /// The text above it.
    pub(crate) title: String,
    /// What the axes show, with their units.
    pub(crate) axes: [String; 2],
    /// Name in the legend, if it has one, and points of each curve; a point that is not finite interrupts it.
    pub(crate) curves: Vec<(String, Vec<[f64; 2]>)>,
    /// Straight lines through two points, thin, with a label at the second one.
    pub(crate) lines: Vec<(String, [[f64; 2]; 2])>,
    /// Dots: x, y, and the share of the largest radius' area.
    pub(crate) dots: Vec<[f64; 3]>,
    /// Open circles; of those that would overlap the first one is drawn.
    pub(crate) marks: Vec<[f64; 2]>,
    /// Whether it is as wide as a page, and higher.
    pub(crate) large: bool,
    /// Whether the vertical axis is logarithmic, for values over decades; what is not above zero is not drawn.
    pub(crate) logarithmic: bool,
    /// Ranges that are shown; those of everything without them.
    pub(crate) ranges: [Option<[f64; 2]>; 2],
}

impl Plane {
    /// The picture as an SVG file of its own.
    pub(crate) fn file(&self) -> Result<String, DrawError> {
        svg_file(|style| self.document(style))
    }

    /// The picture as part of a page that turns its colours.
    pub(crate) fn inline(&self) -> Result<String, DrawError> {
        self.document("")
    }

    fn document(&self, style: &str) -> Result<String, DrawError> {
        let names = self.curves.iter().map(|(name, _)| name.as_str());
        let entries = Entry::curves(names.filter(|name| !name.is_empty()));
        let size = if self.large { LARGE } else { [WIDTH, PANEL] };
        document(&self.description, style, &entries, size, |panel| self.draw(panel))
    }

    /// The same for the script of a page; none of a picture with dots, circles or curves without a name.
    pub(in crate::report) fn chart(&self) -> Option<CurveChart> {
        let named = self.curves.iter().all(|(name, _)| !name.is_empty());
        if !named || !self.dots.is_empty() || !self.marks.is_empty() {
            return None;
        }
        let scale = self.scale();
        let y = scale.as_ref().map_or_else(|| self.range(1), |scale| scale.range.clone());
        let [across, up] = self.axes.each_ref().map(String::as_str);
        let x = self.range(0);
        let curves =
            self.curves.iter().map(|(name, points)| ChartCurve::line(name, points.clone()));
        let straight = self.lines.iter().map(|(label, ends)| ChartCurve {
            limit: true,
            ..ChartCurve::line(label, ends.to_vec())
        });
        Some(CurveChart {
            title: self.title.clone(),
            axes: [
                CurveAxis::labelled(across, false, Some([x.start, x.end])),
                CurveAxis::labelled(up, scale.is_some(), Some([y.start, y.end])),
            ],
            curves: curves.chain(straight).collect(),
        })
    }

    fn range(&self, axis: usize) -> Range<f64> {
        if let Some(Some([from, to])) = self.ranges.get(axis) {
            return *from..*to;
        }
        let curves = self.curves.iter().flat_map(|(_, points)| points).map(|point| point[axis]);
        let dots = self.dots.iter().map(|dot| dot[axis]);
        let lines = self.lines.iter().flat_map(|(_, ends)| ends).map(|end| end[axis]);
        range_of(curves.chain(dots).chain(lines))
    }

    /// The vertical axis where it is logarithmic.
    fn scale(&self) -> Option<Scale> {
        let values = self.curves.iter().flat_map(|(_, points)| points).map(|point| point[1]);
        self.logarithmic.then(|| decades(values, DECADES_MAX))
    }

    fn draw(&self, area: &Area<'_>) -> Result<String, DrawError> {
        title(area, &self.title)?;
        let (x, scale) = (self.range(0), self.scale());
        let y = scale.as_ref().map_or_else(|| self.range(1), |scale| scale.range.clone());
        let labels = self.axes.each_ref().map(String::as_str);
        let space = Space { above: ABOVE, below: BELOW };
        let at: Box<dyn Fn([f64; 2]) -> (i32, i32)> = if let Some(scale) = scale {
            let chart = axes(area, &space, Axis(x.clone()), scale, labels)?;
            Box::new(move |[px, py]| chart.backend_coord(&(px, py)))
        } else {
            let chart = axes(area, &space, Axis(x.clone()), Axis(y.clone()), labels)?;
            Box::new(move |[px, py]| chart.backend_coord(&(px, py)))
        };
        let inside =
            |[px, py]: [f64; 2]| (x.start..=x.end).contains(&px) && (y.start..=y.end).contains(&py);
        let mut out = String::new();
        let mut labels: Vec<(&str, [[i32; 2]; 2])> = Vec::new();
        for (label, ends) in &self.lines {
            let Some(ends) = clipped(*ends, [&x, &y]) else { continue };
            let [from, to] = ends.map(|end| <[i32; 2]>::from(at(end)));
            let _ = writeln!(
                out,
                "<path d=\"{}\" fill=\"none\" stroke=\"#1C1C1E\" stroke-width=\"8\" stroke-opacity=\"0.6\"/>",
                moves(&[from, to])
            );
            labels.push((label, [from, to]));
        }
        for [dx, dy, share] in &self.dots {
            let radius = RADII[0] * share.max(0.0).sqrt();
            if radius < RADII[1] || !inside([*dx, *dy]) {
                continue;
            }
            let (cx, cy) = at([*dx, *dy]);
            let _ = writeln!(
                out,
                "<circle cx=\"{cx}\" cy=\"{cy}\" r=\"{}\" fill=\"#0072B2\" fill-opacity=\"0.55\"/>",
                px(radius)
            );
        }
        for (index, (name, points)) in self.curves.iter().enumerate() {
            // Curves without a name are of one kind.
            let line = if name.is_empty() { stroke(0, 9) } else { stroke_of(name, index, 13) };
            for run in thinned(points).split(|point| !point[1].is_finite()) {
                let placed: Vec<[i32; 2]> = run
                    .iter()
                    .filter(|point| inside(**point))
                    .map(|point| at(*point))
                    .map(|(x, y)| [x, y])
                    .collect();
                if !placed.is_empty() {
                    let _ = writeln!(out, "<path d=\"{}\" {}/>", moves(&placed), line);
                }
            }
        }
        let mut taken: Vec<Rectangle> = Vec::new();
        let radius = px(MARK);
        for mark in self.marks.iter().filter(|mark| inside(**mark)) {
            let (cx, cy) = at(*mark);
            let own = [cx - radius, cy - radius, cx + radius, cy + radius];
            if taken.iter().any(|other| overlap(&own, other)) {
                continue;
            }
            taken.push(own);
            let _ = writeln!(
                out,
                "<circle cx=\"{cx}\" cy=\"{cy}\" r=\"{radius}\" fill=\"none\" stroke=\"#D55E00\" stroke-width=\"12\"/>"
            );
        }
        let ((left, bottom), (right, top)) = (at([x.start, y.start]), at([x.end, y.end]));
        let frame = [left, top, right, bottom];
        for (label, ends) in labels {
            write_label(&mut out, label, ends, &frame, &mut taken);
        }
        Ok(out)
    }
}

/// Whether two rectangles have points in common.
fn overlap(a: &Rectangle, b: &Rectangle) -> bool {
    a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3]
}

/// The label of a line above it, at the place nearest to its second end at which it covers no other label and no circle;
/// none where there is no such place.
fn write_label(
    out: &mut String,
    label: &str,
    [from, to]: [[i32; 2]; 2],
    frame: &Rectangle,
    taken: &mut Vec<Rectangle>,
) {
    let size = 0.85 * TYPE_SMALL;
    let width = px(0.58 * size * crate::spectra::float(label.chars().count()) + 2.0);
    let height = px(size + 1.0);
    for step in 0..LABEL_PLACES {
        let along = |axis: usize| to[axis] + (from[axis] - to[axis]) * step / LABEL_PLACES;
        let (right, bottom) = (along(0) - px(2.0), along(1) - px(1.0));
        let own = [right - width, bottom - height, right, bottom];
        let within = own[0] >= frame[0] && own[1] >= frame[1];
        if !within || taken.iter().any(|other| overlap(&own, other)) {
            continue;
        }
        taken.push(own);
        let _ = writeln!(
            out,
            "<rect x=\"{}\" y=\"{}\" width=\"{width}\" height=\"{height}\" fill=\"#FFFFFF\" fill-opacity=\"0.8\"/>\
             <text x=\"{}\" y=\"{}\" text-anchor=\"end\" font-family=\"{FONT}\" font-size=\"{}\" fill=\"#1C1C1E\">{}</text>",
            own[0],
            own[1],
            right - px(1.0),
            bottom - px(2.5),
            px(size),
            escaped(label)
        );
        return;
    }
}

/// As many points as the picture can show; of each group the one with the largest ordinate.
fn thinned(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let size = points.len().div_ceil(POINTS_MAX).max(1);
    let largest = |group: &[[f64; 2]]| {
        let interrupted = group.iter().find(|point| !point[1].is_finite());
        let largest = group.iter().max_by(|a, b| a[1].total_cmp(&b[1]));
        interrupted.or(largest).copied()
    };
    points.chunks(size).filter_map(largest).collect()
}

/// The part of a straight line within the ranges.
fn clipped([from, to]: [[f64; 2]; 2], ranges: [&Range<f64>; 2]) -> Option<[[f64; 2]; 2]> {
    let (mut first, mut last) = (0.0_f64, 1.0_f64);
    for (axis, range) in ranges.into_iter().enumerate() {
        let length = to[axis] - from[axis];
        if length == 0.0 {
            if !(range.start..=range.end).contains(&from[axis]) {
                return None;
            }
            continue;
        }
        let ends = [(range.start - from[axis]) / length, (range.end - from[axis]) / length];
        first = first.max(ends[0].min(ends[1]));
        last = last.min(ends[0].max(ends[1]));
    }
    let at = |share: f64| [0, 1].map(|axis| from[axis] + share * (to[axis] - from[axis]));
    (first < last).then(|| [at(first), at(last)])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_end_at_the_frame() {
        let ranges = [&(0.0..2.0), &(0.0..1.0)];
        assert_eq!(clipped([[0.0, 0.0], [2.0, 4.0]], ranges), Some([[0.0, 0.0], [0.5, 1.0]]));
        assert_eq!(clipped([[0.0, 2.0], [2.0, 3.0]], ranges), None);
        assert_eq!(clipped([[0.0, 0.5], [2.0, 0.5]], ranges), Some([[0.0, 0.5], [2.0, 0.5]]));
    }

    #[test]
    fn a_peak_survives_thinning() {
        let points: Vec<_> =
            (0..10_000).map(|k| [f64::from(k), if k == 1234 { 5.0 } else { 1.0 }]).collect();
        let thinned = thinned(&points);
        assert!(thinned.len() <= POINTS_MAX && thinned.contains(&[1234.0, 5.0]));
    }
}
