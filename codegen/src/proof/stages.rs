//! The stages of the elimination: what an entry of the system is once the joints from the tip inwards
//! are eliminated, `mass_pq_h`, `f_q_bx_h`, `tau_p_h`.
//!
//! In the identities of [`super::factors`] each stage is a symbol, except for those of the entry that
//! the identity is about: these are replaced by what the text computes, one after the other, until the
//! entry itself is left. A polynomial identity in symbols holds for any values of them, hence for the
//! values that the text gives to the stages of other entries; each of those is written out in the
//! identity of its own entry. So every product `gain * row` that is subtracted is multiplied out once,
//! and no identity is longer than the number of joints.

use rustc_hash::FxHashSet;

use super::modes::Settled;
use super::unknowns::{AXES, HUB, Unknowns};
use crate::graph::{Expr, Node, SymbolId};
use crate::normal::Ring;

/// The names of all stages of all entries.
pub(super) fn all(unknowns: &Unknowns<'_>) -> Vec<String> {
    let joints: Vec<_> = unknowns.solved().into_iter().skip(HUB.len()).collect();
    let entries = joints.iter().flat_map(|&y| {
        let inboard = unknowns.solved().into_iter().filter(move |x| *x <= y);
        inboard.flat_map(move |x| of_entry(unknowns, x, y)).chain(of_right_side(unknowns, y))
    });
    entries.collect()
}

/// The stages of the entry between unknown `x` and joint `y`, not nearer the hub: after the tip, after
/// the two outermost joints, and so on up to the joint outboard of `y`.
pub(super) fn of_entry(unknowns: &Unknowns<'_>, x: usize, y: usize) -> Vec<String> {
    let (of, tag) = (unknowns.suffix(x), unknowns.suffix(y));
    let entry = match x / AXES.len() {
        0 => format!("f_{tag}_{}", AXES[x]),
        1 => format!("n_{tag}_{}", AXES[x - AXES.len()]),
        _ => format!("mass_{of}{tag}"),
    };
    after(unknowns, y, &entry).collect()
}

/// The stages of the right side of joint `x`, torque less bias first.
pub(super) fn of_right_side(unknowns: &Unknowns<'_>, x: usize) -> Vec<String> {
    let entry = format!("tau_{}", unknowns.suffix(x));
    let stages: Vec<_> = after(unknowns, x, &entry).collect();
    std::iter::once(entry).chain(stages).collect()
}

fn after(unknowns: &Unknowns<'_>, y: usize, entry: &str) -> impl Iterator<Item = String> {
    let outboard = unknowns.solved().into_iter().rev().take_while(move |j| *j > y);
    let mut done = String::new();
    outboard.map(move |j| {
        done.push_str(unknowns.suffix(j));
        format!("{entry}_{done}")
    })
}

/// These stages by their symbols, each with its value in terms of the entries themselves: a stage is
/// made of those before it.
pub(super) fn written<'g>(
    settled: &Settled<'_, 'g>,
    names: impl IntoIterator<Item = String>,
) -> Vec<(SymbolId, Expr<'g>)> {
    let mut made: Vec<(SymbolId, Expr<'g>)> = Vec::new();
    for (symbol, value) in names.into_iter().filter_map(|name| settled.stage(&name)) {
        made.push((symbol, value.with(&made)));
    }
    made
}

/// `e` with these symbols written out, products with their reciprocals reduced first: those that `e`
/// divides by even then are left.
pub(super) fn write_out<'g>(e: Expr<'g>, written: &[(SymbolId, Expr<'g>)]) -> Expr<'g> {
    let divisors = divisors(e);
    if written.iter().all(|(symbol, _)| !divisors.contains(symbol)) {
        return e.with(written);
    }
    let mut ring = Ring::new(e.graph());
    let Ok(normal) = ring.normal(e) else { return e };
    let reduced = ring.expression(&normal);
    let divisors = self::divisors(reduced);
    let written = written.iter().filter(|(symbol, _)| !divisors.contains(symbol));
    reduced.with(&written.copied().collect::<Vec<_>>())
}

/// The symbols that `e` divides by.
fn divisors(e: Expr<'_>) -> FxHashSet<SymbolId> {
    let graph = e.graph();
    let recips = graph.reachable([e.id()]).into_iter().filter_map(|id| match graph.node(id) {
        Node::Recip(of) => match graph.node(of) {
            Node::Symbol(symbol) => Some(symbol),
            _ => None,
        },
        _ => None,
    });
    recips.collect()
}
