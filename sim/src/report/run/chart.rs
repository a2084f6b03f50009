//! [`Chart`]: the columns of one picture; [`ScaledChart`]: their values in the unit of the picture.

use super::limits::DrawnLimit;
use super::wraps::interrupt;
use crate::record::Bucket;
use crate::report::draw::figure::{Band, Figure, LimitLine, Line};
use crate::report::unit::{Family, Unit, for_peak, of_size};

/// Curves that are apart by no more than this share of the range of a figure, a fifth of a line's width, are seen as one.
const APART_MIN: f64 = 2e-3;

/// Curves that share axes.
#[derive(Clone, Debug)]
pub(in crate::report) struct Chart {
    /// The section of the page that it belongs to.
    pub(in crate::report) part: Part,
    /// For names of files and ids: lower case, digits, hyphens.
    pub(in crate::report) slug: String,
    /// What it shows.
    pub(in crate::report) title: String,
    /// What the vertical axis shows.
    pub(in crate::report) axis: &'static str,
    /// The units it may have.
    pub(in crate::report) family: &'static Family,
    /// By what a curve changes from one sample to the next only where it jumps, SI; none of curves that do not.
    pub(in crate::report) jump: Option<f64>,
    /// The curves, at least one.
    pub(in crate::report) curves: Vec<Curve>,
}

/// A section of the page with charts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::report) enum Part {
    /// Motion and motors.
    Histories,
    /// What is conserved.
    Energy,
    /// Forces and moments across joints.
    Loads,
}

/// A curve: one column.
#[derive(Clone, Debug)]
pub(in crate::report) struct Curve {
    /// Index of the column in a sample.
    pub(in crate::report) column: usize,
    /// Its name in files.
    pub(in crate::report) name: String,
    /// Its symbol, `_` before a subscript.
    pub(in crate::report) label: String,
    /// The axes that it is a component in; empty for a scalar.
    pub(in crate::report) frame: String,
    /// Whether the value at the start is taken off.
    pub(in crate::report) departure: bool,
}

/// A chart with its values.
#[derive(Clone, Debug)]
pub(in crate::report) struct ScaledChart {
    /// As in [`Chart`].
    pub(in crate::report) part: Part,
    /// As in [`Chart`].
    pub(in crate::report) slug: String,
    /// As in [`Chart`].
    pub(in crate::report) title: String,
    /// As in [`Chart`].
    pub(in crate::report) axis: &'static str,
    /// Of all values below.
    pub(in crate::report) unit: Unit,
    /// Start of each bucket, s.
    pub(in crate::report) time: Vec<f64>,
    /// End of the last one, s.
    pub(in crate::report) end: f64,
    /// The curves.
    pub(in crate::report) curves: Vec<DrawnCurve>,
    /// Limits of requirements on them.
    pub(in crate::report) limits: Vec<DrawnLimit>,
}

/// The values of a curve.
#[derive(Clone, Debug)]
pub(in crate::report) struct DrawnCurve {
    /// As in [`Curve`].
    pub(in crate::report) curve: Curve,
    /// Least value of each bucket.
    pub(in crate::report) min: Vec<f64>,
    /// Greatest value of each bucket.
    pub(in crate::report) max: Vec<f64>,
    /// The first sample of each bucket.
    pub(in crate::report) first: Vec<f64>,
    /// The last value.
    pub(in crate::report) last: f64,
}

/// A chart with the values of buckets of samples, and of the first and last sample; in the unit of the size `stated`, SI,
/// where there is one that its values are readable in.
pub(in crate::report) fn drawn(
    chart: &Chart,
    buckets: &[Bucket],
    [first, last]: [&[f64]; 2],
    stated: Option<f64>,
) -> ScaledChart {
    let of = |row: &[f64], index: usize| row.get(index).copied().unwrap_or(f64::NAN);
    let offset = |curve: &Curve| if curve.departure { of(first, curve.column) } else { 0.0 };
    let mut peak = 0.0_f64;
    for curve in &chart.curves {
        for bucket in buckets {
            let low = of(&bucket.min, curve.column) - offset(curve);
            let high = of(&bucket.max, curve.column) - offset(curve);
            peak = peak.max(low.abs()).max(high.abs());
        }
    }
    let stated = stated.and_then(|size| of_size(chart.family, size, peak));
    let unit = stated.unwrap_or_else(|| for_peak(chart.family, peak));
    let curves = chart.curves.iter().map(|curve| {
        let read = |value: f64| (value - offset(curve)) * unit.per_si;
        DrawnCurve {
            min: buckets.iter().map(|bucket| read(of(&bucket.min, curve.column))).collect(),
            max: buckets.iter().map(|bucket| read(of(&bucket.max, curve.column))).collect(),
            first: buckets.iter().map(|bucket| read(of(&bucket.first, curve.column))).collect(),
            last: read(of(last, curve.column)),
            curve: curve.clone(),
        }
    });
    let mut curves: Vec<DrawnCurve> = curves.collect();
    if let Some(jump) = chart.jump {
        interrupt(&mut curves, jump * unit.per_si);
    }
    ScaledChart {
        part: chart.part,
        slug: chart.slug.clone(),
        title: chart.title.clone(),
        axis: chart.axis,
        unit,
        time: buckets.iter().map(|bucket| bucket.start).collect(),
        end: buckets.last().map_or(0.0, |bucket| bucket.end),
        curves,
        limits: Vec::new(),
    }
}

impl ScaledChart {
    /// Whether every value is zero.
    pub(in crate::report) fn is_zero(&self) -> bool {
        self.curves.iter().all(|curve| curve.min.iter().chain(&curve.max).all(|v| *v == 0.0))
    }

    /// Start of the first bucket, s.
    pub(in crate::report) fn start(&self) -> f64 {
        self.time.first().copied().unwrap_or(0.0)
    }

    /// The largest magnitude.
    pub(in crate::report) fn peak(&self) -> f64 {
        let all = self.curves.iter().flat_map(|curve| curve.min.iter().chain(&curve.max));
        all.map(|value| value.abs()).filter(|size| size.is_finite()).fold(0.0, f64::max)
    }

    /// Labels of the curves that lie on one another in its figure, in groups of two or more.
    pub(in crate::report) fn equal(&self) -> Vec<Vec<String>> {
        let all = || self.curves.iter().flat_map(|curve| curve.min.iter().chain(&curve.max));
        let [least, most] =
            [f64::min, f64::max].map(|of| all().copied().reduce(of).unwrap_or_default());
        let seen = APART_MIN * (most - least);
        let near = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() <= seen);
        let mut groups: Vec<Vec<&DrawnCurve>> = Vec::new();
        for curve in &self.curves {
            let same = |group: &&mut Vec<&DrawnCurve>| {
                group
                    .first()
                    .is_some_and(|of| near(&of.min, &curve.min) && near(&of.max, &curve.max))
            };
            match groups.iter_mut().find(same) {
                Some(group) => group.push(curve),
                None => groups.push(vec![curve]),
            }
        }
        groups.retain(|group| group.len() > 1);
        let label = |curve: &&DrawnCurve| curve.curve.label.replace('_', " ");
        groups.iter().map(|group| group.iter().map(label).collect()).collect()
    }

    /// Its static figure.
    pub(in crate::report) fn figure(&self) -> Figure {
        let starts = &self.time;
        let ends = starts.iter().skip(1).chain([&self.end]);
        let middles: Vec<f64> = starts.iter().zip(ends).map(|(a, b)| 0.5 * (a + b)).collect();
        let lines = self.curves.iter().map(|curve| {
            let pairs = || curve.min.iter().zip(&curve.max);
            let is_band = pairs().any(|(min, max)| min != max && !min.is_nan());
            let times = if is_band { &middles } else { starts };
            let values = times.iter().zip(pairs());
            let bands = values.map(|(time, (min, max))| Band { time: *time, min: *min, max: *max });
            Line { name: curve.curve.label.clone(), bands: bands.collect() }
        });
        let peak = self.peak();
        let limits = self.limits.iter().map(|limit| LimitLine {
            name: limit.label.clone(),
            values: limit.near(peak),
            window: limit.window,
        });
        let mut described = self.title.clone();
        if !self.unit.name.is_empty() {
            described = format!("{described}, in {}", self.unit.name);
        }
        Figure {
            description: format!("{described}, over the time in s."),
            title: self.title.clone(),
            axis: self.axis,
            unit: self.unit.name,
            span: [self.start(), self.end],
            lines: lines.collect(),
            limits: limits.collect(),
        }
    }
}
