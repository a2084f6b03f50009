//! Mutants of the equations themselves: of the hand-checked blocks as written, and of both normal
//! forms, term by term.

use precess_codegen::derivation::chain::Chain;
use precess_codegen::derivation::quantities::quantities;
use precess_codegen::graph::{Graph, Rational};
use precess_codegen::kinds::DGVSCMG;
use precess_codegen::normal::{Difference, Polynomial, Ring, Term};
use precess_codegen::page::{Equation, Page, read};
use precess_codegen::proof::{Row, Verdict, against_pages};
use quote::ToTokens;

use crate::hand_checked;
use crate::sites::{Change, changed, count};

/// The equations that the product promises, by the paper's numbers.
const PROMISED: [&str; 21] = [
    "(9)",
    "(10)",
    "(11)",
    "(12)",
    "(13)",
    "(14)",
    "(15)",
    "(17)",
    "(29)",
    "(31)",
    "(36)",
    "(40)",
    "(42)",
    "(44)",
    "(49)-(52)",
    "(55)",
    "(57)",
    "(59)",
    "(64)",
    "(71)",
    "(73)",
];

#[test]
fn every_promised_equation_is_proven() {
    let graph = Graph::new();
    let chain = Chain::new(&graph, &DGVSCMG);
    let equations = read(&graph, &hand_checked()).unwrap();
    let rows = against_pages(&mut Ring::new(&graph), &chain, &quantities(&chain), &equations);
    for tag in PROMISED {
        assert!(rows.iter().any(|row| row.tag == tag), "{tag} has no row");
    }
    for row in rows {
        assert!(row.holds(), "{row}");
    }
}

#[test]
fn a_quantity_without_a_block_is_named() {
    let graph = Graph::new();
    let chain = Chain::new(&graph, &DGVSCMG);
    let mut equations = read(&graph, &hand_checked()).unwrap();
    equations.retain(|equation| equation.block.name != "f_i");
    let rows = against_pages(&mut Ring::new(&graph), &chain, &quantities(&chain), &equations);
    let failed: Vec<_> = rows.iter().filter(|row| !row.holds()).collect();
    assert_eq!(failed.len(), 1);
    assert_eq!((failed[0].name.as_str(), &failed[0].verdict), ("f_i", &Verdict::Absent));
}

/// Drops and flips each term of each component of each equation on one side; the difference must
/// be that term and nothing else.
#[test]
fn every_term_of_either_normal_form_is_named_when_it_is_wrong() {
    let graph = Graph::new();
    let _symbols = Chain::new(&graph, &DGVSCMG);
    let mut ring = Ring::new(&graph);
    let mut terms = 0;
    for equation in read(&graph, &hand_checked()).unwrap() {
        for (_, component) in &equation.components {
            let right = ring.normal(*component).unwrap();
            for (monomial, coefficient) in right.terms() {
                terms += 1;
                let term = Polynomial::single(*monomial, *coefficient);
                let shown = ring.show(monomial, *coefficient);
                let dropped = right.plus(-Rational::ONE, &term).unwrap();
                let flipped = right.plus(Rational::from(-2), &term).unwrap();
                let opposite = ring.show(monomial, -coefficient);
                let named = |a: &Polynomial, b: &Polynomial| Difference::between(&ring, a, b).terms;
                assert_eq!(named(&dropped, &right), [Term::Missing(shown.clone())]);
                assert_eq!(named(&right, &dropped), [Term::Extra(shown.clone())]);
                assert_eq!(named(&flipped, &right), [Term::Sign(shown)]);
                assert_eq!(named(&right, &flipped), [Term::Sign(opposite)]);
            }
        }
    }
    assert!(terms > 3000, "only {terms} terms were tried");
}

/// Drops and flips each operand of each sum of each block as written. The row must fail, and the
/// terms it names must be exactly what the operand contributed.
#[test]
fn every_term_of_a_page_as_written_is_named_when_it_is_wrong() {
    let graph = Graph::new();
    let chain = Chain::new(&graph, &DGVSCMG);
    let list = quantities(&chain);
    let mut ring = Ring::new(&graph);
    let pages = hand_checked();
    let equations = read(&graph, &pages).unwrap();
    let mut mutants = 0;
    for original in equations.iter().filter(|equation| is_root(equation)) {
        let block: syn::Block = syn::parse_str(&format!("{{{}}}", original.block.body)).unwrap();
        for (statement, sites) in block.stmts.iter().map(sites_of).enumerate() {
            for (site, change) in (0..sites).flat_map(|s| [(s, Change::Drop), (s, Change::Flip)]) {
                let body = mutated(&block, statement, site, change);
                let equation = reread(&graph, &pages, original, &body);
                let rows = against_pages(&mut ring, &chain, &list, std::slice::from_ref(&equation));
                let row = rows.iter().find(|row| row.name == original.block.name).unwrap();
                assert_named(&mut ring, row, original, &equation, &body);
                mutants += 1;
            }
        }
    }
    assert!(mutants > 500, "only {mutants} mutants were tried");
}

/// Equations that state a result; a definition is a name and proven like any other.
fn is_root(equation: &Equation<'_>) -> bool {
    equation.block.tag != "(definition)"
}

fn sites_of(statement: &syn::Stmt) -> usize {
    match statement {
        syn::Stmt::Local(local) => local.init.as_ref().map_or(0, |init| count(&init.expr)),
        syn::Stmt::Expr(expr, None) => count(expr),
        _ => 0,
    }
}

fn mutated(block: &syn::Block, statement: usize, site: usize, change: Change) -> String {
    let mut statements = block.stmts.clone();
    match &mut statements[statement] {
        syn::Stmt::Local(local) => {
            let init = local.init.as_mut().expect("a let has a value");
            *init.expr = changed(&init.expr, site, change);
        }
        syn::Stmt::Expr(expr, None) => *expr = changed(expr, site, change),
        _ => unreachable!("pages hold lets and one expression"),
    }
    statements.iter().map(|s| s.to_token_stream().to_string() + "\n").collect()
}

/// The equation as the page would state it with another body.
fn reread<'g>(
    graph: &'g Graph,
    pages: &[Page],
    original: &Equation<'_>,
    body: &str,
) -> Equation<'g> {
    let mut pages = pages.to_vec();
    let page = pages.iter_mut().find(|page| page.name == original.block.page).unwrap();
    assert!(page.text.contains(&original.block.body));
    let heading = page.text.lines().nth(original.block.line).unwrap().to_owned();
    let old = format!("{heading}\n{}\n", original.block.body);
    page.text = page.text.replace(&old, &format!("{heading}\n{body}"));
    let equations = read(graph, &pages).unwrap();
    equations.into_iter().find(|equation| equation.block.name == original.block.name).unwrap()
}

fn assert_named<'g>(
    ring: &mut Ring<'g>,
    row: &Row,
    original: &Equation<'g>,
    mutant: &Equation<'g>,
    body: &str,
) {
    let mut expected = Vec::new();
    for ((label, right), (_, wrong)) in original.components.iter().zip(&mutant.components) {
        let (right, wrong) = (ring.normal(*right).unwrap(), ring.normal(*wrong).unwrap());
        let terms = Difference::between(ring, &right, &wrong).terms;
        expected.extend(terms.into_iter().map(|term| (label.clone(), term)));
    }
    assert!(!expected.is_empty(), "{}: no effect of\n{body}", original.block.name);
    assert_eq!(row.verdict, Verdict::Differs(expected), "{}:\n{body}", original.block.name);
}
