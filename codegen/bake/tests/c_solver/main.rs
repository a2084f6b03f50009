//! The emitted C solver of sets of kinds: accelerations, statuses and a thousand steps have the bits of the Rust library.
//!
//! The C is compiled by each compiler at hand with the warnings of its page as errors, once with sanitisers.

mod batch;
#[allow(dead_code, reason = "shared with the suite of the kernels")]
#[path = "../../../tests/c_kernels/build.rs"]
mod build;
mod case;
mod example;
mod jvp;
mod mutants;
#[allow(dead_code, reason = "shared with the suite of the kernels")]
#[path = "../../../tests/c_kernels/random.rs"]
mod random;
mod reference;
mod refused;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use precess_bake::{Description, solver};
use precess_codegen::emit::EmittedFile;
use precess_description::{Body, Device, Hub};
use precess_dynamics::BuiltInKind;

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

/// The description of a set of devices with these names.
fn description(name: &str, devices: &[String], names: &[&str]) -> Description {
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
    Description {
        format: precess_description::FORMAT,
        name: name.to_owned(),
        title: String::new(),
        hub: Hub { mass: 1.0, centre_of_mass: [0.0; 3], inertia: zero },
        device: devices.iter().zip(kinds(names)).map(device).collect(),
    }
}

/// What is emitted of a set of devices with these names.
fn files_of(name: &str, devices: &[String], names: &[&str]) -> Vec<EmittedFile> {
    let files = solver(&description(name, devices, names)).expect("a solver");
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
fn differing(program: &Path, cases: &[Case], expected: &[Vec<f64>]) -> Option<String> {
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
    // Angles of joints that have turned for hours, up to those that the C takes: whole turns are taken
    // away to the same bits.
    for k in 0..SPACECRAFT {
        let mut case = Case::random(&kinds, Settings { mrp: k == 0, ..PLAIN }, &mut random);
        let reach = if k % 2 == 0 { 20.0 } else { 1.6e7 };
        let joints = kinds.iter().flat_map(|kind| kind.joints()).zip(&mut case.joints);
        for (_, joint) in joints.filter(|(info, _)| !info.slides) {
            joint.coordinate = random.within(-reach, reach);
        }
        cases.push(case);
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
    let (sources, headers): (Vec<_>, Vec<_>) = files(name, names)
        .into_iter()
        .partition(|file| file.path.split('.').next_back() == Some("c"));
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
