//! The state of a run that a unit copies: from it a run goes on with the bits of the undisturbed one, this run and another.

use std::fmt::Write as _;

use precess::engine::{CheckpointError, CoupledRun};
use precess::scenario::Scenario;

use super::engine::{changed, flexible_slew, imaging, isolator, of_file, read_again, starts};
use super::{UNIT, scenario};

/// Three wheels under a law with an integral, sensors, filters and dumping, one of them driven otherwise and given back; a wheel that
/// sticks and breaks away, has a largest power, rate and drag; a panel that runs into a stop and is locked there.
fn everything() -> Scenario {
    let mut text = "format = 1\n[hub]\nmass = \"100 kg\"\ninertia = \"12, 11, 10 kg m^2\"\n\
        [initial]\nangular_velocity = \"0.02, -0.01, 0.05 rad/s\"\n"
        .to_owned();
    for (name, axis) in [("rwx", "1, 0, 0"), ("rwy", "0, 1, 0"), ("rwz", "0, 0, 1")] {
        write!(
            text,
            "[[device]]\nname = \"{name}\"\nkind = \"reaction_wheel\"\nmount = {{ spin_axis = [{axis}] }}\n\
             imbalance = {{ static = \"1 g cm\" }}\n\
             wheel = {{ mass = \"2 kg\", inertia = \"0.02, 0.01, 0.01 kg m^2\", rate = \"100 rad/s\", \
             torque_limit = \"0.2 N m\", power_limit = \"10 W\" }}\n"
        )
        .expect("a text");
    }
    text += r#"
[[device]]
name = "dry"
kind = "reaction_wheel"
mount = { spin_axis = [0, 0.6, 0.8] }
[device.wheel]
mass = "1 kg"
inertia = "2e-3, 1e-3, 1e-3 kg m^2"
torque = { sine = "40 mN m", frequency = "1.1 Hz" }
torque_limit = "30 mN m"
rate_limit = "0.5 rad/s"
static_friction = "10 mN m"
coulomb = "5 mN m"
stribeck_rate = "1 rad/s"
quadratic_drag = "1e-4 N m s^2/rad^2"
[[device]]
name = "panel"
kind = "hinged_panel"
position = "45, 0, 0 cm"
mount = { hinge_axis = [0, 0, 1] }
[device.panel]
mass = "3 kg"
centre_of_mass = "60, 0, 0 cm"
inertia = "0.2, 0.4, 0.4 kg m^2"
rate = "0.2 rad/s"
upper_stop = "9 deg"
lower_stop = "-9 deg"
at_stop = "lock"
[[controller]]
name = "aocs"
devices = ["rwx", "rwy", "rwz"]
rate = "10 Hz"
delay = "130 ms"
servo = { rate = "25 Hz" }
[controller.law]
kind = "mrp_feedback"
attitude_gain = "8 N m"
rate_gain = "6 N m s"
integral_gain = "0.01 1/(kg m^2)"
integral_limit = "10 N m s"
[controller.reference.attitude]
quaternion = [1, 0, 0, 0]
scalar = "first"
[controller.allocation]
inverse = "singularity_robust"
[controller.sensors]
seed = 3
encoder_quantum = "20 arcsec"
tachometer_quantum = "0.01 rpm"
gyro = { output = "integrating", angle_random_walk = "2e-5 rad/sqrt(s)", rate_random_walk = "0.1 deg/h/sqrt(h)", quantum = "1e-6 rad" }
star_tracker = { noise = "2, 2, 12 arcsec", rate = "5 Hz", latency = "0.15 s" }
accelerometer = { noise_density = "2 mm/s^2/sqrt(Hz)" }
[controller.estimator]
attitude_deviation = "10 arcsec"
bias_deviation = "1 deg/h"
[controller.dumping]
gain = "0.08 1/s"
torque_limit = "0.1 N m"
[[controller.filter]]
signal = "torque"
kind = "low_pass"
frequency = "2 Hz"
damping_ratio = 0.7
[[controller.filter]]
signal = "rate"
kind = "low_pass"
frequency = "3 Hz"
damping_ratio = 0.7
[[at]]
time = "0.6 s"
joint = "rwy.wheel"
torque = "50 mN m"
[[at]]
time = "1.2 s"
joint = "rwy.wheel"
controlled = true
[run]
duration = "2 s"
integrator = "rk4"
step = "4 ms"
[output]
rate = "97 Hz"
"#;
    scenario(&text)
}

/// Four gyros with wheels of variable speed, an estimator and measurements that arrive late.
fn estimated() -> Scenario {
    let run = "duration = \"1.2 s\"\nintegrator = \"rk4\"\nstep = \"4 ms\"";
    let changes = [
        ("duration = \"60 s\"", run),
        ("\"50 s\"", "\"0.2 s\""),
        ("start = \"2 s\"", "start = \"0.1 s\""),
    ];
    of_file("vscmg-pyramid-slew.toml", &changes)
}

/// Inputs at a sample: those of the scenario at first, then others every 30 samples.
fn inputs_at(starts: &[f64], sample: usize) -> Vec<f64> {
    let varied = |(place, start): (usize, &f64)| {
        let sign = [0.0, 1.0, -1.0, 0.0][(sample / 30 + place) % 4];
        if sample < 30 { *start } else { start + 0.01 * sign }
    };
    starts.iter().enumerate().map(varied).collect()
}

/// Outputs from a sample to an end, as bits, by a function for what is done before each.
fn outputs(
    run: &mut CoupledRun<'_>,
    scenario: &Scenario,
    starts: &[f64],
    samples: std::ops::Range<usize>,
    mut before: impl FnMut(usize, &mut CoupledRun<'_>),
) -> Vec<Vec<u64>> {
    let mut rows = Vec::new();
    for sample in samples {
        before(sample, run);
        let time = f64::from(u32::try_from(sample).expect("few")) / scenario.output.rate;
        let inputs = inputs_at(starts, sample);
        let reached = run.advance(&inputs, time).unwrap_or_else(|error| panic!("{error}"));
        assert!(reached, "{time}");
        let row = run.outputs(&inputs).expect("outputs");
        rows.push(row.iter().map(|number| number.to_bits()).collect());
    }
    rows
}

#[test]
fn a_run_goes_on_from_its_state_with_the_bits_of_an_undisturbed_one() {
    let all = [everything(), estimated(), isolator(), imaging(), flexible_slew(), changed()];
    for scenario in all {
        let scenario = read_again(&scenario);
        let new = || CoupledRun::new(&scenario).unwrap_or_else(|error| panic!("{error}"));
        let mut run = new();
        let starts = starts(&scenario, &run);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "few samples")]
        let count = (scenario.settings.duration * scenario.output.rate).floor() as usize;
        let count = count.min(250);
        let undisturbed = outputs(&mut run, &scenario, &starts, 0..count, |_, _| {});
        // Saving changes nothing.
        let mut saved = Vec::new();
        run = new();
        let again = outputs(&mut run, &scenario, &starts, 0..count, |sample, run| {
            if sample % (count / 5) == 3 {
                saved.push((sample, run.checkpoint().expect("a state")));
            }
        });
        assert!(again == undisturbed && saved.len() >= 5, "{}", scenario.name);
        for (from, bytes) in saved.iter().rev() {
            // The run at its end, or in the middle of another's; and one that has just begun.
            for run in [&mut run, &mut new()] {
                run.restore(bytes).expect("a state");
                assert!(run.checkpoint().as_ref() == Ok(bytes), "{}", scenario.name);
                let end = (from + count / 5 + 9).min(count);
                let later = outputs(run, &scenario, &starts, *from..end, |_, _| {});
                for (row, expected) in later.iter().zip(&undisturbed[*from..]) {
                    assert!(row == expected, "{}: from sample {from}", scenario.name);
                }
            }
        }
    }
}

#[test]
fn bytes_that_are_no_state_of_the_scenario_change_nothing() {
    let (one, other) = (scenario(UNIT), scenario(&UNIT.replace("\"90 kg\"", "\"91 kg\"")));
    let (one, other) = (read_again(&one), read_again(&other));
    let mut run = CoupledRun::new(&one).expect("a run");
    let mut of_other = CoupledRun::new(&other).expect("a run");
    let inputs = starts(&one, &run);
    assert!(run.advance(&inputs, 0.02).expect("a step"));
    assert!(of_other.advance(&inputs, 0.02).expect("a step"));
    let bytes = run.checkpoint().expect("a state");
    let mut damaged = bytes.clone();
    damaged[9] ^= 4;
    let shorter = &bytes[..bytes.len() - 8];
    let others = of_other.checkpoint().expect("a state");
    for wrong in [&[][..], &[0; 8], shorter, &damaged, &others] {
        assert_eq!(run.restore(wrong), Err(CheckpointError::Bytes));
        assert_eq!(run.checkpoint().as_ref(), Ok(&bytes));
    }
}

#[test]
fn a_run_with_a_tolerance_has_no_state_that_is_copied() {
    let scenario = scenario(&UNIT.replace("integrator = \"rk4\"\nstep = \"1 ms\"\n", ""));
    let mut run = CoupledRun::new(&scenario).expect("a run");
    assert_eq!(run.checkpoint(), Err(CheckpointError::Kept));
    let why = CheckpointError::Kept.to_string();
    assert!(why.contains("state `integrator = \"rk4\"`"), "{why}");
}

/// Force and torque on the hub that are given and taken away again: accelerations are those without.
#[test]
fn a_force_that_no_longer_acts_leaves_the_accelerations() {
    let (spacecraft, rest) = UNIT.split_once("[[wrench]]").expect("wrenches");
    let (_, settings) = rest.split_once("[run]").expect("settings");
    let text = format!("{spacecraft}[run]{settings}columns = [\"acceleration\"]\n");
    let scenario = read_again(&scenario(&text));
    let mut run = CoupledRun::new(&scenario).expect("a run");
    let still = vec![0.0; run.input_count()];
    let mut pushed = still.clone();
    pushed[..6].copy_from_slice(&[30.0, -20.0, 10.0, 1.0, 2.0, -3.0]);
    let first = run.outputs(&still).expect("outputs").to_vec();
    let with = run.outputs(&pushed).expect("outputs").to_vec();
    let after = run.outputs(&still).expect("outputs").to_vec();
    assert!(first.len() > 3 && with != first);
    assert_eq!(after, first);
}
