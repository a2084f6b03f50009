//! The data block of the page: JSON with arrays of numbers in base64, as sim/report/DATA.md states.

use serde::Serialize;

use super::blocks::Section;
use super::curve_data::CurveData;
use super::error::ReportError;
use super::run::chart::ScaledChart;
use super::run::limits::DrawnLimit;
use super::run::replay::ReplayData;
use crate::record::Event;
use crate::scenario::Scenario;

/// Values that differ by a smaller share of themselves are stored less the first of them: singles have seven digits.
const OFFSET_SHARE: f64 = 1e-2;

/// The format that the page's script draws.
const FORMAT: u32 = 1;

#[derive(Serialize)]
struct Data<'a> {
    format: u32,
    name: &'a str,
    title: &'a str,
    time: String,
    end: f64,
    columns: Vec<ColumnData<'a>>,
    charts: Vec<ChartData<'a>>,
    events: Vec<EventData<'a>>,
    replay: Option<&'a ReplayData>,
    #[serde(flatten)]
    curves: CurveData<'a>,
}

#[derive(Serialize)]
struct ColumnData<'a> {
    name: &'a str,
    label: &'a str,
    unit: &'a str,
    frame: &'a str,
    min: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    max: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    first: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    offset: Option<f64>,
    #[serde(rename = "final", skip_serializing_if = "Option::is_none")]
    last: Option<f64>,
}

#[derive(Serialize)]
struct ChartData<'a> {
    id: String,
    title: &'a str,
    unit: &'a str,
    columns: Vec<usize>,
    log: bool,
    #[serde(rename = "static")]
    figure: String,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    limits: Vec<LimitData<'a>>,
}

#[derive(Serialize)]
struct LimitData<'a> {
    label: &'a str,
    written: &'a str,
    values: &'a [f64],
    from: f64,
    to: f64,
}

#[derive(Serialize)]
struct EventData<'a> {
    time: f64,
    text: &'a str,
}

impl<'a> LimitData<'a> {
    fn new(limit: &'a DrawnLimit) -> Self {
        let [from, to] = limit.window;
        Self { label: &limit.label, written: &limit.written, values: &limit.values, from, to }
    }
}

/// The data block of these charts, whose buckets start at `time`; `<` written as `\u003c`.
pub(super) fn data(
    scenario: &Scenario,
    time: &[f64],
    end: f64,
    drawn: &[ScaledChart],
    events: &[Event],
    replay: Option<&ReplayData>,
) -> Result<String, ReportError> {
    let mut columns = Vec::new();
    let mut charts = Vec::new();
    for chart in drawn {
        let first = columns.len();
        columns.extend(chart.curves.iter().map(|curve| {
            let offset = offset(curve.min.iter().chain(&curve.max).copied());
            let less = |values: &[f64]| -> String {
                let less = offset.unwrap_or(0.0);
                singles(&values.iter().map(|value| value - less).collect::<Vec<_>>())
            };
            let (min, max) = (less(&curve.min), less(&curve.max));
            let banded = max != min;
            ColumnData {
                name: &curve.curve.name,
                label: &curve.curve.label,
                unit: chart.unit.name,
                frame: &curve.curve.frame,
                max: banded.then_some(max),
                first: banded.then(|| less(&curve.first)),
                offset,
                min,
                last: curve.last.is_finite().then_some(curve.last),
            }
        }));
        charts.push(ChartData {
            id: format!("chart-{}", chart.slug),
            title: &chart.title,
            unit: chart.unit.name,
            columns: (first..columns.len()).collect(),
            log: false,
            figure: figure_id(chart),
            limits: chart.limits.iter().map(LimitData::new).collect(),
        });
    }
    let data = Data {
        format: FORMAT,
        name: &scenario.name,
        title: &scenario.title,
        time: doubles(time),
        end,
        columns,
        charts,
        events: events.iter().map(|Event { time, text }| EventData { time: *time, text }).collect(),
        replay,
        curves: CurveData::default(),
    };
    Ok(serde_json::to_string(&data)?.replace('<', "\\u003c"))
}

/// The data block of a page that is not of a run: the charts of its figures.
pub(super) fn of_curves(
    name: &str,
    title: &str,
    sections: &[Section],
) -> Result<String, ReportError> {
    let data = Data {
        format: FORMAT,
        name,
        title,
        time: doubles(&[]),
        end: 0.0,
        columns: Vec::new(),
        charts: Vec::new(),
        events: Vec::new(),
        replay: None,
        curves: CurveData::of_sections(sections),
    };
    Ok(serde_json::to_string(&data)?.replace('<', "\\u003c"))
}

/// What is taken off values whose differences singles would lose: the first of them; none where they differ by more.
fn offset(values: impl Iterator<Item = f64>) -> Option<f64> {
    let mut first = None;
    let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
    for value in values.filter(|value| value.is_finite()) {
        first.get_or_insert(value);
        (least, most) = (least.min(value), most.max(value));
    }
    first.filter(|first| *first != 0.0 && most - least < OFFSET_SHARE * first.abs())
}

/// The id of a chart's static figure.
pub(super) fn figure_id(chart: &ScaledChart) -> String {
    format!("figure-{}", chart.slug)
}

/// Doubles as base64 of little-endian numbers.
pub(super) fn doubles(values: &[f64]) -> String {
    base64(&values.iter().flat_map(|value| value.to_le_bytes()).collect::<Vec<_>>())
}

/// The same as singles.
#[expect(clippy::cast_possible_truncation, reason = "what is drawn has seven digits")]
pub(super) fn singles(values: &[f64]) -> String {
    base64(&values.iter().flat_map(|value| (*value as f32).to_le_bytes()).collect::<Vec<_>>())
}

/// RFC 4648, padded.
fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut out = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for three in bytes.chunks(3) {
        let byte = |index: usize| usize::from(three.get(index).copied().unwrap_or(0));
        let bits = byte(0) << 16 | byte(1) << 8 | byte(2);
        for index in 0..4 {
            let letter = LETTERS[bits >> (18 - 6 * index) & 63];
            out.push(if index <= three.len() { char::from(letter) } else { '=' });
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_values_that_hardly_differ_have_an_offset() {
        let of = |values: &[f64]| offset(values.iter().copied());
        assert_eq!(of(&[f64::NAN, 3000.0, 3_000.000_2]), Some(3000.0));
        assert_eq!(of(&[3000.0, 3100.0]), None);
        assert_eq!(of(&[0.0, 1e-9]), None);
        assert_eq!(of(&[]), None);
    }

    #[test]
    fn base64_is_that_of_rfc_4648() {
        let texts = ["", "f", "fo", "foo", "foob", "fooba", "foobar"];
        let expected = ["", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"];
        assert_eq!(texts.map(|text| base64(text.as_bytes())), expected);
    }
}
