//! What is emitted of a kind before it has a syntax: its records, and its functions with their
//! bodies.

use rustc_hash::{FxHashMap, FxHashSet};

use super::body::{FunctionBody, Writer};
use super::error::EmitError;
use super::functions::{Functions, functions};
use super::inputs::{self, Stated};
use super::prepare::Prepared;
use super::render::Rendered;
use crate::derivation::chain::Chain;
use crate::graph::{Node, NodeId};
use crate::kernel::{Kernel, Record, Source, parameters_of};
use crate::kernel::{joint_accelerations, modes, motors, pose, rates, wrenches};

/// What lanes and dispatched evaluations call. Inlined, since they reach the instructions of their caller only so.
pub(super) const INLINED: [&str; 5] =
    ["eliminate", "back_substitute", "load_derivatives", "external", "gravity"];

/// Records and functions of a kind, in the order of the emitted files.
pub(super) struct Parts {
    /// Those of only this kind, each before those that contain it.
    pub(super) records: Vec<Record>,
    /// `prepare` first.
    pub(super) functions: Vec<Part>,
    /// Section and unit of each constant.
    pub(super) stated: FxHashMap<String, Stated>,
    /// The hash of the kind's data and of everything derived from them.
    pub(super) inputs: String,
}

/// One function.
pub(super) struct Part {
    /// Its name.
    pub(super) name: String,
    /// Its documentation, line by line.
    pub(super) doc: Vec<String>,
    /// The arguments that its body reads: their letters and records.
    pub(super) inputs: Vec<(&'static str, Record)>,
    /// Its statements, in the emitted Rust.
    pub(super) body: FunctionBody,
    /// What it returns.
    pub(super) output: Record,
}

/// The parts of the chain's kind.
///
/// # Errors
/// When a name would stand for two values.
pub(super) fn parts(chain: &Chain<'_>) -> Result<Parts, EmitError> {
    let kind = chain.kind;
    let functions = functions(chain);
    let inputs = inputs::derived(chain.graph, kind, &functions);
    let Functions { kernels, prepared } = functions;
    if let Some(name) = &prepared.ambiguous {
        return Err(EmitError::Ambiguous(kind.name, name.clone()));
    }
    let stated = inputs::stated(&prepared.sections);
    let raw = parameters_of(chain);
    let prepare = Part {
        name: "prepare".to_owned(),
        doc: vec!["What depends only on parameters, once for each device.".to_owned()],
        inputs: vec![("p", raw.clone())],
        body: prepare_body(chain, &prepared),
        output: prepared.record.clone(),
    };
    let part = |kernel: &Kernel<'_>| {
        let body = kernel_body(chain, kernel, &prepared);
        let read = kernel.inputs.iter().filter(|(letter, _)| body.mentions(letter));
        let whole = |record: &Record| {
            let constants = record.name == prepared.record.name;
            if constants { prepared.record.clone() } else { record.clone() }
        };
        Part {
            name: kernel.name.clone(),
            doc: kernel.doc.clone(),
            inputs: read.map(|(letter, record)| (*letter, whole(record))).collect(),
            body,
            output: kernel.output.clone(),
        }
    };
    let functions = std::iter::once(prepare).chain(kernels.iter().map(part)).collect();

    let mut records = vec![raw, prepared.record.clone()];
    // What is locked on the hub has no state.
    if !chain.is_rigid() {
        records.extend(pose(kind).into_iter().map(|(_, record)| record));
        // A kind whose joints all keep their rates has neither motors nor modes.
        let given = [rates(kind), motors(kind), modes(kind), wrenches(kind)].into_iter();
        records.extend(given.filter(|record| !record.fields.is_empty()));
    }
    let outputs = kernels.iter().flat_map(|kernel| kernel.output.with_nested());
    for output in outputs.filter(|record| !record.shared) {
        if !records.contains(&output) {
            records.push(output);
        }
    }
    assert!(chain.is_rigid() || records.contains(&joint_accelerations(kind)));
    Ok(Parts { records, functions, stated, inputs })
}

/// The body of `prepare`.
pub(super) fn prepare_body<'g>(chain: &Chain<'g>, prepared: &Prepared<'g>) -> FunctionBody {
    let (graph, raw) = (chain.graph, parameters_of(chain));
    let argument: FxHashSet<&str> = raw.fields.iter().map(|field| field.name.as_str()).collect();
    let given = |id: NodeId| match graph.node(id) {
        Node::Symbol(symbol) => {
            let name = graph.symbol_info(symbol).name;
            argument.contains(name.as_str()).then(|| Rendered::field("p", &name))
        }
        _ => None,
    };
    let witness = Rendered::field("p", &raw.fields[0].name);
    let computed = prepared.computed(&raw);
    let mut body = Writer::new(graph, &given, witness).write(&prepared.sections, &computed);
    let names = prepared.record.fields.iter().map(|field| &field.name);
    for name in names.filter(|name| !computed.contains(name)) {
        body.copies.insert(name.clone(), format!("p.{name}"));
    }
    body
}

pub(super) fn kernel_body<'g>(
    chain: &Chain<'g>,
    kernel: &Kernel<'g>,
    prepared: &Prepared<'g>,
) -> FunctionBody {
    let graph = chain.graph;
    let mut argument: FxHashMap<String, &str> = FxHashMap::default();
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
    Writer::new(graph, &given, witness).write(&kernel.sections, &kernel.output.sources())
}
