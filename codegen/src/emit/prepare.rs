//! What depends on parameters only leaves every kernel and is computed once, in `prepare`.
//!
//! Invariant: no two fields of `Prepared` are the same expression.

use std::collections::BTreeMap;

use rustc_hash::{FxHashMap, FxHashSet};

use crate::derivation::heading::Heading;
use crate::derivation::script::{Section, Statement};
use crate::graph::{Expr, Graph, Node, NodeId, Stage};
use crate::kernel::{Field, Kernel, Record, Source};
use crate::normal::Ring;

/// The constants of a kind: fields of `Prepared` and the statements that compute them.
pub struct Prepared<'g> {
    /// Field name of each node that a kernel reads.
    pub(super) fields: FxHashMap<NodeId, String>,
    /// In order of first use: raw parameters first.
    pub record: Record,
    /// The statements of `prepare`.
    pub sections: Vec<Section<'g>>,
    /// A name that stands for two values.
    pub(super) ambiguous: Option<String>,
}

impl<'g> Prepared<'g> {
    /// `e` with each field that it reads as it is `computed`.
    pub(super) fn read(
        &self,
        graph: &'g Graph,
        e: Expr<'g>,
        computed: &FxHashMap<String, Expr<'g>>,
    ) -> Expr<'g> {
        let mut made: FxHashMap<NodeId, Expr<'g>> = FxHashMap::default();
        for id in graph.reachable([e.id()]) {
            let field = self.fields.get(&id).and_then(|name| computed.get(name));
            let new = match (graph.node(id), field) {
                (Node::Constant(_) | Node::Symbol(_), _) => graph.expr(id),
                (_, Some(field)) => *field,
                (Node::Sum(a, b), None) => made[&a] + made[&b],
                (Node::Product(a, b), None) => made[&a] * made[&b],
                (Node::Neg(a), None) => -made[&a],
                (Node::Recip(a), None) => made[&a].recip(),
            };
            made.insert(id, new);
        }
        made[&e.id()]
    }

    /// The nodes that the other functions read and do not compute, before and after they are joined.
    #[must_use]
    pub fn given(&self) -> FxHashSet<NodeId> {
        let statements = self.sections.iter().flat_map(|section| &section.statements);
        let is_field = |name: &str| self.record.fields.iter().any(|field| field.name == name);
        let computed = statements.filter(|s| is_field(&s.name)).map(|s| s.value.id());
        self.fields.keys().copied().chain(computed).collect()
    }

    /// Makes one field of all that are the same expression: of a cut, whose name the proof knows,
    /// rather than of a plain name, and of that rather than of a number.
    pub(super) fn merge(&mut self) {
        let statements = self.sections.iter().flat_map(|section| &section.statements);
        let is_field = |name: &str| self.record.fields.iter().any(|field| field.name == name);
        let fields: Vec<_> = statements.filter(|statement| is_field(&statement.name)).collect();
        let rank = |statement: &Statement<'_>| (statement.cut.is_none(), numbered(&statement.name));
        let mut kept: FxHashMap<NodeId, &Statement<'_>> = FxHashMap::default();
        for statement in &fields {
            let best = kept.entry(statement.value.id()).or_insert(statement);
            if rank(statement) < rank(best) {
                *best = statement;
            }
        }
        let name = |statement: &&Statement<'_>| kept[&statement.value.id()].name.clone();
        let names = fields.iter().map(|field| (field.name.clone(), name(field))).collect();
        self.rename(&names);
        let rest = self.record.fields.iter().filter(|field| numbered(&field.name)).enumerate();
        let names = rest.map(|(k, field)| (field.name.clone(), format!("k_{k}"))).collect();
        self.rename(&names);
    }

    /// Gives fields other names. Those of one name become one field, numbered statements of one
    /// name one statement; statements with a name of their own keep it.
    fn rename(&mut self, names: &FxHashMap<String, String>) {
        let rename = |name: &mut String| {
            if let Some(new) = names.get(name) {
                name.clone_from(new);
            }
        };
        self.fields.values_mut().for_each(rename);
        self.record.fields.iter_mut().for_each(|field| rename(&mut field.name));
        let mut seen = FxHashSet::default();
        self.record.fields.retain(|field| seen.insert(field.name.clone()));
        seen.clear();
        for section in &mut self.sections {
            let statements = section.statements.iter_mut();
            statements.filter(|s| numbered(&s.name)).for_each(|s| rename(&mut s.name));
            section.statements.retain(|statement| seen.insert(statement.name.clone()));
        }
    }

    /// The names of the fields that are not among the `raw` parameters.
    pub(super) fn computed(&self, raw: &Record) -> Vec<String> {
        let given = |name: &String| raw.fields.iter().any(|field| field.name == *name);
        let names = self.record.fields.iter().map(|field| field.name.clone());
        names.filter(|name| !given(name)).collect()
    }
}

/// Finds what the kernels can share of parameters only.
pub(crate) fn prepared<'g>(
    graph: &'g Graph,
    kernels: &[Kernel<'g>],
    parameters: &Record,
) -> Prepared<'g> {
    let names = names(kernels);
    let mut raw = BTreeMap::new();
    let mut derived = BTreeMap::new();
    let (hoisted, others): (Vec<_>, Vec<_>) = kernels.iter().partition(|kernel| kernel.hoisted);
    let mut read: Vec<_> =
        hoisted.iter().flat_map(|kernel| read_constants(graph, kernel)).collect();
    let known: FxHashSet<_> = read.iter().copied().collect();
    read.extend(others.iter().flat_map(|kernel| read_beside(graph, kernel, &known)));
    for id in read {
        match graph.node(id) {
            Node::Constant(_) => {}
            Node::Symbol(symbol) => {
                let name = graph.symbol_info(symbol).name;
                let given = parameters.fields.iter().position(|field| field.name == name);
                match given {
                    Some(place) => raw.insert(place, id),
                    None => derived.insert(id, name).map(|_| id),
                };
            }
            _ => {
                derived.insert(id, names.get(&id).cloned().unwrap_or_default());
            }
        }
    }
    let doc = "What a kernel needs of the parameters, computed once by [`prepare`].";
    let mut record = Record {
        name: "Prepared".to_owned(),
        doc: doc.to_owned(),
        fields: Vec::new(),
        shared: false,
    };
    let mut fields = FxHashMap::default();
    for (place, id) in raw {
        record.fields.push(parameters.fields[place].clone());
        fields.insert(id, parameters.fields[place].name.clone());
    }
    let mut number = 0;
    for (id, name) in derived {
        let name = if name.is_empty() {
            number += 1;
            format!("k_{}", number - 1)
        } else {
            name
        };
        // A cut constant and the symbol that stands for it are one field.
        if !record.fields.iter().any(|field| field.name == name) {
            let doc = String::new();
            record.fields.push(Field { name: name.clone(), doc, source: Source::Own });
        }
        fields.insert(id, name);
    }
    let ambiguous = ambiguous(graph, kernels).map(str::to_owned);
    let sections = sections(graph, kernels, &fields);
    Prepared { fields, record, sections, ambiguous }
}

/// Whether a field has a number, no name.
pub(super) fn numbered(name: &str) -> bool {
    name.strip_prefix("k_").is_some_and(|number| number.parse::<usize>().is_ok())
}

/// A name that the kernels give to two values of parameters only. One value may be two
/// expressions: the mass that slides, summed from the tip and from its normal form.
fn ambiguous<'a, 'g>(graph: &'g Graph, kernels: &'a [Kernel<'g>]) -> Option<&'a str> {
    let mut known: FxHashMap<&str, Expr<'g>> = FxHashMap::default();
    let mut ring = Ring::new(graph);
    let mut same = |a: Expr<'g>, b: Expr<'g>| {
        a == b || ring.normal(a).is_ok_and(|a| ring.normal(b).is_ok_and(|b| a == b))
    };
    let live = kernels.iter().flat_map(|kernel| live(graph, kernel));
    live.filter(|s| s.value.stage() == Stage::Parameter)
        .find(|s| !same(*known.entry(&s.name).or_insert(s.value), s.value))
        .map(|s| s.name.as_str())
}

/// Names that the derivation gives to nodes of parameters.
fn names(kernels: &[Kernel<'_>]) -> FxHashMap<NodeId, String> {
    let mut names = FxHashMap::default();
    for statement in statements(kernels) {
        for node in std::iter::once(statement.value).chain(statement.cut) {
            names.entry(node.id()).or_insert_with(|| statement.name.clone());
        }
    }
    names
}

fn statements<'a, 'g>(kernels: &'a [Kernel<'g>]) -> impl Iterator<Item = &'a Statement<'g>> {
    kernels.iter().flat_map(|kernel| &kernel.sections).flat_map(|section| &section.statements)
}

/// The nodes of parameters only that a kernel reads where it computes with the state.
fn read_constants(graph: &Graph, kernel: &Kernel<'_>) -> Vec<NodeId> {
    let (_, mut found) = walked(graph, kernel, |id| graph.expr(id).stage() == Stage::Parameter);
    found.sort_unstable();
    found
}

/// The parameters, and what is known of them, that a kernel reads which computes the rest by itself.
fn read_beside(graph: &Graph, kernel: &Kernel<'_>, known: &FxHashSet<NodeId>) -> Vec<NodeId> {
    let stop = |id| {
        let symbol = matches!(graph.node(id), Node::Symbol(_));
        known.contains(&id) || symbol && graph.expr(id).stage() == Stage::Parameter
    };
    let (_, mut found) = walked(graph, kernel, stop);
    found.sort_unstable();
    found
}

/// The statements that a kernel's outputs need, down to the parameters.
fn live<'a, 'g>(graph: &Graph, kernel: &'a Kernel<'g>) -> Vec<&'a Statement<'g>> {
    walked(graph, kernel, |_| false).0
}

/// From the outputs backwards: the statements needed, and the nodes at which `stop` stops.
fn walked<'a, 'g>(
    graph: &Graph,
    kernel: &'a Kernel<'g>,
    stop: impl Fn(NodeId) -> bool,
) -> (Vec<&'a Statement<'g>>, Vec<NodeId>) {
    let outputs = kernel.output.sources();
    let all: Vec<_> = kernel.sections.iter().flat_map(|section| &section.statements).collect();
    let (mut seen, mut needed, mut found) = (FxHashSet::default(), Vec::new(), Vec::new());
    for statement in all.into_iter().rev() {
        let read = outputs.contains(&statement.name)
            || statement.cut.is_some_and(|symbol| seen.contains(&symbol.id()))
            || seen.contains(&statement.value.id());
        let mut pending = if read { vec![statement.value.id()] } else { Vec::new() };
        if read {
            needed.push(statement);
        }
        while let Some(id) = pending.pop() {
            if seen.insert(id) {
                if stop(id) {
                    found.push(id);
                } else {
                    pending.extend(graph.node(id).operands());
                }
            }
        }
    }
    (needed, found)
}

/// `prepare` repeats the sections of the kernels as far as they are parameters only.
fn sections<'g>(
    graph: &'g Graph,
    kernels: &[Kernel<'g>],
    fields: &FxHashMap<NodeId, String>,
) -> Vec<Section<'g>> {
    let mut seen = FxHashSet::default();
    let mut made: Vec<Section<'g>> = Vec::new();
    for kernel in kernels.iter().filter(|kernel| kernel.hoisted) {
        let live: FxHashSet<_> = live(graph, kernel).into_iter().map(|s| s.name.as_str()).collect();
        for section in &kernel.sections {
            let mut statements = section.statements.clone();
            statements.retain(|s| {
                s.value.stage() == Stage::Parameter
                    && live.contains(s.name.as_str())
                    && seen.insert(s.name.clone())
            });
            if !statements.is_empty() {
                made.push(Section { statements, ..section.clone() });
            }
        }
    }
    let named: FxHashSet<_> =
        made.iter().flat_map(|s| &s.statements).map(|s| s.name.clone()).collect();
    let mut rest: Vec<_> = fields
        .iter()
        .filter(|(id, name)| !named.contains(*name) && !matches!(graph.node(**id), Node::Symbol(_)))
        .map(|(id, name)| (*id, name.clone()))
        .collect();
    rest.sort_unstable();
    let statement = |(id, name): (NodeId, String)| {
        let value: Expr<'g> = graph.expr(id);
        Statement { name, value, cut: None }
    };
    let statements = rest.into_iter().map(statement).collect();
    let heading = Heading::new("Products and sums of parameters that occur more deeply");
    made.push(Section { heading, prefix: "prep".to_owned(), statements });
    made
}
