//! Mutants of the emitted text: every operand of every sum of every statement.

use std::sync::LazyLock;

use precess_codegen::derivation::chain::Chain;
use precess_codegen::emit::{TargetCrate, of_kind};
use precess_codegen::graph::Graph;
use precess_codegen::kinds::DGVSCMG;
use precess_codegen::proof::{Comparison, EmittedError, Prover, Verdict};

use crate::sites::{Change, changed, count};

/// Every function of the file but `load_derivatives`.
const ALL: [&str; 14] = [
    "prepare",
    "constant_share",
    "outer_gimbal",
    "inner_gimbal",
    "wheel",
    "first_moment",
    "eliminate",
    "back_substitute",
    "energy_momentum",
    "axes",
    "loads",
    "steer",
    "external",
    "gravity",
];

/// The kernels of the DGVSCMG, emitted once for all tests.
static TEXT: LazyLock<String> = LazyLock::new(|| {
    let graph = Graph::new();
    let emitted = of_kind(&Chain::new(&graph, &DGVSCMG), TargetCrate::Dynamics).unwrap();
    emitted.files.into_iter().find(|file| file.path.ends_with("/dgvscmg.rs")).unwrap().text
});

fn emitted() -> syn::File {
    syn::parse_file(&TEXT).unwrap()
}

fn function<'a>(file: &'a mut syn::File, name: &str) -> &'a mut syn::ItemFn {
    let found = file.items.iter_mut().find_map(|item| match item {
        syn::Item::Fn(function) if function.sig.ident == name => Some(function),
        _ => None,
    });
    found.unwrap()
}

/// The value of statement `index` of `name`, where it is a `let`.
fn value<'a>(file: &'a mut syn::File, name: &str, index: usize) -> Option<&'a mut syn::Expr> {
    match &mut function(file, name).block.stmts[index] {
        syn::Stmt::Local(local) => local.init.as_mut().map(|init| &mut *init.expr),
        _ => None,
    }
}

/// Drops and flips every operand of every sum of `name`; each mutant must fail a row of the
/// functions in `judged`, which are tried in turn until one names it. Returns the number of mutants
/// and of those that a claim named.
fn every_mutant_is_caught(name: &str, judged: &[&str]) -> (usize, usize) {
    let (mutants, named, survivors) = mutants_are_caught(name, judged, 1);
    assert_eq!(survivors, 0, "of {mutants} mutants of {name}");
    (mutants, named)
}

/// The same of every so many statements; also how many survive.
fn mutants_are_caught(name: &str, judged: &[&str], every: usize) -> (usize, usize, usize) {
    let graph = Graph::new();
    let chain = Chain::new(&graph, &DGVSCMG);
    let mut prover = Prover::new(&chain);
    let mut file = emitted();
    for name in judged {
        assert!(prover.function(&file, name).unwrap().iter().all(Comparison::holds));
    }
    let (mut mutants, mut named, mut survivors) = (0, 0, 0);
    for index in (0..function(&mut file, name).block.stmts.len()).step_by(every) {
        let Some(original) = value(&mut file, name, index).cloned() else { continue };
        for site in 0..count(&original) {
            for change in [Change::Drop, Change::Flip] {
                *value(&mut file, name, index).unwrap() = changed(&original, site, change);
                mutants += 1;
                if judged.iter().any(|name| is_found(&mut prover, &file, name, differs)) {
                    named += 1;
                } else if !judged.iter().any(|name| is_found(&mut prover, &file, name, fails)) {
                    println!("{change:?} at {site} of statement {index} survives");
                    survivors += 1;
                }
            }
        }
        *value(&mut file, name, index).unwrap() = original;
    }
    (mutants, named, survivors)
}

/// Whether a row of a function is sought.
fn is_found(
    prover: &mut Prover<'_, '_>,
    file: &syn::File,
    name: &str,
    sought: fn(&Comparison) -> bool,
) -> bool {
    prover.until(file, name, sought).unwrap().iter().any(sought)
}

fn fails(row: &Comparison) -> bool {
    !row.holds()
}

/// Whether a row names terms that differ.
fn differs(row: &Comparison) -> bool {
    matches!(row.verdict, Verdict::Differs(_))
}

#[test]
#[ignore = "long: `cargo xtask test --all --for codegen`"]
fn every_mutant_of_the_kinematics_is_named() {
    for name in ["outer_gimbal", "inner_gimbal", "wheel", "first_moment"] {
        let (mutants, named) = every_mutant_is_caught(name, &[name]);
        assert!(mutants > 50 && named == mutants, "{name}: {named} of {mutants}");
    }
}

#[test]
#[ignore = "long: `cargo xtask test --all --for codegen`"]
fn every_mutant_of_the_elimination_is_named() {
    // What only another mount than none shows is judged with the constant share of the hub.
    for (name, judged, least) in [
        ("eliminate", &["eliminate", "constant_share"][..], 1200),
        ("back_substitute", &["back_substitute"], 60),
    ] {
        let (mutants, named) = every_mutant_is_caught(name, judged);
        assert!(mutants > least && named == mutants, "{name}: {named} of {mutants}");
    }
}

#[test]
#[ignore = "long: `cargo xtask test --all --for codegen`"]
fn every_mutant_of_energy_and_momentum_is_named() {
    let (mutants, named) = every_mutant_is_caught("energy_momentum", &["energy_momentum"]);
    assert!(mutants > 500 && named == mutants, "{named} of {mutants}");
}

#[test]
#[ignore = "long: `cargo xtask test --all --for codegen`"]
fn every_mutant_beside_the_equations_of_motion_is_named() {
    for (name, least) in
        [("axes", 20), ("loads", 800), ("steer", 800), ("external", 120), ("gravity", 800)]
    {
        let (mutants, named) = every_mutant_is_caught(name, &[name]);
        assert!(mutants > least && named == mutants, "{name}: {named} of {mutants}");
    }
}

/// All of its mutants are put to the laws of physics by `cargo xtask mutate`. Every result is claimed, so that a mutant
/// which fails no claim is the same function: terms that cancel, 2 of 3664.
#[test]
#[ignore = "long: `cargo xtask test --all --for codegen`"]
fn a_sample_of_statements_of_the_derivatives_is_named() {
    let (mutants, named, same) = mutants_are_caught("load_derivatives", &["load_derivatives"], 120);
    assert!(mutants > 15 && named + same == mutants, "{named} and {same} of {mutants}");
    assert!(10 * same <= mutants, "{same} of {mutants}");
}

#[test]
#[ignore = "long: `cargo xtask test --all --for codegen`"]
fn every_mutant_of_prepare_is_named() {
    let (mutants, named) = every_mutant_is_caught("prepare", &ALL[1..]);
    assert!(mutants > 100 && named == mutants, "{named} of {mutants}");
}

/// Every statement doubled: products have no operand to drop, but a wrong factor is caught too.
#[test]
#[ignore = "long: `cargo xtask test --all --for codegen`"]
fn every_doubled_statement_is_caught() {
    let graph = Graph::new();
    let chain = Chain::new(&graph, &DGVSCMG);
    let mut prover = Prover::new(&chain);
    let mut file = emitted();
    for name in &ALL {
        assert!(prover.function(&file, name).unwrap().iter().all(Comparison::holds));
    }
    for name in &ALL {
        for index in 0..function(&mut file, name).block.stmts.len() {
            let Some(original) = value(&mut file, name, index).cloned() else { continue };
            // Nothing doubled is nothing.
            if quote::quote!(#original).to_string().ends_with("like (0.0)") {
                continue;
            }
            let doubled = syn::parse_quote!(#original + (#original));
            *value(&mut file, name, index).unwrap() = doubled;
            assert!(
                is_caught(&mut prover, &file, name),
                "statement {index} of {name} doubled survives"
            );
            *value(&mut file, name, index).unwrap() = original;
        }
    }
}

/// Whether a row that the function is judged by does not hold.
fn is_caught(prover: &mut Prover<'_, '_>, file: &syn::File, name: &&str) -> bool {
    let judged = match *name {
        "prepare" => &ALL[..],
        "eliminate" | "constant_share" => &["eliminate", "constant_share"],
        _ => std::slice::from_ref(name),
    };
    judged.iter().any(|judge| is_found(prover, file, judge, fails))
}

/// The results of a function: the value of each field of what it returns, nested records in line.
fn results<'a>(file: &'a mut syn::File, name: &str) -> Vec<&'a mut syn::Expr> {
    match function(file, name).block.stmts.last_mut() {
        Some(syn::Stmt::Expr(literal, None)) => values(literal),
        _ => panic!("`{name}` returns nothing"),
    }
}

fn values(value: &mut syn::Expr) -> Vec<&mut syn::Expr> {
    match value {
        syn::Expr::Struct(record) => {
            record.fields.iter_mut().flat_map(|field| values(&mut field.expr)).collect()
        }
        value => vec![value],
    }
}

/// Every result doubled where it is returned, and what is zero replaced by another result.
#[test]
#[ignore = "long: `cargo xtask test --all --for codegen`"]
fn every_wrong_result_is_caught() {
    let graph = Graph::new();
    let chain = Chain::new(&graph, &DGVSCMG);
    let mut prover = Prover::new(&chain);
    let mut file = emitted();
    let mut zeros = 0;
    for name in &ALL {
        let originals: Vec<_> =
            results(&mut file, name).into_iter().map(|value| value.clone()).collect();
        let is_zero = |value: &syn::Expr| quote::quote!(#value).to_string() == "zero";
        let other =
            originals.iter().find(|value| !is_zero(value)).expect("a result that is not zero");
        for (index, original) in originals.iter().enumerate() {
            zeros += usize::from(is_zero(original));
            let wrong = if is_zero(original) {
                other.clone()
            } else {
                syn::parse_quote!(#original + #original)
            };
            *results(&mut file, name)[index] = wrong;
            assert!(is_caught(&mut prover, &file, name), "result {index} of {name} wrong survives");
            *results(&mut file, name)[index] = original.clone();
        }
    }
    assert!(zeros > 10, "{zeros} results are zero");
}

/// The proof of a text in which `right` is replaced by `wrong`.
fn with(right: &str, wrong: &str) -> Result<Vec<Comparison>, EmittedError> {
    let graph = Graph::new();
    let chain = Chain::new(&graph, &DGVSCMG);
    assert!(TEXT.contains(right), "{right}");
    let rows = Prover::new(&chain).rows(&TEXT.replace(right, wrong))?;
    Ok(rows.into_iter().filter(|row| !row.holds()).collect())
}

#[test]
#[ignore = "long: `cargo xtask test --all --for codegen`"]
fn a_wrong_constant_returned_value_or_pivot_is_caught() {
    for (right, wrong) in [
        ("let mass_ww = p.j_11 + base_30;", "let mass_ww = p.j_11 + base_29;"),
        ("pivot_w: p.mass_ww,", "pivot_w: mass_iw,"),
        ("diagonal_i: mass_ii,", "diagonal_i: mass_iw,"),
        ("pivot_i: mass_ii_w,", "pivot_i: mass_ii,"),
        (
            "            h_v_1,\n            h_v_2,",
            "            h_v_1: h_v_2,\n            h_v_2: h_v_1,",
        ),
        ("let m_vw_12 = n_w_by * gain_w_v1", "let m_vw_12 = (-n_w_by) * gain_w_v1"),
        ("mount_12: p.mount_12,", "mount_12: p.mount_21,"),
        ("a.r_b_n_ddot_bx * e.gain_o_v1", "a.omega_dot_bx * e.gain_o_v1"),
    ] {
        assert!(!with(right, wrong).unwrap().is_empty(), "{wrong}");
    }
}

#[test]
fn text_that_says_a_thing_twice_or_from_nowhere_is_refused() {
    for (right, wrong) in [
        (
            "let tau_o = u.u_o - u_rest_o;",
            "let tau_o = u.u_o + u_rest_o; let tau_o = u.u_o - u_rest_o;",
        ),
        ("let tau_o = u.u_o - u_rest_o;", "#[cfg(any())] let tau_o = u.u_o - u_rest_o;"),
        ("let tau_o = u.u_o - u_rest_o;", "let tau_o = v.u_o - u_rest_o;"),
        ("let tau_o = u.u_o - u_rest_o;", "let tau_o = u_o - u_rest_o;"),
        ("    Eliminated {\n", "    if true {}\n    Eliminated {\n"),
    ] {
        assert!(with(right, wrong).is_err(), "{wrong}");
    }
}
