//! What an emitted file is made from: the hash in its header, and label and unit of each constant.
//!
//! Invariant: the hash changes with the kind's data, with any statement of the derivation (section,
//! name, expression), and with the template.

use rustc_hash::FxHashMap;

use super::functions::Functions;
use super::text::fnv1a64;
use crate::derivation::script::Section;
use crate::graph::{Expr, Graph, Node, NodeId};
use crate::kinds::Kind;
use crate::unit::{Balance, Unit, unit_of};

/// Section and unit of a named constant.
pub(super) struct Stated {
    /// Quantity, equations and axes of the section that states it.
    pub(super) label: String,
    /// Its unit; none where a symbol in it has no known unit.
    pub(super) unit: Option<Unit>,
}

/// What these sections state of each name.
pub(super) fn stated(sections: &[Section<'_>]) -> FxHashMap<String, Stated> {
    let (mut known, mut stated) = (FxHashMap::default(), FxHashMap::default());
    for section in sections {
        for statement in &section.statements {
            let unit = match unit_of(statement.value, &known) {
                Ok(Balance::Is(unit)) => Some(unit),
                Ok(Balance::Any | Balance::Not) | Err(_) => None,
            };
            if let Some(unit) = unit {
                known.insert(statement.name.clone(), unit);
            }
            let label = section.heading.label();
            stated.entry(statement.name.clone()).or_insert(Stated { label, unit });
        }
    }
    stated
}

/// The hash of a kind's data and of everything derived from them.
pub(super) fn derived(graph: &Graph, kind: &Kind, functions: &Functions<'_>) -> String {
    let (mut texts, mut digests) = (vec![format!("{kind:?}")], FxHashMap::default());
    let sections = functions.kernels.iter().flat_map(|kernel| &kernel.sections);
    for section in functions.prepared.sections.iter().chain(sections) {
        texts.push(section.heading.to_string());
        for statement in &section.statements {
            let value = digest(graph, statement.value, &mut digests);
            texts.push(format!("{} = {value};", statement.name));
        }
    }
    for kernel in &functions.kernels {
        let given: Vec<_> = kernel.inputs.iter().map(|(letter, _)| letter).collect();
        texts.push(format!("{} {:?} {given:?} {:?}", kernel.name, kernel.doc, kernel.output));
    }
    fnv1a64(&texts.concat())
}

/// The hash of an expression, by those of its operands.
fn digest(graph: &Graph, e: Expr<'_>, known: &mut FxHashMap<NodeId, String>) -> String {
    for id in graph.reachable([e.id()]) {
        if known.contains_key(&id) {
            continue;
        }
        let text = match graph.node(id) {
            Node::Constant(value) => format!("{value}"),
            Node::Symbol(symbol) => graph.symbol_info(symbol).name,
            Node::Neg(a) => format!("-{}", known[&a]),
            Node::Recip(a) => format!("1/{}", known[&a]),
            Node::Sum(a, b) => format!("{}+{}", known[&a], known[&b]),
            Node::Product(a, b) => format!("{}*{}", known[&a], known[&b]),
        };
        known.insert(id, fnv1a64(&text));
    }
    known[&e.id()].clone()
}
