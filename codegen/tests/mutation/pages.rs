//! Mutants of the equations themselves: of the hand-checked blocks as written, and of both normal
//! forms, term by term.

use precess_codegen::derivation::chain::Chain;
use precess_codegen::derivation::quantities::quantities;
use precess_codegen::graph::{Expr, Graph, Rational};
use precess_codegen::kinds::DGVSCMG;
use precess_codegen::normal::{Difference, Polynomial, Ring, Term};
use precess_codegen::page::{Equation, in_the_case, read, read_on};
use precess_codegen::proof::{Comparison, Verdict, against_block, against_pages};
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

/// Components of up to this many terms are tried term by term; the work grows with the square.
const SHORT: usize = 150;

/// Drops and flips each term of each component of each equation on one side; the difference must
/// be that term and nothing else.
#[test]
#[ignore = "long: `cargo xtask test --all --for codegen`"]
fn every_term_of_either_normal_form_is_named_when_it_is_wrong() {
    let graph = Graph::new();
    let _symbols = Chain::new(&graph, &DGVSCMG);
    let mut ring = Ring::new(&graph);
    let mut terms = 0;
    for equation in read(&graph, &hand_checked()).unwrap() {
        for (_, component) in &equation.components {
            let right = ring.normal(*component).unwrap();
            // A short component is tried whole; of a long one, every so many terms.
            for (monomial, coefficient) in right.terms().step_by(1 + right.len() / SHORT) {
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
#[ignore = "long: `cargo xtask test --all --for codegen`"]
fn every_term_of_a_page_as_written_is_named_when_it_is_wrong() {
    let graph = Graph::new();
    let chain = Chain::new(&graph, &DGVSCMG);
    let list = quantities(&chain);
    let mut ring = Ring::new(&graph);
    let (equations, reader) = read_on(&graph, &hand_checked()).unwrap();
    assert!(against_pages(&mut ring, &chain, &list, &equations).iter().all(Comparison::holds));
    ring.settle();
    let mut mutants = 0;
    for original in equations.iter().filter(|equation| is_root(equation)) {
        let block: syn::Block = syn::parse_str(&format!("{{{}}}", original.block.body)).unwrap();
        for (statement, sites) in block.stmts.iter().map(sites_of).enumerate() {
            for (site, change) in (0..sites).flat_map(|s| [(s, Change::Drop), (s, Change::Flip)]) {
                let body = mutated(&block, statement, site, change);
                let value = reader.body(&body).unwrap();
                let components = reader.resolve(&original.block, value).unwrap();
                let given = &original.block.given;
                let components = in_the_case(&graph, given, components).unwrap();
                // What is zero in a special case can be dropped there.
                if !given.is_empty() && same(&mut ring, &components, &original.components) {
                    continue;
                }
                let mutant = Equation { block: original.block.clone(), components };
                let row = against_block(&mut ring, &chain, &list, &mutant);
                assert_named(&mut ring, &row, original, &mutant, &body);
                ring.settle();
                mutants += 1;
            }
        }
    }
    assert!(mutants > 1500, "only {mutants} mutants were tried");
}

pub(crate) fn same<'g>(
    ring: &mut Ring<'g>,
    a: &[(String, Expr<'g>)],
    b: &[(String, Expr<'g>)],
) -> bool {
    a.iter().zip(b).all(|((_, a), (_, b))| ring.normal(*a) == ring.normal(*b))
}

/// Equations that state a result; a definition is a name and proven like any other.
fn is_root(equation: &Equation<'_>) -> bool {
    equation.block.tag != "(definition)"
}

pub(crate) fn sites_of(statement: &syn::Stmt) -> usize {
    match statement {
        syn::Stmt::Local(local) => local.init.as_ref().map_or(0, |init| count(&init.expr)),
        syn::Stmt::Expr(expr, None) => count(expr),
        _ => 0,
    }
}

pub(crate) fn mutated(block: &syn::Block, statement: usize, site: usize, change: Change) -> String {
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

pub(crate) fn assert_named<'g>(
    ring: &mut Ring<'g>,
    row: &Comparison,
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
