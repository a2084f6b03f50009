//! Sensors, filters and estimators in the loop: closed forms, the scenarios, noise.

use std::f64::consts::{PI, TAU};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use nalgebra::{Complex, ComplexField as _};
use precess::engine::run;
use precess::file::from_file;
use precess::margins::analysis::{ControlLoop, chosen};
use precess::margins::measurement::ReadingNoise;
use precess::margins::notes::notes;
use precess::record::Samples;
use precess::scenario::Scenario;

use super::{BUS, K, P, controller, loop_of, read};

/// T, s.
const PERIOD: f64 = 0.25;
/// Inertia about z, kg m².
const INERTIA: f64 = 10.04;
/// A few operations beside an exponential and the solution of sixty equations.
const RESPONSE: f64 = 1e-11;
/// Frequencies, rad/s.
const OMEGAS: [f64; 4] = [0.02, 0.3, 2.0, 11.0];

fn of(keys: &str) -> ControlLoop {
    loop_of(&read(&format!("{BUS}{}", controller(keys))))
}

/// Of the axis z: `L` of a double integrator behind a hold, whose attitude and rate are read through transfers.
fn closed_form(z: Complex<f64>, attitude: Complex<f64>, rate: Complex<f64>) -> Complex<f64> {
    let integrator = (z - 1.0).inv();
    let rotation =
        (integrator * 0.5 + integrator * integrator) * (PERIOD * PERIOD / INERTIA) * (K / 4.0);
    rotation * attitude + rate
}

/// The rate over the torque, and the change of attitude over a sample.
fn rates(z: Complex<f64>) -> [Complex<f64>; 2] {
    let integrator = (z - 1.0).inv();
    let rate = integrator * PERIOD / INERTIA;
    let attitude = (integrator * 0.5 + integrator * integrator) * (PERIOD * PERIOD / INERTIA);
    [rate, attitude * (-z.inv() + 1.0) / PERIOD]
}

/// `(s² + 2 a w s + w²) / (s² + 2 b w s + w²)`, or `w²` above, by the bilinear transform that keeps w.
fn section(z: Complex<f64>, frequency: f64, zeros: Option<f64>, poles: f64) -> Complex<f64> {
    let w = TAU * frequency;
    let s = (z - 1.0) / (z + 1.0) * (w / (w * PERIOD / 2.0).tan());
    let above = zeros.map_or(Complex::new(w * w, 0.0), |of| s * s + s * (2.0 * of * w) + w * w);
    above / (s * s + s * (2.0 * poles * w) + w * w)
}

fn agrees(keys: &str, expected: impl Fn(Complex<f64>) -> Complex<f64>) {
    let found = of(keys);
    for omega in OMEGAS {
        let z = Complex::new(0.0, omega * PERIOD).exp();
        let own = found.closed.response(omega).expect("no pole").axis(2).expect("z");
        let expected = expected(z);
        let apart = (own - expected).modulus() / expected.modulus();
        assert!(apart < RESPONSE, "{keys} at {omega}: {own} {expected} {apart:e}");
    }
}

#[test]
fn sensors_and_filters_are_those_of_the_closed_form() {
    let one = Complex::new(1.0, 0.0);
    agrees("", |z| closed_form(z, one, rates(z)[0] * P));
    agrees("sensors = { gyro = { output = \"integrating\" } }", |z| {
        closed_form(z, one, rates(z)[1] * P)
    });
    // 0.3 s are seen after two samples.
    agrees("sensors = { star_tracker = { latency = \"0.3 s\" } }", |z| {
        closed_form(z, z.inv().powi(2), rates(z)[0] * P)
    });
    // A measurement in 2.5 samples: ages of 1, 2 and, at every other measurement, 3 samples.
    let keys = "sensors = { star_tracker = { latency = \"0.25 s\", rate = \"1.6 Hz\" } }";
    agrees(keys, |z| {
        let late = z.inv();
        closed_form(z, (late + late.powi(2) + late.powi(3) * 0.5) / 2.5, rates(z)[0] * P)
    });
    let low =
        "[[controller.filter]]\nkind = \"low_pass\"\nfrequency = \"0.8 Hz\"\ndamping_ratio = 0.7\n";
    agrees(low, |z| closed_form(z, one, rates(z)[0] * section(z, 0.8, None, 0.7) * P));
    let notch = "[[controller.filter]]\nsignal = \"torque\"\nkind = \"notch\"\nfrequency = \"1.1 Hz\"\nzero_damping = 0.1\npole_damping = 0.6\n";
    agrees(notch, |z| closed_form(z, one, rates(z)[0] * P) * section(z, 1.1, Some(0.1), 0.6));
}

const STAR: &str =
    "star_tracker = { noise = \"5 arcsec\", rate = \"1.6 Hz\", latency = \"0.6 s\" }";

/// The error of the estimate does not depend on the motion that an integrating gyro has wholly: neither latency nor rate of the
/// star tracker are in the loop.
#[test]
fn an_estimator_with_an_integrating_gyro_has_no_delay() {
    let gyro = "gyro = { output = \"integrating\", angle_random_walk = \"0.1 deg/sqrt(h)\", rate_random_walk = \"1 deg/h/sqrt(h)\" }";
    let by = "estimator = { attitude_deviation = \"10 arcsec\", bias_deviation = \"0.1 deg/h\" }";
    let estimated = of(&format!("sensors = {{ seed = 1, {gyro}, {STAR} }}\n{by}"));
    let read = of(&format!("sensors = {{ seed = 1, {gyro} }}"));
    for omega in OMEGAS {
        let [a, b] = [&estimated, &read].map(|of| of.closed.response(omega).expect("no pole").open);
        let apart = (a - &b).norm() / b.norm();
        assert!(apart < 1e-9, "{omega}: {apart:e}");
    }
    // A sampled gyro does not have the motion between samples: the star tracker corrects the estimate.
    let sampled = of(&format!(
        "sensors = {{ seed = 1, {}, {STAR} }}\n{by}",
        gyro.replace("integrating", "sampled")
    ));
    let own = sampled.closed.response(0.3).expect("no pole").open;
    let other = of("").closed.response(0.3).expect("no pole").open;
    let apart = (own - &other).norm() / other.norm();
    assert!(apart > 1e-9 && apart < 0.02, "{apart:e}");
    assert!(sampled.closed.is_stable().expect("poles"));
}

/// White noise of a gyro and of a star tracker that is turned about x by 90 degrees, through a law with attitude and rate.
#[test]
fn noise_of_sensors_is_that_of_their_keys() {
    let star = "star_tracker = { mount = { axis = [1, 0, 0], angle = \"90 deg\" }, noise = \"2, 3, 12 arcsec\" }";
    let gyro = "gyro = { angle_random_walk = \"0.01 deg/sqrt(s)\" }";
    let text = format!("{BUS}{}", controller(&format!("sensors = {{ seed = 1, {gyro}, {star} }}")));
    let scenario = read(&text);
    let noise = ReadingNoise::of_sensors(chosen(&scenario, None).expect("one")).expect("noise");
    let arcsec = PI / 648_000.0;
    for (own, expected) in noise.attitude_deviations().iter().zip([2.0, 12.0, 3.0]) {
        assert!((own / arcsec / expected - 1.0).abs() < 1e-9, "{own}");
    }
    let rate = 0.01_f64.to_radians() / PERIOD.sqrt();
    assert!((noise.rate / rate - 1.0).abs() < 1e-12);
    let rms = loop_of(&scenario).noise().expect("stable").attitude_rms(&noise);
    // About y, 11.04 kg m², by the recursion.
    let (k, p) = (K / 4.0 / 11.04, P / 11.04);
    let mut sum = 0.0;
    for (attitude, of_rate) in [(12.0 * arcsec, 0.0), (0.0, rate)] {
        let (mut theta, mut omega) = (0.0_f64, 0.0_f64);
        for sample in 0..2000 {
            let first = if sample == 0 { 1.0 } else { 0.0 };
            let acceleration = -k * (theta + first * attitude) - p * (omega + first * of_rate);
            sum += theta * theta;
            theta += omega * PERIOD + 0.5 * acceleration * PERIOD * PERIOD;
            omega += acceleration * PERIOD;
        }
    }
    assert!((rms[1] / sum.sqrt() - 1.0).abs() < 1e-9, "{rms:?} {}", sum.sqrt());
}

fn path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenarios").join(name)
}

fn scenario(name: &str) -> Scenario {
    let read = from_file(&path(name), &[]);
    read.unwrap_or_else(|errors| panic!("{name}: {errors}")).0
}

/// Gain margin upwards and downwards, dB, and phase margin, degrees, the least of the axes; none of a loop that is not stable.
fn least(scenario: &Scenario) -> Option<[f64; 2]> {
    let found = loop_of(scenario).analysis().expect("an analysis");
    let mut least = [f64::INFINITY; 2];
    for axis in found.axes? {
        let up = axis.gain_up.map(|of| 20.0 * of.value.log10());
        let down = axis.gain_down.map(|of| -20.0 * of.value.log10());
        least[0] = up.into_iter().chain(down).fold(least[0], f64::min);
        least[1] = axis.phase.map_or(least[1], |of| least[1].min(of.value.to_degrees()));
    }
    Some(least)
}

/// Every scenario with a controller has margins of more than 6 dB and 30 degrees, but those named.
#[test]
fn the_committed_scenarios_have_margins() {
    let mut names: Vec<_> = std::fs::read_dir(path(""))
        .expect("the folder of scenarios")
        .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
        .filter(|name| name.split('.').next_back() == Some("toml"))
        .collect();
    names.sort();
    let mut count = 0;
    for name in names {
        let scenario = scenario(&name);
        if scenario.controllers.is_empty() {
            continue;
        }
        count += 1;
        let [gain, phase] = least(&scenario).unwrap_or_else(|| panic!("{name} is not stable"));
        println!("{name}: {gain:.2} dB, {phase:.2} degrees");
        assert!(gain > 6.0 && phase > 30.0, "{name}: {gain} dB, {phase} degrees");
    }
    assert!(count >= 7, "{count}");
}

fn without_notch() -> Scenario {
    let mut without = scenario("flexible-slew.toml");
    assert_eq!(without.controllers[0].filters.len(), 1);
    without.controllers[0].filters.clear();
    without
}

/// The mode that a notch takes out of the loop of the example is driven by it without the filter, as fast as in a run.
#[test]
fn without_its_notch_the_mode_grows_as_in_a_run() {
    let mut without = without_notch();
    assert_eq!(least(&without), None);
    let found = loop_of(&without);
    let poles = found.closed.poles().expect("poles");
    let rate = without.controllers[0].rate;
    let unstable = poles.iter().find(|z| z.modulus() > 1.0 && z.im > 0.1).expect("the mode");
    let frequency = unstable.arg() * rate / TAU;
    assert!((frequency - 4.16).abs() < 0.1, "{frequency}");
    let growth = unstable.modulus().ln() * rate;
    without.settings.duration = 46.0;
    without.requirements.clear();
    let mut samples = Samples::default();
    run(&without, &mut samples, &mut |_| ControlFlow::Continue(())).expect("a run");
    let column = samples.column("modes.eta_dot_1").expect("the mode");
    // The second difference over 0.1 s has 3.7 of the mode, little of the slew, and no more of the wheels.
    let level = |from: f64| {
        let rows = samples.rows.iter().enumerate();
        let within = rows.filter(|(_, row)| (from..from + 5.0).contains(&row[0]));
        let squares =
            within.map(|(at, _)| (column[at + 5] - 2.0 * column[at] + column[at - 5]).powi(2));
        squares.sum::<f64>().sqrt()
    };
    // Torques of the wheels are at their limits from about 45 s on.
    let in_run = (level(40.0) / level(15.0)).ln() / 25.0;
    println!("growth {growth} 1/s, in the run {in_run} 1/s");
    assert!((in_run / growth - 1.0).abs() < 0.01, "{in_run} {growth}");
}

/// Motion without torque is left out, and said to be.
#[test]
fn motion_without_torque_is_not_in_the_loop() {
    let with = scenario("vscmg-pyramid-slew.toml");
    let mut without = with.clone();
    without.controllers[0].allocation.null_motion = precess::scenario::NullMotion::default();
    let [a, b] = [&with, &without].map(|of| loop_of(of).closed.poles().expect("poles"));
    assert_eq!(a, b);
    let said = |of: &Scenario| notes(of, &of.controllers[0]).join("\n");
    assert!(said(&with).contains("preferred angles"), "{}", said(&with));
    assert!(!said(&without).contains("preferred angles"));
}
