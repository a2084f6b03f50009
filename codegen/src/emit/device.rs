//! The second file of a kind: its parameters, joints and motors as a user states them, and the calls
//! of the emitted kernels by the solver.
//!
//! Everything here follows from the kind's data and from the signatures of its kernels: no equation.
//! All of the file but its header is tokens until it is printed, once.

use std::collections::BTreeMap;

use proc_macro2::TokenStream;
use quote::quote;
use syn::Path;
use tera::{Context, Tera};

use super::body::mention;
use super::device_items::{Items, set};
use super::device_parameters::{Parameter, parameters};
use super::error::EmitError;
use super::file::{EmittedFile, FEATURE, rust_file};
use super::target_crate::TargetCrate;
use super::text::{COMMENT, capital, documented, fnv1a64, ident, pretty_items};
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

/// Lays out the file of a kind for its target.
pub(super) fn device_file(
    tera: &Tera,
    kind: &Kind,
    target: TargetCrate<'_>,
    signatures: &Signatures,
) -> Result<EmittedFile, EmitError> {
    let records = [structure(kind), joints(kind), motors(kind), per_joint(kind)];
    let feature = (target == TargetCrate::Dynamics).then_some(FEATURE);
    let of_kind = Items { kind, signatures, feature };
    let by_number = target.dynamics_name().map(|dynamics| of_kind.by_number(dynamics));
    let items = of_kind.all();
    let items = quote!(#(#records)* #items);
    let imports = imports(&target.dynamics()?, feature, &items);
    let mut context = Context::new();
    context.insert("command", target.command());
    context.insert("source", kind.source);
    let made_from = format!("{kind:?}{signatures:?}");
    context.insert("hash", &fnv1a64(&(made_from + include_str!("templates/device.rs.tera"))));
    context.insert("title", &capital(kind.title));
    context.insert("items", &pretty_items(quote!(#imports #items)));
    context.insert("by_number", &by_number.unwrap_or_default());
    rust_file(target.path(&format!("{}/device.rs", kind.name)), tera.render("device.rs", &context)?)
}

/// What the items name of other modules; of the dynamics crate only that.
fn imports(dynamics: &Path, feature: Option<&str>, items: &TokenStream) -> TokenStream {
    let read = |names: TokenStream| {
        let names = names.into_iter().filter(|name| mention(items.clone(), &name.to_string()));
        quote!({ #(#names),* })
    };
    let hub = read(quote! {
        BodyAcceleration BodyRate BodyVelocity ConstantShare EnergyMomentum Gradient HubShare
    });
    let kind = read(quote! {
        BodyParameters Carried Drive Each ImbalanceModel JointInfo JointStates JointSteering Kernels Kind
        Lumped ParameterInfo ParameterMut Shape Steering Value Wrenches
        components diagonal entries no_inertia unit vector zero
    });
    let derivatives = feature.map(|feature| quote!(#[cfg(feature = #feature)]));
    let root = read(quote!(Angle Passive Real Scalar Wrench));
    quote! {
        use nalgebra::{Matrix3, Vector3};
        pub use super::JointAccelerations;
        use #dynamics::generated::hub::#hub;
        use #dynamics::kind::#kind;
        #derivatives
        use #dynamics::kind::LoadDerivatives;
        use #dynamics::#root;
    }
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

/// Whether an inertia has products.
fn has_products(body: &Body) -> bool {
    match body.inertia {
        Inertia::Full(_) => true,
        Inertia::Diagonal(_) | Inertia::Symmetric(..) | Inertia::Point => false,
    }
}

/// The outermost body and the name of its offset, where it is a rotor that can be off balance.
pub(super) fn imbalanced(kind: &Kind) -> Option<(&Body, &'static str)> {
    let Link { joint, body, .. } = kind.links.last()?;
    let offset = match body.centre {
        Centre::On(_, offset) => offset,
        Centre::Free(_) | Centre::At => return None,
    };
    let turns = match joint.motion {
        Motion::Turn(_) => true,
        Motion::Slide(_) => false,
    };
    (turns && has_products(body)).then_some((body, offset))
}

fn field(name: &str, doc: &str, ty: &TokenStream) -> TokenStream {
    let (doc, field) = (documented(doc, COMMENT - 4), set(name, ty));
    quote!(#doc pub #field)
}

fn record(name: &TokenStream, doc: &str, fields: &[TokenStream]) -> TokenStream {
    let doc = documented(doc, COMMENT);
    quote! {
        #doc
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct #name { #(#fields),* }
    }
}

/// What the device is made of, as a user states it.
fn structure(kind: &Kind) -> TokenStream {
    let passive = field(
        "passive",
        "Spring, damper and friction of each joint; `PerJoint::all(Passive::none())` for none.",
        &quote!(PerJoint<Passive<T>>),
    );
    let own = |row: &Parameter| field(&row.name, &row.doc(), &row.field_type());
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
    if kind.links.iter().any(|link| has_products(&link.body)) {
        doc.push_str(
            "\n\nProducts of inertia have the sign of the tensor's entries: `J_13` is entry 13.",
        );
    }
    let name = ident(kind.type_name());
    record(&quote!(#name<T = f64>), &doc, &fields)
}

/// Coordinates and rates.
fn joints(kind: &Kind) -> TokenStream {
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
        coordinates.push(field(joint.coordinate, &doc, &quote!(T)));
        let unit = joint.motion.units().rate;
        let doc = format!("`{}`, its rate relative to the {parent}, {unit}.", joint.symbols[0]);
        rates.push(field(joint.rate, &doc, &quote!(T)));
    }
    coordinates.extend(rates);
    let doc = "Coordinates and relative rates of the joints.";
    record(&quote!(Joints<T = f64>), doc, &coordinates)
}

/// What the motors exert.
fn motors(kind: &Kind) -> TokenStream {
    let fields = kind.links.iter().enumerate().map(|(k, link)| {
        let parent = if k == 0 { "hub" } else { kind.links[k - 1].body.title };
        let unit = link.joint.motion.units().drive;
        let doc = format!("{} on {}, {unit}.", capital(parent), link.body.title);
        field(link.joint.torque, &doc, &quote!(T))
    });
    let doc = "Torques or forces of the motors, each on the child body and, reversed, on the parent \
               body. Not read at a joint whose acceleration is given.";
    record(&quote!(MotorTorques<T = f64>), doc, &fields.collect::<Vec<_>>())
}

/// A value per joint.
fn per_joint(kind: &Kind) -> TokenStream {
    let fields = kind.links.iter().map(|link| {
        let doc = format!("Of the {}.", link.body.title);
        field(&body_name(&link.body), &doc, &quote!(V))
    });
    let doc = "A value for each joint, by its child body.";
    record(&quote!(PerJoint<V>), doc, &fields.collect::<Vec<_>>())
}
