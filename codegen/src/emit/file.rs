//! The files: records and functions laid out by templates.

use std::collections::{HashMap, HashSet};
use std::fmt;

use proc_macro2::TokenStream;
use serde::Serialize;
use tera::{Context, Tera};

use super::body::{Counts, FunctionBody, Writer};
use super::by_number::by_number;
use super::cost::{CountText, chain_passes, count, factoring};
use super::device::{Signature, Signatures, device_file, type_name};
use super::functions::{Functions, functions};
use super::home::Home;
use super::prepare::Prepared;
use super::render::Rendered;
use super::text::{COMMENT, LINE, capital, fnv1a64, literal, pretty, spaced, wrapped};
use crate::derivation::chain::Chain;
use crate::graph::{Node, NodeId};
use crate::kernel::{Kernel, Record, Source, parameters};
use crate::kernel::{joint_accelerations, modes, motors, pose, rates, shared_records, wrenches};
use crate::kinds::{Kind, Motion};

/// Where the time of an evaluation goes. What is asked once in a while keeps plain operators.
/// Inlined, since lanes reach the wide instructions of their caller only so.
const FUSED: [&str; 2] = ["eliminate", "back_substitute"];
/// The records that are gathered into lanes or spread from them.
const LANED: [&str; 4] = ["Prepared", "JointAccelerations", "HubShare", "Gains"];

/// One emitted file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EmittedFile {
    /// Path from the repository's root.
    pub path: String,
    /// Its text.
    pub text: String,
}

/// Why a file could not be laid out: a fault of the generator, not of its input.
#[derive(Debug)]
pub enum EmitError {
    /// A template failed.
    Template(tera::Error),
    /// The result is not Rust.
    Syntax(String, syn::Error),
    /// A line is too wide.
    Width(String, usize),
}

impl fmt::Display for EmitError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Template(error) => write!(f, "template: {error}"),
            Self::Syntax(path, error) => write!(f, "{path} would not parse: {error}"),
            Self::Width(path, line) => {
                write!(f, "{path}:{line} would be wider than {LINE} columns; shorten its name")
            }
        }
    }
}

impl std::error::Error for EmitError {}

impl From<tera::Error> for EmitError {
    fn from(error: tera::Error) -> Self {
        Self::Template(error)
    }
}

#[derive(Serialize)]
struct FieldText {
    name: String,
    doc: Vec<String>,
    ty: String,
}

#[derive(Serialize)]
pub(super) struct RecordText {
    name: String,
    doc: Vec<String>,
    fields: Vec<FieldText>,
    /// The functions that change each number, for records that lanes take apart.
    by_number: Vec<String>,
}

#[derive(Serialize)]
struct SectionText {
    title: Vec<String>,
    lines: Vec<String>,
}

#[derive(Serialize)]
struct FunctionText {
    doc: Vec<String>,
    inlined: bool,
    signature: String,
    sections: Vec<SectionText>,
    result: Vec<String>,
}

/// What is emitted of one kind.
#[derive(Clone, Debug)]
pub struct Emitted {
    /// Its files.
    pub files: Vec<EmittedFile>,
    pub(super) module: &'static str,
    pub(super) device_type: String,
    pub(super) counts: Vec<CountText>,
    /// Operations of `eliminate` after each set of passes over the chain.
    pub(super) passes: Vec<usize>,
    /// Function, and its operations before and after common factors are taken out of it.
    pub(super) factoring: Vec<(String, usize, usize)>,
}

impl Emitted {
    /// Kind, and operations of `eliminate` after each set of passes over the chain.
    pub(crate) fn passes(&self) -> (&'static str, &[usize]) {
        (self.module, &self.passes)
    }

    /// Each function and what a call of it costs.
    pub(crate) fn operations(&self) -> Vec<(String, usize)> {
        self.counts.iter().map(|count| (count.function.clone(), count.total)).collect()
    }
}

/// The files of one kind, for the crate that they are part of.
///
/// # Errors
/// When a template fails or a file would not parse.
pub fn of_kind(chain: &Chain<'_>, home: Home<'_>) -> Result<Emitted, EmitError> {
    let mut counts = Vec::new();
    let (tera, mut signatures) = (templates()?, Signatures::new());
    let kernels = kind_file(&tera, chain, home, &mut counts, &mut signatures)?;
    let device = device_file(&tera, chain.kind, home, &signatures)?;
    let device_type = type_name(chain.kind);
    let files = vec![kernels, device];
    let passes = chain_passes(chain.kind);
    let factoring = factoring(chain.kind, &counts);
    Ok(Emitted { files, module: chain.kind.name, device_type, counts, passes, factoring })
}

pub(super) fn templates() -> Result<Tera, EmitError> {
    let mut tera = Tera::default();
    tera.autoescape_on(Vec::<&str>::new());
    for (name, text) in [
        ("kind.rs", include_str!("templates/kind.rs.tera")),
        ("device.rs", include_str!("templates/device.rs.tera")),
        ("hub.rs", include_str!("templates/hub.rs.tera")),
        ("mod.rs", include_str!("templates/mod.rs.tera")),
        ("operations.md", include_str!("templates/operations.md.tera")),
    ] {
        tera.add_raw_template(name, text)?;
    }
    Ok(tera)
}

pub(super) fn rust_file(path: String, text: String) -> Result<EmittedFile, EmitError> {
    if let Some(line) = text.lines().position(|line| line.chars().count() > LINE) {
        return Err(EmitError::Width(path, line + 1));
    }
    syn::parse_file(&text).map_err(|error| EmitError::Syntax(path.clone(), error))?;
    Ok(EmittedFile { path, text })
}

fn kind_file(
    tera: &Tera,
    chain: &Chain<'_>,
    home: Home<'_>,
    rows: &mut Vec<CountText>,
    signatures: &mut Signatures,
) -> Result<EmittedFile, EmitError> {
    let kind = chain.kind;
    let Functions { kernels, mut prepared } = functions(chain);
    let raw = parameters(kind);

    let body = prepare_body(chain, &prepared);
    describe(&mut prepared.record, &body);
    let computed = prepared.computed(&raw);
    let fields = prepared.record.fields.iter().map(|field| {
        let own = !computed.contains(&field.name);
        (field.name.clone(), if own { format!("p.{}", field.name) } else { field.name.clone() })
    });
    let mut functions = vec![function(
        "prepare",
        &["What depends on parameters alone, once per device.".to_owned()],
        &[("p", "Parameters".to_owned())],
        &body,
        literal("Prepared", &fields.collect::<Vec<_>>()),
        "Prepared",
    )];
    rows.push(count(kind.name, "prepare", body.counts));

    for kernel in &kernels {
        let body = kernel_body(chain, kernel, &prepared);
        rows.push(count(kind.name, &kernel.name, body.counts));
        let read = kernel.inputs.iter().filter(|(letter, _)| body.mentions(letter));
        let inputs: Vec<_> = read.map(|(letter, record)| (*letter, record.name.clone())).collect();
        let letters = inputs.iter().map(|(letter, _)| *letter).collect();
        let fields = kernel.output.fields.iter().map(|field| field.name.clone()).collect();
        signatures.insert(kernel.name.clone(), Signature { letters, fields });
        let result = literal(&kernel.output.name, &record_fields(&kernel.output));
        functions.push(function(
            &kernel.name,
            &kernel.doc,
            &inputs,
            &body,
            result,
            &kernel.output.name,
        ));
    }

    let mut records = vec![raw, prepared.record];
    records.extend(pose(kind).into_iter().map(|(_, record)| record));
    // A kind whose joints all keep their rates has neither motors nor modes.
    let given = [rates(kind), motors(kind), modes(kind), wrenches(kind)].into_iter();
    records.extend(given.filter(|record| !record.fields.is_empty()));
    let outputs = kernels.iter().flat_map(|kernel| kernel.output.with_nested());
    for output in outputs.filter(|record| !record.shared) {
        if !records.contains(&output) {
            records.push(output);
        }
    }
    debug_assert!(records.contains(&joint_accelerations(kind)));
    let texts: Vec<_> = records.iter().map(record_text).collect();
    let mut imports: Vec<_> = shared_records().into_iter().map(|record| record.name).collect();
    imports.sort_unstable();
    let mut context = Context::new();
    context.insert("command", home.command());
    context.insert("source", kind.source);
    context.insert("hash", &fnv1a64(&format!("{kind:?}")));
    context.insert("title", &capital(kind.title));
    context.insert("symmetric", &symmetric(kind));
    context.insert("imports", &home.imports(&imports));
    context.insert("records", &texts);
    context.insert("functions", &functions);
    rust_file(home.path(&format!("{}.rs", kind.name)), tera.render("kind.rs", &context)?)
}

/// What is said of a body whose axes do not turn with it.
fn symmetric(kind: &Kind) -> Vec<String> {
    let turning: Vec<_> = kind.turning().map(|link| link.joint.tag).collect();
    let told = kind.links.iter().filter(|link| {
        matches!(link.joint.motion, Motion::Turn(_)) && !turning.contains(&link.joint.tag)
    });
    let text = told.map(|link| {
        format!(
            "The {} is the same from every angle: `{}` enters no equation, and what stands along \
             its axes stands along those that carry it.",
            link.body.title, link.joint.coordinate
        )
    });
    text.flat_map(|text| wrapped(&text, COMMENT)).collect()
}

/// The body of `prepare`.
pub(super) fn prepare_body<'g>(chain: &Chain<'g>, prepared: &Prepared<'g>) -> FunctionBody {
    let (graph, raw) = (chain.graph, parameters(chain.kind));
    let argument: HashSet<&str> = raw.fields.iter().map(|field| field.name.as_str()).collect();
    let given = |id: NodeId| match graph.node(id) {
        Node::Symbol(symbol) => {
            let name = graph.symbol_info(symbol).name;
            argument.contains(name.as_str()).then(|| Rendered::field("p", &name))
        }
        _ => None,
    };
    let witness = Rendered::field("p", &raw.fields[0].name);
    Writer::new(graph, &given, witness).write(&prepared.sections, &prepared.computed(&raw))
}

pub(super) fn kernel_body<'g>(
    chain: &Chain<'g>,
    kernel: &Kernel<'g>,
    prepared: &Prepared<'g>,
) -> FunctionBody {
    let graph = chain.graph;
    let mut argument: HashMap<String, &str> = HashMap::new();
    for (letter, record) in &kernel.inputs {
        for name in record.fields.iter().map(|field| field.name.clone()) {
            argument.insert(name, letter);
        }
    }
    let given = |id: NodeId| {
        if let Some(name) = prepared.fields.get(&id) {
            return Some(Rendered::field("p", name));
        }
        let Node::Symbol(symbol) = graph.node(id) else { return None };
        let name = graph.symbol_info(symbol).name;
        argument.get(&name).map(|letter| Rendered::field(letter, &name))
    };
    // The fields of `Prepared` are not among the kernel's own: without a state, one of them.
    let of_record = |letter: &str, record: &Record| {
        let number = record.fields.iter().find(|field| !matches!(field.source, Source::Nested(_)));
        number.map(|field| Rendered::field(letter, &field.name))
    };
    let stated = kernel.inputs.iter().find_map(|(letter, record)| of_record(letter, record));
    let witness = stated.or_else(|| of_record("p", &prepared.record));
    let witness = witness.expect("a kernel reads something");
    let writer = Writer::new(graph, &given, witness);
    let writer = if FUSED.contains(&kernel.name.as_str()) { writer.fusing() } else { writer };
    writer.write(&kernel.sections, &kernel.output.sources())
}

/// Documents a constant by the formula that computes it, and a named one by its section.
fn describe(record: &mut Record, body: &FunctionBody) {
    let mut docs = HashMap::new();
    for (title, statements) in &body.sections {
        for line in pretty(statements) {
            if let Some((name, formula)) = line.trim_start_matches("let ").split_once(" = ") {
                let formula = format!("`{}`.", formula.trim_end_matches(';'));
                let numbered = name.starts_with("k_");
                let doc = if numbered { formula } else { format!("{formula} {title}") };
                docs.insert(name.to_owned(), doc);
            }
        }
    }
    for field in &mut record.fields {
        if let Some(doc) = docs.remove(&field.name) {
            field.doc = doc;
        }
    }
}

pub(super) fn record_text(record: &Record) -> RecordText {
    let field = |field: &crate::kernel::Field| FieldText {
        name: field.name.clone(),
        doc: wrapped(&field.doc, COMMENT - 4),
        ty: match &field.source {
            Source::Nested(record) => format!("{}<T>", record.name),
            Source::Own | Source::Named(_) => "T".to_owned(),
        },
    };
    RecordText {
        name: record.name.clone(),
        doc: wrapped(&record.doc, COMMENT),
        fields: record.fields.iter().map(field).collect(),
        by_number: if LANED.contains(&record.name.as_str()) {
            let names: Vec<_> = record.fields.iter().map(|field| field.name.as_str()).collect();
            by_number(&record.name, "T: Copy", &names)
        } else {
            Vec::new()
        },
    }
}

fn function(
    name: &str,
    doc: &[String],
    inputs: &[(&str, String)],
    body: &FunctionBody,
    result: Vec<String>,
    output: &str,
) -> FunctionText {
    let Counts { mul, add, neg, div } = body.counts;
    let mut lines: Vec<_> = doc.iter().map(|line| spaced(line)).collect();
    lines.push(String::new());
    lines.push(format!(" Operations: {mul} mul, {add} add, {neg} neg, {div} div, 0 trig."));
    let arguments: Vec<_> = inputs.iter().map(|(p, record)| format!("{p}: &{record}<T>")).collect();
    let line = format!("pub fn {name}<T: Real>({}) -> {output}<T>", arguments.join(", "));
    let signature = if line.len() + " {".len() <= LINE {
        line
    } else {
        let arguments = arguments.join(",\n    ");
        format!("pub fn {name}<T: Real>(\n    {arguments},\n) -> {output}<T>")
    };
    let section = |(title, statements): &(String, Vec<TokenStream>)| SectionText {
        title: wrapped(title, COMMENT),
        lines: pretty(statements),
    };
    FunctionText {
        doc: lines,
        inlined: FUSED.contains(&name),
        signature,
        sections: body.sections.iter().map(section).collect(),
        result,
    }
}

/// Field and value of every number of a record.
fn record_fields(record: &Record) -> Vec<(String, String)> {
    let field = |field: &crate::kernel::Field| {
        let value = match &field.source {
            Source::Own => field.name.clone(),
            Source::Named(name) => name.clone(),
            Source::Nested(record) => {
                let inside = literal(&record.name, &record_fields(record));
                inside.join("\n")
            }
        };
        (field.name.clone(), value)
    };
    record.fields.iter().map(field).collect()
}
