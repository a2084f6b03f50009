//! [`FittedLines`]: amplitudes of lines over speed, as measured and as fitted, with 95 % bands, as SVG; the
//! amplitude is logarithmic.

use std::fmt::Write as _;
use std::ops::Range;

use super::axes::{Space, axes, svg_file, title};
use super::curves::{ChartCurve, CurveAxis, CurveChart};
use super::figure::{ABOVE, Area, BELOW, PANEL, WIDTH, document, moves};
use super::legend::{Entry, Sample, colour, cross_at, cross_stroke, stroke};
use super::log_panel::{Scale, decades};
use super::ticks::{Axis, range_of};
use crate::report::error::DrawError;

/// Height of the panel by that of a figure of a run.
const HEIGHT: f64 = 1.4;
/// Decades below the largest amplitude that are shown.
const DECADES_MAX: f64 = 5.0;

/// Label of the horizontal axis.
const SPEED: &str = "Speed (rpm)";

/// Lines of one group.
#[derive(Clone, Debug)]
pub(crate) struct FittedLines {
    /// What the picture shows, for readers who cannot see it.
    pub(crate) description: String,
    /// The text above it.
    pub(crate) title: String,
    /// What the amplitude is, with its unit.
    pub(crate) axis: String,
    /// The lines.
    pub(crate) lines: Vec<FittedLine>,
}

/// One line.
#[derive(Clone, Debug)]
pub(crate) struct FittedLine {
    /// In the legend.
    pub(crate) name: String,
    /// Speed, rpm, and amplitude as measured.
    pub(crate) measured: Vec<[f64; 2]>,
    /// Speed, rpm, amplitude as fitted, and the ends of its interval.
    pub(crate) fitted: Vec<[f64; 4]>,
}

impl FittedLines {
    /// The picture as an SVG file of its own.
    pub(crate) fn file(&self) -> Result<String, DrawError> {
        svg_file(|style| self.document(style))
    }

    /// The picture as part of a page that turns its colours.
    pub(crate) fn inline(&self) -> Result<String, DrawError> {
        self.document("")
    }

    fn document(&self, style: &str) -> Result<String, DrawError> {
        let each = self.lines.iter().enumerate();
        let entries: Vec<_> = each
            .map(|(index, line)| Entry { name: &line.name, sample: Sample::Measured(index) })
            .collect();
        document(&self.description, style, &entries, [WIDTH, HEIGHT * PANEL], |panel| {
            self.draw(panel)
        })
    }

    /// The same for the script of a page.
    pub(in crate::report) fn chart(&self) -> CurveChart {
        let (x, y) = (self.speeds(), self.scale().range);
        let curves = self.lines.iter().map(|line| {
            let mut measured: Vec<_> =
                line.measured.iter().copied().filter(|point| positive(point[1])).collect();
            measured.sort_by(|a, b| a[0].total_cmp(&b[0]));
            let fitted = line.fitted.iter().map(|p| [p[0], p[1]]).collect();
            let interval = line.fitted.iter().map(|p| [p[2], p[3]]).collect();
            ChartCurve { interval, measured, ..ChartCurve::line(&line.name, fitted) }
        });
        CurveChart {
            title: self.title.clone(),
            axes: [
                CurveAxis::labelled(SPEED, false, Some([x.start, x.end])),
                CurveAxis::labelled(&self.axis, true, Some([y.start, y.end])),
            ],
            curves: curves.collect(),
        }
    }

    fn speeds(&self) -> Range<f64> {
        range_of(self.lines.iter().flat_map(|line| line.fitted.iter().map(|p| p[0])))
    }

    /// The vertical axis.
    fn scale(&self) -> Scale {
        let values = self.lines.iter().flat_map(|line| {
            line.measured.iter().map(|p| p[1]).chain(line.fitted.iter().map(|p| p[1]))
        });
        decades(values, DECADES_MAX)
    }

    fn draw(&self, area: &Area<'_>) -> Result<String, DrawError> {
        title(area, &self.title)?;
        let (x, axis) = (self.speeds(), self.scale());
        let y = axis.range.clone();
        let labels = [SPEED, self.axis.as_str()];
        let chart = axes(area, &Space { above: ABOVE, below: BELOW }, Axis(x), axis, labels)?;
        let place = |speed: f64, value: f64| {
            let (x, y) = chart.backend_coord(&(speed, value.clamp(y.start, y.end)));
            [x, y]
        };
        let mut out = String::new();
        for (index, line) in self.lines.iter().enumerate() {
            let shown: Vec<_> =
                line.fitted.iter().filter(|p| p.iter().all(|v| v.is_finite())).collect();
            let above = shown.iter().map(|p| place(p[0], p[3]));
            let below = shown.iter().rev().map(|p| place(p[0], p[2]));
            let band: Vec<_> = above.chain(below).collect();
            let fill = colour(index);
            let _ = writeln!(
                out,
                "<path d=\"{}z\" fill=\"{fill}\" fill-opacity=\"0.3\"/>",
                moves(&band)
            );
            let curve: Vec<_> = shown.iter().map(|p| place(p[0], p[1])).collect();
            let _ = writeln!(out, "<path d=\"{}\" {}/>", moves(&curve), stroke(index, 11));
            let mut marks = String::new();
            for [speed, value] in line.measured.iter().filter(|p| positive(p[1])) {
                marks.push_str(&cross_at(place(*speed, *value)));
            }
            let _ = writeln!(out, "<path d=\"{marks}\" {}/>", cross_stroke(index));
        }
        Ok(out)
    }
}

fn positive(value: f64) -> bool {
    value.is_finite() && value > 0.0
}
