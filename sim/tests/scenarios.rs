//! Every file of `scenarios` is read, written, read back and run; every scenario on the page is
//! read.

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use precess::engine::run;
use precess::file::{from_file, from_toml, to_toml};
use precess::record::{Columns, End, Outcome, RecorderGroup, RunError, Statistics};
use precess::scenario::{IntegratorChoice, Scenario};
use precess_dynamics::{BuiltInKind, SolveError};

/// Longer runs are cut to this, s, unless a description says that they end in an error.
const SHORT: f64 = 0.2;
/// The sentences with which a description says how the run ends.
const FINISHED: &str = "It runs to its duration.";
const FAILED: &str = "It ends in an error of the solver.";

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenarios")
}

/// The scenario files, in the order of their names.
fn files() -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder()).expect("the folder of scenarios");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    let mut files: Vec<_> =
        paths.filter(|path| path.extension().is_some_and(|ext| ext == "toml")).collect();
    files.sort();
    assert!(files.len() >= 18, "{files:?}");
    files
}

fn read(path: &Path) -> Scenario {
    let read = from_file(path, &[]);
    read.unwrap_or_else(|errors| panic!("{}:\n{errors}", path.display())).0
}

/// Runs a scenario with the statistics of its requirements.
fn run_of(scenario: &Scenario) -> (Outcome, Statistics) {
    let mut statistics = Statistics::new(&scenario.requirements);
    let mut recorders = RecorderGroup::new(vec![&mut statistics]);
    let outcome = run(scenario, &mut recorders, &mut |_| ControlFlow::Continue(()));
    let outcome = outcome.unwrap_or_else(|error| panic!("{}: {error}", scenario.name));
    (outcome, statistics)
}

/// The same scenario, over by `SHORT`.
fn shortened(scenario: &Scenario) -> Scenario {
    let mut short = scenario.clone();
    let duration = short.settings.duration.min(SHORT);
    short.settings.duration = duration;
    short.output.rate = short.output.rate.max(1.0 / duration);
    short.changes.retain(|change| change.time <= duration);
    short.requirements.clear();
    if let IntegratorChoice::Rk4 { step } = &mut short.settings.integrator {
        *step = step.min(duration);
    }
    short
}

#[test]
fn each_file_is_named_and_described() {
    for path in files() {
        let scenario = read(&path);
        let stem = path.file_stem().and_then(|stem| stem.to_str()).expect("a name");
        assert_eq!(scenario.name, stem);
        assert_ne!(scenario.title, scenario.name, "{stem} has a title");
        let ends = scenario.description.ends_with(FINISHED);
        assert!(ends || scenario.description.ends_with(FAILED), "{}", scenario.description);
    }
}

#[test]
fn each_file_is_written_and_read_back_the_same() {
    for path in files() {
        let first = read(&path);
        let written = to_toml(&first);
        let again = from_toml("written.toml", &written, Path::new(""));
        let (second, _) = again.unwrap_or_else(|errors| panic!("{errors}\n{written}"));
        assert_eq!(to_toml(&second), written);
        // The text by itself could lack something: the parts, too.
        assert_eq!(second.name, first.name);
        assert_eq!(second.hub, first.hub);
        assert_eq!(second.hub_size, first.hub_size);
        assert_eq!(second.names, first.names);
        assert_eq!(second.devices, first.devices);
        assert_eq!(second.initial, first.initial, "{}", first.name);
        assert_eq!(second.hub_mode, first.hub_mode);
        assert_eq!(second.gravity, first.gravity);
        assert_eq!(second.drives, first.drives);
        assert_eq!(second.stops, first.stops);
        assert_eq!(second.wrenches, first.wrenches);
        assert_eq!(second.changes, first.changes);
        assert_eq!(second.crossings, first.crossings);
        assert_eq!(second.settings, first.settings);
        // The default, no selection, is written out.
        let columns = |of: &Scenario| Columns::from_scenario(of).expect("known columns");
        assert_eq!(columns(&second), columns(&first));
        assert_eq!(second.output.rate.to_bits(), first.output.rate.to_bits());
        assert_eq!(second.output.formats, first.output.formats);
        assert_eq!(second.requirements, first.requirements);
    }
}

#[test]
fn each_file_runs_and_ends_as_it_says() {
    for path in files() {
        let scenario = read(&path);
        let fails = scenario.description.ends_with(FAILED);
        let scenario = if fails { scenario } else { shortened(&scenario) };
        let (outcome, _) = run_of(&scenario);
        let name = &scenario.name;
        match &outcome.end {
            End::Finished => {
                assert!(!fails, "{name} ends in no error");
                assert_eq!(outcome.end_time, scenario.settings.duration, "{name}");
            }
            End::Failed(error) => assert!(fails, "{name}: {error}"),
            other => panic!("{name}: {other}"),
        }
        assert!(outcome.samples > 0, "{name}");
        let energy = outcome.drift.energy.expect("energy is always counted");
        assert!(fails || energy < 1e-9, "{name}: energy drifts by {energy:e}");
    }
}

/// The outer gimbal's, at the right angle: sqrt(pi / 0.5 rad/s^2) = 2.50663 s, less what the inner
/// gimbal takes for the 2e-7 rad before it that the solver rejects.
#[test]
fn gimbal_lock_ends_in_the_error_of_a_singular_pose() {
    let (outcome, _) = run_of(&read(&folder().join("gimbal-lock.toml")));
    let End::Failed(error) = &outcome.end else { panic!("{}", outcome.end) };
    let RunError::Solve { time, device, source } = error else { panic!("{error}") };
    assert_eq!(device.as_deref(), Some("cmg"));
    let SolveError::Singular { joint, .. } = source else { panic!("{error}") };
    assert_eq!(*joint, Some("outer gimbal"), "{error}");
    let expected = (std::f64::consts::PI / 0.5).sqrt();
    assert!((time - expected).abs() < 1e-6, "{time} s, {expected} s");
}

#[test]
fn every_kind_is_in_every_kind() {
    let scenario = read(&folder().join("every-kind.toml"));
    let kinds: Vec<_> = scenario.devices.0.iter().map(precess_dynamics::BuiltIn::kind).collect();
    for kind in BuiltInKind::ALL {
        let count = kinds.iter().filter(|found| **found == *kind).count();
        assert_eq!(count, 1, "{}", kind.name());
    }
}

#[test]
fn brake_and_latch_take_the_energy_that_they_should() {
    // The inner gimbal turns at 0.2 rad/s; what its brake takes is half its share of inertia times
    // that squared, less than with all that it carries at rest: (0.05 + 0.0114) kg m^2.
    let (outcome, _) = run_of(&read(&folder().join("locked-gimbal.toml")));
    let most = 0.5 * (0.05 + 0.0114) * 0.2 * 0.2;
    assert!(0.9 * most < outcome.energy_lost && outcome.energy_lost <= most, "{outcome:?}");
    assert_eq!(outcome.events.len(), 2, "{:?}", outcome.events);
    // The latch takes what the spring has done less what friction took: at most the spring's
    // energy.
    let (outcome, _) = run_of(&read(&folder().join("panel-deployment.toml")));
    let spring = |from_rest: f64| 0.5 * 0.2 * from_rest.to_radians().powi(2);
    let most = spring(120.0) - spring(30.0);
    assert!(0.5 * most < outcome.energy_lost && outcome.energy_lost < most, "{outcome:?}");
    assert!(outcome.events.iter().any(|event| event.text.contains("panel.phi")));
}

#[test]
fn a_wheel_breaks_away_and_sticks_again() {
    let (outcome, _) = run_of(&read(&folder().join("sticking-wheel.toml")));
    let found: Vec<_> = outcome.events.iter().map(|event| event.text.as_str()).collect();
    let words = ["wheel.theta: slides", "wheel.theta: driven by a torque", "wheel.theta: sticks"];
    assert_eq!(found, words);
    // 0.8 mN m of a ramp of 1 mN m/s.
    assert!((outcome.events[0].time - 0.8).abs() < 1e-9, "{:?}", outcome.events);
    let drift = &outcome.drift;
    for part in [drift.energy, drift.linear, drift.angular] {
        assert!(part.is_some_and(|part| part < 1e-12), "{drift:?}");
    }
}

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn examples_with_requirements_meet_them() {
    for path in files() {
        let scenario = read(&path);
        if scenario.requirements.is_empty() {
            continue;
        }
        let (outcome, statistics) = run_of(&scenario);
        assert!(matches!(outcome.end, End::Finished), "{}: {}", scenario.name, outcome.end);
        for verdict in statistics.verdicts() {
            let (unit, size) = &verdict.unit;
            let value = verdict.value.map(|value| value / size);
            println!(
                "{}: {} {value:?} of {} {unit}",
                scenario.name,
                verdict.name,
                verdict.limit / size
            );
            assert!(verdict.is_met(), "{}: {verdict:?}", scenario.name);
        }
    }
}

#[test]
fn every_scenario_on_the_page_is_read() {
    let page = folder().join("../docs/scenarios.md");
    let text = std::fs::read_to_string(&page).expect("the page");
    let blocks = text.split("```toml\n").skip(1).filter_map(|rest| rest.split("```").next());
    let mut count = 0;
    for block in blocks.filter(|block| block.trim_start().starts_with("format = 1")) {
        let read = from_toml("docs/scenarios.md", block, &folder());
        let (scenario, _) = read.unwrap_or_else(|errors| panic!("{errors}\n{block}"));
        let (outcome, _) = run_of(&shortened(&scenario));
        assert!(outcome.end.is_complete(), "{}\n{block}", outcome.end);
        count += 1;
    }
    assert!(count >= 3, "{count} scenarios on the page");
}
