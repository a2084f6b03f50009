//! The second file of a kind: its parameters, joints and motors as a user states them, and the calls
//! of the emitted kernels by the solver.
//!
//! Everything here follows from the kind's data and from the signatures of its kernels: no equation.

use std::collections::BTreeMap;

use serde::Serialize;
use tera::{Context, Tera};

use super::device_items::Items;
use super::device_parameters::{Parameter, parameters};
use super::file::{EmitError, EmittedFile, rust_file};
use super::home::Home;
use super::layout::packed;
use super::text::{COMMENT, capital, fnv1a64, spaced, wrapped};
use crate::kinds::{Body, Centre, Inertia, Kind, Link, Motion};

/// The kernels of a kind by their names.
pub(super) type Signatures = BTreeMap<String, Signature>;

/// How a kernel is called.
#[derive(Debug)]
pub(super) struct Signature {
    /// The letters of its arguments.
    pub(super) letters: Vec<&'static str>,
    /// The fields of what it returns.
    pub(super) fields: Vec<String>,
}

/// A structure as the template takes it.
#[derive(Serialize)]
struct Record {
    name: String,
    doc: Vec<String>,
    fields: Vec<Field>,
}

/// A field of a structure.
#[derive(Serialize)]
struct Field {
    name: String,
    doc: Vec<String>,
    ty: String,
}

/// Lays out the file. `dynamics` is how it calls the dynamics crate.
pub(super) fn device_file(
    tera: &Tera,
    kind: &Kind,
    home: Home<'_>,
    signatures: &Signatures,
) -> Result<EmittedFile, EmitError> {
    let body = Items { kind, signatures }.lines();
    let mut context = Context::new();
    context.insert("command", home.command());
    context.insert("source", kind.source);
    let made_from = format!("{kind:?}{signatures:?}");
    context.insert("hash", &fnv1a64(&(made_from + include_str!("templates/device.rs.tera"))));
    context.insert("title", &capital(kind.title));
    context.insert("imports", &imports(home.dynamics(), &body));
    context.insert("records", &[structure(kind), joints(kind), motors(kind), per_joint(kind)]);
    context.insert("body", &body);
    rust_file(home.path(&format!("{}/device.rs", kind.name)), tera.render("device.rs", &context)?)
}

/// What the text needs of the dynamics crate, and only that.
fn imports(dynamics: &str, body: &[String]) -> Vec<String> {
    let read = |name: &&&str| {
        let word = |line: &String| {
            let parts = line.split(|c: char| !(c.is_alphanumeric() || c == '_'));
            parts.into_iter().any(|part| part == **name)
        };
        body.iter().any(word)
    };
    let list = |module: &str, names: &[&str], always: &[&str]| {
        let names = names.iter().filter(|name| always.contains(name) || read(name));
        let names: Vec<_> = names.map(|name| (*name).to_owned()).collect();
        let from = format!("use {dynamics}::{module}");
        match names.as_slice() {
            [] => String::new(),
            [one] => format!("{from}{one};"),
            _ => packed(&format!("{from}{{"), &names, "};"),
        }
    };
    let hub = [
        "BodyAcceleration",
        "BodyRate",
        "BodyVelocity",
        "ConstantShare",
        "EnergyMomentum",
        "Gradient",
        "HubShare",
    ];
    let kind = [
        "BodyParameters",
        "Carried",
        "Drive",
        "Each",
        "ImbalanceModel",
        "JointInfo",
        "JointStates",
        "Kernels",
        "Kind",
        "Lumped",
        "ParameterInfo",
        "ParameterMut",
        "Shape",
        "Value",
        "Wrenches",
        "components",
        "diagonal",
        "entries",
        "no_inertia",
        "unit",
        "vector",
        "zero",
    ];
    let used = [
        list("generated::hub::", &hub, &[]),
        list("kind::", &kind, &[]),
        list("", &["Angle", "Passive", "Real", "Scalar", "Wrench"], &[]),
    ];
    used.iter().flat_map(|text| text.lines()).map(str::to_owned).collect()
}

/// The name of the body behind a joint: `outer_gimbal`.
pub(super) fn body_name(body: &Body) -> String {
    body.title.replace(' ', "_")
}

/// The field that holds a full inertia: `i_go_goc`.
pub(super) fn inertia_name(body: &Body) -> String {
    format!("i_{}_{}", body.frame, body.point)
}

/// The names of the parameters of an inertia that is not full, each once.
pub(super) fn moments(body: &Body) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for name in body.inertia.names().into_iter().flatten() {
        if !names.contains(&name) {
            names.push(name);
        }
    }
    names
}

/// The outermost body and the name of its offset, where it is a rotor that can be off balance.
pub(super) fn imbalanced(kind: &Kind) -> Option<(&Body, &'static str)> {
    let Link { joint, body, .. } = kind.links.last()?;
    let offset = match body.centre {
        Centre::On(_, offset) => offset,
        Centre::Free(_) | Centre::At => return None,
    };
    let full = match body.inertia {
        Inertia::Full(_) => true,
        Inertia::Diagonal(_) | Inertia::Symmetric(..) | Inertia::Point => false,
    };
    let turns = match joint.motion {
        Motion::Turn(_) => true,
        Motion::Slide(_) => false,
    };
    (turns && full).then_some((body, offset))
}

fn field(name: &str, doc: &str, ty: &str) -> Field {
    let doc = wrapped(doc, COMMENT - 4).iter().map(|line| spaced(line)).collect();
    Field { name: name.to_owned(), doc, ty: ty.to_owned() }
}

fn record(name: &str, doc: &str, fields: Vec<Field>) -> Record {
    let paragraphs = doc.split("\n\n").map(|text| wrapped(text, COMMENT));
    let mut lines: Vec<String> = Vec::new();
    for paragraph in paragraphs {
        if !lines.is_empty() {
            lines.push(String::new());
        }
        lines.extend(paragraph.iter().map(|line| spaced(line)));
    }
    Record { name: name.to_owned(), doc: lines, fields }
}

/// What the device is made of, as a user states it.
fn structure(kind: &Kind) -> Record {
    let passive = field(
        "passive",
        "Spring, damper and friction of each joint; `PerJoint::all(Passive::none())` for none.",
        "PerJoint<Passive<T>>",
    );
    let own = |row: &Parameter| field(&row.name, &row.doc(), row.field_type());
    let mut fields: Vec<_> = parameters(kind).iter().map(own).collect();
    let last = fields.len() - usize::from(imbalanced(kind).is_some());
    fields.insert(last, passive);
    let mut doc = format!("{}.", capital(kind.title));
    for link in kind.links.iter().filter(|link| !link.is_driven()) {
        let kept = format!(
            "\n\nThe {} keeps its rate, whatever torque that takes: its acceleration is zero, \
             `Spacecraft::loads` tells the torque.",
            link.body.title
        );
        doc.push_str(&kept);
    }
    if kind.links.iter().any(|link| matches!(link.body.inertia, Inertia::Full(_))) {
        doc.push_str(
            "\n\nProducts of inertia have the sign of the tensor's entries: `J_13` is entry 13.",
        );
    }
    record(&format!("{}<T = f64>", kind.type_name()), &doc, fields)
}

/// Coordinates and rates.
fn joints(kind: &Kind) -> Record {
    let (mut coordinates, mut rates) = (Vec::new(), Vec::new());
    for (k, link) in kind.links.iter().enumerate() {
        let (joint, title) = (&link.joint, link.body.title);
        let parent = if k == 0 { "hub" } else { kind.links[k - 1].body.title };
        let (what, unit, axis) = match joint.motion {
            Motion::Turn(axis) => ("Angle", "rad", axis),
            Motion::Slide(axis) => ("Position", "m", axis),
        };
        let axis = format!("{axis:?}").to_lowercase();
        let about = if unit == "rad" { "about" } else { "along" };
        let doc = format!("{what} of the {title}, {about} its {axis} axis, {unit}.");
        coordinates.push(field(joint.coordinate, &doc, "T"));
        let unit = joint.motion.units().rate;
        let doc = format!("`{}`, its rate relative to the {parent}, {unit}.", joint.symbols[0]);
        rates.push(field(joint.rate, &doc, "T"));
    }
    coordinates.extend(rates);
    record("Joints<T = f64>", "Coordinates and relative rates of the joints.", coordinates)
}

/// What the motors exert.
fn motors(kind: &Kind) -> Record {
    let fields = kind.links.iter().enumerate().map(|(k, link)| {
        let parent = if k == 0 { "hub" } else { kind.links[k - 1].body.title };
        let unit = link.joint.motion.units().drive;
        field(
            link.joint.torque,
            &format!("{} on {}, {unit}.", capital(parent), link.body.title),
            "T",
        )
    });
    let doc = "Torques or forces of the motors, each on the child body and, reversed, on the parent \
               body. Not read at a joint whose acceleration is given.";
    record("MotorTorques<T = f64>", doc, fields.collect())
}

/// A value per joint.
fn per_joint(kind: &Kind) -> Record {
    let fields = kind.links.iter().map(|link| {
        let doc = format!("Of the {}.", link.body.title);
        field(&body_name(&link.body), &doc, "V")
    });
    let doc = "A value for each joint, by its child body.";
    record("PerJoint<V>", doc, fields.collect())
}
