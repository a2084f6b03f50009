//! Campaigns with controllers: side by side with the bits of a run by itself, at any number of threads; a changed program is
//! another campaign.

use std::fs;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use precess::campaign::{Reducer, Selection, run_reduced};
use precess::file::Template;

use super::{BUS, controller};

/// A controller with everything that it may have.
fn text() -> String {
    let keys = "delay = \"0.1 s\"\n\
        estimator = { attitude_deviation = \"1 mrad\", bias_deviation = \"1 mrad/s\" }\n\
        dumping = { gain = \"0.05 1/s\", torque_limit = \"10 mN m\" }\n\
        filter = [{ kind = \"low_pass\", frequency = \"1 Hz\" }]\n\
        allocation = { keep_out = [\"40, 60 rad/s\"] }\n\
        [controller.sensors]\nseed = 1\ntachometer_quantum = \"0.1 rad/s\"\n\
        gyro = { output = \"integrating\", angle_random_walk = \"1e-4 rad/sqrt(s)\", bias = \"1, 2, 3 mrad/s\" }\n\
        star_tracker = { noise = \"0.1 mrad\", rate = \"2 Hz\", latency = \"0.3 s\" }\n";
    let bus = BUS.replace("inertia = \"0.02,", "rate = \"50 rad/s\", inertia = \"0.02,");
    format!(
        "{bus}[initial]\nangular_velocity = \"0.02, -0.01, 0.05 rad/s\"\n{}\
         [run]\nduration = \"6 s\"\nintegrator = \"rk4\"\nstep = \"50 ms\"\n[output]\nrate = \"10 Hz\"\n",
        controller(keys, "")
    )
}

/// What each run differs in.
const CASES: [&str; 11] = [
    "hub.mass = \"100 kg\"",
    "hub.inertia = \"13, 11, 10 kg m^2\"",
    "controller.aocs.sensors.seed = 2",
    "controller.aocs.sensors.gyro.bias = \"0, 0, 0 deg/h\"",
    "controller.aocs.sensors.star_tracker.latency = \"0 s\"",
    "controller.aocs.rate = \"3 Hz\"",
    "controller.aocs.delay = \"0 s\"",
    "controller.aocs.law.attitude_gain = \"6 N m\"",
    "controller.aocs.dumping.gain = \"0.002 1/s\"",
    "controller.aocs.sensors.tachometer_quantum = \"2 rad/s\"",
    "device.rwz.wheel.rate = \"70 rad/s\"",
];

fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("control").join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("a folder");
    folder
}

fn path(of: &Path) -> &str {
    of.to_str().expect("text")
}

fn precess(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_precess")).args(arguments).output().expect("it starts")
}

fn bits(row: &[f64]) -> Vec<u64> {
    row.iter().map(|number| number.to_bits()).collect()
}

#[test]
fn each_run_side_by_side_has_the_bits_that_it_has_by_itself() {
    let file = folder("side-by-side").join("bus.toml");
    fs::write(&file, text()).expect("a file");
    let template = Template::from_file(&file).unwrap_or_else(|errors| panic!("{errors}"));
    let columns = ["omega", "aocs.torque", "aocs.measurement_error", "rwz.spin", "energy"];
    let columns = columns.map(str::to_owned);
    let selection = Selection { columns: columns.into(), lines: 0, from: 0.0 };
    let read = |case: &str| {
        let read = template.scenario(&[case.to_owned()]);
        read.unwrap_or_else(|errors| panic!("{case}: {errors}")).0
    };
    let scenarios: Vec<_> = CASES.iter().map(|case| read(case)).collect();
    let mut rows = Vec::new();
    let together = run_reduced(scenarios.clone(), &selection, &|| false);
    for ((case, mut scenario), found) in CASES.iter().zip(scenarios).zip(together) {
        let found = found.expect("not cancelled").expect("a row");
        scenario.output.columns.clone_from(&selection.columns);
        let mut reducer = Reducer::new(&scenario, &selection);
        let progress = &mut |_| ControlFlow::Continue(());
        let outcome = precess::engine::run(&scenario, &mut reducer, progress).expect("a run");
        assert!(outcome.end.is_complete(), "{case}: {}", outcome.end);
        assert_eq!(bits(&found), bits(&reducer.row().expect("numbers")), "{case}");
        rows.push(bits(&found));
    }
    let same = rows.iter().skip(1).filter(|row| **row == rows[0]).count();
    assert_eq!(same, 0, "what is varied acts");
}

/// Files of results, but for the journal, by name.
fn results(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let entries =
        fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path());
    let mut found: Vec<_> = entries
        .filter(|path| path.extension().is_some_and(|ext| ext == "csv" || ext == "npz"))
        .map(|path| {
            (
                path.file_name().expect("a name").to_string_lossy().into_owned(),
                fs::read(&path).expect("read"),
            )
        })
        .collect();
    found.sort();
    found
}

#[test]
fn sweeps_and_samples_do_not_depend_on_threads() {
    let folder = folder("threads");
    let file = folder.join("bus.toml");
    fs::write(&file, text()).expect("a file");
    let plan = folder.join("plan.toml");
    let drawn = "format = 1\n[[vary]]\nkey = \"controller.aocs.law.attitude_gain\"\ndistribution = \"uniform\"\n\
                 from = \"6 N m\"\nto = \"9 N m\"\n";
    fs::write(&plan, drawn).expect("a plan");
    for (name, arguments) in [
        ("sweep", vec!["sweep", path(&file), "--over", "controller.aocs.sensors.seed=1,2,3,4,5"]),
        (
            "montecarlo",
            vec!["montecarlo", path(&file), "--plan", path(&plan), "--samples", "6", "--seed", "1"],
        ),
    ] {
        let run = |threads: &str| {
            let out = folder.join(format!("{name}-{threads}"));
            let mut arguments = arguments.clone();
            arguments.extend(["--threads", threads, "--no-report", "--out", path(&out)]);
            let output = precess(&arguments);
            assert!(output.status.success(), "{name}: {}", String::from_utf8_lossy(&output.stderr));
            results(&out)
        };
        let one = run("1");
        assert!(!one.is_empty(), "{name}");
        assert!(run("4") == one, "{name}");
    }
}

#[test]
fn two_controllers_are_compared() {
    let folder = folder("compare");
    let (file, other) = (folder.join("bus.toml"), folder.join("other.toml"));
    fs::write(&file, text()).expect("a file");
    fs::write(&other, text().replace("delay = \"0.1 s\"", "delay = \"0.2 s\"")).expect("a file");
    let same = precess(&["compare", path(&file), path(&file)]);
    assert_eq!(same.status.code(), Some(0), "{}", String::from_utf8_lossy(&same.stderr));
    let output = precess(&["compare", path(&file), path(&other)]);
    let shown = String::from_utf8_lossy(&output.stdout).into_owned();
    assert_eq!(output.status.code(), Some(2), "{shown}{}", String::from_utf8_lossy(&output.stderr));
    assert!(shown.contains("aocs.torque"), "{shown}");
}

#[cfg(unix)]
#[test]
fn a_changed_program_is_another_campaign() {
    let folder = folder("program");
    let (file, law, out) = (folder.join("bus.toml"), folder.join("law.sh"), folder.join("out"));
    let script = "read -r greeting; while read -r line; do echo '{\"torque\":[0,0,0]}'; done\n";
    fs::write(&law, script).expect("a file");
    let text = text();
    let (before, after) = text.split_once("[controller.law]").expect("a law");
    let (_, after) = after.split_once("[controller.reference").expect("a reference");
    let program = "[controller.law]\nkind = \"program\"\ncommand = [\"sh\", \"law.sh\"]\n";
    fs::write(&file, format!("{before}{program}[controller.reference{after}")).expect("a file");
    let run = |more: &[&str]| {
        let mut arguments = vec![
            "sweep",
            path(&file),
            "--over",
            "hub.mass=100,110 kg",
            "--no-report",
            "--out",
            path(&out),
        ];
        arguments.extend(more);
        precess(&arguments)
    };
    let first = run(&[]);
    assert!(first.status.success(), "{}", String::from_utf8_lossy(&first.stderr));
    let again = run(&["--force"]);
    let shown = String::from_utf8_lossy(&again.stdout).into_owned();
    assert!(shown.contains("2 samples were in the journal"), "{shown}");
    fs::write(&law, script.replace("[0,0,0]", "[0,0,1e-3]")).expect("a file");
    let changed = run(&["--force"]);
    let shown = String::from_utf8_lossy(&changed.stdout).into_owned();
    assert!(!shown.contains("were in the journal"), "{shown}");
}
