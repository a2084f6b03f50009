//! Derivatives of a unit by its states and inputs: those of the scenario, linearised.

use std::fs;

use precess::evaluation::{Evaluator, Linearized};
use precess::fmu::FmiVersion;
use precess::scenario::Scenario;
use precess_dynamics::Outputs;

use super::compiled::{FLAGS, compile, compilers, numbers, sources};
use super::{UNIT, scenario};

/// By how much a derivative differs at most, of the largest of its row; by the attitude, of the acceleration that turns with
/// it, too.
const AGREEMENT: f64 = 1e-14;
/// States of the hub before its quaternion and after.
const BEFORE: usize = 6;
const AFTER: usize = 10;

/// A unit without what the linearised scenario does not have: a wrench that turns in B, a motor at its limit.
fn smooth(gravity: &str) -> String {
    let unit = UNIT.replace("axes = \"inertial\"\n", "").replace("\"0.3 N m\"", "\"0.1 N m\"");
    format!("{unit}[gravity]\n{gravity}\n")
}

/// Derivatives of the states' derivatives by each state and input, one after another, as the unit has them.
fn of_unit(name: &str, unit: &str, compiler: &str, more: &[&str]) -> Vec<Vec<f64>> {
    let (folder, mut sources) = sources(FmiVersion::Two, name, unit);
    fs::write(folder.join("driver.c"), include_str!("driver_derivatives.c")).expect("a source");
    sources.push("driver.c".to_owned());
    let arguments = [&FLAGS, more, &["-o", "driver"]].concat();
    let done = compile(compiler, &folder, &arguments, &sources);
    assert!(done.status.success(), "{compiler}: {}", String::from_utf8_lossy(&done.stderr));
    let (found, states) = (numbers(&folder, &[]), 13 + 2 * scenario(unit).joint_count());
    found.chunks(states).map(<[f64]>::to_vec).collect()
}

/// What the linearised scenario has of the hub's attitude and the rest, by the unit's states and inputs.
fn linearized(scenario: &Scenario) -> (Linearized, [f64; 4], f64) {
    let evaluator = Evaluator::new(scenario).expect("a spacecraft");
    let state = evaluator.initial();
    let inputs = evaluator.inputs(0.0, &state).expect("inputs");
    let q = state.attitude;
    let none = Outputs { momentum: None, loads: None };
    let found = evaluator.linearize(&state, &inputs, &none, &[] as &[&str]).expect("derivatives");
    let accelerations = evaluator.accelerations(&state, &inputs).expect("accelerations");
    (found, [q.q0, q.q1, q.q2, q.q3], accelerations.r_b_n_ddot.amax())
}

/// The change of a quaternion by a small rotation about an axis of B.
fn turned([q0, q1, q2, q3]: [f64; 4], axis: usize) -> [f64; 4] {
    let twice = [[-q1, q0, q3, -q2], [-q2, -q3, q0, q1], [-q3, q2, -q1, q0]];
    twice[axis].map(|of| 0.5 * of)
}

#[test]
fn derivatives_are_those_of_the_linearised_scenario() {
    let mut worst: f64 = 0.0;
    for (field, gravity) in [
        ("uniform", "uniform = \"1, -2, -9 m/s^2\""),
        ("central", "central = \"398600.4418 km^3/s^2\""),
    ] {
        let unit = smooth(gravity).replace(
            "[initial]\n",
            "[initial]\nposition = \"7000, 100, -200 km\"\nvelocity = \"0.1, 7.5, 0 km/s\"\n",
        );
        let scenario = scenario(&unit);
        let (expected, q, acceleration) = linearized(&scenario);
        let joints = scenario.joint_count();
        // Rows and columns that are states of both: the unit has a quaternion where the other has a rotation.
        let of_unit_places: Vec<usize> = (0..BEFORE).chain(AFTER..13 + 2 * joints).collect();
        let of_other = |place: usize| match place {
            0..3 => place,
            3..6 => place + 3,
            place => place - 1,
        };
        let compiler = compilers().into_iter().next().expect("a compiler");
        let found = of_unit(&format!("derivatives_{field}"), &unit, compiler, &[]);
        let mut compare = |row: usize, what: &str, found: f64, of: f64, size: f64| {
            let off = (found - of).abs() / size;
            assert!(
                off <= AGREEMENT,
                "{field}, {} by {what}: {found:e} and {of:e}, {off:.1e} of the row's {size:e}",
                expected.states[row]
            );
            worst = worst.max(off);
        };
        for unit_row in &of_unit_places {
            let row = of_other(*unit_row);
            let largest = expected.a.row(row).amax().max(expected.b.row(row).amax());
            for place in &of_unit_places {
                let column = of_other(*place);
                let of = expected.a[(row, column)];
                compare(row, &expected.states[column], found[*place][*unit_row], of, largest);
            }
            for axis in 0..3 {
                let along: f64 = (0..4).map(|k| found[6 + k][*unit_row] * turned(q, axis)[k]).sum();
                // The field, expressed in N, does not turn: what turns with B cancels.
                let size =
                    if unit_row.abs_diff(4) <= 1 { largest.max(acceleration) } else { largest };
                compare(row, "attitude", along, expected.a[(row, 3 + axis)], size);
            }
            // Force and torque on the hub, then the motors; wrenches are no inputs of the other on the hub.
            for (column, name) in expected.inputs.iter().enumerate().take(6 + joints) {
                let of = expected.b[(row, column)];
                compare(row, name, found[13 + 2 * joints + column][*unit_row], of, largest);
            }
        }
    }
    println!("at most {worst:.1e} of the largest of a row");
}

#[test]
fn derivatives_have_no_warning_and_pass_the_sanitisers() {
    for compiler in compilers() {
        let sanitiser: &[&str] = if compiler == "gcc" {
            &["-fsanitize=address,undefined", "-fno-sanitize-recover=all"]
        } else {
            &["-fsanitize=undefined", "-fsanitize-undefined-trap-on-error"]
        };
        let found = of_unit(&format!("derivatives_{compiler}"), UNIT, compiler, sanitiser);
        assert_eq!(found.len(), 13 + 4 + 6 + 2 + 12);
        // The wrench along N turns in B: force and attitude.
        assert!(found[6].iter().any(|of| *of != 0.0));
    }
}
