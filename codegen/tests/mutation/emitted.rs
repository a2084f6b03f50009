//! Mutants of the emitted text: every operand of every sum of every statement.

use precess_codegen::derivation::chain::Chain;
use precess_codegen::graph::Graph;
use precess_codegen::kinds::DGVSCMG;
use precess_codegen::proof::{Prover, Row, Verdict};
use precess_codegen::regen::emit;

use crate::sites::{Change, changed, count};

fn emitted() -> syn::File {
    let files = emit().unwrap();
    let file = files.iter().find(|file| file.path.ends_with("/dgvscmg.rs")).unwrap();
    syn::parse_file(&file.text).unwrap()
}

fn function<'a>(file: &'a mut syn::File, name: &str) -> &'a mut syn::ItemFn {
    let found = file.items.iter_mut().find_map(|item| match item {
        syn::Item::Fn(function) if function.sig.ident == name => Some(function),
        _ => None,
    });
    found.unwrap()
}

/// Drops and flips every operand of every sum of `name`; each mutant must fail a row of the
/// functions in `judged`. Returns the number of mutants and of those that a claim named.
fn every_mutant_is_caught(name: &str, judged: &[&str]) -> (usize, usize) {
    let graph = Graph::new();
    let chain = Chain::new(&graph, &DGVSCMG);
    let mut prover = Prover::new(&chain);
    let original = emitted();
    let (mut mutants, mut named) = (0, 0);
    let statements = function(&mut original.clone(), name).block.stmts.clone();
    for (index, statement) in statements.iter().enumerate() {
        let syn::Stmt::Local(local) = statement else { continue };
        let value = &local.init.as_ref().unwrap().expr;
        for site in 0..count(value) {
            for change in [Change::Drop, Change::Flip] {
                let mut file = original.clone();
                let syn::Stmt::Local(local) = &mut function(&mut file, name).block.stmts[index]
                else {
                    unreachable!("statement {index} is a let")
                };
                let init = local.init.as_mut().unwrap();
                *init.expr = changed(&init.expr, site, change);
                let place = format!("{change:?} at {site} of statement {index} of {name}");
                let rows = judged.iter().flat_map(|name| prover.function(&file, name).unwrap());
                let failed: Vec<Row> = rows.filter(|row| !row.holds()).collect();
                assert!(!failed.is_empty(), "{place} survives");
                mutants += 1;
                named += usize::from(
                    failed.iter().any(|row| matches!(row.verdict, Verdict::Differs(_))),
                );
            }
        }
    }
    (mutants, named)
}

#[test]
fn every_mutant_of_the_kinematics_is_named() {
    for name in ["outer_gimbal", "inner_gimbal", "wheel", "first_moment"] {
        let (mutants, named) = every_mutant_is_caught(name, &[name]);
        assert!(mutants > 50 && named == mutants, "{name}: {named} of {mutants}");
    }
}

#[test]
fn every_mutant_of_the_elimination_is_named() {
    for (name, least) in [("eliminate", 1500), ("back_substitute", 60)] {
        let (mutants, named) = every_mutant_is_caught(name, &[name]);
        assert!(mutants > least && named == mutants, "{name}: {named} of {mutants}");
    }
}

#[test]
fn every_mutant_of_energy_and_momentum_is_named() {
    let (mutants, named) = every_mutant_is_caught("energy_momentum", &["energy_momentum"]);
    assert!(mutants > 500 && named == mutants, "{named} of {mutants}");
}

#[test]
fn every_mutant_of_prepare_is_named() {
    let judged =
        ["outer_gimbal", "inner_gimbal", "wheel", "first_moment", "eliminate", "energy_momentum"];
    let (mutants, named) = every_mutant_is_caught("prepare", &judged);
    assert!(mutants > 100 && named == mutants, "{named} of {mutants}");
}

#[test]
fn two_returned_values_that_change_places_are_caught() {
    let graph = Graph::new();
    let chain = Chain::new(&graph, &DGVSCMG);
    let mut prover = Prover::new(&chain);
    let files = emit().unwrap();
    let file = files.iter().find(|file| file.path.ends_with("/dgvscmg.rs")).unwrap();
    for (right, wrong) in [
        ("diagonal_w: mass_ww,", "diagonal_w: mass_iw,"),
        (
            "            h_v_1,\n            h_v_2,",
            "            h_v_1: h_v_2,\n            h_v_2: h_v_1,",
        ),
    ] {
        assert!(file.text.contains(right), "{right}");
        let rows = prover.rows(&file.text.replace(right, wrong)).unwrap();
        let failed: Vec<_> = rows.iter().filter(|row| !row.holds()).collect();
        assert_eq!(failed.len(), 1, "{wrong}");
        assert_eq!(failed[0].name, "Eliminated");
    }
}
