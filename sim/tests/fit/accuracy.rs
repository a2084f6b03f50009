//! Accuracy and coverage of the fit of one wheel: `scene.rs` says which, with what noise.

use precess::fit::{FitError, Fitted, Group, Measurement, Options, fit};

use super::scene::{H, SEED, Variant, measured, stated, wheel};
use super::synthetic::Random;
use super::trials::{Compared, compared, coverage, trials};

/// The acceptance: `U_s` and `U_d`, harmonic numbers, modes.
const IMBALANCE: f64 = 0.02;
const NUMBER: f64 = 5e-3;
const MODE: f64 = 0.01;
/// Damping ratios: fewer lines are within a half-power width than near a mode.
const DAMPING: f64 = 0.03;
/// Four standard deviations of the weakest coefficients, 1 % each.
const COEFFICIENT: f64 = 0.04;
/// The drift of a record whose lines sweep by half a bin.
const DRIFT: f64 = 0.1;
/// Trials of the test; the example `fit_coverage` runs 1000.
const TRIALS: usize = 100;
/// Of 100 trials at 95 % less than 87 are inside once in 2000 draws.
const INSIDE_MIN: f64 = 0.87;
/// All intervals of all trials: the bounds that 1000 trials have for each parameter.
const POOLED: [f64; 2] = [0.93, 0.97];

fn close(all: &[Compared]) {
    for (name, put_in, found) in all {
        let bound = match name.as_str() {
            "U_s" | "U_d" => IMBALANCE,
            name if name.starts_with("h =") => NUMBER,
            name if name.starts_with("frequency") || name.starts_with("I_s") => MODE,
            name if name.starts_with("damping") => DAMPING,
            _ => COEFFICIENT,
        };
        let error = (found.value / put_in - 1.0).abs();
        assert!(error < bound, "{name}: {} instead of {put_in}", found.value);
        assert!(found.deviation > 0.0 && found.deviation.is_finite(), "{name}");
    }
}

fn fitted(variant: Variant, options: &Options) -> Fitted {
    let measurement = measured(&wheel(), variant, &mut Random::new(SEED));
    fit(&measurement, options).expect("it fits")
}

#[test]
fn a_wheel_is_found_within_its_bounds() {
    let indexed = Variant { indexed: true, ..Variant::default() };
    for variant in [Variant::default(), indexed] {
        let fitted = fitted(variant, &stated(variant));
        close(&compared(&wheel(), &fitted));
        assert_eq!(fitted.imbalance.angle.is_some(), variant.indexed);
        assert!(fitted.imbalance.phase.is_some(), "torque and force are in one record");
    }
}

#[test]
#[ignore = "long: `cargo xtask test --all --for sim/src/fit`"]
fn a_drifting_speed_that_is_badly_known_costs_nothing() {
    let variant = Variant { indexed: false, drift: 1e-3, speeds: 3e-4 };
    let fitted = fitted(variant, &stated(variant));
    close(&compared(&wheel(), &fitted));
    // Of the fastest record, whose lines tell the most, of 1.024 s.
    let fastest = fitted.rotations.last().expect("forty records");
    let drift = fastest.drift * 1.024 / fastest.speed;
    assert!((drift / 1e-3 - 1.0).abs() < DRIFT, "{drift}");
    let phases = fitted.harmonics.iter().flat_map(|h| &h.coefficients);
    assert!(phases.into_iter().all(|c| c.phase.is_none()), "no index, no phase");
}

#[test]
#[ignore = "long: `cargo xtask test --all --for sim/src/fit`"]
fn lines_and_modes_that_nobody_stated_are_found() {
    let variant = Variant { indexed: true, ..Variant::default() };
    let fitted = fitted(variant, &Options::default());
    let numbers: Vec<f64> = fitted.harmonics.iter().map(|h| h.number.value).collect();
    assert_eq!(numbers.len(), H.len(), "{numbers:?}");
    let groups: Vec<Group> = fitted.modes.iter().map(|mode| mode.group).collect();
    assert_eq!(groups, [Group::RadialForce, Group::RadialTorque]);
    close(&compared(&wheel(), &fitted));
}

#[test]
#[ignore = "long: `cargo xtask test --all --for sim/src/fit`"]
fn intervals_have_what_was_put_in() {
    let found = trials(TRIALS, Variant::default());
    assert!(found.iter().all(|all| all.len() == found[0].len()));
    let shares = coverage(&found);
    for (name, share) in &shares {
        assert!(*share >= INSIDE_MIN, "{name}: {share}");
    }
    let pooled = shares.iter().map(|(_, share)| share).sum::<f64>() / shares.len() as f64;
    assert!((POOLED[0]..=POOLED[1]).contains(&pooled), "{pooled}");
}

#[test]
#[ignore = "long: `cargo xtask test --all --for sim/src/fit`"]
fn the_same_measurement_gives_the_same_bits() {
    let variant = Variant::default();
    let [a, b] = [(); 2].map(|()| fitted(variant, &stated(variant)));
    assert_eq!(a.harmonics, b.harmonics);
    assert_eq!(a.modes, b.modes);
}

#[test]
fn what_cannot_be_fitted_is_an_error() {
    let good = measured(&wheel(), Variant::default(), &mut Random::new(SEED));
    let two = Measurement { records: good.records[..2].to_vec() };
    assert!(matches!(fit(&two, &Options::default()), Err(FitError::Records { found: 2, .. })));
    let twice = Options { harmonics: vec![2.0, 2.0], ..Options::default() };
    assert!(matches!(fit(&good, &twice), Err(FitError::Harmonic { .. })));
    // Noise only: no line follows the speed.
    let mut random = Random::new(SEED);
    let mut noise = Measurement { records: good.records[..8].to_vec() };
    for record in &mut noise.records {
        record.channels.iter_mut().flatten().for_each(|sample| *sample = random.normal());
    }
    let found = fit(&noise, &Options::default());
    assert!(matches!(found, Err(FitError::NoLines { .. })), "{found:?}");
    // No signal at all, and pulses that fit no speed.
    for record in &mut noise.records {
        record.channels.iter_mut().flatten().for_each(|sample| *sample = 0.0);
    }
    assert!(fit(&noise, &Options::default()).is_err());
    let mut wrong = good;
    wrong.records[0].pulses = vec![0.1, 0.13, 0.2, 0.31, 0.33];
    assert!(matches!(fit(&wrong, &Options::default()), Err(FitError::Pulses { .. })));
}
