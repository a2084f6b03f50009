//! What the emitted functions cost, and what the passes over a chain bring.

use serde::Serialize;

use super::body::Counts;
use super::file::kernel_body;
use super::prepare::prepared;
use crate::derivation::base::Passes;
use crate::derivation::chain::Chain;
use crate::graph::Graph;
use crate::kernel::{kernels, parameters};
use crate::kinds::Kind;

/// One function's operations, as a table shows them.
#[derive(Clone, Debug, Serialize)]
pub(super) struct CountText {
    kind: String,
    pub(super) function: String,
    mul: usize,
    add: usize,
    neg: usize,
    div: usize,
    pub(super) total: usize,
}

/// The operations of a function of a kind.
pub(super) fn count(kind: &str, function: &str, counts: Counts) -> CountText {
    let Counts { mul, add, neg, div } = counts;
    let (kind, function) = (kind.to_owned(), function.to_owned());
    CountText { kind, function, mul, add, neg, div, total: counts.total() }
}

/// Operations of `eliminate` after each of [`Passes::EACH`].
pub(super) fn passes(kind: &'static Kind) -> Vec<usize> {
    let after = |passes| {
        let graph = Graph::new();
        let chain = Chain::after(&graph, kind, passes);
        let kernels = kernels(&chain);
        let prepared = prepared(&graph, &kernels, &parameters(kind));
        let eliminate = kernels.iter().find(|kernel| kernel.name == "eliminate");
        eliminate.map_or(0, |kernel| kernel_body(&chain, kernel, &prepared).counts.total())
    };
    Passes::EACH.map(after).to_vec()
}
