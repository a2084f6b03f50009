//! Integrals over frequency against closed forms.

use nalgebra::Complex;

use super::super::noise::Densities;
use super::*;
use crate::pointing::Metric;

/// Densities of one output, of an interval each.
fn densities(bands: &[[f64; 2]], natural: &[Oscillation], of: impl Fn(f64) -> f64) -> Densities {
    let intervals = intervals(bands, std::iter::empty(), natural);
    let frequencies: Vec<f64> = intervals.iter().copied().flat_map(nodes).collect();
    let values = frequencies.iter().map(|f| vec![of(*f)]).collect();
    Densities { speed: 1.0, intervals, frequencies, values }
}

/// The integral of a mode over a band, Hz, by its antiderivative.
fn of_mode(centre: f64, damping: f64, [from, to]: [f64; 2]) -> f64 {
    // 1 / ((1 - r^2)^2 + (2 zeta r)^2) = Im(1 / (r^2 - p^2)) / Im(p^2), with p^2 = 1 - 2 zeta^2 + 2 i zeta sqrt(1 - zeta^2).
    let p = Complex::new((1.0 - damping * damping).sqrt(), damping);
    let at = |f: f64| {
        let r = Complex::new(f / centre, 0.0);
        (((p - r) / (p + r)).ln() / (p * 2.0)).im
    };
    centre * (at(to) - at(from)) / (p * p).im
}

#[test]
fn a_power_of_the_frequency_is_exact_in_any_band() {
    let all = densities(&[[5.0, 200.0]], &[], |f| f.powi(-4));
    let exact = |[a, b]: [f64; 2]| (a.powi(-3) - b.powi(-3)) / 3.0;
    for band in [[5.0, 200.0], [100.0, 100.5], [33.0, 34.0], [10.0, 20.0], [1.0, 6.0], [199.0, 1e9]]
    {
        let weight = Weight::of_metric(&Metric::BandRms(band)).expect("no index");
        let found = all.mean_square(&[0], &weight);
        let expected = exact([band[0].max(5.0), band[1].min(200.0)]);
        assert!((found / expected - 1.0).abs() < 1e-12, "{band:?}: {found} for {expected}");
    }
    let found = all.mean_square(&[0], &Weight::one());
    assert!((found / exact([5.0, 200.0]) - 1.0).abs() < 1e-13, "{found}");
}

/// Of two noises each stops where its own band does.
#[test]
fn a_gap_and_a_step_between_bands_are_edges() {
    let step = |f: f64| if f < 20.0 { 1.0 } else { 3.0 };
    let all = densities(&[[10.0, 30.0], [10.0, 20.0], [50.0, 60.0]], &[], step);
    let found = all.mean_square(&[0], &Weight::one());
    assert!((found - 70.0).abs() < 1e-12, "{found}");
    assert!(all.frequencies.iter().all(|f| *f < 30.0 || 50.0 < *f));
}

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn shares_of_exposures_are_those_of_fine_steps() {
    let all = densities(&[[5.0, 200.0]], &[], |f| f.powi(-2));
    for (time, near) in [(0.01, 1e-9), (1.0, 1e-9), (30.0, 1e-4)] {
        for metric in [Metric::Displacement(time), Metric::Smear(time), Metric::Jitter(time)] {
            let weight = Weight::of_metric(&metric).expect("no index");
            let found = all.mean_square(&[0], &weight);
            // Simpson's rule with hundreds of parts in each period of the share.
            let parts = 4_000_000;
            let step = 195.0 / f64::from(parts);
            let of = |k: i32| {
                let f = 5.0 + step * f64::from(k);
                let simpson = if k == 0 || k == parts { 1.0 } else { f64::from(2 + 2 * (k % 2)) };
                simpson * weight.at(TAU * f) / (f * f)
            };
            let expected = (0..=parts).map(of).sum::<f64>() * step / 3.0;
            let off = (found / expected - 1.0).abs();
            assert!(off < near, "{metric:?}: {found:e} for {expected:e}");
        }
    }
}

#[test]
fn intervals_resolve_a_lightly_damped_mode() {
    for damping in [0.05, 0.005, 1e-5] {
        let mode = Oscillation { frequency: TAU * 40.0, damping };
        let density = |f: f64| {
            let r = f / 40.0;
            1.0 / ((1.0 - r * r).powi(2) + (2.0 * damping * r).powi(2))
        };
        let all = densities(&[[1.0, 400.0]], &[mode], density);
        for band in [[1.0, 400.0], [30.0, 40.0], [39.9, 40.3]] {
            let weight = Weight::of_metric(&Metric::BandRms(band)).expect("no index");
            let found = all.mean_square(&[0], &weight);
            let expected = of_mode(40.0, damping, band);
            assert!(
                (found / expected - 1.0).abs() < 1e-4,
                "{damping} {band:?}: {found} {expected}"
            );
        }
    }
}

/// Twenty modes, each a tenth above the one before: every one is resolved, with fewer frequencies than each by itself.
#[test]
fn intervals_resolve_modes_that_are_close() {
    let natural: Vec<Oscillation> = (0..20)
        .map(|k| Oscillation { frequency: TAU * 40.0 * 1.1_f64.powi(k), damping: 0.005 })
        .collect();
    for of in &natural {
        let centre = of.frequency / TAU;
        let density = |f: f64| {
            let r = f / centre;
            1.0 / ((1.0 - r * r).powi(2) + (2.0 * of.damping * r).powi(2))
        };
        let all = densities(&[[1.0, 400.0]], &natural, density);
        assert!(all.frequencies.len() < 20 * 60 + 220, "{} frequencies", all.frequencies.len());
        let found = all.mean_square(&[0], &Weight::one());
        let expected = of_mode(centre, of.damping, [1.0, 400.0]);
        assert!((found / expected - 1.0).abs() < 1e-4, "{found} for {expected}");
    }
}

#[test]
fn cumulative_squares_end_at_the_mean_square() {
    let all = densities(&[[5.0, 200.0]], &[], |f| f.powi(-4));
    let weight = Weight::of_metric(&Metric::BandRms([33.0, 34.0])).expect("no index");
    let cumulative = all.cumulative(&[0], &weight);
    assert_eq!(cumulative.len(), all.frequencies.len());
    assert!(cumulative.is_sorted());
    let whole = all.mean_square(&[0], &weight);
    assert!((cumulative.last().expect("some") / whole - 1.0).abs() < 1e-12);
    let parts: f64 = all.squares(&[0], &weight).iter().map(|(_, square)| square).sum();
    assert!((parts / whole - 1.0).abs() < 1e-12);
}
