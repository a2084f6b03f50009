//! Derivatives along a direction, of every setting: those of `Spacecraft::jvp`.

use precess_dynamics::{Axis, Each, Variable};

use crate::case::Case;
use crate::reference::{Numbers, of_case};
use crate::{SETS, build, cases, files, kinds};

/// By how much a change differs at most, of the largest of the spacecraft: rounding of another order of sums.
const AGREEMENT: f64 = 1e-13;

/// The component of the direction of a number, as in `jvp.c`.
fn component(number: usize) -> f64 {
    let residue = i32::try_from((number * 37 + 11) % 101).expect("below 101");
    f64::from(residue - 50) / 50.0
}

/// The number of a variable's component.
fn number(variable: Variable) -> Option<usize> {
    let axis = |axis: Axis| Axis::ALL.iter().position(|of| *of == axis).expect("an axis");
    Some(match variable {
        Variable::Position(of) => axis(of),
        Variable::Attitude(of) => 3 + axis(of),
        Variable::Omega(of) => 6 + axis(of),
        Variable::Force(of) => 9 + axis(of),
        Variable::TorqueB(of) => 12 + axis(of),
        Variable::HubAcceleration(of) => 15 + axis(of),
        Variable::HubAngularAcceleration(of) => 18 + axis(of),
        Variable::Coordinate(joint) => 21 + 9 * joint,
        Variable::Rate(joint) => 22 + 9 * joint,
        Variable::Motor(joint) | Variable::Acceleration(joint) => 23 + 9 * joint,
        Variable::BodyForce(joint, of) => 24 + 9 * joint + axis(of),
        Variable::BodyMoment(joint, of) => 27 + 9 * joint + axis(of),
        _ => return None,
    })
}

/// What the accelerations of a case change by.
fn along<A: Numbers>(case: &Case) -> Vec<f64> {
    let (craft, state, inputs) = of_case::<A>(case);
    let of = |variable: Variable| number(variable).map_or(0.0, component);
    let states: Vec<_> = craft.state_variables(&inputs).map(of).collect();
    let acting: Vec<_> = craft.input_variables(&inputs).map(of).collect();
    let (_, along) = craft.jvp(&state, &inputs, (&states, &acting)).expect("a derivative");
    let hub = along.r_b_n_ddot.iter().chain(&along.omega_dot).copied();
    hub.chain(along.devices.iter().flat_map(Each::values)).collect()
}

/// The largest difference of a set, of the largest change of its spacecraft.
fn differ(name: &str) {
    let (_, names) = SETS.iter().find(|(set, _)| *set == name).expect("a set");
    let (cases, files) = (cases(names), files(name, names));
    let numbers: Vec<_> = cases.iter().flat_map(Case::numbers).collect();
    let joints: usize = kinds(names).iter().map(|kind| kind.joints().len()).sum();
    for compiler in build::compilers() {
        let program = program([name, compiler], &files);
        let found = build::run(&program, &numbers);
        let length = 7 + joints;
        assert_eq!(found.len(), cases.len() * length);
        let mut worst: f64 = 0.0;
        for (case, found) in cases.iter().zip(found.chunks(length)) {
            let expected = if case.settings.mrp {
                along::<precess_dynamics::Mrp>(case)
            } else {
                along::<precess_dynamics::Quaternion>(case)
            };
            assert_eq!(found[0], 0.0, "{:?}", case.settings);
            let size = expected.iter().fold(0.0_f64, |largest, of| largest.max(of.abs()));
            for (place, (a, b)) in found[1..].iter().zip(&expected).enumerate() {
                let off = (a - b).abs() / size;
                assert!(
                    off <= AGREEMENT,
                    "{name}, {:?}: number {place} is {a:e}, not {b:e}; the largest is {size:e}",
                    case.settings
                );
                worst = worst.max(off);
            }
        }
        println!(
            "{name}, {compiler}: {} directions, at most {worst:.1e} of the largest",
            cases.len()
        );
    }
}

fn program(
    [name, compiler]: [&str; 2],
    files: &[precess_codegen::emit::EmittedFile],
) -> std::path::PathBuf {
    let (reads, _) = include_str!("program.c").split_once("int main(void)").expect("a program");
    let main = format!("{reads}{}", include_str!("jvp.c"));
    let main = main.replace("NAME", name).replace("UPPER", &name.to_uppercase());
    let folder = build::folder(&format!("solver_jvp_{name}_{compiler}"));
    build::c(&folder, compiler, files, &[("main.c", &main)], &[])
}

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn a_pyramid_of_double_gimbals_has_the_derivatives_of_rust() {
    differ("pyramid");
}

#[test]
fn wheels_a_panel_and_slosh_have_the_derivatives_of_rust() {
    differ("mixed");
}

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn flexible_bearings_have_the_derivatives_of_rust() {
    differ("flexible");
}

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn every_other_kind_has_the_derivatives_of_rust() {
    differ("others");
}
