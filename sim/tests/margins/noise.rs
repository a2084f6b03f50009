//! Noise of sources and sensors through the loop, against runs and against the sum of squares of the impulse response.

use std::ops::ControlFlow;

use precess::engine::run;
use precess::jitter::model::Output;
use precess::jitter::weight::Weight;
use precess::margins::analysis::{ControlLoop, chosen};
use precess::margins::closed_noise::{ClosedNoise, ReadingSpectrum};
use precess::margins::measurement::ReadingNoise;
use precess::pointing::Metric;
use precess::record::Samples;
use precess::scenario::Scenario;

use super::{BUS, read};

/// What a run and the linear loop may differ by off resonance, and at it.
const AGREEMENT: [f64; 2] = [0.01, 0.05];

/// The period of the sources, s, and where a run has settled, s: the loop's slowest pole is at 0.25 1/s.
const PERIOD: f64 = 200.0;
const SETTLED: f64 = 100.0;

/// Errors of 0.1 Hz at 4 Hz; more keys of the scenario, and of its controller.
fn bus(keys: &str, control: &str, (duration, step, rate): (f64, f64, f64)) -> Scenario {
    let kind = "kind = \"balanced_reaction_wheel\"\n";
    let on_node = format!("{kind}node = \"centre\"\n");
    let wheels =
        if keys.contains("[structure]") { BUS.replace(kind, &on_node) } else { BUS.to_owned() };
    read(&format!(
        "{wheels}{keys}\n[[controller]]\nname = \"aocs\"\nrate = \"4 Hz\"\ndelay = \"50 ms\"\n{control}\n\
         [controller.law]\nkind = \"eigen_axis\"\nfrequency = \"0.1 Hz\"\ndamping_ratio = 0.4\n\
         [controller.reference.attitude]\nquaternion = [1, 0, 0, 0]\nscalar = \"first\"\n\
         [run]\nduration = \"{duration} s\"\nintegrator = \"rk4\"\nstep = \"{step} s\"\n\
         [output]\nrate = \"{rate} Hz\"\ncolumns = [\"q1\", \"q2\"]\n"
    ))
}

/// Rotations of the hub about x and y.
fn outputs(node: &str) -> [Output; 2] {
    [3, 4].map(|axis| {
        let mut row = [0.0; 6];
        row[axis] = 1.0;
        Output { name: format!("rotation {axis}"), terms: vec![(node.to_owned(), row)] }
    })
}

fn noise(scenario: &Scenario, node: &str) -> ClosedNoise {
    let of = chosen(scenario, None).expect("a controller");
    let found = ControlLoop::new(scenario, of, &outputs(node)).expect("a loop");
    let reading = ReadingSpectrum::of_sensors(of).expect("sensors");
    found.closed_noise(reading).expect("a stable loop")
}

/// RMS of both rotations together by all, and by each part, rad.
fn rms(found: &ClosedNoise) -> [f64; 4] {
    let weight = Weight::of_metric(&Metric::Rms).expect("a weight");
    let [own, aliased, sensors] = &found.parts;
    [&found.whole, own, aliased, sensors].map(|of| of.mean_square(&[0, 1], &weight).sqrt())
}

/// The same in a run from a time on, without the end.
fn in_run(scenario: &Scenario, from: f64) -> f64 {
    let mut samples = Samples::default();
    let outcome = run(scenario, &mut samples, &mut |_| ControlFlow::Continue(())).expect("a run");
    assert!(outcome.end.is_complete(), "{}", outcome.end);
    let [x, y] = ["q1", "q2"].map(|name| samples.column(name).expect(name));
    let end = samples.rows.len() - 1;
    let rows = (0..end).filter(|row| samples.rows[*row][0] > from - 1e-9);
    let squares: Vec<f64> = rows.map(|row| 4.0 * (x[row].powi(2) + y[row].powi(2))).collect();
    let count = f64::from(u32::try_from(squares.len()).expect("few"));
    (squares.iter().sum::<f64>() / count).sqrt()
}

/// Noise of moments about y and z, in a band of which each line of a period has an alias of its own: the mean square over one period
/// does not depend on the phases, so that the run has no scatter.
fn source(band: [f64; 2], more: &str) -> String {
    format!(
        "{more}\n[[source]]\nname = \"noise\"\non = \"rwx\"\nspin_axis = \"z\"\nseed = 7\n\
         [source.broadband]\nband = \"{}, {} Hz\"\nperiod = \"{PERIOD} s\"\n\
         radial_moment = \"1e-4 N^2 m^2/Hz\"\n",
        band[0], band[1]
    )
}

/// Lines of 5 mHz in the middle of equal intervals of the band.
fn agrees(band: [f64; 2], (more, node): (&str, &str), bound: f64) {
    let scenario = bus(&source(band, more), "", (SETTLED + PERIOD, 0.0025, 40.0));
    let [whole, own, aliased, sensors] = rms(&noise(&scenario, node));
    let run = in_run(&scenario, SETTLED);
    println!(
        "{band:?} Hz: {whole:e} rad, own {own:e}, aliased {aliased:e}; in the run {run:e}, {:e}",
        whole / run - 1.0
    );
    assert_eq!(sensors, 0.0);
    assert!((whole.powi(2) - own.powi(2) - aliased.powi(2)).abs() < 1e-12 * whole.powi(2));
    assert!((whole / run - 1.0).abs() < bound, "{whole:e} {run:e}");
}

/// 8.3 to 9.7 Hz are seen at 0.3 to 1.7 Hz, above the bandwidth.
#[test]
fn aliased_noise_off_resonance_is_in_the_run() {
    agrees([8.3025, 9.6975], ("", "hub"), AGREEMENT[0]);
}

/// 8.02 to 8.3 Hz are seen at 0.02 to 0.3 Hz, where the loop resonates.
#[test]
fn aliased_noise_at_the_resonance_of_the_loop_is_in_the_run() {
    agrees([8.0225, 8.2975], ("", "hub"), AGREEMENT[1]);
}

/// Noise that is not aliased, through the loop's resonance.
#[test]
fn noise_within_the_bandwidth_is_in_the_run() {
    agrees([0.0225, 0.9975], ("", "hub"), AGREEMENT[1]);
}

/// A mode of a fifth of the inertia about y, with which the noise resonates.
const MODE: &str = "[structure]\ncontains_devices = false\n\
    [[structure.node]]\nname = \"centre\"\nposition = \"0, 0, 0 m\"\n[[structure.point]]\nname = \"centre\"\n\
    [[structure.mode]]\nfrequency = \"7.8 Hz\"\ndamping = 0.01\nangular_momentum = [0, 1.5, 0]\n";

#[test]
fn aliased_noise_at_the_resonance_of_a_mode_is_in_the_run() {
    agrees([8.3025, 9.6975], (MODE, "centre"), AGREEMENT[1]);
}

/// White noise of gyro and star tracker. 80,000 samples are 20,000 s: with the 0.3 Hz that the loop has as bandwidth of noise 12,000
/// independent squares, twice, so that the RMS of the run has a deviation of 0.3 percent.
#[test]
fn noise_of_sensors_is_in_the_run_and_in_the_impulse_response() {
    let sensors = "sensors = { seed = 3, gyro = { angle_random_walk = \"0.01 deg/sqrt(s)\" }, star_tracker = { noise = \"20 arcsec\" } }";
    let scenario = bus("", sensors, (20_000.0, 0.25, 4.0));
    let [whole, own, aliased, of_sensors] = rms(&noise(&scenario, "hub"));
    assert!(own == 0.0 && aliased == 0.0 && whole == of_sensors, "{own} {aliased}");
    let of = chosen(&scenario, None).expect("a controller");
    let gains = ControlLoop::new(&scenario, of, &[]).expect("a loop").noise().expect("stable");
    let [x, y, _] = gains.attitude_rms(&ReadingNoise::of_sensors(of).expect("sensors"));
    let response = x.hypot(y);
    let run = in_run(&scenario, SETTLED);
    println!(
        "{whole:e} rad, response {response:e}, run {run:e}: {:e} {:e}",
        whole / response - 1.0,
        whole / run - 1.0
    );
    // At the samples, and in the mean over time.
    assert!((whole / response - 1.0).abs() < 0.002, "{whole:e} {response:e}");
    assert!((whole / run - 1.0).abs() < AGREEMENT[0], "{whole:e} {run:e}");
}

/// A bias that walks, followed by the estimator. Its gains have a time constant of some 10 s: 40,000 s are 2000 independent squares,
/// twice, so that the RMS of the run has a deviation of one percent; the bound is three of them.
#[test]
fn a_bias_that_walks_is_in_the_run() {
    let sensors = |walk: &str| {
        format!(
            "sensors = {{ seed = 5, gyro = {{ output = \"integrating\", angle_random_walk = \"0.002 deg/sqrt(s)\"{walk} }}, star_tracker = {{ noise = \"20 arcsec\" }} }}\n\
             estimator = {{ attitude_deviation = \"20 arcsec\", bias_deviation = \"10 deg/h\" }}"
        )
    };
    let walk = ", rate_random_walk = \"0.0005 deg/s/sqrt(s)\"";
    let scenario = bus("", &sensors(walk), (40_000.0, 0.25, 4.0));
    let [whole, ..] = rms(&noise(&scenario, "hub"));
    // The same loop, the gains of the estimator included, by white noise only.
    let of = chosen(&scenario, None).expect("a controller");
    let gains = ControlLoop::new(&scenario, of, &[]).expect("a loop").noise().expect("stable");
    let [x, y, _] = gains.attitude_rms(&ReadingNoise::of_sensors(of).expect("sensors"));
    let run = in_run(&scenario, 1000.0);
    println!("{whole:e} rad, white only {:e}, run {run:e}: {:e}", x.hypot(y), whole / run - 1.0);
    assert!((whole / run - 1.0).abs() < 0.03, "{whole:e} {run:e}");
    assert!(x.hypot(y) < 0.9 * whole, "{whole:e} {:e}", x.hypot(y));
}
