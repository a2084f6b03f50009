//! The promises of docs/promises.md, each with a name, how its cases are drawn and how it is
//! checked.

use precess_dynamics::BuiltInKind;
use proptest::prelude::{BoxedStrategy, Strategy};
use proptest::prop_oneof;

use super::draw::Profile;
use super::{
    Case, Verdict, derivatives, energy, finite, limits, longest_steps, motion, residual, runs,
    same, shapes, singular, typed_errors,
};

/// A promise.
#[derive(Clone, Copy, Debug)]
pub struct Property {
    /// Its name.
    pub name: &'static str,
    /// What it says, in one sentence.
    pub statement: &'static str,
    /// Cases of a chunk.
    pub cases: u32,
    /// The function that checks it, as printed code calls it.
    pub function: &'static str,
    /// How cases are drawn.
    pub draw: fn() -> BoxedStrategy<Case>,
    /// How it is checked.
    pub check: fn(&Case) -> Verdict,
}

use BuiltInKind as K;

/// Fourteen kinds, and lists of which every shape is compiled.
const SHAPES: &[&[BuiltInKind]] = &[
    &[K::ReactionWheel],
    &[K::Dgvscmg],
    &[K::Dgvscmg; 2],
    shapes::SIX,
    shapes::OTHERS,
    &[
        K::Dgvscmg,
        K::Vscmg,
        K::Sgcmg,
        K::ReactionWheel,
        K::HingedPanel,
        K::SloshMass,
        K::BalancedDgvscmg,
        K::Dgcmg,
        K::BalancedVscmg,
        K::BalancedSgcmg,
        K::BalancedDgcmg,
        K::BalancedReactionWheel,
    ],
    &[K::FlexibleReactionWheel],
    &[K::FlexibleVscmg],
];

/// Lists of which batches are compiled.
const BATCHES: &[&[BuiltInKind]] =
    &[&[K::Dgvscmg], &[K::BalancedVscmg], shapes::THREE, shapes::RAGGED];

/// Lists that are evaluated in lanes: batches, and devices side by side.
const LANES: &[&[BuiltInKind]] = &[
    &[K::Dgvscmg],
    &[K::BalancedVscmg],
    shapes::THREE,
    &[K::ReactionWheel; shapes::ABREAST],
    &[K::SloshMass; shapes::ABREAST],
    &[K::BalancedSgcmg; shapes::ABREAST],
    &[K::Dgcmg; shapes::ABREAST],
    &[K::Dgvscmg; shapes::ABREAST],
];

fn real() -> BoxedStrategy<Case> {
    Profile::REAL.cases()
}

fn wild(wild: f64) -> Profile {
    Profile { wild, ..Profile::REAL }
}

fn any_numbers() -> BoxedStrategy<Case> {
    prop_oneof![
        wild(0.02).cases(),
        Profile { sets: LANES, ..wild(0.02) }.cases(),
        wild(0.2).cases(),
        wild(0.8).cases(),
        Profile { sets: LANES, not_finite: 0.01, ..wild(0.2) }.cases(),
    ]
    .boxed()
}

fn bad_numbers() -> BoxedStrategy<Case> {
    prop_oneof![
        Profile { not_finite: 0.01, ..Profile::REAL }.cases(),
        Profile { not_finite: 0.01, sets: LANES, ..Profile::REAL }.cases(),
        Profile { sets: LANES, ..wild(0.05) }.cases(),
    ]
    .boxed()
}

fn in_shapes() -> BoxedStrategy<Case> {
    prop_oneof![
        Profile { sets: SHAPES, ..Profile::REAL }.cases(),
        Profile { sets: SHAPES, not_finite: 0.003, ..wild(0.01) }.cases(),
    ]
    .boxed()
}

fn in_batches() -> BoxedStrategy<Case> {
    let sets = BATCHES;
    prop_oneof![
        Profile { sets, more: 18, lumped: false, ..Profile::REAL }.cases(),
        Profile { sets, more: 18, not_finite: 0.003, ..wild(0.01) }.cases(),
        Profile { sets: LANES, ..Profile::REAL }.cases(),
    ]
    .boxed()
}

fn energies() -> BoxedStrategy<Case> {
    prop_oneof![energy::cancelling(), real(), wild(0.1).cases()].boxed()
}

/// Every property.
pub const PROPERTIES: &[Property] = &[
    Property {
        name: "result-or-error",
        statement: "every public call gives finite numbers or an error for any input",
        cases: 300,
        function: "finite::result_or_error",
        draw: any_numbers,
        check: finite::result_or_error,
    },
    Property {
        name: "first-bad-input-is-named",
        statement: "the first input that is not finite is named with its value, and nothing else is",
        cases: 300,
        function: "finite::first_bad_is_named",
        draw: bad_numbers,
        check: finite::first_bad_is_named,
    },
    Property {
        name: "shapes-are-bit-identical",
        statement: "arrays, tuples, lists and the set on board give the same bits or the same error",
        cases: 100,
        function: "same::shapes_are_identical",
        draw: in_shapes,
        check: same::shapes_are_identical,
    },
    Property {
        name: "batch-is-spacecraft",
        statement: "each state and spacecraft of a batch has the bits or error that it has by itself",
        cases: 50,
        function: "same::batch_is_spacecraft",
        draw: in_batches,
        check: same::batch_is_spacecraft,
    },
    Property {
        name: "singular-is-refused",
        statement: "a spacecraft without inertia where something turns freely is rejected",
        cases: 2000,
        function: "singular::singular_is_refused",
        draw: singular::cases,
        check: singular::singular_is_refused,
    },
    Property {
        name: "inverse-dynamics-residual",
        statement: "loads of the accelerations need no wrench on the hub and give the motors back",
        cases: 1000,
        function: "residual::inverse_dynamics",
        draw: real,
        check: residual::inverse_dynamics,
    },
    Property {
        name: "wrapping-changes-nothing",
        statement: "wrapped angles leave accelerations, energies and springs as they are",
        cases: 500,
        function: "motion::wrapping_changes_nothing",
        draw: real,
        check: motion::wrapping_changes_nothing,
    },
    Property {
        name: "order-changes-only-rounding",
        statement: "the order of devices changes nothing but rounding",
        cases: 500,
        function: "motion::order_changes_only_rounding",
        draw: real,
        check: motion::order_changes_only_rounding,
    },
    Property {
        name: "attitudes-agree",
        statement: "quaternions of any length and both sets of MRPs move alike",
        cases: 100,
        function: "motion::attitudes_agree",
        draw: real,
        check: motion::attitudes_agree,
    },
    Property {
        name: "ledger-balances",
        statement: "the residual of the ledger is rounding",
        cases: 1000,
        function: "energy::ledger_balances",
        draw: real,
        check: energy::ledger_balances,
    },
    Property {
        name: "kinetic-energy-is-not-negative",
        statement: "kinetic energy is never below zero",
        cases: 2000,
        function: "energy::kinetic_energy_is_not_negative",
        draw: energies,
        check: energy::kinetic_energy_is_not_negative,
    },
    Property {
        name: "stop-conserves",
        statement: "a stop keeps momentum, loses energy and leaves what is locked at rest",
        cases: 500,
        function: "energy::stop_conserves",
        draw: energy::moving,
        check: energy::stop_conserves,
    },
    Property {
        name: "locked-stays-locked",
        statement: "a locked joint keeps its coordinate to the bit and its rate at zero",
        cases: 200,
        function: "energy::locked_stays_locked",
        draw: real,
        check: energy::locked_stays_locked,
    },
    Property {
        name: "longest-step-holds",
        statement: "the longest step that an error names is accepted, and no vibration grows with it",
        cases: 200,
        function: "longest_steps::longest_step_holds",
        draw: runs::cases,
        check: longest_steps::longest_step_holds,
    },
    Property {
        name: "runs-conserve-or-refuse",
        statement: "a step that a spring or damper makes unstable is rejected; one that resolves them keeps energy less work",
        cases: 100,
        function: "runs::runs_conserve_or_refuse",
        draw: runs::cases,
        check: runs::runs_conserve_or_refuse,
    },
    Property {
        name: "errors-are-typed",
        statement: "what is locked and moves, not driven, at the centre or miscounted has its own error",
        cases: 500,
        function: "typed_errors::errors_are_typed",
        draw: typed_errors::cases,
        check: typed_errors::errors_are_typed,
    },
    Property {
        name: "central-gravity",
        statement: "the field is mu/r² wherever that is a number",
        cases: 2000,
        function: "limits::central_gravity",
        draw: limits::far_and_near,
        check: limits::central_gravity,
    },
    Property {
        name: "near-singular",
        statement: "near gimbal lock the error is that of the conditioning, or the pose is rejected",
        cases: 500,
        function: "limits::near_singular",
        draw: limits::near_lock,
        check: limits::near_singular,
    },
    Property {
        name: "derivatives-or-error",
        statement: "the linearised system is finite with the solver's accelerations, or the solver's error",
        cases: 100,
        function: "derivatives::derivatives_or_error",
        draw: any_numbers,
        check: derivatives::derivatives_or_error,
    },
    Property {
        name: "derivatives-are-differences",
        statement: "derivatives of the accelerations are those of central differences",
        cases: 100,
        function: "derivatives::derivatives_are_differences",
        draw: real,
        check: derivatives::derivatives_are_differences,
    },
];

/// The property of a name.
#[must_use]
pub fn named(name: &str) -> Option<&'static Property> {
    PROPERTIES.iter().find(|property| property.name == name)
}
