//! The C of a unit: without a warning, with the bits of a run, and with a status for every call out of order.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use precess::engine;
use precess::fmu::{FmiVersion, compiler_arguments, headers};
use precess::record::Samples;

use super::{UNIT, files, scenario};

pub(super) const FLAGS: [&str; 8] = [
    "-std=c99",
    "-O2",
    "-ffp-contract=off",
    "-Wall",
    "-Wextra",
    "-Wpedantic",
    "-Wconversion",
    "-Werror",
];
/// The end stops of the unit's panel.
const STOPS: &str = "lower_stop = \"-20 deg\"\nupper_stop = \"20 deg\"\nat_stop = \"end\"\n";
/// Steps of 1 ms that the driver and the run take.
const STEPS: usize = 100;

/// The compilers that this machine has; one that is missing is named, or refused.
pub(super) fn compilers() -> Vec<&'static str> {
    let is_there = |name: &&str| {
        let asked = Command::new(name).arg("--version").output();
        let is_there = asked.is_ok_and(|output| output.status.success());
        if !is_there {
            let skipped =
                format!("skipped: {name} (install with: apt-get install {name} libc6-dev)");
            let required =
                std::env::var_os("PRECESS_REQUIRE_ALL").is_some_and(|value| value == "1");
            assert!(!required, "{skipped}");
            eprintln!("{skipped}");
        }
        is_there
    };
    ["gcc", "clang"].into_iter().filter(is_there).collect()
}

/// An importer of a version: names and texts of its files.
fn driver(version: FmiVersion) -> &'static [(&'static str, &'static str)] {
    match version {
        FmiVersion::Two => &[("driver_fmi2.c", include_str!("driver_fmi2.c"))],
        FmiVersion::Three => &[
            ("driver_fmi3.c", include_str!("driver_fmi3.c")),
            ("driver_fmi3.h", include_str!("driver_fmi3.h")),
            ("driver_fmi3_refused.c", include_str!("driver_fmi3_refused.c")),
        ],
    }
}

/// A folder with the sources of the unit and the standard's headers, and the names of what is compiled.
pub(super) fn sources(version: FmiVersion, name: &str, unit: &str) -> (PathBuf, Vec<String>) {
    let name = format!("{name}_{}", version.text());
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("fmu").join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("a folder");
    let (_, files) = files(version, &scenario(unit));
    let mut compiled = Vec::new();
    for (name, text) in headers(version) {
        fs::write(folder.join(name), text).expect("a header");
    }
    for (path, text) in &files {
        let Some(name) = path.strip_prefix("sources/") else { continue };
        fs::write(folder.join(name), text).expect("a source");
        if Path::new(name).extension() == Some("c".as_ref()) {
            compiled.push(name.to_owned());
        }
    }
    (folder, compiled)
}

pub(super) fn compile(
    compiler: &str,
    folder: &Path,
    arguments: &[&str],
    sources: &[String],
) -> Output {
    let mut command = Command::new(compiler);
    command.current_dir(folder).args(arguments).args(sources);
    command.args(["-lm"]).output().expect("the compiler starts")
}

/// The states at the end of a run, in the order of the unit.
fn states() -> Vec<f64> {
    let mut samples = Samples::default();
    let goes_on = &mut |_| std::ops::ControlFlow::Continue(());
    engine::run(&scenario(UNIT), &mut samples, goes_on).expect("a run");
    let vector = |name: &str| ["x", "y", "z"].map(|axis| format!("{name}_{axis}"));
    let mut names = [vector("position"), vector("velocity")].concat();
    names.extend(["q0", "q1", "q2", "q3"].map(str::to_owned));
    names.extend(vector("omega"));
    names.extend(["rw.theta", "panel.phi", "rw.spin", "panel.phi_dot"].map(str::to_owned));
    let last = |name: &String| samples.column(name).expect(name).last().copied();
    names.iter().map(|name| last(name).expect("a sample")).collect()
}

#[test]
fn co_simulation_has_the_bits_of_a_run_and_calls_out_of_order_are_errors() {
    let expected = states();
    for version in FmiVersion::ALL {
        for compiler in compilers() {
            has_the_bits(version, compiler, &expected);
        }
    }
}

/// The importer of a version with the unit's sources, compiled: the folder, in which it is named `driver`.
fn importer(version: FmiVersion, name: &str, unit: &str, compiler: &str, more: &[&str]) -> PathBuf {
    let (folder, mut sources) = sources(version, name, unit);
    for (name, text) in driver(version) {
        fs::write(folder.join(name), text).expect("a source");
        if Path::new(name).extension() == Some("c".as_ref()) {
            sources.push((*name).to_owned());
        }
    }
    let arguments = [&FLAGS, more, &["-o", "driver"]].concat();
    let done = compile(compiler, &folder, &arguments, &sources);
    assert!(done.status.success(), "{compiler}: {}", String::from_utf8_lossy(&done.stderr));
    folder
}

/// What an importer writes: numbers.
pub(super) fn numbers(folder: &Path, arguments: &[&str]) -> Vec<f64> {
    let done = Command::new(folder.join("driver")).args(arguments).output();
    let done = done.expect("the driver starts");
    let errors = String::from_utf8_lossy(&done.stderr);
    assert!(done.status.success(), "{}, {arguments:?}: {} {errors}", folder.display(), done.status);
    let (numbers, rest) = done.stdout.as_chunks();
    assert!(rest.is_empty());
    numbers.iter().map(|bytes| f64::from_ne_bytes(*bytes)).collect()
}

/// The driver by a compiler, without sanitisers and with: every check holds, and the states have the bits.
fn has_the_bits(version: FmiVersion, compiler: &str, expected: &[f64]) {
    let sanitisers: [&[&str]; 2] = [
        &[],
        if compiler == "gcc" {
            &["-fsanitize=address,undefined", "-fno-sanitize-recover=all"]
        } else {
            &["-fsanitize=undefined", "-fsanitize-undefined-trap-on-error"]
        },
    ];
    for (number, more) in sanitisers.into_iter().enumerate() {
        let folder = importer(version, &format!("{compiler}_{number}"), UNIT, compiler, more);
        let found = numbers(&folder, &[&STEPS.to_string()]);
        let bits = |numbers: &[f64]| numbers.iter().map(|of| of.to_bits()).collect::<Vec<_>>();
        assert_eq!(
            bits(&found),
            bits(expected),
            "{version}, {compiler}: {found:?} and {expected:?}"
        );
    }
}

/// A joint without a spring and one with end stops, both beyond half a turn, beside a wheel whose angle is brought back.
#[test]
fn an_angle_that_is_wrapped_leaves_the_others_as_they_are() {
    let Some(compiler) = compilers().into_iter().next() else { return };
    for (turns, stops) in [
        ("", "angle = \"440 deg\"\n"),
        (
            STOPS,
            "angle = \"440 deg\"\nlower_stop = \"400 deg\"\nupper_stop = \"450 deg\"\nat_stop = \"end\"\n",
        ),
    ] {
        let unit = UNIT.replace(STOPS, stops).replace("stiffness = \"3 N m/rad\"\n", "");
        for version in FmiVersion::ALL {
            let name = format!("wrapped_{}", turns.len());
            let folder = importer(version, &name, &unit, compiler, &[]);
            // 2^23 rad and half a turn.
            let numbers = numbers(&folder, &["0", "8388611.14"]);
            let (by_steps, by_event) = numbers.split_at(numbers.len() / 2);
            for states in [by_steps, by_event] {
                let (wheel, panel) = (states[13], states[14]);
                assert!(wheel.abs() <= std::f64::consts::PI, "{version}, the wheel: {wheel}");
                assert!(
                    (panel - 440_f64.to_radians()).abs() < 1e-3,
                    "{version}, the panel: {panel}"
                );
            }
        }
    }
}

#[test]
fn arithmetic_by_other_rules_is_refused() {
    for compiler in compilers() {
        let (folder, _) = sources(FmiVersion::Two, &format!("fast_{compiler}"), UNIT);
        let core = ["precess_fmu.c".to_owned()];
        let done = compile(compiler, &folder, &["-std=c99", "-ffast-math", "-c"], &core);
        let errors = String::from_utf8_lossy(&done.stderr);
        assert!(!done.status.success() && errors.contains("-ffast-math"), "{compiler}: {errors}");
    }
}

/// The functions that the headers of the standard declare.
fn declared(version: FmiVersion) -> Vec<String> {
    let (header, prefix) = match version {
        FmiVersion::Two => (include_str!("../../src/fmu/c/fmi2Functions.h"), "FMI2_Export"),
        FmiVersion::Three => (include_str!("../../src/fmu/c/fmi3Functions.h"), "FMI3_Export"),
    };
    let names = header.lines().filter_map(|line| line.trim().strip_prefix(prefix));
    let names = names.filter_map(|line| line.trim().strip_suffix(';')?.split_whitespace().last());
    names.map(str::to_owned).collect()
}

#[cfg(target_os = "linux")]
#[test]
fn every_function_of_the_standard_is_exported_and_no_other_symbol() {
    for (version, count) in FmiVersion::ALL.into_iter().zip([44, 75]) {
        let expected: std::collections::BTreeSet<_> = declared(version).into_iter().collect();
        assert_eq!(expected.len(), count, "{expected:?}");
        for compiler in compilers() {
            let (folder, sources) = sources(version, &format!("exported_{compiler}"), UNIT);
            let arguments = [compiler_arguments(), &["-o", "unit.so"]].concat();
            let done = compile(compiler, &folder, &arguments, &sources);
            assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
            let listed = Command::new("nm")
                .args(["-D", "--defined-only"])
                .arg(folder.join("unit.so"))
                .output();
            let listed =
                String::from_utf8(listed.expect("nm, of binutils").stdout).expect("a text");
            let found = listed.lines().filter_map(|line| line.split_whitespace().nth(2));
            let hidden = ["_init", "_fini", "_edata", "_end", "__bss_start"];
            let found = found.filter(|name| !hidden.contains(name)).map(str::to_owned);
            assert_eq!(
                found.collect::<std::collections::BTreeSet<_>>(),
                expected,
                "{version}, {compiler}"
            );
        }
    }
}
