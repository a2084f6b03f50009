//! Known lines, known noise, Parseval's theorem, orders of a known sweep, and inputs that are rejected.

use std::f64::consts::{PI, TAU};

use super::synthetic::{Random, tone};
use super::{
    Detrend, OrderSettings, SpectrumError, WelchSettings, Window, amplitude_spectrum,
    cross_spectra, psd, track_orders,
};

/// Sums of thousands of squares, rounded: Parseval's theorem.
const PARSEVAL: f64 = 1e-12;
/// Leakage of a negative frequency into a line far from zero.
const IMAGE: f64 = 1e-4;
const SEED: u64 = 20_260_117;

#[test]
fn parseval_holds_for_a_rectangular_window_without_overlap_and_detrending() {
    let noise = Random::new(SEED).first_order(8192, 1.0, 20.0);
    let samples: Vec<f64> = noise.iter().map(|x| 3.0 + x).collect();
    let mean_square = samples.iter().map(|x| x * x).sum::<f64>() / 8192.0;
    for length in [8192, 1024, 64] {
        let found = psd(&samples, 250.0, &WelchSettings::rectangular(length)).expect("a density");
        assert_eq!((found.metadata.unused, found.metadata.segments), (0, 8192 / length));
        assert!((found.mean_square() / mean_square - 1.0).abs() < PARSEVAL, "{length}");
        let last = found.cumulative_rms_forward().pop().expect("bins");
        let first = found.cumulative_rms_backward()[0];
        let band = found.band_rms([0.0, 125.0]).expect("a band");
        // Bands split bins, so their squares add up wherever they meet.
        let [low, high] = [[0.0, 31.3], [31.3, 125.0]].map(|band| found.band_rms(band));
        let parts = low.expect("a band").hypot(high.expect("a band"));
        for rms in [last, first, band, parts] {
            assert!((rms * rms / mean_square - 1.0).abs() < PARSEVAL, "{rms}");
        }
    }
    // An odd length has no bin at half the rate.
    let odd = psd(&samples[..8181], 250.0, &WelchSettings::rectangular(909)).expect("a density");
    let mean_square = samples[..8181].iter().map(|x| x * x).sum::<f64>() / 8181.0;
    assert!((odd.mean_square() / mean_square - 1.0).abs() < PARSEVAL);
}

#[test]
fn forward_and_backward_squares_add_up_to_all_and_the_bin() {
    let samples = Random::new(SEED).white(1000);
    let found = psd(&samples, 10.0, &WelchSettings::hann(200)).expect("a density");
    let (forward, backward) = (found.cumulative_rms_forward(), found.cumulative_rms_backward());
    for (bin, (a, b)) in forward.iter().zip(&backward).enumerate() {
        let own = found.density[bin] * found.metadata.resolution;
        let sum = a * a + b * b - own;
        assert!((sum / found.mean_square() - 1.0).abs() < PARSEVAL, "{bin}");
    }
}

#[test]
fn lines_between_bins_have_their_frequency_and_amplitude() {
    // Bins of 0.5 Hz: on one, between, and near the middle of two.
    for (frequency, amplitude) in [(40.0, 2.0), (63.17, 0.3), (101.76, 5.0)] {
        let samples = tone(8000, 1000.0, [frequency, amplitude, 0.4]);
        for (window, of_frequency, of_amplitude) in [
            // The neighbour's ratio is exact but for the negative frequency, which decays as 1/k here.
            (Window::Rectangular, 0.01, 0.01),
            (Window::Hann, IMAGE, IMAGE),
            (Window::FlatTop, 1e-3, 2e-3),
        ] {
            let settings =
                WelchSettings { window, length: 2000, overlap: 1000, detrend: Detrend::None };
            let found = amplitude_spectrum(&samples, 1000.0, &settings).expect("amplitudes");
            let lines = found.strongest(5);
            assert_eq!(lines.len(), 1, "{window:?} {frequency}: {lines:?}");
            let off = (lines[0].frequency - frequency).abs() / found.metadata.resolution;
            assert!(off < of_frequency, "{window:?} {frequency}: {off} bins");
            let off = (lines[0].amplitude / amplitude - 1.0).abs();
            assert!(off < of_amplitude, "{window:?} {frequency}: {off}");
        }
    }
}

#[test]
fn the_mean_square_of_a_line_is_its_peak_density_times_the_noise_bandwidth() {
    let samples = tone(4096, 512.0, [64.0, 3.0, 1.0]);
    for window in [Window::Rectangular, Window::Hann, Window::FlatTop] {
        let settings = WelchSettings { window, length: 512, overlap: 0, detrend: Detrend::None };
        let found = psd(&samples, 512.0, &settings).expect("a density");
        let mean_square = found.density[64] * found.metadata.noise_bandwidth;
        assert!((mean_square / 4.5 - 1.0).abs() < PARSEVAL, "{window:?}");
    }
}

#[test]
fn lines_stand_out_of_noise_and_noise_does_not() {
    let mut samples = Random::new(SEED).white(40_000);
    let found = |samples: &[f64]| {
        let settings = WelchSettings::hann(2000);
        amplitude_spectrum(samples, 1000.0, &settings).expect("amplitudes").strongest(10)
    };
    assert_eq!(found(&samples), []);
    for line in [[50.0, 1.0, 0.0], [57.3, 0.5, 1.0]] {
        samples.iter_mut().zip(tone(40_000, 1000.0, line)).for_each(|(x, tone)| *x += tone);
    }
    let lines = found(&samples);
    assert_eq!(lines.len(), 2, "{lines:?}");
    // The noise in a line's bins: sqrt(2 * 1.5 bins * 2/1000 unit^2/Hz * 0.5 Hz / 39 averages), 5 standard deviations.
    for (line, (frequency, amplitude)) in lines.iter().zip([(50.0, 1.0), (57.3, 0.5)]) {
        assert!((line.frequency - frequency).abs() < 0.05, "{line:?}");
        assert!((line.amplitude - amplitude).abs() < 0.05, "{line:?}");
    }
}

#[test]
fn white_and_filtered_noise_lie_within_their_intervals_as_often_as_stated() {
    let (rate, count) = (100.0, 200_000);
    let mut random = Random::new(SEED);
    // The density of a sampled first-order process, (1 - a^2) / |1 - a exp(-j w)|^2, a = exp(-step / tau).
    let decay = (-1.0_f64 / 5.0).exp();
    let filtered = |frequency: f64| {
        let angle = TAU * frequency / rate;
        2.0 / rate * (1.0 - decay * decay) / (1.0 - 2.0 * decay * angle.cos() + decay * decay)
    };
    let white = |_: f64| 2.0 / rate;
    let records = [random.white(count), random.first_order(count, 1.0, 5.0)];
    let densities: [&dyn Fn(f64) -> f64; 2] = [&white, &filtered];
    for (samples, density) in records.iter().zip(densities) {
        let found = psd(samples, rate, &WelchSettings::hann(1000)).expect("a density");
        let (mut inside, mut all) = (0.0, 0.0);
        // Every third bin: Hann's neighbours are correlated.
        for (bin, (frequency, value)) in found.iter().enumerate().skip(3).step_by(3) {
            let [low, high] = found.interval(bin, 0.9).expect("an interval");
            let truth = density(frequency);
            inside += f64::from(u8::from(low * value <= truth && truth <= high * value));
            all += 1.0;
        }
        // Of 166 bins 90 %, with a standard deviation of 2.3 %: three of them.
        let share: f64 = inside / all;
        assert!((share - 0.9).abs() < 0.07, "{share}");
    }
}

#[test]
fn the_matrix_is_hermitian_with_the_coherence_of_a_delayed_signal_in_noise() {
    let mut random = Random::new(SEED);
    let source = random.white(100_004);
    let (x, delayed) = (&source[4..], &source[..100_000]);
    // Half of the power is noise of its own: the coherence is one half.
    let y: Vec<f64> = delayed.iter().map(|s| s + random.normal()).collect();
    let z = random.white(100_000);
    let cross = cross_spectra(&[x, &y, &z], 1.0, &WelchSettings::hann(500)).expect("spectra");
    for bin in 0..cross.metadata.bins() {
        let matrix = cross.at(bin).expect("a bin");
        assert_eq!(matrix, matrix.adjoint());
    }
    let mean = |values: Vec<f64>| values.iter().sum::<f64>() / 251.0;
    // Its standard deviation at a bin is sqrt(2) (1 - 1/2) sqrt(1/2) / sqrt(378), 2.6 %; of the mean of 84
    // independent bins 0.3 %: three of them, and the bias of the estimate, 0.1 %.
    let coherence = mean(cross.coherence(0, 1).expect("averages"));
    assert!((coherence - 0.5).abs() < 0.01, "{coherence}");
    // One by the number of averages.
    let none = mean(cross.coherence(0, 2).expect("averages"));
    assert!((none * cross.metadata.averages - 1.0).abs() < 0.3, "{none}");
    // Four samples late: -2 pi f 4; a standard deviation of 0.05 rad at a bin.
    let between = cross.between(0, 1).expect("two signals");
    for (bin, value) in between.iter().enumerate().skip(1).take(249) {
        let expected = -TAU * cross.metadata.frequency(bin) * 4.0;
        let off = (value.arg() - expected).rem_euclid(TAU);
        assert!(off.min(TAU - off) < 0.25, "{bin}: {off}");
    }
    let one = cross_spectra(&[x, &y], 1.0, &WelchSettings::hann(100_000)).expect("spectra");
    assert_eq!(one.coherence(0, 1), Err(SpectrumError::Averages(1.0)));
}

#[test]
fn a_line_is_removed_by_the_linear_trend_and_a_constant_by_the_mean() {
    let samples: Vec<f64> = (0..512).map(|i| 4.0 + 0.25 * f64::from(i)).collect();
    let of = |detrend| {
        let settings = WelchSettings { window: Window::Hann, length: 128, overlap: 64, detrend };
        psd(&samples, 1.0, &settings).expect("a density").mean_square()
    };
    assert!(of(Detrend::Linear) < 1e-24);
    assert!(of(Detrend::Mean) > 1.0 && of(Detrend::None) > of(Detrend::Mean));
}

#[test]
fn a_drift_is_no_line() {
    let samples: Vec<f64> =
        (0..8000).map(|i| f64::from(i) / 8000.0 + 1e-3 * (0.3 * f64::from(i)).sin()).collect();
    for window in [Window::Hann, Window::FlatTop] {
        let settings = WelchSettings { window, length: 1000, overlap: 500, detrend: Detrend::Mean };
        let found = amplitude_spectrum(&samples, 1000.0, &settings).expect("amplitudes");
        let lines = found.strongest(5);
        assert_eq!(lines.len(), 1, "{window:?}: {lines:?}");
        assert!((lines[0].frequency - 1000.0 * 0.3 / TAU).abs() < 0.1, "{lines:?}");
    }
}

#[test]
fn orders_of_a_sweep_have_their_amplitudes_and_phases() {
    // From 20 to 80 Hz in 20 s; orders 1, 1.02 (a cage beside it, one beat in 50 turns) and 5.6.
    let (rate, count) = (2000.0, 40_000);
    let time = |i: usize| super::float(i) / rate;
    let theta: Vec<f64> =
        (0..count).map(|i| TAU * (20.0 * time(i) + 0.5 * 3.0 * time(i) * time(i))).collect();
    let truth = [(1.0, 2.0, 0.3), (1.02, 0.5, -2.0), (5.6, 0.1, 1.5)];
    let mut random = Random::new(SEED);
    let signal: Vec<f64> = theta
        .iter()
        .map(|theta| {
            let of = |(order, amplitude, phase): &(f64, f64, f64)| {
                amplitude * (order * theta + phase).cos()
            };
            7.0 + truth.iter().map(of).sum::<f64>() + 0.05 * random.normal()
        })
        .collect();
    let settings =
        OrderSettings { orders: truth.map(|(order, ..)| order).to_vec(), length: 8000, hop: 8000 };
    let windows = track_orders(&signal, &theta, rate, &settings).expect("orders");
    assert_eq!(windows.len(), 5);
    for window in &windows {
        let middle = time(window.start) + 0.5 * 7999.0 / rate;
        assert!((window.rate / (TAU * (20.0 + 3.0 * middle)) - 1.0).abs() < 1e-12);
        // Five standard deviations of the noise, 0.05 sqrt(2 / 8000); the near pair has 1.5 of them.
        for (found, (order, amplitude, phase)) in window.orders.iter().zip(truth) {
            let near = |off: f64, within: f64| assert!(off.abs() < within, "{order}: {found:?}");
            near(found.amplitude - amplitude, 6e-3);
            near(found.phase - phase, 6e-3 / amplitude);
        }
        assert!((window.residual - 0.05).abs() < 2e-3 && (window.mean - 7.0).abs() < 5e-3);
    }
    let near = OrderSettings { orders: vec![1.0, 1.0 + 1e-12], ..settings };
    let rejected = track_orders(&signal, &theta, rate, &near).expect_err("dependent");
    assert!(matches!(rejected, SpectrumError::Dependent { start: 0, .. }), "{rejected}");
}

#[test]
fn what_cannot_be_computed_is_rejected_with_its_place() {
    let samples = [0.0, 1.0, f64::NAN, 3.0, 1.0, 2.0, 0.0, 5.0];
    let settings = WelchSettings::hann(8);
    let of =
        |samples: &[f64], rate, settings: &WelchSettings| psd(samples, rate, settings).map(|_| ());
    let found = of(&samples, 1.0, &settings).expect_err("a sample");
    assert_eq!(found.to_string(), "sample 2 of signal 0 is NaN; spectra need finite samples");
    let fine = [1.0, -1.0, 2.0, 0.0, 1.0, 1.0, 3.0, 0.0];
    assert_eq!(of(&fine, 0.0, &settings), Err(SpectrumError::Rate(0.0)));
    for length in [0, 3, 9, usize::MAX] {
        let settings = WelchSettings { length, overlap: 0, ..settings };
        assert!(matches!(of(&fine, 1.0, &settings), Err(SpectrumError::Segment { .. })));
    }
    let overlap = WelchSettings { overlap: 8, ..settings };
    assert_eq!(of(&fine, 1.0, &overlap), Err(SpectrumError::Overlap { overlap: 8, length: 8 }));
    assert!(of(&[f64::MAX; 8], 1.0, &WelchSettings::rectangular(8)).is_err());
    let found = psd(&fine, 1.0, &settings).expect("a density");
    for band in [[0.2, 0.1], [0.0, 0.6], [f64::NAN, 0.4], [-0.1, 0.3]] {
        assert!(matches!(found.band_rms(band), Err(SpectrumError::Band { .. })));
    }
    assert!(found.interval(1, PI).is_err());
    let short = cross_spectra(&[&fine, &fine[..7]], 1.0, &settings).expect_err("lengths");
    assert_eq!(short, SpectrumError::Lengths { signal: 1, expected: 8, found: 7 });
}
