//! When controllers sample and what they command acts: exact solutions, the same at the start as later.

use std::sync::{Arc, Mutex};

use nalgebra::Vector3;
use precess::control::{Command, Controller, ControllerError, ControllerSample};
use precess::engine::{Advance, Run, RunQuantities};
use precess::record::{End, Samples};

use super::{BUS, I_Z, K, P, column, controller, ran, read};

/// Some roundings of each of a thousand steps, and the tolerance of the integrators below.
const EXACT: f64 = 1e-10;

/// Duration, integrator, and samples of the result at those of the controller.
fn run_of(integrator: &str) -> String {
    format!("[run]\nduration = \"20 s\"\n{integrator}\n[output]\nrate = \"4 Hz\"\n")
}

const DOP853: &str = "integrator = \"dop853\"\ntolerance = 1e-13";
const RK4: &str = "integrator = \"rk4\"\nstep = \"12.5 ms\"";

/// The hub is turned about z at the start.
const TURNED: &str = "[initial]\nangular_velocity = \"0, 0, 0.05 rad/s\"\n[initial.attitude]\naxis = [0, 0, 1]\nangle = \"40 deg\"\n";

/// Angle and rate about z at samples: between times at which something acts the acceleration is constant, so the loop is
/// a recursion. Samples at `offset + k / 4`, each acts `delay` later.
fn exact(offset: f64, delay: f64, duration: f64) -> Vec<[f64; 2]> {
    let (mut time, mut theta, mut omega) = (0.0, 40.0_f64.to_radians(), 0.05);
    let mut torque = 0.0;
    let mut pending: Vec<(f64, f64)> = Vec::new();
    let mut samples = vec![];
    let (mut next_sample, mut next_output) = (0_u32, 0_u32);
    while f64::from(next_output) * 0.25 <= duration {
        let sample = offset + f64::from(next_sample) * 0.25;
        let output = f64::from(next_output) * 0.25;
        let acts = pending.first().map_or(f64::INFINITY, |(at, _)| *at);
        let to = sample.min(output).min(acts);
        let (step, acceleration) = (to - time, torque / I_Z);
        theta += omega * step + 0.5 * acceleration * step * step;
        omega += acceleration * step;
        time = to;
        if output <= time {
            samples.push([theta, omega]);
            next_output += 1;
        }
        if sample <= time {
            pending.push((sample + delay, -K * (theta / 4.0).tan() - P * omega));
            next_sample += 1;
        }
        while pending.first().is_some_and(|(at, _)| *at <= time) {
            torque = pending.remove(0).1;
        }
    }
    samples
}

#[test]
fn a_loop_with_delay_is_its_exact_solution() {
    for (offset, delay) in [(0.0, 0.0), (0.0, 0.1), (0.0, 0.25), (0.125, 0.375), (0.0, 0.0625)] {
        for integrator in [DOP853, RK4] {
            let keys = format!("offset = \"{offset} s\"\ndelay = \"{delay} s\"");
            let text = format!("{BUS}{TURNED}{}{}", controller(&keys, ""), run_of(integrator));
            let (outcome, samples) = ran(&read(&text));
            let exact = exact(offset, delay, 20.0);
            let [q0, q3, omega] = ["q0", "q3", "omega_z"].map(|name| column(&samples, name));
            assert_eq!(exact.len(), omega.len());
            let mut worst = 0.0_f64;
            for (k, [theta, rate]) in exact.iter().enumerate() {
                let found = 2.0 * q3[k].atan2(q0[k]);
                worst = worst.max((found - theta).abs()).max((omega[k] - rate).abs());
            }
            println!("offset {offset} delay {delay} {integrator}: {worst:e}");
            assert!(worst < EXACT, "offset {offset}, delay {delay}, {integrator}: {worst:e}");
            let energy = outcome.drift.energy.expect("a ledger");
            assert!(energy < 1e-12 && outcome.drift.angular < Some(1e-12), "{:?}", outcome.drift);
        }
    }
}

/// What the law gives for the state of each sample.
fn law_at(samples: &Samples) -> Vec<f64> {
    let [q0, q3, omega] = ["q0", "q3", "omega_z"].map(|name| column(samples, name));
    let each = q0.iter().zip(&q3).zip(&omega);
    each.map(|((q0, q3), omega)| -K * (0.5 * q3.atan2(*q0)).tan() - P * omega).collect()
}

/// A wheel is braked at the time of a sample: the hub's rate jumps, the law reads the one after it, and what it commands
/// acts at once, at the start as at any other sample.
#[test]
fn at_one_time_changes_come_first_then_samples_then_what_acts() {
    let spinning = BUS.replace(
        "mount = { spin_axis = [0, 0, 1] }\nwheel = { ",
        "mount = { spin_axis = [0, 0, 1] }\nwheel = { rate = \"300 rad/s\", ",
    );
    let brake = "[[at]]\ntime = \"3 s\"\njoint = \"rwz.wheel\"\nbrake = true\n\
                 [[at]]\ntime = \"5 s\"\njoint = \"rwz.wheel\"\ncontrolled = true\n";
    let text = format!("{spinning}{TURNED}{}{brake}{}", controller("", ""), run_of(RK4));
    let text = text.replace("[controller.law]", "[controller.allocation]\ninverse = \"singularity_robust\"\nlambda = 1e-6\n[controller.law]");
    let (_, samples) = ran(&read(&text));
    let [torque, omega, motor, spin] =
        ["aocs.torque_z", "omega_z", "rwz.u_w", "rwz.spin"].map(|name| column(&samples, name));
    for (k, (wanted, found)) in law_at(&samples).iter().zip(&torque).enumerate() {
        // The last sample of the result is at the end of the run, where no controller samples.
        if k + 1 < torque.len() {
            assert!((wanted - found).abs() < 1e-12, "{k}: {wanted} {found}");
        }
    }
    assert!((omega[12] - omega[11]).abs() > 0.1, "{} {}", omega[11], omega[12]);
    assert!(motor[0] != 0.0, "it acts from the start");
    assert!(spin[12..20].iter().all(|spin| *spin == 0.0), "locked: {:?}", &spin[10..22]);
    assert!(spin[21] != 0.0, "commanded again");
}

/// Samples whose times differ by roundings from those of changes are at one time.
#[test]
fn times_that_differ_by_rounding_are_one() {
    let keys = "offset = \"0.1 s\"\ndelay = \"0.25 s\"";
    let text = format!("{BUS}{TURNED}{}{}", controller(keys, ""), run_of(RK4));
    let (outcome, _) = ran(&read(&text));
    // 20 s of 12.5 ms each: none is cut to a rounding.
    assert!(outcome.steps.accepted <= 1601, "{}", outcome.steps.accepted);
}

/// What a sample commands acts a delay after it by its clock: at 100 Hz no rounding is carried from one sample to the next, and no step
/// is cut to one.
#[test]
fn delays_do_not_accumulate_roundings() {
    let keys = "delay = \"20 ms\"";
    let text = format!("{BUS}{TURNED}{}{}", controller(keys, ""), run_of(RK4));
    let text = text.replace("\"4 Hz\"", "\"100 Hz\"").replace("\"12.5 ms\"", "\"10 ms\"");
    let (outcome, samples) = ran(&read(&text.replace("\"20 s\"", "\"50 s\"")));
    assert_eq!(outcome.steps.accepted, 5000);
    // Each sample of the result is one of the controller, too: from it on acts what was computed two before.
    let [torque, acting] = ["aocs.torque_z", "rwz.u_w"].map(|name| column(&samples, name));
    let pairs = || torque.iter().copied().zip(acting[2..].iter().copied()).take(4996);
    let (of, by) = pairs().find(|(of, _)| of.abs() > 1e-6).expect("a torque");
    let late =
        pairs().filter(|(own, found)| (own * by - found * of).abs() > 1e-9 * (own * by).abs());
    assert_eq!(late.count(), 0, "{:?} {:?}", &torque[..5], &acting[..5]);
}

/// With an offset of 0.1 s at 10 Hz the sample of 0.8 s is at 0.7999999999999999 s: a change at 0.8 s comes before it, and
/// at the end of a run at 0.8 s there is none.
#[test]
fn a_sample_that_differs_by_rounding_from_a_change_comes_after_it() {
    let spinning = BUS.replace(
        "mount = { spin_axis = [0, 0, 1] }\nwheel = { ",
        "mount = { spin_axis = [0, 0, 1] }\nwheel = { rate = \"300 rad/s\", ",
    );
    let brake = "[[at]]\ntime = \"0.8 s\"\njoint = \"rwz.wheel\"\nbrake = true\n";
    let keys =
        "offset = \"0.1 s\"\nallocation = { inverse = \"singularity_robust\", lambda = 1e-6 }";
    for integrator in [DOP853, RK4] {
        let text =
            format!("{spinning}{TURNED}{}{brake}{}", controller(keys, ""), run_of(integrator));
        let text = text.replace("\"4 Hz\"", "\"10 Hz\"").replace("\"20 s\"", "\"1 s\"");
        let (outcome, samples) = ran(&read(&text));
        let [torque, omega] = ["aocs.torque_z", "omega_z"].map(|name| column(&samples, name));
        assert!((omega[8] - omega[7]).abs() > 0.1, "{omega:?}");
        for (k, wanted) in law_at(&samples).iter().enumerate().take(10).skip(1) {
            assert!((wanted - torque[k]).abs() < 1e-12, "{k}: {wanted} {}", torque[k]);
        }
        let braked: Vec<_> = outcome.events.iter().map(|event| event.time).collect();
        assert_eq!(braked, [0.8]);
    }
}

/// A controller that keeps the times at which it samples.
struct Times(Arc<Mutex<Vec<f64>>>);

impl Controller for Times {
    fn sample(&mut self, sample: &ControllerSample<'_>) -> Result<Command, ControllerError> {
        self.0.lock().expect("no panic").push(sample.time);
        Ok(Command::Torque(Vector3::zeros()))
    }
}

#[test]
fn no_controller_samples_at_the_end() {
    let keys = "offset = \"0.1 s\"";
    let text = format!("{BUS}{}{}", controller(keys, ""), run_of(RK4));
    let text = text.replace("\"4 Hz\"", "\"10 Hz\"").replace("\"20 s\"", "\"0.8 s\"");
    let scenario = read(&text);
    let times = Arc::new(Mutex::new(Vec::new()));
    let own: Vec<(String, Box<dyn Controller>)> =
        vec![("aocs".to_owned(), Box::new(Times(Arc::clone(&times))))];
    let mut run = Run::with_controllers(&scenario, RunQuantities::All, own).expect("a run");
    while let Advance::Stepped = run.advance().expect("a step") {}
    assert_eq!(run.time().to_bits(), 0.8_f64.to_bits());
    assert!(matches!(run.end(), Some(End::Finished)));
    assert_eq!(times.lock().expect("no panic").len(), 7, "0.1 s to 0.7 s");
}
