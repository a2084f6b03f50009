//! [`DrawnLimit`]: the limit of a requirement in the chart of its column.
//!
//! Drawn are limits that every value within a window has to keep: on the largest magnitude, and of a column on the
//! departure from the first sample. Those on means, levels and the value at the end bound no value of a curve.

use super::chart::{Chart, ScaledChart};
use crate::record::Header;
use crate::report::number::short;
use crate::scenario::{Projection, Requirement, Statistic};

/// A limit further away than this many times the largest value leaves no room for the curves.
const SHOWN: f64 = 3.0;

/// A limit in the unit of a chart.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::report) struct DrawnLimit {
    /// In the legend: `limit of smear`.
    pub(in crate::report) label: String,
    /// With its unit, as it was written; in the unit of the chart, where it was written without one.
    pub(in crate::report) written: String,
    /// Where the lines are.
    pub(in crate::report) values: Vec<f64>,
    /// Where they begin and end, s.
    pub(in crate::report) window: [f64; 2],
}

/// Size, SI, of the unit in which the first limit on the columns of a chart is written.
pub(in crate::report) fn stated_unit(
    chart: &Chart,
    (requirements, header): (&[Requirement], &Header),
) -> Option<f64> {
    let is_of_chart = |of: &&Requirement| {
        let columns = header.quantity(&of.quantity).unwrap_or_default();
        chart.curves.iter().any(|curve| columns.contains(&curve.column))
    };
    requirements.iter().find(is_of_chart).map(|of| of.unit.1)
}

/// The limits of the columns of a chart, whose values at the start are `first`, SI.
pub(in crate::report) fn limits(
    (chart, drawn): (&Chart, &ScaledChart),
    (requirements, header): (&[Requirement], &Header),
    first: &[f64],
) -> Vec<DrawnLimit> {
    let own = requirements.iter().filter(|of| of.projection == Projection::None);
    let one = |of: &Requirement| {
        let columns = header.quantity(&of.quantity).ok()?;
        let shown = |column: &usize| {
            chart.curves.iter().any(|curve| curve.column == *column && !curve.departure)
        };
        let middle = match (of.statistic, columns.as_slice()) {
            (Statistic::Peak, _) => 0.0,
            (Statistic::Drift, [only]) if of.window[0] <= 0.0 => first.get(*only).copied()?,
            _ => return None,
        };
        columns.iter().any(shown).then(|| {
            let ends = [middle - of.limit, middle + of.limit];
            let [low, high] = ends.map(|end| end * drawn.unit.per_si);
            let values =
                || drawn.curves.iter().flat_map(|curve| curve.min.iter().chain(&curve.max));
            let middle = middle * drawn.unit.per_si;
            let below = values().any(|value| *value < middle);
            let above = values().any(|value| *value > middle) || !below;
            let sides = [(above, high), (below, low)];
            let written = if of.written.parse::<f64>().is_ok() {
                let value = short(of.limit * drawn.unit.per_si, 4);
                format!("{value} {}", drawn.unit.name).trim_end().to_owned()
            } else {
                of.written.clone()
            };
            DrawnLimit {
                label: format!("limit of {}", of.name),
                written,
                values: sides.into_iter().filter(|(is, _)| *is).map(|(_, value)| value).collect(),
                window: [of.window[0].max(drawn.start()), of.window[1].min(drawn.end)],
            }
        })
    };
    own.filter_map(one).collect()
}

impl DrawnLimit {
    /// The lines that leave room for values up to a magnitude.
    pub(in crate::report) fn near(&self, peak: f64) -> Vec<f64> {
        self.values.iter().copied().filter(|value| value.abs() <= SHOWN * peak).collect()
    }
}
