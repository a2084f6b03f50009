//! Statuses of the emitted C: those of the Rust where both refuse, and what only the C refuses.

use nalgebra::{Matrix3, Vector3};
use precess_bake::solver;
use precess_dynamics::{BuiltIn, BuiltInKind, DeviceParameters};

use crate::case::{Case, Settings};
use crate::random::Random;
use crate::reference::reference;
use crate::{PLAIN, SEED, SETS, build, description, differing, files, kinds, program, sanitisers};

/// What is refused: by the same status as in Rust, after as many steps.
fn refused(names: &[&str]) -> Vec<Case> {
    let (mut random, kinds) = (Random::new(SEED), kinds(names));
    let all = Settings { passive: true, wrenches: true, field: 2, steps: 20, ..PLAIN };
    let good = Case::random(&kinds, all, &mut random);
    let with = |settings: Settings, change: &dyn Fn(&mut Case)| {
        let mut case = Case { settings, ..good.clone() };
        change(&mut case);
        case
    };
    let nan: [&dyn Fn(&mut Case); 14] = [
        &|case| case.r_b_n[1] = f64::NAN,
        &|case| case.r_b_n_dot[2] = f64::INFINITY,
        &|case| case.attitude[0] = f64::NAN,
        &|case| case.attitude = [0.0; 4],
        &|case| case.omega[0] = f64::NEG_INFINITY,
        &|case| case.joints[3].coordinate = f64::NAN,
        &|case| case.joints[4].rate = f64::NAN,
        &|case| case.joints[2].torque = f64::NAN,
        &|case| case.joints[1].force[2] = f64::NAN,
        &|case| case.joints[5].moment[0] = f64::INFINITY,
        &|case| case.force[0] = f64::NAN,
        &|case| case.torque_b[1] = f64::NAN,
        &|case| case.mu = f64::NAN,
        &|case| (case.joints[0].mode, case.joints[0].acceleration) = (1, f64::NAN),
    ];
    let mut cases: Vec<_> = nan.iter().map(|change| with(all, change)).collect();
    cases.push(with(all, &|case| case.settings.dt = f64::NAN));
    cases.push(with(all, &|case| case.joints[0].mode = 2));
    cases.push(with(all, &|case| case.r_b_n = [0.0; 3]));
    cases.push(with(all, &|case| case.omega = [1e200; 3]));
    cases.push(with(Settings { hub: 1, ..all }, &|_| ()));
    cases.extend(overflowing(&kinds, &mut random));
    // From a step that the cheap bound accepts to ones that are refused, close to the limit.
    for k in 0..60 {
        let dt = 1e-3 * 1.15_f64.powi(k);
        cases.push(with(Settings { dt, steps: 1, ..all }, &|_| ()));
        cases.push(with(Settings { dt, steps: 1, modes: true, hub: 2, ..all }, &|_| ()));
    }
    cases
}

/// A case of the mixed set in which one parameter of a device is changed.
fn changed(case: &Case, device: usize, change: impl Fn(&mut DeviceParameters)) -> Case {
    let (mut case, own) = (case.clone(), &case.devices[device]);
    let (kind, mut parameters) = (own.kind(), own.parameters());
    change(&mut parameters);
    case.devices[device] = BuiltIn::new(kind, &parameters).expect("the pattern of the kind");
    case
}

/// Numbers that overflow, tensors that are no inertia, and steps after which an angle may be anything.
fn overflowing(kinds: &[BuiltInKind], random: &mut Random) -> Vec<Case> {
    const PANEL: usize = 4;
    let one = Settings { steps: 1, ..PLAIN };
    let mut good = Case::random(kinds, one, random);
    good.joints[5].coordinate = 0.5;
    let with = |settings: Settings, change: &dyn Fn(&mut Case)| {
        let mut case = Case { settings, ..good.clone() };
        change(&mut case);
        case
    };
    let mut cases = vec![
        // The angle of a wheel is infinite after the first stage.
        with(Settings { dt: 1e300, ..one }, &|case| case.joints[0].rate = 1e10),
        with(one, &|case| case.joints[6].coordinate = 1e200),
        with(one, &|case| (case.mass, case.centre_of_mass) = (1e10, [1e160; 3])),
        with(one, &|case| case.inertia[1] = 2.0 * case.mass),
        // Diagonal and all minors of two rows are those of an inertia, the determinant is not.
        with(one, &|case| case.inertia = [1.0, -0.6, -0.6, 1.0, -0.6, 1.0]),
        with(one, &|case| case.inertia = [1.0, -0.5, -0.5, 1.0, -0.5, 1.0]),
        with(one, &|case| case.inertia = [1.0; 6]),
        with(one, &|case| case.inertia = [1.0, 1.0, 0.0, 1.0 - 1e-12, 0.0, 1.0]),
        with(one, &|case| case.inertia = [1.0, 1.0, 0.0, 1.0 - 1e-11, 0.0, 1.0]),
        with(one, &|case| case.inertia = [-1e-14, 0.0, 0.0, 1.0, 0.0, 1.0]),
        with(one, &|case| case.inertia = [0.0; 6]),
        changed(&good, PANEL, |panel| {
            let i = &mut panel.bodies[0].inertia;
            (i.m12, i.m21) = (9.0 * i.m11, 9.0 * i.m11);
        }),
    ];
    // A spring that every longer step diverges by.
    for dt in [1e-2, 1.0, 10.0, 1e3, 1e5, 1e100] {
        let stiff = changed(&good, PANEL, |panel| panel.passive[0].stiffness = 1e6);
        cases.push(Case { settings: Settings { dt, ..one }, ..stiff });
    }
    // Friction that no step is short enough for.
    let mut steep = changed(&good, PANEL, |panel| {
        (panel.passive[0].coulomb, panel.passive[0].coulomb_rate) = (1e200, 1e-200);
    });
    steep.joints[5].rate = 0.0;
    cases.push(steep);
    cases
}

#[test]
fn what_is_refused_is_refused_as_in_rust() {
    let (name, names) = SETS[1];
    let (cases, files) = (refused(names), files(name, names));
    let expected: Vec<_> = cases.iter().map(reference).collect();
    for status in [0.0, 2.0, 5.0, 6.0, 7.0, 9.0, 10.0] {
        let there = expected.iter().any(|numbers| numbers[1..3].contains(&status));
        assert!(there, "no case has status {status}");
    }
    for compiler in build::compilers() {
        let program = program(["refused", name], compiler, &files, &sanitisers(compiler));
        assert_eq!(differing(&program, &cases, &expected), None, "{compiler}");
    }
}

/// Wheels whose rates their kind keeps, and locked joints that move.
#[test]
fn a_joint_whose_rate_its_kind_keeps_is_not_driven_as_in_rust() {
    let (name, names) = ("gyro", &["sgcmg"]);
    let files = files(name, names);
    let good = Case::random(&kinds(names), Settings { steps: 2, ..PLAIN }, &mut Random::new(SEED));
    let [gimbal, wheel] = [0, 1];
    let with = |joint: usize, mode: u8, acceleration: f64, rate: f64| {
        let mut case = good.clone();
        let joint = &mut case.joints[joint];
        (joint.mode, joint.acceleration, joint.rate) = (mode, acceleration, rate);
        case
    };
    let cases = [
        good.clone(),
        with(wheel, 0, 0.0, 100.0),
        with(wheel, 0, 0.0, 0.0),
        with(wheel, 1, 0.1, 100.0),
        with(wheel, 1, 0.0, 100.0),
        with(wheel, 2, 0.0, 0.0),
        with(wheel, 2, 0.0, 100.0),
        with(gimbal, 2, 0.0, 0.1),
    ];
    let expected: Vec<_> = cases.iter().map(reference).collect();
    let statuses: Vec<_> = expected.iter().map(|numbers| numbers[1]).collect();
    assert_eq!(statuses, [0.0, 8.0, 8.0, 8.0, 0.0, 0.0, 8.0, 6.0]);
    for compiler in build::compilers() {
        let program = program(["singular", name], compiler, &files, &[]);
        assert_eq!(differing(&program, &cases, &expected), None, "{compiler}");
    }
}

/// A double-gimbal device without gimbal masses, its wheel's axis along the outer gimbal's.
fn singular(random: &mut Random) -> Case {
    let mut case = Case::random(&kinds(SETS[0].1), PLAIN, random);
    let mut parameters = case.devices[0].parameters();
    for body in &mut parameters.bodies[..2] {
        (body.mass, body.inertia, body.centre) = (0.0, Matrix3::zeros(), [0.0; 3]);
    }
    parameters.bodies[1].origin = [0.0; 3];
    let wheel = &mut parameters.bodies[2];
    (wheel.origin, wheel.centre) = ([0.0; 3], [0.0; 3]);
    wheel.inertia = Matrix3::from_diagonal(&Vector3::new(0.2, 0.1, 0.1));
    case.devices[0] = BuiltIn::new(BuiltInKind::Dgvscmg, &parameters).expect("a bare wheel");
    case.joints[1].coordinate = core::f64::consts::FRAC_PI_2;
    case
}

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn a_joint_without_inertia_is_refused_as_in_rust() {
    let (name, names) = SETS[0];
    let (case, files) = (singular(&mut Random::new(SEED)), files(name, names));
    let expected = reference(&case);
    assert_eq!(expected[1], 4.0, "not singular");
    for compiler in build::compilers() {
        let program = program(["parameters", name], compiler, &files, &[]);
        let cases = std::slice::from_ref(&case);
        let expected = std::slice::from_ref(&expected);
        assert_eq!(differing(&program, cases, expected), None, "{compiler}");
    }
}

#[test]
fn parameters_and_angles_that_c_does_not_take_are_refused() {
    let (name, names) = SETS[1];
    let (files, mut random) = (files(name, names), Random::new(SEED));
    let good = Case::random(&kinds(names), PLAIN, &mut random);
    let mut far = good.clone();
    far.joints[3].coordinate = 2e7;
    let length = reference(&good).len();
    // A mass, the mount of a device, mass and stiffness of the first joint, by their places.
    let devices = names.len();
    let places = [(0, -1.0), (11, 2.0), (11 + 9 * devices, -1.0), (11 + 9 * devices + 13, -1.0)];
    let broken = places.map(|(place, value)| {
        let mut numbers = good.numbers();
        numbers[place] = value;
        numbers
    });
    let numbers: Vec<_> = [good.numbers(), far.numbers()].into_iter().chain(broken).collect();
    for compiler in build::compilers() {
        let program = program(["inertias", name], compiler, &files, &[]);
        let found = build::run(&program, &numbers.concat());
        let statuses: Vec<_> = found.chunks(length).map(|own| [own[0], own[1]]).collect();
        let parameter = [1.0, 0.0];
        let expected = [[0.0, 0.0], [0.0, 3.0], parameter, parameter, parameter, parameter];
        assert_eq!(statuses, expected, "{compiler}");
    }
}

#[test]
fn names_that_meet_in_c_are_refused() {
    let refusal = |name: &str, devices: &[(&str, &str)]| {
        let (names, kinds): (Vec<_>, Vec<_>) = devices.iter().copied().unzip();
        let names: Vec<_> = names.into_iter().map(str::to_owned).collect();
        solver(&description(name, &names, &kinds)).err().map(|error| error.to_string())
    };
    let two = refusal("bus", &[("cmg", "dgvscmg"), ("cmg_outer", "vscmg")]).expect("a refusal");
    assert!(two.contains("outer gimbal of cmg and that of the gimbal of cmg_outer"), "{two}");
    assert!(two.contains("`BUS_CMG_OUTER_GIMBAL`"), "{two}");
    assert_eq!(refusal("bus", &[("cmg", "dgvscmg"), ("cmg_inner", "reaction_wheel")]), None);
    for header in ["string", "stdint", "stdio", "float", "math"] {
        let refused = refusal(header, &[("wheel", "reaction_wheel")]).expect("a refusal");
        assert!(refused.contains(&format!("`{header}`")), "{refused}");
    }
    assert_eq!(refusal("strings", &[("wheel", "reaction_wheel")]), None);
}
