//! Sums and differences: with operators, or as one operation with a product.

use super::Writer;
use crate::emit::render::{Binding, Rendered};
use crate::graph::{Node, NodeId};

impl Writer<'_, '_> {
    /// `a + b`: where one of them is a product, what the other is increased by.
    pub(super) fn sum(&mut self, a: NodeId, b: NodeId) -> Rendered {
        self.counts.add += 1;
        match (self.factors(a), self.factors(b)) {
            (_, Some(of_b)) => self.fused(a, "add_mul", of_b),
            (Some(of_a), None) => self.fused(b, "add_mul", of_a),
            _ => self.commuting(a, b, Rendered::plus, Binding::Sum),
        }
    }

    /// `a - b`, likewise.
    pub(super) fn difference(&mut self, a: NodeId, b: NodeId) -> Rendered {
        self.counts.add += 1;
        match (self.factors(a), self.factors(b)) {
            (_, Some(of_b)) => self.fused(a, "sub_mul", of_b),
            (Some([x, y]), None) => self.fused(x, "mul_sub", [y, b]),
            _ => self.fitting([a, b], |[a, b]| a.minus(b)),
        }
    }

    /// The factors of a product that is written in place and may be fused with a sum.
    fn factors(&self, id: NodeId) -> Option<[NodeId; 2]> {
        match self.inline(id) {
            Node::Product(a, b) if self.fusing => Some([a, b]),
            _ => None,
        }
    }

    /// A product and a sum in one operation.
    fn fused(&mut self, object: NodeId, name: &str, [a, b]: [NodeId; 2]) -> Rendered {
        self.counts.mul += 1;
        self.fitting([object, a, b], |[object, a, b]| object.method(name, [a, b]))
    }
}
