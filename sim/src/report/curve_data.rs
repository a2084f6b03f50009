//! Charts over other axes than the time in the data block of a page, as sim/report/DATA.md states.

use serde::Serialize;

use super::blocks::{Block, Section};
use super::data::{doubles, singles};
use super::draw::curves::{ChartCurve, CurveAxis, CurveChart};

/// The horizontal axes, and the charts over them.
#[derive(Default, Serialize)]
pub(super) struct CurveData<'a> {
    axes: Vec<AxisData<'a>>,
    planes: Vec<PlaneData<'a>>,
}

#[derive(Serialize)]
struct AxisData<'a> {
    name: &'a str,
    unit: &'a str,
    log: bool,
    from: f64,
    to: f64,
}

#[derive(Serialize)]
struct PlaneData<'a> {
    id: String,
    title: &'a str,
    unit: &'a str,
    axis: usize,
    log: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    range: Option<[f64; 2]>,
    #[serde(rename = "static")]
    figure: &'a str,
    curves: Vec<CurveOfPlane<'a>>,
}

#[derive(Serialize)]
struct CurveOfPlane<'a> {
    label: &'a str,
    x: String,
    y: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    low: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    high: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    measured: Option<[String; 2]>,
    limit: bool,
}

impl<'a> CurveData<'a> {
    /// Those of the figures of some sections.
    pub(super) fn of_sections(sections: &'a [Section]) -> Self {
        let mut data = Self::default();
        for block in sections.iter().flat_map(|section| &section.blocks) {
            let Block::Figure { id, charts, .. } = block else { continue };
            for (number, chart) in charts.iter().enumerate() {
                data.add(id, number, chart);
            }
        }
        data
    }

    fn add(&mut self, figure: &'a str, number: usize, chart: &'a CurveChart) {
        let [across, up] = &chart.axes;
        let slug = figure.strip_prefix("figure-").unwrap_or(figure);
        let plane = PlaneData {
            id: if number == 0 {
                format!("chart-{slug}")
            } else {
                format!("chart-{slug}-{number}")
            },
            title: &chart.title,
            unit: &up.unit,
            axis: self.axis(across, &chart.curves),
            log: up.logarithmic,
            range: up.range,
            figure,
            curves: chart.curves.iter().map(CurveOfPlane::new).collect(),
        };
        self.planes.push(plane);
    }

    /// The number of an axis, which the charts over one quantity share: it is as long as the longest of theirs.
    fn axis(&mut self, of: &'a CurveAxis, curves: &[ChartCurve]) -> usize {
        let points = || curves.iter().flat_map(|curve| &curve.points).map(|point| point[0]);
        let ends = || [points().fold(f64::INFINITY, f64::min), points().fold(0.0, f64::max)];
        let [from, to] = of.range.unwrap_or_else(ends);
        let same = |axis: &AxisData<'_>| {
            (axis.name, axis.unit, axis.log) == (&of.name, &of.unit, of.logarithmic)
        };
        if let Some(index) = self.axes.iter().position(same) {
            if let Some(axis) = self.axes.get_mut(index) {
                (axis.from, axis.to) = (axis.from.min(from), axis.to.max(to));
            }
            return index;
        }
        self.axes.push(AxisData { name: &of.name, unit: &of.unit, log: of.logarithmic, from, to });
        self.axes.len() - 1
    }
}

impl<'a> CurveOfPlane<'a> {
    fn new(curve: &'a ChartCurve) -> Self {
        let parts = |points: &[[f64; 2]]| {
            let of = |axis: usize| points.iter().map(|point| point[axis]).collect::<Vec<_>>();
            [doubles(&of(0)), singles(&of(1))]
        };
        let [x, y] = parts(&curve.points);
        let ends = |end: usize| {
            let ends: Vec<f64> = curve.interval.iter().map(|interval| interval[end]).collect();
            (!ends.is_empty()).then(|| singles(&ends))
        };
        Self {
            label: &curve.label,
            x,
            y,
            low: ends(0),
            high: ends(1),
            measured: (!curve.measured.is_empty()).then(|| parts(&curve.measured)),
            limit: curve.limit,
        }
    }
}
