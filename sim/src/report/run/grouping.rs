//! Which recorded columns make one chart: those of one quantity and one unit, over all devices.
//!
//! Every recorded column but the time is in exactly one chart, except Euler parameters where the
//! modified Rodrigues parameters are recorded. A chart has at most [`CURVES_MAX`] curves.

use std::collections::BTreeMap;

use precess_dynamics::kind::JointInfo;

use super::chart::{Chart, Curve, Part};
use crate::names::file_names;
use crate::record::columns::Quantity;
use crate::record::{Column, Header};
use crate::report::unit::{self, Family};
use crate::scenario::Scenario;

/// Colours and dashes of curves repeat after as many.
const CURVES_MAX: usize = 8;

const AXES: [&str; 3] = ["x", "y", "z"];

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
            Quantity::Time => None,
            Quantity::Quaternion(_) if mrp => None,
            Quantity::Coordinate(joint)
            | Quantity::Rate(joint)
            | Quantity::JointAcceleration(joint)
            | Quantity::Torque(joint) => joints.get(joint).map(|(_, device, info)| {
                let body = bodies.iter().position(|body| *body == info.body).unwrap_or_default();
                of_joint(column.quantity, body, device, info)
            }),
            Quantity::ModalCoordinate(_)
            | Quantity::ModalRate(_)
            | Quantity::Displacement(..)
            | Quantity::Rotation(..)
            | Quantity::PointSigma(..)
            | Quantity::PointOmega(..)
            | Quantity::PointAcceleration(..) => of_structure(column),
            Quantity::Disturbance(source, component) => {
                Some(of_disturbance(source, component, column))
            }
            quantity if quantity.is_load() => Some(of_load(quantity, index, column)),
            quantity => of_hub(quantity),
        };
        let Some(Found { key, part, slug, title, axis, family, label, departure }) = found else {
            continue;
        };
        let name = column.name.clone();
        let frame = column.frame.clone().unwrap_or_default();
        let curve = Curve { column: index, name, label, frame, departure };
        let new = || Chart { part, slug, title, axis, family, curves: Vec::new() };
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
struct Found {
    /// Orders the charts.
    key: (usize, usize),
    part: Part,
    slug: String,
    title: String,
    axis: &'static str,
    family: &'static Family,
    label: String,
    departure: bool,
}

fn of_hub(quantity: Quantity) -> Option<Found> {
    let (rank, title, axis, family, symbol, index) = match quantity {
        Quantity::Omega(axis) => (
            0,
            "Angular velocity of the hub",
            "Angular velocity",
            unit::ANGULAR_RATE,
            "ω",
            AXES[axis],
        ),
        Quantity::Sigma(axis) => (
            1,
            "Attitude of B relative to N, modified Rodrigues parameters",
            "Attitude σ",
            unit::NUMBER,
            "σ",
            ["1", "2", "3"][axis],
        ),
        Quantity::Quaternion(index) => (
            1,
            "Attitude of B relative to N, Euler parameters",
            "Attitude q",
            unit::NUMBER,
            "q",
            ["0", "1", "2", "3"][index],
        ),
        Quantity::Position(axis) => {
            (5, "Inertial position of B", "Position", unit::LENGTH, "r", AXES[axis])
        }
        Quantity::Velocity(axis) => {
            (6, "Inertial velocity of B", "Velocity", unit::VELOCITY, "v", AXES[axis])
        }
        Quantity::OmegaDot(axis) => (
            7,
            "Angular acceleration of the hub",
            "Angular acceleration",
            unit::ANGULAR_ACCELERATION,
            "α",
            AXES[axis],
        ),
        Quantity::HubAcceleration(axis) => {
            (8, "Inertial acceleration of B", "Acceleration", unit::ACCELERATION, "a", AXES[axis])
        }
        Quantity::Energy => {
            (20, "Energy and work since the start", "Energy", unit::ENERGY, "ΔE", "")
        }
        Quantity::Work => (20, "", "", unit::ENERGY, "W", ""),
        Quantity::Lost => (20, "", "", unit::ENERGY, "losses", ""),
        Quantity::Linear(axis) => (
            22,
            "Linear momentum, departure from the start",
            "Departure",
            unit::LINEAR_MOMENTUM,
            "Δp",
            AXES[axis],
        ),
        Quantity::Angular(axis) => (
            23,
            "Angular momentum about the inertial origin, departure from the start",
            "Departure",
            unit::ANGULAR_MOMENTUM,
            "ΔH",
            AXES[axis],
        ),
        _ => return None,
    };
    let label = if index.is_empty() { symbol.to_owned() } else { format!("{symbol}_{index}") };
    let title = if title.is_empty() { "Work and losses since the start" } else { title };
    let slug = match rank {
        0 => "angular-velocity",
        1 => "attitude",
        5 => "position",
        6 => "velocity",
        7 => "angular-acceleration",
        8 => "acceleration",
        20 => "energy",
        22 => "linear-momentum",
        _ => "angular-momentum",
    };
    Some(Found {
        key: (rank, 0),
        part: if rank < 20 { Part::Histories } else { Part::Energy },
        slug: slug.to_owned(),
        title: title.to_owned(),
        axis: if axis.is_empty() { "Energy" } else { axis },
        family,
        label,
        departure: rank >= 20,
    })
}

fn of_joint(quantity: Quantity, body: usize, device: &str, info: &JointInfo) -> Found {
    let wheel = info.body == "wheel";
    let slides = info.slides;
    let (rank, what, axis, family) = match quantity {
        Quantity::Rate(_) if wheel => (2, "rates", "Rate", unit::WHEEL_RATE),
        Quantity::Rate(_) if slides => (2, "speeds", "Speed", unit::VELOCITY),
        Quantity::Rate(_) => (2, "rates", "Rate", unit::ANGULAR_RATE),
        Quantity::Coordinate(_) if wheel => (3, "angles", "Angle", unit::REVOLUTIONS),
        Quantity::Coordinate(_) if slides => (3, "displacements", "Displacement", unit::LENGTH),
        Quantity::Coordinate(_) => (3, "angles", "Angle", unit::ANGLE),
        Quantity::Torque(_) if slides => (4, "motor forces", "Force", unit::FORCE),
        Quantity::Torque(_) => (4, "motor torques", "Torque", unit::MOTOR_TORQUE),
        _ if wheel => (9, "accelerations", "Acceleration", unit::WHEEL_ACCELERATION),
        _ if slides => (9, "accelerations", "Acceleration", unit::ACCELERATION),
        _ => (9, "accelerations", "Acceleration", unit::ANGULAR_ACCELERATION),
    };
    Found {
        key: (rank, body),
        part: Part::Histories,
        slug: hyphenated(&format!("{} {what}", info.body)),
        title: format!("{} {what}", capitalised(info.body)),
        axis,
        family,
        label: plain(device),
        departure: false,
    }
}

/// Modal coordinates of all modes in one chart, and a chart for each vector of each point.
fn of_structure(column: &Column) -> Option<Found> {
    let point = plain(&column.group);
    let (rank, index, what, axis, family, label) = match column.quantity {
        Quantity::Displacement(point, axis) => {
            let label = format!("u_{}", AXES[axis]);
            (10, point, "displacement in B", "Displacement", unit::DISPLACEMENT, label)
        }
        Quantity::Rotation(point, axis) => {
            let label = format!("θ_{}", AXES[axis]);
            (11, point, "rotation in B", "Rotation", unit::SMALL_ANGLE, label)
        }
        Quantity::PointSigma(point, axis) => (
            12,
            point,
            "attitude relative to N, modified Rodrigues parameters",
            "Attitude σ",
            unit::NUMBER,
            format!("σ_{}", ["1", "2", "3"][axis]),
        ),
        Quantity::PointOmega(point, axis) => (
            13,
            point,
            "inertial angular velocity",
            "Angular velocity",
            unit::ANGULAR_RATE,
            format!("ω_{}", AXES[axis]),
        ),
        Quantity::PointAcceleration(point, axis) => (
            14,
            point,
            "inertial acceleration",
            "Acceleration",
            unit::ACCELERATION,
            format!("a_{}", AXES[axis]),
        ),
        Quantity::ModalCoordinate(mode) => {
            (15, 0, "modal coordinates", "η", unit::MODAL, format!("η_{}", mode + 1))
        }
        Quantity::ModalRate(mode) => {
            (16, 0, "modal rates", "η′", unit::MODAL_RATE, format!("η′_{}", mode + 1))
        }
        _ => return None,
    };
    let title = if rank < 15 { format!("{point}: {what}") } else { what.to_owned() };
    Some(Found {
        key: (rank, index),
        part: Part::Histories,
        slug: hyphenated(&match rank {
            10..15 => column.vector.clone().unwrap_or_default(),
            _ => what.to_owned(),
        }),
        title: capitalised(&title),
        axis,
        family,
        label,
        departure: false,
    })
}

/// A chart for the force and one for the moment of each source.
fn of_disturbance(source: usize, component: usize, column: &Column) -> Found {
    let (what, axis, family, symbol) = if component < 3 {
        ("force", "Force", unit::FORCE, "F")
    } else {
        ("moment", "Moment", unit::MOMENT, "M")
    };
    Found {
        key: (17, 2 * source + component / 3),
        part: Part::Histories,
        slug: hyphenated(column.vector.as_deref().unwrap_or(&column.name)),
        title: format!("{}: {what}", capitalised(&plain(&column.group))),
        axis,
        family,
        label: format!("{symbol}_{}", AXES[component % 3]),
        departure: false,
    }
}

fn of_load(quantity: Quantity, index: usize, column: &Column) -> Found {
    let (axis, family, name, symbol) = match quantity {
        Quantity::MountForce(_, axis)
        | Quantity::CarriedForce(_, axis)
        | Quantity::LoadForce(_, axis) => (axis, unit::FORCE, "Force", "F"),
        Quantity::MountMoment(_, axis)
        | Quantity::CarriedMoment(_, axis)
        | Quantity::LoadMoment(_, axis) => (axis, unit::MOMENT, "Moment", "M"),
        _ => (0, unit::NUMBER, "", ""),
    };
    // The meaning ends in the component: "…, x".
    let meaning = column.meaning.rsplit_once(',').map_or(column.meaning.as_str(), |(what, _)| what);
    let device = column.group.split('.').next().unwrap_or_default();
    let title = capitalised(meaning.strip_suffix(", component").unwrap_or(meaning));
    let title = if title.contains(device) { title } else { format!("{}: {title}", plain(device)) };
    Found {
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
    if chart.curves.len() <= CURVES_MAX {
        return vec![chart];
    }
    let parts = chart.curves.len().div_ceil(CURVES_MAX);
    let size = chart.curves.len().div_ceil(parts);
    let numbered = chart.curves.chunks(size).enumerate().map(|(index, curves)| Chart {
        slug: format!("{}-{}", chart.slug, index + 1),
        title: format!("{}, {} of {parts}", chart.title, index + 1),
        curves: curves.to_vec(),
        ..chart
    });
    numbered.collect()
}

/// A device's name without what a label would take for an index.
fn plain(name: &str) -> String {
    name.replace('_', " ")
}

/// A name for a file: lower case, digits, hyphens.
fn hyphenated(name: &str) -> String {
    name.replace([' ', '_', '.'], "-")
}

fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}
