//! What the templates of the whole spacecraft are filled from.

use precess_codegen::derivation::chain::assumed::Mount;
use precess_description::Description;
use serde::Serialize;
use tera::Context;

use crate::shape::{Derived, Operations, Shape};
use crate::values::{checks, listed};

/// A shape.
#[derive(Clone, Serialize)]
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
struct FunctionCost {
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
pub(crate) fn context(
    description: &Description,
    shapes: &[Shape<'_>],
    derived: &[Derived],
    operations: Operations,
    constants: bool,
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
        let row = |(function, _, count): &(String, Vec<&'static str>, usize)| FunctionCost {
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
    context.insert("assumed_lines", &listed(&lines));
    let all: Vec<_> = shapes.iter().zip(derived).map(shape).collect();
    context.insert("moving", &all.iter().filter(|shape| shape.moves).collect::<Vec<_>>());
    context.insert("shapes", &all);
    let names: Vec<_> = description.device.iter().map(|device| device.name.as_str()).collect();
    context.insert("names", &format!("hub, {}", names.join(", ")));
    context.insert("constants", &constants);
    context.insert("test", if constants { "#[cfg(test)]" } else { "" });
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
