//! How far intervals fall short where the truth is richer than what is fitted: the bus of the health benchmark, whose wheels are on flexible
//! bearings with tones and noise, with a flexible array and a clock of each joint, identified as a rigid one.

use std::f64::consts::PI;
use std::fs;

use precess::file::identification_from_toml;
use precess::fit::Estimate;
use precess::health::{HealthCase, Loop, Spacecraft, Timing, record};
use precess::identify::{Identified, Unknowns, identify};
use precess::scenario::Scenario;
use precess::telemetry::{Sensor, Series, Telemetry};

use super::recovered::{deviations, is_within};

const UNKNOWN: &str = r#"format = 1
name = "bus"

[unknown]
hub_moments = true
gyro_bias = "2 deg/h"

[[unknown.device]]
name = "rw1"
imbalance = { static = "1 g cm", dynamic = "20 g cm^2" }
coulomb = true

[[unknown.device]]
name = "rw2"
imbalance = { static = "1 g cm", dynamic = "20 g cm^2" }
coulomb = true

[[unknown.device]]
name = "rw3"
imbalance = { static = "1 g cm", dynamic = "20 g cm^2" }
coulomb = true

[[unknown.device]]
name = "rw4"
imbalance = { static = "1 g cm", dynamic = "20 g cm^2" }
coulomb = true

[noise]
tachometer = "0.01 rad/s"
"#;

/// Kinds of numbers that are counted together.
const KINDS: [&str; 6] = ["moments", "bias", "coulomb", "U_s", "U_d", "phase"];

fn unknowns(scenario: &Scenario) -> Unknowns {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("unknown.toml");
    fs::write(&path, UNKNOWN).expect("a file");
    identification_from_toml(&path, scenario).expect("a file of unknowns").unknowns
}

/// The telemetry of a seed.
fn telemetry(of: Loop, seed: u32, duration: f64) -> Telemetry {
    let case = HealthCase { spacecraft: Spacecraft::Bus, of, fault: None };
    let record = record(&case, seed, &Timing { duration, ..Timing::default() }).expect("a record");
    let empty = |sensor: Sensor, name: &str| Series {
        sensor,
        name: name.to_owned(),
        times: Vec::new(),
        values: Vec::new(),
    };
    let mut series: Vec<Series> =
        record.sensors.iter().map(|of| empty(of.sensor, &of.name)).collect();
    for reading in &record.readings {
        series[reading.index].times.push(reading.time);
        series[reading.index].values.push(reading.value);
    }
    Telemetry { series, exclusions: Vec::new() }
}

/// Kind, name, truth and estimate of what is compared. The angle of a wheel at the first reading is left out: it is that of no file.
fn compared(found: &Identified) -> Vec<(usize, String, f64, &Estimate)> {
    let mut all = Vec::new();
    let mut number = |kind: usize, name: String, truth: f64| {
        let of = found.number(&name).unwrap_or_else(|| panic!("no {name}"));
        all.push((kind, name, truth, &of.estimate));
    };
    for (axis, moment) in [("xx", 40.6), ("yy", 34.6), ("zz", 30.3)] {
        number(0, format!("hub.i_b_bc_{axis}"), moment);
    }
    for (axis, bias) in [("x", 0.5_f64), ("y", -0.3), ("z", 0.4)] {
        number(1, format!("gyro.bias_{axis}"), (bias / 3600.0).to_radians());
    }
    let wheels = [
        ("rw1", [0.55, 5.5, 40.0]),
        ("rw2", [0.45, 6.0, -70.0]),
        ("rw3", [0.5, 4.5, 120.0]),
        ("rw4", [0.6, 5.0, 10.0_f64]),
    ];
    for (name, _) in wheels {
        number(2, format!("{name}.wheel.coulomb"), 2.1e-3);
    }
    for (name, [u_s, u_d, phase]) in wheels {
        let of = found.wheels.iter().find(|of| of.device == name).expect("a wheel");
        all.push((3, format!("U_s of {name}"), u_s * 1e-5, &of.u_s));
        all.push((4, format!("U_d of {name}"), u_d * 1e-7, &of.u_d));
        all.push((5, format!("phase of {name}"), phase * PI / 180.0, &of.phase));
    }
    all
}

/// Sums over the numbers of a kind.
#[derive(Clone, Copy, Default)]
struct Covered {
    all: u32,
    inside: u32,
    /// Of errors by the stated deviations, and of their squares; of relative errors.
    errors: f64,
    squares: f64,
    relative: f64,
}

/// One short record in closed loop. With `PRECESS_DRAWS=50` as many of each loop, of 20 s or of `PRECESS_SECONDS`: how often intervals have the truth, and errors by deviations.
#[test]
#[ignore = "long: `cargo xtask test --all --for sim/src/identify`"]
fn intervals_of_a_rigid_model_of_a_flexible_bus() {
    let draws = std::env::var("PRECESS_DRAWS").ok().and_then(|of| of.parse::<u32>().ok());
    let seconds = std::env::var("PRECESS_SECONDS").ok().and_then(|of| of.parse::<f64>().ok());
    let (loops, draws, duration) = match draws {
        Some(draws) => (&[Loop::Closed, Loop::Open][..], draws, seconds.unwrap_or(20.0)),
        None => (&[Loop::Closed][..], 1, 6.0),
    };
    let scenario = Spacecraft::Bus.watched().expect("a scenario");
    let unknowns = unknowns(&scenario);
    for of in loops.iter().copied() {
        let mut kinds = [Covered::default(); KINDS.len()];
        let mut squares: Vec<(&str, f64)> = Vec::new();
        for seed in 1..=draws {
            let telemetry = telemetry(of, seed, duration);
            let found = identify(&scenario, &telemetry, &unknowns, &mut |_| true);
            let found = found.expect("estimates");
            for (kind, name, truth, estimate) in compared(&found) {
                let error = deviations(&name, truth, estimate);
                let of = &mut kinds[kind];
                of.all += 1;
                of.inside += u32::from(is_within(&name, truth, estimate));
                of.errors += error;
                of.squares += error * error;
                of.relative += (estimate.value - truth) / truth;
                if draws == 1 {
                    println!("{name}: {truth:e}, {:e} ± {:e}", estimate.value, estimate.deviation);
                    // What the fitted model lacks is not more than that.
                    let off = (error * estimate.deviation / truth).abs();
                    assert!(kind == 1 || kind == 5 || off < 0.6, "{name} is off by {off}");
                }
            }
            squares.extend(found.residuals.iter().map(|of| (of.sensor, of.mean_square)));
        }
        println!("{of:?} loop, {draws} records of {duration} s");
        println!("kind: covered %, mean and root mean square error by deviations, mean error %");
        for (name, of) in KINDS.iter().zip(kinds) {
            let count = f64::from(of.all);
            println!(
                "{name}: {:.1}, {:.2}, {:.2}, {:.2}",
                100.0 * f64::from(of.inside) / count,
                of.errors / count,
                (of.squares / count).sqrt(),
                100.0 * of.relative / count
            );
        }
        squares.sort_by(|a, b| a.0.cmp(b.0).then(a.1.total_cmp(&b.1)));
        for sensor in squares.chunk_by(|a, b| a.0 == b.0) {
            let [(name, middle)] = sensor[sensor.len() / 2..][..1] else { unreachable!() };
            println!("residuals of {name}: median mean square {middle:.2}");
        }
    }
}
