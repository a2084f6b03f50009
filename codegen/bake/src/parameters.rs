//! The parameters of a kind by name: where each is among mount and bodies, and its value.
//!
//! Invariant: every number of a device's bodies is the place of exactly one parameter, or is fixed
//! by the kind itself ([`Fixed`]).

use std::fmt;

use precess_codegen::kinds::{Centre, Kind};
use precess_codegen::space::Axis;
use precess_description::Device;

use crate::error::BakeError;

/// Where a number is in the description.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ParameterLocation {
    /// Mass of a body.
    Mass(usize),
    /// Component of the origin of a joint; of the first one along the device's axes.
    Origin(usize, usize),
    /// Component of the centre of mass of a body.
    Centre(usize, usize),
    /// Entry of the inertia of a body.
    Inertia(usize, usize, usize),
}

/// A parameter: its name, and where its value is.
#[derive(Clone, Debug)]
pub(crate) struct Parameter {
    pub(crate) name: String,
    pub(crate) place: ParameterLocation,
}

/// What a kind says of its bodies.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Fixed {
    /// The number there is zero.
    Zero(ParameterLocation),
    /// The two are equal.
    Equal(ParameterLocation, ParameterLocation),
}

/// Every parameter of a kind but the mount, in the order of its record.
pub(crate) fn parameters(kind: &Kind) -> Vec<Parameter> {
    let mut list = Vec::new();
    for (k, link) in kind.links.iter().enumerate() {
        let (joint, body) = (&link.joint, &link.body);
        let mut push = |name: &str, place| list.push(Parameter { name: name.to_owned(), place });
        for (c, name) in joint.place().into_iter().flat_map(|place| place.names).enumerate() {
            push(name, ParameterLocation::Origin(k, c));
        }
        match body.centre {
            Centre::Free(triple) => {
                for (c, name) in triple.names.into_iter().enumerate() {
                    push(name, ParameterLocation::Centre(k, c));
                }
            }
            Centre::On(axis, name) => push(name, ParameterLocation::Centre(k, index(axis))),
            Centre::At => {}
        }
        body.mass.into_iter().for_each(|mass| push(mass, ParameterLocation::Mass(k)));
        let names = body.inertia.names();
        for (entry, name) in names.iter().enumerate() {
            let first = names[..entry].iter().all(|other| other != name);
            if let Some(name) = name.as_ref().filter(|_| first) {
                let (row, column) = ENTRIES[entry];
                push(name, ParameterLocation::Inertia(k, row, column));
            }
        }
    }
    list
}

/// What the kind itself fixes.
pub(crate) fn fixed(kind: &Kind) -> Vec<Fixed> {
    let mut list = Vec::new();
    for (k, link) in kind.links.iter().enumerate() {
        let kept = match link.body.centre {
            Centre::Free(_) => vec![0, 1, 2],
            Centre::On(axis, _) => vec![index(axis)],
            Centre::At => Vec::new(),
        };
        let centre = (0..3)
            .filter(|c| !kept.contains(c))
            .map(|c| Fixed::Zero(ParameterLocation::Centre(k, c)));
        list.extend(centre);
        let origin = (0..3).filter(|_| link.joint.place().is_none());
        list.extend(origin.map(|c| Fixed::Zero(ParameterLocation::Origin(k, c))));
        list.extend(link.body.mass.is_none().then_some(Fixed::Zero(ParameterLocation::Mass(k))));
        let names = link.body.inertia.names();
        for (entry, name) in names.iter().enumerate() {
            let place =
                |entry: usize| ParameterLocation::Inertia(k, ENTRIES[entry].0, ENTRIES[entry].1);
            let same = names[..entry].iter().position(|other| other == name);
            match (name, same) {
                (None, _) => list.push(Fixed::Zero(place(entry))),
                (Some(_), Some(first)) => list.push(Fixed::Equal(place(entry), place(first))),
                (Some(_), None) => {}
            }
        }
    }
    list
}

/// Rows and columns of the six entries.
const ENTRIES: [(usize, usize); 6] = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)];

fn index(axis: Axis) -> usize {
    axis.cycle()[0]
}

impl ParameterLocation {
    /// The number there.
    pub(crate) fn value(self, device: &Device) -> f64 {
        match self {
            Self::Mass(k) => device.body[k].mass,
            Self::Origin(0, c) => {
                let r = device.body[0].origin;
                let m = &device.mount;
                m[0][c] * r[0] + m[1][c] * r[1] + m[2][c] * r[2]
            }
            Self::Origin(k, c) => device.body[k].origin[c],
            Self::Centre(k, c) => device.body[k].centre_of_mass[c],
            Self::Inertia(k, row, column) => device.body[k].inertia[row][column],
        }
    }

    /// What rounding there is measured by: the longest offset of the device, the trace of the
    /// inertia.
    pub(crate) fn scale(self, device: &Device) -> f64 {
        match self {
            Self::Mass(k) => device.body[k].mass,
            Self::Origin(..) | Self::Centre(..) => {
                let offsets =
                    device.body.iter().flat_map(|body| [body.origin, body.centre_of_mass]);
                offsets.flatten().fold(0.0, |largest: f64, x| largest.max(x.abs()))
            }
            Self::Inertia(k, ..) => {
                let [[xx, ..], [_, yy, _], [.., zz]] = device.body[k].inertia;
                xx.abs() + yy.abs() + zz.abs()
            }
        }
    }

    /// Whether it is a moment of inertia.
    pub(crate) fn is_moment(self) -> bool {
        matches!(self, Self::Inertia(_, row, column) if row == column)
    }

    /// The body whose number it is.
    pub(crate) fn body(self) -> usize {
        match self {
            Self::Mass(k) | Self::Origin(k, _) | Self::Centre(k, _) | Self::Inertia(k, ..) => k,
        }
    }
}

/// As a reader of the description finds it: `body 2: inertia, entry 23`.
impl fmt::Display for ParameterLocation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "body {}: ", self.body() + 1)?;
        match self {
            Self::Mass(_) => write!(f, "mass"),
            Self::Origin(_, c) => write!(f, "origin, component {}", c + 1),
            Self::Centre(_, c) => write!(f, "centre of mass, component {}", c + 1),
            Self::Inertia(_, row, column) => write!(f, "inertia, entry {}{}", row + 1, column + 1),
        }
    }
}

/// Whether a number is rounding beside a scale.
pub(crate) fn is_rounding(value: f64, scale: f64) -> bool {
    value.abs() <= 4.0 * f64::EPSILON * scale
}

/// Checks what the kind itself fixes.
pub(crate) fn check(kind: &Kind, device: &Device) -> Result<(), BakeError> {
    let (expected, found) = (kind.links.len(), device.body.len());
    if expected != found {
        return Err(BakeError::Bodies(device.name.clone(), expected, found));
    }
    for fixed in fixed(kind) {
        let (place, off, what) = match fixed {
            Fixed::Zero(place) => (place, place.value(device), format!("{place} zero")),
            Fixed::Equal(place, other) => {
                let off = place.value(device) - other.value(device);
                (place, off, format!("{place} equal to {other}"))
            }
        };
        if !is_rounding(off, place.scale(device)) {
            let what = format!("{what}, not off by {off:e}; use the kind without the pattern");
            return Err(BakeError::Pattern(device.name.clone(), what));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use precess_codegen::kernel;
    use precess_codegen::kinds::KINDS;

    #[test]
    fn they_are_those_of_the_kernel_in_its_order() {
        for kind in KINDS {
            let names: Vec<_> = parameters(kind).into_iter().map(|p| p.name).collect();
            let record = kernel::parameters(kind).fields.into_iter().map(|field| field.name);
            let record: Vec<_> = record.filter(|name| !name.starts_with("mount_")).collect();
            assert_eq!(names, record, "{}", kind.name);
        }
    }

    #[test]
    fn every_number_is_a_parameter_or_fixed() {
        for kind in KINDS {
            let count = parameters(kind).len() + fixed(kind).len();
            // Mass, origin, centre of mass, six entries.
            assert_eq!(count, 13 * kind.links.len(), "{}", kind.name);
        }
    }
}
