//! One rewriting of a function: each sum of products, as far as it reaches, with fewer operations.
//!
//! A sum reaches through sums, signs and products that nothing else uses and that have no name. What
//! it ends at is a factor, whatever that is made of: it is a sum of its own.

use rustc_hash::FxHashMap;

use super::sum::{Sum, Term, Written};
use super::{Function, statements};
use crate::derivation::script::Section;
use crate::emit::body::Shape;
use crate::graph::{Expr, Node, NodeId};

/// What becomes of a product that has no name and more than one user.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Shared {
    /// It is one factor.
    Kept,
    /// Each user takes it apart: it is spared where all find a better use for its factors.
    Apart,
}

impl Shared {
    /// Both, the one first that cannot fail.
    pub(super) const EACH: [Self; 2] = [Self::Kept, Self::Apart];
}

/// The sections of a function, each sum that gains by it rewritten.
pub(super) fn rewritten<'g>(function: &Function<'_, 'g>, shared: Shared) -> Vec<Section<'g>> {
    let shape = function.shape();
    let made = Rewriting { function, shape: &shape, shared, made: FxHashMap::default() }.all();
    let mut sections = function.sections.clone();
    for statement in sections.iter_mut().flat_map(|section| &mut section.statements) {
        if shape.live.contains(&statement.name) {
            statement.value = made[&statement.value.id()];
        }
    }
    sections
}

struct Rewriting<'a, 'g> {
    function: &'a Function<'a, 'g>,
    shape: &'a Shape,
    shared: Shared,
    /// What has become of each node so far.
    made: FxHashMap<NodeId, Expr<'g>>,
}

impl<'g> Rewriting<'_, 'g> {
    fn all(mut self) -> FxHashMap<NodeId, Expr<'g>> {
        let (graph, live) = (self.function.graph, &self.shape.live);
        let roots = statements(&self.function.sections).filter(|s| live.contains(&s.name));
        for id in graph.reachable(roots.map(|statement| statement.value.id())) {
            let made = |id: NodeId| self.made[&id];
            let new = match graph.node(id) {
                _ if self.function.free.contains(&id) => graph.expr(id),
                Node::Constant(_) | Node::Symbol(_) => graph.expr(id),
                Node::Sum(a, b) => self.factored(id).unwrap_or_else(|| made(a) + made(b)),
                Node::Product(a, b) => self.factored(id).unwrap_or_else(|| made(a) * made(b)),
                Node::Neg(a) => -made(a),
                Node::Recip(a) => made(a).recip(),
            };
            self.made.insert(id, new);
        }
        self.made
    }

    /// The sum that ends in this node, where fewer operations give it.
    fn factored(&self, id: NodeId) -> Option<Expr<'g>> {
        let mut terms = Vec::new();
        let before = self.terms(id, true, false, &mut terms);
        let Written { value, operations } = Sum::new(terms).written();
        (operations < before).then_some(value)
    }

    /// Adds the terms of a node; the operations that they take unchanged.
    fn terms(&self, id: NodeId, root: bool, negative: bool, terms: &mut Vec<Term<'g>>) -> usize {
        match self.function.graph.node(id) {
            Node::Sum(a, b) if root || self.passes(id) => {
                let [a, b] = self.as_written(a, b);
                1 + self.terms(a, false, negative, terms) + self.terms(b, false, negative, terms)
            }
            Node::Neg(a) if self.passes(id) => self.terms(a, false, !negative, terms),
            _ => {
                let mut term = Term::signed(negative);
                let operations = self.factors(id, root, &mut term);
                terms.push(term);
                operations
            }
        }
    }

    /// Adds the factors of a node, likewise.
    fn factors(&self, id: NodeId, root: bool, term: &mut Term<'g>) -> usize {
        match self.function.graph.node(id) {
            Node::Product(a, b) if root || self.passes(id) => {
                let [a, b] = self.as_written(a, b);
                1 + self.factors(a, false, term) + self.factors(b, false, term)
            }
            _ => {
                term.push(self.made[&id], self.function.free.contains(&id));
                0
            }
        }
    }

    /// Operands as a line has them: what is written without parentheses goes first, a sign last.
    fn as_written(&self, a: NodeId, b: NodeId) -> [NodeId; 2] {
        let place = |id: NodeId| match self.function.graph.node(id) {
            _ if !self.passes(id) => 1,
            Node::Sum(..) | Node::Product(..) => 0,
            _ => 2,
        };
        if place(b) < place(a) { [b, a] } else { [a, b] }
    }

    /// Whether a sum may reach through this node. A sign is no value of its own.
    fn passes(&self, id: NodeId) -> bool {
        let own = match self.function.graph.node(id) {
            Node::Neg(_) => true,
            Node::Product(..) if self.shared == Shared::Apart => true,
            _ => self.shape.uses.get(&id) == Some(&1),
        };
        own && !self.shape.names.contains_key(&id) && !self.function.free.contains(&id)
    }
}
