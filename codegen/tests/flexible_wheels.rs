//! Wheels on flexible bearings have the parameters of wheels on rigid ones.

use precess_codegen::kernel::parameters;
use precess_codegen::kinds::{
    FLEXIBLE_REACTION_WHEEL, FLEXIBLE_VSCMG, Kind, REACTION_WHEEL, VSCMG,
};

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
