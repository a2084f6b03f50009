//! [`Plane`]: curves, lines and dots over linear axes as SVG, in the manner of [`Figure`](super::figure::Figure):
//! a quantity over the speed, a waterfall, a Campbell diagram.

use std::fmt::Write as _;
use std::ops::Range;

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::axes::{Space, axes, svg_file, title};
use super::figure::{
    ABOVE, Area, BELOW, INK, PANEL, TYPE_SMALL, document, moves, px, stroke, text,
};
use super::ticks::{Axis, range_of};
use crate::report::error::DrawError;

/// Largest radius of a dot, and smallest that is drawn.
const RADII: [f64; 2] = [5.0, 0.35];
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
    /// Open circles.
    pub(crate) marks: Vec<[f64; 2]>,
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
        let names: Vec<_> = names.filter(|name| !name.is_empty()).collect();
        document(&self.description, style, &names, PANEL, |panel| self.draw(panel))
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

    fn draw(&self, area: &Area<'_>) -> Result<String, DrawError> {
        title(area, &self.title)?;
        let [x, y] = [self.range(0), self.range(1)];
        let labels = self.axes.each_ref().map(String::as_str);
        let chart = axes(
            area,
            &Space { above: ABOVE, below: BELOW },
            Axis(x.clone()),
            Axis(y.clone()),
            labels,
        )?;
        let at = |[px, py]: [f64; 2]| chart.backend_coord(&(px, py));
        let inside =
            |[px, py]: [f64; 2]| (x.start..=x.end).contains(&px) && (y.start..=y.end).contains(&py);
        let mut out = String::new();
        for (label, ends) in &self.lines {
            let Some([from, to]) = clipped(*ends, [&x, &y]) else { continue };
            let ([x0, y0], [x1, y1]) = ([at(from).0, at(from).1], [at(to).0, at(to).1]);
            let _ = writeln!(
                out,
                "<path d=\"M{x0} {y0}L{x1} {y1}\" fill=\"none\" stroke=\"#1C1C1E\" \
                 stroke-width=\"5\" stroke-opacity=\"0.45\"/>"
            );
            let style = text(0.85 * TYPE_SMALL, INK).pos(Pos::new(HPos::Right, VPos::Bottom));
            chart.plotting_area().draw(
                &(EmptyElement::at((to[0], to[1]))
                    + Text::new(label.clone(), (px(-2.0), px(-1.0)), style)),
            )?;
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
        for (index, (_, points)) in self.curves.iter().enumerate() {
            for run in thinned(points).split(|point| !point[1].is_finite()) {
                let placed: Vec<[i32; 2]> = run
                    .iter()
                    .filter(|point| inside(**point))
                    .map(|point| at(*point))
                    .map(|(x, y)| [x, y])
                    .collect();
                if !placed.is_empty() {
                    let _ = writeln!(out, "<path d=\"{}\" {}/>", moves(&placed), stroke(index, 13));
                }
            }
        }
        for mark in self.marks.iter().filter(|mark| inside(**mark)) {
            let (cx, cy) = at(*mark);
            let _ = writeln!(
                out,
                "<circle cx=\"{cx}\" cy=\"{cy}\" r=\"{}\" fill=\"none\" stroke=\"#D55E00\" stroke-width=\"12\"/>",
                px(3.5)
            );
        }
        Ok(out)
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
