//! What the templates of one kind are filled from.

use precess_codegen::emit::c::{Signature, signatures};
use precess_codegen::emit::capital;
use precess_codegen::kernel::{pose, wrenches};
use precess_codegen::kinds::{Kind, Link, Motion};
use serde::Serialize;
use tera::Context;

use crate::error::BakeError;
use crate::parameters::{Fixed, ParameterLocation, fixed, parameters};

/// A joint and its body.
#[derive(Serialize)]
struct LinkText {
    place: usize,
    title: &'static str,
    tag: &'static str,
    coordinate: &'static str,
    rate: &'static str,
    acceleration: &'static str,
    torque: &'static str,
    unit: &'static str,
    axis: usize,
    slides_c: u8,
    driven: bool,
    driven_c: u8,
    /// The field of its diagonal among what elimination returns.
    diagonal: String,
}

/// A component of a wrench: its field in a kernel's record, and where it is.
#[derive(Serialize)]
struct Component {
    name: String,
    place: usize,
    /// `joints[1]`, or `hub`.
    record: String,
    vector: &'static str,
    axis: usize,
}

/// A record of a pose.
#[derive(Serialize)]
struct PoseText {
    letter: &'static str,
    record: &'static str,
}

/// A parameter of `prepare` and its value.
#[derive(Serialize)]
struct Value {
    name: String,
    value: String,
}

/// What the kind has no parameter for.
#[derive(Serialize)]
struct Check {
    what: String,
    off: String,
    scale: String,
}

/// What the files of a kind say.
pub(super) fn context(kind: &'static Kind) -> Result<Context, BakeError> {
    let signatures = signatures(kind).map_err(BakeError::Emit)?;
    let links: Vec<_> =
        kind.links.iter().enumerate().map(|(k, link)| link_text(&signatures, k, link)).collect();
    let turning: Vec<_> =
        (0..links.len()).filter(|k| kind.axes_turn(*k)).map(|k| &links[k]).collect();
    let slides = |(k, link): (usize, &Link)| {
        matches!(link.joint.motion, Motion::Slide(_)).then_some(&links[k])
    };
    let sliding: Vec<_> = kind.links.iter().enumerate().filter_map(slides).collect();
    let poses = pose(kind).into_iter().map(|(letter, _)| PoseText {
        letter,
        record: if letter == "q" { "trig" } else { "positions" },
    });
    let poses: Vec<_> = poses.collect();
    let mut context = Context::new();
    context.insert("name", kind.name);
    context.insert("upper", &kind.name.to_uppercase());
    context.insert("title", &capital(kind.title));
    context.insert("count", &links.len());
    context.insert("turning", &turning);
    context.insert("sliding", &sliding);
    context.insert("driven", &links.iter().filter(|link| link.driven).collect::<Vec<_>>());
    let held = links.iter().filter(|link| !link.driven).map(|link| link.place);
    context.insert("held_places", &held.collect::<Vec<_>>());
    context.insert("links", &links);
    context.insert("pose", &poses);
    context.insert("values", &values(kind));
    let checks = checks(kind);
    context.insert("lengths", &checks.iter().any(|check| check.scale == "length"));
    context.insert("checks", &checks);
    context.insert("entries", &["11", "12", "13", "22", "23", "33"]);
    let on_bodies = wrenches(kind).fields.into_iter().map(|field| field.name).collect();
    context.insert("wrenches", &components(on_bodies));
    context.insert("carried", &components(fields(&signatures, "external")));
    for (key, kernel) in [
        ("share_arguments", "constant_share"),
        ("eliminate_arguments", "eliminate"),
        ("back_arguments", "back_substitute"),
        ("external_arguments", "external"),
        ("gravity_arguments", "gravity"),
        ("load_derivatives_arguments", "load_derivatives"),
    ] {
        context.insert(key, &arguments(&signatures, kernel));
    }
    Ok(context)
}

fn link_text(signatures: &[Signature], place: usize, link: &Link) -> LinkText {
    let slides = matches!(link.joint.motion, Motion::Slide(_));
    let returned = fields(signatures, "eliminate");
    let names = ["diagonal", "pivot"].map(|what| format!("{what}_{}", link.joint.tag));
    let diagonal = names.into_iter().find(|name| returned.contains(name)).unwrap_or_default();
    LinkText {
        place,
        title: link.body.title,
        tag: link.joint.tag,
        coordinate: link.joint.coordinate,
        rate: link.joint.rate,
        acceleration: link.joint.acceleration,
        torque: link.joint.torque,
        unit: if slides { "m" } else { "rad" },
        axis: link.joint.motion.axis().cycle()[0],
        slides_c: u8::from(slides),
        driven: link.is_driven(),
        driven_c: u8::from(link.is_driven()),
        diagonal,
    }
}

/// The fields that a kernel returns.
fn fields(signatures: &[Signature], kernel: &str) -> Vec<String> {
    let own = signatures.iter().find(|signature| signature.name == kernel);
    let fields = own.into_iter().flat_map(|signature| &signature.output.fields);
    fields.map(|field| field.name.clone()).collect()
}

/// The arguments of a kernel, each followed by a comma.
fn arguments(signatures: &[Signature], kernel: &str) -> String {
    let own = signatures.iter().find(|signature| signature.name == kernel);
    let letters = own.into_iter().flat_map(|signature| &signature.inputs);
    let argument = |letter: &'static str| match (kernel, letter) {
        ("constant_share", "p") => "&out->prepared, ".to_owned(),
        (_, "p") => "&device->prepared, ".to_owned(),
        (_, "q" | "s") => format!("&pose->{letter}, "),
        (_, "w") => "omega, ".to_owned(),
        (_, "e") => "gains, ".to_owned(),
        (_, "a") => "hub, ".to_owned(),
        _ => format!("&{letter}, "),
    };
    letters.map(|(letter, _)| argument(letter)).collect()
}

/// Six fields a body: force and moment; after those of the bodies, of the hub.
fn components(names: Vec<String>) -> Vec<Component> {
    let bodies = names.len() / 6;
    let on_hub = names.iter().any(|name| name.ends_with("_bx"));
    let component = |(k, name): (usize, String)| {
        let (place, within) = (k / 6, k % 6);
        let record = if on_hub && place + 1 == bodies {
            "hub".to_owned()
        } else {
            format!("joints[{place}]")
        };
        let vector = if within < 3 { "force" } else { "moment" };
        Component { name, place, record, vector, axis: within % 3 }
    };
    names.into_iter().enumerate().map(component).collect()
}

/// What `prepare` takes.
fn values(kind: &Kind) -> Vec<Value> {
    let mount = (0..9).map(|k| {
        let (row, column) = (k / 3, k % 3);
        let name = format!("mount_{}{}", row + 1, column + 1);
        Value { name, value: format!("mount->columns[{column}][{row}]") }
    });
    let own = parameters(kind).into_iter();
    let own = own.map(|parameter| Value { name: parameter.name, value: written(parameter.place) });
    mount.chain(own).collect()
}

/// What the kind has no parameter for.
fn checks(kind: &Kind) -> Vec<Check> {
    let scale = |place| match place {
        ParameterLocation::Mass(k) => format!("b[{k}].mass"),
        ParameterLocation::Origin(..) | ParameterLocation::Centre(..) => "length".to_owned(),
        ParameterLocation::Inertia(k, ..) => format!("precess_trace(&b[{k}])"),
    };
    let check = |fixed: Fixed| match fixed {
        Fixed::Zero(place) => Check {
            what: format!("{place}: zero in this kind"),
            off: written(place),
            scale: scale(place),
        },
        Fixed::Equal(place, other) => Check {
            what: format!("{place}: as {other} in this kind"),
            off: format!("{} - {}", written(place), written(other)),
            scale: scale(place),
        },
    };
    fixed(kind).into_iter().map(check).collect()
}

/// How a number of the bodies is written.
fn written(place: ParameterLocation) -> String {
    match place {
        ParameterLocation::Mass(k) => format!("b[{k}].mass"),
        ParameterLocation::Origin(0, c) => format!("origin[{c}]"),
        ParameterLocation::Origin(k, c) => format!("b[{k}].origin[{c}]"),
        ParameterLocation::Centre(k, c) => format!("b[{k}].centre_of_mass[{c}]"),
        ParameterLocation::Inertia(k, row, column) => {
            let (row, column) = (row.min(column), row.max(column));
            let entry = [0, 2, 3][row] + column;
            format!("b[{k}].inertia[{entry}]")
        }
    }
}
