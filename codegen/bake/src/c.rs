//! C99: kernels, what checks and calls them, and a test program with reference values.

use precess_codegen::derivation::chain::Chain;
use precess_codegen::emit::{EmittedFile, c as emit_c};
use precess_codegen::graph::Graph;
use precess_description::Description;
use tera::Context;

use crate::error::BakeError;
use crate::numbers::c;
use crate::shape::{Derived, Shape};
use crate::test_values::reference;
use crate::values::{device, whole};
use crate::{COMMAND, Operations, templates};

/// A line of the list of assumptions is at most this wide.
const WIDTH: usize = 96;

/// The templates.
const TEMPLATES: [(&str, &str); 6] = [
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
    operations: Operations,
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
    let mut declared = Vec::new();
    let mut defined = Vec::new();
    for (shape, derived) in shapes.iter().zip(derived) {
        let context = device(shape, derived, [name, &upper]);
        declared.push(render("shape.h", &context)?);
        defined.push(render("shape.c", &context)?);
    }
    let mut context = whole(description, shapes, derived, operations);
    context.insert("c", &true);
    context.insert("declared", &declared);
    context.insert("defined", &defined);
    let lines = shapes.iter().flat_map(Shape::assumptions);
    let lines = lines.flat_map(|line| wrapped(&format!("- {line}")));
    context.insert("assumptions_c", &lines.collect::<Vec<_>>());
    let mut push = |path: String, text: String| files.push(EmittedFile { path, text });
    push(format!("{name}.h"), render("whole.h", &context)?);
    push(format!("{name}.c"), render("whole.c", &context)?);
    push("README.md".to_owned(), render("README.md", &context)?);
    let context = reference(description, shapes)?;
    push("test_reference.c".to_owned(), render("test.c", &context)?);
    Ok(files)
}

/// Words in lines of the width of a comment; the following ones are indented.
fn wrapped(text: &str) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.len() + 1 + word.len() <= WIDTH => {
                line.push(' ');
                line.push_str(word);
            }
            Some(_) => lines.push(format!("  {word}")),
            None => lines.push(word.to_owned()),
        }
    }
    lines
}
