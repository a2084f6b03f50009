//! [`legend`]: the names of curves above a figure, each with a piece of its line; colours, dashes and crosses of curves.

use std::fmt::Write as _;

use super::figure::{FONT, LEGEND, TYPE, escaped, px};

/// Colours of the curves in order; they repeat.
const COLOURS: [&str; 7] =
    ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#000000", "#E69F00", "#56B4E9"];
/// Dashes of the curves in order, tenths of a unit; they repeat.
const DASHES: [&str; 8] =
    ["", "80 30", "20 25", "90 30 20 30", "140 40", "40 40", "90 30 20 30 20 30", "50 20"];

/// Name of a curve that is a limit, and its dashes, tenths of a unit.
pub(super) const LIMIT: &str = "limit";
const LIMIT_DASH: &str = "60 30 10 30";
/// Length of a piece of a line.
const SAMPLE: f64 = 22.0;
/// Half the width of a cross, tenths of a unit.
const CROSS: i32 = 24;

/// What a legend says of a curve.
#[derive(Clone, Copy, Debug)]
pub(in crate::report) struct Entry<'a> {
    pub(super) name: &'a str,
    pub(super) sample: Sample,
}

/// How a curve is drawn, by its number.
#[derive(Clone, Copy, Debug)]
pub(in crate::report) enum Sample {
    /// As a line.
    Line(usize),
    /// As a line, and crosses where it was measured.
    Measured(usize),
    /// As limits are.
    Limit,
    /// As a cross of a sample that failed.
    Failed,
}

impl<'a> Entry<'a> {
    /// Curves in order; one named as limits are is a limit.
    pub(super) fn curves(names: impl Iterator<Item = &'a str>) -> Vec<Self> {
        let one = |(index, name): (usize, &'a str)| {
            let sample = if name == LIMIT { Sample::Limit } else { Sample::Line(index) };
            Self { name, sample }
        };
        names.enumerate().map(one).collect()
    }
}

impl Sample {
    /// A piece from a place to the right.
    fn draw(self, [x, y]: [i32; 2]) -> String {
        let line =
            |attributes: String| format!("<path d=\"M{x} {y}h{}\" {attributes}/>", px(SAMPLE));
        let middle = x + px(0.5 * SAMPLE);
        match self {
            Self::Line(index) => line(stroke(index, 20)),
            Self::Limit => line(limit_stroke(13)),
            Self::Measured(index) => {
                let cross = cross_at([middle, y]);
                line(stroke(index, 14)) + &format!("<path d=\"{cross}\" {}/>", cross_stroke(index))
            }
            Self::Failed => format!(
                "<path d=\"M{} {}l{d} {d}m-{d} 0l{d} -{d}\" fill=\"none\" stroke=\"#1C1C1E\" stroke-width=\"10\"/>",
                middle - CROSS,
                y - CROSS,
                d = 2 * CROSS
            ),
        }
    }
}

/// The legend in a width, and its rows.
pub(super) fn legend(entries: &[Entry<'_>], room: f64) -> (String, u32) {
    /// Width that a letter of a name takes, on average, and gaps.
    const LETTER: f64 = 0.52 * TYPE;
    const GAP: f64 = 6.0;
    const BETWEEN: f64 = 20.0;
    #[expect(clippy::cast_precision_loss, reason = "names are short")]
    let width = |name: &str| SAMPLE + GAP + LETTER * name.chars().count() as f64;
    let mut rows: Vec<(f64, Vec<usize>)> = Vec::new();
    for (index, Entry { name, .. }) in entries.iter().enumerate() {
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
        for Entry { name, sample } in row.iter().filter_map(|&index| entries.get(index)) {
            let _ = write!(
                out,
                "{}<text x=\"{}\" y=\"{}\" dy=\"0.32em\" fill=\"#1C1C1E\">{}</text>",
                sample.draw([px(x), px(y)]),
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

/// The attributes of the nth curve's line.
pub(super) fn stroke(index: usize, width: u32) -> String {
    let colour = colour(index);
    let dash = DASHES[index % DASHES.len()];
    let dash =
        if dash.is_empty() { String::new() } else { format!(" stroke-dasharray=\"{dash}\"") };
    format!("fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\"{dash}")
}

/// The attributes of the nth curve's line by its name: a limit is ink in every figure.
pub(super) fn stroke_of(name: &str, index: usize, width: u32) -> String {
    if name == LIMIT { limit_stroke(width) } else { stroke(index, width) }
}

/// The attributes of a limit's line.
pub(super) fn limit_stroke(width: u32) -> String {
    format!(
        "fill=\"none\" stroke=\"#1C1C1E\" stroke-width=\"{width}\" stroke-dasharray=\"{LIMIT_DASH}\""
    )
}

/// The path of a cross.
pub(super) fn cross_at([x, y]: [i32; 2]) -> String {
    let size = 2 * CROSS;
    format!("M{} {y}h{size}M{x} {}v{size}", x - CROSS, y - CROSS)
}

/// The attributes of the crosses of the nth curve.
pub(super) fn cross_stroke(index: usize) -> String {
    let line = stroke(index, 8);
    line.split(" stroke-dasharray").next().unwrap_or_default().to_owned()
}

/// The colour of the nth curve.
pub(super) fn colour(index: usize) -> &'static str {
    COLOURS[index % COLOURS.len()]
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
