//! The constants of a spacecraft: what the emitted constructor makes of the description's values.
//!
//! In the order of its operations and with its roundings: what it calls of the emitted kernels is
//! evaluated as it is written, what is written by hand is the same file. The emitted tests compare
//! all bits.

use precess_codegen::kinds::{Link, Motion};
use precess_description::{Description, Device};
use serde::Serialize;
use tera::Context;

use crate::by_hand::body::{Body, Joint, outboard};
use crate::by_hand::mount::Turned;
use crate::by_hand::rigid::RigidBody;
use crate::by_hand::sin_cos::sin_cos;
use crate::error::BakeError;
use crate::evaluate::{Numbers, evaluate};
use crate::numbers::{float, list};
use crate::shape::{Derived, Shape, turns};
use crate::sources::{Source, source};

/// Hub and constant shares of the devices.
#[derive(Serialize)]
struct BodyText {
    mass: String,
    first_moment: String,
    inertia: String,
}

/// The constants of a shape, device by device.
#[derive(Serialize)]
struct Folded {
    module: &'static str,
    devices: Vec<FoldedDevice>,
}

/// The constants of a device.
#[derive(Serialize)]
struct FoldedDevice {
    prepared: Vec<Number>,
    has_scales: bool,
    scales: String,
}

/// A constant by its name.
#[derive(Serialize)]
struct Number {
    name: String,
    value: String,
}

/// Adds the constants of a spacecraft to what its files are made from.
pub(crate) fn fold(
    description: &Description,
    shapes: &[Shape<'_>],
    derived: &[Derived],
    context: &mut Context,
) -> Result<(), BakeError> {
    let hub = &description.hub;
    let mut body = RigidBody::new(hub.mass, hub.centre_of_mass, &hub.inertia);
    let mut list_of = Vec::new();
    for (shape, derived) in shapes.iter().zip(derived) {
        let text = &derived.emitted.file.text;
        let file = syn::parse_file(text)
            .map_err(|error| BakeError::Statement(shape.kind.name.to_owned(), error.to_string()))?;
        let mut devices = Vec::new();
        for device in &shape.devices {
            let (share, own) = of_device(shape, derived, device, &file)?;
            body.add(&share);
            devices.push(own);
        }
        if !shape.is_rigid() {
            list_of.push(Folded { module: shape.kind.name, devices });
        }
    }
    let numbers = [body.mass].into_iter().chain(body.first_moment).chain(body.inertia);
    for value in numbers {
        finite("hub", "mass, first moment or inertia of hub and devices", value)?;
    }
    context.insert(
        "body",
        &BodyText {
            mass: float(body.mass),
            first_moment: list(body.first_moment.into_iter()),
            inertia: list(body.inertia.into_iter()),
        },
    );
    context.insert("folded", &list_of);
    Ok(())
}

/// Constant share of the hub, and the constants that are left, of one device.
fn of_device(
    shape: &Shape<'_>,
    derived: &Derived,
    device: &Device,
    file: &syn::File,
) -> Result<(RigidBody, FoldedDevice), BakeError> {
    let turned = turns(shape, device)?;
    let mut parameters = Numbers::new();
    for field in &derived.parameters.fields {
        let value = source(shape.kind, &field.name)
            .and_then(|source| number(source, shape, device, turned.as_ref()));
        let unknown = || BakeError::Statement("prepare".to_owned(), field.name.clone());
        parameters.insert(field.name.clone(), value.ok_or_else(unknown)?);
    }
    let prepared = evaluate(file, "prepare", &parameters)?;
    for (name, value) in &prepared {
        finite(&device.name, name, *value)?;
    }
    let share = evaluate(file, "constant_share", &prepared.iter().cloned().collect())?;
    let share: Numbers = share.into_iter().collect();
    let of = |name: &str| {
        let found = share.get(&format!("constant_{name}")).copied();
        found.ok_or_else(|| BakeError::Statement("constant_share".to_owned(), name.to_owned()))
    };
    let share = RigidBody {
        mass: of("m")?,
        first_moment: [of("mr_bx")?, of("mr_by")?, of("mr_bz")?],
        inertia: [of("i_11")?, of("i_12")?, of("i_13")?, of("i_22")?, of("i_23")?, of("i_33")?],
    };
    let bodies = device.body.iter().map(|body| Body {
        mass: body.mass,
        origin: body.origin,
        centre_of_mass: body.centre_of_mass,
        inertia: body.inertia,
    });
    let (bodies, links) = (bodies.collect::<Vec<_>>(), shape.kind.links);
    let joints: Vec<_> = links.iter().map(joint).collect();
    let driven = links.iter().enumerate().filter(|(_, link)| link.is_driven());
    let scales: Vec<_> = driven.map(|(k, _)| outboard(&bodies, &joints, k)).collect();
    for value in &scales {
        finite(&device.name, "inertia outboard of a joint", *value)?;
    }
    let number = |(name, value): (String, f64)| Number { name, value: float(value) };
    let folded = FoldedDevice {
        prepared: prepared.into_iter().map(number).collect(),
        has_scales: !scales.is_empty(),
        scales: list(scales.into_iter()),
    };
    Ok((share, folded))
}

/// The number that a source has.
fn number(
    source: Source,
    shape: &Shape<'_>,
    device: &Device,
    turned: Option<&Turned>,
) -> Option<f64> {
    let at = |link: &Link| {
        let name = link.joint.coordinate;
        let k = shape.kind.links.iter().position(|own| own.joint.coordinate == name)?;
        device.body.get(k)?.locked_at
    };
    Some(match source {
        Source::Location(place) => place.value(device),
        Source::Mount(row, column) => *device.mount.get(row)?.get(column)?,
        Source::Turn("sin_a") => turned?.sin_a,
        Source::Turn("cos_a") => turned?.cos_a,
        Source::Turn("sin_b") => turned?.sin_b,
        Source::Turn(_) => turned?.cos_b,
        Source::Sine(link) => sin_cos(at(link)?).0,
        Source::Cosine(link) => sin_cos(at(link)?).1,
        Source::Position(link) => at(link)?,
    })
}

fn joint(link: &Link) -> Joint {
    let slides = matches!(link.joint.motion, Motion::Slide(_));
    Joint { axis: link.joint.motion.axis().cycle()[0], slides }
}

fn finite(of: &str, name: &str, value: f64) -> Result<(), BakeError> {
    if value.is_finite() {
        return Ok(());
    }
    Err(BakeError::NotFinite(of.to_owned(), name.to_owned(), value))
}
