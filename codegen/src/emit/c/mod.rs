//! The second back end: the kernels as C99, for those who cannot link Rust.
//!
//! From the very statements that are emitted as Rust, so that sharing, order, names and rounding
//! are theirs; only the syntax differs. Names are prefixed by `precess_` and the kind's. What is
//! proven is the Rust; that the C computes the same bits is shown by running both.

mod declaration;
mod expression;

pub use declaration::{function, tag};

use serde::Serialize;
use tera::{Context, Tera};

use super::error::EmitError;
use super::file::{EmittedFile, describe, symmetric};
use super::parts::{Part, parts};
use super::text::{capital, fnv1a64};
use crate::derivation::chain::Chain;
use crate::graph::Graph;
use crate::kernel::{Record, Source, shared_records};
use crate::kinds::{KINDS, Kind};
use crate::threads::side_by_side;

/// Hand-written C of the solver: what an evaluation needs besides the kernels.
const BY_HAND: [(&str, &str); 5] = [
    ("precess_body.c", include_str!("by_hand/precess_body.c")),
    ("precess_solve.h", include_str!("by_hand/precess_solve.h")),
    ("precess_solve.c", include_str!("by_hand/precess_solve.c")),
    ("precess_sin_cos.h", include_str!("by_hand/precess_sin_cos.h")),
    ("precess_sin_cos.c", include_str!("by_hand/precess_sin_cos.c")),
];

/// Hand-written C of the rest of the solver: joints, gravity, attitude, what devices share.
const SOLVER: [(&str, &str); 17] = [
    ("precess_status.h", include_str!("by_hand/precess_status.h")),
    ("precess_arithmetic.h", include_str!("by_hand/precess_arithmetic.h")),
    ("precess_arithmetic.c", include_str!("by_hand/precess_arithmetic.c")),
    ("precess_joint.h", include_str!("by_hand/precess_joint.h")),
    ("precess_joint.c", include_str!("by_hand/precess_joint.c")),
    ("precess_gravity.h", include_str!("by_hand/precess_gravity.h")),
    ("precess_gravity.c", include_str!("by_hand/precess_gravity.c")),
    ("precess_attitude.h", include_str!("by_hand/precess_attitude.h")),
    ("precess_attitude.c", include_str!("by_hand/precess_attitude.c")),
    ("precess_evaluation.h", include_str!("by_hand/precess_evaluation.h")),
    ("precess_evaluation.c", include_str!("by_hand/precess_evaluation.c")),
    ("precess_device.h", include_str!("by_hand/precess_device.h")),
    ("precess_device.c", include_str!("by_hand/precess_device.c")),
    ("precess_jvp.h", include_str!("by_hand/precess_jvp.h")),
    ("precess_jvp.c", include_str!("by_hand/precess_jvp.c")),
    ("precess_wrap.h", include_str!("by_hand/precess_wrap.h")),
    ("precess_wrap.c", include_str!("by_hand/precess_wrap.c")),
];

/// Hand-written C of batches, and headers in place of those of the system, which NVRTC has not.
const BATCH: [(&str, &str); 5] = [
    ("precess_batch.h", include_str!("by_hand/precess_batch.h")),
    ("nvrtc/float.h", include_str!("by_hand/nvrtc/float.h")),
    ("nvrtc/stddef.h", include_str!("by_hand/nvrtc/stddef.h")),
    ("nvrtc/stdint.h", include_str!("by_hand/nvrtc/stdint.h")),
    ("nvrtc/string.h", include_str!("by_hand/nvrtc/string.h")),
];

/// The kernels of every kind, the records that they share, and the hub's equations.
///
/// # Errors
/// When a statement or a name is none of C's.
pub fn files() -> Result<Vec<EmittedFile>, EmitError> {
    let mut files = Vec::new();
    for kind in side_by_side(KINDS, of_kind) {
        files.extend(kind?);
    }
    files.extend(shared()?);
    files.extend(solver());
    Ok(files)
}

/// The records that kernels share, the hub's equations, and sines.
///
/// # Errors
/// When the template fails.
pub fn shared() -> Result<Vec<EmittedFile>, EmitError> {
    let mut files = Vec::new();
    let mut context = Context::new();
    context.insert("hash", &fnv1a64(&format!("{:?}", shared_records())));
    let records = shared_records().map(|record| declaration::structure("", &record));
    context.insert("records", &records);
    let text = templates()?.render("hub.h", &context)?;
    files.push(EmittedFile { path: "precess_hub.h".to_owned(), text });
    let by_hand =
        BY_HAND.map(|(path, text)| EmittedFile { path: path.to_owned(), text: text.to_owned() });
    files.extend(by_hand);
    Ok(files)
}

/// The rest of the solver, apart from what depends on kinds: joints, gravity, attitude, devices.
#[must_use]
pub fn solver() -> Vec<EmittedFile> {
    as_written(&SOLVER)
}

/// What batches add to the solver, apart from what depends on kinds.
#[must_use]
pub fn batch() -> Vec<EmittedFile> {
    as_written(&BATCH)
}

fn as_written(files: &[(&str, &str)]) -> Vec<EmittedFile> {
    let file = |(path, text): &(&str, &str)| EmittedFile {
        path: (*path).to_owned(),
        text: (*text).to_owned(),
    };
    files.iter().map(file).collect()
}

/// Header and source of one kind.
///
/// # Errors
/// When a statement or a name is none of C's.
pub fn of_kind(kind: &'static Kind) -> Result<Vec<EmittedFile>, EmitError> {
    let graph = Graph::new();
    of_chain(&Chain::new(&graph, kind), "cargo xtask regen --emit c")
}

/// Header and source of a chain, written by `command`.
///
/// # Errors
/// When a statement or a name is none of C's.
pub fn of_chain(chain: &Chain<'_>, command: &str) -> Result<Vec<EmittedFile>, EmitError> {
    let kind = chain.kind;
    let super::parts::Parts { mut records, functions, stated, inputs } = parts(chain)?;
    let bodies = functions.iter().map(|part| sections(kind, part));
    let bodies = bodies.collect::<Result<Vec<_>, _>>()?;
    for (part, body) in functions.iter().zip(&bodies).filter(|(part, _)| part.name == "prepare") {
        if let Some(own) = records.iter_mut().find(|own| **own == part.output) {
            describe(own, body.iter().flat_map(|(_, lines)| lines.clone()), &stated);
        }
    }
    let written = functions.iter().zip(&bodies).map(|(part, body)| FunctionText {
        signature: declaration::head(kind.name, part),
        sections: body.iter().map(section).collect(),
        result: unread(part, body).chain(results(part, &part.output, "out->")).collect(),
    });
    let header = format!("precess_{}.h", kind.name);
    let mut context = Context::new();
    context.insert("command", command);
    context.insert("source", kind.source);
    let template =
        concat!(include_str!("templates/kind.h.tera"), include_str!("templates/kind.c.tera"));
    context.insert("hash", &fnv1a64(&(inputs + template)));
    context.insert("title", &capital(kind.title));
    context.insert("symmetric", &symmetric(kind));
    context.insert("guard", &format!("PRECESS_{}_H", kind.name.to_uppercase()));
    context.insert("header", &header);
    let structures = records.iter().map(|record| declaration::structure(kind.name, record));
    context.insert("records", &structures.collect::<Vec<_>>());
    let declared = functions.iter().map(|part| declaration::declaration(kind.name, part));
    context.insert("functions", &declared.collect::<Vec<_>>());
    let tera = templates()?;
    let declarations = tera.render("kind.h", &context)?;
    context.insert("functions", &written.collect::<Vec<_>>());
    let definitions = tera.render("kind.c", &context)?;
    let source = format!("precess_{}.c", kind.name);
    let files = [(header, declarations), (source, definitions)];
    Ok(files.map(|(path, text)| EmittedFile { path, text }).into())
}

/// The arguments and the result of a function, as whoever calls it has to know them.
#[derive(Clone, Debug)]
pub struct Signature {
    /// Its name among those of the kind.
    pub name: String,
    /// Letters and records of what it reads, in order.
    pub inputs: Vec<(&'static str, Record)>,
    /// What it finds.
    pub output: Record,
}

/// The functions of a kind, in the order of the emitted files.
///
/// # Errors
/// When a name would stand for two values.
pub fn signatures(kind: &'static Kind) -> Result<Vec<Signature>, EmitError> {
    let graph = Graph::new();
    let functions = parts(&Chain::new(&graph, kind))?.functions.into_iter();
    let signature = |Part { name, inputs, output, .. }| Signature { name, inputs, output };
    Ok(functions.map(signature).collect())
}

#[derive(Serialize)]
struct FunctionText {
    signature: String,
    sections: Vec<SectionText>,
    result: Vec<String>,
}

#[derive(Serialize)]
struct SectionText {
    title: Vec<String>,
    lines: Vec<String>,
}

fn templates() -> Result<Tera, EmitError> {
    let mut tera = Tera::default();
    tera.autoescape_on(Vec::<&str>::new());
    for (name, text) in [
        ("kind.h", include_str!("templates/kind.h.tera")),
        ("kind.c", include_str!("templates/kind.c.tera")),
        ("hub.h", include_str!("templates/hub.h.tera")),
    ] {
        tera.add_raw_template(name, text)?;
    }
    Ok(tera)
}

/// Title and statements, section by section.
type Sections = Vec<(String, Vec<String>)>;

fn sections(kind: &Kind, part: &Part) -> Result<Sections, EmitError> {
    let mut sections = Vec::new();
    for (title, statements) in &part.body.sections {
        let lines = statements.iter().map(|tokens| {
            expression::statement(tokens.clone()).ok_or_else(|| EmitError::NoC {
                function: function(kind.name, &part.name),
                statement: tokens.to_string(),
            })
        });
        sections.push((title.clone(), lines.collect::<Result<_, _>>()?));
    }
    Ok(sections)
}

fn section((title, statements): &(String, Vec<String>)) -> SectionText {
    let lines = statements.iter().flat_map(|statement| expression::lines(statement, 4));
    SectionText { title: declaration::title(title), lines: lines.collect() }
}

/// Arguments that Rust reads for the type of a constant only: in C, which has one type, not at all.
fn unread<'a>(part: &'a Part, body: &'a Sections) -> impl Iterator<Item = String> + 'a {
    let unread = |letter: &&str| {
        let read = format!("{letter}->");
        let copied = format!("{letter}.");
        !body.iter().flat_map(|(_, lines)| lines).any(|line| line.contains(&read))
            && !part.body.copies.values().any(|value| value.starts_with(&copied))
    };
    let letters = part.inputs.iter().map(|(letter, _)| *letter);
    letters.filter(move |letter| unread(letter)).map(|letter| format!("(void){letter};"))
}

/// The assignments that fill the record at `place`.
fn results(part: &Part, record: &Record, place: &str) -> Vec<String> {
    let mut lines = Vec::new();
    for field in &record.fields {
        let name = &field.name;
        let mut assign = |value: &str| {
            let value = part.body.result(value).replace('.', "->");
            lines.push(format!("{place}{name} = {value};"));
        };
        match &field.source {
            Source::Own => assign(name),
            Source::Named(value) => assign(value),
            Source::Nested(record) => {
                lines.extend(results(part, record, &format!("{place}{name}.")));
            }
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::emit::text::LINE;

    #[test]
    fn every_kind_has_header_and_source_and_no_line_is_too_wide() {
        let files = files().unwrap();
        let stems = KINDS.map(|kind| format!("precess_{}", kind.name));
        let expected = stems.iter().flat_map(|stem| ["h", "c"].map(|end| format!("{stem}.{end}")));
        let shared = ["precess_hub.h"].into_iter().chain(BY_HAND.map(|(path, _)| path));
        let solver = SOLVER.map(|(path, _)| path);
        let expected = expected.chain(shared.chain(solver).map(str::to_owned));
        let expected: Vec<_> = expected.collect();
        assert_eq!(files.iter().map(|file| file.path.clone()).collect::<Vec<_>>(), expected);
        for file in &files {
            let wide = file.text.lines().find(|line| line.chars().count() > LINE);
            assert_eq!(wide, None, "{}", file.path);
        }
    }

    #[test]
    #[ignore = "long: `cargo xtask test --all`"]
    fn every_function_is_declared_and_defined_once() {
        for kind in KINDS {
            let files = of_kind(kind).unwrap();
            for signature in signatures(kind).unwrap() {
                let head = format!("void {}(", function(kind.name, &signature.name));
                assert!(files.iter().all(|file| file.text.matches(&head).count() == 1), "{head}");
            }
        }
    }
}
