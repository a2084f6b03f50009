//! One wrong term of any emitted function breaks a law of physics: a fixed sample of all mutants.
//! `cargo xtask mutate` makes them all.

use precess_codegen::kinds::DGVSCMG;
use precess_codegen::mutation::{
    EngineError, Engines, Fate, Kind, MutationError, NOTICED, Report, Selection, mutate,
};

/// Every so many mutants: a prime, so that all changes and all places are met.
const SAMPLE: usize = 23;

/// What unchanged functions may leave of a law: some thousand times what they do, and a hundred
/// times less than what is noticed.
const FLOOR: f64 = 1e-10;

/// What the laws must leave of a mutant: states of order one make a missing term of order one, and
/// cancellation takes no more than four digits of it.
const SIGNAL: f64 = 1e-4;

fn stored() -> String {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/fixtures/engines.json");
    std::fs::read_to_string(path).unwrap()
}

fn run(selection: &Selection<'_>) -> Result<Report, MutationError> {
    let engines = Engines::parse(&DGVSCMG, &stored()).unwrap();
    mutate(&DGVSCMG, &engines, selection, &mut |_, _| {})
}

#[test]
fn every_mutant_of_a_sample_is_killed_or_equivalent() {
    let report = run(&Selection { kernel: None, every: SAMPLE }).unwrap();
    let survivors: Vec<_> = report.survivors().map(|outcome| outcome.mutant.to_string()).collect();
    assert!(survivors.is_empty(), "{survivors:#?}");
    assert!(report.outcomes.len() > 150, "{} mutants", report.outcomes.len());
    for (law, floor) in &report.floors {
        assert!(*floor < FLOOR, "unchanged functions leave {floor:e} of {law}");
    }
    for outcome in report.outcomes.iter().filter(|outcome| outcome.killed()) {
        let strongest = Kind::ALL.map(|kind| outcome.signal(kind)).into_iter().fold(0.0, f64::max);
        assert!(strongest > SIGNAL, "{}: {strongest:e}", outcome.mutant);
    }
    let by_kernel = report.by_kernel();
    assert_eq!(by_kernel.len(), 8);
    let sum: usize = by_kernel.iter().map(|(_, tally)| tally.mutants).sum();
    let rows: usize = report.by_name().iter().map(|row| row.tally.mutants).sum();
    assert_eq!((sum, rows), (report.outcomes.len(), report.outcomes.len()));
}

#[test]
fn every_kind_of_check_kills_by_itself() {
    let report = run(&Selection { kernel: Some("back_substitute"), every: 5 }).unwrap();
    let total = report.total();
    assert_eq!(total.killed, [total.mutants; 3]);
    assert!(report.outcomes.iter().all(|outcome| outcome.fate == Fate::Killed));
}

#[test]
fn a_missing_constant_arm_is_seen_by_momenta_and_engines_alone() {
    let report = run(&Selection { kernel: Some("outer_gimbal"), every: 1 }).unwrap();
    let arm = report.outcomes.iter().find(|outcome| {
        let mutant = &outcome.mutant;
        mutant.name == "r_goc_b_bx" && mutant.operand == "r_go_b_bx"
    });
    let arm = arm.unwrap();
    assert_eq!(Kind::ALL.map(|kind| arm.killed_by(kind)), [true, false, true], "{}", arm.mutant);
}

#[test]
fn rows_are_found_by_equation() {
    let report = run(&Selection { kernel: Some("wheel"), every: SAMPLE }).unwrap();
    let acceleration = report.by_tag().into_iter().find(|(tag, _)| tag == "(14)").unwrap().1;
    assert!(acceleration.mutants > 0 && acceleration.any == acceleration.mutants);
    let names = report.by_name();
    assert!(names.iter().any(|row| row.name.starts_with("r_wc_b_dprime")), "{names:?}");
    assert!(report.page().contains("| `wheel` |"));
}

#[test]
fn a_function_that_is_not_there_is_named() {
    let error = run(&Selection { kernel: Some("wheels"), every: 1 }).unwrap_err();
    let message = error.to_string();
    assert!(
        message.starts_with("no function is called `wheels`; choose one of prepare, outer_gim")
    );
}

#[test]
fn values_that_are_not_physics_are_refused() {
    let json = stored();
    let start =
        json.find("\"pinocchio\": {\"").or_else(|| json.find("\"pinocchio\": {\n")).unwrap();
    let energy = start + json[start..].find("\"energy\":").unwrap() + "\"energy\":".len();
    let end = energy + json[energy..].find([',', '}']).unwrap();
    let wrong = format!("{} 1.0{}", &json[..energy], &json[end..]);
    let engines = Engines::parse(&DGVSCMG, &wrong).unwrap();
    let error = mutate(&DGVSCMG, &engines, &Selection::all(), &mut |_, _| {}).unwrap_err();
    let MutationError::Broken { law, residual } = error else { panic!("{error}") };
    assert!(law.kind() == Kind::Engines && residual > NOTICED);
}

#[test]
fn missing_values_are_named() {
    let without = stored().replacen("\"gamma_o\"", "\"gamma\"", 1);
    let error = Engines::parse(&DGVSCMG, &without).err().unwrap();
    assert!(matches!(&error, EngineError::Missing { name, .. } if name == "gamma_o"), "{error}");
    let none = stored().replace("unit scales", "other scales");
    assert!(matches!(Engines::parse(&DGVSCMG, &none), Err(EngineError::None)));
    assert!(matches!(Engines::parse(&DGVSCMG, "{}"), Err(EngineError::Json(_))));
}
