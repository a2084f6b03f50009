//! The command line of `precess`: files, messages and exit codes.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

#[path = "shared/contents.rs"]
mod contents;

use contents::contents;

fn precess(arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_precess"));
    command.current_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join(".."));
    command.args(arguments).output().expect("the command starts")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).expect("text")
}

/// A folder that is not there yet.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&folder);
    folder
}

/// A scenario that runs in a moment: one wheel for 0.2 s.
fn wheel(name: &str) -> (PathBuf, String) {
    let folder = folder(name);
    fs::create_dir_all(&folder).expect("a folder");
    let example = precess(&["new", "reaction_wheel"]);
    assert!(example.status.success());
    let file = folder.join("wheel.toml");
    fs::write(&file, example.stdout).expect("a file");
    (folder, file.to_str().expect("text").to_owned())
}

fn run(file: &str, out: &Path, more: &[&str]) -> Output {
    let out = out.to_str().expect("text");
    let short = "run.duration=0.2 s";
    precess(&[&["run", file, "--out", out, "--set", short], more].concat())
}

#[test]
fn the_same_run_writes_the_same_bytes_and_no_more_files() {
    let (folder, file) = wheel("bytes");
    let (first, second) = (folder.join("a"), folder.join("b"));
    let ran = run(&file, &first, &["--set", "output.formats=[\"csv\", \"npz\"]"]);
    assert!(ran.status.success(), "{}", text(&ran.stderr));
    assert!(ran.stderr.is_empty(), "no progress in a pipe: {}", text(&ran.stderr));
    assert!(run(&file, &second, &["--set", "output.formats=[\"csv\", \"npz\"]"]).status.success());
    let files = contents(&first);
    let names: Vec<_> = files.keys().map(String::as_str).collect();
    assert_eq!(names, ["wheel.csv", "wheel.html", "wheel.npz"]);
    assert!(files == contents(&second), "the bytes of two runs differ");
}

#[test]
fn a_result_that_is_there_is_replaced_only_when_told() {
    let (folder, file) = wheel("replace");
    let out = folder.join("out");
    fs::create_dir_all(&out).expect("a folder");
    fs::write(out.join("wheel.csv"), "mine").expect("a file");
    let refused = run(&file, &out, &[]);
    assert_eq!(refused.status.code(), Some(1));
    let message = text(&refused.stderr);
    assert!(message.contains("wheel.csv exists") && message.contains("--force"), "{message}");
    assert_eq!(contents(&out), BTreeMap::from([("wheel.csv".to_owned(), b"mine".to_vec())]));
    assert!(run(&file, &out, &["--force"]).status.success());
    assert_ne!(contents(&out)["wheel.csv"], b"mine");
}

#[test]
fn a_wrong_file_has_all_its_errors_and_leaves_nothing() {
    let (folder, file) = wheel("wrong");
    let given = fs::read_to_string(&file).expect("a file");
    let wrong = given.replace("mass = \"4 kg\"", "mas = 4").replace("3000 rpm", "3000 m");
    fs::write(&file, wrong).expect("a file");
    let out = folder.join("out");
    let ran = run(&file, &out, &[]);
    assert_eq!(ran.status.code(), Some(1));
    let message = text(&ran.stderr);
    for part in ["unknown key", "did you mean `mass`?", "angular rate is wanted", "wheel.toml:"] {
        assert!(message.contains(part), "{part}: {message}");
    }
    assert!(!out.exists());
    let json = precess(&["check", &file, "--format", "json"]);
    assert_eq!(json.status.code(), Some(1));
    let entries: serde_json::Value = serde_json::from_slice(&json.stdout).expect("JSON");
    // The misspelt key, and the unit of another; that `mass` is missing follows from the first.
    assert_eq!(entries.as_array().map(Vec::len), Some(2), "{entries}");
}

#[test]
fn a_requirement_that_is_not_met_has_its_exit_code() {
    let (folder, file) = wheel("unmet");
    let limit = ["--set", "requirement.rate.limit=1 arcsec/s"];
    let ran = run(&file, &folder.join("out"), &limit);
    assert_eq!(ran.status.code(), Some(2), "{}", text(&ran.stdout));
    assert!(folder.join("out/wheel.csv").exists(), "the results are there");
}

#[test]
fn evaluate_check_and_compare_tell_what_they_find() {
    let (folder, file) = wheel("tell");
    let table = text(&precess(&["evaluate", &file]).stdout);
    assert!(table.contains("omega_dot_x") && table.contains("rad/s"), "{table}");
    let torque = "device.wheel1.wheel.torque=10 mN m";
    let json = precess(&["evaluate", &file, "--format", "json", "--set", torque]).stdout;
    let values: serde_json::Value = serde_json::from_slice(&json).expect("JSON");
    let u = &values["wheel1.u_w"];
    assert_eq!((u["value"].as_f64(), u["unit"].as_str()), (Some(0.01), Some("N m")), "{values}");
    let checked = text(&precess(&["check", &file]).stdout);
    assert!(checked.contains("total mass") && checked.contains("354 kg"), "{checked}");
    assert!(checked.contains("U_s 1 g cm"), "{checked}");
    let limited = checked.lines().find(|line| line.contains("torque limit")).expect("a table");
    assert!(!limited.contains("stiffness") && checked.contains("0.2 N m"), "{checked}");
    // A panel on its spring: degrees per second, and its frequency where all else is held: 30 N m/rad on
    // 2.8 kg m^2 and 8 kg at 1 m from the axis.
    let panel = folder.join("panel.toml");
    fs::write(&panel, precess(&["new", "hinged_panel"]).stdout).expect("a file");
    let panel = panel.to_str().expect("text");
    let checked =
        text(&precess(&["check", panel, "--set", "device.panel1.panel.rate=2 deg/s"]).stdout);
    let hertz = (30.0_f64 / (2.8 + 8.0)).sqrt() / std::f64::consts::TAU;
    for part in ["its spring", "2 deg/s", "30 N m/rad", &format!("{hertz:.6}")[..6]] {
        assert!(checked.contains(part), "{part} in {checked}");
    }
    let out = folder.join("out");
    assert!(run(&file, &out, &["--no-report"]).status.success());
    let result = out.join("wheel.csv");
    let result = result.to_str().expect("text");
    let same = text(&precess(&["compare", result, result]).stdout);
    assert!(same.lines().any(|line| line.starts_with("omega_x") && line.contains(" 0 ")), "{same}");
    let slower = folder.join("slower");
    let changed = ["--no-report", "--set", "device.wheel1.wheel.rate=2900 rpm"];
    assert!(run(&file, &slower, &changed).status.success());
    let [a, b] = [&out, &slower].map(|folder| folder.to_str().expect("text"));
    let json = precess(&["compare", a, b, "--format", "json"]).stdout;
    let found: serde_json::Value = serde_json::from_slice(&json).expect("JSON");
    let columns = found[0]["columns"].as_array().expect("columns");
    let spin = columns.iter().find(|column| column["column"] == "wheel1.spin").expect("a rate");
    let difference = 100.0 * std::f64::consts::PI / 30.0;
    assert!((spin["peak"].as_f64().expect("a number") / difference - 1.0).abs() < 1e-3, "{spin}");
    assert_eq!((&found[0]["result"], &spin["unit"]), (&"wheel.csv".into(), &"rad/s".into()));
    let mixed = precess(&["compare", a, result]);
    assert!(text(&mixed.stderr).contains("one is a folder"), "{}", text(&mixed.stderr));
}

#[test]
fn every_command_shows_an_example() {
    let commands = [
        "new", "check", "run", "evaluate", "compare", "plot", "spectrum", "schema", "kinds", "fit",
    ];
    assert!(text(&precess(&["--help"]).stdout).contains("Example"));
    for command in commands {
        let help = text(&precess(&[command, "--help"]).stdout);
        assert!(help.contains("Example"), "{command}: {help}");
    }
    assert!(text(&precess(&["kinds"]).stdout).contains("dgvscmg"));
    assert!(text(&precess(&["kinds", "sgcmg"]).stdout).contains("gimbal"));
    let kinds: serde_json::Value =
        serde_json::from_slice(&precess(&["kinds", "--json"]).stdout).expect("JSON");
    assert_eq!(kinds.as_object().map(serde_json::Map::len), Some(14));
    assert_eq!(kinds["vscmg"], serde_json::json!(["gimbal", "wheel"]));
    let schema: serde_json::Value =
        serde_json::from_slice(&precess(&["schema"]).stdout).expect("JSON");
    assert_eq!(schema["properties"]["format"]["const"], 1);
}

/// What the generator reads of a scenario is what the tests of the generator are made of.
#[test]
fn the_description_of_a_spacecraft_is_the_committed_one() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/baked");
    let committed = |name: &str| {
        fs::read_to_string(root.join(name).join("description.toml")).expect("a description")
    };
    let described = |scenario: &str| {
        let printed = precess(&["bake", "--description", scenario]);
        assert!(printed.status.success(), "{}", text(&printed.stderr));
        text(&printed.stdout)
    };
    let satellite = described("scenarios/imaging-satellite.toml");
    assert_eq!(satellite, committed("imaging_satellite"));
    assert_eq!(satellite.matches("locked_at").count(), 8);
    let table1 = described("scenarios/table1-catalogue-free.toml");
    assert_eq!(table1.replace("table1_catalogue_free", "table1"), committed("table1"));
    let unlocked =
        precess(&["bake", "--description", "--unlock", "scenarios/imaging-satellite.toml"]);
    assert!(!text(&unlocked.stdout).contains("locked_at"));
}

/// How a mount is written says which turns it is made of, whatever rounding leaves of them.
#[test]
fn a_mount_is_described_by_its_turns() {
    let hub = "format = 1\n[hub]\nmass = \"90 kg\"\ninertia = \"9, 9, 9 kg m^2\"\n[run]\n\
               duration = \"1 s\"\n[[device]]\nname = \"cmg\"\nkind = \"vscmg\"\n";
    let bodies = "[device.gimbal]\nmass = \"3 kg\"\ninertia = \"1, 1, 1 kg m^2\"\n\
                  [device.wheel]\nmass = \"3 kg\"\ninertia = \"1, 1, 1 kg m^2\"\n";
    let place = folder("turned_mounts");
    fs::create_dir_all(&place).expect("a folder");
    let file = place.join("scenario.toml");
    for (mount, turns) in [
        ("mount = { axis = [0, 0, 2], angle = \"-90 deg\" }", "turns = [\"z 270\"]"),
        ("mount = { axis = [0, 1, 0], angle = \"20 deg\" }", "turns = [\"y\"]"),
        (
            "mount = { euler = \"30, 0, 90 deg\", sequence = \"ZYX\", direction = \"hub to device\" }",
            "turns = [\"z\", \"x 90\"]",
        ),
        (
            "mount = { euler = \"30, 20, 90 deg\", sequence = \"ZYX\", direction = \"device to hub\" }",
            "turns = [\"x 270\", \"y\", \"z\"]",
        ),
        ("mount = { gimbal_axis = [0, 0, 1], spin_axis = [1, 0, 0] }", "turns = []"),
        ("mount = { gimbal_axis = [0, 0, 1], spin_axis = [3, 4, 0] }", "turns = [\"z\"]"),
        ("layout.ring = { count = 1 }", "turns = [\"y 90\", \"z 90\"]"),
    ] {
        fs::write(&file, format!("{hub}{mount}\n{bodies}")).expect("written");
        let printed = precess(&["bake", "--description", file.to_str().expect("a path")]);
        let text = text(&printed.stdout);
        assert!(text.contains(turns), "{mount}: {text}{}", self::text(&printed.stderr));
    }
    // Of numbers nothing is known but within rounding.
    let mount = "mount = { matrix = [[1, 0, 0], [0, 1, 0], [0, 0, 1]] }";
    fs::write(&file, format!("{hub}{mount}\n{bodies}")).expect("written");
    let printed = precess(&["bake", "--description", file.to_str().expect("a path")]);
    assert!(printed.status.success() && !text(&printed.stdout).contains("turns"));
}

#[test]
fn a_spacecraft_without_kernels_of_its_own_is_refused() {
    let refused = |set: &str, named: &str| {
        let scenario = "scenarios/imaging-satellite.toml";
        let printed = precess(&["bake", "--description", scenario, "--set", set]);
        assert!(!printed.status.success());
        let error = text(&printed.stderr);
        assert!(error.contains(named), "{error}");
    };
    refused("hub.mode=\"fixed\"", "free hub");
    refused("device.cmg.imbalance_model=\"lumped\"", "coupled");
}
