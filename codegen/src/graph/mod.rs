//! The expression graph: rational constants, symbols, sum, product, negation, reciprocal.
//!
//! Invariants:
//! - nodes are interned, so equal expressions have equal ids and sharing is free;
//! - a node's operands have smaller ids than the node, so every pass is one loop in id order and
//!   no expression is too deep for the stack;
//! - ids depend only on the order of construction: the same derivation gives the same graph.
//!
//! Sine and cosine of an angle are two symbols (see [`Graph::angle`]); that their squares add to
//! one is known only to the normal form.

mod calculus;
pub(crate) mod rational;
mod rules;
mod symbol;

use std::cell::RefCell;
use std::ops::{Add, Mul, Neg, Sub};

use rustc_hash::FxHashMap;

pub use rational::{Rational, float};
pub use rules::RULES;
pub use symbol::{Stage, Symbol, SymbolId};

/// Position of a node in its graph.
pub type NodeId = u32;

/// One interned node. Operands of a sum and of a product are in id order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Node {
    /// A rational constant.
    Constant(Rational),
    /// A named quantity.
    Symbol(SymbolId),
    /// `a + b`.
    Sum(NodeId, NodeId),
    /// `a b`.
    Product(NodeId, NodeId),
    /// `-a`.
    Neg(NodeId),
    /// `1 / a`.
    Recip(NodeId),
}

impl Node {
    /// The ids of the operands, at most two.
    pub fn operands(self) -> impl Iterator<Item = NodeId> {
        let (first, second) = match self {
            Self::Constant(_) | Self::Symbol(_) => (None, None),
            Self::Neg(a) | Self::Recip(a) => (Some(a), None),
            Self::Sum(a, b) | Self::Product(a, b) => (Some(a), Some(b)),
        };
        first.into_iter().chain(second)
    }
}

#[derive(Default)]
struct Arena {
    nodes: Vec<Node>,
    index: FxHashMap<Node, NodeId>,
    symbols: Vec<Symbol>,
    names: FxHashMap<String, SymbolId>,
}

/// An arena of interned expressions.
#[derive(Default)]
pub struct Graph {
    arena: RefCell<Arena>,
}

/// A `Copy` handle to one expression of a [`Graph`].
#[derive(Clone, Copy)]
pub struct Expr<'g> {
    graph: &'g Graph,
    id: NodeId,
}

impl Graph {
    /// An empty graph.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// The constant `value`.
    #[must_use]
    pub fn constant(&self, value: impl Into<Rational>) -> Expr<'_> {
        self.intern(Node::Constant(value.into()))
    }

    /// The constant zero.
    #[must_use]
    pub fn zero(&self) -> Expr<'_> {
        self.constant(0)
    }

    /// The node of an id.
    #[must_use]
    pub fn node(&self, id: NodeId) -> Node {
        self.arena.borrow().nodes[id as usize]
    }

    /// The expression of a node.
    #[must_use]
    pub fn expr(&self, id: NodeId) -> Expr<'_> {
        Expr { graph: self, id }
    }

    fn intern(&self, node: Node) -> Expr<'_> {
        let mut arena = self.arena.borrow_mut();
        let arena = &mut *arena;
        let next =
            NodeId::try_from(arena.nodes.len()).expect("a graph holds fewer than 2^32 nodes");
        let id = *arena.index.entry(node).or_insert(next);
        if id == next {
            arena.nodes.push(node);
        }
        Expr { graph: self, id }
    }

    /// The id that the next new node will have.
    pub(crate) fn next(&self) -> NodeId {
        NodeId::try_from(self.arena.borrow().nodes.len()).unwrap_or(NodeId::MAX)
    }

    /// Every node that `roots` are made of, operands before their users.
    #[must_use]
    pub fn reachable(&self, roots: impl IntoIterator<Item = NodeId>) -> Vec<NodeId> {
        let arena = self.arena.borrow();
        let mut seen = vec![false; arena.nodes.len()];
        let mut pending: Vec<NodeId> = roots.into_iter().collect();
        let mut found = Vec::new();
        while let Some(id) = pending.pop() {
            if !std::mem::replace(&mut seen[id as usize], true) {
                found.push(id);
                pending.extend(arena.nodes[id as usize].operands());
            }
        }
        // An operand is older than its users.
        found.sort_unstable();
        found
    }
}

impl<'g> Expr<'g> {
    /// The graph this expression lives in.
    #[must_use]
    pub fn graph(self) -> &'g Graph {
        self.graph
    }

    /// Its node.
    #[must_use]
    pub fn id(self) -> NodeId {
        self.id
    }

    /// The node itself.
    #[must_use]
    pub fn node(self) -> Node {
        self.graph.node(self.id)
    }

    /// Whether this is the constant zero.
    #[must_use]
    pub fn is_zero(self) -> bool {
        self.node() == Node::Constant(Rational::ZERO)
    }

    /// `1 / self`.
    #[must_use]
    pub fn recip(self) -> Self {
        rules::recip(self)
    }

    /// `self * self`.
    #[must_use]
    pub fn squared(self) -> Self {
        self * self
    }

    fn apply(self, node: Node) -> Self {
        self.graph.intern(node)
    }
}

impl PartialEq for Expr<'_> {
    fn eq(&self, other: &Self) -> bool {
        assert!(std::ptr::eq(self.graph, other.graph), "handles of two graphs compared");
        self.id == other.id
    }
}

impl std::fmt::Debug for Expr<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Expr({})", self.id)
    }
}

impl<'g> Add for Expr<'g> {
    type Output = Self;
    fn add(self, other: Self) -> Expr<'g> {
        rules::sum(self, other)
    }
}

impl<'g> Sub for Expr<'g> {
    type Output = Self;
    fn sub(self, other: Self) -> Expr<'g> {
        rules::sum(self, -other)
    }
}

impl<'g> Mul for Expr<'g> {
    type Output = Self;
    fn mul(self, other: Self) -> Expr<'g> {
        rules::product(self, other)
    }
}

impl<'g> Neg for Expr<'g> {
    type Output = Self;
    fn neg(self) -> Expr<'g> {
        rules::neg(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_expressions_are_one_node() {
        let g = Graph::new();
        let [a, b] = ["a", "b"].map(|name| g.symbol(name, Stage::Parameter));
        assert_eq!(a * b + a, a + b * a);
        assert_ne!(a * b, a + b);
    }

    #[test]
    fn operands_precede_their_users() {
        let g = Graph::new();
        let [a, b] = ["a", "b"].map(|name| g.symbol(name, Stage::Parameter));
        let root = (a + b) * (a - b);
        for id in g.reachable([root.id()]) {
            assert!(g.node(id).operands().all(|operand| operand < id));
        }
    }
}
