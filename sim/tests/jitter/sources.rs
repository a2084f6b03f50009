//! Harmonics and noise of a data sheet on a rigid hub: amplitudes and densities against force over mass.

use std::f64::consts::TAU;
use std::path::Path;

use precess::file::{from_file, from_toml};
use precess::jitter::model::{HUB, Model, Output};
use precess::jitter::noise::{Densities, NoiseSweep};
use precess::jitter::sweep::{Phases, sweep};
use precess::jitter::weight::Weight;
use precess::pointing::Metric;

use super::known::STEADY;

/// What the wheel's share of the motion of a rigid body leaves of the closed form: its imbalance in the mass matrix.
const ROUNDING: f64 = 1e-9;

fn displacement(axis: usize) -> Output {
    let mut row = [0.0; 6];
    row[axis] = 1.0;
    Output { name: format!("{axis}"), terms: vec![(HUB.to_owned(), row)] }
}

#[test]
fn axial_tones_and_noise_of_a_data_sheet_move_the_hub_by_force_over_mass() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenarios/wheel-data-sheet.toml");
    let (scenario, _) = from_file(&path, &[]).unwrap_or_else(|errors| panic!("{errors}"));
    let mut model = Model::new(&scenario, &[displacement(2)], &STEADY).expect("valid");
    assert_eq!(model.add_sources(&scenario).expect("finite"), Vec::<String>::new());
    let contributors = model.contributors();
    let orders: Vec<f64> = contributors.iter().map(|of| of.order).collect();
    assert_eq!(orders, [1.0, 2.0, 3.87, 5.18]);
    assert_eq!(contributors[3].cause, "bearing");
    let rates = [100.0, 314.0];
    for rate in rates {
        let lines = model.lines(rate).expect("above zero");
        for (line, force) in lines.iter().zip([0.0, 0.0, 1.2e-8, 4e-9]) {
            // C Omega^2 / m by w^2 = h^2 Omega^2.
            let order = contributors[line.contributor].order;
            let expected = force / 400.0 / (order * order);
            let found = line.values[0].norm();
            assert!((found - expected).abs() <= ROUNDING * expected + 1e-20, "{order}: {found:e}");
        }
        // The density of the axial force is constant: 2e-10 N^2/Hz at 3000 rpm, and grows with the fourth power.
        let scale = (rate / (100.0 * std::f64::consts::PI)).powi(4);
        for frequency in [5.0, 60.0, 399.0] {
            let w = TAU * frequency;
            let expected = 2e-10 * scale / (400.0 * w * w).powi(2);
            let found = model.density(rate, w).expect("above zero")[0];
            assert!((found / expected - 1.0).abs() < ROUNDING, "{frequency} Hz: {found:e}");
        }
        assert_eq!(model.density(rate, TAU * 500.0).expect("above zero")[0], 0.0);
    }
    let densities = rates.map(|rate| Densities::new(&model, rate).expect("regular"));
    let noise = NoiseSweep { speeds: densities.to_vec() };
    // The mean square of the displacement in a band: S / (m^2 (2 pi)^4) (a^-3 - b^-3) / 3.
    for rate in [100.0, 171.0, 314.0] {
        let scale = (rate / (100.0 * std::f64::consts::PI)).powi(4);
        for band in [[5.0_f64, 400.0], [1.0, 1000.0], [100.0, 100.5], [10.0, 20.0]] {
            let (a, b): (f64, f64) = (band[0].max(5.0), band[1].min(400.0));
            let expected =
                2e-10 * scale / (400.0_f64.powi(2) * TAU.powi(4)) * (a.powi(-3) - b.powi(-3)) / 3.0;
            let weight = Weight::of_metric(&Metric::BandRms(band)).expect("no index");
            let found = noise.mean_square(rate, &[0], &weight);
            let off = (found / expected - 1.0).abs();
            assert!(off < 1e-9, "{rate} rad/s, {band:?}: {found:e} for {expected:e}");
        }
    }
    let all = sweep(&model, &rates, 1, &|_| {}).expect("regular");
    let one = Weight::one();
    let whole = all.mean_square(1, &[0], Phases::Unknown, &one);
    let parts: f64 = all.shares(1, &[0], Phases::Unknown, &one).iter().sum();
    let of_noise = all.noise_square(1, &[0], &one);
    assert!(of_noise > 0.0 && (whole / (parts + of_noise) - 1.0).abs() < 1e-12);
}

#[test]
fn a_source_that_the_frequency_domain_has_not_is_named() {
    let text = r#"
format = 1
[hub]
mass = "40 kg"
inertia = "4, 3.5, 3 kg m^2"
[[device]]
name = "rw"
kind = "reaction_wheel"
mount = { spin_axis = [0, 0, 1] }
[device.wheel]
mass = "4 kg"
inertia = "0.02, 0.012, 0.012 kg m^2"
rate = "300 rad/s"
[[source]]
name = "pump"
on = "hub"
seed = 1
[source.broadband]
force_z = "1e-6 N^2/Hz"
band = "1, 100 Hz"
period = "2 s"
[run]
duration = "1 s"
"#;
    let (scenario, _) =
        from_toml("pump", text, Path::new("")).unwrap_or_else(|errors| panic!("{errors}"));
    let mut model = Model::new(&scenario, &[displacement(2)], &STEADY).expect("valid");
    let left_out = model.add_sources(&scenario).expect("finite");
    assert_eq!(left_out.len(), 1, "{left_out:?}");
    assert!(left_out[0].contains("`pump`") && left_out[0].contains("no mount"), "{left_out:?}");
}
