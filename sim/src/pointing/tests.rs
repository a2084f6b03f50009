//! Exposures and indices against simulated windows, closed forms of a first-order process, and rejected inputs.

use std::f64::consts::{PI, TAU};

use super::{
    Exposure, ExposureWeights, Index, Interpretation, Limit, Margin, Metric, PointingError, assess,
    exposure_of_history, exposure_of_lines, exposure_of_psd, exposure_of_table, index_of_psd,
    index_of_runs,
};
use crate::spectra::synthetic::{Random, tone};
use crate::spectra::{WelchSettings, float, psd};

/// Independent windows of a simulation.
const WINDOWS: usize = 10_000;
/// Samples of a window: sums differ from integrals by less than 1e-4 at the frequencies here.
const SAMPLES: usize = 256;
const SEED: u64 = 19_920_404;

/// Mean squares of displacement, smear and jitter over windows, with their standard errors.
fn simulated(mut window: impl FnMut() -> Vec<f64>) -> [[f64; 2]; 3] {
    let mut sums = [[0.0; 2]; 3];
    for _ in 0..WINDOWS {
        let samples = window();
        let found = exposure_of_history(&[&samples], float(SAMPLES), 1.0).expect("one window").rms;
        for (sum, value) in sums.iter_mut().zip([found.displacement, found.smear, found.jitter]) {
            sum[0] += value * value;
            sum[1] += value.powi(4);
        }
    }
    let n = float(WINDOWS);
    sums.map(|[sum, squares]| {
        let mean = sum / n;
        [mean, ((squares / n - mean * mean) / n).sqrt()]
    })
}

fn assert_within_three_standard_errors(found: [[f64; 2]; 3], expected: &Exposure) {
    let expected = [expected.displacement, expected.smear, expected.jitter].map(|rms| rms * rms);
    for ([mean, error], expected) in found.into_iter().zip(expected) {
        assert!((mean - expected).abs() < 3.0 * error, "{mean} ± {error} for {expected}");
    }
}

#[test]
fn lines_with_random_phase_have_the_weights_in_simulated_windows() {
    let mut random = Random::new(SEED);
    // u = pi f: each share is the largest once.
    for frequency in [0.2, 0.65, 1.4, 3.3] {
        let found = simulated(|| {
            let phase = TAU * random.uniform();
            let at = |i: usize| (float(i) + 0.5) / float(SAMPLES);
            (0..SAMPLES).map(|i| 3.0 * (TAU * frequency * at(i) + phase).cos()).collect()
        });
        let expected = exposure_of_lines(&[[frequency, 3.0]], 1.0).expect("an exposure");
        assert_within_three_standard_errors(found, &expected);
        assert!((expected.total().powi(2) - 4.5).abs() < 1e-12);
    }
}

/// Density of a process with unit variance and the autocorrelation exp(-|t| / tau), to a thousand cycles a window.
fn first_order_table(tau: f64) -> Vec<[f64; 2]> {
    let density = |f: f64| 4.0 * tau / (1.0 + (TAU * f * tau).powi(2));
    let mut frequencies = vec![0.0];
    frequencies.extend((0..=3000_u32).map(|k| 1e-3 * 10_f64.powf(f64::from(k) / 500.0)));
    frequencies.into_iter().map(|f| [f, density(f)]).collect()
}

#[test]
fn filtered_noise_has_the_weighted_density_in_simulated_windows() {
    let mut random = Random::new(SEED);
    for tau in [0.1, 1.0] {
        let found = simulated(|| random.first_order(SAMPLES, 1.0 / float(SAMPLES), tau));
        let expected = exposure_of_table(&first_order_table(tau), 1.0).expect("an exposure");
        assert_within_three_standard_errors(found, &expected);
    }
}

#[test]
fn a_first_order_process_has_its_displacement_in_closed_form() {
    for tau in [0.03, 0.3, 3.0] {
        let found = exposure_of_table(&first_order_table(tau), 1.0).expect("an exposure");
        // Variance of the mean over T = 1: 2 tau (1 - tau (1 - exp(-1 / tau))).
        let closed = 2.0 * tau * (1.0 - tau * (1.0 - (-1.0 / tau).exp()));
        // The table: lines between points a 0.5 % apart, and 256 parts of an interval.
        assert!((found.displacement.powi(2) / closed - 1.0).abs() < 1e-5, "{tau}");
        // And what lies beyond 1000 Hz.
        let beyond = 1.0 / (PI * PI * tau * 1000.0);
        assert!((found.total().powi(2) + beyond - 1.0).abs() < 1e-5, "{tau}");
    }
}

#[test]
fn a_density_of_welch_and_the_history_it_came_from_agree() {
    let samples = Random::new(SEED).first_order(400_000, 0.01, 0.2);
    let settings = WelchSettings::rectangular(2000);
    let density = psd(&samples, 100.0, &settings).expect("a density");
    let by_density = exposure_of_psd(&density, 1.0).expect("an exposure");
    let by_history = exposure_of_history(&[&samples], 100.0, 1.0).expect("exposures");
    assert_eq!((by_history.count, by_history.samples), (4000, 100));
    // 4000 windows: a standard error of 1.1 % of an RMS, three times; and bins of 1/20 of the inverse exposure.
    for (a, b) in [
        (by_density.displacement, by_history.rms.displacement),
        (by_density.smear, by_history.rms.smear),
        (by_density.jitter, by_history.rms.jitter),
    ] {
        assert!((a / b - 1.0).abs() < 0.035, "{a} {b}");
    }
    // All of the density is in one of the three.
    assert!((by_density.total().powi(2) / density.mean_square() - 1.0).abs() < 1e-9);
    assert!(by_history.worst.jitter > by_history.rms.jitter);
}

#[test]
fn a_ramp_is_smear_and_a_constant_displacement() {
    let samples: Vec<f64> = (0..100).map(|i| 5.0 + 0.02 * (f64::from(i) - 49.5)).collect();
    let found = exposure_of_history(&[&samples], 100.0, 1.0).expect("one window").rms;
    assert!((found.displacement - 5.0).abs() < 1e-12 && found.jitter < 1e-12);
    // A length of 2 less one sample of it, evenly spread: 2 sqrt((1 - 1e-4) / 12).
    assert!((found.smear_length() - 2.0 * (1.0_f64 - 1e-4).sqrt()).abs() < 1e-12);
}

#[test]
fn indices_of_a_known_history_are_those_of_the_definitions() {
    // Windows of two samples: means 2, 4, -1, deviations 1, 2, 3.
    let run: &[&[f64]] = &[&[1.0, 3.0, 2.0, 6.0, -4.0, 2.0]];
    let of = |index, level| {
        index_of_runs(index, &[run], 1.0, Interpretation::Temporal, level, None)
            .map(|found| (found.value, found.values))
    };
    let (window, most) = (2.0, 0.999);
    assert_eq!(of(Index::Ape, most), Ok((6.0, 6)));
    assert_eq!(of(Index::Ape, 0.5), Ok((2.0, 6)));
    assert_eq!(of(Index::Mpe { window }, most), Ok((4.0, 3)));
    assert_eq!(of(Index::Rpe { window }, most), Ok((3.0, 6)));
    assert_eq!(of(Index::Pde { window, stability: 2.0 }, most), Ok((5.0, 2)));
    assert_eq!(of(Index::Pde { window, stability: 4.0 }, most), Ok((3.0, 1)));
    let long = of(Index::Pde { window, stability: 6.0 }, most);
    assert_eq!(long, Err(PointingError::Short { samples: 6, least: 8 }));
    let between = of(Index::Pde { window, stability: 3.0 }, most);
    assert_eq!(between, Err(PointingError::Stability { stability: 3.0, window }));
    assert!(matches!(of(Index::Pre { window }, most), Err(PointingError::Interpretation { .. })));
    let other: &[&[f64]] = &[&[1.0, 3.0, 5.0, 5.0, -1.0, -1.0]];
    let pre = Index::Pre { window };
    let pre = index_of_runs(pre, &[run, other], 1.0, Interpretation::Mixed, most, None);
    assert_eq!(pre.map(|found| found.value), Ok(1.0));
    // A vector: magnitudes of (3, 4).
    let vector: &[&[f64]] = &[&[3.0; 4], &[4.0; 4]];
    let ape = index_of_runs(Index::Ape, &[vector], 1.0, Interpretation::Mixed, 0.9, None);
    assert_eq!(ape.map(|found| found.value), Ok(5.0));
}

#[test]
fn interpretations_differ_as_they_are_defined() {
    // Ten runs with the largest values 1 to 10, each for one of ten samples, and otherwise a tenth of it.
    let histories: Vec<Vec<f64>> = (1..=10)
        .map(|k| (0..10).map(|i| f64::from(k) * if i == 3 { 1.0 } else { 0.1 }).collect())
        .collect();
    let runs: Vec<[&[f64]; 1]> = histories.iter().map(|run| [run.as_slice()]).collect();
    let runs: Vec<&[&[f64]]> = runs.iter().map(<[&[f64]; 1]>::as_slice).collect();
    let of = |interpretation, level, confidence| {
        index_of_runs(Index::Ape, &runs, 1.0, interpretation, level, confidence)
    };
    let value = |interpretation, level| of(interpretation, level, None).expect("an index").value;
    assert_eq!(value(Interpretation::Temporal, 0.9), 1.0);
    assert_eq!(value(Interpretation::Temporal, 0.95), 10.0);
    assert_eq!(value(Interpretation::Ensemble, 0.9), 9.0);
    // 90 of 100 values are 1 or less but the one of the first run, which is 1, too.
    assert_eq!(value(Interpretation::Mixed, 0.91), 1.0);
    assert_eq!(value(Interpretation::Mixed, 0.92), 2.0);
    // The ninth of ten: P(at most 8 of 10 below) = 1 - 0.9^10 - 10 0.1 0.9^9.
    let nine = of(Interpretation::Ensemble, 0.9, None).expect("an index").confidence;
    let closed = 1.0 - 0.9_f64.powi(10) - 0.9_f64.powi(9);
    assert!((nine.expect("a confidence") - closed).abs() < 1e-12);
    // The largest: 1 - 0.9^10 = 0.651.
    let sure = of(Interpretation::Ensemble, 0.9, Some(0.65)).expect("an index");
    assert_eq!(sure.value, 10.0);
    let few = of(Interpretation::Ensemble, 0.9, Some(0.66)).expect_err("too few");
    assert!(few.to_string().ends_with("at least 11 are needed"), "{few}");
    assert!(of(Interpretation::Mixed, 0.9, Some(0.5)).is_err());
}

#[test]
fn indices_of_a_density_are_those_of_the_history_it_came_from() {
    let samples = Random::new(SEED).first_order(1_000_000, 0.01, 0.2);
    let density = psd(&samples, 100.0, &WelchSettings::rectangular(2000)).expect("a density");
    let halves = samples.split_at(500_000);
    let [first, second] = [[halves.0], [halves.1]];
    let (window, level) = (1.0, 0.683);
    for index in [
        Index::Ape,
        Index::Mpe { window },
        Index::Rpe { window },
        Index::Pde { window, stability: 3.0 },
        Index::Pre { window },
    ] {
        let by_density = index_of_psd(index, &density, level).expect("an index").value;
        let runs: [&[&[f64]]; 2] = [&first, &second];
        let found = index_of_runs(index, &runs, 100.0, Interpretation::Mixed, level, None);
        let found = found.expect("an index").value;
        // 5000 to 10000 independent windows: a standard error of 1.5 % of a quantile, three times.
        assert!((by_density / found - 1.0).abs() < 0.045, "{}: {by_density} {found}", index.name());
    }
    let twice = index_of_psd(Index::Ape, &density, 0.954_499_736).expect("an index").value;
    assert!((twice / density.mean_square().sqrt() - 2.0).abs() < 1e-6);
}

#[test]
fn margins_are_by_ratio_decibels_and_percent() {
    let samples = tone(10_000, 1000.0, [25.0, 2.0, 0.0]);
    let density = psd(&samples, 1000.0, &WelchSettings::rectangular(1000)).expect("a density");
    let unit = ("rad".to_owned(), 1.0);
    let limit = |metric, limit| Limit { name: String::new(), metric, limit, unit: unit.clone() };
    let limits = [
        limit(Metric::Rms, 10.0_f64.sqrt()),
        limit(Metric::BandRms([0.0, 30.0]), 1.0),
        limit(Metric::Displacement(0.02), 1.0),
        limit(Metric::Smear(0.02), 1.0),
        limit(Metric::Jitter(0.02), 1.0),
    ];
    // A line of 2 at 25 Hz in the density, and one of 4 at 50 Hz beside it.
    let found = assess(&limits, &density, &[[50.0, 4.0]]).expect("margins");
    let values: Vec<f64> = found.iter().map(|assessment| assessment.margin.value).collect();
    let [slow, fast] = [25.0, 50.0].map(|f| ExposureWeights::new(f, 0.02));
    let both = |of: fn(&ExposureWeights) -> f64| (2.0 * of(&slow) + 8.0 * of(&fast)).sqrt();
    let expected = [
        10.0_f64.sqrt(),
        2.0_f64.sqrt(),
        both(|w| w.displacement),
        both(|w| w.smear),
        both(|w| w.jitter),
    ];
    for (value, expected) in values.iter().zip(expected) {
        // The line in the density is spread over a bin of 1 Hz.
        assert!((value - expected).abs() < 2e-3 * expected, "{value} for {expected}");
    }
    assert!(found[0].margin.ratio() > 0.999 && !found[1].margin.is_met());
    let margin = Margin { value: 0.5, limit: 1.0 };
    assert!((margin.decibels() - 6.0206).abs() < 1e-4 && margin.percent() == 50.0);
    assert!(!Margin { value: f64::NAN, limit: 1.0 }.is_met());
    assert_eq!(Margin { value: 0.0, limit: 0.0 }.percent(), 100.0);
}

#[test]
fn what_has_no_metric_is_rejected() {
    let samples = [1.0, 2.0, 0.0, 1.0, 5.0, 3.0, 1.0, 0.0];
    let of = |rate, exposure| exposure_of_history(&[&samples], rate, exposure).map(|_| ());
    assert_eq!(of(1.0, 9.0), Err(PointingError::Short { samples: 8, least: 9 }));
    for (rate, exposure) in
        [(1.0, 2.0), (1.0, 3.5), (f64::NAN, 3.0), (1.0, f64::INFINITY), (1.0, -4.0), (1e300, 1e300)]
    {
        assert!(
            matches!(of(rate, exposure), Err(PointingError::Window { .. })),
            "{rate} {exposure}"
        );
    }
    assert!(exposure_of_history(&[], 1.0, 3.0).is_err());
    assert!(exposure_of_history(&[&samples, &samples[1..]], 1.0, 3.0).is_err());
    assert_eq!(
        exposure_of_table(&[[0.0, 1.0], [2.0, 1.0], [2.0, 1.0]], 1.0),
        Err(PointingError::Order { index: 2 })
    );
    assert!(exposure_of_lines(&[[1.0, f64::NAN]], 1.0).is_err());
    assert!(exposure_of_lines(&[[1.0, 1e200]], 1.0).is_err());
    assert_eq!(exposure_of_lines(&[], 0.0), Err(PointingError::Time(0.0)));
}
