//! Each sign and each factor of the emitted kernels made wrong, in turn: a claim must fail.
//!
//! The claims are about normal forms, so one mutant in a place is enough: whatever the numbers, a
//! statement that means something else is seen.

use std::collections::BTreeSet;

use precess_codegen::derivation::chain::Chain;
use precess_codegen::derivation::chain::assumed::{Assumed, Exchange, Mount, Turns};
use precess_codegen::emit::{EmittedFile, standalone_kernels};
use precess_codegen::graph::Graph;
use precess_codegen::kinds::{DGVSCMG, Kind, Link};
use precess_codegen::proof::prove_assumed;
use precess_codegen::threads::side_by_side;

/// Both gimbals locked.
const LINKS: [Link; 3] = [DGVSCMG.links[0].locked(), DGVSCMG.links[1].locked(), DGVSCMG.links[2]];
/// The kind that is left.
const KIND: Kind = Kind { name: "cmg", links: &LINKS, ..DGVSCMG };

/// The device of the imaging satellite: gimbals locked, axes that meet in a point, two turns.
fn device() -> (&'static Kind, Assumed) {
    let zero = "l_o_x l_o_y l_o_z l_i_x l_i_y l_i_z r_goc_go_gox r_goc_go_goy r_goc_go_goz \
                r_gic_gi_gix r_gic_gi_giy r_gic_gi_giz i_go_12 i_go_13 i_go_23 i_gi_12 i_gi_13 \
                i_gi_23 j_23 r_go_b_by";
    let zero: BTreeSet<_> = zero.split_whitespace().map(str::to_owned).collect();
    let equal = [("j_33".to_owned(), "j_22".to_owned())].into();
    let none = Exchange::NONE;
    let mount = Mount::Turned { outer: none, turns: Turns::Two, inner: none };
    (&KIND, Assumed { zero, equal, mount })
}

/// Texts with one operator changed, in the functions of an evaluation.
fn mutants(text: &str) -> Vec<String> {
    let start = text.find("pub fn prepare").unwrap();
    let operators = [(" + ", " - "), (" - ", " + ")];
    let mut list = Vec::new();
    for (own, other) in operators {
        let places = text.match_indices(own).map(|(place, _)| place).filter(|place| *place > start);
        for place in places {
            let line = text[..place].rfind('\n').map_or(0, |k| k + 1);
            if text[line..].trim_start().starts_with("let ") {
                list.push(format!("{}{other}{}", &text[..place], &text[place + own.len()..]));
            }
        }
    }
    // A product with another factor: one of its own is squared.
    for (place, _) in text.match_indices(" * p.").filter(|(place, _)| *place > start) {
        let line = text[..place].rfind('\n').map_or(0, |k| k + 1);
        if text[line..].trim_start().starts_with("let ") {
            let end = place
                + 5
                + text[place + 5..].find(|c: char| !c.is_alphanumeric() && c != '_').unwrap();
            let factor = &text[place..end];
            list.push(format!("{}{factor}{}", &text[..end], &text[end..]));
        }
    }
    list
}

#[test]
fn every_mutant_fails_a_claim() {
    let (kind, assumed) = device();
    let emitted = {
        let graph = Graph::new();
        standalone_kernels(&Chain::assuming(&graph, kind, assumed.clone()), "precess bake").unwrap()
    };
    let text = &emitted.file.text;
    let holds = |text: String| {
        let graph = Graph::new();
        let chain = Chain::assuming(&graph, kind, assumed.clone());
        let file = EmittedFile { path: emitted.file.path.clone(), text };
        prove_assumed(&chain, &DGVSCMG, &[file])
            .is_ok_and(|rows| rows.iter().all(precess_codegen::proof::Comparison::holds))
    };
    assert!(holds(text.clone()), "the text itself is not proven");
    let mutants = mutants(text);
    assert!(mutants.len() > 200, "only {} mutants", mutants.len());
    let threads = std::thread::available_parallelism().map_or(1, Into::into);
    let shares = mutants.chunks(mutants.len().div_ceil(threads));
    let alive = side_by_side(shares, |share| {
        share.iter().filter(|mutant| holds((*mutant).clone())).cloned().collect::<Vec<_>>()
    });
    let alive = alive.concat();
    let changed = |mutant: &String| {
        let lines = mutant.lines().zip(text.lines()).find(|(a, b)| a != b);
        lines.map(|(a, _)| a.trim().to_owned()).unwrap_or_default()
    };
    assert!(alive.is_empty(), "not seen: {:#?}", alive.iter().map(changed).collect::<Vec<_>>());
}
