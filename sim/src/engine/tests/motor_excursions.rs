//! Motors at their limits under profiles and loads that swing: what passes a limit within a step, impulses, friction.

use std::path::Path;

use super::{Samples, column, recorded};
use crate::record::Outcome;

/// A wheel on a hub, what its table has besides, and the rest of the file.
fn run(hub: &str, wheel: &str, rest: &str) -> (Outcome, Samples) {
    let text = format!(
        "format = 1\n[hub]\nmass = \"100 kg\"\ninertia = \"{hub} kg m^2\"\n[[device]]\nname = \"a\"\n\
         kind = \"reaction_wheel\"\n[device.wheel]\nmass = \"1 kg\"\ninertia = \"0.02, 0.01, 0.01 kg m^2\"\n\
         {wheel}\n{rest}"
    );
    let scenario = crate::file::from_toml("motors", &text, Path::new(""));
    let (scenario, _) = scenario.unwrap_or_else(|errors| panic!("{errors}"));
    recorded(&scenario)
}

fn of<'a>(outcome: &'a Outcome, text: &str) -> Vec<&'a crate::record::Event> {
    outcome.events.iter().filter(|event| event.text.contains(text)).collect()
}

#[test]
fn a_joint_leaves_its_largest_rate_in_each_period_of_a_swinging_profile() {
    let (outcome, _) = run(
        "1000, 1000, 1000",
        "rate_limit = \"100 rad/s\"\nrate = \"99 rad/s\"\ndamping = \"5 mN m s/rad\"\n\
         torque = { sine = \"0.25 N m\", mean = \"0.7 N m\", frequency = \"1 Hz\" }",
        "[run]\nduration = \"30 s\"\n[output]\nrate = \"2 Hz\"",
    );
    let leaves = of(&outcome, "leaves its largest rate");
    assert_eq!(leaves.len(), 30);
    // Friction takes 0.5 N m at that rate: the sine is at -0.8.
    let first = (std::f64::consts::PI + 0.8_f64.asin()) / std::f64::consts::TAU;
    for (period, event) in (0_u32..).zip(leaves) {
        let expected = f64::from(period) + first;
        assert!((event.time - expected).abs() < 1e-8, "{}, not {expected}", event.time);
    }
}

#[test]
fn excursions_beyond_the_largest_rate_shorter_than_a_step_end() {
    let (outcome, samples) = run(
        "1, 1.1, 1.2",
        "rate = \"100 rad/s\"\nrate_limit = \"100 rad/s\"\ntorque_limit = \"1 mN m\"",
        "[[wrench]]\non = \"hub\"\nmoment.x = { sine = \"1 N m\", frequency = \"1 Hz\" }\n\
         moment.y = { sine = \"0.3 N m\", frequency = \"0.3 Hz\" }\n\
         [run]\nduration = \"20 s\"\n[output]\nrate = \"20 Hz\"",
    );
    assert!(outcome.end.is_complete(), "{}", outcome.end);
    assert!((20..100).contains(&outcome.events.len()), "{} events", outcome.events.len());
    // Without a motor torque the relative rate swings by the impulse of the moment over the hub's inertia.
    let largest = column(&samples, "a.spin").into_iter().fold(0.0, f64::max);
    assert!(largest < 100.0 + 1.0 / std::f64::consts::PI, "{largest}");
}

#[test]
fn the_largest_rate_is_not_passed_between_the_times_at_which_a_step_is_searched() {
    // The rate is (1 - cos pi t) / (pi J): 31.8316 rad/s at most.
    let (outcome, samples) = run(
        "1000, 1000, 1000",
        "rate_limit = \"31.82 rad/s\"\ntorque = { sine = \"1 N m\", frequency = \"0.5 Hz\" }",
        "[run]\nduration = \"20 s\"\n[output]\nrate = \"200 Hz\"",
    );
    // Held at first, the rate is 0.01 rad/s smaller at every later peak.
    assert_eq!(of(&outcome, "is at its largest rate").len(), 1);
    let largest = column(&samples, "a.spin").into_iter().fold(0.0, f64::max);
    assert!((largest - 31.82).abs() < 1e-9, "{largest}");
}

#[test]
fn an_impulse_that_slows_a_joint_beyond_its_largest_rate_frees_the_motor() {
    let (outcome, samples) = run(
        "0.02, 0.02, 0.02",
        "rate = \"100 rad/s\"",
        "[[device]]\nname = \"b\"\ncopy_of = \"a\"\nwheel.rate = \"150 rad/s\"\n\
         [[at]]\ntime = \"1 s\"\njoint = \"a.wheel\"\ntorque = \"0.01 N m\"\ntorque_limit = \"0.05 N m\"\n\
         rate_limit = \"60 rad/s\"\n[[at]]\ntime = \"2 s\"\njoint = \"b.wheel\"\nbrake = true\n\
         [run]\nduration = \"4 s\"\n[output]\nrate = \"2 Hz\"",
    );
    assert_eq!(of(&outcome, "is below its largest rate, 60 rad/s, again").len(), 1);
    // Freed, by 0.01 N m on the wheel against hub and the braked one: 1 / 0.02 + 1 / 0.04 in 1 / (kg m²).
    let spin = column(&samples, "a.spin");
    let (from, to) = (spin[spin.len() - 3], spin[spin.len() - 1]);
    assert!((to - from - 0.75).abs() < 1e-9, "{from}, {to}");
}

#[test]
fn the_torque_of_a_motor_at_its_largest_power_is_that_with_dry_friction_too() {
    let (outcome, samples) = run(
        "1000, 1000, 1000",
        "torque_limit = \"1 N m\"\npower_limit = \"20 W\"\ntorque = \"1 N m\"\ncoulomb = \"0.1 N m\"\n\
         static_friction = \"0.15 N m\"",
        "[run]\nduration = \"20 s\"\n[output]\nrate = \"2 Hz\"",
    );
    assert_eq!(of(&outcome, "delivers its largest power").len(), 1);
    let both = column(&samples, "a.spin").into_iter().zip(column(&samples, "a.u_w")).skip(2);
    for (rate, torque) in both {
        assert!((rate * torque / 20.0 - 1.0).abs() < 1e-9, "{torque} N m at {rate} rad/s");
    }
    assert!(column(&samples, "a.friction_theta").iter().skip(1).all(|of| (of + 0.1).abs() < 1e-15));
}
