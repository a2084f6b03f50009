//! What the emitted functions cost, and what the passes bring.

use serde::Serialize;

use super::body::Counts;
use super::functions::{Functions, functions, of_kernels};
use super::parts::{kernel_body, prepare_body};
use crate::derivation::chain::Chain;
use crate::derivation::chain::passes::Passes;
use crate::graph::Graph;
use crate::kernel::{Kernel, elimination};
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

/// Operations of `eliminate` after each of [`Passes::EACH`] that leaves the functions as they are.
pub(super) fn chain_passes(kind: &'static Kind) -> Vec<usize> {
    let after = |passes: &Passes| {
        let graph = Graph::new();
        let chain = Chain::after(&graph, kind, *passes);
        let Functions { prepared, kernels } = of_kernels(&chain, vec![elimination(&chain)]);
        kernels.iter().map(|kernel| kernel_body(&chain, kernel, &prepared).counts.total()).sum()
    };
    Passes::EACH.iter().filter(|passes| !passes.factor).map(after).collect()
}

/// Function, and its operations before and after common factors are taken out, where they differ.
pub(super) fn factoring(kind: &'static Kind, after: &[CountText]) -> Vec<(String, usize, usize)> {
    let before = counted(kind, Passes::CHAIN).into_iter().zip(after);
    let told = before.map(|((function, before), after)| (function, before, after.total));
    told.filter(|(_, before, after)| before != after).collect()
}

/// The functions of a kind after these passes, in the order of the emitted file, and their
/// operations.
fn counted(kind: &'static Kind, passes: Passes) -> Vec<(String, usize)> {
    let graph = Graph::new();
    let chain = Chain::after(&graph, kind, passes);
    let Functions { prepared, kernels } = functions(&chain);
    let counted = |kernel: &Kernel<'_>| {
        (kernel.name.clone(), kernel_body(&chain, kernel, &prepared).counts.total())
    };
    let first = ("prepare".to_owned(), prepare_body(&chain, &prepared).counts.total());
    std::iter::once(first).chain(kernels.iter().map(counted)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kinds::KINDS;

    /// The page on the architecture names them, and says what they are for.
    #[test]
    #[ignore = "long: `cargo xtask test --all`"]
    fn functions_without_an_operation_are_those_that_only_return_constants() {
        let none = |kind: &'static Kind| {
            let functions = counted(kind, Passes::ALL).into_iter();
            functions.filter(|(_, operations)| *operations == 0).map(|(function, _)| function)
        };
        for kind in KINDS {
            let expected: &[&str] = match kind.name {
                "balanced_reaction_wheel" => &["wheel", "first_moment", "constant_share", "axes"],
                _ => &["constant_share"],
            };
            assert_eq!(none(kind).collect::<Vec<_>>(), expected, "{}", kind.name);
        }
    }

    /// `load_derivatives` reads the constants that the other functions have, and factored they have others.
    fn more_after_factoring(kind: &str, function: &str) -> usize {
        match (kind, function) {
            ("balanced_dgvscmg", "load_derivatives") => 1,
            ("balanced_vscmg" | "balanced_sgcmg", "load_derivatives") => 11,
            _ => 0,
        }
    }

    #[test]
    #[ignore = "long: `cargo xtask test --all`"]
    fn no_function_with_a_state_costs_more_after_factoring() {
        for kind in KINDS {
            let [before, after] = [Passes::CHAIN, Passes::ALL].map(|passes| counted(kind, passes));
            assert!(before.len() > 10, "{} has {} functions", kind.name, before.len());
            assert_eq!(before.len(), after.len());
            // `prepare` may: it computes what the others do not compute any more. So may `steer`, which is not hoisted.
            for ((function, before), (_, after)) in
                before.into_iter().zip(after).skip(1).filter(|((name, _), _)| name != "steer")
            {
                let more = more_after_factoring(kind.name, &function);
                assert!(after <= before + more, "{} {function}: {before} -> {after}", kind.name);
            }
        }
    }
}
