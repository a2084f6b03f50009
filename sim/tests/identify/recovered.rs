//! The truth of the example, and of other seeds, is within the intervals.

use std::f64::consts::PI;
use std::fs;

use precess::file::identification_example as example;
use precess::file::identification_from_toml;
use precess::fit::Estimate;
use precess::identify::recording::Recording;
use precess::identify::{Identified, Unknowns};
use precess::scenario::Scenario;
use sha2::{Digest as _, Sha256};
use statrs::distribution::{ContinuousCDF as _, Normal};

use super::identified;

/// Intervals of 95 % of thirty numbers: by chance three are outside once in twenty records, six once in ten thousand.
const OUTSIDE_MAX: usize = 5;
/// None of them is farther than this, in standard deviations.
const FAR: f64 = 4.0;
/// Two solutions of one record are this near, in standard deviations: each has converged to 3e-3.
const SAME: f64 = 0.02;

/// What the example finds.
pub(crate) fn unknowns(scenario: &Scenario) -> Unknowns {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("unknown.toml");
    fs::write(&path, example::UNKNOWN).expect("a file");
    identification_from_toml(&path, scenario).expect("a file of unknowns").unknowns
}

/// The bias of the gyro in the example, rad/s.
fn example_bias() -> [f64; 3] {
    [0.5, -0.3, 0.4].map(|bias: f64| (bias / 3600.0).to_radians())
}

/// The truth of the example by the names of its numbers: `U_s`, `U_d`, phase and angle of each wheel, damping, moments, bias.
pub(crate) fn compared(found: &Identified) -> Vec<(String, f64, &Estimate)> {
    compared_with(found, example_bias())
}

/// The same with another bias, rad/s.
fn compared_with(found: &Identified, bias: [f64; 3]) -> Vec<(String, f64, &Estimate)> {
    let degrees = PI / 180.0;
    let wheels = [
        ("rw1", [0.21, 2.9, 40.0, 25.0], 1.4e-5),
        ("rw2", [0.17, 1.8, -70.0, -110.0], 1.1e-5),
        ("rw3", [0.12, 2.4, 120.0, 160.0], 2.3e-5),
        ("rw4", [0.28, 3.3, 10.0, 75.0], 0.8e-5),
    ];
    let mut all = Vec::new();
    let mut number = |name: &str, truth: f64| {
        let of = found.number(name).unwrap_or_else(|| panic!("no {name}"));
        all.push((name.to_owned(), truth, &of.estimate));
    };
    for (axis, moment) in [("xx", 41.3), ("yy", 34.2), ("zz", 30.6)] {
        number(&format!("hub.i_b_bc_{axis}"), moment);
    }
    for (axis, bias) in ["x", "y", "z"].into_iter().zip(bias) {
        number(&format!("gyro.bias_{axis}"), bias);
    }
    for (name, _, damping) in wheels {
        number(&format!("{name}.wheel.viscous"), damping);
    }
    for (name, [u_s, u_d, phase, angle], _) in wheels {
        let of = found.wheels.iter().find(|of| of.device == name).expect("a wheel");
        let what = |what: &str| format!("{what} of {name}");
        all.push((what("U_s"), u_s * 1e-5, &of.u_s));
        all.push((what("U_d"), u_d * 1e-7, &of.u_d));
        all.push((what("phase"), phase * degrees, &of.phase));
        all.push((what("angle"), angle * degrees, &of.angle));
    }
    all
}

/// An error by the standard deviation; angles within half a turn.
pub(crate) fn deviations(name: &str, truth: f64, found: &Estimate) -> f64 {
    let mut error = found.value - truth;
    if name.starts_with("phase") || name.starts_with("angle") {
        error = error.sin().atan2(error.cos());
    }
    error / found.deviation
}

/// How far estimates may be off in ten minutes: shares of `U_s` and `U_d`, of drag, of moments; phases, rad.
const OFF: [f64; 4] = [0.05, 0.02, 0.01, 3.0 * PI / 180.0];

/// With `PRECESS_SECONDS=600` from ten minutes, whose errors are bounded.
#[test]
fn the_example_is_recovered_within_its_intervals() {
    let seconds = std::env::var("PRECESS_SECONDS").ok().and_then(|of| of.parse::<f64>().ok());
    let scenario = example::scenario().expect("a scenario");
    let truth = example::truth().expect("a scenario");
    let duration = seconds.unwrap_or(example::RECORDING.duration);
    let record = Recording { duration, ..example::RECORDING };
    let text = record.csv(&truth).expect("telemetry");
    let start = std::time::Instant::now();
    let found = identified(&scenario, &text, &unknowns(&scenario)).expect("estimates");
    println!("{duration} s of telemetry in {:.1} s", start.elapsed().as_secs_f64());
    let mut outside = Vec::new();
    for (name, truth, estimate) in compared(&found) {
        let error = deviations(&name, truth, estimate);
        let Estimate { value, deviation, .. } = estimate;
        println!("{name}: {truth:e}, found {value:e} ± {deviation:e}");
        assert!(error.abs() < FAR, "{name}: {error} standard deviations");
        if !is_within(&name, truth, estimate) {
            outside.push(name.clone());
        }
        let of = |start: &str| name.starts_with(start);
        let [imbalance, drag, moment, phase] = OFF;
        let bound = match () {
            () if of("U_") => imbalance * truth,
            () if of("phase") => phase,
            () if of("hub") => moment * truth,
            () if name.ends_with("viscous") => drag * truth,
            () => f64::INFINITY,
        };
        let off = (error * deviation).abs();
        assert!(duration < 600.0 || off < bound, "{name} is off by {off:e}, above {bound:e}");
    }
    assert!(outside.len() <= OUTSIDE_MAX, "{outside:?}");
    assert!(found.holds() && found.is_told(), "{:?} {:?}", found.residuals, found.untold);
}

/// Whether the truth is within the interval; angles within half a turn of its middle.
pub(crate) fn is_within(name: &str, truth: f64, found: &Estimate) -> bool {
    let [low, high] = found.interval;
    if name.starts_with("phase") || name.starts_with("angle") {
        let error = truth - 0.5 * (low + high);
        return error.sin().atan2(error.cos()).abs() <= 0.5 * (high - low);
    }
    low <= truth && truth <= high
}

/// What many records say of a number.
#[derive(Clone, Debug, Default, PartialEq)]
struct Covered {
    name: String,
    inside: u32,
    /// Sums of errors by standard deviations, and of their squares.
    errors: f64,
    squares: f64,
}

/// Of all numbers together, on short records; with `PRECESS_DRAWS=1000` of each number, on as many records of 20 s.
#[test]
fn intervals_cover_the_truth_as_often_as_they_say() {
    let Some(draws) = std::env::var("PRECESS_DRAWS").ok().and_then(|of| of.parse::<u32>().ok())
    else {
        let found = coverage(6, 4.0);
        let all = 6 * u32::try_from(found.len()).expect("a count");
        let inside: u32 = found.iter().map(|of| of.inside).sum();
        // 156 intervals, which are not independent within a record: 95 % within four deviations of a share of as many by half.
        assert!(20 * inside > 17 * all && inside <= all, "{inside} of {all}");
        return;
    };
    let found = coverage(draws, 20.0);
    let all = f64::from(draws);
    println!("number: covered %, mean error, root mean square error, by standard deviations");
    for of in &found {
        let Covered { name, inside, errors, squares } = of;
        let share = 100.0 * f64::from(*inside) / all;
        println!("{name}: {share:.1}, {:.3}, {:.3}", errors / all, (squares / all).sqrt());
    }
    for Covered { name, inside, .. } in found {
        let share = f64::from(inside) / all;
        assert!((0.93..=0.97).contains(&share), "{name}: {share}");
    }
}

/// The bias of the gyro of a seed, rad/s: normal, of the deviation that the file of unknowns states. With one bias for all, intervals of what
/// mostly the prior tells would cover it always, or never.
fn bias_of(seed: u32) -> [f64; 3] {
    let deviation = (2.0_f64 / 3600.0).to_radians();
    [0, 1, 2].map(|axis| {
        let hash = Sha256::digest(format!("{seed} {axis}"));
        let bytes = hash.iter().take(4).fold(0_u32, |all, byte| (all << 8) | u32::from(*byte));
        let uniform = (f64::from(bytes) + 0.5) / 2.0_f64.powi(32);
        deviation * Normal::standard().inverse_cdf(uniform)
    })
}

/// The record of a seed, which counts for every sensor, with this bias of the gyro.
fn drawn(truth: &Scenario, seed: u32, bias: [f64; 3], duration: f64) -> String {
    let mut drawn = truth.clone();
    drawn.controllers[0].sensors.seed = seed;
    drawn.controllers[0].sensors.gyro.as_mut().expect("a gyro").bias = bias.into();
    let record = Recording { seed, duration, ..example::RECORDING };
    record.csv(&drawn).expect("telemetry")
}

/// Each from the truth, on as many threads as there are cores.
fn coverage(draws: u32, duration: f64) -> Vec<Covered> {
    let truth = example::truth().expect("a scenario");
    let unknowns = Unknowns { is_near: true, ..unknowns(&truth) };
    let threads = std::thread::available_parallelism().map_or(1, |of| of.get().min(64));
    let threads = u32::try_from(threads).expect("a count");
    let of_thread = |first: u32| {
        let mut all: Vec<Covered> = Vec::new();
        for seed in (first..draws).step_by(threads as usize) {
            let bias = bias_of(seed);
            let text = drawn(&truth, seed, bias, duration);
            let found = identified(&truth, &text, &unknowns).expect("estimates");
            let numbers = compared_with(&found, bias);
            all.resize(numbers.len(), Covered::default());
            for ((name, truth, estimate), of) in numbers.into_iter().zip(&mut all) {
                let error = deviations(&name, truth, estimate);
                of.inside += u32::from(is_within(&name, truth, estimate));
                of.errors += error;
                of.squares += error * error;
                of.name = name;
            }
        }
        all
    };
    let parts: Vec<Vec<Covered>> = std::thread::scope(|scope| {
        let threads: Vec<_> =
            (0..threads.min(draws)).map(|first| scope.spawn(move || of_thread(first))).collect();
        threads.into_iter().map(|of| of.join().expect("a thread")).collect()
    });
    let mut parts = parts.into_iter();
    let mut all = parts.next().unwrap_or_default();
    for part in parts {
        for (to, from) in all.iter_mut().zip(part) {
            to.inside += from.inside;
            to.errors += from.errors;
            to.squares += from.squares;
        }
    }
    all
}

/// Draws are taken from the truth, which saves the first parts of a record; from the data sheet the same is found.
#[test]
fn from_the_data_sheet_the_same_is_found_as_from_the_truth() {
    let draws = std::env::var("PRECESS_DRAWS").ok().and_then(|of| of.parse::<u32>().ok());
    let (draws, duration) = draws.map_or((1, 8.0), |draws| (draws.div_ceil(50), 20.0));
    let [truth, stated] = [example::truth(), example::scenario()].map(|of| of.expect("a scenario"));
    let near = Unknowns { is_near: true, ..unknowns(&truth) };
    for seed in 0..draws {
        let text = drawn(&truth, seed, example_bias(), duration);
        let from_truth = identified(&truth, &text, &near).expect("estimates");
        let from_sheet = identified(&stated, &text, &unknowns(&stated)).expect("estimates");
        for ((name, a, one), (_, _, other)) in
            compared(&from_truth).into_iter().zip(compared(&from_sheet))
        {
            let error = deviations(&name, a, one) - deviations(&name, a, other);
            assert!(error.abs() < SAME, "seed {seed}, {name}: {error} standard deviations");
        }
    }
}
