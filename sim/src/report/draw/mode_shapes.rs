//! Mode shapes of a structure as SVG: a stick figure of the nodes for each mode, at rest and displaced, seen from
//! (1, 1, 1). The same bytes for the same structure.
//!
//! Lines join each node to the nearest one of those before it: a file of modes has no elements. The largest
//! displacement of a node is drawn as a fixed share of the structure's extent; rotations are not drawn.

use std::fmt::Write as _;

use nalgebra::{DVector, Vector3};

use super::figure::{FONT, THEME, TYPE, TYPE_SMALL, escaped};
use crate::report::number::short;
use crate::structure::{COORDINATES, Structure};

/// Modes that are drawn, at most; in a row.
pub(crate) const MODES_MAX: usize = 24;
const IN_ROW: usize = 3;
/// A panel: width, height, room for its title, around the figure.
const WIDTH: f64 = 190.0;
const HEIGHT: f64 = 170.0;
const TITLE: f64 = 22.0;
const MARGIN: f64 = 14.0;
/// Room for the axes, below.
const AXES: f64 = 30.0;
/// The largest displacement, of the largest distance of two nodes.
const SHARE: f64 = 0.2;
/// Cosine and sine of 30 degrees.
const ACROSS: [f64; 2] = [0.866_025_403_784_438_6, 0.5];
const INK: &str = "#1C1C1E";
const AT_REST: &str = "#9A9AA0";
const DISPLACED: &str = "#0072B2";

/// A point of the picture.
type Point = [f64; 2];

/// The picture of the first modes.
pub(crate) fn mode_shapes(structure: &Structure) -> String {
    let positions: Vec<_> = structure.nodes.iter().map(|node| node.position).collect();
    let links = links(&positions);
    let count = structure.modes.len().min(MODES_MAX);
    let rows = count.div_ceil(IN_ROW).max(1);
    let size = |count: usize, each: f64| (0..count).fold(2.0 * MARGIN, |sum: f64, _| sum + each);
    let (width, height) = (size(IN_ROW.min(count.max(1)), WIDTH), size(rows, HEIGHT) + AXES);
    let all = structure.modes.len();
    let name = if structure.name.is_empty() { "structure" } else { &structure.name };
    let title = escaped(&format!(
        "Mode shapes of {name}: {count} of {all}, nodes at rest grey, displaced blue, seen from (1, 1, 1)."
    ));
    let mut out = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
         <svg class=\"figure\" xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" width=\"{width}\" \
         height=\"{height}\" viewBox=\"0 0 {width} {height}\">\n<title>{title}</title>\n\
         <style>\n{THEME}</style>\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"#FFFFFF\"/>\n\
         <g font-family=\"{FONT}\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n"
    );
    let (mut x, mut y) = (MARGIN, MARGIN);
    for (index, mode) in structure.modes.iter().take(count).enumerate() {
        if index > 0 && index.is_multiple_of(IN_ROW) {
            (x, y) = (MARGIN, y + HEIGHT);
        }
        let hertz = short(mode.frequency / std::f64::consts::TAU, 4);
        let damping = short(100.0 * mode.damping, 3);
        let _ = writeln!(
            out,
            "<text x=\"{:.1}\" y=\"{:.1}\" font-size=\"{TYPE}\" fill=\"{INK}\" \
             text-anchor=\"middle\">{}: {hertz} Hz, {damping} %</text>",
            x + 0.5 * WIDTH,
            y + 0.7 * TITLE,
            index + 1
        );
        let shape = structure.shapes.column(index).into_owned();
        panel(&mut out, [x, y + TITLE], &positions, &shape, &links);
        x += WIDTH;
    }
    triad(&mut out, [MARGIN + 10.0, height - 10.0]);
    out.push_str("</g>\n</svg>\n");
    out
}

/// For each node but the first, the nearest one before it.
fn links(positions: &[Vector3<f64>]) -> Vec<[usize; 2]> {
    let nearest = |(index, position): (usize, &Vector3<f64>)| {
        let before = positions.iter().take(index).enumerate();
        let distance = |other: &Vector3<f64>| (other - position).norm_squared();
        let near = before.min_by(|(_, a), (_, b)| distance(a).total_cmp(&distance(b)));
        near.map(|(other, _)| [other, index])
    };
    positions.iter().enumerate().filter_map(nearest).collect()
}

/// A point as it is seen from (1, 1, 1), z upwards.
fn seen(p: &Vector3<f64>) -> Point {
    [(p.y - p.x) * ACROSS[0], (p.x + p.y) * ACROSS[1] - p.z]
}

/// The figure of one mode.
fn panel(
    out: &mut String,
    [left, top]: Point,
    positions: &[Vector3<f64>],
    shape: &DVector<f64>,
    links: &[[usize; 2]],
) {
    let moved: Vec<Vector3<f64>> = (0..positions.len())
        .map(|node| shape.fixed_rows::<3>(COORDINATES * node).into_owned())
        .collect();
    let distances = positions.iter().flat_map(|a| positions.iter().map(move |b| (a - b).norm()));
    let extent = distances.fold(0.0, f64::max);
    let extent = if extent > 0.0 { extent } else { 1.0 };
    let largest = moved.iter().map(Vector3::norm).fold(0.0, f64::max);
    let factor = if largest > 0.0 { SHARE * extent / largest } else { 0.0 };
    let at_rest: Vec<_> = positions.iter().map(seen).collect();
    let displaced: Vec<_> =
        positions.iter().zip(&moved).map(|(at, by)| seen(&(at + by * factor))).collect();
    let range = |axis: usize| {
        let all = || at_rest.iter().chain(&displaced).map(|point| point[axis]);
        (all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max))
    };
    let [across, down] = [range(0), range(1)];
    let room = [WIDTH - 2.0 * MARGIN, HEIGHT - TITLE - 2.0 * MARGIN];
    let scale = (room[0] / (across.1 - across.0).max(1e-3 * extent))
        .min(room[1] / (down.1 - down.0).max(1e-3 * extent));
    let place = |point: &Point| {
        let middle = |room: f64, (low, high): (f64, f64), at: f64| {
            MARGIN + 0.5 * room + (at - 0.5 * (low + high)) * scale
        };
        [left + middle(room[0], across, point[0]), top + middle(room[1], down, point[1])]
    };
    for (points, colour, width, radius) in
        [(&at_rest, AT_REST, 1.0, 1.8), (&displaced, DISPLACED, 1.6, 2.4)]
    {
        let mut path = String::new();
        for [from, to] in links {
            let ends = [points.get(*from), points.get(*to)].map(|point| point.map(place));
            if let [Some([x, y]), Some([u, v])] = ends {
                let _ = write!(path, "M{x:.1} {y:.1}L{u:.1} {v:.1}");
            }
        }
        for [x, y] in points.iter().map(place) {
            // A dot: a circle of two arcs.
            let _ = write!(
                path,
                "M{:.1} {y:.1}a{radius} {radius} 0 1 0 {} 0a{radius} {radius} 0 1 0 {} 0",
                x - radius,
                2.0 * radius,
                -2.0 * radius
            );
        }
        let _ = writeln!(
            out,
            "<path d=\"{path}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\"/>"
        );
    }
    if largest == 0.0 {
        let _ = writeln!(
            out,
            "<text x=\"{:.1}\" y=\"{:.1}\" font-size=\"{TYPE_SMALL}\" fill=\"{INK}\" \
             text-anchor=\"middle\">no translation of a node</text>",
            left + 0.5 * WIDTH,
            top + HEIGHT - TITLE - 4.0
        );
    }
}

/// The axes, in a corner.
fn triad(out: &mut String, [x, y]: Point) {
    let origin = [x + 8.0, y - 12.0];
    for (axis, name) in [Vector3::x(), Vector3::y(), Vector3::z()].iter().zip(["x", "y", "z"]) {
        let [u, v] = seen(axis).map(|along| 12.0 * along);
        let _ = writeln!(
            out,
            "<path d=\"M{:.1} {:.1}l{u:.1} {v:.1}\" stroke=\"{INK}\" stroke-width=\"0.8\"/>\
             <text x=\"{:.1}\" y=\"{:.1}\" font-size=\"9\" fill=\"{INK}\" \
             text-anchor=\"middle\">{name}</text>",
            origin[0],
            origin[1],
            origin[0] + 1.5 * u,
            origin[1] + 1.5 * v + 3.0
        );
    }
}
