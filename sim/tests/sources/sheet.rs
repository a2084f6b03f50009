//! The example `wheel-data-sheet.toml`: its numbers against closed forms; and the units of data sheets.

use std::f64::consts::{PI, TAU};
use std::path::Path;

use nalgebra::{Matrix5, Vector5};
use precess::disturbance::Model;
use precess::file::from_file;
use precess::scenario::Scenario;

use super::{WHEEL, column, largest, ran, read};

/// Of F / m, on a free hub without a mode: what is left are products of the hub's small rotation and the
/// radial motion. Measured: 2e-6.
const OFF_RESONANCE: f64 = 1e-5;
/// Of a density: the interpolation of the noise, 1.4e-8 of the highest line, and the wheel's rate, which
/// its imbalance changes by some 1e-7 of itself; twice, in a square.
const DENSITY: f64 = 1e-6;

fn sheet() -> Scenario {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenarios/wheel-data-sheet.toml");
    from_file(&path, &[]).unwrap_or_else(|errors| panic!("{errors}")).0
}

/// Amplitudes of two tones of a history by least squares, with a constant.
fn amplitudes(history: &[f64], angles: &[f64], numbers: [f64; 2]) -> [f64; 2] {
    let (mut normal, mut right) = (Matrix5::zeros(), Vector5::zeros());
    for (value, theta) in history.iter().zip(angles) {
        let ([s1, c1], [s2, c2]) = (
            <[f64; 2]>::from((numbers[0] * theta).sin_cos()),
            <[f64; 2]>::from((numbers[1] * theta).sin_cos()),
        );
        let row = Vector5::new(s1, c1, s2, c2, 1.0);
        normal += row * row.transpose();
        right += row * *value;
    }
    let found = normal.lu().solve(&right).expect("tones that differ");
    [found[0].hypot(found[1]), found[2].hypot(found[3])]
}

#[test]
fn an_axial_tone_accelerates_the_hub_by_force_over_mass() {
    let mut scenario = sheet();
    scenario.disturbances.retain(|of| of.name == "bearing");
    scenario.output.columns.retain(|name| name != "source_noise");
    let (outcome, samples) = ran(&scenario);
    let (theta, a) = (column(&samples, "rw.theta"), column(&samples, "acceleration_z"));
    let found = amplitudes(&a, &theta, [3.87, 5.18]);
    let omega = 100.0 * PI;
    for (found, coefficient) in found.iter().zip([1.2e-8, 4e-9]) {
        let expected = coefficient * omega * omega / 400.0;
        println!("{found:e} m/s², F / m {expected:e}");
        assert!((found / expected - 1.0).abs() < OFF_RESONANCE, "{found:e} {expected:e}");
    }
    // The column says the same of the force itself.
    let force = amplitudes(&column(&samples, "source_bearing.force_z"), &theta, [3.87, 5.18]);
    assert!((force[1] / 0.394_784e-3 - 1.0).abs() < DENSITY, "{force:?}");
    assert!(outcome.drift.energy.is_some_and(|drift| drift < 1e-9), "{:?}", outcome.drift);
    assert_eq!(outcome.drift.linear, None);
}

#[test]
fn the_noise_has_the_densities_of_the_sheet() {
    let (_, samples) = ran(&sheet());
    // 2 s at 2 kHz; the last sample is the first of the next period.
    let periodogram = |history: &[f64], cycles: u32| {
        let angle = |i: u32| TAU * f64::from(cycles) * f64::from(i) / 4000.0;
        let sum = |of: fn(f64) -> f64| {
            let terms = history.iter().take(4000).zip(0..).map(|(x, i)| x * of(angle(i)));
            terms.sum::<f64>() / 4000.0
        };
        2.0 * (sum(f64::cos).powi(2) + sum(f64::sin).powi(2)) * 2.0
    };
    // log-log between 5, 50 and 400 Hz.
    let between = |f: f64, [f_0, s_0]: [f64; 2], [f_1, s_1]: [f64; 2]| {
        s_0 * (s_1 / s_0).powf((f / f_0).ln() / (f_1 / f_0).ln())
    };
    for (name, first, table) in [
        ("source_noise.force_x", 5.0, [1e-9, 4e-10, 4e-11]),
        ("source_noise.force_y", 5.0, [1e-9, 4e-10, 4e-11]),
        ("source_noise.force_z", 5.0, [2e-10, 2e-10, 2e-10]),
        ("source_noise.moment_x", 5.0, [1e-11, 1e-11, 1e-12]),
    ] {
        let history = column(&samples, name);
        for cycles in [10, 11, 57, 100, 101, 333, 799, 800] {
            let f = f64::from(cycles) / 2.0;
            let expected = if f <= 50.0 {
                between(f, [first, table[0]], [50.0, table[1]])
            } else {
                between(f, [50.0, table[1]], [400.0, table[2]])
            };
            let found = periodogram(&history, cycles);
            assert!(
                (found / expected - 1.0).abs() < DENSITY,
                "{name} at {f} Hz: {found} {expected}"
            );
        }
        for cycles in [5, 9, 801, 1000] {
            let found = periodogram(&history, cycles);
            assert!(found < DENSITY * table[0], "{name} at {cycles} / 2 Hz: {found}");
        }
    }
    assert_eq!(largest(column(&samples, "source_noise.moment_z")), 0.0);
}

/// Tables of harmonics are often in N/rpm²: 1 N/rpm² is (60 / 2π)² kg m.
#[test]
fn an_amplitude_may_be_over_the_square_of_a_rate_in_rpm() {
    let source = |amplitude: &str| {
        let text = format!(
            "{WHEEL}[[source]]\nname = \"a\"\non = \"rw\"\n[[source.harmonic]]\nnumber = 2\n\
             axial_force = \"{amplitude}\"\nphase.axial_force = \"0 deg\"\n"
        );
        let found = read(&text);
        let Model::Harmonic(tones) = &found.disturbances[0].model else { panic!("harmonics") };
        tones[0].amplitudes.iter().sum::<f64>()
    };
    let [by_rpm, by_mass] = ["1.3e-7 N/rpm^2", "1.3e-7 kg m"].map(source);
    let factor = (60.0 / TAU).powi(2);
    assert!((by_rpm / by_mass / factor - 1.0).abs() < 1e-14, "{by_rpm} {by_mass}");
}
