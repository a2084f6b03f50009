//! A fit to a waterfall, and the coverage of its intervals.

use std::f64::consts::TAU;

use precess::fit::{FitError, Group, fit_waterfall};

use super::scene::{RATE, SEED, U_D, U_S};
use super::synthetic::Random;
use super::trials::{coverage, spectra_trials};
use super::waterfalls::{APART, HALF, options, rows, wheel_of_spectra};

/// The acceptance, and what a segment of a quarter of the records leaves of it.
const IMBALANCE: f64 = 0.02;
const NUMBER: f64 = 5e-3;
const MODE: f64 = 0.01;
/// Trials of the test; the example `fit_coverage` runs 1000.
const TRIALS: usize = 60;
/// Of 60 trials at 95 % less than 51 are inside once in 1000 draws.
const INSIDE_MIN: f64 = 0.85;
/// All intervals of all trials: the bounds that 1000 trials have for each parameter.
const POOLED: [f64; 2] = [0.93, 0.97];
/// Errors of some sixty densities by their standard deviations, root mean square: three of its own from 1.
const NOISE: [f64; 2] = [0.72, 1.28];

#[test]
#[ignore = "long: `cargo xtask test --all --for sim/src/fit`"]
fn intervals_of_a_waterfall_have_what_was_put_in() {
    for averaging in [APART, HALF] {
        let found = coverage(&spectra_trials(TRIALS, averaging));
        for (name, share) in &found {
            assert!(*share >= INSIDE_MIN, "{name}: {share}");
        }
        let mean = found.iter().map(|(_, share)| share).sum::<f64>() / found.len() as f64;
        assert!((POOLED[0]..=POOLED[1]).contains(&mean), "{mean}: {found:?}");
    }
}

#[test]
fn the_noise_of_a_waterfall_is_within_its_intervals() {
    let wheel = wheel_of_spectra(APART);
    let mut random = Random::new(SEED);
    let mut errors = Vec::new();
    for _ in 0..3 {
        let rows = rows(&wheel, APART, &mut random);
        let fitted = fit_waterfall(&rows, &options(&wheel, true)).expect("it fits");
        // No mode divides the axial noise, which is the table's.
        for (group, bands) in &fitted.floors {
            if group.is_radial() {
                continue;
            }
            let deviation = wheel.noise[usize::from(*group == Group::AxialTorque)];
            let put_in = 2.0 * deviation * deviation / RATE;
            errors.extend(bands.iter().map(|b| (b.density.value - put_in) / b.density.deviation));
        }
    }
    let size = (errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64).sqrt();
    assert!((NOISE[0]..=NOISE[1]).contains(&size), "{size} of {} bands", errors.len());
}

#[test]
fn a_waterfall_gives_the_imbalance_and_the_radial_mode() {
    let wheel = wheel_of_spectra(APART);
    let rows = rows(&wheel, APART, &mut Random::new(SEED));
    let options = options(&wheel, false);
    let fitted = fit_waterfall(&rows, &options).expect("it fits");
    let numbers: Vec<f64> = fitted.harmonics.iter().map(|h| h.number.value).collect();
    for (found, put_in) in numbers.iter().zip([1.0, 2.0, 2.86, 5.2]) {
        assert!((found / put_in - 1.0).abs() < NUMBER, "{numbers:?}");
    }
    let imbalance = [fitted.imbalance.u_s, fitted.imbalance.u_d];
    for (found, put_in) in imbalance.iter().zip([U_S, U_D]) {
        assert!((found.value / put_in - 1.0).abs() < IMBALANCE, "{found:?}");
    }
    for (mode, hertz) in fitted.modes.iter().zip([210.0, 140.0]) {
        assert!((mode.frequency.value / (TAU * hertz) - 1.0).abs() < MODE, "{mode:?}");
    }
    assert!(fitted.imbalance.phase.is_none() && fitted.imbalance.angle.is_none());
    assert!(fit_waterfall(&rows[..2], &options).is_err());
    let mut again = rows.clone();
    again[7].densities = rows[3].densities.clone();
    let found = fit_waterfall(&again, &options);
    assert!(matches!(found, Err(FitError::Twice { places: [4, 8], .. })), "{found:?}");
    let mut bad = rows;
    bad[1].densities[2][9] = -1.0;
    assert!(fit_waterfall(&bad, &options).is_err());
}
