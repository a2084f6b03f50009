//! Units that run the engine: outputs have the bits of a run, inputs act, descriptions are of Co-Simulation alone, and their C
//! has no warning.

use std::fs;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::process::Command;

use precess::engine::{self, CoupledRun};
use precess::file::{from_filled, from_toml};
use precess::fmu::{EngineFmu, FmiVersion, Fmu, FmuError};
use precess::record::{RunError, Samples};
use precess::scenario::Scenario;

use super::compiled::{FLAGS, compile, compilers, numbers};
use super::described::{elements, variables};
use super::{UNIT, scenario};

/// A scenario of the folder with parts of its text replaced.
pub(super) fn of_file(name: &str, changes: &[(&str, &str)]) -> Scenario {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenarios");
    let mut text = fs::read_to_string(folder.join(name)).expect("a scenario");
    for (from, to) in changes {
        assert!(text.contains(from), "{from}");
        text = text.replace(from, to);
    }
    from_toml("bus-1", &text, &folder).unwrap_or_else(|errors| panic!("{errors}")).0
}

/// Four gyros under a controller, into the slew.
fn pyramid() -> Scenario {
    let run = "duration = \"2.5 s\"\nintegrator = \"rk4\"\nstep = \"2 ms\"";
    of_file("gyro-pyramid-slew.toml", &[("duration = \"40 s\"", run), ("\"30 s\"", "\"1 s\"")])
}

/// Four wheels on an isolated platform.
pub(super) fn isolator() -> Scenario {
    let run = "duration = \"0.2 s\"\nintegrator = \"rk4\"\nstep = \"0.5 ms\"";
    of_file("wheels-on-isolator.toml", &[("duration = \"18 s\"", run), ("tolerance = 1e-10", "")])
}

/// Four gyros with locked gimbals on a structure of twenty modes, which are in a file.
pub(super) fn imaging() -> Scenario {
    let run = "duration = \"60 ms\"\nintegrator = \"rk4\"\nstep = \"0.1 ms\"";
    let window = "from = \"10 ms\"\nto = \"60 ms\"";
    let changes =
        [("duration = \"2 s\"\ntolerance = 1e-9", run), ("from = \"1 s\"\nto = \"2 s\"", window)];
    of_file("imaging-satellite-flexible.toml", &changes)
}

/// Four wheels on a flexible structure under a controller, into the slew.
pub(super) fn flexible_slew() -> Scenario {
    let run = "duration = \"3 s\"\nintegrator = \"rk4\"\nstep = \"2 ms\"";
    of_file("flexible-slew.toml", &[("duration = \"80 s\"", run), ("\"70 s\"", "\"1 s\"")])
}

/// A wheel and a panel; the torque of the wheel's motor changes within the run.
pub(super) fn changed() -> Scenario {
    scenario(
        &(UNIT.to_owned()
            + "[[at]]\ntime = \"30.5 ms\"\njoint = \"rw.wheel\"\ntorque = \"-50 mN m\"\n"),
    )
}

/// The scenario that the unit's library reads.
pub(super) fn read_again(scenario: &Scenario) -> Scenario {
    let read = from_filled("scenario", &scenario.source.filled);
    read.unwrap_or_else(|errors| panic!("{errors}")).0
}

/// The inputs that the unit's description starts with.
pub(super) fn starts(scenario: &Scenario, run: &CoupledRun<'_>) -> Vec<f64> {
    let on_hub = vec![0.0; run.input_count() - run.motors().len()];
    let motors = run.motors().iter().map(|joint| {
        let drive = &scenario.drives[*joint];
        drive.limits().clipped(drive.profile().expect("a torque").at(0.0, false))
    });
    on_hub.into_iter().chain(motors).collect()
}

#[test]
fn outputs_of_a_coupled_run_have_the_bits_of_a_run() {
    // Of the isolated platform the six axes, too; of gyros with locked gimbals the wheels. Nothing acts on the hub of a
    // flexible structure.
    for (scenario, on_hub, motors) in [
        (pyramid(), 6, 0),
        (isolator(), 6, 10),
        (imaging(), 0, 4),
        (flexible_slew(), 0, 0),
        (changed(), 6, 2),
    ] {
        let mut samples = Samples::default();
        let goes_on = &mut |_| ControlFlow::Continue(());
        engine::run(&scenario, &mut samples, goes_on).expect("a run");
        let scenario = read_again(&scenario);
        let mut run = CoupledRun::new(&scenario).expect("a run");
        let inputs = starts(&scenario, &run);
        assert_eq!((run.motors().len(), run.input_count()), (motors, on_hub + motors));
        assert_eq!(run.input_count(), inputs.len());
        assert!(samples.rows.len() > 100);
        for (index, row) in samples.rows.iter().enumerate() {
            let time = f64::from(u32::try_from(index).expect("few")) / scenario.output.rate;
            assert!(run.advance(&inputs, time).expect("a step"), "{time}");
            let outputs = run.outputs(&inputs).expect("outputs");
            for ((found, expected), of) in
                outputs.iter().zip(row).zip(&samples.header.as_ref().expect("a header").columns)
            {
                assert_eq!(
                    found.to_bits(),
                    expected.to_bits(),
                    "{} at {time} s: {found:e} and {expected:e}",
                    of.name
                );
            }
            assert_eq!(outputs.len(), row.len());
        }
        let end = scenario.settings.duration;
        assert!(
            !run.advance(&inputs, end + 0.1).expect("the end"),
            "there is nothing after the end"
        );
    }
}

#[test]
fn inputs_of_a_coupled_run_act_as_those_of_a_scenario() {
    let free = UNIT.replace(
        "torque = \"0.3 N m\"\ntorque_limit = \"0.2 N m\"\n",
        "torque_limit = \"0.2 N m\"\n",
    );
    let pushed = UNIT.to_owned()
        + "[[wrench]]\non = \"hub\"\nforce = \"3, -2, 1 N\"\nmoment = \"0.1, 0.2, -0.3 N m\"\n";
    let (free, pushed) = (scenario(&free), scenario(&pushed));
    let mut given = CoupledRun::new(&free).expect("a run");
    let mut stated = CoupledRun::new(&pushed).expect("a run");
    // Beyond the limit of the motor.
    let inputs = [3.0, -2.0, 1.0, 0.1, 0.2, -0.3, 0.3, 0.0];
    let nothing = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.3, 0.0];
    assert!(given.advance(&inputs, 0.05).expect("a step"));
    assert!(stated.advance(&nothing, 0.05).expect("a step"));
    let names: Vec<_> = given.columns().iter().map(|of| of.name.clone()).collect();
    let (given, stated) =
        (given.outputs(&inputs).expect("outputs"), stated.outputs(&nothing).expect("outputs"));
    for ((name, a), b) in names.iter().zip(given).zip(stated) {
        let is_close = (a - b).abs() <= 1e-13 * (1.0 + b.abs());
        assert!(is_close, "{name}: {a} and {b}");
    }
    let moved = names.iter().position(|name| name == "velocity_x").expect("a column");
    assert!(given[moved].abs() > 1e-4, "{}", given[moved]);
}

#[test]
fn other_inputs_than_a_coupled_run_takes_are_refused() {
    let scenario = scenario(UNIT);
    let mut run = CoupledRun::new(&scenario).expect("a run");
    for inputs in [&[0.0; 7][..], &[f64::NAN; 8]] {
        let error = run.advance(inputs, 0.01).expect_err("it is refused");
        assert!(matches!(error, RunError::Inputs { expected: 8, .. }), "{error}");
    }
}

#[test]
fn a_unit_that_runs_the_engine_is_for_co_simulation_alone() {
    for scenario in [pyramid(), isolator(), imaging(), flexible_slew()] {
        let why = Fmu::new(&scenario).expect_err("it cannot be sources");
        assert!(!matches!(why, FmuError::Tolerance), "{why}");
        let unit = EngineFmu::new(&scenario).expect("a unit");
        for version in FmiVersion::ALL {
            let document = unit.description(version);
            let found = variables(version, &document);
            assert_eq!(found.len(), unit.variable_count());
            let of = |causality: &str| {
                found.iter().filter(|(of, _)| of["causality"] == causality).count()
            };
            let outputs = of("output");
            assert_eq!((of("independent"), of("parameter")), (1, 0));
            assert_eq!(of("input"), found.len() - 1 - outputs);
            assert!(!document.contains("<ModelExchange") && document.contains("<CoSimulation"));
            let (saves, unknown) = match version {
                FmiVersion::Two => ("canGetAndSetFMUstate", "Unknown"),
                FmiVersion::Three => ("canGetAndSetFMUState", "InitialUnknown"),
            };
            assert_eq!(elements(&document, "CoSimulation")[0][saves], "true");
            let times = if version == FmiVersion::Two { 2 } else { 1 };
            assert_eq!(elements(&document, unknown).len(), times * outputs);
            let spoken = elements(&document, "fmiModelDescription").remove(0);
            let token = spoken.get("guid").or(spoken.get("instantiationToken")).expect("a token");
            let sources = unit.sources(version);
            let (_, header) = sources.iter().find(|(name, _)| name == "model.h").expect("a header");
            assert!(header.contains(token.as_str()));
            assert!(header.contains(&format!("#define FMU_OUTPUTS {outputs}\n")));
        }
    }
}

#[test]
fn what_an_engine_would_need_beside_the_scenario_is_refused() {
    let tolerance = scenario(&UNIT.replace("integrator = \"rk4\"\nstep = \"1 ms\"\n", ""));
    assert_eq!(EngineFmu::new(&tolerance).err(), Some(FmuError::Tolerance));
    let law = "kind = \"eigen_axis\"\nfrequency = \"0.15 Hz\"\ndamping_ratio = 0.8";
    let program = "kind = \"program\"\ncommand = [\"law\"]";
    let run = "duration = \"80 s\"\nintegrator = \"rk4\"\nstep = \"2 ms\"";
    let scenario = of_file("flexible-slew.toml", &[(law, program), ("duration = \"80 s\"", run)]);
    assert_eq!(EngineFmu::new(&scenario).err(), Some(FmuError::Program("aocs".to_owned())));
}

#[test]
fn a_change_of_a_drive_that_takes_the_place_of_an_input_is_noted() {
    let notes = EngineFmu::new(&changed()).expect("a unit").notes().join("\n");
    assert!(notes.contains("changes the drive of rw.theta at 0.0305 s"), "{notes}");
    assert_eq!(EngineFmu::new(&scenario(UNIT)).expect("a unit").notes(), [""; 0]);
}

/// A folder with the C over the engine, and the names of what is compiled.
fn c_over_engine(name: &str, version: FmiVersion, unit: &EngineFmu) -> (PathBuf, Vec<String>) {
    let folder: PathBuf = Path::new(env!("CARGO_TARGET_TMPDIR")).join("fmu").join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("a folder");
    let mut compiled = Vec::new();
    for (name, text) in unit.sources(version) {
        fs::write(folder.join(&name), text).expect("a source");
        if Path::new(&name).extension() == Some("c".as_ref()) {
            compiled.push(name);
        }
    }
    (folder, compiled)
}

#[test]
fn the_c_over_the_engine_has_no_warning() {
    // With inputs, and without.
    let units = [pyramid(), flexible_slew()].map(|of| EngineFmu::new(&of).expect("a unit"));
    for (unit, version) in units.iter().zip(FmiVersion::ALL) {
        for compiler in compilers() {
            let name = format!("engine_{compiler}_{}", version.text());
            let (folder, compiled) = c_over_engine(&name, version, unit);
            let mut command = Command::new(compiler);
            let command = command.current_dir(&folder).args(FLAGS).arg("-c").args(compiled);
            let done = command.output().expect("the compiler starts");
            assert!(done.status.success(), "{compiler}: {}", String::from_utf8_lossy(&done.stderr));
        }
    }
}

/// By a driver that has an engine of its own in the place of ours.
#[test]
fn the_c_over_the_engine_copies_states() {
    let unit = EngineFmu::new(&changed()).expect("a unit");
    for compiler in compilers() {
        let name = format!("engine_states_{compiler}");
        let (folder, mut compiled) = c_over_engine(&name, FmiVersion::Two, &unit);
        fs::write(folder.join("driver_engine.c"), include_str!("driver_engine.c"))
            .expect("written");
        compiled.push("driver_engine.c".to_owned());
        let sanitisers: &[_] = if compiler == "gcc" {
            &["-fsanitize=address,undefined", "-fno-sanitize-recover=all"]
        } else {
            &["-fsanitize=undefined", "-fsanitize-undefined-trap-on-error"]
        };
        let arguments = [&FLAGS[..], sanitisers, &["-o", "driver"]].concat();
        let done = compile(compiler, &folder, &arguments, &compiled);
        assert!(done.status.success(), "{compiler}: {}", String::from_utf8_lossy(&done.stderr));
        assert_eq!(numbers(&folder, &[]), [0.0; 0], "{compiler}");
    }
}
