//! `montecarlo` with keys that are correlated: the sample, an ended campaign, what is refused.

use std::fs;
use std::path::Path;
use std::process::Output;

use precess::campaign::spearman;

use super::shared::{folder, number, path, precess, results, rows, text};

const PLAN: &str = r#"format = 1
[[vary]]
key = "device.rw.imbalance.static"
distribution = "lognormal"
median = "10 g cm"
sigma = 0.2
[[vary]]
key = "device.rw.wheel.rate"
distribution = "uniform"
from = "2950 rpm"
to = "3050 rpm"
[[vary]]
key = "hub.mass"
distribution = "normal"
mean = "96 kg"
deviation = "0.2 kg"
[[correlation]]
between = ["hub.mass", "device.rw.imbalance.static"]
coefficient = 0.8
"#;

fn run(file: &Path, plan: &str, out: &Path, more: &[&str]) -> Output {
    let plan_file = file.with_file_name("plan.toml");
    fs::write(&plan_file, plan).expect("a file");
    let mut arguments =
        vec!["montecarlo", path(file), "--plan", path(&plan_file), "--out", path(out)];
    arguments.extend(["--set", "run.duration=0.01 s", "--lines", "0"]);
    arguments.extend(more);
    precess(&arguments)
}

/// The rank correlation is `6 / pi asin(0.4)`, with an error below one by the root of the samples; four of these.
#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn a_sample_is_correlated_and_an_ended_campaign_is_continued() {
    let (folder, file) = folder("correlated");
    let out = folder.join("out");
    let whole = run(&file, PLAN, &out, &["--samples", "200", "--threads", "2"]);
    assert!(whole.status.success(), "{}", text(&whole.stderr));
    let whole = results(&out);
    let table = rows(&whole["wheel-montecarlo.csv"]);
    let of = |key: &str| table.iter().map(|row| number(row, key)).collect::<Vec<f64>>();
    let mass = of("hub.mass [kg]");
    let imbalance = of("device.rw.imbalance.static [g cm]");
    let error = 4.0 / 200.0_f64.sqrt();
    let known = 6.0 / std::f64::consts::PI * 0.4_f64.asin();
    let found = spearman(&mass, &imbalance).expect("they vary");
    assert!((found - known).abs() < error, "{found} for {known}");
    let found = spearman(&mass, &of("device.rw.wheel.rate [rpm]")).expect("they vary");
    assert!(found.abs() < error, "{found}");

    let part = folder.join("part");
    let first = run(&file, PLAN, &part, &["--samples", "70", "--threads", "1"]);
    assert!(first.status.success(), "{}", text(&first.stderr));
    let rest = run(&file, PLAN, &part, &["--samples", "200", "--force", "--threads", "3"]);
    assert!(text(&rest.stdout).contains("70 samples were in the journal"));
    assert!(results(&part) == whole, "another result");

    // Another coefficient is another campaign.
    let other = PLAN.replace("0.8", "0.7");
    let refused = run(&file, &other, &out, &["--samples", "200"]);
    assert_eq!(refused.status.code(), Some(1));
}

#[test]
fn correlations_that_are_none_are_refused_with_the_remedy() {
    let (folder, file) = folder("no-correlation");
    let out = folder.join("out");
    let pair = |a: &str, b: &str, coefficient: &str| {
        format!("[[correlation]]\nbetween = [\"{a}\", \"{b}\"]\ncoefficient = {coefficient}\n")
    };
    let (rate, imbalance) = ("device.rw.wheel.rate", "device.rw.imbalance.static");
    for (more, part) in [
        (pair("hub.mas", rate, "0.5"), "no `[[vary]]` has the key `hub.mas`"),
        (pair("hub.mass", rate, "1"), "above -1 and below 1"),
        (pair("hub.mass", rate, "\"1 kg\""), "coefficient"),
        (pair(imbalance, "hub.mass", "0.5"), "remove one"),
        ("[[correlation]]\nbetween = \"hub.mass\"\n".to_owned(), "coefficient = 0.5"),
        (
            pair("hub.mass", rate, "0.9") + &pair(imbalance, rate, "-0.9"),
            "is above -0.9815 and below -0.4585",
        ),
    ] {
        let output = run(&file, &(PLAN.to_owned() + &more), &out, &["--samples", "3"]);
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{more}: {message}");
        assert!(message.contains(part), "{more}: {message}");
    }
    assert!(!out.exists());
}
