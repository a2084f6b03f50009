//! C99: kernels, what checks and calls them, and a test program with reference values.

use precess_codegen::derivation::chain::Chain;
use precess_codegen::emit::{EmittedFile, c as emit_c};
use precess_codegen::graph::Graph;
use precess_description::Description;
use tera::Context;

use crate::error::BakeError;
use crate::numbers::c;
use crate::shape::{Derived, Shape};
use crate::templates::{COMMAND, templates};
use crate::test_values::reference;
use crate::values::device;

/// The templates.
const TEMPLATES: [(&str, &str); 11] = [
    ("parameters.h", include_str!("templates/parameters.h.tera")),
    ("device.h", include_str!("templates/device.h.tera")),
    ("prepare.c", include_str!("templates/prepare.c.tera")),
    ("construct.c", include_str!("templates/construct.c.tera")),
    ("constants.c", include_str!("templates/constants.c.tera")),
    ("shape.h", include_str!("templates/shape.h.tera")),
    ("shape.c", include_str!("templates/shape.c.tera")),
    ("whole.h", include_str!("templates/whole.h.tera")),
    ("whole.c", include_str!("templates/whole.c.tera")),
    ("test.c", include_str!("templates/test.c.tera")),
    ("README.md", include_str!("templates/README.md.tera")),
];

/// The files.
pub(crate) fn files(
    description: &Description,
    shapes: &[Shape<'_>],
    derived: &[Derived],
    whole: Context,
) -> Result<Vec<EmittedFile>, BakeError> {
    let tera = templates(&TEMPLATES);
    let mut files = emit_c::shared()?;
    for shape in shapes {
        let graph = Graph::new();
        let chain = Chain::assuming(&graph, shape.kind, shape.assumed.clone());
        files.extend(emit_c::of_chain(&chain, COMMAND)?);
    }
    let render = |template: &str, context: &Context| -> Result<String, BakeError> {
        let text = tera.render(template, context);
        text.map(|text| c(&text)).map_err(|error| BakeError::Emit(error.into()))
    };
    let (name, upper) = (description.name.as_str(), description.name.to_uppercase());
    let mut context = whole;
    context.insert("c", &true);
    let mut parts = ["device.h", "prepare.c", "shape.h", "shape.c"].map(|name| (name, Vec::new()));
    for (shape, derived) in shapes.iter().zip(derived) {
        let of = device(shape, derived, [name, &upper], "");
        for (template, texts) in &mut parts {
            texts.push(render(template, &of)?);
        }
    }
    for (key, (_, texts)) in ["devices", "prepared", "declared", "defined"].iter().zip(&parts) {
        context.insert(*key, texts);
    }
    // Of a spacecraft whose values are folded, they are in its tests only.
    let [parameters, construct] =
        ["parameters.h", "construct.c"].map(|name| render(name, &context));
    let (parameters, construct) = (parameters?, construct?);
    context.insert("parameters", &parameters);
    context.insert("construct", &construct);
    let constants = context.get("constants").and_then(tera::Value::as_bool).unwrap_or_default();
    if constants {
        context.insert("constants_c", &render("constants.c", &context)?);
    }
    let mut push = |path: String, text: String| files.push(EmittedFile { path, text });
    push(format!("{name}.h"), render("whole.h", &context)?);
    push(format!("{name}.c"), render("whole.c", &context)?);
    push("README.md".to_owned(), render("README.md", &context)?);
    let mut context = reference(description, shapes)?;
    context.insert("constants", &constants);
    context.insert("parameters", &parameters);
    context.insert("construct", &construct);
    push("test_reference.c".to_owned(), render("test.c", &context)?);
    Ok(files)
}
