//! From the speeds that a budget keeps out of to wheels that leave them: the table of the command in a controller.

use std::ops::ControlFlow;
use std::path::Path;

use precess::engine::run;
use precess::file::from_file;
use precess::record::Samples;
use precess::scenario::Scenario;

use super::command::{folder, jitter};

/// A mode about x of a quarter of the hub's inertia, 20 Hz with the hub held; the scenario's wheels at its nodes.
const STRUCTURE: &str = r#"
[structure]
contains_devices = false
[[structure.node]]
name = "camera"
position = "0, 0, 0 m"
[[structure.node]]
name = "rw1"
position = "0.25, 0, 0 m"
[[structure.node]]
name = "rw2"
position = "0, 0.25, 0 m"
[[structure.node]]
name = "rw3"
position = "-0.25, 0, 0 m"
[[structure.node]]
name = "rw4"
position = "0, -0.25, 0 m"
[[structure.point]]
name = "camera"
node = "camera"
[[structure.mode]]
frequency = "20 Hz"
damping = 0.01
angular_momentum = [2, 0, 0]

[[device]]
"#;

const BUDGET: &str = r#"format = 1
scenario = "bus.toml"
[speed]
from = "900 rpm"
to = "1600 rpm"
count = 141
[[line_of_sight]]
name = "camera"
node = "camera"
[[requirement]]
name = "jitter"
metric = "rms"
limit = "LIMIT"
[[requirement]]
name = "peak"
metric = "rms"
limit = "0.04 urad"
"#;

const KEY: &str = "controller.aocs.allocation.keep_out";

/// Wheels at the rates of the scenario, without bands of its own.
fn bus(out: &Path) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenarios/wheel-keep-out.toml");
    let text = std::fs::read_to_string(path).expect("a scenario");
    let bands = "keep_out = [\"1150, 1350 rpm\"]\nkeep_out_gain = \"0.1 1/s\"\n";
    let layout = "layout.pyramid = { count = 4, half_angle = \"54.74 deg\", radius = \"25 cm\" }\n";
    for part in [bands, layout, "\n[[device]]\n"] {
        assert!(text.contains(part), "{part}");
    }
    let nodes = format!("{layout}node = [\"rw1\", \"rw2\", \"rw3\", \"rw4\"]\n");
    let text = text.replace(bands, "").replace(layout, &nodes);
    std::fs::write(out.join("bus.toml"), text.replace("\n[[device]]\n", STRUCTURE))
        .expect("written");
}

fn bands_of(text: &str) -> Vec<[f64; 2]> {
    let row = |line: &str| {
        let (lower, upper) = line.split_once(',').expect("two columns");
        [lower, upper].map(|number| number.parse().expect("a number"))
    };
    text.lines().skip(1).map(row).collect()
}

/// Largest depth of a wheel in a band at a time, rad/s, and the largest torque error of all samples.
fn ran(scenario: &Scenario, bands: &[[f64; 2]]) -> ([f64; 2], f64) {
    let mut samples = Samples::default();
    let outcome = run(scenario, &mut samples, &mut |_| ControlFlow::Continue(())).expect("a run");
    assert!(outcome.end.is_complete(), "{}", outcome.end);
    let column = |name: &str| samples.column(name).unwrap_or_else(|| panic!("{name}"));
    let speeds: Vec<Vec<f64>> = (1..=4).map(|k| column(&format!("rw{k}.spin"))).collect();
    let depth = |row: usize| {
        let within = |[from, to]: &[f64; 2]| {
            let each =
                speeds.iter().map(|speed| (speed[row].abs() - from).min(to - speed[row].abs()));
            each.fold(0.0, f64::max)
        };
        bands.iter().map(within).fold(0.0, f64::max)
    };
    let errors = ["x", "y", "z"].map(|axis| column(&format!("aocs.torque_error_{axis}")));
    let error = errors.iter().flatten().map(|error| error.abs()).fold(0.0, f64::max);
    ([depth(0), depth(samples.rows.len() - 1)], error)
}

/// `precess jitter` writes the bands; a controller with them takes its wheels out, without a torque on the hub.
#[test]
fn wheels_leave_the_bands_that_a_budget_wrote() {
    let out = folder("keep-out");
    bus(&out);
    std::fs::write(out.join("budget.toml"), BUDGET.replace("LIMIT", "0.02 urad")).expect("written");
    let found = jitter(&out.join("budget.toml"), &out, &["--no-compare"]);
    let text = String::from_utf8_lossy(&found.stdout).into_owned();
    assert_eq!(found.status.code(), Some(2), "{text}{}", String::from_utf8_lossy(&found.stderr));
    assert!(text.contains("budget-keep-out.csv; a controller's wheels leave them"), "{text}");
    let written = std::fs::read_to_string(out.join("budget-keep-out.csv")).expect("a table");
    let bands = bands_of(&written);
    println!("{text}{written}");
    // That of the narrower requirement is within that of the other.
    assert_eq!(bands.len(), 1, "{written}");
    let set = format!("{KEY}={{ file = \"budget-keep-out.csv\" }}");
    let path = out.join("bus.toml");
    let (with, _) = from_file(&path, &[set]).unwrap_or_else(|errors| panic!("{errors}"));
    assert_eq!(with.controllers[0].allocation.null_motion.keep_out, bands);
    let (without, _) = from_file(&path, &[]).unwrap_or_else(|errors| panic!("{errors}"));
    let ([start, end], error) = ran(&with, &bands);
    let ([_, stays], _) = ran(&without, &bands);
    println!("depth {start} -> {end} rad/s, without {stays}; torque error {error:e} N m");
    assert!(start > 1.0 && stays > 1.0, "{start} {stays}");
    assert_eq!(end, 0.0);
    assert!(error < 1e-12, "{error}");
    std::fs::remove_dir_all(out).expect("it was made");
}

/// A table that is not there, has no such columns, or is none, with its place; a budget that is met writes no band.
#[test]
fn a_table_of_bands_is_read_with_its_place() {
    let out = folder("keep-out-errors");
    bus(&out);
    let path = out.join("bus.toml");
    let read = |value: &str| from_file(&path, &[format!("{KEY}={value}")]);
    std::fs::write(out.join("other.csv"), "from,to\n1,2\n").expect("written");
    std::fs::write(out.join("wrong.csv"), "lower_rad_per_s,upper_rad_per_s\n2,1\n")
        .expect("written");
    std::fs::write(out.join("meet.csv"), "upper_rad_per_s,lower_rad_per_s\n30,20\n25,10\n50,40\n")
        .expect("written");
    for (value, part) in [
        ("{ file = \"none.csv\" }", "none.csv"),
        ("{ file = \"other.csv\" }", "no column `lower_rad_per_s`"),
        ("{ file = \"wrong.csv\" }", "is no band"),
        ("{ name = \"x\" }", "file"),
    ] {
        let errors = read(value).map(|_| ()).expect_err(value).to_string();
        assert!(errors.contains(part), "{value}: {errors}");
    }
    for value in
        ["{ file = \"meet.csv\" }", "[\"20, 30 rad/s\", \"10, 25 rad/s\", \"40, 50 rad/s\"]"]
    {
        let (scenario, _) = read(value).unwrap_or_else(|errors| panic!("{errors}"));
        let bands = &scenario.controllers[0].allocation.null_motion.keep_out;
        assert_eq!(*bands, [[10.0, 30.0], [40.0, 50.0]], "{value}");
    }
    std::fs::write(
        out.join("met.toml"),
        BUDGET.replace("0.04 urad", "1 rad").replace("LIMIT", "1 rad"),
    )
    .expect("written");
    let found = jitter(&out.join("met.toml"), &out, &["--no-compare"]);
    let text = String::from_utf8_lossy(&found.stdout).into_owned();
    assert_eq!(found.status.code(), Some(0), "{text}");
    assert!(!text.contains("keep-out.csv"), "{text}");
    let written = std::fs::read_to_string(out.join("met-keep-out.csv")).expect("a table");
    assert_eq!(written, "lower_rad_per_s,upper_rad_per_s\n");
    std::fs::remove_dir_all(out).expect("it was made");
}
