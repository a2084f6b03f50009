//! What an emitted function computes, statement by statement, and nothing that is not returned.

use rustc_hash::FxHashSet;

use precess_codegen::derivation::heading::Heading;
use precess_codegen::derivation::script::{Section, Statement};
use precess_codegen::graph::{Expr, Graph, Node, NodeId};
use precess_codegen::kernel::{Claim, Record};

/// One named value of one emitted function.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Computed {
    /// The function.
    pub kernel: String,
    /// The emitted name.
    pub name: String,
    /// The paper's number, or those that its heading cites: `(14)`, `(49)-(52)`, `(17), (78)`.
    pub tag: Option<String>,
}

/// One emitted function.
pub(super) struct Listing<'g> {
    /// Its name.
    pub(super) name: String,
    /// Statements in order.
    pub(super) lines: Vec<Line<'g>>,
    /// Returned field and the name of its value.
    pub(super) fields: Vec<(String, String)>,
    /// The nodes that it computes: the others come from `prepare`.
    pub(super) own: FxHashSet<NodeId>,
}

/// One statement, with the nodes that are computed there for the first time.
pub(super) struct Line<'g> {
    /// Heading it is under.
    pub(super) section: String,
    /// Emitted name.
    pub(super) name: String,
    /// The paper's number, or those that the heading cites.
    pub(super) tag: Option<String>,
    /// Its value.
    pub(super) value: Expr<'g>,
    /// The symbol that stands for it afterwards.
    pub(super) cut: Option<Expr<'g>>,
    /// Operands before their users.
    pub(super) nodes: Vec<NodeId>,
}

impl<'g> Listing<'g> {
    /// The function that computes `output` by these sections from what is `given`.
    pub(super) fn new(
        graph: &'g Graph,
        name: &str,
        sections: &[Section<'g>],
        output: &Record,
        claims: &[Claim<'g>],
        given: &FxHashSet<NodeId>,
    ) -> Self {
        let fields = output.leaves();
        let needed = Needed::of(graph, sections, &fields, &FxHashSet::default());
        let own = Needed::of(graph, sections, &fields, given).nodes;
        let (mut lines, mut placed) = (Vec::new(), FxHashSet::default());
        for section in sections {
            for statement in &section.statements {
                if !needed.statement(graph, statement) {
                    continue;
                }
                let reachable = graph.reachable([statement.value.id()]);
                let new = |id: &NodeId| needed.nodes.contains(id) && placed.insert(*id);
                let nodes: Vec<_> = reachable.into_iter().filter(new).collect();
                lines.push(Line {
                    section: section.heading.to_string(),
                    name: statement.name.clone(),
                    tag: tag(&statement.name, &section.heading, claims),
                    value: statement.value,
                    cut: statement.cut,
                    nodes,
                });
            }
        }
        Self { name: name.to_owned(), lines, fields, own }
    }

    /// What is computed or returned here.
    pub(super) fn computed(&self) -> impl Iterator<Item = Computed> {
        let own = |line: &&Line<'g>| {
            let returned = || self.fields.iter().any(|(_, source)| *source == line.name);
            self.own.contains(&line.value.id()) || returned()
        };
        self.lines.iter().filter(own).map(|line| Computed {
            kernel: self.name.clone(),
            name: line.name.clone(),
            tag: line.tag.clone(),
        })
    }
}

/// Nodes that the returned values are made of, through the cuts, and the names returned.
struct Needed {
    returned: FxHashSet<String>,
    nodes: FxHashSet<NodeId>,
}

impl Needed {
    /// From what is `given`.
    fn of(
        graph: &Graph,
        sections: &[Section<'_>],
        fields: &[(String, String)],
        given: &FxHashSet<NodeId>,
    ) -> Self {
        let returned: FxHashSet<String> = fields.iter().map(|(_, source)| source.clone()).collect();
        let mut nodes = FxHashSet::default();
        // Backwards: a statement comes before whatever uses the symbol it was cut at.
        for statement in sections.iter().flat_map(|section| &section.statements).rev() {
            let used = statement.cut.is_some_and(|symbol| nodes.contains(&symbol.id()));
            if !(used || returned.contains(&statement.name)) {
                continue;
            }
            let mut pending = vec![statement.value.id()];
            while let Some(id) = pending.pop() {
                if !given.contains(&id) && nodes.insert(id) {
                    pending.extend(graph.node(id).operands());
                }
            }
        }
        Self { returned, nodes }
    }

    /// Whether a statement is written: something is made of it, or it names what is computed.
    fn statement(&self, graph: &Graph, statement: &Statement<'_>) -> bool {
        let opposite = |id| match graph.node(id) {
            Node::Neg(inner) => self.nodes.contains(&inner),
            _ => false,
        };
        let id = statement.value.id();
        match statement.cut {
            Some(symbol) => {
                self.returned.contains(&statement.name) || self.nodes.contains(&symbol.id())
            }
            None => {
                self.returned.contains(&statement.name) || self.nodes.contains(&id) || opposite(id)
            }
        }
    }
}

/// The numbers that claims give the name, else those that its heading cites.
fn tag(name: &str, heading: &Heading, claims: &[Claim<'_>]) -> Option<String> {
    let own = claims.iter().filter(|claim| claim.components.iter().any(|(own, _)| own == name));
    let mut tags: Vec<_> = own.map(|claim| claim.tag.as_str()).collect();
    tags.dedup();
    if tags.is_empty() {
        tags = heading.equations().iter().map(String::as_str).collect();
    }
    (!tags.is_empty()).then(|| tags.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_has_the_numbers_of_its_claims_or_else_of_its_heading() {
        let graph = Graph::new();
        let claim = |tag: &str| {
            let components = vec![("claimed".to_owned(), graph.zero())];
            Claim { tag: tag.to_owned(), name: String::new(), components }
        };
        let claims = ["(D14)", "(D15)"].map(claim);
        let heading = Heading::new("Right side").equation("(80), (101)");
        let tag = |name| tag(name, &heading, &claims).unwrap();
        assert_eq!((tag("claimed"), tag("other")), ("(D14), (D15)".into(), "(80), (101)".into()));
        assert_eq!(super::tag("other", &Heading::new("As it is"), &claims), None);
    }
}
