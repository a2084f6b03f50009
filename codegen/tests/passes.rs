//! The passes change what is computed and in which order, and nothing else: with none, with each and
//! with all, what is emitted is proven by the same claims.

use precess_codegen::derivation::chain::Chain;
use precess_codegen::derivation::chain::passes::Passes;
use precess_codegen::emit::{TargetCrate, of_kind};
use precess_codegen::graph::Graph;
use precess_codegen::kinds::{
    BALANCED_VSCMG, DGVSCMG, HINGED_PANEL, Kind, REACTION_WHEEL, SLOSH_MASS, VSCMG,
};
use precess_codegen::proof::prove_kind;

/// A kind after some passes: its proofs hold.
fn holds(kind: &'static Kind, passes: Passes) {
    let graph = Graph::new();
    let chain = Chain::after(&graph, kind, passes);
    let emitted = of_kind(&chain, TargetCrate::Dynamics).unwrap();
    let rows = prove_kind(&chain, &emitted.files).unwrap();
    assert!(rows.len() > 50, "{} has {} rows", kind.name, rows.len());
    if let Some(row) = rows.iter().find(|row| !row.holds()) {
        panic!("{} after {passes:?}: {row}", kind.name);
    }
}

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn a_long_chain_is_proven_after_each_pass() {
    for kind in [&VSCMG, &BALANCED_VSCMG, &DGVSCMG] {
        for passes in Passes::EACH {
            holds(kind, passes);
        }
    }
}

#[test]
fn short_chains_are_proven_after_each_pass() {
    for kind in [&REACTION_WHEEL, &HINGED_PANEL, &SLOSH_MASS] {
        for passes in Passes::EACH {
            holds(kind, passes);
        }
    }
}
