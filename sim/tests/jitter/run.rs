//! Lines against runs of the coupled, nonlinear equations: off resonance, at it, with gyroscopic whirls, on springs.

use std::path::Path;

use precess::file::{budget_from_toml, from_file, from_toml};
use precess::jitter::budget::{Budget, Sight};
use precess::jitter::campbell::oscillations;
use precess::jitter::coupled::compare;
use precess::jitter::device::Steady;
use precess::jitter::model::Model;
use precess::jitter::sensitivity::sensitivities;
use precess::jitter::sweep::{Phases, speeds, sweep};
use precess::pointing::LineOfSight;
use precess::scenario::Scenario;
use precess::structure::dynamic_mass::Motor;

/// What the two paths may differ by off resonance, and at it.
const OFF: f64 = 0.01;
const AT: f64 = 0.05;

fn budget(node: &str) -> Budget {
    let line = LineOfSight::rigid(node, &nalgebra::Vector3::z(), &nalgebra::Vector3::x());
    Budget {
        title: "test".into(),
        speeds: [60.0, 700.0],
        count: 65,
        swept: Vec::new(),
        phases: Phases::Given,
        motor: Motor::ConstantTorque,
        sprung: true,
        sights: vec![Sight { name: "sight".into(), line: line.expect("a direction") }],
        limits: Vec::new(),
    }
}

fn read(name: &str) -> Scenario {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenarios").join(name);
    let (scenario, _) = from_file(&path, &[]).unwrap_or_else(|errors| panic!("{errors}"));
    scenario
}

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn the_satellite_with_twenty_modes_off_resonance_and_at_it() {
    let scenario = read("imaging-satellite-flexible.toml");
    let budget = budget("camera");
    let steady = Steady { motor: budget.motor, sprung: true, swept: Some(&[]) };
    let model = Model::new(&scenario, &budget.outputs(), &steady).expect("valid");
    let size = |speed: f64| -> f64 {
        let lines = model.lines(speed).expect("damped");
        let values =
            |k: usize| lines.iter().map(|line| line.values[k]).sum::<nalgebra::Complex<f64>>();
        values(0).norm().hypot(values(1).norm())
    };
    // The largest peak of the range, found on a grid that is finer than its width.
    let steps = 4000;
    let at = |k: i32| 60.0 * (700.0_f64 / 60.0).powf(f64::from(k) / f64::from(steps));
    let worst = (0..=steps).max_by(|a, b| size(at(*a)).total_cmp(&size(at(*b)))).expect("some");
    let peak = at(worst);
    assert!((1..steps).contains(&worst), "a peak within the range, at {peak} rad/s");
    let natural = oscillations(&model, peak).expect("regular");
    let nearest = natural.iter().map(|of| (of.frequency / peak - 1.0).abs()).fold(1.0, f64::min);
    assert!(nearest < 0.005, "it is a resonance: {nearest}");
    // Away from every natural frequency by a tenth.
    let clear = |speed: &f64| natural.iter().all(|of| (of.frequency / speed - 1.0).abs() > 0.06);
    let off: Vec<f64> = (0..=steps).map(at).filter(clear).collect();
    let off = off[off.len() / 2];
    for (speed, bound) in [(off, OFF), (peak, AT)] {
        let found = compare(&scenario, &budget, speed).expect("it runs");
        assert!(found.lines.iter().any(|(_, values)| values[0][0].norm() > 0.0));
        let difference = found.difference();
        println!("{speed} rad/s, {} s: {difference:e}", found.window);
        assert!(difference < bound, "{speed} rad/s: {difference:e}");
    }
}

/// A wheel on bearings in a free hub: radial and axial slides and two whirls, with their dampers.
#[test]
fn a_wheel_on_its_bearings_below_and_at_a_whirl() {
    let text = r#"
format = 1
[hub]
mass = "40 kg"
inertia = "4, 3.5, 3 kg m^2"
[[device]]
name = "rw"
kind = "flexible_reaction_wheel"
position = "10, -5, 20 cm"
mount = { spin_axis = [1, 1, 0] }
imbalance = { static = "0.1 g cm", dynamic = "2 g cm^2" }
[device.axial_slide]
stiffness = "2e6 N/m"
damping = "60 N s/m"
[device.radial_slide_y]
stiffness = "8e6 N/m"
damping = "120 N s/m"
[device.radial_slide_z]
stiffness = "8e6 N/m"
damping = "120 N s/m"
[device.tilt_y]
stiffness = "3200 N m/rad"
damping = "0.2 N m s/rad"
[device.tilt_z]
stiffness = "3200 N m/rad"
damping = "0.2 N m s/rad"
[device.wheel]
mass = "4 kg"
inertia = "0.015, 0.02, 0.02 kg m^2"
rate = "300 rad/s"
[run]
duration = "1 s"
"#;
    let (scenario, _) =
        from_toml("soft", text, Path::new("")).unwrap_or_else(|errors| panic!("{errors}"));
    let budget = budget("hub");
    // The forward whirl of a slender rotor meets the order 1 at sqrt(k / (J_t - J_s)) = 800 rad/s.
    for (speed, bound) in [(300.0, OFF), (795.0, AT)] {
        let found = compare(&scenario, &budget, speed).expect("it runs");
        println!("{speed} rad/s, {} s: {:e}", found.window, found.difference());
        assert!(found.difference() < bound, "{speed} rad/s: {:e}", found.difference());
    }
}

#[test]
fn the_budget_of_the_scenarios_is_read_and_a_wrong_one_says_everything() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenarios");
    let (budget, scenario) =
        budget_from_toml(&folder.join("budgets/imaging-satellite-jitter.toml"), &[])
            .unwrap_or_else(|errors| panic!("{errors}"));
    assert_eq!((budget.count, budget.sights.len(), budget.limits.len()), (601, 1, 3));
    assert!(scenario.ends_with("imaging-satellite-flexible.toml"));
    let wrong = std::env::temp_dir().join(format!("precess-budget-{}.toml", std::process::id()));
    let text = "format = 1\nphases = \"random\"\n[speed]\nfrom = \"0 rpm\"\nto = \"9 rpm\"\n\
                [[line_of_sight]]\nname = \"a\"\n[[line_of_sight]]\nnode = \"b\"\n\
                [[requirement]]\nmetric = \"smear\"\nlimit = \"3 kg\"\nwindow = 1\n";
    std::fs::write(&wrong, text).expect("it is written");
    let found = budget_from_toml(&wrong, &[]).expect_err("much is wrong").to_string();
    std::fs::remove_file(&wrong).expect("it was written");
    for part in [
        "`scenario` is missing",
        "phases",
        "`speed.from` is 0 rpm; a wheel at rest has no tones",
        "a line of sight is of one rigid instrument",
        "exposure` is missing",
        "unknown key",
    ] {
        assert!(found.contains(part), "{part} in:\n{found}");
    }
}

/// One percent more of every amplitude is one percent more of the metric; at a resonance the damping ratio of its mode counts
/// nearly as much, and no other.
#[test]
fn sensitivities_are_shares_and_the_damping_of_the_mode_at_resonance() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../scenarios/budgets/imaging-satellite-jitter.toml");
    let (budget, scenario) =
        budget_from_toml(&path, &[]).unwrap_or_else(|errors| panic!("{errors}"));
    let (scenario, _) = from_file(&scenario, &[]).unwrap_or_else(|errors| panic!("{errors}"));
    let steady = Steady { motor: budget.motor, sprung: budget.sprung, swept: Some(&[]) };
    let model = Model::new(&scenario, &budget.outputs(), &steady).expect("valid");
    let speeds = speeds(budget.speeds, budget.count);
    let found = sweep(&model, &speeds, 2, &|_| {}).expect("damped");
    let assessed = budget.assess(&found).expect("lines");
    let names: Vec<String> = model.contributors().into_iter().map(|of| of.rotor).collect();
    let worst = &assessed[1];
    let all = sensitivities(&model, &budget, worst, speeds[worst.worst], &names).expect("damped");
    let amplitudes = all.iter().filter(|of| of.parameter.starts_with("amplitude"));
    let sum: f64 = amplitudes.map(|of| of.ratio).sum();
    assert!((sum - 1.0).abs() < 1e-12, "{sum}");
    let damping = all.iter().filter(|of| of.parameter.starts_with("damping"));
    let sum: f64 = damping.map(|of| of.ratio).sum();
    assert!((-1.0..-0.5).contains(&sum), "{sum}: {all:?}");
    assert!(all[0].parameter.starts_with("frequency"), "{:?}", all[0]);
}
