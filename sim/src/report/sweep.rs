//! Pictures of a sweep: a number over a key, a map over two keys, lines over a key and frequency.

use super::draw::cells::{CellMap, MapAxis};
use super::draw::picture::Picture;
use super::draw::plane::Plane;
use super::number::{power_of_ten, short, with_unit};
use crate::campaign::{Axis, Spacing};
use crate::jitter::campbell::{Branch, Crossing, Oscillation};

/// A line is drawn in a waterfall from this share of the largest on.
const DOT_MIN: f64 = 5e-3;
/// Lines of orders end at this share of the highest line.
const BELOW_TITLE: f64 = 0.93;
/// A Campbell diagram goes up to this many times the highest order.
const CAMPBELL_TOP: f64 = 1.25;
/// A limit is drawn up to this many times the largest number.
pub(super) const LIMIT_SHOWN: f64 = 5.0;
/// Above the highest point of a picture.
const ABOVE: f64 = 1.06;

/// A number of each sample.
pub(crate) struct Numbers<'a> {
    /// What it is.
    pub(crate) name: &'a str,
    /// The unit in which it is shown, and its size in SI.
    pub(crate) unit: (&'a str, f64),
    /// SI; none of a sample that failed.
    pub(crate) values: &'a [Option<f64>],
    /// A limit, SI.
    pub(crate) limit: Option<f64>,
}

/// A value of an axis as it is drawn: its decadic logarithm where values have equal ratios.
fn place(axis: &Axis, value: f64) -> f64 {
    if axis.spacing == Spacing::Logarithmic { libm::log10(value) } else { value }
}

/// The key; of keys that are set together the first, and how many there are besides: an axis has no room for all.
fn short_key(axis: &Axis) -> String {
    let mut keys = axis.key.split('+').map(str::trim);
    let first = keys.next().unwrap_or_default();
    match keys.count() {
        0 => first.to_owned(),
        more => format!("{first} and {more} more"),
    }
}

/// The key with its unit.
fn key(axis: &Axis) -> String {
    let unit = if axis.unit.is_empty() { String::new() } else { format!(" ({})", axis.unit) };
    format!("{}{unit}", short_key(axis))
}

/// What [`place`] shows.
fn label(axis: &Axis) -> String {
    let word = if axis.spacing == Spacing::Logarithmic { "log10 of " } else { "" };
    format!("{word}{}", key(axis))
}

fn ends(axis: &Axis) -> Option<[f64; 2]> {
    let places = || axis.values.iter().map(|value| place(axis, *value));
    let (least, most) =
        (places().fold(f64::INFINITY, f64::min), places().fold(f64::NEG_INFINITY, f64::max));
    (least < most).then_some([least, most])
}

/// A unit, times a power of a thousand where that makes numbers short, and its size in SI.
pub(super) fn scaled(
    (unit, size): (&str, f64),
    values: impl Iterator<Item = f64>,
) -> (String, f64) {
    let most = values.map(f64::abs).filter(|value| value.is_finite()).fold(0.0, f64::max) / size;
    if most == 0.0 || (1e-2..1e5).contains(&most) {
        return (unit.to_owned(), size);
    }
    #[expect(
        clippy::cast_possible_truncation,
        reason = "an exponent of a finite number, -324 to 308"
    )]
    let power = 3 * (libm::log10(most) / 3.0).floor() as i32;
    let unit = format!("{} {unit}", power_of_ten(power));
    (unit.trim_end().to_owned(), size * libm::pow(10.0, f64::from(power)))
}

/// A number over the values of a key, with its limit.
pub(crate) fn curve(axis: &Axis, of: &Numbers<'_>) -> Picture {
    // A limit far away would leave no room for the numbers.
    let most = of.values.iter().flatten().map(|value| value.abs()).fold(0.0, f64::max);
    let near = of.limit.filter(|limit| *limit <= LIMIT_SHOWN * most);
    let (unit, size) = scaled(of.unit, of.values.iter().flatten().copied().chain(near));
    let title = match of.limit.filter(|_| near.is_none()) {
        Some(limit) => format!("{}, limit {}", of.name, with_unit(limit / size, 6, &unit)),
        None => of.name.to_owned(),
    };
    let points = axis.values.iter().zip(of.values);
    let mut points: Vec<[f64; 2]> = points
        .map(|(value, number)| [place(axis, *value), number.unwrap_or(f64::NAN) / size])
        .collect();
    points.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let mut curves = vec![("found".to_owned(), points)];
    if let (Some(limit), Some(ends)) = (near, ends(axis)) {
        curves.push(("limit".to_owned(), ends.map(|end| [end, limit / size]).to_vec()));
    }
    let finite = curves.iter().flat_map(|(_, points)| points).map(|point| point[1]);
    let most = finite.filter(|value| value.is_finite()).fold(0.0, f64::max);
    let y = (most > 0.0).then_some([0.0, ABOVE * most]);
    plane(
        format!("{} over {}, in {unit}.", of.name, axis.label()),
        title,
        [label(axis), format!("Value ({})", if unit.is_empty() { "1" } else { &unit })],
        [ends(axis), y],
        |plane| (plane.curves, plane.large) = (curves, true),
    )
}

/// A number over the values of two keys, the second one fastest: filled cells, the limit as a contour; crosses are samples
/// that failed.
pub(crate) fn map(axes: [&Axis; 2], of: &Numbers<'_>) -> Picture {
    let (unit, size) = scaled(of.unit, of.values.iter().flatten().copied());
    let [first, second] = axes;
    let map_axis = |axis: &Axis| MapAxis {
        label: key(axis),
        values: axis.values.clone(),
        logarithmic: axis.spacing == Spacing::Logarithmic,
    };
    let shown = if unit.is_empty() { "number".to_owned() } else { unit.clone() };
    Picture::Cells(CellMap {
        description: format!(
            "{} in {shown} over {} and {}; crosses are samples that failed.",
            of.name,
            first.label(),
            second.label()
        ),
        title: of.name.to_owned(),
        axes: [map_axis(first), map_axis(second)],
        numbers: of.values.iter().map(|number| number.map_or(f64::NAN, |n| n / size)).collect(),
        scale: unit,
        logarithmic: false,
        contours: of.limit.iter().map(|limit| ("limit".to_owned(), limit / size)).collect(),
    })
}

/// Lines, `[value of the key, frequency in Hz, amplitude in SI]`, and straight lines of the orders of a rate.
pub(crate) fn waterfall(
    axis: &Axis,
    column: &str,
    unit: &str,
    lines: &[[f64; 3]],
    orders: &[f64],
) -> Picture {
    let largest = lines.iter().map(|line| line[2]).fold(0.0, f64::max);
    let mut dots: Vec<[f64; 3]> = Vec::new();
    for [value, frequency, amplitude] in lines {
        if *amplitude > DOT_MIN * largest {
            dots.push([place(axis, *value), *frequency, amplitude / largest]);
        }
    }
    // Room above the highest line, so that orders reach it below the title.
    let top = dots.iter().map(|dot| dot[1]).fold(0.0, f64::max) / BELOW_TITLE;
    let order = |order: &f64| {
        // A straight line only over the rate itself.
        let ends = ends(axis).filter(|_| axis.spacing != Spacing::Logarithmic)?;
        let frequency = |value: f64| order * value.abs() * axis.size / std::f64::consts::TAU;
        let [from, to] = ends;
        // The label is at the end: below the title.
        let share = (BELOW_TITLE * top / frequency(to)).min(1.0);
        let end = if from >= 0.0 { to * share } else { to };
        let ends = [from, end.max(from)];
        let at = |value: f64| [value, frequency(value)];
        Some((format!("{}\u{d7}", short(*order, 4)), ends.map(at)))
    };
    let straight = orders.iter().filter_map(order).collect();
    let amplitude = with_unit(largest, 3, unit);
    plane(
        format!(
            "Lines of {column} over {} and frequency in Hz; the largest is {amplitude}.",
            axis.label()
        ),
        format!("{column}: lines, largest {amplitude}"),
        [label(axis), "Frequency f (Hz)".to_owned()],
        [ends(axis), (top > 0.0).then_some([0.0, ABOVE * top])],
        |plane| (plane.dots, plane.lines) = (dots, straight),
    )
}

/// Natural frequencies over the values of a key, rising, with the orders of a rate and where they cross.
pub(crate) fn campbell(
    axis: &Axis,
    values: &[f64],
    branches: &[Branch],
    orders: &[f64],
    crossings: &[Crossing],
) -> Picture {
    let hertz = |frequency: f64| frequency / std::f64::consts::TAU;
    let curve = |branch: &Branch| {
        let point = |(value, of): (&f64, &Option<Oscillation>)| {
            [place(axis, *value), of.map_or(f64::NAN, |of| hertz(of.frequency))]
        };
        values.iter().zip(&branch.points).map(point).collect::<Vec<_>>()
    };
    let curves: Vec<(String, Vec<[f64; 2]>)> =
        branches.iter().map(|branch| (String::new(), curve(branch))).collect();
    let all = curves.iter().flat_map(|(_, points)| points).map(|point| point[1]);
    let highest = all.filter(|value| value.is_finite()).fold(0.0, f64::max);
    // Where orders are drawn, a little above the highest of them, and never below the lowest one: natural frequencies of a
    // rigid hub are below all orders.
    let last = values.last().map_or(0.0, |value| hertz(value.abs() * axis.size));
    let [lowest, above_all] = [f64::min, f64::max]
        .map(|of| CAMPBELL_TOP * orders.iter().copied().reduce(of).unwrap_or(0.0) * last);
    let top = ABOVE * highest;
    let top = if orders.is_empty() { top } else { above_all.min(top).max(lowest) };
    let straight = |order: &f64| {
        let ends = ends(axis).filter(|_| axis.spacing != Spacing::Logarithmic)?;
        let frequency = |value: f64| hertz(order * value.abs() * axis.size);
        let share = (BELOW_TITLE * top / frequency(ends[1])).min(1.0);
        let end = if ends[0] >= 0.0 { (ends[1] * share).max(ends[0]) } else { ends[1] };
        let at = |value: f64| [value, frequency(value)];
        Some((format!("{}\u{d7}", short(*order, 4)), [at(ends[0]), at(end)]))
    };
    let lines = orders.iter().filter_map(straight).collect();
    let marks = crossings
        .iter()
        .map(|of| [place(axis, of.speed / axis.size), hertz(of.oscillation.frequency)])
        .collect();
    plane(
        format!("Natural frequencies in Hz over {}, with orders and crossings.", axis.label()),
        format!("Natural frequencies over {}", short_key(axis)),
        [label(axis), "Frequency f (Hz)".to_owned()],
        [ends(axis), (top > 0.0).then_some([0.0, top])],
        |plane| (plane.curves, plane.lines, plane.marks) = (curves, lines, marks),
    )
}

fn plane(
    description: String,
    title: String,
    axes: [String; 2],
    ranges: [Option<[f64; 2]>; 2],
    fill: impl FnOnce(&mut Plane),
) -> Picture {
    let (curves, lines, dots, marks) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    let (large, logarithmic) = (false, false);
    let mut plane =
        Plane { description, title, axes, curves, lines, dots, marks, large, logarithmic, ranges };
    fill(&mut plane);
    Picture::Plane(plane)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_that_are_set_together_have_one_name_on_an_axis() {
        let axis = |text: &str| Axis::parse(text).expect("an axis");
        assert_eq!(key(&axis("device.a.wheel.rate=600,700 rpm")), "device.a.wheel.rate (rpm)");
        let together =
            axis("device.a.wheel.rate+device.b.wheel.rate+device.c.wheel.rate=600,700 rpm");
        assert_eq!(key(&together), "device.a.wheel.rate and 2 more (rpm)");
    }
}
