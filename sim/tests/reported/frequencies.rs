//! Budgets and bands: integrals over frequency, and what is compared with what.

use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use super::{CommandResult, case, folder, precess};

fn write(folder: &Path, name: &str, text: &str) -> String {
    let path = folder.join(name);
    fs::write(&path, text).expect("it is written");
    path.to_str().expect("text").to_owned()
}

fn jitter(folder: &Path, budget: &str, more: &[&str]) -> CommandResult {
    let budget = write(folder, "budget.toml", budget);
    let out = folder.join("out");
    let arguments = ["jitter", &budget, "--force", "--out", out.to_str().expect("text")];
    precess(&[&arguments[..], more].concat())
}

/// A force of constant density on a rigid hub of 100 kg with its wheel: the line of sight is the displacement x.
const NOISE: &str = r#"format = 1
[hub]
mass = "99 kg"
inertia = "10, 10, 10 kg m^2"
[[device]]
name = "rw"
kind = "balanced_reaction_wheel"
wheel = { mass = "1 kg", inertia = "0.02, 0.011, 0.011 kg m^2", rate = "3000 rpm" }
[[source]]
name = "noise"
on = "rw"
seed = 1
broadband = { BROADBAND }
[run]
duration = "1 s"
"#;

/// The RMS of each band in a budget of noise.
fn band_rms(folder: &Path, broadband: &str, bands: &[[f64; 2]]) -> Vec<f64> {
    write(folder, "noise.toml", &NOISE.replace("BROADBAND", broadband));
    let mut budget = String::from(
        "format = 1\nscenario = \"noise.toml\"\n[speed]\nfrom = \"600 rpm\"\nto = \"6000 rpm\"\ncount = 3\n\
         [[line_of_sight]]\nname = \"los\"\n[[line_of_sight.sensitivity]]\nnode = \"hub\"\n\
         x_by_displacement = [1, 0, 0]\n",
    );
    for [from, to] in bands {
        let _ = writeln!(
            budget,
            "[[requirement]]\nname = \"{from} {to}\"\nmetric = \"band_rms\"\nband = \"{from:?}, {to:?} Hz\"\n\
             limit = \"1 rad\""
        );
    }
    let ended = jitter(folder, &budget, &[]);
    assert_eq!(ended.code, Some(0), "{}{}", ended.out, ended.error);
    let csv = fs::read_to_string(folder.join("out/budget-requirements.csv")).expect("metrics");
    let row = csv.lines().nth(1).expect("a row");
    row.split(',').skip(1).map(|cell| cell.parse().expect("a number")).collect()
}

#[test]
fn noise_in_any_band_of_a_budget_is_its_integral() {
    let bands = [
        [100.0, 100.5],
        [33.0, 34.0],
        [60.0, 61.0],
        [150.0, 160.0],
        [10.0, 20.0],
        [1.0, 7.0],
        [1.0, 900.0],
    ];
    let found =
        band_rms(&folder("noise"), "band = \"5, 200 Hz\", force_x = \"1e-6 N^2/Hz\"", &bands);
    for ([from, to], found) in bands.into_iter().zip(found) {
        let (a, b): (f64, f64) = (from.max(5.0), to.min(200.0));
        let square = 1e-6 / (100.0_f64.powi(2) * TAU.powi(4)) * (a.powi(-3) - b.powi(-3)) / 3.0;
        let expected = square.sqrt();
        // The stated bound of noise on a rigid hub.
        assert!((found / expected - 1.0).abs() < 1e-9, "{from} {to}: {found:e} for {expected:e}");
    }
}

/// A table that goes beyond its band, and whose corners are within the bands of the metric.
#[test]
fn a_table_of_noise_counts_within_its_band_only() {
    let bands = [[1.0, 900.0], [15.0, 25.0], [45.0, 60.0]];
    let broadband = "band = \"10, 50 Hz\", frequencies = \"1, 20, 1000 Hz\", \
                     force_x = \"1e-6, 4e-4, 1.6e-7 N^2/Hz\"";
    let found = band_rms(&folder("noise-table"), broadband, &bands);
    for ([from, to], found) in bands.into_iter().zip(found) {
        // 1e-6 f^2 up to 20 Hz, then 4e-4 (f / 20)^-2 = 0.16 f^-2, over f^4.
        let (a, b): (f64, f64) = (from.max(10.0), to.min(50.0));
        let rising = |a: f64, b: f64| if a < b { 1e-6 * (1.0 / a - 1.0 / b) } else { 0.0 };
        let falling =
            |a: f64, b: f64| if a < b { 0.16 * (a.powi(-5) - b.powi(-5)) / 5.0 } else { 0.0 };
        let sum = rising(a, b.min(20.0)) + falling(a.max(20.0), b);
        let expected = (sum / (100.0_f64.powi(2) * TAU.powi(4))).sqrt();
        assert!((found / expected - 1.0).abs() < 1e-9, "{from} {to}: {found:e} for {expected:e}");
    }
}

/// A tone of a moment of 1e-9 kg m^2 at twice the rate, on a hub of 2 kg m^2: no imbalance beside it.
#[test]
fn a_budget_whose_only_tones_are_of_sources_needs_no_comparison() {
    let folder = folder("sources-only");
    write(
        &folder,
        "wheel.toml",
        r#"format = 1
[hub]
mass = "50 kg"
inertia = "2, 2, 2 kg m^2"
[[device]]
name = "rw"
kind = "reaction_wheel"
mount = { spin_axis = [1, 0, 0] }
imbalance_model = "balanced"
wheel = { mass = "0.5 kg", inertia = "1e-4, 6e-5, 6e-5 kg m^2", rate = "3000 rpm" }
[[source]]
name = "table"
on = "rw"
spin_axis = "z"
seed = 1
[[source.harmonic]]
number = 2
radial_moment = "1e-9 kg m^2"
[run]
duration = "1 s"
"#,
    );
    let budget = "format = 1\nscenario = \"wheel.toml\"\n[speed]\nfrom = \"600 rpm\"\nto = \"6000 rpm\"\n\
                  count = 55\n[[line_of_sight]]\nname = \"los\"\nnode = \"hub\"\nboresight = [0, 0, 1]\n\
                  [[requirement]]\nname = \"rms\"\nmetric = \"rms\"\nlimit = \"1 urad\"\n";
    for more in [&[][..], &["--compare", "3000 rpm"], &["--no-compare"]] {
        let ended = jitter(&folder, budget, more);
        assert_eq!(ended.code, Some(0), "{more:?}: {}{}", ended.out, ended.error);
        let why = "without sources, and no rotor is out of balance";
        assert!(ended.out.contains(why), "{more:?}: {}", ended.out);
        let csv = fs::read_to_string(folder.join("out/budget-requirements.csv")).expect("metrics");
        let row = csv.lines().nth(1).expect("a row");
        let found: f64 =
            row.split(',').nth(1).and_then(|cell| cell.parse().ok()).expect("a metric");
        // As reported: 8.84e-11 rad. A moment about one of the two axes that the line of sight has.
        assert!((found / 8.84e-11 - 1.0).abs() < 1e-3, "{found:e}");
    }
}

/// Four gyros in a pyramid whose amplitudes cancel on the line of sight but for some millionths.
#[test]
fn amplitudes_that_cancel_are_compared_in_units_of_what_does_not() {
    let folder = folder("cancelling");
    let out = folder.join("out");
    let budget = case("gyro-pyramid-jitter.toml");
    let ended = precess(&["jitter", &budget, "--out", out.to_str().expect("text")]);
    assert_eq!(ended.code, Some(0), "{}{}", ended.out, ended.error);
    let line = ended.out.lines().find(|line| line.starts_with("coupled run at"));
    let line = line.expect("a comparison");
    for part in ["% of the magnitudes of their tones", "within 1 % off resonance"] {
        assert!(line.contains(part), "{part} in {line}");
    }
    let page = fs::read_to_string(out.join("gyro-pyramid-jitter.html")).expect("a page");
    assert!(page.contains("these do not vanish where an amplitude cancels"));
}

/// The S2E sample wheel has its own fundamental at 1.01 beside an imbalance.
#[test]
fn a_fundamental_beside_an_imbalance_is_refused_or_warned_of() {
    let folder = folder("fundamental");
    let text = |number: &str, more: &str| {
        format!(
            "format = 1\n[hub]\nmass = \"50 kg\"\ninertia = \"2, 2, 2 kg m^2\"\n[[device]]\nname = \"rw\"\n\
             kind = \"reaction_wheel\"\nmount = {{ spin_axis = [1, 0, 0] }}\n\
             imbalance = {{ static = \"2.18e-7 kg m\", dynamic = \"6.3e-9 kg m^2\" }}\n\
             wheel = {{ mass = \"0.5 kg\", inertia = \"1e-4, 6e-5, 6e-5 kg m^2\", rate = \"3000 rpm\" }}\n\
             [run]\nduration = \"1 s\"\n[[source]]\nname = \"table\"\non = \"rw\"\nspin_axis = \"z\"\nseed = 1\n{more}\
             [[source.harmonic]]\nnumber = {number}\nradial_force = \"2.18e-07 N s^2/rad^2\"\n"
        )
    };
    let check = |number: &str, more: &str| {
        let file = write(&folder, "both.toml", &text(number, more));
        precess(&["check", &file])
    };
    for number in ["0.99", "1", "1.01"] {
        let ended = check(number, "");
        assert_eq!(ended.code, Some(1), "{number}: {}", ended.out);
        assert!(ended.error.contains("within 0.01 of 1"), "{number}: {}", ended.error);
    }
    for number in ["0.97", "0.985", "1.011", "1.03"] {
        let ended = check(number, "");
        assert_eq!(ended.code, Some(0), "{number}: {}", ended.error);
        for part in ["is either the fundamental", "or a tone of its own", "both.toml:"] {
            assert!(ended.out.contains(part), "{number}: {part} in {}", ended.out);
        }
    }
    for (number, more) in [("0.96", ""), ("1.04", ""), ("1.02", "fundamental_removed = true\n")] {
        let ended = check(number, more);
        assert_eq!(ended.code, Some(0), "{number}: {}", ended.error);
        assert!(!ended.out.contains("fundamental"), "{number}: {}", ended.out);
    }
}

/// A second of a wheel at 50 Hz, and bands that begin 1 Hz above it or end 1 Hz below.
#[test]
fn a_tone_beside_the_band_of_a_run_does_not_leak_into_it() {
    let folder = folder("leak");
    let requirement = |name: &str, band: &str| {
        format!(
            "[[requirement]]\nname = \"{name}\"\nquantity = \"omega\"\nstatistic = \"band_rms\"\n\
             band = \"{band}\"\nlimit = \"1 rad/s\"\n"
        )
    };
    let text = format!(
        "format = 1\n[hub]\nmass = \"50 kg\"\ninertia = \"2, 2, 2 kg m^2\"\n[[device]]\nname = \"rw\"\n\
         kind = \"reaction_wheel\"\nposition = \"10, 0, 0 cm\"\n\
         imbalance = {{ static = \"1 g cm\", dynamic = \"10 g cm^2\" }}\n\
         wheel = {{ mass = \"4 kg\", inertia = \"2e-2, 1.1e-2, 1.1e-2 kg m^2\", rate = \"3000 rpm\" }}\n\
         [run]\nduration = \"1 s\"\n[output]\nrate = \"1 kHz\"\n{}{}{}{}",
        requirement("above", "51, 80 Hz"),
        requirement("below", "20, 49 Hz"),
        requirement("with", "40, 60 Hz"),
        requirement("all", "0, 500 Hz"),
    );
    let (scenario, _) = precess::file::from_toml("leak", &text, &folder)
        .unwrap_or_else(|errors| panic!("{errors}"));
    let mut statistics = precess::record::Statistics::new(&scenario.requirements);
    precess::engine::run(&scenario, &mut statistics, &mut |_| std::ops::ControlFlow::Continue(()))
        .expect("it runs");
    let value = |name: &str| {
        let of = statistics.verdicts().iter().find(|verdict| verdict.name == name);
        of.and_then(|verdict| verdict.value).expect("a value")
    };
    assert!(value("with") > 0.0);
    for name in ["above", "below"] {
        let leaked = value(name) / value("with");
        assert!(leaked < 1e-3, "{name}: {leaked}");
    }
    // The band that holds everything has it, too.
    assert!(value("all") >= value("with"), "{} {}", value("all"), value("with"));
}
