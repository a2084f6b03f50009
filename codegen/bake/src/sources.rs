//! Where `prepare` takes each of its parameters from.

use precess_codegen::kinds::{Kind, Link, Motion};

use crate::parameters::{ParameterLocation, parameters};

/// Where a parameter of `prepare` comes from.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Source {
    /// A number of a body.
    Location(ParameterLocation),
    /// Row and column of the mount.
    Mount(usize, usize),
    /// Sine or cosine of a turn that the mount is made of.
    Turn(&'static str),
    /// Sine of the coordinate of a joint that is locked for good.
    Sine(&'static Link),
    /// Cosine of it.
    Cosine(&'static Link),
    /// The coordinate itself, of one that slides.
    Position(&'static Link),
}

/// The turns of a mount: name of the parameter, and field of the emitted record.
const TURNS: [(&str, &str); 4] = [
    ("sin_mount_a", "sin_a"),
    ("cos_mount_a", "cos_a"),
    ("sin_mount_b", "sin_b"),
    ("cos_mount_b", "cos_b"),
];

/// The source of the parameter `name` of a kind.
pub(crate) fn source(kind: &Kind, name: &str) -> Option<Source> {
    if let Some(parameter) = parameters(kind).iter().find(|parameter| parameter.name == name) {
        return Some(Source::Location(parameter.place));
    }
    if let Some((_, field)) = TURNS.iter().find(|(turn, _)| *turn == name) {
        return Some(Source::Turn(field));
    }
    if let Some(entry) = name.strip_prefix("mount_") {
        let index = |k: usize| entry.get(k..=k)?.parse::<usize>().ok()?.checked_sub(1);
        return Some(Source::Mount(index(0)?, index(1)?));
    }
    let of = |name: &str| kind.links.iter().find(|link| link.joint.coordinate == name);
    let turns = |link: &&Link| matches!(link.joint.motion, Motion::Turn(_));
    if let Some(link) = name.strip_prefix("sin_").and_then(of).filter(turns) {
        return Some(Source::Sine(link));
    }
    if let Some(link) = name.strip_prefix("cos_").and_then(of).filter(turns) {
        return Some(Source::Cosine(link));
    }
    of(name).map(Source::Position)
}

impl Source {
    /// As the emitted constructor writes it.
    pub(crate) fn written(self) -> String {
        match self {
            Self::Location(place) => written(place),
            Self::Mount(row, column) => format!("m[{row}][{column}]"),
            Self::Turn(field) => format!("turned.{field}"),
            Self::Sine(link) => format!("sin_{}", link.joint.coordinate),
            Self::Cosine(link) => format!("cos_{}", link.joint.coordinate),
            Self::Position(link) => format!("device.{}", link.joint.coordinate),
        }
    }
}

/// How a place is written.
pub(crate) fn written(place: ParameterLocation) -> String {
    match place {
        ParameterLocation::Mass(k) => format!("b[{k}].mass"),
        ParameterLocation::Origin(0, c) => format!("origin[{c}]"),
        ParameterLocation::Origin(k, c) => format!("b[{k}].origin[{c}]"),
        ParameterLocation::Centre(k, c) => format!("b[{k}].centre_of_mass[{c}]"),
        ParameterLocation::Inertia(k, row, column) => format!("b[{k}].inertia[{row}][{column}]"),
    }
}
