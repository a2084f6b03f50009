//! Common factors: `a b + a c` is written as `a (b + c)` wherever that makes a function shorter.
//!
//! A function is rewritten right before it is laid out. What has a name keeps name and value; sums
//! and products are collected through nodes that are neither named nor shared, see [`rewriting`].
//! What a rewriting saves is counted in the function as it would be emitted: nothing else shows
//! whether a product that two sums share is better expanded in both or kept.

mod rewriting;
mod sum;

use rustc_hash::FxHashSet;

use self::rewriting::{Shared, rewritten};
use super::body::{Shape, Writer};
use super::render::Rendered;
use crate::derivation::script::{Section, Statement};
use crate::graph::{Expr, Graph, Node, NodeId, Stage};

/// The sections of a function with common factors taken out, as long as that lowers its operations.
/// What depends on parameters only counts zero operations where it is `hoisted` into `prepare`.
pub(super) fn factored<'g>(
    graph: &'g Graph,
    sections: Vec<Section<'g>>,
    outputs: &[String],
    hoisted: bool,
) -> Vec<Section<'g>> {
    let mut best = Function::new(graph, sections, outputs, hoisted);
    let mut least = best.operations();
    loop {
        let mut candidates = Shared::EACH.into_iter().map(|shared| {
            let candidate = Function::new(graph, rewritten(&best, shared), outputs, hoisted);
            (candidate.operations(), candidate)
        });
        let better = candidates.find(|(operations, _)| *operations < least);
        drop(candidates);
        let Some(better) = better else { return best.sections };
        (least, best) = better;
    }
}

/// A function before it is laid out.
struct Function<'a, 'g> {
    graph: &'g Graph,
    sections: Vec<Section<'g>>,
    outputs: &'a [String],
    /// What `prepare` computes, and constants beside it.
    free: FxHashSet<NodeId>,
    /// The symbols that stand for a statement of the function.
    cuts: FxHashSet<NodeId>,
}

impl<'a, 'g> Function<'a, 'g> {
    fn new(
        graph: &'g Graph,
        sections: Vec<Section<'g>>,
        outputs: &'a [String],
        hoisted: bool,
    ) -> Self {
        let cuts = statements(&sections).filter_map(|s| s.cut).map(Expr::id).collect();
        let mut function = Self { graph, sections, outputs, free: FxHashSet::default(), cuts };
        if hoisted {
            function.free = function.of_parameters();
        }
        function
    }

    /// Everything that depends on parameters only.
    fn of_parameters(&self) -> FxHashSet<NodeId> {
        let (graph, mut found) = (self.graph, FxHashSet::default());
        let roots = statements(&self.sections).flat_map(|s| s.cut.into_iter().chain([s.value]));
        for id in graph.reachable(roots.map(Expr::id)) {
            let node = graph.node(id);
            let of_parameters = match node {
                Node::Symbol(symbol) => graph.symbol_info(symbol).stage == Stage::Parameter,
                _ => node.operands().all(|operand| found.contains(&operand)),
            };
            if of_parameters {
                found.insert(id);
            }
        }
        found
    }

    /// What it costs as emitted.
    fn operations(&self) -> usize {
        self.with_writer(|writer| writer.write(&self.sections, self.outputs).counts.total())
    }

    /// What has a name, and how often the rest is used.
    fn shape(&self) -> Shape {
        self.with_writer(|writer| writer.shape(&self.sections, self.outputs))
    }

    fn with_writer<R>(&self, ask: impl FnOnce(Writer<'_, 'g>) -> R) -> R {
        let any = Rendered::name("given");
        let given = |id: NodeId| {
            let given = match self.graph.node(id) {
                Node::Constant(_) => false,
                Node::Symbol(_) => self.free.contains(&id) || !self.cuts.contains(&id),
                _ => self.free.contains(&id),
            };
            given.then(|| any.clone())
        };
        ask(Writer::new(self.graph, &given, any.clone()))
    }
}

fn statements<'s, 'g>(sections: &'s [Section<'g>]) -> impl Iterator<Item = &'s Statement<'g>> {
    sections.iter().flat_map(|section| &section.statements)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::derivation::heading::Heading;
    use crate::derivation::script::Script;

    /// What is left of a function that returns these values, and what it cost and costs.
    fn costs<'g>(values: &[(&str, Expr<'g>)], graph: &'g Graph) -> (Vec<Expr<'g>>, [usize; 2]) {
        let mut script = Script::new(graph);
        script.section("t", Heading::new("Test").equation("(1)"));
        script.names(values.iter().map(|(name, value)| ((*name).to_owned(), *value)));
        let outputs: Vec<_> = values.iter().map(|(name, _)| (*name).to_owned()).collect();
        let count = |sections| Function::new(graph, sections, &outputs, true).operations();
        let before = count(script.sections.clone());
        let after = factored(graph, script.sections, &outputs, true);
        (statements(&after).map(|s| s.value).collect(), [before, count(after.clone())])
    }

    fn symbols<'g, const N: usize>(
        graph: &'g Graph,
        names: [&str; N],
        stage: Stage,
    ) -> [Expr<'g>; N] {
        names.map(|name| graph.symbol(name, stage))
    }

    #[test]
    fn a_common_factor_is_taken_out() {
        let g = Graph::new();
        let [a, b, c, d] = symbols(&g, ["a", "b", "c", "d"], Stage::Rate);
        let (values, counts) = costs(&[("x", a * b * d - a * c)], &g);
        assert_eq!((values[0], counts), (a * (b * d - c), [4, 3]));
    }

    #[test]
    fn a_shared_product_is_spared_where_no_user_needs_it() {
        let g = Graph::new();
        let [a, b, c, d] = symbols(&g, ["a", "b", "c", "d"], Stage::Rate);
        let (values, counts) = costs(&[("x", a * b + a * c), ("y", a * b + a * d)], &g);
        assert_eq!((values, counts), (vec![a * (b + c), a * (b + d)], [5, 4]));
    }

    #[test]
    fn a_shared_product_is_kept_where_one_user_needs_it() {
        let g = Graph::new();
        let [a, b, c] = symbols(&g, ["a", "b", "c"], Stage::Rate);
        let given = [("x", a * b + a * c), ("y", a * b)];
        let (values, counts) = costs(&given, &g);
        assert_eq!((values, counts), (given.map(|(_, value)| value).to_vec(), [3, 3]));
    }

    #[test]
    fn a_named_value_is_not_taken_apart() {
        let g = Graph::new();
        let [a, b, c, d] = symbols(&g, ["a", "b", "c", "d"], Stage::Rate);
        let part = a * b + c;
        let (values, counts) = costs(&[("part", part), ("whole", part + a * d)], &g);
        assert_eq!((values, counts), (vec![part, part + a * d], [4, 4]));
    }

    #[test]
    fn what_prepare_computes_stands_together_and_stays_there() {
        let g = Graph::new();
        let [a, b] = symbols(&g, ["a", "b"], Stage::Rate);
        let [k, l, m] = symbols(&g, ["k", "l", "m"], Stage::Parameter);
        let (values, counts) = costs(&[("x", k + a + l + b)], &g);
        assert_eq!((values[0], counts), ((a + b) + (k + l), [3, 2]));
        // Two products of parameters are known: to take `m` out would undo that.
        let given = k * m * a + l * m * b;
        let (values, counts) = costs(&[("x", given)], &g);
        assert_eq!((values[0], counts), (given, [3, 3]));
    }
}
