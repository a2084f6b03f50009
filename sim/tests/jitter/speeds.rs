//! What a budget says of speeds: the worst one of a flat curve, rotors at their own, rotors at rest.

use precess::jitter::budget::worst_of;

use super::cubesat::{files, found, jitter, precess};

/// A metric of a rigid hub is the same at all speeds to this.
const FLAT: f64 = 1e-8;

/// Metrics that do not vary have the first speed, everywhere and in one sentence.
#[test]
fn a_flat_metric_is_worst_at_the_first_speed() {
    assert_eq!(worst_of(&[1.0, 1.0 + 1e-12, 1.0 - 1e-12]), 0);
    assert_eq!(worst_of(&[1.0, 1.1, 1.1, 0.5]), 1, "the first of equal ones");
    let folder = files("flat", "given");
    for assessed in found(&folder, &[]).assessed {
        assert!(assessed.is_flat() && assessed.worst == 0, "{assessed:?}");
        assert!(assessed.by_phases.iter().all(|of| of.worst == 0));
    }
    let sentence = "1000 rpm, the same at every speed";
    let (_, shown, _, page) = jitter(&folder, &[]);
    assert_eq!(shown.matches(sentence).count(), 3, "{shown}");
    for name in ["pointing x", "pointing y", "pointing z"] {
        let heading = format!("{name} at {sentence}");
        // Of contributors and of sensitivities.
        assert!(page.matches(&heading).count() >= 2, "{heading}");
    }
    // The same of values of a key that nothing depends on.
    let over = "device.wheel1.wheel.torque_limit=1,2,3 mNm";
    let sweep = ["sweep", "cubesat.toml", "--over", over, "--set", "run.duration=0.1 s"];
    let sweep = precess(&folder, &[&sweep[..], &["--no-report", "--lines", "0"]].concat());
    let shown = String::from_utf8_lossy(&sweep.stdout).into_owned();
    assert!(shown.contains("1 mNm, the same at every value"), "{shown}");
    std::fs::remove_dir_all(folder).expect("it was made");
}

/// Each wheel at its own speed: three frequencies, whose squares are added with any phases, as a run has them.
#[test]
fn the_scenario_as_it_is_agrees_with_its_run() {
    let folder = files("own", "given");
    let of = found(&folder, &[]);
    let own = of.budget.at_own_speeds(&of.scenario).expect("a rigid hub");
    let run = precess(&folder, &["run", "cubesat.toml", "--no-report"]);
    let run = String::from_utf8_lossy(&run.stdout).into_owned();
    let (code, shown, notes, page) = jitter(&folder, &[]);
    assert_eq!(code, Some(0), "{notes}");
    let rows: Vec<&str> =
        shown.lines().filter(|line| line.contains("as in the scenario")).collect();
    let table = std::fs::read_to_string(folder.join("out/budget-scenario.csv")).expect("a table");
    for (index, (own, name)) in
        own.iter().zip(["pointing x", "pointing y", "pointing z"]).enumerate()
    {
        let size = of.budget.limits[index].1.unit.1;
        let value = own.by_phases[0].1.value;
        let of_run = run.lines().find_map(|line| line.trim().strip_prefix(&format!("{name}: ")));
        let of_run = of_run.and_then(|text| text.split(' ').next()?.parse::<f64>().ok());
        let of_run = of_run.unwrap_or_else(|| panic!("{name} in:\n{run}"));
        // The run prints four digits.
        assert!((value / size / of_run - 1.0).abs() < 1e-3, "{name}: {value} for {of_run}");
        for (_, margin) in &own.by_phases {
            assert!((margin.value / value - 1.0).abs() < 1e-14, "phases do not count");
        }
        let words: Vec<&str> = rows[index].split_whitespace().collect();
        assert_eq!(words[..5], ["as", "in", "the", "scenario", "met"]);
        let printed: f64 = words[5].parse().expect("a number");
        assert!((printed * size / value - 1.0).abs() < 1e-5, "{}", rows[index]);
        assert!(page.contains(&format!("{name}, as in the scenario")), "in the page");
        let head = name.replace(' ', "_");
        let row = table.lines().find(|line| line.starts_with(&format!("{head},given,")));
        let row: Vec<&str> =
            row.unwrap_or_else(|| panic!("{name} in:\n{table}")).split(',').collect();
        assert_eq!((row[2], row[3].parse()), ("met", Ok(value)));
    }
    // Wheels of one speed have one frequency, and the scenario as it is has that of the sweep.
    let same = [1, 2].map(|k| format!("device.wheel{}.wheel.rate = \"3000 rpm\"", k + 1));
    let of = found(&folder, &same);
    let own = of.budget.at_own_speeds(&of.scenario).expect("a rigid hub");
    for (own, assessed) in own.iter().zip(&of.assessed) {
        for ((_, margin), by) in own.by_phases.iter().zip(&assessed.by_phases) {
            assert!((margin.value / by.margin.value - 1.0).abs() < FLAT, "{:?}", by.phases);
        }
    }
    std::fs::remove_dir_all(folder).expect("it was made");
}

#[test]
fn wheels_at_rest_are_named() {
    let folder = files("rest", "unknown");
    let (code, _, notes, page) = jitter(&folder, &["--set", "device.wheel1.wheel.rate=0 rpm"]);
    assert_eq!(code, Some(0), "{notes}");
    assert_eq!(
        notes.matches("warning: `wheel1.wheel` is at rest in the scenario").count(),
        1,
        "{notes}"
    );
    assert!(page.contains("2 of 3 rotors; at rest: wheel1.wheel"), "the summary");
    assert!(page.contains("is at rest in the scenario"), "the warnings");
    // One that is not swept is as the scenario has it; one that is named is.
    let of = |rotors: &str| {
        let rotors = format!("budget.speed.rotors={rotors}");
        jitter(&folder, &["--set", "device.wheel1.wheel.rate=0 rpm", "--set", &rotors])
    };
    let (_, _, notes, _) = of("[\"wheel2.wheel\"]");
    assert!(!notes.contains("at rest"), "{notes}");
    let (_, _, notes, page) = of("[\"wheel1.wheel\", \"wheel2.wheel\"]");
    assert!(notes.contains("`wheel1.wheel` is at rest"), "{notes}");
    assert!(page.contains("wheel1.wheel (at rest), wheel2.wheel"), "the summary");
    std::fs::remove_dir_all(folder).expect("it was made");
}

/// Metrics on one page are compared: their axes are of one kind, though only one of them spans decades with its limit.
#[test]
fn metrics_of_a_page_have_axes_of_one_kind() {
    let folder = files("axes", "given");
    let of = |more: &[&str]| {
        let (_, _, notes, page) = jitter(&folder, more);
        let (_, data) =
            page.split_once("id=\"precess-report\">").unwrap_or_else(|| panic!("{notes}"));
        let data: serde_json::Value =
            serde_json::from_str(data.split_once("</script>").expect("its end").0).expect("JSON");
        let planes = data["planes"].as_array().expect("charts").clone();
        let of_metrics = planes.iter().filter(|plane| {
            plane["static"].as_str().is_some_and(|id| id.starts_with("figure-requirement"))
        });
        of_metrics.map(|plane| plane["log"].as_bool().expect("yes or no")).collect::<Vec<_>>()
    };
    // 0.062, 0.080 and 0.071 arcsec.
    assert_eq!(of(&[]), [true; 3]);
    let limits = ["x", "y", "z"]
        .map(|axis| format!("budget.requirement.\"pointing {axis}\".limit=1 arcsec"));
    assert_eq!(of(&["--set", &limits[0], "--set", &limits[1], "--set", &limits[2]]), [false; 3]);
    std::fs::remove_dir_all(folder).expect("it was made");
}

/// What is wrong is quoted as it was typed; numbers have no exponent where none is needed.
#[test]
fn messages_have_keys_and_numbers_as_they_were_written() {
    let folder = files("messages", "given");
    for (set, key) in [
        ("budget.speed.count=1", "budget.speed.count"),
        ("budget.phases=random", "budget.phases"),
        ("budget.scenario=none.toml", "budget.scenario"),
        ("budget.speed.rotors=[\"rw\"]", "budget.speed.rotors"),
        ("budget.requirement.*.limti=1", "budget.requirement"),
    ] {
        let (code, _, notes, _) = jitter(&folder, &["--set", set]);
        assert_eq!(code, Some(1), "{set}: {notes}");
        assert!(notes.contains(&format!("--set {key}")), "{set}:\n{notes}");
        let rest = key.trim_start_matches("budget.");
        assert!(!notes.contains(&format!("--set {rest}")), "{set}:\n{notes}");
    }
    let band = "budget.requirement.\"pointing x\".band=500, 600 Hz";
    let (code, shown, notes, _) = jitter(&folder, &["--set", band]);
    assert_eq!(code, Some(3), "{notes}");
    assert!(
        shown.contains("no tone and no noise is within 500 Hz to 600 Hz at any speed"),
        "{shown}"
    );
    let row = shown.lines().filter(|line| line.contains("as in the scenario")).collect::<Vec<_>>();
    assert!(row[0].contains("not evaluated") && row[1].contains("met"), "{shown}");
    std::fs::remove_dir_all(folder).expect("it was made");
}
