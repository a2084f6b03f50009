//! `sweep`: closed forms, threads, samples that fail, what is refused.

use std::f64::consts::TAU;
use std::fs;
use std::path::Path;

use super::shared::{folder, number, path, precess, results, rows, text};

/// Of the acceleration of the hub's origin, m s w^2 / M for a wheel that keeps its rate: the imbalance moves the centre of mass by
/// 1e-6 m, and the wheel's rate changes by less than that share.
const CLOSED_FORM: f64 = 1e-4;
/// Of the frequency of a line between bins of 2 Hz, by two bins of Hann's window.
const FREQUENCY: f64 = 1e-4;

#[test]
fn acceleration_and_line_follow_the_square_of_the_rate() {
    let (folder, file) = folder("square");
    let out = folder.join("out");
    let arguments = [
        "sweep",
        path(&file),
        "--over",
        "device.rw.wheel.rate=1200..6000 rpm:5",
        "--column",
        "acceleration",
        "--out",
        path(&out),
    ];
    let output = precess(&arguments);
    // The limit is exceeded at two rates: at 6000 rpm 1e-4 kg m / 100 kg (628 rad/s)^2 = 395 mm/s^2.
    assert_eq!(output.status.code(), Some(2), "{}", text(&output.stderr));
    let shown = text(&output.stdout);
    assert!(shown.contains("violated by 2") && shown.contains("6000 rpm"), "{shown}");
    let files = results(&out);
    let found = rows(&files["wheel-sweep.csv"]);
    assert_eq!(found.len(), 5);
    for row in &found {
        let rate = number(row, "device.rw.wheel.rate [rpm]") * TAU / 60.0;
        let expected = 1e-4 * rate * rate / 100.0;
        for name in ["acceleration rms [m/s²]", "acceleration peak [m/s²]"] {
            let value = number(row, name);
            assert!((value / expected - 1.0).abs() < CLOSED_FORM, "{name}: {value} for {expected}");
        }
        let line = number(row, "acceleration line 1 frequency [Hz]");
        assert!((line * TAU / rate - 1.0).abs() < FREQUENCY, "{line} for {rate}");
        // Both components of a circle have the amplitude, so their root of the sum of squares is sqrt(2) of it.
        let amplitude = number(row, "acceleration line 1 amplitude [m/s²]");
        assert!((amplitude / expected / 2.0_f64.sqrt() - 1.0).abs() < 1e-2, "{amplitude}");
        assert!((number(row, "end time [s]") - 0.5).abs() < 1e-12);
    }
    // Between 3600 and 4800 rpm, 142.1 and 252.7 mm/s^2, the straight line crosses 200 mm/s^2 at 4228 rpm.
    assert!(shown.contains("4228.") && shown.contains(" to 6000 rpm"), "{shown}");
    let waterfall = text(&files["wheel-sweep-lines-acceleration.svg"]);
    assert!(waterfall.contains("1\u{d7}") && waterfall.contains("2\u{d7}"));
    assert_eq!(&files["wheel-sweep.npz"][..2], b"PK");
    // The page has the verdict, the worst sample, the speeds to keep out of and every picture.
    let page = text(&files["wheel-sweep.html"]);
    for part in ["The requirement is violated:", "requirement micro-g", "4228.", "violated by 2"] {
        assert!(page.contains(part), "{part} in the page");
    }
    let is_picture = |name: &&String| Path::new(name).extension().is_some_and(|of| of == "svg");
    let pictures = files.keys().filter(is_picture).count();
    assert_eq!(
        page.matches("<figcaption").count(),
        pictures,
        "all files but the page are pictures"
    );
}

#[test]
fn the_result_does_not_depend_on_threads_or_on_the_journal() {
    let (folder, file) = folder("threads");
    let run = |out: &str, threads: &str, more: &[&str]| {
        let out = folder.join(out);
        let over =
            ["--over", "device.rw.wheel.rate=600..3000 rpm:7", "--over", "hub.mass=50,96 kg"];
        let mut arguments = vec!["sweep", path(&file), "--threads", threads, "--out", path(&out)];
        arguments.extend(over);
        arguments.extend(more);
        let output = precess(&arguments);
        assert!(output.status.success(), "{}", text(&output.stderr));
        (results(&out), text(&output.stdout))
    };
    let (one, _) = run("a", "1", &[]);
    assert!(one.len() >= 4, "{:?}", one.keys());
    assert!(run("b", "5", &[]).0 == one, "threads");
    let (again, shown) = run("a", "3", &["--force"]);
    assert!(again == one, "from the journal");
    assert!(shown.contains("14 samples were in the journal"), "{shown}");
}

#[test]
fn a_sample_that_fails_is_a_row_with_its_error() {
    let (folder, file) = folder("poisoned");
    let out = folder.join("out");
    let arguments = ["sweep", path(&file), "--over", "hub.mass=96,-1,50 kg", "--out", path(&out)];
    let output = precess(&arguments);
    assert_eq!(output.status.code(), Some(2), "{}", text(&output.stderr));
    let shown = text(&output.stdout);
    assert!(shown.contains("1 of 3 samples failed; the first is sample 1"), "{shown}");
    let found = rows(&results(&out)["wheel-sweep.csv"]);
    let states: Vec<_> = found.iter().map(|row| row["state"].as_str()).collect();
    assert_eq!((states[0], states[2]), ("ok", "ok"));
    assert!(states[1].contains("mass"), "{states:?}");
    assert_eq!(found[1]["omega rms [rad/s]"], "");
}

#[test]
fn what_cannot_be_swept_is_refused_with_the_remedy() {
    let (folder, file) = folder("refused");
    let out = folder.join("out");
    let file = path(&file);
    for (arguments, part) in [
        (vec!["--over", "hub.maas=1,2 kg"], "maas"),
        (vec!["--over", "device.rv.wheel.rate=1,2 rpm"], "nothing is named `rv`"),
        (vec!["--over", "hub.mass=1,2 m"], "a mass is wanted"),
        (vec!["--over", "hub.mass=1,2 kg", "--column", "omga"], "nearest: `omega`"),
        (vec!["--over", "hub.mass=1,2 kg", "--from", "2 s"], "choose an earlier time"),
        (vec!["--over", "hub.mass=1,2 kg", "--over", "hub.mass=1,2 kg"], "two axes are of the key"),
        (
            vec!["--over", "hub.mass=1..9 kg:9999", "--over", "run.tolerance=1e-9..1e-8:9999"],
            "are not within 1 to 1000000",
        ),
        (vec!["--over", "hub.mass=1..2 kg"], "the count is missing"),
    ] {
        let all = [&["sweep", file, "--out", path(&out)], &arguments[..]].concat();
        let output = precess(&all);
        let message = text(&output.stderr);
        assert!(!output.status.success() && message.contains(part), "{arguments:?}: {message}");
    }
    assert!(!out.exists());
}

#[test]
fn a_journal_of_another_plan_or_scenario_is_refused() {
    let (folder, file) = folder("other");
    let out = folder.join("out");
    let run = |over: &str, more: &[&str]| {
        let mut all = vec!["sweep", path(&file), "--over", over, "--out", path(&out)];
        all.extend(more);
        precess(&all)
    };
    assert!(run("hub.mass=50,96 kg", &[]).status.success());
    // The result is there.
    assert!(text(&run("hub.mass=50,96 kg", &[]).stderr).contains("exists"));
    for name in results(&out).keys() {
        fs::remove_file(out.join(name)).expect("removed");
    }
    let refused = |output: std::process::Output| {
        let message = text(&output.stderr);
        assert!(message.contains("is no journal of this scenario, plan"), "{message}");
        assert!(message.contains("--force"), "{message}");
    };
    refused(run("hub.mass=50,97 kg", &[]));
    refused(run("hub.mass=50,96 kg", &["--set", "hub.inertia=21, 20, 20 kg m^2"]));
    refused(run("hub.mass=50,96 kg", &["--lines", "2"]));
    assert!(results(&out).is_empty());
    assert!(run("hub.mass=50,97 kg", &["--force"]).status.success());
}

#[test]
fn a_sweep_that_was_ended_while_it_wrote_its_files_is_continued() {
    let (folder, file) = folder("writing");
    let out = folder.join("out");
    let run =
        || precess(&["sweep", path(&file), "--over", "hub.mass=50,96 kg", "--out", path(&out)]);
    assert!(run().status.success());
    let whole = results(&out);
    // The table is written last.
    fs::remove_file(out.join("wheel-sweep.csv")).expect("removed");
    fs::rename(out.join("wheel-sweep.npz"), out.join("wheel-sweep.npz.partial")).expect("renamed");
    let output = run();
    assert!(output.status.success(), "{}", text(&output.stderr));
    assert!(results(&out) == whole, "another result");
}

#[test]
fn keys_are_linked_and_two_of_them_are_a_map_of_cells() {
    let (folder, file) = folder("linked");
    let second = "[[device]]\nname = \"rw2\"\ncopy_of = \"rw\"\n";
    let scenario =
        fs::read_to_string(&file).expect("a file").replace("[run]", &format!("{second}[run]"));
    fs::write(&file, scenario).expect("a file");
    let out = folder.join("out");
    let output = precess(&[
        "sweep",
        path(&file),
        "--over",
        "device.rw*.wheel.rate=1200..4800 rpm:3",
        "--over",
        "hub.inertia[x]+hub.inertia[y]=10,20 kg m^2",
        "--column",
        "acceleration",
        "--set",
        "run.duration=0.05 s",
        "--out",
        path(&out),
    ]);
    let shown = text(&output.stdout);
    assert_eq!(output.status.code(), Some(2), "{shown}{}", text(&output.stderr));
    assert!(shown.contains("is device.rw.wheel.rate, device.rw2.wheel.rate"), "{shown}");
    let files = results(&out);
    let found = rows(&files["wheel-sweep.csv"]);
    assert_eq!(found.len(), 6);
    for row in &found {
        // Two wheels at one rate and angle: twice the force on 104 kg, wheels and hub.
        let rate = number(row, "device.rw*.wheel.rate [rpm]") * TAU / 60.0;
        let expected = 2e-4 * rate * rate / 104.0;
        let value = number(row, "acceleration rms [m/s²]");
        assert!((value / expected - 1.0).abs() < CLOSED_FORM, "{value} for {expected}");
    }
    let map = text(&files["wheel-sweep-requirement-micro-g.svg"]);
    assert!(map.contains(">limit</text>") && map.contains("#FEE838"), "cells, contour and scale");
    let refused = precess(&["sweep", path(&file), "--over", "device.cmg*.mass=1,2 kg"]);
    let error = text(&refused.stderr);
    assert!(
        error.contains("nothing matches `device.cmg*`") && error.contains("rw, rw2"),
        "{error}"
    );
}

#[test]
fn a_sweep_of_a_sprung_wheel_has_a_campbell_diagram() {
    let (folder, file) = folder("campbell");
    let scenario = r#"format = 1
name = "wheel"
[hub]
mass = "400 kg"
inertia = "120, 110, 90 kg m^2"
[[device]]
name = "panel"
kind = "hinged_panel"
panel = { mass = "3 kg", inertia = "0.05, 0.2, 0.24 kg m^2", stiffness = "40 N m/rad", damping = "0.01 N m s/rad" }
[[device]]
name = "rw"
kind = "reaction_wheel"
imbalance = { static = "1 g cm" }
wheel = { mass = "4 kg", inertia = "288, 150, 150 kg cm^2", rate = "3000 rpm" }
[run]
duration = "0.05 s"
"#;
    fs::write(&file, scenario).expect("a file");
    let out = folder.join("out");
    let over = "device.rw.wheel.rate=60..600 rpm:4";
    let output = precess(&["sweep", path(&file), "--over", over, "--out", path(&out)]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let diagram = text(&results(&out)["wheel-sweep-campbell.svg"]);
    assert!(
        diagram.contains("Natural frequencies over") && diagram.contains("1\u{d7}"),
        "{diagram}"
    );
    // The frequencies of a rigid hub with its wheel are far below all orders; the lowest order is in the picture all the same.
    let from = scenario.find("[[device]]\nname = \"panel\"").expect("a panel");
    let to = scenario.find("[[device]]\nname = \"rw\"").expect("a wheel");
    fs::write(&file, scenario.replace(&scenario[from..to], "")).expect("a file");
    let output = precess(&["sweep", path(&file), "--over", over, "--out", path(&out), "--force"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let diagram = text(&results(&out)["wheel-sweep-campbell.svg"]);
    assert!(diagram.contains(">1\u{d7}</text>"), "{diagram}");
}
