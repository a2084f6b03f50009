//! What the templates of a shape are filled from.

use precess_codegen::derivation::chain::assumed::{Exchange, Mount};
use precess_codegen::emit::{capital, wrapped};
use precess_codegen::kinds::{Link, Motion};
use serde::Serialize;
use tera::Context;

use crate::numbers::array;
use crate::parameters::{Fixed, Parameter, ParameterLocation, fixed, parameters};
use crate::records_c::parts_c;
use crate::shape::{Derived, Shape};
use crate::sources::{source, written};

/// A line of the list of assumptions is at most this wide, without its dash.
const WIDTH: usize = 94;

/// A joint and its body.
#[derive(Clone, Serialize)]
pub(crate) struct JointText {
    tag: &'static str,
    title: &'static str,
    coordinate: &'static str,
    rate: &'static str,
    acceleration: &'static str,
    torque: &'static str,
    unit: &'static str,
    axis: usize,
    slides: bool,
}

/// A number that must vanish: its name, what it is assumed to be, by how much it is off, its scale.
#[derive(Serialize)]
pub(crate) struct Check {
    name: String,
    assumed: String,
    off: String,
    pub(crate) scale: String,
    /// The same in C.
    scale_c: String,
}

/// A field and how it is written.
#[derive(Serialize)]
pub(crate) struct Assigned {
    name: String,
    rust: String,
    /// The same in C.
    c: String,
}

impl Assigned {
    pub(crate) fn new(name: String, rust: String) -> Self {
        Self { name, c: rust.replace("device.", "device->"), rust }
    }
}

fn joint(link: &Link) -> JointText {
    let slides = matches!(link.joint.motion, Motion::Slide(_));
    JointText {
        tag: link.joint.tag,
        title: link.body.title,
        coordinate: link.joint.coordinate,
        rate: link.joint.rate,
        acceleration: link.joint.acceleration,
        torque: link.joint.torque,
        unit: if slides { "m" } else { "rad" },
        axis: link.joint.motion.axis().cycle()[0],
        slides,
    }
}

/// How its scale is written.
fn scale(place: ParameterLocation) -> String {
    match place {
        ParameterLocation::Mass(k) => format!("b[{k}].mass"),
        ParameterLocation::Origin(..) | ParameterLocation::Centre(..) => "length".to_owned(),
        ParameterLocation::Inertia(k, ..) => format!("trace(&b[{k}].inertia)"),
    }
}

/// Everything that must vanish in a device of the shape.
pub(crate) fn checks(shape: &Shape<'_>) -> Vec<Check> {
    let check = |name: String, assumed: String, off: String, place| {
        let scale = scale(place);
        Check { name, assumed, off, scale_c: scale.replace('&', ""), scale }
    };
    let fixed = fixed(shape.general).into_iter().map(|fixed| match fixed {
        Fixed::Zero(place) => check(
            place.to_string(),
            "zero, as in every device of the kind".to_owned(),
            written(place),
            place,
        ),
        Fixed::Equal(place, other) => {
            let off = format!("{} - {}", written(place), written(other));
            check(place.to_string(), format!("equal to {other}"), off, place)
        }
    });
    let list = parameters(shape.general);
    let find = |name: &str| list.iter().find(|parameter| parameter.name == name);
    let assumed = &shape.assumed;
    let zero =
        assumed.zero.iter().filter_map(|name| find(name)).map(|Parameter { name, place }| {
            check(name.clone(), "zero".to_owned(), written(*place), *place)
        });
    let equal = assumed.equal.iter().filter_map(|(name, other)| {
        let (own, of) = (find(name)?, find(other)?);
        let off = format!("{} - {}", written(own.place), written(of.place));
        Some(check(name.clone(), format!("equal to {other}"), off, own.place))
    });
    fixed.chain(zero).chain(equal).collect()
}

/// What `prepare` takes.
fn values(shape: &Shape<'_>, derived: &Derived) -> Vec<Assigned> {
    let fields = derived.parameters.fields.iter();
    let assigned = fields.filter_map(|field| {
        let source = source(shape.kind, &field.name)?;
        Some(Assigned::new(field.name.clone(), source.written()))
    });
    assigned.collect()
}

fn exchange(of: Exchange) -> String {
    let row = |row: usize| array([0, 1, 2].map(|c| of.entry(row, c).to_string()).into_iter());
    array([0, 1, 2].map(row).into_iter())
}

/// The arguments of `eliminate`, as they are written.
fn arguments(shape: &Shape<'_>, letters: &[&'static str]) -> Vec<String> {
    let moving: Vec<_> = shape.kind.links.iter().filter(|link| !link.is_locked()).collect();
    let driven: Vec<_> = shape.kind.driven().collect();
    let fields = |list: Vec<String>| list.join(", ");
    let argument = |letter: &&str| match *letter {
        "q" => {
            let turning = shape.kind.turning().filter(|link| !link.is_locked());
            let both = turning.flat_map(|link| {
                ["sin", "cos"].map(|of| format!("{of}_{}", link.joint.coordinate))
            });
            format!("&kernels::Trig {{ {} }}", fields(both.collect()))
        }
        "s" => {
            let sliding =
                moving.iter().filter(|link| matches!(link.joint.motion, Motion::Slide(_)));
            let name = |link: &&Link| format!("{0}: joints.{0}", link.joint.coordinate);
            format!("&kernels::Positions {{ {} }}", fields(sliding.map(name).collect()))
        }
        "v" => {
            let rates = moving.iter().map(|link| format!("{0}: joints.{0}", link.joint.rate));
            format!("&kernels::Rates {{ {} }}", fields(rates.collect()))
        }
        "w" => "omega".to_owned(),
        "u" => {
            let own = |link: &&Link| {
                let (name, given) = (link.joint.torque, format!("u_{}", link.joint.tag));
                if name == given { given } else { format!("{name}: {given}") }
            };
            format!("&kernels::Motors {{ {} }}", fields(driven.iter().map(own).collect()))
        }
        "m" => {
            let own = |link: &&Link| {
                ["driven", "held", "given"].map(|of| format!("{of}_{}", link.joint.tag))
            };
            format!("&kernels::Modes {{ {} }}", fields(driven.iter().flat_map(own).collect()))
        }
        _ => "&self.prepared".to_owned(),
    };
    letters.iter().map(argument).collect()
}

/// The file that checks and calls the kernels of a shape.
pub(crate) fn device(
    shape: &Shape<'_>,
    derived: &Derived,
    [name, upper]: [&str; 2],
    test: &str,
) -> Context {
    let links = shape.kind.links;
    let letters = |name: &str| {
        let own = derived.emitted.functions.iter().find(|(function, ..)| function == name);
        own.map(|(_, letters, _)| letters.clone()).unwrap_or_default()
    };
    let eliminate = letters("eliminate");
    let turning: Vec<_> =
        shape.kind.turning().filter(|link| !link.is_locked()).map(joint).collect();
    let turning: Vec<_> = if eliminate.contains(&"q") { turning } else { Vec::new() };
    let locked: Vec<_> = links.iter().filter(|link| link.is_locked()).map(joint).collect();
    let checks = checks(shape);
    let mut context = names(shape);
    context.insert("lengths", &checks.iter().any(|check| check.scale == "length"));
    context.insert("traces", &checks.iter().any(|check| check.scale.starts_with("trace")));
    context.insert("sines", &(!turning.is_empty() || locked.iter().any(|joint| !joint.slides)));
    context.insert("checks", &checks);
    let places = links.iter().enumerate().filter(|(_, link)| link.is_driven());
    let places: Vec<_> = places.map(|(k, _)| k.to_string()).collect();
    context.insert("driven_places", &places.join(", "));
    context.insert("driven_list", &places);
    let (parts, arguments_c) = parts_c(shape, &eliminate, upper);
    context.insert("eliminate_c", &parts);
    context.insert("eliminate_arguments_c", &arguments_c);
    context.insert("name", name);
    context.insert("upper", upper);
    context.insert("test", test);
    context.insert("prepared_c", if shape.is_rigid() { "prepared" } else { "out->prepared" });
    context.insert("all", &links.iter().map(joint).collect::<Vec<_>>());
    let moving = links.iter().filter(|link| !link.is_locked()).map(joint);
    context.insert("joints", &moving.collect::<Vec<_>>());
    context.insert("driven", &shape.kind.driven().map(joint).collect::<Vec<_>>());
    context.insert("turning", &turning);
    context.insert("locked", &locked);
    context.insert("values", &values(shape, derived));
    context.insert("share_reads", &!letters("constant_share").is_empty());
    context.insert("eliminate_w", &eliminate.contains(&"w"));
    context.insert("eliminate", &arguments(shape, &eliminate));
    let back = letters("back_substitute").into_iter();
    let back = back.map(|letter| if letter == "a" { "hub" } else { "kept" });
    context.insert("back", &back.collect::<Vec<_>>().join(", "));
    if let Mount::Turned { outer, turns, inner } = shape.assumed.mount {
        context.insert("turned", &true);
        context.insert("turns", &turns.angles().len());
        context.insert("outer", &exchange(outer));
        context.insert("inner", &exchange(inner));
    } else {
        context.insert("turned", &false);
    }
    context
}

/// What every template says of a shape.
fn names(shape: &Shape<'_>) -> Context {
    let mut context = Context::new();
    let names: Vec<_> = shape.devices.iter().map(|device| device.name.as_str()).collect();
    let bodies: Vec<_> = shape.kind.links.iter().map(|link| link.body.title).collect();
    context.insert("module", shape.kind.name);
    context.insert("title", &capital(shape.general.title));
    context.insert("names", &names.join(", "));
    context.insert("assumed_lines", &listed(&shape.assumptions()));
    context.insert("bodies", &bodies.join(", "));
    context.insert("count", &shape.kind.links.len());
    context
}

/// A list of assumptions as lines of a comment; what does not fit on one goes on below it.
pub(crate) fn listed(assumptions: &[String]) -> Vec<String> {
    let lines = assumptions.iter().flat_map(|line| {
        let wrapped = wrapped(line, WIDTH).into_iter().enumerate();
        wrapped.map(|(k, line)| format!("{} {line}", if k == 0 { "-" } else { " " }))
    });
    lines.collect()
}
