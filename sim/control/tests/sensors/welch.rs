//! One-sided power spectral density by Welch's method, without overlap, with Hann's window.

use std::f64::consts::TAU;

/// Densities at the frequencies `k rate / length`, k from 1 to below `length / 2`. The length is a power of two.
pub(crate) fn density(signal: &[f64], length: usize, rate: f64) -> Vec<f64> {
    let position = |k: usize| f64::from(u32::try_from(k).unwrap());
    let window: Vec<f64> =
        (0..length).map(|k| 0.5 - 0.5 * libm::cos(TAU * position(k) / position(length))).collect();
    let squares: f64 = window.iter().map(|w| w * w).sum();
    let mut sum = vec![0.0; length / 2];
    let segments = signal.chunks_exact(length);
    let count = position(segments.len());
    for segment in segments {
        let mut values: Vec<(f64, f64)> =
            segment.iter().zip(&window).map(|(x, w)| (x * w, 0.0)).collect();
        transform(&mut values);
        for (sum, (re, im)) in sum.iter_mut().zip(&values) {
            *sum += re * re + im * im;
        }
    }
    sum.iter().skip(1).map(|sum| 2.0 * sum / (count * rate * squares)).collect()
}

/// Cooley and Tukey, by halves.
fn transform(values: &mut [(f64, f64)]) {
    let count = values.len();
    if count == 1 {
        return;
    }
    let mut even: Vec<_> = values.iter().step_by(2).copied().collect();
    let mut odd: Vec<_> = values.iter().skip(1).step_by(2).copied().collect();
    transform(&mut even);
    transform(&mut odd);
    let half = count / 2;
    let step = TAU / f64::from(u32::try_from(count).unwrap());
    for k in 0..half {
        let (sin, cos) = libm::sincos(-step * f64::from(u32::try_from(k).unwrap()));
        let (re, im) = odd[k];
        let turned = (re * cos - im * sin, re * sin + im * cos);
        values[k] = (even[k].0 + turned.0, even[k].1 + turned.1);
        values[k + half] = (even[k].0 - turned.0, even[k].1 - turned.1);
    }
}

/// A sine of amplitude 2 has the mean square 2 in its bins.
#[test]
fn a_sine_has_its_mean_square() {
    let signal: Vec<f64> =
        (0..1024).map(|k| 2.0 * libm::sin(TAU * 16.0 * f64::from(k) / 256.0)).collect();
    let found = density(&signal, 256, 10.0);
    let total: f64 = found.iter().sum::<f64>() * 10.0 / 256.0;
    assert!((total - 2.0).abs() < 1e-12, "{total}");
    assert!(found[15] > 10.0 * found[19]);
}
