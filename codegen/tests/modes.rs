//! A joint's mode as data against a joint that is not there: with the acceleration of a joint given,
//! and zero, the emitted elimination is that of the kind which prescribes it, term by term.
//!
//! The blocks of the system stay symbols, so only the elimination is compared; that the
//! blocks are equal, too, is shown beside the other limits between kinds.

use std::collections::{BTreeMap, BTreeSet};

use precess_codegen::derivation::chain::Chain;
use precess_codegen::derivation::chain::parallel_axes::ParallelAxes;
use precess_codegen::graph::{Expr, Graph, Node, SymbolId};
use precess_codegen::kernel::kernels;
use precess_codegen::kinds::{
    BALANCED_DGCMG, BALANCED_DGVSCMG, BALANCED_SGCMG, BALANCED_VSCMG, DGCMG, DGVSCMG, Kind, SGCMG,
    VSCMG,
};
use precess_codegen::normal::Ring;

/// The terms of every number that `eliminate` returns, and of what each joint divides by, with the
/// joints of these tags at zero acceleration, and these symbols zero.
fn eliminated(
    kind: &'static Kind,
    given: &[&str],
    zero: &[&str],
) -> BTreeMap<String, BTreeSet<String>> {
    let graph = Graph::new();
    let chain = Chain::new(&graph, kind);
    let kernels = kernels(&chain);
    let kernel = kernels.iter().find(|kernel| kernel.name == "eliminate").unwrap();
    let blocks: BTreeSet<&str> = kernel
        .claims
        .iter()
        .flat_map(|claim| &claim.components)
        .map(|(name, _)| name.as_str())
        .collect();
    let mut values: Vec<(SymbolId, Expr<'_>)> = Vec::new();
    for tag in given {
        for (stem, value) in [("driven", 0), ("held", 1), ("given", 0)] {
            let symbol = graph.find(&format!("{stem}_{tag}")).unwrap();
            values.push((id(symbol), graph.constant(value)));
        }
    }
    values.extend(zero.iter().map(|name| (id(graph.find(name).unwrap()), graph.zero())));
    let mut named = BTreeMap::new();
    for statement in kernel.sections.iter().flat_map(|section| &section.statements) {
        let name = statement.name.as_str();
        if let Some(entry) = name.strip_prefix("across_") {
            // What is across the tip's axis, and along it, is an entry of the mass matrix.
            let ParallelAxes { cosine, .. } = ParallelAxes::of_chain(&chain).unwrap();
            let own = cosine * named["mass_ww"];
            let whole = graph.find(&format!("mass_{entry}")).unwrap();
            let across = statement.cut.unwrap_or(statement.value);
            if entry.ends_with('w') {
                values.push((id(whole), across + own));
            } else {
                values.push((id(across), whole - cosine * own));
            }
            named.insert(name.to_owned(), across);
            continue;
        }
        if blocks.contains(name) {
            // A block stands for itself, under its own name.
            let symbol = statement.cut.filter(|cut| *cut != statement.value);
            named.insert(name.to_owned(), symbol.unwrap_or(statement.value));
            continue;
        }
        let value = statement.value.with(&values);
        named.insert(name.to_owned(), value);
        let number = matches!(value.node(), Node::Constant(_));
        if let Some(symbol) = statement.cut.filter(|_| number || !name.starts_with("divisor_")) {
            values.push((id(symbol), value));
        }
    }
    let mut outputs = kernel.output.leaves();
    // A pivot that no outboard joint changes is the diagonal, and returned once.
    let pivots = outputs.iter().filter_map(|(field, source)| {
        let diagonal = field.replace("pivot_", "diagonal_");
        let other = outputs.iter().all(|(field, _)| *field != diagonal);
        other.then(|| (diagonal, source.clone()))
    });
    outputs.extend(pivots.collect::<Vec<_>>());
    let divisors = named.keys().filter(|name| name.starts_with("divisor_"));
    outputs.extend(divisors.map(|name| (name.clone(), name.clone())));
    let mut ring = Ring::new(&graph);
    let terms = outputs.into_iter().map(|(field, source)| {
        let normal = ring.normal(named[&source]).unwrap();
        let terms = normal.terms().map(|(monomial, k)| ring.show(monomial, *k)).collect();
        (field, terms)
    });
    terms.collect()
}

fn id(symbol: Expr<'_>) -> SymbolId {
    let Node::Symbol(id) = symbol.node() else { panic!("a symbol is a symbol") };
    id
}

/// What the narrow kind returns, the wide one does, with one joint given its acceleration and with
/// these symbols zero. Of what else the wide one returns, only that joint's pivot and diagonal are not
/// zero: it has no gain and no free acceleration.
#[track_caller]
fn assert_prescribed(wide: &'static Kind, tag: &str, zero: &[&str], narrow: &'static Kind) {
    let (wide, narrow) = (eliminated(wide, &[tag], zero), eliminated(narrow, &[], &[]));
    assert!(
        narrow.values().map(BTreeSet::len).sum::<usize>() > 50,
        "there is something to compare"
    );
    for (field, terms) in &narrow {
        assert_eq!(wide.get(field), Some(terms), "{field}");
    }
    let of_it = [format!("gain_{tag}_"), format!("free_{tag}")];
    for (field, terms) in wide.iter().filter(|(field, _)| !narrow.contains_key(*field)) {
        let moves = of_it.iter().any(|start| field.starts_with(start));
        let about_it = field.ends_with(&format!("_{tag}")) && !moves;
        assert_ne!(terms.is_empty(), about_it, "{field}: {terms:?}");
    }
}

#[test]
fn a_control_moment_gyro_is_its_variable_speed_twin_with_the_wheel_prescribed() {
    for (wide, narrow) in [
        (&VSCMG, &SGCMG),
        (&BALANCED_VSCMG, &BALANCED_SGCMG),
        (&DGVSCMG, &DGCMG),
        (&BALANCED_DGVSCMG, &BALANCED_DGCMG),
    ] {
        assert_prescribed(wide, "w", &[], narrow);
    }
}

#[test]
fn a_driven_joint_is_not_a_prescribed_one() {
    let (driven, given) = (eliminated(&VSCMG, &[], &[]), eliminated(&VSCMG, &["w"], &[]));
    let differing = driven.iter().filter(|(field, terms)| given[*field] != **terms);
    let differing: BTreeSet<_> = differing.map(|(field, _)| field.as_str()).collect();
    for field in ["gain_w_g", "free_w", "free_g", "gain_g_w3", "m_ww_33", "h_v_1", "divisor_g"] {
        assert!(differing.contains(field), "{field}");
    }
}
