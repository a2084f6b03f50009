//! Files of `scenarios` with a controller, run to their end: their requirements are met, and each shows what it is for.

use std::ops::ControlFlow;
use std::path::Path;

use precess::engine::run;
use precess::file::from_file;
use precess::record::{RecorderGroup, Samples, Statistics};
use precess::scenario::{NullMotion, Scenario};

use super::column;

fn scenario(name: &str) -> Scenario {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenarios");
    let read = from_file(&folder.join(format!("{name}.toml")), &[]);
    read.unwrap_or_else(|errors| panic!("{errors}")).0
}

/// The samples of a run to its duration, and whether each requirement is met.
fn ran(scenario: &Scenario) -> (Samples, Vec<bool>) {
    let (mut samples, mut statistics) =
        (Samples::default(), Statistics::new(&scenario.requirements));
    let mut all = RecorderGroup::new(vec![&mut samples, &mut statistics]);
    let outcome = run(scenario, &mut all, &mut |_| ControlFlow::Continue(()));
    let outcome = outcome.unwrap_or_else(|error| panic!("{}: {error}", scenario.name));
    assert!(outcome.end.is_complete(), "{}: {}", scenario.name, outcome.end);
    let met = statistics.verdicts().iter().map(|verdict| {
        println!("{}: {} {:?}", scenario.name, verdict.name, verdict.value);
        verdict.is_met()
    });
    (samples, met.collect())
}

/// The least and the largest from a time on, s.
fn range(samples: &Samples, name: &str, from: f64) -> [f64; 2] {
    let times = column(samples, "time");
    let of = column(samples, name);
    let of = of.iter().zip(times).filter(|(_, time)| *time >= from).map(|(of, _)| *of);
    of.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], of| [least.min(of), most.max(of)])
}

#[test]
fn a_pyramid_of_vscmgs_turns_by_what_its_sensors_read() {
    let (samples, met) = ran(&scenario("vscmg-pyramid-slew"));
    assert_eq!(met, [true]);
    for axis in ["x", "y", "z"] {
        let [least, most] = range(&samples, &format!("aocs.measurement_error_{axis}"), 20.0);
        assert!(least > -1e-4 && most < 1e-4, "{axis}: {least} {most}");
        assert!(most > 1e-7, "{axis}: an estimate has an error");
    }
    // Gimbals are back near the angles that are preferred, with the attitude held.
    for device in 1..=4 {
        let [least, most] = range(&samples, &format!("cmg{device}.gamma"), 0.0);
        assert!(most - least > 0.05, "gimbal {device} moves: {least} {most}");
    }
}

#[test]
fn wheels_leave_the_band_without_a_torque() {
    let scenario = scenario("wheel-keep-out");
    let (samples, met) = ran(&scenario);
    assert_eq!(met, [true]);
    let band = [1150.0_f64, 1350.0].map(|rpm| rpm * std::f64::consts::TAU / 60.0);
    for wheel in 1..=4 {
        let spin = column(&samples, &format!("rw{wheel}.spin"));
        assert!((band[0]..band[1]).contains(&spin[0].abs()), "{wheel} starts in it");
        let [least, most] = range(&samples, &format!("rw{wheel}.spin"), 50.0);
        let [low, high] = [least.abs().min(most.abs()), least.abs().max(most.abs())];
        assert!(high <= band[0] || low >= band[1], "{wheel} is outside: {low} {high}");
    }
    // Without it they stay.
    let mut without = scenario;
    without.controllers[0].allocation.null_motion = NullMotion::default();
    let (samples, _) = ran(&without);
    let spin = column(&samples, "rw1.spin");
    let last = spin[spin.len() - 1].abs();
    assert!((band[0]..band[1]).contains(&last), "{last}");
}

#[test]
fn three_wheels_go_on_when_one_is_braked() {
    let (samples, met) = ran(&scenario("locked-wheel-in-flight"));
    assert_eq!(met, [true]);
    assert_eq!(range(&samples, "rw2.spin", 30.1), [0.0, 0.0]);
    let [_, most] = range(&samples, "aocs.error_angle", 30.0);
    assert!(most > 0.05, "the brake turns the hub: {most} rad");
}

#[test]
fn a_notch_filter_keeps_the_first_mode_out_of_the_loop() {
    let scenario = scenario("flexible-slew");
    let (samples, met) = ran(&scenario);
    assert_eq!(met, [true]);
    let amplitude = |samples: &Samples, from: f64| {
        let [least, most] = range(samples, "modes.eta_dot_1", from);
        most - least
    };
    let with = amplitude(&samples, 75.0);
    let mut without = scenario;
    without.controllers[0].filters.clear();
    let (samples, met) = ran(&without);
    assert_eq!(met, [false], "the mode is driven");
    let driven = amplitude(&samples, 75.0);
    println!("rate of the first mode, peak to peak: {with:e}, without the filter {driven:e}");
    assert!(driven > 30.0 * with, "{driven} {with}");
}
