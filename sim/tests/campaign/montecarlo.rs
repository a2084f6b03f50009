//! `montecarlo`: a number whose distribution is known, derivatives against the sample, threads, what is refused.

use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;

use super::shared::{folder, number, path, precess, results, rows, text};

/// Of the acceleration of the hub's origin, as in the sweep.
const CLOSED_FORM: f64 = 1e-4;
/// Of a derivative by central differences, steps of a twentieth of a deviation of a hundredth.
const DERIVATIVE: f64 = 1e-3;
/// Of a regression over deviations of a hundredth: what is not linear, and 200 samples of the other keys.
const REGRESSION: f64 = 0.05;

pub(super) const PLAN: &str = r#"format = 1
[[vary]]
key = "device.rw.imbalance.static"
distribution = "normal"
mean = "10 g cm"
deviation = "0.1 g cm"
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
"#;

pub(super) fn plan(folder: &Path, text: &str) -> PathBuf {
    let file = folder.join("plan.toml");
    fs::write(&file, text).expect("a file");
    file
}

pub(super) fn run(file: &Path, plan: &Path, out: &Path, more: &[&str]) -> Output {
    let mut arguments = vec!["montecarlo", path(file), "--plan", path(plan), "--out", path(out)];
    arguments.extend(["--column", "acceleration", "--set", "run.duration=0.05 s", "--lines", "0"]);
    arguments.extend(more);
    precess(&arguments)
}

/// `m s w^2 / M` of a row.
fn expected(row: &BTreeMap<String, String>) -> f64 {
    let rate = number(row, "device.rw.wheel.rate [rpm]") * TAU / 60.0;
    let imbalance = number(row, "device.rw.imbalance.static [g cm]") * 1e-5;
    imbalance * rate * rate / (4.0 + number(row, "hub.mass [kg]"))
}

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn a_near_linear_number_has_the_derivatives_of_its_closed_form_and_of_the_sample() {
    const NUMBER: &str = "acceleration rms [m/s²]";
    let (folder, file) = folder("derivatives");
    let plan = plan(&folder, PLAN);
    let out = folder.join("out");
    let more = ["--samples", "200", "--seed", "5", "--latin-hypercube", "--sensitivities"];
    let output = run(&file, &plan, &out, &more);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let files = results(&out);
    let table = rows(&files["wheel-montecarlo.csv"]);
    assert_eq!(table.len(), 200);
    let page = text(&files["wheel-montecarlo.html"]);
    for part in
        ["Percentiles", "Rank correlations", "Derivatives about the middle", "Latin hypercube"]
    {
        assert!(page.contains(part), "{part} in the page");
    }
    for row in &table {
        let share = number(row, NUMBER) / expected(row);
        assert!((share - 1.0).abs() < CLOSED_FORM, "{row:?}");
    }
    // d/dx of s w^2 / M at the middle.
    let center = 1e-4 * (50.0 * TAU).powi(2) / 100.0;
    let known = [
        ("device.rw.wheel.rate [rpm]", 2.0 * center / 3000.0, 100.0 / 12.0_f64.sqrt()),
        ("device.rw.imbalance.static [g cm]", center / 10.0, 0.1),
        ("hub.mass [kg]", -center / 100.0, 0.2),
    ];
    let derivatives = rows(&files["wheel-montecarlo-sensitivities.csv"]);
    let derivatives = derivatives.iter().filter(|row| row["number"] == "acceleration rms");
    for (row, (key, slope, deviation)) in derivatives.zip(known) {
        // Largest over a deviation first.
        assert_eq!(row["key"], key);
        let found = number(row, "derivative_si_by_key_unit");
        assert!((found / slope - 1.0).abs() < DERIVATIVE, "{key}: {found} for {slope}");
        let size = number(row, "times_deviation_si");
        assert!((size / (slope * deviation).abs() - 1.0).abs() < DERIVATIVE, "{key}: {size}");
        // The regression coefficient of the sample: keys are drawn independently.
        let count = f64::from(u32::try_from(table.len()).expect("few"));
        let mean = |of: &dyn Fn(&BTreeMap<String, String>) -> f64| {
            table.iter().map(of).sum::<f64>() / count
        };
        let (x, y) = (mean(&|row| number(row, key)), mean(&|row| number(row, NUMBER)));
        let product = mean(&|row| (number(row, key) - x) * (number(row, NUMBER) - y));
        let square = mean(&|row| (number(row, key) - x).powi(2));
        let off = (product / square - slope).abs() * deviation;
        let largest = known[0].1 * known[0].2;
        assert!(off < REGRESSION * largest, "{key}: {} for {slope}", product / square);
    }
    let ranks = rows(&files["wheel-montecarlo-correlations.csv"]);
    let rank = |key: &str| {
        let of = |row: &&BTreeMap<String, String>| {
            row["number"] == "acceleration rms" && row["key"] == key
        };
        number(ranks.iter().find(of).expect("a row"), "rank_correlation")
    };
    assert!(rank(known[0].0) > 0.7 && rank(known[1].0) > 0.2 && rank(known[2].0) < 0.0);
    assert!(text(&output.stdout).contains("largest derivative times deviation"));
}

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn percentiles_and_probabilities_are_those_of_the_closed_form() {
    let (folder, file) = folder("percentiles");
    // The acceleration is proportional to the imbalance: uniform from 0.09 to 0.11 of its middle, 0.0987 m/s^2.
    let uniform = "format = 1\n[[vary]]\nkey = \"device.rw.imbalance.static\"\n\
        distribution = \"uniform\"\nfrom = \"9 g cm\"\nto = \"11 g cm\"\n";
    let plan = plan(&folder, uniform);
    let out = folder.join("out");
    let middle = 1e-4 * (50.0 * TAU).powi(2) / 100.0;
    let limit = format!("requirement.micro-g.limit={} m/s^2", 1.05 * middle);
    let more = ["--samples", "400", "--seed", "3", "--set", limit.as_str()];
    let output = run(&file, &plan, &out, &more);
    assert_eq!(output.status.code(), Some(2), "{}", text(&output.stderr));
    let files = results(&out);
    let found = rows(&files["wheel-montecarlo-percentiles.csv"]);
    let of = |number: &str, percentile: &str| {
        let is = |row: &&BTreeMap<String, String>| {
            row["number"] == number && row["percentile"] == percentile
        };
        found.iter().find(is).expect("a row").clone()
    };
    for (share, name) in [(0.05, "5"), (0.5, "50"), (0.95, "95")] {
        let row = of("acceleration rms", name);
        let known = middle * (0.9 + 0.2 * share);
        // The seed is fixed: intervals of 0.95 contain the known percentiles.
        assert!(number(&row, "lower_si") <= known && known <= number(&row, "upper_si"), "{row:?}");
        assert!((number(&row, "value_si") / known - 1.0).abs() < 0.02, "{row:?}");
    }
    // The limit is at three quarters of the uniform distribution.
    let row = of("requirement micro-g", "probability of meeting");
    assert!(number(&row, "lower_si") < 0.75 && 0.75 < number(&row, "upper_si"), "{row:?}");
}

#[test]
fn more_samples_keep_the_earlier_rows_on_any_number_of_threads() {
    let (folder, file) = folder("more");
    let plan = plan(&folder, PLAN);
    let out = folder.join("out");
    let of = |out: &Path, more: &[&str]| {
        let output = run(&file, &plan, out, more);
        assert!(output.status.success(), "{}", text(&output.stderr));
        (results(out), text(&output.stdout))
    };
    let (few, _) = of(&out, &["--samples", "6", "--threads", "1"]);
    let (many, shown) = of(&out, &["--samples", "12", "--force", "--threads", "4"]);
    assert!(shown.contains("6 samples were in the journal"), "{shown}");
    let table = |files: &BTreeMap<String, Vec<u8>>| rows(&files["wheel-montecarlo.csv"]);
    assert_eq!(table(&few)[..], table(&many)[..6]);
    let (again, _) = of(&folder.join("b"), &["--samples", "12", "--threads", "3"]);
    assert!(again == many, "threads");
    let (other, _) = of(&folder.join("c"), &["--samples", "6", "--seed", "2"]);
    assert_ne!(table(&few)[0], table(&other)[0]);
}

#[test]
fn what_is_no_plan_is_refused_with_the_remedy() {
    let (folder, file) = folder("no-plan");
    let out = folder.join("out");
    let vary = |keys: &str| format!("format = 1\n[[vary]]\nkey = \"hub.mass\"\n{keys}\n");
    for (plan_text, part) in [
        ("format = 1".to_owned(), "[[vary]]"),
        (vary(""), "distribution = \"normal\""),
        (vary("distribution = \"nrmal\""), "nrmal"),
        (vary("distribution = \"normal\"\nmean = \"1 kg\""), "deviation = \"0.1 kg\""),
        (
            vary("distribution = \"normal\"\nmean = \"1 kg\"\ndeviation = \"1 m\""),
            "another dimension",
        ),
        (vary("distribution = \"normal\"\nmean = \"1 kg\"\ndeviation = \"0 kg\""), "above zero"),
        (vary("distribution = \"uniform\"\nfrom = \"2 kg\"\nto = \"1 kg\""), "not above `from`"),
        (vary("distribution = \"lognormal\"\nmedian = \"2 kg\"\nsigma = 9"), "at most five"),
        (vary("distribution = \"phase\"\nmena = 1"), "mena"),
        (PLAN.replace("hub.mass", "device.rw.wheel.rate"), "two axes are of the key"),
        (PLAN.replace("hub.mass", "hub.maas"), "maas"),
    ] {
        let plan = plan(&folder, &plan_text);
        let output = run(&file, &plan, &out, &["--samples", "3"]);
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{plan_text}: {message}");
        assert!(message.contains(part), "{plan_text}: {message}");
    }
    let plan = plan(&folder, PLAN);
    let output = run(&file, &plan, &out, &["--samples", "0"]);
    assert!(text(&output.stderr).contains("not within 1 to 1000000"));
    assert!(!out.exists());
}

const WHEELS: &str = r#"format = 1
name = "wheels"
[hub]
mass = "60 kg"
inertia = "4, 3.5, 3 kg m^2"
centre_of_mass = "1, 2, -1 mm"
[initial]
angular_velocity = "0.3, -0.2, 0.1 deg/s"
[[device]]
name = "rw1"
kind = "reaction_wheel"
position = "30, 10, -5 cm"
mount = { spin_axis = [0.2, 0.3, 1] }
imbalance = { static = "10 g cm", dynamic = "200 g cm^2", phase = "40 deg" }
[device.wheel]
mass = "4 kg"
inertia = "288, 150, 150 kg cm^2"
rate = "3000 rpm"
[[device]]
name = "cmg"
kind = "vscmg"
position = "-20, 10, 5 cm"
imbalance = { static = "4 g cm", dynamic = "50 g cm^2" }
[device.gimbal]
mass = "2 kg"
inertia = "90, 70, 80 kg cm^2"
stiffness = "400 N m/rad"
damping = "0.5 N m s/rad"
angle = "20 deg"
rest = "20 deg"
[device.wheel]
mass = "3 kg"
inertia = "200, 110, 110 kg cm^2"
rate = "2400 rpm"
torque = "5 mN m"
[[requirement]]
name = "band"
quantity = "omega"
statistic = "band_rms"
band = "20, 80 Hz"
limit = "1 rad/s"
[[requirement]]
name = "smear"
quantity = "omega"
statistic = "smear"
exposure = "10 ms"
limit = "1 rad/s"
[[requirement]]
name = "drift"
quantity = "omega"
statistic = "drift"
limit = "1 rad/s"
[run]
duration = "0.25 s"
integrator = "rk4"
step = "0.2 ms"
[output]
rate = "2 kHz"
"#;

const WHEELS_PLAN: &str = r#"format = 1
[[vary]]
key = "device.rw1.imbalance.static"
distribution = "normal"
mean = "10 g cm"
deviation = "1 g cm"
[[vary]]
key = "device.rw1.imbalance.phase"
distribution = "normal"
mean = "40 deg"
deviation = "10 deg"
[[vary]]
key = "device.rw1.wheel.rate+device.cmg.wheel.rate"
distribution = "uniform"
from = "2900 rpm"
to = "3100 rpm"
[[vary]]
key = "device.cmg.gimbal.stiffness"
distribution = "lognormal"
median = "400 N m/rad"
sigma = 0.1
[[vary]]
key = "hub.inertia[2]"
distribution = "normal"
mean = "3.5 kg m^2"
deviation = "0.1 kg m^2"
[[vary]]
key = "device.cmg.wheel.torque"
distribution = "normal"
mean = "5 mN m"
deviation = "1 mN m"
[[vary]]
key = "device.rw*.position[x]"
distribution = "normal"
mean = "30 cm"
deviation = "1 cm"
"#;

/// Exact derivatives of runs, against central differences of the same runs: RK4 of the scenario, so both are derivatives of the
/// same numbers. Steps of a hundredth of a deviation to either side leave a share of 1e-4 of the third derivative, and the
/// rounding of a run.
#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn exact_derivatives_are_those_of_central_differences_of_runs() {
    const NEAR: f64 = 1e-4;
    let (folder, file) = folder("exact");
    fs::write(&file, WHEELS).expect("a file");
    let plan_file = plan(&folder, WHEELS_PLAN);
    let variations = precess::file::variations_from_toml(&plan_file).expect("a plan");
    let template = precess::file::Template::from_file(&file).expect("a scenario");
    let columns = vec!["omega".to_owned(), "acceleration".to_owned(), "cmg.gamma".to_owned()];
    let selection = precess::campaign::Selection { columns, lines: 0, from: 0.05 };
    let found = precess::campaign::tangents(&template, &[], &variations, &selection)
        .expect("it is differentiated");
    println!("runs differ by {:e}", found.difference);
    assert!(found.difference < 1e-9, "the same steps: {:e}", found.difference);
    let middles: Vec<[f64; 2]> =
        variations.iter().map(|of| of.distribution.scale().expect("continuous")).collect();
    let numbers = |changed: usize, value: f64| -> Vec<f64> {
        let overrides: Vec<String> = variations
            .iter()
            .zip(&middles)
            .enumerate()
            .map(|(index, (of, [middle, _]))| {
                let value = if index == changed { value } else { *middle };
                format!("{} = \"{value:?} {}\"", of.key, of.unit)
            })
            .collect();
        let (mut scenario, _) = template.scenario(&overrides).expect("a scenario");
        scenario.output.columns.clone_from(&selection.columns);
        let mut reducer = precess::campaign::Reducer::new(&scenario, &selection);
        let progress = &mut |_| std::ops::ControlFlow::Continue(());
        precess::engine::run(&scenario, &mut reducer, progress).expect("a run");
        let row = reducer.row().expect("numbers");
        // Three requirements, then RMS and peak of each column.
        row[..9].to_vec()
    };
    for (key, [middle, deviation]) in middles.iter().enumerate() {
        let step = 0.01 * deviation;
        let (low, high) = (numbers(key, middle - step), numbers(key, middle + step));
        for (number, slopes) in found.slopes.iter().enumerate() {
            let exact =
                slopes.as_ref().expect("every number is of the state or its accelerations")[key];
            let difference = (high[number] - low[number]) / (2.0 * step);
            // By what the number is, over a deviation: a derivative may be next to zero.
            let size = 1e-6 * high[number].abs() / deviation;
            let apart = (exact - difference).abs();
            assert!(
                apart < NEAR * difference.abs() + size,
                "number {number} by key {}: {exact:e}, by differences {difference:e}",
                variations[key].key
            );
        }
    }
}

#[test]
fn exact_and_other_derivatives_are_told_apart() {
    let (folder, file) = folder("methods");
    let plan_file = plan(&folder, PLAN);
    let methods = |out: &str, more: &[&str]| {
        let out = folder.join(out);
        let all = [&["--samples", "12", "--sensitivities"], more].concat();
        let output = run(&file, &plan_file, &out, &all);
        assert!(output.status.success(), "{}", text(&output.stderr));
        let found = rows(&results(&out)["wheel-montecarlo-sensitivities.csv"]);
        let method = |row: &BTreeMap<String, String>| row["method"].clone();
        (found.iter().map(method).collect::<Vec<_>>(), text(&output.stdout))
    };
    let (found, shown) = methods("exact", &[]);
    assert!(found.iter().all(|method| method == "exact"), "{found:?}");
    assert!(shown.contains(", exact"), "{shown}");
    // Of the energy there are only differences.
    let (found, _) = methods("energy", &["--column", "energy"]);
    assert!(found.iter().any(|method| method == "exact"), "{found:?}");
    assert!(found.iter().any(|method| method == "difference"), "{found:?}");
    let wrench = "wrench=[{ on = \"hub\", force.x = \"1 N\" }]";
    let (found, shown) = methods("wrench", &["--set", wrench]);
    assert!(found.iter().all(|method| method == "difference"), "{found:?}");
    assert!(shown.contains("central differences: the scenario has wrenches"), "{shown}");
}
