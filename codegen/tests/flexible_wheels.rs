//! Wheels on flexible bearings: every claim about the one that is not in the registry is proven, too,
//! and the one in the registry has the parameters of a wheel.

use std::time::Instant;

use precess_codegen::kernel::parameters;
use precess_codegen::kinds::{
    FLEXIBLE_REACTION_WHEEL, FLEXIBLE_VSCMG, Kind, REACTION_WHEEL, VSCMG,
};
use precess_codegen::{emit_kind, prove_kind};

/// The parameters of a kind, positions of joints on the hub left out.
fn names(kind: &Kind) -> Vec<String> {
    let names = parameters(kind).fields.into_iter().map(|field| field.name);
    names.filter(|name| !name.contains("_b_b")).collect()
}

#[test]
fn a_flexible_wheel_has_the_parameters_of_a_wheel() {
    assert_eq!(names(&FLEXIBLE_REACTION_WHEEL), names(&REACTION_WHEEL));
    assert_eq!(names(&FLEXIBLE_VSCMG), names(&VSCMG));
}

/// Seven joints, one of them with a body of its own inboard of five without. Run with `--nocapture` to
/// see what it costs.
#[test]
fn every_claim_about_a_flexible_wheel_in_a_gimbal_is_proven() {
    let started = Instant::now();
    let files = emit_kind(&FLEXIBLE_VSCMG, "precess_dynamics").expect("files");
    let emitted = started.elapsed();
    for file in &files {
        println!("{}: {} lines", file.path, file.text.lines().count());
    }
    let rows = prove_kind(&FLEXIBLE_VSCMG, &files).expect("rows");
    println!("emitted in {emitted:?}, proven by {} rows in {:?}", rows.len(), started.elapsed());
    let failed: Vec<_> = rows.iter().filter(|row| !row.holds()).map(ToString::to_string).collect();
    assert!(rows.len() > 100 && failed.is_empty(), "{} rows, failed: {failed:#?}", rows.len());
}
