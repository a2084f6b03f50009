//! One wrong term of any emitted function breaks a law of physics: a fixed sample of all mutants.
//! `cargo xtask mutate` makes them all.

use precess_codegen::kinds::{DGVSCMG, KINDS};
use precess_review::mutation::{
    Computed, EngineError, Engines, Kind, Law, Mutant, MutantStatus, MutationError, NOTICED,
    Outcome, Report, Selection, mutate, mutate_all,
};
use precess_review::report::mutation;
use serde_json::Value;

/// Every so many mutants: a prime, so that all changes and all places are met.
const SAMPLE: usize = 23;

/// What unchanged functions may leave of a law: some thirty times the 3e-12 that they do leave,
/// which is rounding over the step of a difference, and a hundred times less than what is noticed.
const FLOOR: f64 = 1e-10;

/// What the laws must leave of a mutant: states of order one make a missing term of order one, and
/// cancellation takes no more than four digits of it.
const SIGNAL: f64 = 1e-4;

fn stored() -> String {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/fixtures/engines.json");
    std::fs::read_to_string(path).unwrap()
}

fn run(selection: &Selection<'_>) -> Result<Report, MutationError> {
    let engines = Engines::parse(&DGVSCMG, &stored()).unwrap();
    mutate(&DGVSCMG, &engines, selection, &|_| {})
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
    assert_eq!(by_kernel.len(), 14);
    let sum: usize = by_kernel.iter().map(|(_, tally)| tally.mutants).sum();
    let numbered: usize = report.by_tag().iter().map(|(_, tally)| tally.mutants).sum();
    assert_eq!(sum, report.outcomes.len());
    assert_eq!(numbered + report.unnumbered(), report.outcomes.len());
}

/// Kinds of which no values of engines are stored are judged only by conservation and differences.
#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn every_mutant_of_a_sample_of_every_kind_is_killed_or_equivalent() {
    let engines = Engines::parse(&DGVSCMG, &stored()).unwrap();
    let selection = Selection { kernel: None, every: SAMPLE };
    for report in mutate_all(&KINDS, &engines, &selection, &|_| {}).unwrap() {
        let name = report.kind.name;
        let survivors: Vec<_> = report.survivors().map(|o| o.mutant.to_string()).collect();
        assert!(survivors.is_empty(), "{name}: {survivors:#?}");
        assert!(report.total().any > 0, "{name}: nothing is killed");
        let none = |(law, _): &(Law, f64)| law.kind() != Kind::Engines;
        assert!(name == DGVSCMG.name || report.floors.iter().all(none), "{name}");
        for (law, floor) in &report.floors {
            assert!(*floor < FLOOR, "unchanged functions of {name} leave {floor:e} of {law}");
        }
    }
}

#[test]
fn every_kind_of_check_kills_by_itself() {
    let report = run(&Selection { kernel: Some("back_substitute"), every: 5 }).unwrap();
    let total = report.total();
    assert_eq!(total.killed, [total.mutants; 3]);
    assert!(report.outcomes.iter().all(|outcome| outcome.status == MutantStatus::Killed));
}

#[test]
fn a_missing_constant_arm_is_seen_by_no_difference() {
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
    let page = mutation(&[report]).unwrap().unwrap();
    assert_eq!(page.path, "docs/mutation.md");
    assert!(page.text.contains("| `wheel` |"));
}

#[test]
fn whatever_is_made_wrong_is_computed_under_the_same_number() {
    let report = run(&Selection { kernel: None, every: 7 * SAMPLE }).unwrap();
    for Outcome { mutant, .. } in &report.outcomes {
        let Mutant { kernel, name, tag, .. } = mutant.clone();
        assert!(report.computed.contains(&Computed { kernel, name, tag }), "{mutant}");
    }
    let of = |tag: &str| {
        let computed = report.computed.iter().filter(|value| value.tag.as_deref() == Some(tag));
        computed.map(|value| (value.kernel.as_str(), value.name.as_str())).collect::<Vec<_>>()
    };
    // Only products: nothing to make wrong, and computed all the same.
    assert!(of("(D10)").contains(&("eliminate", "gain_w_v1")), "{:?}", of("(D10)"));
    assert!(of("(34)").contains(&("eliminate", "alpha_go_gox")), "{:?}", of("(34)"));
    // What several equations share is computed once, in `prepare`, under no number.
    let mut shared = report.computed.iter().filter(|value| value.tag.is_none());
    assert!(shared.all(|value| value.kernel == "prepare"));
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
    let error =
        mutate(&DGVSCMG, &engines, &Selection { kernel: None, every: 1 }, &|_| {}).unwrap_err();
    let MutationError::Broken { law, residual, .. } = error else { panic!("{error}") };
    assert!(law.kind() == Kind::Engines && residual > NOTICED);
}

#[test]
fn missing_values_are_named() {
    let without = stored().replacen("\"gamma_o\"", "\"gamma\"", 1);
    let error = Engines::parse(&DGVSCMG, &without).err().unwrap();
    assert!(matches!(&error, EngineError::Missing { name, .. } if name == "gamma_o"), "{error}");
    let none = stored().replace("\"scales\": \"unit\"", "\"scales\": \"declared\"");
    assert!(matches!(Engines::parse(&DGVSCMG, &none), Err(EngineError::None)));
    assert!(matches!(Engines::parse(&DGVSCMG, "{}"), Err(EngineError::Json(_))));
}

/// The bodies of a stored spacecraft.
fn bodies(craft: &mut Value) -> &mut Vec<Value> {
    craft["pinocchio"]["bodies"][0].as_array_mut().unwrap()
}

/// The first stored spacecraft's lists, each with one entry more or fewer.
#[test]
fn lists_of_another_length_are_refused_with_their_place() {
    let refused = |change: fn(&mut Value)| {
        let mut json: Value = serde_json::from_str(&stored()).unwrap();
        change(&mut json["spacecraft"][0]);
        Engines::parse(&DGVSCMG, &json.to_string()).err().unwrap().to_string()
    };
    let said = |list: &str, count: usize, expected: usize| {
        format!(
            "spacecraft `one device, unit scales, 0` has {count} entries in `{list}`, not \
             {expected}; store the values again with `python tests/engines/store.py`"
        )
    };
    let more = refused(|craft| {
        let wheel = bodies(craft)[2].clone();
        bodies(craft).push(wheel);
    });
    assert_eq!(more, said("bodies", 4, 3));
    let fewer = refused(|craft| drop(bodies(craft).pop()));
    assert_eq!(fewer, said("bodies", 2, 3));
    let none = refused(|craft| craft["mujoco"]["accelerations"] = Value::Array(Vec::new()));
    assert_eq!(none, said("accelerations", 0, 1));
    let fourth = refused(|craft| craft["devices"][0]["angles"]["fourth"] = 1.0.into());
    assert_eq!(fourth, said("angles", 4, 3));
}
