//! Requirements on margins: what is found, and how `precess margins` ends by them.

use std::fs;
use std::path::Path;
use std::process::Command;

use precess::scenario::LoopMargin;

use super::{BUS, controller, loop_of, read};

/// Rounding of decibels.
const ROUNDING: f64 = 1e-12;

fn with(requirements: &[(&str, &str)]) -> String {
    let tables = requirements.iter().map(|(margin, least)| {
        format!(
            "[[requirement]]\nname = \"own {margin}\"\ncontroller = \"aocs\"\n\
             margin = \"{margin}\"\nleast = \"{least}\"\n"
        )
    });
    let tables: String = tables.collect();
    format!("{BUS}{}{tables}", controller("delay = \"50 ms\""))
}

#[test]
fn a_requirement_has_the_smallest_margin_of_the_axes() {
    let scenario = read(&with(&[("gain", "6 dB"), ("phase", "89 deg"), ("delay", "1 ms")]));
    let analysis = loop_of(&scenario).analysis().expect("an analysis");
    let axes = analysis.axes.as_ref().expect("stable");
    let up = axes.iter().filter_map(|of| of.gain_up).map(|of| of.value).fold(9e9, f64::min);
    let phase = axes.iter().filter_map(|of| of.phase).map(|of| of.value).fold(9e9, f64::min);
    assert!(axes.iter().all(|of| of.gain_down.is_none()), "double integrators");
    let found = analysis.least(LoopMargin::Gain).expect("a gain");
    assert!((found - 20.0 * up.log10()).abs() < ROUNDING, "{found} {up}");
    assert_eq!(analysis.least(LoopMargin::Phase), Some(phase));
    assert_eq!(analysis.least(LoopMargin::Delay), analysis.delay);
    assert!(analysis.verdicts(&scenario, "another").is_empty());
    let states: Vec<_> =
        analysis.verdicts(&scenario, "aocs").iter().map(|of| of.state.word()).collect();
    assert_eq!(states, ["met", "violated", "met"]);
    let unstable = read(&with(&[("gain", "0 dB")]).replace("\"50 ms\"", "\"3 s\""));
    let analysis = loop_of(&unstable).analysis().expect("an analysis");
    assert!(!analysis.stable);
    assert_eq!(analysis.least(LoopMargin::Gain), Some(0.0));
    assert!(analysis.verdicts(&unstable, "aocs")[0].state.is_violated());
}

#[test]
fn the_command_ends_by_requirements() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("margin-requirements");
    fs::create_dir_all(&folder).expect("a folder");
    let run = |requirements: &[(&str, &str)], options: &[&str]| {
        fs::write(folder.join("bus.toml"), with(requirements)).expect("written");
        let mut command = Command::new(env!("CARGO_BIN_EXE_precess"));
        command.current_dir(&folder).args(["margins", "bus.toml", "--force", "--out", "out"]);
        let done = command.args(options).output().expect("it runs");
        let said = String::from_utf8(done.stdout).expect("a text");
        (done.status.code(), said)
    };
    let (code, _) = run(&[], &[]);
    assert_eq!(code, Some(0), "6 dB and 30 degrees");
    let (code, said) = run(&[("delay", "2 s"), ("phase", "10 deg")], &[]);
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("requirement own delay: delay margin "), "{said}");
    assert!(said.contains("at least 2 s: violated"), "{said}");
    assert!(said.contains("at least 10 deg: met"), "{said}");
    let page = fs::read_to_string(folder.join("out/bus-margins.html")).expect("a page");
    assert!(page.contains("own delay"), "the page names it");
    let (code, _) = run(&[("phase", "80 deg")], &[]);
    assert_eq!(code, Some(2), "each axis is to have it");
    let (code, _) = run(&[("gain", "1 dB")], &["--gain-margin", "40"]);
    assert_eq!(code, Some(2), "an option is before a requirement");
}
