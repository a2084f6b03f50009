//! The table of parameters against the structure, for every kind; reading and writing by name.

use std::string::{String, ToString};
use std::vec::Vec;
use std::{format, vec};

use nalgebra::{Matrix3, Vector3};

use crate::every_kind;
use crate::generated::devices::*;
use crate::model::kind::{BodyParameters, ImbalanceModel, Kind, unit};
use crate::model::parameter_info::{NameError, ParameterValue, Shape};
use crate::model::passive::Passive;
use crate::sets::built_in::{BuiltIn, BuiltInKind};

/// The fields of a structure, by its `Debug`.
fn fields(shown: &str) -> Vec<&str> {
    let field = |line| Some(str::strip_prefix(line, "    ")?.split_once(": ")?.0);
    shown.lines().filter_map(field).filter(|name| !name.starts_with(' ')).collect()
}

/// A value of a shape that no device here has.
fn other(shape: Shape) -> ParameterValue {
    match shape {
        Shape::Scalar => ParameterValue::Scalar(7.0),
        Shape::Vector => ParameterValue::Vector(Vector3::new(7.0, 8.0, 9.0)),
        Shape::Rotation | Shape::Symmetric => ParameterValue::Matrix(Matrix3::repeat(7.0)),
        Shape::Model => ParameterValue::Model(ImbalanceModel::Lumped),
    }
}

fn device<K: Kind<Scalar = f64>>() -> K {
    let body = BodyParameters { origin: [1.0; 3], mass: 2.0, centre: [3.0; 3], inertia: unit() };
    let free = K::all(Passive::none());
    K::of_bodies(&unit(), &K::all(body), &free, ImbalanceModel::Coupled)
}

fn table_is_that_of_the_structure<K: Kind<Scalar = f64>>(module: &str)
where
    BuiltIn: From<K>,
{
    let before: K = device();
    let listed = BuiltIn::from(before);
    assert_eq!([K::NAME, listed.kind().name()], [module; 2]);
    assert_eq!(BuiltInKind::of_name(module), Some(listed.kind()));
    assert_eq!(listed.kind().parameters(), K::PARAMETERS);
    let shown = format!("{before:#?}");
    let mut names = fields(&shown);
    names.retain(|name| *name != "passive");
    assert_eq!(K::PARAMETERS.iter().map(|info| info.name).collect::<Vec<_>>(), names);
    let bodies: Vec<_> = K::JOINTS.iter().map(|joint| joint.body).collect();
    for info in K::PARAMETERS {
        assert!(info.body.is_none_or(|body| bodies.contains(&body)), "{info:?}");
        assert!(info.frame.is_none_or(|f| f == "B" || bodies.contains(&f)), "{info:?}");
        assert_eq!(info.unit.is_empty(), info.shape == Shape::Model, "{info:?}");
        written(before, info.name, info.shape);
        assert_eq!(listed.parameter(info.name), before.parameter(info.name));
    }
    for joint in K::JOINTS {
        let body = joint.body.replace(' ', "_");
        for (name, _) in Passive::<f64>::PARAMETERS {
            written(before, &format!("passive.{body}.{name}"), Shape::Scalar);
        }
    }
    let unknown = NameError::Unknown { kind: K::NAME };
    for name in ["", "passive", "passive.hub.rest", "passive.wheel", "passive.wheel.mass"] {
        assert_eq!(before.parameter(name), Err(unknown), "{name}");
    }
}

/// A parameter takes a value of its shape, and of no other, and nothing else changes.
fn written<K: Kind<Scalar = f64>>(before: K, name: &str, shape: Shape) {
    let (mut device, value) = (before, before.parameter(name).unwrap());
    device.set_parameter(name, other(shape)).unwrap();
    assert_eq!(device.parameter(name), Ok(other(shape)), "{name}");
    device.set_parameter(name, value).unwrap();
    assert_eq!(device, before, "{name}");
    let another = if shape == Shape::Scalar { Shape::Vector } else { Shape::Scalar };
    let refused = NameError::Shape { kind: K::NAME, required: shape };
    assert_eq!(device.set_parameter(name, other(another)), Err(refused), "{name}");
    assert_eq!(device, before, "{name}");
}

#[test]
fn tables_are_those_of_the_structures() {
    macro_rules! each {
        ($($kind:ident $module:ident $number:literal;)*) => {
            $(table_is_that_of_the_structure::<$kind>(stringify!($module));)*
        };
    }
    every_kind!(each);
}

#[test]
fn passive_parameters_are_those_of_the_structure() {
    let shown = format!("{:#?}", Passive::<f64>::none());
    let names: Vec<_> = Passive::<f64>::PARAMETERS.iter().map(|(name, _)| *name).collect();
    assert_eq!(names, fields(&shown));
}

#[test]
fn refusal_names_the_kind_and_what_it_requires() {
    let mut wheel: ReactionWheel = device();
    let refusals: [String; 2] = [
        wheel.parameter("m_go").unwrap_err().to_string(),
        wheel.set_parameter("i_w_wc", ParameterValue::Scalar(1.0)).unwrap_err().to_string(),
    ];
    let messages = vec![
        "reaction_wheel has no parameter of this name; use one of its `Kind::PARAMETERS`, or \
         `passive.BODY.NAME` with one of `Passive::PARAMETERS`",
        "the parameter of reaction_wheel requires a 3 by 3 matrix",
    ];
    assert_eq!(refusals.as_slice(), messages);
}
