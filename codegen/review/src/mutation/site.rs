//! The places of an emitted function at which one term can be wrong, and what can be done there.

use std::fmt;

use rustc_hash::FxHashMap;

use super::listing::Listing;
use precess_codegen::graph::{Expr, Graph, Node, NodeId, Stage, SymbolId};

/// The longest text of an operand, in characters.
const SHORT: usize = 56;

/// What is done at one place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Change {
    /// The term is left out.
    Drop,
    /// Its sign is changed.
    Flip,
    /// Sine and cosine are exchanged.
    Swap,
}

impl fmt::Display for Change {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Drop => "drop",
            Self::Flip => "flip",
            Self::Swap => "swap",
        })
    }
}

/// One place of one emitted function, and what is done there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mutant {
    /// The function.
    pub kernel: String,
    /// The heading that the place is under.
    pub section: String,
    /// The emitted name that the place belongs to.
    pub name: String,
    /// The paper's number of that name, or those that its heading cites: `(14)`, `(17), (78)`.
    pub tag: Option<String>,
    /// What is done.
    pub change: Change,
    /// The operand it is done to.
    pub operand: String,
    /// The expression that the operand is part of.
    pub whole: String,
}

impl fmt::Display for Mutant {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { kernel, name, change, operand, whole, .. } = self;
        write!(f, "{kernel}: {name}: {change} `{operand}` of `{whole}`")
    }
}

/// Where in the graph.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Location {
    /// An operand of a node.
    Operand { node: NodeId, second: bool },
    /// A returned field that is a bare sine or cosine.
    Returned(String, NodeId),
}

/// A mutant and where it is in the graph.
pub(super) struct Site {
    pub(super) mutant: Mutant,
    pub(super) place: Location,
}

/// Every mutant of a function, in the order of its text, where it is computed: what comes from `prepare` belongs to
/// `prepare`.
pub(super) fn sites<'g>(graph: &'g Graph, listing: &Listing<'g>) -> Vec<Site> {
    let mut names = FxHashMap::default();
    let mut found = Vec::new();
    for line in &listing.lines {
        for id in line.nodes.iter().filter(|id| listing.own.contains(*id)) {
            let operands: Vec<_> = graph.node(*id).operands().collect();
            let whole = text(graph, *id, &names);
            for (index, operand) in operands.iter().enumerate() {
                // Twice the same is one place: either operand gives the same mutant.
                if index == 1 && operands[0] == operands[1] {
                    continue;
                }
                for change in changes(graph, *id, *operand) {
                    let mutant = Mutant {
                        kernel: listing.name.clone(),
                        section: line.section.clone(),
                        name: line.name.clone(),
                        tag: line.tag.clone(),
                        change,
                        operand: text(graph, *operand, &names),
                        whole: whole.clone(),
                    };
                    let place = Location::Operand { node: *id, second: index == 1 };
                    found.push(Site { mutant, place });
                }
            }
        }
        let fields = listing.fields.iter().filter(|(_, source)| *source == line.name);
        for (field, _) in fields.filter(|_| line.value.stage() != Stage::Parameter) {
            if partner(graph, line.value).is_some() {
                let shown = text(graph, line.value.id(), &names);
                let mutant = Mutant {
                    kernel: listing.name.clone(),
                    section: line.section.clone(),
                    name: line.name.clone(),
                    tag: line.tag.clone(),
                    change: Change::Swap,
                    operand: shown.clone(),
                    whole: shown,
                };
                let place = Location::Returned(field.clone(), line.value.id());
                found.push(Site { mutant, place });
            }
        }
        names.entry(line.value.id()).or_insert_with(|| line.name.clone());
    }
    found
}

/// What can be done to an operand.
fn changes(graph: &Graph, node: NodeId, operand: NodeId) -> Vec<Change> {
    let term = matches!(graph.node(node), Node::Sum(..));
    let turning = partner(graph, graph.expr(operand)).is_some();
    let changes = [(Change::Drop, term), (Change::Flip, term), (Change::Swap, turning)];
    changes.into_iter().filter_map(|(change, possible)| possible.then_some(change)).collect()
}

/// The cosine of a sine, the sine of a cosine.
pub(super) fn partner<'g>(graph: &'g Graph, e: Expr<'g>) -> Option<Expr<'g>> {
    let info = graph.symbol_info(symbol(e)?);
    let name = match (info.name.strip_prefix("sin_"), info.name.strip_prefix("cos_")) {
        (Some(angle), _) => format!("cos_{angle}"),
        (_, Some(angle)) => format!("sin_{angle}"),
        _ => return None,
    };
    graph.find(&name)
}

/// The symbol of an expression that is one.
pub(super) fn symbol(e: Expr<'_>) -> Option<SymbolId> {
    match e.node() {
        Node::Symbol(id) => Some(id),
        _ => None,
    }
}

/// An expression as one would write it, by the names it already has, and short.
fn text(graph: &Graph, id: NodeId, names: &FxHashMap<NodeId, String>) -> String {
    let whole = written(graph, id, names, 4);
    if whole.chars().count() <= SHORT {
        return whole;
    }
    let start: String = whole.chars().take(SHORT - 2).collect();
    format!("{start} …")
}

fn written(graph: &Graph, id: NodeId, names: &FxHashMap<NodeId, String>, depth: usize) -> String {
    if let Some(name) = names.get(&id) {
        return name.clone();
    }
    if depth == 0 && !matches!(graph.node(id), Node::Symbol(_) | Node::Constant(_)) {
        return "…".to_owned();
    }
    let inner = |id| written(graph, id, names, depth - 1);
    let factor = |id| {
        let sum = matches!(graph.node(id), Node::Sum(..)) && !names.contains_key(&id);
        if sum && depth > 1 { format!("({})", inner(id)) } else { inner(id) }
    };
    match graph.node(id) {
        Node::Constant(k) => k.to_string(),
        Node::Symbol(symbol) => graph.symbol_info(symbol).name,
        Node::Sum(a, b) => match (graph.node(a), graph.node(b)) {
            (_, Node::Neg(b)) => format!("{} - {}", inner(a), factor(b)),
            (Node::Neg(a), _) => format!("{} - {}", inner(b), factor(a)),
            _ => format!("{} + {}", inner(a), inner(b)),
        },
        Node::Product(a, b) => format!("{} * {}", factor(a), factor(b)),
        Node::Neg(a) => format!("-{}", factor(a)),
        Node::Recip(a) => format!("1/{}", factor(a)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mutation::device::Device;
    use precess_codegen::derivation::chain::Chain;
    use precess_codegen::derivation::heading::Heading;
    use precess_codegen::derivation::script::Script;
    use precess_codegen::kernel::{Field, Record, Source};
    use precess_codegen::kinds::{KINDS, Kind};
    use rustc_hash::FxHashSet;

    /// What the emitted text is counted to add; `regen --check` holds it to what is emitted.
    const TABLE: &str = include_str!("../../../../docs/operations.md");

    /// What `prepare` or a kernel of a kind adds.
    fn counted(kind: &str, function: &str) -> Option<usize> {
        let row =
            TABLE.lines().find(|line| line.starts_with(&format!("| {kind} | `{function}` |")))?;
        row.split('|').nth(4)?.trim().parse().ok()
    }

    #[test]
    fn every_addition_of_the_emitted_text_is_a_place() {
        for kind in KINDS {
            every_addition_of(kind);
        }
    }

    fn every_addition_of(kind: &'static Kind) {
        let graph = Graph::new();
        let chain = Chain::new(&graph, kind);
        let device = Device::new(&chain).unwrap();
        for listing in &device.listings {
            let found = sites(&graph, listing);
            let dropped = found.iter().filter(|site| site.mutant.change == Change::Drop);
            let mut sums: Vec<_> = dropped
                .map(|site| match site.place {
                    Location::Operand { node, .. } => node,
                    Location::Returned(..) => panic!("a returned value is no term"),
                })
                .collect();
            sums.dedup();
            let counted = counted(kind.name, &listing.name);
            assert_eq!(Some(sums.len()), counted, "{}: {}", kind.name, listing.name);
        }
    }

    #[test]
    fn a_bare_cosine_that_is_returned_is_a_place() {
        let g = Graph::new();
        let (s, c) = g.angle("q", g.symbol("q_dot", Stage::Rate));
        let mut script = Script::new(&g);
        script.section("a", Heading::new("Bare").equation("(3)"));
        script.name("x", c);
        script.name("y", s + s);
        let field =
            |name: &str| Field { name: name.to_owned(), doc: String::new(), source: Source::Own };
        let output = Record {
            name: String::new(),
            doc: String::new(),
            fields: vec![field("x"), field("y")],
            shared: false,
        };
        let listing = Listing::new(&g, "f", &script.sections, &output, &[], &FxHashSet::default());
        let found = sites(&g, &listing);
        let shown: Vec<_> = found.iter().map(|site| site.mutant.to_string()).collect();
        let expected = [
            "f: x: swap `cos_q` of `cos_q`",
            "f: y: drop `sin_q` of `sin_q + sin_q`",
            "f: y: flip `sin_q` of `sin_q + sin_q`",
            "f: y: swap `sin_q` of `sin_q + sin_q`",
        ];
        assert_eq!(shown, expected);
        assert_eq!(found[0].mutant.tag.as_deref(), Some("(3)"));
    }
}
