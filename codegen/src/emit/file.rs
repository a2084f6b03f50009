//! The files: records and functions laid out by templates.

use rustc_hash::FxHashMap;

use proc_macro2::TokenStream;
use serde::Serialize;
use tera::{Context, Tera};

use super::body::Counts;
use super::cost::{CountText, chain_passes, count, factoring};
use super::device::{Signature, Signatures, device_file};
use super::error::EmitError;
use super::inputs::Stated;
use super::map_and_zip::map_and_zip;
use super::parts::{INLINED, Part, Parts, parts};
use super::prepare::numbered;
use super::target_crate::TargetCrate;
use super::text::{
    COMMENT, LINE, capital, fnv1a64, literal, pretty, pretty_items, spaced, within_lines, wrapped,
};
use crate::derivation::chain::Chain;
use crate::kernel::{Record, Source, shared_records};
use crate::kinds::{Kind, Motion};

/// The records that are gathered into lanes or spread from them.
const LANED: [&str; 4] = ["Prepared", "JointAccelerations", "HubShare", "Gains"];

/// The functions that contain the mount: their vectors are expressed in B.
const OF_HUB: [&str; 3] = ["constant_share", "eliminate", "back_substitute"];

/// The feature of the dynamics crate that its derivatives are part of, and the record and function that it has.
pub(super) const FEATURE: &str = "derivatives";
const OF_FEATURE: [&str; 2] = ["LoadDerivatives", "load_derivatives"];

/// The feature that a record or function of this name is part of in a crate; only the dynamics crate has one.
fn feature(name: &str, target: TargetCrate<'_>) -> Option<&'static str> {
    (target == TargetCrate::Dynamics && OF_FEATURE.contains(&name)).then_some(FEATURE)
}

/// One emitted file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EmittedFile {
    /// Path from the repository's root.
    pub path: String,
    /// Its text.
    pub text: String,
}

#[derive(Serialize)]
struct FieldText {
    name: String,
    doc: Vec<String>,
    ty: String,
}

#[derive(Serialize)]
pub(super) struct RecordText {
    /// The feature that it is part of.
    feature: Option<&'static str>,
    name: String,
    doc: Vec<String>,
    fields: Vec<FieldText>,
    /// The functions that change each number, for records that lanes take apart.
    pub(super) by_number: Vec<String>,
}

#[derive(Serialize)]
struct SectionText {
    title: Vec<String>,
    lines: Vec<String>,
}

#[derive(Serialize)]
struct FunctionText {
    feature: Option<&'static str>,
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
    #[must_use]
    pub fn operations(&self) -> Vec<(String, usize)> {
        self.counts.iter().map(|count| (count.function.clone(), count.total)).collect()
    }
}

/// The files of one kind, for the crate that they are part of.
///
/// # Errors
/// When a template fails or a file would not parse.
pub fn of_kind(chain: &Chain<'_>, target: TargetCrate<'_>) -> Result<Emitted, EmitError> {
    let mut counts = Vec::new();
    let (tera, mut signatures) = (templates()?, Signatures::new());
    let kernels = kind_file(&tera, chain, target, &mut counts, &mut signatures)?;
    let device = device_file(&tera, chain.kind, target, &signatures)?;
    let files = vec![kernels, device];
    let passes = chain_passes(chain.kind);
    let factoring = factoring(chain.kind, &counts);
    Ok(Emitted { files, module: chain.kind.name, counts, passes, factoring })
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

pub(super) fn rust_file(path: String, mut text: String) -> Result<EmittedFile, EmitError> {
    text = within_lines(&text);
    if let Some(line) = text.lines().find(|line| line.chars().count() > LINE) {
        return Err(EmitError::Width(path, line.trim().to_owned()));
    }
    syn::parse_file(&text).map_err(|error| EmitError::Syntax(path.clone(), error))?;
    Ok(EmittedFile { path, text })
}

pub(super) fn kind_file(
    tera: &Tera,
    chain: &Chain<'_>,
    target: TargetCrate<'_>,
    rows: &mut Vec<CountText>,
    signatures: &mut Signatures,
) -> Result<EmittedFile, EmitError> {
    let kind = chain.kind;
    let Parts { mut records, functions: parts, stated, inputs } = parts(chain)?;
    let mut functions = Vec::new();
    for part in &parts {
        rows.push(count(kind.name, &part.name, part.body.counts));
        let letters = part.inputs.iter().map(|(letter, _)| *letter).collect();
        let fields = part.output.fields.iter().map(|field| field.name.clone()).collect();
        signatures.insert(part.name.clone(), Signature { letters, fields });
        functions.push(function(part, target));
        if let Some(own) =
            records.iter_mut().find(|own| part.name == "prepare" && **own == part.output)
        {
            let lines = part.body.sections.iter().flat_map(|(_, statements)| pretty(statements));
            describe(own, lines, &stated);
        }
    }
    let texts: Vec<_> = records.iter().map(|record| record_text(record, target)).collect();
    let read = |name: &String| {
        let alone = matches!(target, TargetCrate::Standalone(_));
        let taken = |part: &Part| part.inputs.iter().any(|(_, record)| record.name == *name);
        let found = |part: &Part| part.output.with_nested().iter().any(|own| own.name == *name);
        !alone || parts.iter().any(|part| taken(part) || found(part))
    };
    let shared = shared_records().into_iter().map(|record| record.name);
    let mut imports: Vec<_> = shared.filter(read).collect();
    imports.sort_unstable();
    let mut context = Context::new();
    context.insert("command", target.command());
    context.insert("has_device", &!matches!(target, TargetCrate::Standalone(_)));
    context.insert("source", kind.source);
    context.insert("hash", &fnv1a64(&(inputs + include_str!("templates/kind.rs.tera"))));
    context.insert("title", &capital(kind.title));
    context.insert("symmetric", &symmetric(kind));
    context.insert("imports", &pretty_items(target.imports(&imports)?));
    context.insert("records", &texts);
    context.insert("functions", &functions);
    rust_file(target.path(&format!("{}.rs", kind.name)), tera.render("kind.rs", &context)?)
}

/// What is said of a body whose axes do not turn with it.
pub(super) fn symmetric(kind: &Kind) -> Vec<String> {
    let turning: Vec<_> = kind.turning().map(|link| link.joint.tag).collect();
    let told = kind.links.iter().filter(|link| {
        matches!(link.joint.motion, Motion::Turn(_)) && !turning.contains(&link.joint.tag)
    });
    let text = told.map(|link| {
        format!(
            "The {} is symmetric about its joint: `{}` enters no equation, and quantities of the \
             body are expressed in the axes of its parent body.",
            link.body.title, link.joint.coordinate
        )
    });
    text.flat_map(|text| wrapped(&text, COMMENT)).collect()
}

/// Documents a constant by the formula that computes it, its unit and, where it has a name of its
/// own, what the section computes that states it. The formulas are those of the emitted `lines`.
pub(super) fn describe(
    record: &mut Record,
    lines: impl Iterator<Item = String>,
    stated: &FxHashMap<String, Stated>,
) {
    let mut formulas = FxHashMap::default();
    for line in lines {
        if let Some((name, formula)) = line.split_once(" = ") {
            let name = name.rsplit(' ').next().unwrap_or(name);
            formulas.insert(name.to_owned(), formula.trim_end_matches(';').to_owned());
        }
    }
    for field in &mut record.fields {
        let Some(formula) = formulas.remove(&field.name) else { continue };
        let stated = stated.get(&field.name);
        let unit = stated.and_then(|stated| stated.unit);
        let unit = unit.map_or_else(String::new, |unit| format!(", {unit}"));
        let stated = stated.filter(|_| !numbered(&field.name));
        let stated = stated.map_or_else(String::new, |stated| format!(" {}.", stated.label));
        field.doc = format!("`{formula}`{unit}.{stated}");
    }
}

pub(super) fn record_text(record: &Record, target: TargetCrate<'_>) -> RecordText {
    let field = |field: &crate::kernel::Field| FieldText {
        name: field.name.clone(),
        doc: wrapped(&field.doc, COMMENT - 4),
        ty: match &field.source {
            Source::Nested(record) => format!("{}<T>", record.name),
            Source::Own | Source::Named(_) => "T".to_owned(),
        },
    };
    RecordText {
        feature: feature(&record.name, target),
        name: record.name.clone(),
        doc: wrapped(&record.doc, COMMENT),
        fields: record.fields.iter().map(field).collect(),
        by_number: match target.dynamics_name() {
            Some(dynamics) if LANED.contains(&record.name.as_str()) => {
                let names: Vec<_> = record.fields.iter().map(|field| field.name.as_str()).collect();
                map_and_zip(dynamics, &record.name, ["T", "Copy"], &names)
            }
            _ => Vec::new(),
        },
    }
}

fn function(part: &Part, target: TargetCrate<'_>) -> FunctionText {
    let Part { name, body, .. } = part;
    let output = &part.output.name;
    let Counts { mul, add, neg, div } = body.counts;
    let mut lines: Vec<_> = part.doc.iter().map(|line| spaced(line)).collect();
    lines.push(String::new());
    lines.extend(contract(part).iter().map(|line| spaced(line)));
    lines.push(String::new());
    lines.push(format!(" Operations: {mul} mul, {add} add, {neg} neg, {div} div, 0 trig."));
    let arguments = part.inputs.iter().map(|(p, record)| format!("{p}: &{}<T>", record.name));
    let arguments: Vec<_> = arguments.collect();
    let line = format!("pub fn {name}<T: Real>({}) -> {output}<T>", arguments.join(", "));
    let signature = if line.len() + " {".len() <= LINE {
        line
    } else {
        let arguments = arguments.join(",\n    ");
        format!("pub fn {name}<T: Real>(\n    {arguments},\n) -> {output}<T>")
    };
    let section = |(title, statements): &(String, Vec<TokenStream>)| SectionText {
        title: if title.is_empty() { Vec::new() } else { wrapped(title, COMMENT) },
        lines: pretty(statements),
    };
    FunctionText {
        feature: feature(name, target),
        doc: lines,
        inlined: INLINED.contains(&name.as_str()),
        signature,
        sections: body.sections.iter().map(section).collect(),
        result: literal(output, &record_fields(part, &part.output), "    ".len()),
    }
}

/// What a function takes and what it promises, a line for each.
fn contract(part: &Part) -> Vec<String> {
    let argument = |(letter, record): &(&str, Record)| {
        let what = match *letter {
            "p" if part.name == "prepare" => "parameters",
            "p" => "constants",
            "q" => "sines and cosines",
            "s" => "lengths",
            "v" => "joint rates",
            "w" => "the hub's rate",
            "b" => "the hub's velocities",
            "a" => "the hub's accelerations",
            "u" => "motors",
            "m" => "modes",
            "j" => "joint accelerations",
            "x" => "wrenches",
            "g" => "the gradient",
            "e" => "gains",
            _ => record.name.as_str(),
        };
        // Other arguments have no frame, or state their own.
        let frame = match *letter {
            "w" | "b" | "a" | "g" if OF_HUB.contains(&part.name.as_str()) => " (expressed in B)",
            "w" | "b" | "a" | "g" => " (expressed in the device's axes)",
            _ => "",
        };
        format!("{what} `{letter}`{frame}")
    };
    let arguments: Vec<_> = part.inputs.iter().map(argument).collect();
    let takes = format!("Takes {}.", arguments.join(", "));
    let returns = format!(
        "Returns `{}`, proved equal to the equations cited. No branch, no panic.",
        part.output.name
    );
    [takes, returns].iter().flat_map(|line| wrapped(line, COMMENT)).collect()
}

/// Field and value of every number of a record.
fn record_fields(part: &Part, record: &Record) -> Vec<(String, String)> {
    let field = |field: &crate::kernel::Field| {
        let value = match &field.source {
            Source::Own => part.body.result(&field.name).to_owned(),
            Source::Named(name) => part.body.result(name).to_owned(),
            Source::Nested(record) => {
                let taken = "        : ,".len() + field.name.len();
                literal(&record.name, &record_fields(part, record), taken).join("\n")
            }
        };
        (field.name.clone(), value)
    };
    record.fields.iter().map(field).collect()
}
