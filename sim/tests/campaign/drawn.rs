//! Errors of drawn values, `--no-report`, and what correlations say beside their size.

use super::montecarlo::{PLAN, plan, run};
use super::shared::{folder, number, path, precess, results, rows, text};

#[test]
fn an_error_of_a_drawn_value_is_at_its_entry_of_the_plan() {
    let (folder, file) = folder("drawn-errors");
    let negative = "format = 1\n[[vary]]\nkey = \"hub.mass\"\ndistribution = \"uniform\"\nfrom = \"-9 kg\"\n\
        to = \"-8 kg\"\n[[vary]]\nkey = \"device.rw.wheel.rate\"\ndistribution = \"uniform\"\nfrom = \"9 kg\"\n\
        to = \"10 kg\"\n";
    let drawn = plan(&folder, negative);
    let output = run(&file, &drawn, &folder.join("out"), &["--samples", "3"]);
    assert_eq!(output.status.code(), Some(1));
    let shown = text(&output.stderr);
    for part in ["plan.toml:3:7", "sample 0 draws hub.mass = \"-8.", "plan.toml:8:7"] {
        assert!(shown.contains(part), "{part}\n{shown}");
    }
    // An error elsewhere has the values in its help.
    let far = "format = 1\n[[vary]]\nkey = \"device.rw.wheel.rate\"\ndistribution = \"uniform\"\nfrom = \"400 rad/s\"\n\
        to = \"401 rad/s\"\n";
    let drawn = plan(&folder, far);
    let limit = ["--samples", "3", "--set", "device.rw.wheel.rate_limit=350 rad/s"];
    let shown = run(&file, &drawn, &folder.join("out"), &limit);
    let shown = text(&shown.stderr);
    for part in
        ["beyond its `rate_limit` 350 rad/s", "sample 0 draws device.rw.wheel.rate = \"400."]
    {
        assert!(shown.contains(part), "{part}\n{shown}");
    }
    // Of a sweep the option is named.
    let over = ["sweep", path(&file), "--over", "hub.mass=-2,-1 kg", "--out", path(&folder)];
    let shown = precess(&over);
    let shown = text(&shown.stderr);
    for part in ["--over hub.mass = ", "sample 0 has hub.mass = \"-2 kg\""] {
        assert!(shown.contains(part), "{part}\n{shown}");
    }
}

#[test]
fn without_a_report_there_is_no_page_and_correlations_have_their_probability_by_chance() {
    let (folder, file) = folder("no-report");
    let drawn = plan(&folder, PLAN);
    let out = folder.join("out");
    let output = run(&file, &drawn, &out, &["--samples", "12", "--no-report"]);
    let shown = text(&output.stdout);
    let files = results(&out);
    assert!(files.keys().all(|name| !name.contains(".html")), "{:?}", files.keys());
    assert!(shown.contains("wheel-montecarlo.csv and "), "{shown}");
    assert!(shown.contains("rank correlation") && shown.contains("(12 samples, p "), "{shown}");
    for row in rows(&files["wheel-montecarlo-correlations.csv"]) {
        let (r, chance) = (number(&row, "rank_correlation"), number(&row, "p_value"));
        assert!(row["samples"] == "12" && (0.0..=1.0).contains(&chance), "{row:?}");
        // Student's t with 10 degrees of freedom: 0.576 at 0.05.
        assert_eq!(chance < 0.05, r.abs() > 0.576, "{row:?}");
    }
    // Of fewer than ten samples none is judged.
    let few = run(&file, &drawn, &folder.join("few"), &["--samples", "6", "--no-report"]);
    let shown = text(&few.stdout);
    assert!(shown.contains("largest rank correlation"), "{shown}");
    assert!(shown.contains("(6 samples, too few to judge)"), "{shown}");
    assert!(!shown.contains("significant"), "{shown}");
}
