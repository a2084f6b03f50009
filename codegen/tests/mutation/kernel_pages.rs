//! Mutants of our own equations: of the blocks on which the fast kernels rest, as written.

use precess_codegen::derivation::chain::Chain;
use precess_codegen::graph::Graph;
use precess_codegen::kinds::DGVSCMG;
use precess_codegen::normal::Ring;
use precess_codegen::page::Page;
use precess_codegen::proof::{Comparison, KernelPages, Verdict};

use crate::pages::{assert_named, mutated, same, sites_of};
use crate::sites::Change;
use crate::{folder, hand_checked};

fn composites<'a, 'g>(chain: &'a Chain<'g>, pages: &[Page]) -> KernelPages<'a, 'g> {
    KernelPages::composites(chain, &hand_checked(), pages).unwrap()
}

fn elimination<'a, 'g>(chain: &'a Chain<'g>) -> KernelPages<'a, 'g> {
    KernelPages::elimination(chain, &folder::pages("kernels/elimination")).unwrap()
}

#[test]
fn every_equation_of_our_own_is_proven() {
    let graph = Graph::new();
    let chain = Chain::new(&graph, &DGVSCMG);
    let mut rows = composites(&chain, &folder::pages("kernels")).rows();
    rows.extend(elimination(&chain).rows());
    for number in 1..=13 {
        let tag = format!("(D{number})");
        assert!(rows.iter().any(|row| row.tag == tag), "{tag} has no row");
    }
    for row in rows {
        assert!(row.holds(), "{row}");
    }
}

#[test]
fn a_value_of_a_kernel_without_a_block_is_named() {
    let graph = Graph::new();
    let chain = Chain::new(&graph, &DGVSCMG);
    let mut pages = folder::pages("kernels");
    pages.retain(|page| page.name != "03-joint-rows.md" && page.name != "04-by-the-paper.md");
    let rows = composites(&chain, &pages).rows();
    let missing = |name: &str| {
        let absent = |row: &&Comparison| row.tag == "(missing)" && row.verdict == Verdict::Absent;
        rows.iter().filter(absent).any(|row| row.name == name)
    };
    assert!(missing("field_w") && missing("n_rates_i_gox") && missing("u_rest_o"));
}

/// Drops and flips each operand of each sum of each block as written. The row must fail, and the
/// terms it names must be exactly what the operand contributed.
#[test]
fn every_term_of_our_own_equations_is_named_when_it_is_wrong() {
    let graph = Graph::new();
    let chain = Chain::new(&graph, &DGVSCMG);
    let groups = [composites(&chain, &folder::pages("kernels")), elimination(&chain)];
    let (mut mutants, mut equivalent) = (0, 0);
    for group in &groups {
        let mut page = String::new();
        let mut ring = Ring::new(&graph);
        for original in group.equations() {
            if page != original.block.page {
                page.clone_from(&original.block.page);
                ring = Ring::new(&graph);
                ring.settle();
            }
            let block: syn::Block =
                syn::parse_str(&format!("{{{}}}", original.block.body)).unwrap();
            for (statement, sites) in block.stmts.iter().map(sites_of).enumerate() {
                let changes = [Change::Drop, Change::Flip];
                for (site, change) in (0..sites).flat_map(|s| changes.map(|change| (s, change))) {
                    let body = mutated(&block, statement, site, change);
                    let mutant = group.restated(&original.block, &body).unwrap();
                    // What is regrouped has no part in what is kept, an arm may have no component that
                    // counts, and what is zero in a special case can be dropped there.
                    if same(&mut ring, &mutant.components, &original.components) {
                        equivalent += 1;
                        continue;
                    }
                    let row = group.row(&mut ring, &mutant);
                    assert_named(&mut ring, &row, original, &mutant, &body);
                    mutants += 1;
                }
            }
            ring.settle();
        }
    }
    assert!(
        mutants > 400 && mutants > 4 * equivalent,
        "{mutants} mutants, {equivalent} equivalent"
    );
}
