//! What the templates are filled from.

use precess_codegen::derivation::assumed::{Exchange, Mount};
use precess_codegen::kinds::{Link, Motion};
use precess_description::Description;
use serde::Serialize;
use tera::Context;

use crate::Operations;
use crate::numbers::array;
use crate::parameters::{Fixed, Parameter, Place, fixed, parameters};
use crate::records_c::parts_c;
use crate::shape::{Derived, Shape};

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
    pub(crate) slides: bool,
}

/// A number that must vanish: its name, what it is assumed to be, by how much it is off, its scale.
#[derive(Serialize)]
struct Check {
    name: String,
    assumed: String,
    off: String,
    scale: String,
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

pub(crate) fn joint(link: &Link) -> JointText {
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

/// How a place is written.
pub(crate) fn written(place: Place) -> String {
    match place {
        Place::Mass(k) => format!("b[{k}].mass"),
        Place::Origin(0, c) => format!("origin[{c}]"),
        Place::Origin(k, c) => format!("b[{k}].origin[{c}]"),
        Place::Centre(k, c) => format!("b[{k}].centre_of_mass[{c}]"),
        Place::Inertia(k, row, column) => format!("b[{k}].inertia[{row}][{column}]"),
    }
}

/// How its scale is written.
fn scale(place: Place) -> String {
    match place {
        Place::Mass(k) => format!("b[{k}].mass"),
        Place::Origin(..) | Place::Centre(..) => "length".to_owned(),
        Place::Inertia(k, ..) => format!("trace(&b[{k}].inertia)"),
    }
}

/// Everything that must vanish in a device of the shape.
fn checks(shape: &Shape<'_>) -> Vec<Check> {
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
    let list = parameters(shape.general);
    let value = |name: &str| {
        if let Some(parameter) = list.iter().find(|parameter| parameter.name == name) {
            return written(parameter.place);
        }
        if let Some(entry) = name.strip_prefix("mount_") {
            let index = |k: usize| entry.get(k..=k).and_then(|digit| digit.parse::<usize>().ok());
            if let (Some(row), Some(column)) = (index(0), index(1)) {
                return format!("m[{}][{}]", row - 1, column - 1);
            }
        }
        if let Some(turn) = name.strip_suffix("mount_a").or_else(|| name.strip_suffix("mount_b")) {
            return format!("turned.{turn}{}", &name[name.len() - 1..]);
        }
        // Sine or cosine of a locked angle, or a locked position.
        if name.starts_with("sin_") || name.starts_with("cos_") {
            return name.to_owned();
        }
        format!("device.{name}")
    };
    let fields = derived.parameters.fields.iter();
    fields.map(|field| Assigned::new(field.name.clone(), value(&field.name))).collect()
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
pub(crate) fn device(shape: &Shape<'_>, derived: &Derived, [name, upper]: [&str; 2]) -> Context {
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
    context.insert("assumptions", &shape.assumptions());
    context.insert("bodies", &bodies.join(", "));
    context.insert("count", &shape.kind.links.len());
    context
}

#[derive(Serialize)]
struct ShapeText {
    module: &'static str,
    names: String,
    count: usize,
    /// Whether a joint of it moves.
    moves: bool,
    /// Whether one has a motor.
    is_driven: bool,
    /// The arguments of back substitution in C.
    back_c: String,
    /// `Some(a), Some(b)`, and `a, b`.
    somes: String,
    elements: String,
    finite: String,
    /// Whether one is not, in C.
    finite_c: String,
}

#[derive(Serialize)]
struct RowText {
    module: &'static str,
    function: String,
    count: usize,
}

/// The arguments of back substitution in C, each followed by a comma.
fn back_c(shape: &Shape<'_>, derived: &Derived) -> String {
    let own = derived.emitted.functions.iter().find(|(name, ..)| name == "back_substitute");
    let letters = own.map(|(_, letters, _)| letters.as_slice()).unwrap_or_default();
    let argument = |letter: &&str| match *letter {
        "a" => "&out->hub, ".to_owned(),
        _ => format!("&{}_gains[k], ", shape.kind.name),
    };
    letters.iter().map(argument).collect()
}

/// What the files of the whole spacecraft say.
pub(crate) fn whole(
    description: &Description,
    shapes: &[Shape<'_>],
    derived: &[Derived],
    operations: Operations,
) -> Context {
    let shape = |(shape, derived): (&Shape<'_>, &Derived)| {
        let elements: Vec<_> = (0..shape.devices.len()).map(|k| format!("d_{k}")).collect();
        let somes: Vec<_> = elements.iter().map(|name| format!("Some({name})")).collect();
        let moving = shape.kind.links.iter().filter(|link| !link.is_locked());
        let finite = moving.map(|link| format!("own.{}.is_finite()", link.joint.acceleration));
        let finite: Vec<_> = finite.collect();
        let moving = shape.kind.links.iter().filter(|link| !link.is_locked());
        let infinite =
            moving.map(|link| format!("own->{0} - own->{0} != 0.0", link.joint.acceleration));
        let names: Vec<_> = shape.devices.iter().map(|device| device.name.as_str()).collect();
        ShapeText {
            module: shape.kind.name,
            names: names.join(", "),
            count: shape.devices.len(),
            moves: !finite.is_empty(),
            is_driven: shape.kind.driven().next().is_some(),
            back_c: back_c(shape, derived),
            somes: somes.join(", "),
            elements: elements.join(", "),
            finite: finite.join(" && "),
            finite_c: infinite.collect::<Vec<_>>().join(" || "),
        }
    };
    let rows = shapes.iter().zip(derived).flat_map(|(shape, derived)| {
        let row = |(function, _, count): &(String, Vec<&'static str>, usize)| RowText {
            module: shape.kind.name,
            function: function.clone(),
            count: *count,
        };
        derived.emitted.functions.iter().map(row)
    });
    let mut context = Context::new();
    let title = if description.title.is_empty() { &description.name } else { &description.title };
    // Brackets and ends of comments would be those of the templates, or of C.
    context.insert("title", &title.replace(['⟦', '⟧'], "").replace("*/", "* /"));
    context.insert("name", &description.name);
    context.insert("package", &description.name.replace('_', "-"));
    let lines: Vec<_> = shapes.iter().flat_map(Shape::assumptions).collect();
    context.insert("assumptions", &lines);
    context.insert("shapes", &shapes.iter().zip(derived).map(shape).collect::<Vec<_>>());
    context.insert("rows", &rows.collect::<Vec<_>>());
    context.insert("operations", &operations);
    context.insert("claims", &derived.iter().map(|derived| derived.proof.len()).sum::<usize>());
    context.insert("c", &false);
    context.insert("upper", &description.name.to_uppercase());
    let turned = shapes.iter().any(|shape| shape.assumed.mount != Mount::Any);
    context.insert("any_turned", &turned);
    let driven = shapes.iter().any(|shape| shape.kind.driven().next().is_some());
    context.insert("any_driven", &driven);
    let scales: Vec<_> = shapes.iter().flat_map(checks).map(|check| check.scale).collect();
    context.insert("lengths", &scales.iter().any(|scale| scale == "length"));
    context
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}
