//! Expressions flattened for repeated evaluation: batches of one operation over plain numbers.
//!
//! What depends on parameters only is computed once, when the tape is made.

use std::collections::BTreeMap;

use super::ConsequenceError;
use super::table1::parameter;
use precess_codegen::graph::{Expr, Graph, Node, NodeId, float};

/// Roots over named inputs, with Table 1's numbers for the parameters.
///
/// Slots hold the constants, then the inputs, then one result per operation.
pub(super) struct Tape {
    constants: Vec<f64>,
    batches: Vec<Batch>,
    roots: Vec<usize>,
}

/// Operations of one kind, none of which needs another's result: two thirds of the time of a list
/// of mixed operations is spent on guessing which comes next.
struct Batch {
    operation: Operation,
    /// Slots of the operands; the second one of a single operand is the first again.
    operands: Vec<(usize, usize)>,
}

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Operation {
    Sum,
    Product,
    Neg,
    Recip,
}

impl Tape {
    /// Flattens `roots`, which are made of parameters and `inputs`.
    ///
    /// # Errors
    /// When a root contains another symbol.
    pub(super) fn new<'g>(
        graph: &'g Graph,
        roots: &[Expr<'g>],
        inputs: &[&str],
    ) -> Result<Self, ConsequenceError> {
        let reachable = graph.reachable(roots.iter().map(|root| root.id()));
        let (mut constants, mut slots) = (Vec::new(), BTreeMap::new());
        let mut varying = Vec::new();
        // The longest way from an input, for each node that depends on one.
        let mut levels = BTreeMap::new();
        for &id in &reachable {
            let node = graph.node(id);
            let fixed = match node {
                Node::Constant(k) => Some(float(k)),
                Node::Symbol(symbol) => {
                    let name = graph.symbol_info(symbol).name;
                    let number = parameter(&name);
                    if inputs.contains(&name.as_str()) {
                        None
                    } else {
                        Some(number.ok_or(ConsequenceError::Symbol { name })?)
                    }
                }
                _ => apply(node, |operand| Some(constants[*slots.get(&operand)?])),
            };
            if let Some(value) = fixed {
                slots.insert(id, constants.len());
                constants.push(value);
                continue;
            }
            let below = node.operands().filter_map(|operand| levels.get(&operand));
            let level: u32 = below.max().map_or(0, |level| level + 1);
            levels.insert(id, level);
            varying.extend(Operation::of_node(node).map(|operation| (level, operation, id)));
        }
        for (input, name) in inputs.iter().enumerate() {
            if let Some(symbol) = graph.find(name) {
                slots.insert(symbol.id(), constants.len() + input);
            }
        }
        varying.sort_unstable();
        let mut next = constants.len() + inputs.len();
        let mut batches = Vec::new();
        for batch in varying.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
            let operands = batch.iter().map(|(_, _, id)| operands(graph.node(*id), &slots));
            batches.push(Batch { operation: batch[0].1, operands: operands.collect() });
            for (_, _, id) in batch {
                slots.insert(*id, next);
                next += 1;
            }
        }
        let roots = roots.iter().map(|root| slots[&root.id()]).collect();
        Ok(Self { constants, batches, roots })
    }

    /// The values of the roots, given one number for each input; `slots` is scratch.
    pub(super) fn evaluate<'s>(
        &'s self,
        inputs: &[f64],
        slots: &'s mut Vec<f64>,
    ) -> impl Iterator<Item = f64> + 's {
        slots.clear();
        slots.extend_from_slice(&self.constants);
        slots.extend_from_slice(inputs);
        for Batch { operation, operands } in &self.batches {
            let known = slots.len();
            slots.resize(known + operands.len(), 0.0);
            let (known, new) = slots.split_at_mut(known);
            let pairs = new.iter_mut().zip(operands);
            match operation {
                Operation::Sum => pairs.for_each(|(c, (a, b))| *c = known[*a] + known[*b]),
                Operation::Product => pairs.for_each(|(c, (a, b))| *c = known[*a] * known[*b]),
                Operation::Neg => pairs.for_each(|(c, (a, _))| *c = -known[*a]),
                Operation::Recip => pairs.for_each(|(c, (a, _))| *c = known[*a].recip()),
            }
        }
        self.roots.iter().map(|root| slots[*root])
    }
}

impl Operation {
    fn of_node(node: Node) -> Option<Self> {
        match node {
            Node::Constant(_) | Node::Symbol(_) => None,
            Node::Sum(..) => Some(Self::Sum),
            Node::Product(..) => Some(Self::Product),
            Node::Neg(_) => Some(Self::Neg),
            Node::Recip(_) => Some(Self::Recip),
        }
    }
}

/// The value of an operation, where its operands have one.
fn apply(node: Node, value: impl Fn(NodeId) -> Option<f64>) -> Option<f64> {
    match node {
        Node::Constant(_) | Node::Symbol(_) => None,
        Node::Sum(a, b) => Some(value(a)? + value(b)?),
        Node::Product(a, b) => Some(value(a)? * value(b)?),
        Node::Neg(a) => Some(-value(a)?),
        Node::Recip(a) => Some(value(a)?.recip()),
    }
}

fn operands(node: Node, slots: &BTreeMap<NodeId, usize>) -> (usize, usize) {
    let mut slots = node.operands().map(|operand| slots[&operand]);
    let first = slots.next().unwrap_or_default();
    (first, slots.next().unwrap_or(first))
}

#[cfg(test)]
mod tests {
    use super::*;
    use precess_codegen::graph::Stage;

    #[test]
    fn a_tape_gives_what_the_expression_gives() {
        let g = Graph::new();
        let [m, d] = ["m_w", "d"].map(|name| g.symbol(name, Stage::Parameter));
        let [x, y] = ["x", "y"].map(|name| g.symbol(name, Stage::Rate));
        let roots = [(m * d + x) * y.recip() - m, -(m.recip() * d), y, x * y + x * x];
        let tape = Tape::new(&g, &roots, &["x", "y"]).unwrap();
        let values: Vec<_> = tape.evaluate(&[3.0, 7.0], &mut Vec::new()).collect();
        let value = |name: &str| match name {
            "x" => 3.0,
            "y" => 7.0,
            _ => parameter(name).unwrap(),
        };
        assert_eq!(values, roots.map(|root| root.evaluate(&value)));
    }

    #[test]
    fn what_depends_on_parameters_alone_is_calculated_once() {
        let g = Graph::new();
        let [m, d] = ["m_w", "d"].map(|name| g.symbol(name, Stage::Parameter));
        let x = g.symbol("x", Stage::Rate);
        let tape = Tape::new(&g, &[m * d.recip() * x], &["x"]).unwrap();
        assert_eq!(tape.batches.iter().map(|batch| batch.operands.len()).sum::<usize>(), 1);
    }

    #[test]
    fn a_symbol_without_a_number_is_named() {
        let g = Graph::new();
        let x = g.symbol("x", Stage::Rate);
        let error = Tape::new(&g, &[x], &[]).map(|_| ()).unwrap_err();
        assert_eq!(error, ConsequenceError::Symbol { name: "x".to_owned() });
    }
}
