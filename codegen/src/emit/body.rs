//! Statements of one function: which nodes get a name, in which order, and what they cost.
//!
//! Invariant: no statement only repeats a name or a field of an argument, and none gives a constant
//! a second name. A result of that kind is written where it is returned.

mod names;

use std::collections::BTreeMap;

use rustc_hash::{FxHashMap, FxHashSet};

use proc_macro2::{TokenStream, TokenTree};
use quote::{format_ident, quote};

use super::render::{Binding, Rendered};
use crate::derivation::script::{Section, Statement};
use crate::graph::{Graph, Node, NodeId, Rational};

/// A statement with its indentation stays within this width, at which neither formatter breaks it.
const WIDTH: usize = 89;
/// What is on a line besides name and value: indentation, `let`, ` = `, `;`, and `-(` `)`.
const FRAME: usize = "    let  = ;-()".len();

/// Operations as written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Multiplications.
    pub mul: usize,
    /// Additions and subtractions.
    pub add: usize,
    /// Changes of sign.
    pub neg: usize,
    /// Reciprocals.
    pub div: usize,
}

impl Counts {
    /// All of them.
    #[must_use]
    pub fn total(self) -> usize {
        self.mul + self.add + self.neg + self.div
    }
}

/// A function's statements, section by section.
#[derive(Clone, Debug, Default)]
pub struct FunctionBody {
    /// Comment and statements. Constants that only the returned record reads have no comment.
    pub sections: Vec<(String, Vec<TokenStream>)>,
    /// The results that no statement names, each with the name or the field, `p.m_w`, that it is.
    pub copies: BTreeMap<String, String>,
    /// What they cost.
    pub counts: Counts,
}

impl FunctionBody {
    /// Whether the argument called `letter` is read; one that is not read is not taken.
    pub(super) fn mentions(&self, letter: &str) -> bool {
        let mut statements = self.sections.iter().flat_map(|(_, statements)| statements);
        let argument = |value: &String| value.split_once('.').is_some_and(|(of, _)| of == letter);
        statements.any(|tokens| mention(tokens.clone(), letter))
            || self.copies.values().any(argument)
    }

    /// How the result of this name is written.
    pub(super) fn result<'a>(&'a self, name: &'a str) -> &'a str {
        self.copies.get(name).map_or(name, String::as_str)
    }
}

/// What there is to write of a function.
pub(super) struct Shape {
    /// Names of the statements that the outputs need.
    pub(super) live: FxHashSet<String>,
    /// Names of nodes.
    pub(super) names: FxHashMap<NodeId, String>,
    /// How often each node is an operand.
    pub(super) uses: FxHashMap<NodeId, usize>,
}

/// Whether the tokens name it.
pub(super) fn mention(tokens: TokenStream, name: &str) -> bool {
    tokens.into_iter().any(|tree| match tree {
        TokenTree::Ident(ident) => ident == name,
        TokenTree::Group(group) => mention(group.stream(), name),
        TokenTree::Punct(_) | TokenTree::Literal(_) => false,
    })
}

/// Writes the sections of a function.
pub(super) struct Writer<'a, 'g> {
    graph: &'g Graph,
    /// How a symbol or a hoisted node is written where it is not computed here.
    given: &'a dyn Fn(NodeId) -> Option<Rendered>,
    witness: Rendered,
    names: FxHashMap<NodeId, String>,
    bound: FxHashMap<NodeId, Rendered>,
    locals: FxHashSet<String>,
    uses: FxHashMap<NodeId, usize>,
    numbers: BTreeMap<String, usize>,
    prefix: String,
    /// Columns left for the value of the statement at hand.
    room: usize,
    statements: Vec<TokenStream>,
    copies: BTreeMap<String, String>,
    counts: Counts,
}

impl<'a, 'g> Writer<'a, 'g> {
    pub(super) fn new(
        graph: &'g Graph,
        given: &'a dyn Fn(NodeId) -> Option<Rendered>,
        witness: Rendered,
    ) -> Self {
        Self {
            graph,
            given,
            witness,
            names: FxHashMap::default(),
            bound: FxHashMap::default(),
            locals: FxHashSet::default(),
            uses: FxHashMap::default(),
            numbers: BTreeMap::new(),
            prefix: String::new(),
            room: 0,
            statements: Vec::new(),
            copies: BTreeMap::new(),
            counts: Counts::default(),
        }
    }

    /// The body that computes `outputs`, and nothing that they do not need.
    pub(super) fn write(mut self, sections: &[Section<'g>], outputs: &[String]) -> FunctionBody {
        let live = self.live(sections, outputs);
        let (mut written, mut constants) = (Vec::new(), Vec::new());
        for section in sections {
            self.prefix.clone_from(&section.prefix);
            for statement in section.statements.iter().filter(|s| live.contains(&s.name)) {
                let (id, output) = (statement.value.id(), outputs.contains(&statement.name));
                match self.graph.node(id) {
                    Node::Constant(value) if output && statement.cut.is_none() => {
                        self.copies.insert(statement.name.clone(), constant_name(value));
                        constants.push(id);
                    }
                    _ => self.statement(statement, output),
                }
            }
            let statements = std::mem::take(&mut self.statements);
            if !statements.is_empty() {
                written.push((section.heading.to_string(), statements));
            }
        }
        for constant in constants {
            self.operand(constant);
        }
        if !self.statements.is_empty() {
            written.push((String::new(), self.statements));
        }
        FunctionBody { sections: written, copies: self.copies, counts: self.counts }
    }

    /// What there is to write, without writing it.
    pub(super) fn shape(mut self, sections: &[Section<'g>], outputs: &[String]) -> Shape {
        let live = self.live(sections, outputs);
        Shape { live, names: self.names, uses: self.uses }
    }

    fn compound(&self, id: NodeId) -> bool {
        let leaf = matches!(self.graph.node(id), Node::Symbol(_) | Node::Constant(_));
        !leaf && (self.given)(id).is_none()
    }

    fn statement(&mut self, statement: &Statement<'g>, output: bool) {
        let id = statement.value.id();
        let own_name = self.names.get(&id) == Some(&statement.name);
        let given = statement.cut.is_some_and(|symbol| (self.given)(symbol.id()).is_some());
        if given && !output {
            return;
        }
        let mut called = Rendered::name(&statement.name);
        let opposite = match self.graph.node(id) {
            Node::Neg(inner)
                if self.names.get(&inner) == Some(&format!("neg_{}", statement.name)) =>
            {
                Some(inner)
            }
            _ => None,
        };
        if let Some(inner) = opposite {
            self.bind_shared(id);
            if !self.bound.contains_key(&inner) {
                self.bind(inner);
            }
        } else if own_name {
            self.bind_shared(id);
            if !self.bound.contains_key(&id) {
                self.bind(id);
            }
        } else if output || statement.cut.is_some() {
            self.bind_shared(id);
            self.room = WIDTH - FRAME - statement.name.len();
            let value = self.operand(id);
            if value.binding == Binding::Atom {
                if output {
                    let text = value.tokens.to_string().replace(' ', "");
                    self.copies.insert(statement.name.clone(), text);
                }
                called = value;
            } else {
                self.push(&statement.name, &value);
            }
        }
        if let Some(symbol) = statement.cut {
            self.bound.insert(symbol.id(), called);
        }
    }

    /// Names, in order, whatever `root` needs that is used more than once or has a name.
    fn bind_shared(&mut self, root: NodeId) {
        let mut nodes = FxHashSet::default();
        self.collect(root, &mut nodes);
        let mut ascending: Vec<_> = nodes.into_iter().filter(|id| *id != root).collect();
        ascending.sort_unstable();
        for id in ascending {
            let shared = self.uses.get(&id).copied().unwrap_or(0) > 1;
            let sign = matches!(self.graph.node(id), Node::Neg(_));
            let named = self.names.contains_key(&id);
            if self.compound(id) && !self.bound.contains_key(&id) && (named || shared && !sign) {
                self.bind(id);
            }
        }
    }

    /// Emits `let name = ...;` for a node and remembers the name.
    fn bind(&mut self, id: NodeId) -> Rendered {
        let name = self.names.get(&id).cloned();
        let columns = name.as_ref().map_or(self.prefix.len() + "_000".len(), String::len);
        let room = std::mem::replace(&mut self.room, WIDTH - FRAME - columns);
        let value = self.compute(id);
        self.room = room;
        self.bind_rendered(id, name, &value)
    }

    fn push(&mut self, name: &str, value: &Rendered) {
        assert!(self.locals.insert(name.to_owned()), "`{name}` is emitted twice");
        let (ident, tokens) = (format_ident!("{name}"), &value.tokens);
        self.statements.push(quote!(let #ident = #tokens;));
    }

    /// A node as an operand: its name where it has one, else its expression.
    fn operand(&mut self, id: NodeId) -> Rendered {
        if let Some(bound) = self.bound.get(&id) {
            return bound.clone();
        }
        if let Some(given) = (self.given)(id) {
            return given;
        }
        match self.graph.node(id) {
            Node::Constant(value) => {
                let rendered = Rendered::constant(&self.witness, value);
                self.bind_rendered(id, Some(constant_name(value)), &rendered)
            }
            _ => self.compute(id),
        }
    }

    fn compute(&mut self, id: NodeId) -> Rendered {
        match self.graph.node(id) {
            Node::Sum(a, b) => {
                self.counts.add += 1;
                match (self.inline(a), self.inline(b)) {
                    (_, Node::Neg(b)) => self.fitting([a, b], |[a, b]| a.minus(b)),
                    (Node::Neg(a), _) => self.fitting([b, a], |[b, a]| b.minus(a)),
                    _ => self.commuting(a, b, Rendered::plus, Binding::Sum),
                }
            }
            Node::Product(a, b) => {
                self.counts.mul += 1;
                self.commuting(a, b, Rendered::times, Binding::Product)
            }
            Node::Neg(a) => {
                self.counts.neg += 1;
                self.operand(a).negated()
            }
            Node::Recip(a) => {
                self.counts.div += 1;
                self.operand(a).recip()
            }
            Node::Symbol(_) | Node::Constant(_) => self.operand(id),
        }
    }

    /// The node itself, or something without operands where it has a name.
    fn inline(&self, id: NodeId) -> Node {
        let named = self.bound.contains_key(&id) || (self.given)(id).is_some();
        if named { Node::Constant(Rational::ZERO) } else { self.graph.node(id) }
    }

    /// Addition and multiplication commute exactly: the operand that would need parentheses
    /// on the right goes to the left.
    fn commuting(
        &mut self,
        a: NodeId,
        b: NodeId,
        join: fn(&Rendered, &Rendered) -> Rendered,
        kind: Binding,
    ) -> Rendered {
        let chained = |writer: &Self, id: NodeId| {
            !writer.bound.contains_key(&id)
                && writer.compound(id)
                && match writer.graph.node(id) {
                    Node::Sum(..) => kind == Binding::Sum,
                    Node::Product(..) => kind == Binding::Product,
                    _ => false,
                }
        };
        let swap = chained(self, b) && !chained(self, a);
        let operands = if swap { [b, a] } else { [a, b] };
        self.fitting(operands, |[a, b]| join(a, b))
    }

    /// Operands joined, the widest of them under names of their own until the line fits.
    fn fitting<const N: usize>(
        &mut self,
        ids: [NodeId; N],
        join: impl Fn(&[Rendered; N]) -> Rendered,
    ) -> Rendered {
        let mut operands = ids.map(|id| self.operand(id));
        while join(&operands).width > self.room {
            let sides = operands.iter_mut().zip(ids);
            let long = sides.filter(|(side, _)| side.binding != Binding::Atom);
            let Some((wide, id)) = long.max_by_key(|(side, _)| side.width) else { break };
            *wide = self.bind_rendered(id, None, wide);
        }
        join(&operands)
    }

    /// Emits a rendered value under its name, or under the section's next number.
    fn bind_rendered(&mut self, id: NodeId, name: Option<String>, value: &Rendered) -> Rendered {
        let name = name.unwrap_or_else(|| {
            let number = self.numbers.entry(self.prefix.clone()).or_default();
            *number += 1;
            format!("{}_{}", self.prefix, *number - 1)
        });
        self.push(&name, value);
        let rendered = Rendered::name(&name);
        self.bound.insert(id, rendered.clone());
        rendered
    }
}

/// A constant is made once in a function, under a name that says it.
fn constant_name(value: Rational) -> String {
    match (*value.numer(), *value.denom()) {
        (0, _) => "zero".to_owned(),
        (1, 1) => "one".to_owned(),
        (1, 2) => "half".to_owned(),
        (numerator, denominator) => format!("constant_{numerator}_{denominator}"),
    }
}
