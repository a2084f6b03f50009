//! Which recorded columns make one chart: those of one quantity and one unit, over all devices.
//!
//! Every recorded column but the time is in exactly one chart, except Euler parameters where the
//! modified Rodrigues parameters are recorded. A chart has at most [`CURVES_MAX`] curves.

use std::collections::BTreeMap;

use precess_dynamics::kind::JointInfo;

use super::chart::{Chart, Curve, Part};
use super::chart_texts::{
    ABOUT_CENTRE, ACCELERATION, ANGULAR, COORDINATE, ENERGY, FORCE, FRICTION, JointTexts, LINEAR,
    LoadTexts, MOMENT, MOTOR, MomentumTexts, RATE, WORK,
};
use super::wraps;
use crate::names::file_names;
use crate::record::columns::Quantity;
use crate::record::{Column, Header};
use crate::report::unit::{self, Family};
use crate::scenario::Scenario;

/// Colours and dashes of curves repeat after as many.
const CURVES_MAX: usize = 8;

pub(super) const AXES: [&str; 3] = ["x", "y", "z"];
const TURNS: [&str; 3] = ["roll", "pitch", "yaw"];

/// The charts of a header in the order of the page. Energy less work is a column after the last
/// where there is a ledger.
pub(in crate::report) fn charts(header: &Header, scenario: &Scenario, ledger: bool) -> Vec<Chart> {
    let joints: Vec<_> = scenario.joints().collect();
    let mut bodies: Vec<&str> = Vec::new();
    for (_, _, info) in &joints {
        if !bodies.contains(&info.body) {
            bodies.push(info.body);
        }
    }
    let mrp = header.columns.iter().any(|column| matches!(column.quantity, Quantity::Sigma(_)));
    let mut groups: BTreeMap<(usize, usize), Chart> = BTreeMap::new();
    for (index, column) in header.columns.iter().enumerate() {
        let found = match column.quantity {
            Quantity::Quaternion(_) if mrp => None,
            quantity => found(quantity, index, column, (&joints[..], &bodies[..])),
        };
        let Some(ChartColumn { key, part, slug, title, axis, family, label, departure }) = found
        else {
            continue;
        };
        let (name, frame) = (column.name.clone(), column.frame.clone().unwrap_or_default());
        let curve = Curve { column: index, name, label, frame, departure };
        let jump = wraps::jump(column.quantity);
        let new = || Chart { part, slug, title, axis, family, jump, curves: Vec::new() };
        groups.entry(key).or_insert_with(new).curves.push(curve);
    }
    if ledger {
        let curve = Curve {
            column: header.columns.len(),
            name: "energy_less_work".to_owned(),
            label: "Δ(E + losses − W)".to_owned(),
            frame: String::new(),
            departure: true,
        };
        let title = "Energy and losses less work, departure from the start".to_owned();
        let chart = Chart {
            part: Part::Energy,
            slug: "energy-less-work".to_owned(),
            title,
            axis: "Departure",
            family: unit::ENERGY,
            jump: None,
            curves: vec![curve],
        };
        groups.insert((21, 0), chart);
    }
    let mut charts: Vec<Chart> = groups.into_values().flat_map(split).collect();
    let names = file_names(charts.iter().map(|chart| &chart.slug));
    charts.iter_mut().zip(names).for_each(|(chart, name)| chart.slug = name);
    charts
}

/// Where a column belongs.
pub(super) struct ChartColumn {
    /// Orders the charts.
    pub(super) key: (usize, usize),
    pub(super) part: Part,
    pub(super) slug: String,
    pub(super) title: String,
    pub(super) axis: &'static str,
    pub(super) family: &'static Family,
    pub(super) label: String,
    pub(super) departure: bool,
}

/// The joints of a scenario: number and name of the device, and the joint.
pub(super) type Joints<'a> = [(usize, &'a str, &'static JointInfo)];

/// The chart of every quantity; none of the time.
fn found(
    quantity: Quantity,
    index: usize,
    column: &Column,
    joints: (&Joints<'_>, &[&str]),
) -> Option<ChartColumn> {
    Some(match quantity {
        Quantity::Time => return None,
        Quantity::Omega(axis) => {
            let texts = ["angular-velocity", "Angular velocity of the hub", "Angular velocity"];
            of_hub((0, 0), texts, unit::ANGULAR_RATE, ["ω", AXES[axis]])
        }
        Quantity::Sigma(axis) => {
            let title = "Attitude of B relative to N, modified Rodrigues parameters";
            let texts = ["attitude", title, "Attitude σ"];
            of_hub((1, 0), texts, unit::NUMBER, ["σ", ["1", "2", "3"][axis]])
        }
        Quantity::Quaternion(index) => {
            let title = "Attitude of B relative to N, Euler parameters";
            let texts = ["attitude", title, "Attitude q"];
            of_hub((1, 0), texts, unit::NUMBER, ["q", ["0", "1", "2", "3"][index]])
        }
        Quantity::HubRotation(axis) => {
            let texts = ["rotation", "Rotation of the hub from its reference", "Rotation"];
            of_hub((1, 1), texts, unit::SMALL_ANGLE, ["θ", AXES[axis]])
        }
        Quantity::EulerAngle(index) => of_turns(2, ["euler-angles", "N"], index),
        Quantity::OrbitAngle(index) => of_turns(3, ["orbit-angles", "the orbital frame"], index),
        Quantity::OrbitOmega(axis) => {
            let title = "Angular velocity of the hub with respect to the orbital frame";
            let texts = ["orbit-angular-velocity", title, "Angular velocity"];
            of_hub((1, 4), texts, unit::ANGULAR_RATE, ["ω", AXES[axis]])
        }
        Quantity::Rate(joint) => return of_joint(2, &RATE, joint, joints),
        Quantity::Coordinate(joint) => return of_joint(3, &COORDINATE, joint, joints),
        Quantity::Torque(joint) => return of_joint(4, &MOTOR, joint, joints),
        Quantity::Friction(joint) => return of_friction(joint, joints),
        Quantity::Position(axis) => {
            let texts = ["position", "Inertial position of B", "Position"];
            of_hub((5, 0), texts, unit::LENGTH, ["r", AXES[axis]])
        }
        Quantity::Velocity(axis) => {
            let texts = ["velocity", "Inertial velocity of B", "Velocity"];
            of_hub((6, 0), texts, unit::VELOCITY, ["v", AXES[axis]])
        }
        Quantity::OmegaDot(axis) => {
            let texts =
                ["angular-acceleration", "Angular acceleration of the hub", "Angular acceleration"];
            of_hub((7, 0), texts, unit::ANGULAR_ACCELERATION, ["α", AXES[axis]])
        }
        Quantity::HubAcceleration(axis) => {
            let texts = ["acceleration", "Inertial acceleration of B", "Acceleration"];
            of_hub((8, 0), texts, unit::ACCELERATION, ["a", AXES[axis]])
        }
        Quantity::JointAcceleration(joint) => return of_joint(9, &ACCELERATION, joint, joints),
        Quantity::Displacement(point, axis) => {
            let texts = ["displacement in B", "Displacement"];
            of_point((10, point), texts, unit::DISPLACEMENT, ["u", AXES[axis]], column)
        }
        Quantity::Rotation(point, axis) => {
            let texts = ["rotation in B", "Rotation"];
            of_point((11, point), texts, unit::SMALL_ANGLE, ["θ", AXES[axis]], column)
        }
        Quantity::PointSigma(point, axis) => {
            let texts = ["attitude relative to N, modified Rodrigues parameters", "Attitude σ"];
            let label = ["σ", ["1", "2", "3"][axis]];
            of_point((12, point), texts, unit::NUMBER, label, column)
        }
        Quantity::PointOmega(point, axis) => {
            let texts = ["inertial angular velocity", "Angular velocity"];
            of_point((13, point), texts, unit::ANGULAR_RATE, ["ω", AXES[axis]], column)
        }
        Quantity::PointAcceleration(point, axis) => {
            let texts = ["inertial acceleration", "Acceleration"];
            of_point((14, point), texts, unit::ACCELERATION, ["a", AXES[axis]], column)
        }
        Quantity::BodyPointPosition(point, axis) => of_body_point(0, point, axis, column),
        Quantity::BodyPointVelocity(point, axis) => of_body_point(1, point, axis, column),
        Quantity::BodyPointAcceleration(point, axis) => of_body_point(2, point, axis, column),
        Quantity::ModalCoordinate(mode) => {
            of_modes(15, "modal coordinates", unit::MODAL, "η", mode)
        }
        Quantity::ModalRate(mode) => of_modes(16, "modal rates", unit::MODAL_RATE, "η′", mode),
        Quantity::Disturbance(source, component) => of_disturbance(source, component, column),
        Quantity::Control(controller, quantity) => {
            return super::control_charts::chart(controller, quantity, column, joints);
        }
        Quantity::Energy => of_hub((20, 0), ENERGY, unit::ENERGY, ["ΔE", ""]),
        Quantity::Work => of_hub((20, 0), WORK, unit::ENERGY, ["W", ""]),
        Quantity::Lost => of_hub((20, 0), WORK, unit::ENERGY, ["losses", ""]),
        Quantity::Linear(axis) => of_momentum(LINEAR, axis),
        Quantity::Angular(axis) => of_momentum(ANGULAR, axis),
        Quantity::CentreMomentum(axis) => of_momentum(ABOUT_CENTRE, axis),
        Quantity::MountForce(_, axis)
        | Quantity::CarriedForce(_, axis)
        | Quantity::LoadForce(_, axis) => of_load(FORCE, axis, index, column),
        Quantity::MountMoment(_, axis)
        | Quantity::CarriedMoment(_, axis)
        | Quantity::LoadMoment(_, axis) => of_load(MOMENT, axis, index, column),
    })
}

/// Of the hub or of the whole spacecraft.
fn of_hub(
    key: (usize, usize),
    [slug, title, axis]: [&'static str; 3],
    family: &'static Family,
    [symbol, index]: [&str; 2],
) -> ChartColumn {
    ChartColumn {
        key,
        part: if key.0 < 20 { Part::Histories } else { Part::Energy },
        slug: slug.to_owned(),
        title: title.to_owned(),
        axis,
        family,
        label: if index.is_empty() { symbol.to_owned() } else { format!("{symbol}_{index}") },
        departure: key.0 >= 20,
    }
}

/// Of a momentum.
fn of_momentum((key, slug, title, symbol, family): MomentumTexts, axis: usize) -> ChartColumn {
    let column = of_hub(key, [slug, "", "Departure"], family, [symbol, AXES[axis]]);
    ChartColumn { title: format!("{title}, departure from the start"), ..column }
}

/// Roll, pitch and yaw from some axes.
fn of_turns(order: usize, [slug, from]: [&'static str; 2], index: usize) -> ChartColumn {
    let column = of_hub((1, order), [slug, "", "Angle"], unit::ANGLE, [TURNS[index], ""]);
    ChartColumn { title: format!("Roll, pitch and yaw of B from {from}"), ..column }
}

/// After those of the motors.
fn of_friction(joint: usize, of: (&Joints<'_>, &[&str])) -> Option<ChartColumn> {
    let found = of_joint(4, &FRICTION, joint, of)?;
    let (rank, body) = found.key;
    Some(ChartColumn { key: (rank, body + of.1.len()), ..found })
}

/// A chart for the joints of bodies of one name.
fn of_joint(
    rank: usize,
    [of_wheel, of_slide, of_turn]: &JointTexts,
    joint: usize,
    (joints, bodies): (&Joints<'_>, &[&str]),
) -> Option<ChartColumn> {
    let (_, device, info) = joints.get(joint)?;
    let body = bodies.iter().position(|body| *body == info.body).unwrap_or_default();
    let (what, axis, family) = match info.body {
        "wheel" => *of_wheel,
        _ if info.slides => *of_slide,
        _ => *of_turn,
    };
    Some(ChartColumn {
        key: (rank, body),
        part: Part::Histories,
        slug: hyphenated(&format!("{} {what}", info.body)),
        title: format!("{} {what}", capitalised(info.body)),
        axis,
        family,
        label: plain(device),
        departure: false,
    })
}

/// A chart for each vector of each point.
fn of_point(
    key: (usize, usize),
    [what, axis]: [&'static str; 2],
    family: &'static Family,
    [symbol, index]: [&str; 2],
    column: &Column,
) -> ChartColumn {
    ChartColumn {
        key,
        part: Part::Histories,
        slug: hyphenated(column.vector.as_deref().unwrap_or_default()),
        title: capitalised(&format!("{}: {what}", plain(&column.group))),
        axis,
        family,
        label: format!("{symbol}_{index}"),
        departure: false,
    }
}

/// Place, velocity and acceleration of a point of a body, by their order.
fn of_body_point(order: usize, point: usize, axis: usize, column: &Column) -> ChartColumn {
    let (what, title, family, symbol) = match order {
        0 => ("inertial position", "Position", unit::LENGTH, "r"),
        1 => ("inertial velocity", "Velocity", unit::VELOCITY, "v"),
        _ => ("inertial acceleration", "Acceleration", unit::ACCELERATION, "a"),
    };
    of_point((18, 3 * point + order), [what, title], family, [symbol, AXES[axis]], column)
}

/// All modes in one chart.
fn of_modes(
    rank: usize,
    what: &str,
    family: &'static Family,
    symbol: &'static str,
    mode: usize,
) -> ChartColumn {
    ChartColumn {
        key: (rank, 0),
        part: Part::Histories,
        slug: hyphenated(what),
        title: capitalised(what),
        axis: symbol,
        family,
        label: format!("{symbol}_{}", mode + 1),
        departure: false,
    }
}

/// A chart for the force and one for the moment of each source.
fn of_disturbance(source: usize, component: usize, column: &Column) -> ChartColumn {
    let (axis, family, symbol) = if component < 3 { FORCE } else { MOMENT };
    ChartColumn {
        key: (17, 2 * source + component / 3),
        part: Part::Histories,
        slug: hyphenated(column.vector.as_deref().unwrap_or(&column.name)),
        title: format!("{}: {}", capitalised(&plain(&column.group)), axis.to_lowercase()),
        axis,
        family,
        label: format!("{symbol}_{}", AXES[component % 3]),
        departure: false,
    }
}

fn of_load(
    (name, family, symbol): LoadTexts,
    axis: usize,
    index: usize,
    column: &Column,
) -> ChartColumn {
    // The meaning ends in the component: "…, x".
    let meaning = column.meaning.rsplit_once(',').map_or(column.meaning.as_str(), |(what, _)| what);
    let device = column.group.split('.').next().unwrap_or_default();
    let title = capitalised(meaning.strip_suffix(", component").unwrap_or(meaning));
    let title = if title.contains(device) { title } else { format!("{}: {title}", plain(device)) };
    ChartColumn {
        // The components of a vector follow each other; the first one's index stands for all.
        key: (30, index - axis.min(index)),
        part: Part::Loads,
        slug: hyphenated(column.vector.as_deref().unwrap_or(&column.name)),
        title,
        axis: name,
        family,
        label: format!("{symbol}_{}", AXES[axis]),
        departure: false,
    }
}

/// A chart of too many curves as several.
fn split(chart: Chart) -> Vec<Chart> {
    let count = chart.curves.len();
    let parts = count.div_ceil(CURVES_MAX);
    if parts <= 1 {
        return vec![chart];
    }
    let size = count.div_ceil(parts);
    let numbered = chart.curves.chunks(size).enumerate().map(|(index, curves)| Chart {
        slug: format!("{}-{}", chart.slug, index + 1),
        title: format!("{}, {} of {parts}", chart.title, index + 1),
        curves: curves.to_vec(),
        ..chart
    });
    numbered.collect()
}

/// A device's name without what a label would take for an index.
pub(super) fn plain(name: &str) -> String {
    name.replace('_', " ")
}

/// A name for a file: lower case, digits, hyphens.
pub(super) fn hyphenated(name: &str) -> String {
    name.replace([' ', '_', '.'], "-")
}

pub(in crate::report) fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}
