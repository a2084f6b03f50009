//! Rotors in steady spin: rates that their kind keeps, settled starts, budgets over their speed.

use std::fs;
use std::path::Path;

use super::{CommandResult, folder, precess};

/// The examples of `new`, written into a folder.
fn examples(name: &str, all: &[&str]) -> std::path::PathBuf {
    let folder = folder(name);
    for of in all {
        let text = precess(&["new", of]).out;
        fs::write(folder.join(format!("{of}.toml")), text).expect("it is written");
    }
    folder
}

/// A command about a file of a folder, with overrides.
fn with(command: &str, folder: &Path, file: &str, overrides: &[&str]) -> CommandResult {
    let path = folder.join(file);
    let mut arguments = vec![command, path.to_str().expect("text")];
    let out = folder.join("out");
    if command != "check" {
        arguments.extend(["--force", "--out", out.to_str().expect("text")]);
    }
    arguments.extend(overrides.iter().flat_map(|of| ["--set", of]));
    precess(&arguments)
}

#[track_caller]
fn shows(ended: &CommandResult, code: i32, parts: &[&str]) {
    let text = format!("{}{}", ended.out, ended.error);
    assert_eq!(ended.code, Some(code), "{text}");
    for part in parts {
        assert!(text.contains(part), "{part}\n{text}");
    }
}

const GYROS: [(&str, &str); 5] = [
    ("gyros", "cmg"),
    ("sgcmg", "cmg1"),
    ("dgcmg", "cmg1"),
    ("balanced_sgcmg", "cmg1"),
    ("balanced_dgcmg", "cmg1"),
];

/// `check` panicked on a torque; a lock and a motion it passed, which `run` refused without a line; a spring it took.
#[test]
fn what_a_wheel_at_the_rate_of_its_kind_does_not_have_is_an_error_with_its_place() {
    let all = GYROS.map(|(template, _)| template);
    let folder = examples("kept_rates", &all);
    for (template, device) in GYROS {
        for settled in ["true", "false"] {
            let torque = format!("device.{device}.wheel.torque=0.1 N m");
            let settled = format!("initial.settled={settled}");
            let ended = with("check", &folder, &format!("{template}.toml"), &[&torque, &settled]);
            let key = format!("--set device.{device}.wheel.torque");
            shows(&ended, 1, &["the kind keeps the rate of the joint: no `torque`", &key]);
        }
    }
    for (key, value, named) in [
        ("torque", "0 N m", "no `torque`"),
        ("locked", "true", "no `locked`"),
        ("acceleration", "1 rad/s^2", "no `acceleration`"),
        ("stiffness", "1 N m/rad", "no `stiffness`"),
        ("at_stop", "lock", "no `at_stop`"),
        ("rate", "{ ramp = \"0, 1 rad/s\", from = \"0 s\", to = \"1 s\" }", "`rate` is no profile"),
    ] {
        let one = format!("device.cmg1.wheel.{key}={value}");
        let stop = "device.cmg1.wheel.upper_stop=1 rev";
        let ended = with("check", &folder, "gyros.toml", &[&one, stop]);
        shows(&ended, 1, &[named, &format!("--set device.cmg1.wheel.{key}")]);
    }
    // What changes nothing is taken, as a written scenario has it.
    let zero = ["device.cmg1.wheel.acceleration=0 rad/s^2", "device.cmg1.wheel.locked=false"];
    shows(&with("check", &folder, "gyros.toml", &zero), 0, &[]);
    let text = fs::read_to_string(folder.join("gyros.toml")).expect("it is there");
    let brake = "\n[[at]]\ntime = \"1 s\"\njoint = \"cmg1.wheel\"\nbrake = true\n";
    fs::write(folder.join("brake.toml"), text + brake).expect("it is written");
    shows(&with("check", &folder, "brake.toml", &[]), 1, &["no `brake`", "brake.toml:"]);
}

/// Wheels of a settled scenario had other speeds than those of its file, so that their tones no longer added.
#[test]
fn a_budget_of_a_settled_scenario_is_that_of_its_file() {
    let folder = examples("settled_budget", &["wheels", "budget"]);
    let same = ["device.wheel*.wheel.rate=6000 rpm", "budget.speed.rotors=[\"wheel1.wheel\"]"];
    let of = |settled: &str| {
        let settled = format!("initial.settled={settled}");
        let ended = with("jitter", &folder, "budget.toml", &[same[0], same[1], &settled]);
        shows(&ended, 0, &["coupled run at 6000 rpm", "within 1 % off resonance"]);
        let lines = folder.join("out/budget-lines.csv");
        (ended.out, fs::read_to_string(lines).expect("the lines"))
    };
    assert_eq!(of("true"), of("false"));
    let ended = with("check", &folder, "wheels.toml", &same[..1]);
    shows(&ended, 0, &[" 6000 rpm "]);
    assert!(!ended.out.contains("5999."), "{}", ended.out);
}

/// A run that contradicts the lines was in a table only.
#[test]
fn a_coupled_run_above_its_bound_is_in_the_summary() {
    let folder = examples("contradicted", &["wheels", "budget"]);
    // Rotors whose moments across the spin axis differ, on a hub that is light beside them.
    let unequal = [
        "hub.mass=5 kg",
        "hub.inertia=0.1, 0.1, 0.1 kg m^2",
        "device.wheel*.wheel.inertia=288, 130, 400 kg cm^2",
    ];
    let ended = with("jitter", &folder, "budget.toml", &unequal);
    let found = "the coupled run differs from the lines by";
    let text = format!("{}{}", ended.out, ended.error);
    assert!(ended.error.contains(found) && ended.out.contains("above 1 %"), "{text}");
    let page = fs::read_to_string(folder.join("out/budget.html")).expect("a report");
    let at = page.find(found).expect("it is in the report");
    assert!(at < page.find("id=\"requirements\"").expect("a section"), "it is in the summary");
    let plain = with("jitter", &folder, "budget.toml", &[]);
    assert!(!plain.error.contains(found), "{}", plain.error);
}

/// A limit on the rotation of a settled run counts a drift, by which its value depends on the time.
#[test]
fn a_drift_in_the_second_order_is_named_where_a_requirement_counts_it() {
    let folder = examples("second_order", &["wheels"]);
    let text = fs::read_to_string(folder.join("wheels.toml")).expect("it is there");
    // It grows as the square of the imbalance, the vibration as the imbalance.
    let text = text.replace("1 g cm", "30 g cm").replace("20 g cm^2", "600 g cm^2");
    let limit = "[[requirement]]\nname = \"pointing\"\nquantity = \"rotation\"\nstatistic = \"rms\"\n\
                 limit = \"1 deg\"\n";
    fs::write(folder.join("limit.toml"), format!("{text}\n{limit}")).expect("it is written");
    let band = limit.replace("\"rms\"", "\"band_rms\"\nband = \"10, 200 Hz\"");
    fs::write(folder.join("band.toml"), format!("{text}\n{band}")).expect("it is written");
    let short = ["run.duration=2 s", "output.rate=1 kHz"];
    let ended = with("run", &folder, "limit.toml", &short);
    shows(
        &ended,
        0,
        &[
            "rotors out of balance that exchange power",
            "rad/s^2",
            "the requirement `pointing` counts that",
        ],
    );
    let page = fs::read_to_string(folder.join("out/limit.html")).expect("a report");
    assert!(page.contains("the requirement `pointing` counts that"));
    let ended = with("check", &folder, "limit.toml", &short);
    shows(&ended, 0, &["`statistic = \"band_rms\"` with `band`"]);
    let exchange = "exchange power";
    let each = ["device.wheel2.wheel.rate=2500 rpm", "device.wheel3.wheel.rate=2000 rpm"];
    for (file, overrides) in [("band.toml", &short), ("limit.toml", &each)] {
        let ended = with("check", &folder, file, overrides);
        shows(&ended, 0, &[]);
        let text = format!("{}{}", ended.out, ended.error);
        assert!(!text.contains(exchange), "{file}\n{text}");
    }
}

/// `run` failed, or ended at its start, where `check` had no error of its own.
#[test]
fn a_vibration_beyond_a_stop_or_the_largest_rate_is_an_error_with_its_place() {
    let folder = examples("excursions", &["wheels", "hinged_panel"]);
    let limit = "device.wheel*.wheel.rate_limit=3000 rpm";
    let ended = with("check", &folder, "wheels.toml", &[limit]);
    shows(
        &ended,
        1,
        &[
            "of a settled run wheel1.wheel vibrates, up to 3000.",
            "beyond its `rate_limit`, 3000 rpm",
            "or remove `initial.settled`",
        ],
    );
    let at_rest = [limit, "initial.settled=false"];
    assert_eq!(with("check", &folder, "wheels.toml", &at_rest).error, "");
    shows(
        &with("check", &folder, "wheels.toml", &["device.wheel*.wheel.rate_limit=3001 rpm"]),
        0,
        &[],
    );
    let panel = precess(&["new", "hinged_panel"]).out;
    let panel = &panel
        [panel.find("[[device]]").expect("a panel")..panel.find("# What happens").expect("a run")];
    let wheels = fs::read_to_string(folder.join("wheels.toml")).expect("it is there");
    let panel = panel.replace("angle = \"1 deg\"", "angle = \"0 deg\"\nupper_stop = \"0 deg\"");
    let both = wheels.replace("# What happens", &format!("{panel}\n# What happens"));
    fs::write(folder.join("panel.toml"), both).expect("it is written");
    let ended = with("check", &folder, "panel.toml", &[]);
    shows(&ended, 1, &["beyond its `upper_stop`, 0 deg", "panel.toml:", "lock the joint"]);
    shows(&with("check", &folder, "panel.toml", &["device.panel1.panel.locked=true"]), 0, &[]);
}

/// A speed at which the curve is largest by rounding was named as the worst one.
#[test]
fn a_curve_that_is_flat_has_no_worst_speed() {
    let folder = examples("flat", &["wheels", "budget"]);
    let ended = with("jitter", &folder, "budget.toml", &[]);
    shows(&ended, 0, &["the same at every speed"]);
    let band = [
        "budget.requirement.stability.metric=displacement",
        "budget.requirement.stability.exposure=20 ms",
    ];
    let ended = with("jitter", &folder, "budget.toml", &band);
    assert!(!ended.out.contains("the same at every speed"), "{}", ended.out);
}
