//! The emitted C solver of sets of kinds: accelerations, statuses and a thousand steps have the bits of the Rust library.
//!
//! The C is compiled by each compiler at hand with the warnings of its page as errors, once with sanitisers.

#[allow(dead_code, reason = "shared with the suite of the kernels")]
#[path = "../../../tests/c_kernels/build.rs"]
mod build;
mod case;
mod example;
#[allow(dead_code, reason = "shared with the suite of the kernels")]
#[path = "../../../tests/c_kernels/random.rs"]
mod random;
mod reference;

use std::fs;
use std::path::PathBuf;
use std::process::Command;

use nalgebra::{Matrix3, Vector3};
use precess_bake::{Description, solver};
use precess_codegen::emit::EmittedFile;
use precess_description::{Body, Device, Hub};
use precess_dynamics::{BuiltIn, BuiltInKind};

use case::{Case, Settings};
use random::Random;
use reference::reference;

/// The page for users.
const PAGE: &str = include_str!("../../../../docs/c.md");
/// Where all random numbers start.
const SEED: u64 = 0x40_C501;
/// Spacecraft of each setting whose accelerations are compared.
const SPACECRAFT: usize = 20;
/// Steps of one spacecraft of each setting.
const STEPS: usize = 1000;
/// The sanitisers of a compiler. Clang's need a library that is a package of its own; it traps.
fn sanitisers(compiler: &str) -> [&'static str; 2] {
    match compiler {
        "gcc" => ["-fsanitize=address,undefined", "-fno-sanitize-recover=all"],
        _ => ["-fsanitize=undefined", "-fsanitize-undefined-trap-on-error"],
    }
}

/// The sets: a name, and kinds in order.
const SETS: [(&str, &[&str]); 4] = [
    ("pyramid", &["dgvscmg", "dgvscmg", "dgvscmg", "dgvscmg"]),
    (
        "mixed",
        &[
            "reaction_wheel",
            "reaction_wheel",
            "reaction_wheel",
            "vscmg",
            "hinged_panel",
            "slosh_mass",
        ],
    ),
    ("flexible", &["flexible_reaction_wheel", "flexible_vscmg"]),
    (
        "others",
        &[
            "reaction_wheel",
            "balanced_reaction_wheel",
            "sgcmg",
            "balanced_sgcmg",
            "reaction_wheel",
            "dgcmg",
            "balanced_dgcmg",
            "balanced_vscmg",
            "balanced_dgvscmg",
        ],
    ),
];

const PLAIN: Settings = Settings {
    mrp: false,
    passive: false,
    wrenches: false,
    field: 0,
    hub: 0,
    modes: false,
    dt: 1e-3,
    steps: 0,
};

/// All that can act, in few settings.
fn settings() -> [Settings; 6] {
    [
        PLAIN,
        Settings { mrp: true, passive: true, wrenches: true, field: 1, ..PLAIN },
        Settings { passive: true, wrenches: true, field: 2, modes: true, ..PLAIN },
        Settings { passive: true, field: 2, hub: 1, ..PLAIN },
        Settings { mrp: true, wrenches: true, field: 2, hub: 2, modes: true, ..PLAIN },
        Settings { mrp: true, field: 2, dt: -1e-3, ..PLAIN },
    ]
}

fn kinds(names: &[&str]) -> Vec<BuiltInKind> {
    names.iter().map(|name| BuiltInKind::of_name(name).expect("a kind")).collect()
}

/// What is emitted of a set.
fn files(name: &str, names: &[&str]) -> Vec<EmittedFile> {
    let devices: Vec<_> = (0..names.len()).map(|k| format!("device{k}")).collect();
    files_of(name, &devices, names)
}

/// What is emitted of a set of devices with these names.
fn files_of(name: &str, devices: &[String], names: &[&str]) -> Vec<EmittedFile> {
    let zero = [[0.0; 3]; 3];
    let body = Body {
        mass: 1.0,
        origin: [0.0; 3],
        centre_of_mass: [0.0; 3],
        inertia: zero,
        locked_at: None,
    };
    let device = |(name, kind): (&String, BuiltInKind)| Device {
        name: name.clone(),
        kind: kind.name().to_owned(),
        mount: zero,
        turns: None,
        body: vec![body.clone(); kind.joints().len()],
        keep: Vec::new(),
    };
    let description = Description {
        format: precess_description::FORMAT,
        name: name.to_owned(),
        title: String::new(),
        hub: Hub { mass: 1.0, centre_of_mass: [0.0; 3], inertia: zero },
        device: devices.iter().zip(kinds(names)).map(device).collect(),
    };
    let files = solver(&description).expect("a solver");
    for file in files.iter().filter(|file| file.path != "README.md") {
        let wide = file.text.lines().find(|line| line.chars().count() > 100);
        assert_eq!(wide, None, "{}", file.path);
    }
    let files = files.into_iter();
    files.filter(|file| file.path != "README.md").collect()
}

/// The program of a test, in a folder of its own: tests run side by side.
fn program(
    [test, name]: [&str; 2],
    compiler: &str,
    files: &[EmittedFile],
    more: &[&str],
) -> PathBuf {
    let main = include_str!("program.c").replace("NAME", name);
    let main = main.replace("UPPER", &name.to_uppercase());
    let folder = build::folder(&format!("solver_{test}_{name}_{compiler}"));
    build::c(&folder, compiler, files, &[("main.c", &main)], more)
}

/// The first number that differs: of which case, and where.
fn differing(program: &PathBuf, cases: &[Case], expected: &[Vec<f64>]) -> Option<String> {
    let numbers: Vec<_> = cases.iter().flat_map(Case::numbers).collect();
    let found = build::run(program, &numbers);
    let length = expected[0].len();
    assert_eq!(found.len(), cases.len() * length);
    for ((case, found), expected) in cases.iter().zip(found.chunks(length)).zip(expected) {
        let differs = |(a, b): (&f64, &f64)| a.to_bits() != b.to_bits();
        if let Some(place) = found.iter().zip(expected).position(differs) {
            return Some(format!(
                "{:?}: number {place} is {:e}, not {:e}; statuses {:?} for {:?}",
                case.settings,
                found[place],
                expected[place],
                &found[..4],
                &expected[..4]
            ));
        }
    }
    None
}

/// Random spacecraft of every setting, one of each with a thousand steps. Bearings need short ones.
fn cases(names: &[&str]) -> Vec<Case> {
    let flexible = names.iter().any(|name| name.starts_with("flexible"));
    let shorter = if flexible { 0.1 } else { 1.0 };
    let (mut random, kinds) = (Random::new(SEED), kinds(names));
    let mut cases = Vec::new();
    for settings in settings() {
        for k in 0..SPACECRAFT {
            let steps = if k == 0 { STEPS } else { 0 };
            cases.push(Case::random(
                &kinds,
                Settings { steps, dt: shorter * settings.dt, ..settings },
                &mut random,
            ));
        }
    }
    cases
}

/// The whole comparison of one set.
fn compare(name: &str) {
    let (_, names) = SETS.iter().find(|(set, _)| *set == name).expect("a set");
    let (cases, files) = (cases(names), files(name, names));
    let expected: Vec<_> = cases.iter().map(reference).collect();
    // What fails shows nothing of a step.
    let whole = |(case, numbers): &(&Case, &Vec<f64>)| {
        numbers[..3] != [0.0; 3] || case.settings.steps != 0 && numbers[3] < 1000.0
    };
    let failed: Vec<_> = cases.iter().zip(&expected).filter(whole).collect();
    let failed: Vec<_> = failed.iter().map(|(case, n)| (case.settings, &n[..4])).collect();
    assert!(failed.is_empty(), "{name}: {failed:?}");
    for compiler in build::compilers() {
        let program = program(["compare", name], compiler, &files, &[]);
        assert_eq!(differing(&program, &cases, &expected), None, "{name}, {compiler}");
    }
}

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn a_pyramid_of_double_gimbals_has_the_bits_of_rust() {
    compare("pyramid");
}

#[test]
fn wheels_a_panel_and_slosh_have_the_bits_of_rust() {
    compare("mixed");
}

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn flexible_bearings_have_the_bits_of_rust() {
    compare("flexible");
}

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn every_other_kind_has_the_bits_of_rust() {
    compare("others");
}

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
    // From a step that the cheap bound accepts to ones that are refused, close to the limit.
    for k in 0..60 {
        let dt = 1e-3 * 1.15_f64.powi(k);
        cases.push(with(Settings { dt, steps: 1, ..all }, &|_| ()));
        cases.push(with(Settings { dt, steps: 1, modes: true, hub: 2, ..all }, &|_| ()));
    }
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
        let program = program(["singular", name], compiler, &files, &[]);
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
    // A mass, the mount of a device and the stiffness of the first joint, by their places.
    let devices = names.len();
    let places = [(0, -1.0), (11, 2.0), (11 + 9 * devices, -1.0), (11 + 9 * devices + 13, -1.0)];
    let broken = places.map(|(place, value)| {
        let mut numbers = good.numbers();
        numbers[place] = value;
        numbers
    });
    let numbers: Vec<_> = [good.numbers(), far.numbers()].into_iter().chain(broken).collect();
    for compiler in build::compilers() {
        let program = program(["parameters", name], compiler, &files, &[]);
        let found = build::run(&program, &numbers.concat());
        let statuses: Vec<_> = found.chunks(length).map(|own| [own[0], own[1]]).collect();
        let parameter = [1.0, 0.0];
        let expected = [[0.0, 0.0], [0.0, 3.0], parameter, parameter, parameter, parameter];
        assert_eq!(statuses, expected, "{compiler}");
    }
}

#[test]
fn the_example_of_the_page_runs_as_in_rust() {
    let example = include_str!("example.c");
    assert!(PAGE.contains(&format!("```c\n{example}```\n")), "docs/c.md shows another example");
    let files = files_of("bus", &["wheel_x".to_owned()], &["reaction_wheel"]);
    let [spin, omega] = example::in_rust();
    for compiler in build::compilers() {
        let folder = build::folder(&format!("solver_example_{compiler}"));
        let program = build::c(&folder, compiler, &files, &[("main.c", example)], &[]);
        let output = Command::new(program).output().expect("the program starts");
        let printed = String::from_utf8_lossy(&output.stdout);
        let numbers: Vec<f64> = printed.split_whitespace().flat_map(str::parse).collect();
        assert_eq!(numbers, [spin, omega], "{compiler}: {printed}");
    }
}

/// All sources as one: names of one file are not those of another.
#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn the_sources_are_one_translation_unit_too() {
    let (name, names) = SETS[1];
    let (sources, headers): (Vec<_>, Vec<_>) =
        files(name, names).into_iter().partition(|file| file.path.ends_with(".c"));
    let text = sources.into_iter().map(|file| file.text).collect();
    let files: Vec<_> =
        headers.into_iter().chain([EmittedFile { path: "all.c".to_owned(), text }]).collect();
    let cases = cases(names);
    let expected: Vec<_> = cases.iter().map(reference).collect();
    for compiler in build::compilers() {
        let program = program(["one", name], compiler, &files, &[]);
        assert_eq!(differing(&program, &cases, &expected), None, "{compiler}");
    }
}

/// Clang needs nothing but itself for that; GCC's C++ is a package of its own.
#[test]
fn the_files_are_good_cpp_too() {
    if !build::compilers().contains(&"clang") {
        return;
    }
    let (name, names) = SETS[1];
    let (at, files) = (build::folder("solver_cpp"), files(name, names));
    for file in &files {
        fs::write(at.join(&file.path), &file.text).expect("an emitted file");
    }
    let mut clang = Command::new("clang");
    clang.args(["-x", "c++", "-std=c++17", "-fsyntax-only", "-Wall", "-Wextra", "-pedantic"]);
    let paths = files.iter().map(|file| &file.path);
    let output = clang.arg("-Werror").args(paths).current_dir(&at).output().expect("clang");
    assert!(output.status.success(), "{output:?}");
}

/// One operation in another order, in each file written by hand: the comparison sees it.
#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn a_sum_in_another_order_is_noticed() {
    let (name, names) = SETS[1];
    let (cases, files) = (cases(names), files(name, names));
    let expected: Vec<_> = cases.iter().map(reference).collect();
    let Some(compiler) = build::compilers().first().copied() else { return };
    for (path, right, wrong) in [
        (
            "precess_joint.c",
            "spring + (viscous - passive->coulomb * q[0] * (1.0 / root))",
            "spring + viscous - passive->coulomb * q[0] * (1.0 / root)",
        ),
        ("precess_gravity.c", "powers[1] = powers[0] * per_r", "powers[1] = mu * (per_r * per_r)"),
        ("precess_attitude.c", "1.0 - (s2 * q[2] + s3 * q[3])", "1.0 - s2 * q[2] - s3 * q[3]"),
        ("precess_device.c", "drives[k].torque + along", "drives[k].torque - along"),
        (
            "precess_evaluation.c",
            "force[k] = force[k] + third[k]",
            "force[k] = force[k] + 0.0 * third[k]",
        ),
        (
            "mixed.c",
            "start[k] + (0.0 + offset * s)",
            "start[k] + weight * s + (offset - weight) * s",
        ),
    ] {
        let mut files = files.clone();
        let file = files.iter_mut().find(|file| file.path == path).expect("a file");
        assert!(file.text.contains(right), "{path}: {right}");
        file.text = file.text.replacen(right, wrong, 1);
        let program = program(["mutants", name], compiler, &files, &[]);
        let noticed = differing(&program, &cases, &expected);
        assert!(noticed.is_some(), "{path}: nothing seen");
    }
}
