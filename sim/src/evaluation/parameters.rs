//! [`Parameter`]: the numbers of a spacecraft that derivatives are taken by, and that differ within a
//! batch: those of the hub and of the devices' kinds, by name.
//!
//! `hub.m_b`, `hub.r_bc_b_x`, `wheel1.m_w`, `wheel1.i_w_wc_xy`, `wheel1.passive.wheel.viscous`: the
//! names of fields as the kinds list them, with the component after them. `wheel1.mount_x` is a small
//! rotation of the mount about an axis of B; `wheel1.static_imbalance`, `dynamic_imbalance` and
//! `phase` are those of a data sheet.

use precess_dynamics::{
    Axis, BuiltIn, Component, Hub, ParameterValue, ParameterVariable, Passive, Shape,
};

use crate::nearest::nearest;
use crate::scenario::{Scenario, Set, members, with_device};

use super::EvaluationError;

/// A number of hub or devices.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// `wheel1.r_w_b_x`.
    pub name: String,
    /// Its unit.
    pub unit: &'static str,
    /// What it is.
    pub meaning: String,
    of: ParameterSubject,
}

/// Whose it is.
#[derive(Clone, Debug, PartialEq)]
enum ParameterSubject {
    HubMass,
    HubCentre(Axis),
    HubInertia(Axis, Axis),
    /// Of the device of a number: the field and its component.
    Field(usize, String, Component),
    Mount(usize, Axis),
    StaticImbalance(usize),
    DynamicImbalance(usize),
    Phase(usize),
}

/// The elements of a symmetric tensor that are given.
const ELEMENTS: [(Axis, Axis, &str); 6] = [
    (Axis::X, Axis::X, "xx"),
    (Axis::Y, Axis::Y, "yy"),
    (Axis::Z, Axis::Z, "zz"),
    (Axis::X, Axis::Y, "xy"),
    (Axis::X, Axis::Z, "xz"),
    (Axis::Y, Axis::Z, "yz"),
];

/// The axes with their letters.
const AXES: [(Axis, usize, &str); 3] = [(Axis::X, 0, "x"), (Axis::Y, 1, "y"), (Axis::Z, 2, "z")];

impl Parameter {
    /// All of a scenario: of the hub, then device by device; not of platforms.
    #[must_use]
    pub fn all(scenario: &Scenario) -> Vec<Self> {
        let mut all = Vec::new();
        let mut add = |name: String, unit, meaning: &str, of| {
            all.push(Self { name, unit, meaning: meaning.to_owned(), of });
        };
        add("hub.m_b".to_owned(), "kg", "mass of the hub", ParameterSubject::HubMass);
        for (axis, _, letter) in AXES {
            let name = format!("hub.r_bc_b_{letter}");
            add(
                name,
                "m",
                "centre of mass of the hub from B, in B",
                ParameterSubject::HubCentre(axis),
            );
        }
        for (row, column, letters) in ELEMENTS {
            let name = format!("hub.i_b_bc_{letters}");
            let meaning = "inertia of the hub about its centre of mass, in B";
            add(name, "kg m²", meaning, ParameterSubject::HubInertia(row, column));
        }
        for (index, (device, member)) in scenario.members().enumerate() {
            let Some(of) = member.device() else { continue };
            for info in of.kind().parameters() {
                let base = format!("{device}.{}", info.name);
                let field =
                    |component| ParameterSubject::Field(index, info.name.to_owned(), component);
                match info.shape {
                    Shape::Scalar => add(base, info.unit, info.meaning, field(Component::Number)),
                    Shape::Vector => {
                        for (axis, _, letter) in AXES {
                            let name = format!("{base}_{letter}");
                            add(name, info.unit, info.meaning, field(Component::Along(axis)));
                        }
                    }
                    Shape::Symmetric => {
                        for (row, column, letters) in ELEMENTS {
                            let name = format!("{base}_{letters}");
                            let of = field(Component::Element(row, column));
                            add(name, info.unit, info.meaning, of);
                        }
                    }
                    Shape::Rotation => {
                        for (axis, _, letter) in AXES {
                            let name = format!("{base}_{letter}");
                            let meaning = "small rotation of the mount about an axis of B";
                            add(name, "rad", meaning, ParameterSubject::Mount(index, axis));
                        }
                    }
                    Shape::Model => {}
                }
            }
            for info in member.joints() {
                let body = info.body.replace(' ', "_");
                for (name, units) in Passive::<f64>::PARAMETERS {
                    let field = format!("passive.{body}.{name}");
                    let unit = units[usize::from(info.slides)];
                    let meaning = format!("{name} of the joint of the {}", info.body);
                    let of = ParameterSubject::Field(index, field.clone(), Component::Number);
                    add(format!("{device}.{field}"), unit, &meaning, of);
                }
            }
            if of.parameter("d").is_ok() {
                let meaning = "imbalance of the wheel, as a data sheet states it";
                let name = |what: &str| format!("{device}.{what}");
                add(
                    name("static_imbalance"),
                    "kg m",
                    meaning,
                    ParameterSubject::StaticImbalance(index),
                );
                add(
                    name("dynamic_imbalance"),
                    "kg m²",
                    meaning,
                    ParameterSubject::DynamicImbalance(index),
                );
                add(name("phase"), "rad", meaning, ParameterSubject::Phase(index));
            }
        }
        all
    }

    /// Those of some names, in their order.
    ///
    /// # Errors
    ///
    /// [`EvaluationError::UnknownParameter`] with the nearest names.
    pub fn named<N: AsRef<str>>(
        scenario: &Scenario,
        names: &[N],
    ) -> Result<Vec<Self>, EvaluationError> {
        if names.is_empty() {
            return Ok(Vec::new());
        }
        let all = Self::all(scenario);
        let find = |name: &N| {
            let name = name.as_ref();
            let found = all.iter().find(|parameter| parameter.name == name);
            found.cloned().ok_or_else(|| EvaluationError::UnknownParameter {
                name: name.to_owned(),
                nearest: nearest(name, all.iter().map(|parameter| &parameter.name)),
            })
        };
        names.iter().map(find).collect()
    }

    /// As the library takes derivatives by it.
    #[must_use]
    pub fn variable(&self) -> ParameterVariable<'_> {
        match &self.of {
            ParameterSubject::HubMass => ParameterVariable::HubMass,
            ParameterSubject::HubCentre(axis) => ParameterVariable::HubCentre(*axis),
            ParameterSubject::HubInertia(row, column) => {
                ParameterVariable::HubInertia(*row, *column)
            }
            ParameterSubject::Field(device, name, component) => {
                ParameterVariable::Device { device: *device, name, component: *component }
            }
            ParameterSubject::Mount(device, about) => {
                ParameterVariable::MountRotation { device: *device, about: *about }
            }
            ParameterSubject::StaticImbalance(device) => {
                ParameterVariable::StaticImbalance { device: *device }
            }
            ParameterSubject::DynamicImbalance(device) => {
                ParameterVariable::DynamicImbalance { device: *device }
            }
            ParameterSubject::Phase(device) => ParameterVariable::Phase { device: *device },
        }
    }

    /// Its value in hub and devices; none of what is no number there: a rotation, a data sheet's
    /// imbalance.
    #[must_use]
    pub fn value(&self, hub: &Hub, devices: &Set) -> Option<f64> {
        match &self.of {
            ParameterSubject::HubMass => Some(hub.m_b),
            ParameterSubject::HubCentre(axis) => Some(hub.r_bc_b[place(*axis)]),
            ParameterSubject::HubInertia(row, column) => {
                Some(hub.i_b_bc[(place(*row), place(*column))])
            }
            ParameterSubject::Field(index, name, component) => {
                let value = device(devices, *index)?.parameter(name).ok()?;
                match (value, component) {
                    (ParameterValue::Scalar(value), Component::Number) => Some(value),
                    (ParameterValue::Vector(value), Component::Along(axis)) => {
                        Some(value[place(*axis)])
                    }
                    (ParameterValue::Matrix(value), Component::Element(row, column)) => {
                        Some(value[(place(*row), place(*column))])
                    }
                    _ => None,
                }
            }
            ParameterSubject::Mount(..)
            | ParameterSubject::StaticImbalance(_)
            | ParameterSubject::DynamicImbalance(_)
            | ParameterSubject::Phase(_) => None,
        }
    }

    /// Whether [`Self::set`] can write it.
    #[must_use]
    pub fn is_number(&self) -> bool {
        matches!(
            self.of,
            ParameterSubject::HubMass
                | ParameterSubject::HubCentre(_)
                | ParameterSubject::HubInertia(..)
                | ParameterSubject::Field(..)
        )
    }

    /// Writes it into hub and devices; off the diagonal of a tensor both elements. Nothing is
    /// checked. Returns whether it is a number there.
    pub fn set(&self, hub: &mut Hub, devices: &mut Set, number: f64) -> bool {
        match &self.of {
            ParameterSubject::HubMass => hub.m_b = number,
            ParameterSubject::HubCentre(axis) => hub.r_bc_b[place(*axis)] = number,
            ParameterSubject::HubInertia(row, column) => {
                let (row, column) = (place(*row), place(*column));
                hub.i_b_bc[(row, column)] = number;
                hub.i_b_bc[(column, row)] = number;
            }
            ParameterSubject::Field(index, name, component) => {
                let Some(device) = device(devices, *index) else { return false };
                let Ok(mut value) = device.parameter(name) else { return false };
                match (&mut value, component) {
                    (ParameterValue::Scalar(value), Component::Number) => *value = number,
                    (ParameterValue::Vector(value), Component::Along(axis)) => {
                        value[place(*axis)] = number;
                    }
                    (ParameterValue::Matrix(value), Component::Element(row, column)) => {
                        let (row, column) = (place(*row), place(*column));
                        value[(row, column)] = number;
                        value[(column, row)] = number;
                    }
                    _ => return false,
                }
                let set = |device: &mut BuiltIn| device.set_parameter(name, value).is_ok();
                return with_device(devices, *index, set).unwrap_or(false);
            }
            ParameterSubject::Mount(..)
            | ParameterSubject::StaticImbalance(_)
            | ParameterSubject::DynamicImbalance(_)
            | ParameterSubject::Phase(_) => {
                return false;
            }
        }
        true
    }
}

fn place(axis: Axis) -> usize {
    match axis {
        Axis::X => 0,
        Axis::Y => 1,
        Axis::Z => 2,
    }
}

/// The device of a number of the set, platforms counted.
fn device(set: &Set, index: usize) -> Option<BuiltIn> {
    members(set).get(index)?.device()
}
