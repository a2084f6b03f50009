//! Requirements without data: neither met nor violated.

use std::fs;
use std::path::{Path, PathBuf};

use super::{CommandResult, folder, precess};

/// A wheel at 3000 rpm on a hub, for a tenth of a second at 1 kHz: frequencies of a spectrum are 10 Hz apart.
const WHEEL: &str = r#"format = 1
title = "A wheel"
[hub]
mass = "10 kg"
inertia = "0.2, 0.25, 0.1 kg m^2"
[[device]]
name = "rw"
kind = "reaction_wheel"
position = "5, 0, 0 cm"
mount = { spin_axis = [0, 0, 1] }
imbalance = { static = "0.5 g mm", dynamic = "2 g mm^2" }
wheel = { mass = "0.185 kg", inertia = "6.82e-5, 3.8e-5, 3.8e-5 kg m^2", rate = "3000 rpm" }
[run]
duration = "0.1 s"
[output]
rate = "1 kHz"
"#;

/// Every statistic that can be without data in a whole run, with keys that leave it without, and a part of the reason.
const WITHOUT_DATA: [(&str, &str); 9] = [
    ("statistic = \"band_rms\"\nband = \"10.1, 10.2 Hz\"", "no frequency of the spectrum"),
    ("statistic = \"band_rms\"\nband = \"0, 9 Hz\"", "no frequency of the spectrum"),
    ("statistic = \"band_rms\"\nband = \"10, 400 Hz\"\nto = \"10 ms\"", "needs 16 samples"),
    ("statistic = \"displacement\"\nexposure = \"0.2 s\"", "needs 0.2 s"),
    ("statistic = \"smear\"\nexposure = \"0.2 s\"", "needs 0.2 s"),
    ("statistic = \"jitter\"\nexposure = \"0.2 s\"", "needs 0.2 s"),
    ("statistic = \"rpe\"\nwindow = \"0.2 s\"", "needs 0.2 s"),
    ("statistic = \"pde\"\nwindow = \"50 ms\"\nstability = \"100 ms\"", "needs 0.15 s"),
    (
        "statistic = \"peak\"\nfrom = \"10.2 ms\"\nto = \"10.8 ms\"",
        "no sample in 0.0102 s to 0.0108 s",
    ),
];

/// Statistics of every kind that have data.
const WITH_DATA: [&str; 6] = [
    "statistic = \"peak\"",
    "statistic = \"rms\"",
    "statistic = \"final\"",
    "statistic = \"band_rms\"\nband = \"10, 400 Hz\"",
    "statistic = \"smear\"\nexposure = \"10 ms\"",
    "statistic = \"ape\"",
];

fn requirement(name: &str, keys: &str, limit: &str) -> String {
    format!(
        "[[requirement]]\nname = \"{name}\"\nquantity = \"omega\"\n{keys}\nlimit = \"{limit}\"\n"
    )
}

fn write(folder: &Path, name: &str, text: &str) -> String {
    let path = folder.join(name);
    fs::write(&path, text).expect("it is written");
    path.to_str().expect("text").to_owned()
}

/// Runs a scenario with these requirements.
fn run(folder: &Path, requirements: &str) -> (CommandResult, PathBuf) {
    let file = write(folder, "wheel.toml", &format!("{WHEEL}{requirements}"));
    let out = folder.join("out");
    let ended = precess(&["run", &file, "--force", "--out", out.to_str().expect("text")]);
    (ended, out)
}

#[test]
fn every_statistic_without_data_is_not_evaluated_and_check_says_so_before_the_run() {
    let folder = folder("without-data");
    for (keys, reason) in WITHOUT_DATA {
        let (ended, out) = run(&folder, &requirement("empty", keys, "50 urad/s"));
        assert_eq!(ended.code, Some(3), "{keys}: {}{}", ended.out, ended.error);
        assert!(ended.out.contains("0 of 1 met, 1 not evaluated"), "{keys}: {}", ended.out);
        assert!(ended.out.contains(reason), "{keys}: {}", ended.out);
        let page = fs::read_to_string(out.join("wheel.html")).expect("a page");
        assert!(page.contains("The requirement is not evaluated:"), "{keys}");
        let file = folder.join("wheel.toml");
        let checked = precess(&["check", file.to_str().expect("text")]);
        assert_eq!(checked.code, Some(0), "{keys}: {}", checked.error);
        let warning = "requirement `empty` cannot be evaluated: ";
        for part in [warning, reason, "wheel.toml:"] {
            assert!(checked.out.contains(part), "{keys}: {part} in {}", checked.out);
        }
    }
}

#[test]
fn statistics_with_data_are_met_or_violated_as_before() {
    let folder = folder("with-data");
    for keys in WITH_DATA {
        for (limit, code) in [("1 rad/s", 0), ("1e-12 rad/s", 2)] {
            let (ended, _) = run(&folder, &requirement("full", keys, limit));
            assert_eq!(ended.code, Some(code), "{keys}: {}{}", ended.out, ended.error);
            assert!(!ended.error.contains("cannot be evaluated"), "{keys}: {}", ended.error);
        }
    }
}

#[test]
fn a_violated_requirement_outranks_one_without_data() {
    let folder = folder("outranked");
    let empty = requirement("empty", WITHOUT_DATA[0].0, "1 rad/s");
    let met = requirement("met", WITH_DATA[0], "1 rad/s");
    let violated = requirement("violated", WITH_DATA[0], "1e-12 rad/s");
    assert_eq!(run(&folder, &format!("{empty}{met}")).0.code, Some(3));
    let (ended, _) = run(&folder, &format!("{empty}{met}{violated}"));
    assert_eq!(ended.code, Some(2), "{}", ended.out);
    assert!(ended.out.contains("1 of 3 met, 1 violated, 1 not evaluated"), "{}", ended.out);
}

/// A run that a crossing ends before the end of a window: what has been exceeded is violated, nothing else is known.
#[test]
fn a_window_that_was_not_run_is_not_evaluated() {
    let folder = folder("not-run");
    let crossing = "[[crossing]]\nname = \"third turn\"\ncolumn = \"rw.theta\"\nvalue = \"3 rev\"\nends = true\n\
                    [[crossing]]\nname = \"a, \\\"turn\\\"\"\ncolumn = \"rw.theta\"\nvalue = \"1 rev\"\n";
    let met = requirement("peak", "statistic = \"peak\"", "1 rad/s");
    let (ended, out) = run(&folder, &format!("{crossing}{met}"));
    assert_eq!(ended.code, Some(3), "{}{}", ended.out, ended.error);
    assert!(ended.out.contains("the run ended at"), "{}", ended.out);
    // Times of crossings are on the terminal, and in a file with all digits: turns at 50 Hz, nearly.
    assert!(
        ended.out.contains("at 0.06") && ended.out.contains("crossing `third turn`"),
        "{}",
        ended.out
    );
    let events = fs::read_to_string(out.join("wheel-events.csv")).expect("a file");
    let lines: Vec<&str> = events.lines().collect();
    assert_eq!(lines[0], "time_s,event");
    assert!(lines[1].ends_with(",\"crossing `a, \"\"turn\"\"`\""), "{events}");
    let time: f64 = lines[1].split(',').next().and_then(|t| t.parse().ok()).expect("a time");
    assert!((time - 0.02).abs() < 1e-6, "{time}");
    assert_eq!(lines.len(), 3, "{events}");
    // Without crossings there is no such file.
    let (_, out) = run(&super::folder("no-crossings"), &met);
    assert!(!out.join("wheel-events.csv").exists());
    let exceeded = requirement("peak", "statistic = \"peak\"", "1e-12 rad/s");
    assert_eq!(run(&folder, &format!("{crossing}{exceeded}")).0.code, Some(2));
    let unknown = requirement("rms", "statistic = \"rms\"", "1e-12 rad/s");
    assert_eq!(run(&folder, &format!("{crossing}{unknown}")).0.code, Some(3));
}

#[test]
fn campaigns_tell_what_is_not_evaluated_from_what_is_violated() {
    let folder = folder("campaigns");
    let plan = write(
        &folder,
        "plan.toml",
        "format = 1\n[[vary]]\nkey = \"hub.mass\"\ndistribution = \"uniform\"\nfrom = \"10 kg\"\nto = \"11 kg\"\n",
    );
    let empty = requirement("empty", WITHOUT_DATA[0].0, "1 rad/s");
    let violated = requirement("violated", WITH_DATA[0], "1e-12 rad/s");
    for (name, requirements, code) in
        [("empty", empty.clone(), 3), ("both", format!("{empty}{violated}"), 2)]
    {
        let file = write(&folder, "wheel.toml", &format!("{WHEEL}{requirements}"));
        let out = folder.join(name);
        let out = out.to_str().expect("text");
        let ended = precess(&["sweep", &file, "--over", "hub.mass=10..11 kg:2", "--out", out]);
        assert_eq!(ended.code, Some(code), "{}{}", ended.out, ended.error);
        for part in ["not evaluated by 2", "no frequency of the spectrum"] {
            assert!(ended.out.contains(part), "{part} in {}", ended.out);
        }
        let arguments = ["montecarlo", &file, "--plan", &plan, "--samples", "3", "--out", out];
        let ended = precess(&arguments);
        assert_eq!(ended.code, Some(code), "{}{}", ended.out, ended.error);
        for part in ["0 of 3, 3 not evaluated", "no frequency of the spectrum"] {
            assert!(ended.out.contains(part), "{part} in {}", ended.out);
        }
        let csv = Path::new(out).join("wheel-montecarlo-percentiles.csv");
        let csv = fs::read_to_string(csv).expect("percentiles");
        // Nothing is known of the probability.
        assert!(csv.contains("requirement empty,probability of meeting,,0,1\n"), "{csv}");
    }
}

fn budget(folder: &Path, requirement: &str) -> CommandResult {
    write(folder, "wheel.toml", WHEEL);
    let budget = write(
        folder,
        "budget.toml",
        &format!(
            "format = 1\nscenario = \"wheel.toml\"\n[speed]\nfrom = \"1000 rpm\"\nto = \"5600 rpm\"\ncount = 5\n\
             [[line_of_sight]]\nnode = \"hub\"\n[[requirement]]\nname = \"a\"\n{requirement}\n"
        ),
    );
    let out = folder.join("out");
    precess(&["jitter", &budget, "--no-compare", "--force", "--out", out.to_str().expect("text")])
}

#[test]
fn a_budget_without_a_line_in_its_metric_is_not_evaluated() {
    let folder = folder("budget");
    for (keys, reason) in [
        ("metric = \"band_rms\"\nband = \"1e9, 2e9 Hz\"", "within 1e9 Hz to 2e9 Hz at any speed"),
        ("metric = \"band_rms\"\nband = \"0, 1 Hz\"", "no tone and no noise"),
        ("metric = \"smear\"\nexposure = \"1e300 s\"", "exposures of 1e300 s"),
        ("metric = \"displacement\"\nexposure = \"1e300 s\"", "exposures of 1e300 s"),
    ] {
        let ended = budget(&folder, &format!("{keys}\nlimit = \"1 rad\""));
        assert_eq!(ended.code, Some(3), "{keys}: {}{}", ended.out, ended.error);
        assert!(ended.out.contains("a: not evaluated: "), "{keys}: {}", ended.out);
        assert!(ended.out.contains(reason), "{keys}: {}", ended.out);
        let page = fs::read_to_string(folder.join("out/budget.html")).expect("a page");
        assert!(page.contains("1 of 1 requirements not evaluated:"), "{keys}");
    }
    // A band that has a line at some speeds is measured at all.
    let ended = budget(&folder, "metric = \"band_rms\"\nband = \"90, 95 Hz\"\nlimit = \"1 rad\"");
    assert_eq!(ended.code, Some(0), "{}{}", ended.out, ended.error);
}

#[test]
fn a_limit_below_zero_is_refused_by_every_statistic_and_metric() {
    let folder = folder("negative");
    for keys in WITH_DATA {
        let (ended, _) = run(&folder, &requirement("a", keys, "-50 urad/s"));
        assert_eq!(ended.code, Some(1), "{keys}: {}", ended.out);
        for part in ["-50 urad/s is not 0 or above", "wheel.toml:"] {
            assert!(ended.error.contains(part), "{keys}: {part} in {}", ended.error);
        }
    }
    for keys in ["metric = \"rms\"", "metric = \"band_rms\"\nband = \"1, 90 Hz\""] {
        let ended = budget(&folder, &format!("{keys}\nlimit = \"-1 urad\""));
        assert_eq!(ended.code, Some(1), "{keys}: {}", ended.out);
        assert!(ended.error.contains("above zero"), "{keys}: {}", ended.error);
    }
}

/// A hub that turns by 1.2 arcsec in 2 s, about z and half as fast about x, from an attitude of its own.
const SLOW: &str = r#"format = 1
[hub]
mass = "10 kg"
inertia = "1, 1, 1 kg m^2"
[initial]
attitude = { axis = [1, 2, 3], angle = "70 deg" }
angular_velocity = "0.3, 0, 0.6 arcsec/s"
[run]
duration = "2 s"
[output]
rate = "100 Hz"
columns = ["omega"]
"#;

/// The attitude is limited in seconds of arc: about an axis, in all, across and along a boresight.
#[test]
fn pointing_is_limited_in_arcsec() {
    let folder = folder("arcsec");
    for (keys, limit) in [
        ("quantity = \"rotation_z\"", 1.2),
        ("quantity = \"rotation_y\"", 0.0),
        ("quantity = \"rotation\"", 1.2 * 1.25_f64.sqrt()),
        ("quantity = \"rotation\"\nacross = [0, 0, 2]", 0.6),
        ("quantity = \"rotation\"\nalong = [0, 0, -1]", 1.2),
        ("quantity = \"rotation\"\nacross = [1, 0, 2]", 0.0),
        ("quantity = \"omega\"\nalong = [1, 0, 2]", 0.3 * 5.0_f64.sqrt()),
    ] {
        let unit = if keys.contains("omega") { "arcsec/s" } else { "arcsec" };
        for (factor, code) in [(1.0 + 1e-6, 0), (1.0 - 1e-6, 2)] {
            // Of nothing, a bound on the rounding.
            let bound = if limit == 0.0 { 1e-9 } else { limit * factor };
            let text = format!(
                "{SLOW}[[requirement]]\nname = \"a\"\n{keys}\nstatistic = \"peak\"\nlimit = \"{bound} {unit}\"\n"
            );
            let file = write(&folder, "slow.toml", &text);
            let out = folder.join("out");
            let ended = precess(&["run", &file, "--force", "--out", out.to_str().expect("text")]);
            let code = if limit == 0.0 { 0 } else { code };
            assert_eq!(ended.code, Some(code), "{keys} {bound}: {}{}", ended.out, ended.error);
            // Recorded where it is limited, and in a figure.
            let csv = fs::read_to_string(out.join("slow.csv")).expect("a result");
            assert_eq!(csv.contains("rotation_"), keys.contains("rotation"), "{keys}");
        }
    }
}

#[test]
fn a_direction_of_what_is_no_vector_is_refused() {
    for (keys, parts) in [
        ("quantity = \"omega_x\"\nalong = [0, 0, 1]", ["`omega_x` is no vector", "^^^"]),
        ("quantity = \"omega\"\nacross = [0, 0, 0]", ["`across` has no direction", "^^^"]),
        (
            "quantity = \"omega\"\nalong = [1, 0, 0]\nacross = [0, 0, 1]",
            ["`along` and `across` are given", "remove one"],
        ),
    ] {
        let text = format!(
            "{SLOW}[[requirement]]\nname = \"a\"\n{keys}\nstatistic = \"peak\"\nlimit = \"1 rad/s\"\n"
        );
        let read = precess::file::from_toml("slow", &text, Path::new(""));
        let shown = read.expect_err("an error").to_string();
        for part in parts {
            assert!(shown.contains(part), "{part} in\n{shown}");
        }
    }
}

/// A pointing target other than the initial attitude.
#[test]
fn a_rotation_is_from_the_attitude_that_the_file_says() {
    let folder = folder("rotation-from");
    let text = SLOW
        .replace("angular_velocity = \"0.3, 0, 0.6 arcsec/s\"\n", "")
        .replace("[run]", "rotation_from = { axis = [1, 2, 3], angle = \"69 deg\" }\n[run]");
    let limit = |degrees: f64| {
        format!(
            "{text}[[requirement]]\nname = \"a\"\nquantity = \"rotation\"\nalong = [1, 2, 3]\nstatistic = \"rms\"\n\
             limit = \"{degrees} deg\"\n"
        )
    };
    for (degrees, code) in [(1.0 + 1e-9, 0), (1.0 - 1e-9, 2)] {
        let file = write(&folder, "from.toml", &limit(degrees));
        let out = folder.join("out");
        let ended = precess(&["run", &file, "--force", "--out", out.to_str().expect("text")]);
        assert_eq!(ended.code, Some(code), "{}{}", ended.out, ended.error);
        assert!(ended.out.contains("of rotation along [0.2673, 0.5345, 0.8018]"), "{}", ended.out);
    }
}
