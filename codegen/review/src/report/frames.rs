//! The frames of a chain, drawn: origins, axes, arms, centres of mass and joint angles, placed by
//! the derivation's own rotations and positions.

use std::fmt::Write as _;

use precess_codegen::derivation::chain::Chain;
use precess_codegen::derivation::reference::{BodyInHub, bodies};
use precess_codegen::graph::Expr;
use precess_codegen::kinds::Centre;

/// Joint angles of the drawing, rad: each turn is to be seen, none hides an axis.
const ANGLES: [f64; 3] = [0.7, 0.9, 0.75];
/// Arms to the next origin, in the parent body's axes: wide enough apart for labels.
const ARMS: [[f64; 3]; 3] = [[-0.1, 1.35, 0.4], [-0.3, 1.3, 0.3], [0.3, 1.45, 0.75]];
/// Centres of mass, in own axes.
const CENTRE: [f64; 3] = [0.25, -0.45, -0.4];
/// The wheel's centre of mass on its axis.
const OFFSET: f64 = 0.42;
/// Length of a drawn axis.
const AXIS: f64 = 0.62;
/// Classes of the frames, hub first.
const CLASSES: [&str; 4] = ["hub", "outer", "inner", "wheel"];

type Point = [f64; 3];

/// The drawing as SVG.
pub(super) fn drawing(chain: &Chain<'_>) -> String {
    let value = |name: &str| value_of(chain, name);
    let at = |v: [Expr<'_>; 3]| v.map(|e| e.evaluate(&value));
    let bodies = bodies(chain);
    let mut svg = Svg::default();
    let unit = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    svg.triad("hub", [0.0; 3], unit, chain.triad(0));
    svg.point("hub", [0.0; 3], "B", [-16.0, 18.0]);
    let mut before = ([0.0; 3], unit);
    for (k, (body, link)) in bodies.iter().zip(chain.kind.links).enumerate() {
        let class = CLASSES[(k + 1) % CLASSES.len()];
        let BodyInHub { r, axes, joints, .. } = body;
        let origin = joints.last().map_or([0.0; 3], |joint| at(joint.origin.components()));
        let axes = axes.map(|axis| at(axis.components()));
        svg.arrow("arm", before.0, origin, 0.94);
        svg.label(
            "arm",
            middle(before.0, origin),
            &subscripted(link.joint.origin.symbol),
            [0.0, 22.0],
        );
        svg.turn(
            class,
            origin,
            before.1,
            link.joint.motion.axis().cycle(),
            ANGLES[k % ANGLES.len()],
            link.joint.coordinate_symbol,
        );
        svg.triad(class, origin, axes, link.body.triad);
        svg.point(class, origin, link.body.letters[0], [-20.0, 22.0]);
        svg.centre(class, origin, at(r.components()), link);
        before = (origin, axes);
    }
    svg.finish()
}

/// What a symbol is worth in the drawing.
fn value_of(chain: &Chain<'_>, name: &str) -> f64 {
    for (k, link) in chain.kind.links.iter().enumerate() {
        let angle = ANGLES[k % ANGLES.len()];
        if name == format!("sin_{}", link.joint.coordinate) {
            return libm::sin(angle);
        }
        if name == format!("cos_{}", link.joint.coordinate) {
            return libm::cos(angle);
        }
        let component = |names: [&str; 3], values: Point| {
            names.iter().position(|known| *known == name).map(|axis| values[axis])
        };
        let arm = link.joint.place();
        let arm = arm.and_then(|place| component(place.names, ARMS[k % ARMS.len()]));
        let centre = match link.body.centre {
            Centre::Free(triple) => component(triple.names, CENTRE),
            Centre::On(_, distance) => (name == distance).then_some(OFFSET),
            Centre::At => None,
        };
        if let Some(value) = arm.or(centre) {
            return value;
        }
    }
    0.0
}

fn middle(a: Point, b: Point) -> Point {
    [0, 1, 2].map(|i| f64::midpoint(a[i], b[i]))
}

fn along(start: Point, direction: Point, length: f64) -> Point {
    [0, 1, 2].map(|i| start[i] + length * direction[i])
}

/// `r_{Gᵒ/B}` with its index lowered.
fn subscripted(symbol: &str) -> String {
    match symbol.split_once("_{") {
        Some((letter, rest)) => lowered(letter, rest.trim_end_matches('}')),
        None => symbol.to_owned(),
    }
}

fn lowered(letter: &str, index: &str) -> String {
    format!("{letter}<tspan dy=\"5\" font-size=\"13\">{index}</tspan>")
}

/// `s_x` with a hat and its index lowered.
fn hatted(axis: &str) -> String {
    let (letter, index) = axis.split_once('_').unwrap_or((axis, ""));
    lowered(&format!("{letter}\u{302}"), index)
}

#[derive(Default)]
struct Svg {
    body: String,
}

impl Svg {
    /// Where a point of space is drawn.
    fn place([x, y, z]: Point) -> [f64; 2] {
        let scale = 168.0;
        [120.0 + scale * (y - 0.42 * x), 360.0 - scale * (z - 0.34 * x)]
    }

    fn line(&mut self, class: &str, from: Point, to: Point) {
        let ([a, b], [c, d]) = (Self::place(from), Self::place(to));
        let _ = writeln!(
            self.body,
            "<line class=\"{class}\" x1=\"{a:.1}\" y1=\"{b:.1}\" x2=\"{c:.1}\" y2=\"{d:.1}\"/>"
        );
    }

    /// An arrow over a part of the way, with its head.
    fn arrow(&mut self, class: &str, from: Point, to: Point, part: f64) {
        let tip = [0, 1, 2].map(|i| from[i] + part * (to[i] - from[i]));
        self.line(class, from, tip);
        let ([a, b], [c, d]) = (Self::place(from), Self::place(tip));
        let length = libm::hypot(c - a, d - b).max(1.0);
        let (u, v) = ((c - a) / length, (d - b) / length);
        let corners = [
            (c + 4.0 * u, d + 4.0 * v),
            (c - 7.0 * u - 4.0 * v, d - 7.0 * v + 4.0 * u),
            (c - 7.0 * u + 4.0 * v, d - 7.0 * v - 4.0 * u),
        ];
        let corners = corners.map(|(x, y)| format!("{x:.1},{y:.1}")).join(" ");
        let _ = writeln!(self.body, "<polygon class=\"{class} head\" points=\"{corners}\"/>");
    }

    fn label(&mut self, class: &str, at: Point, text: &str, [right, down]: [f64; 2]) {
        let [x, y] = Self::place(at);
        let _ = writeln!(
            self.body,
            "<text class=\"{class}\" x=\"{:.1}\" y=\"{:.1}\">{text}</text>",
            x + right,
            y + down
        );
    }

    fn triad(&mut self, class: &str, origin: Point, axes: [Point; 3], names: [&str; 3]) {
        for (axis, name) in axes.into_iter().zip(names) {
            let tip = along(origin, axis, AXIS);
            self.arrow(class, origin, tip, 1.0);
            let ([a, b], [c, d]) = (Self::place(origin), Self::place(tip));
            let length = libm::hypot(c - a, d - b).max(1.0);
            let offset = [16.0 * (c - a) / length - 7.0, 16.0 * (d - b) / length + 5.0];
            self.label(class, tip, &hatted(name), offset);
        }
    }

    fn point(&mut self, class: &str, at: Point, text: &str, offset: [f64; 2]) {
        let [x, y] = Self::place(at);
        let _ = writeln!(
            self.body,
            "<circle class=\"{class} dot\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3.5\"/>"
        );
        self.label(&format!("{class} name"), at, text, offset);
    }

    /// The centre of mass with its arm from the body's origin.
    fn centre(
        &mut self,
        class: &str,
        origin: Point,
        at: Point,
        link: &precess_codegen::kinds::Link,
    ) {
        self.line(&format!("{class} thin"), origin, at);
        let [x, y] = Self::place(at);
        let _ = writeln!(
            self.body,
            "<circle class=\"{class} mass\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"6\"/>\
             <path class=\"{class}\" d=\"M{:.1} {y:.1}h12M{x:.1} {:.1}v12\"/>",
            x - 6.0,
            y - 6.0
        );
        let letter = link.body.letters[1];
        let (body, index) = letter.split_at(letter.len() - 1);
        self.label(&format!("{class} name"), at, &lowered(body, index), [9.0, 17.0]);
    }

    /// The joint's angle, from the parent body's next axis to the child's.
    fn turn(
        &mut self,
        class: &str,
        origin: Point,
        carrier: [Point; 3],
        cycle: [usize; 3],
        angle: f64,
        text: &str,
    ) {
        let [_, i, j] = cycle;
        let at = |t: f64| {
            along(along(origin, carrier[i], 0.44 * libm::cos(t)), carrier[j], 0.44 * libm::sin(t))
        };
        self.line(&format!("{class} thin"), origin, along(origin, carrier[i], 0.5));
        let points: Vec<String> = (0..=16)
            .map(|step| Self::place(at(angle * f64::from(step) / 16.0)))
            .map(|[x, y]| format!("{x:.1},{y:.1}"))
            .collect();
        let _ = writeln!(
            self.body,
            "<polyline class=\"{class} arc\" points=\"{}\"/>",
            points.join(" ")
        );
        let mid = along(
            along(origin, carrier[i], 0.62 * libm::cos(angle / 2.0)),
            carrier[j],
            0.62 * libm::sin(angle / 2.0),
        );
        self.label(class, mid, text, [-6.0, 5.0]);
    }

    fn finish(self) -> String {
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"20 20 1000 450\" role=\"img\" \
             aria-label=\"Frames, arms and centres of mass of the device\">\n<style>{STYLE}</style>\n{}</svg>\n",
            self.body
        )
    }
}

const STYLE: &str = include_str!("templates/frames.css");

#[cfg(test)]
mod tests {
    use super::*;
    use precess_codegen::graph::Graph;
    use precess_codegen::kinds::DGVSCMG;

    #[test]
    fn every_body_is_drawn_with_its_axes() {
        let graph = Graph::new();
        let svg = drawing(&Chain::new(&graph, &DGVSCMG));
        assert_eq!(svg.matches("mass\"").count(), 3);
        assert_eq!(svg.matches("<polyline").count(), 3);
        assert!(svg.contains("θ") && svg.contains("ᵒγ") && !svg.contains("NaN"));
    }
}
