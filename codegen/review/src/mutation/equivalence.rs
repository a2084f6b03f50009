//! A mutant that no law notices: the same function written otherwise, or not.

use rustc_hash::FxHashMap;

use super::device::{Device, PREPARE};
use super::listing::Line;
use super::site::{Change, Location, Site, partner};
use precess_codegen::graph::{Expr, Graph, Node, NodeId};
use precess_codegen::normal::Ring;

/// Whether every statement that holds the changed node keeps its normal form, or what is dropped or
/// flipped there is zero.
pub(super) fn is_the_same(device: &Device<'_, '_>, index: usize, site: &Site) -> bool {
    let Location::Operand { node, second } = site.place else { return false };
    let graph = device.chain.graph;
    let operand = graph.node(node).operands().nth(usize::from(second));
    if site.mutant.change != Change::Swap
        && operand.is_some_and(|operand| is_zero(device, index, graph.expr(operand)))
    {
        return true;
    }
    let Some(changed) = changed(graph, node, second, site.mutant.change) else { return false };
    let listings = device.listings.iter().enumerate();
    let meant = listings.filter(|(k, _)| index == PREPARE || *k == index);
    let mut lines = meant.flat_map(|(_, listing)| &listing.lines);
    lines.all(|line| same_line(graph, line, node, changed))
}

/// Whether a value of a function is zero once all that it is made of is put in, through the cuts.
fn is_zero<'g>(device: &Device<'_, 'g>, index: usize, value: Expr<'g>) -> bool {
    let mut behind: FxHashMap<NodeId, Expr<'g>> = FxHashMap::default();
    for line in &device.listings[index].lines {
        let Some(symbol) = line.cut else { continue };
        behind.insert(symbol.id(), put_in(line.value, &behind));
    }
    let whole = put_in(value, &behind);
    Ring::new(value.graph()).normal(whole).is_ok_and(|normal| normal.is_empty())
}

/// `e` with what its symbols stand for.
fn put_in<'g>(e: Expr<'g>, behind: &FxHashMap<NodeId, Expr<'g>>) -> Expr<'g> {
    e.rebuild(|symbol| behind.get(&e.graph().named(symbol).id()).copied())
}

fn same_line<'g>(graph: &'g Graph, line: &Line<'g>, node: NodeId, changed: Expr<'g>) -> bool {
    let wrong = replaced(graph, line.value, node, changed);
    if wrong == line.value {
        return true;
    }
    let mut ring = Ring::new(graph);
    match (ring.normal(line.value), ring.normal(wrong)) {
        (Ok(right), Ok(wrong)) => right == wrong,
        _ => false,
    }
}

/// The node as the mutant has it.
fn changed(graph: &Graph, node: NodeId, second: bool, change: Change) -> Option<Expr<'_>> {
    let e = |id| graph.expr(id);
    let swapped = |id: NodeId, here: bool| if here { partner(graph, e(id)) } else { Some(e(id)) };
    Some(match (graph.node(node), change) {
        (Node::Sum(a, b), Change::Drop) => e(if second { a } else { b }),
        (Node::Sum(a, b), Change::Flip) if second => e(a) - e(b),
        (Node::Sum(a, b), Change::Flip) => e(b) - e(a),
        (Node::Sum(a, b), Change::Swap) => swapped(a, !second)? + swapped(b, second)?,
        (Node::Product(a, b), Change::Swap) => swapped(a, !second)? * swapped(b, second)?,
        (Node::Neg(a), Change::Swap) => -partner(graph, e(a))?,
        (Node::Recip(a), Change::Swap) => partner(graph, e(a))?.recip(),
        _ => return None,
    })
}

/// `root` with another expression in place of one node.
fn replaced<'g>(graph: &'g Graph, root: Expr<'g>, node: NodeId, by: Expr<'g>) -> Expr<'g> {
    let mut made: FxHashMap<NodeId, Expr<'g>> = FxHashMap::default();
    for id in graph.reachable([root.id()]) {
        let new = match graph.node(id) {
            _ if id == node => by,
            Node::Constant(_) | Node::Symbol(_) => graph.expr(id),
            Node::Sum(a, b) => made[&a] + made[&b],
            Node::Product(a, b) => made[&a] * made[&b],
            Node::Neg(a) => -made[&a],
            Node::Recip(a) => made[&a].recip(),
        };
        made.insert(id, new);
    }
    made[&root.id()]
}

#[cfg(test)]
mod tests {
    use super::*;
    use precess_codegen::graph::Stage;

    fn line<'g>(value: Expr<'g>) -> Line<'g> {
        let empty = String::new;
        Line { section: empty(), name: empty(), tag: None, value, cut: None, nodes: Vec::new() }
    }

    #[test]
    fn only_what_cancels_may_be_changed() {
        let g = Graph::new();
        let rate = g.symbol("q_dot", Stage::Rate);
        let (s, c) = g.angle("q", rate);
        // s² + c² swapped in both factors of one square is still one; c s swapped in one is not.
        let squares = s.squared() + c.squared();
        let node = s.squared().id();
        let other = g.constant(1) - c.squared();
        assert!(same_line(&g, &line(squares), node, other));
        assert!(!same_line(&g, &line(squares), node, s * c));
        assert!(!same_line(&g, &line(rate + s), (rate + s).id(), rate - s));
    }
}
