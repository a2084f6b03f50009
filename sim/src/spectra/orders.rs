//! [`track_orders`]: amplitude and phase of orders of a rotating machine against its phase.
//!
//! In each window of samples all orders are fitted at once by least squares,
//! `x = c + sum_h a_h cos(h theta) + b_h sin(h theta)`, over the phase `theta(t)` of a tachometer or of the wheel's own
//! coordinate. So the speed may vary within a window, orders that are close are separated, and no resampling is
//! needed; it is neither Vold and Kalman's filter nor a demodulation by a low pass. Amplitudes are taken as constant
//! within a window.

use nalgebra::{DMatrix, DVector};
use precess_dynamics::Angle;

use super::density::check_samples;
use super::{SpectrumError, float};

/// Numbers of the matrix of a fit, at most: 128 MiB.
const NUMBERS_MAX: usize = 1 << 24;
/// The triangular factor's diagonal spans at most this: what is nearly dependent loses half the digits.
const RATIO_MIN: f64 = 1e-6;

/// Orders and windows.
#[derive(Clone, Debug, PartialEq)]
pub struct OrderSettings {
    /// Multiples of the phase, not necessarily whole: 1 is imbalance.
    pub orders: Vec<f64>,
    /// Samples of a window.
    pub length: usize,
    /// Samples from one window to the next.
    pub hop: usize,
}

/// The orders in one window.
#[derive(Clone, Debug, PartialEq)]
pub struct OrderWindow {
    /// Its first sample.
    pub start: usize,
    /// Mean rate of the phase over the window, rad/s.
    pub rate: f64,
    /// The constant c, unit.
    pub mean: f64,
    /// In the order of the settings.
    pub orders: Vec<Order>,
    /// RMS of what the fit leaves, unit.
    pub residual: f64,
}

/// One order in one window: `amplitude cos(order theta + phase)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Order {
    /// The multiple of the phase.
    pub order: f64,
    /// Unit of the signal, not negative.
    pub amplitude: f64,
    /// rad, from -pi to pi.
    pub phase: f64,
}

/// Orders of a signal at a rate, 1/s, against a phase, rad, sample by sample and without jumps of a turn.
///
/// # Errors
///
/// Settings, a sample or phase that is not finite, or orders that a window cannot separate.
pub fn track_orders(
    samples: &[f64],
    phase: &[f64],
    rate: f64,
    settings: &OrderSettings,
) -> Result<Vec<OrderWindow>, SpectrumError> {
    let OrderSettings { orders, length, hop } = settings;
    let (length, hop) = (*length, (*hop).max(1));
    if !(rate.is_finite() && rate > 0.0) {
        return Err(SpectrumError::Rate(rate));
    }
    if phase.len() != samples.len() {
        let (expected, found) = (samples.len(), phase.len());
        return Err(SpectrumError::Lengths { signal: 1, expected, found });
    }
    if let Some(order) = orders.iter().find(|order| !(order.is_finite() && **order > 0.0)) {
        return Err(SpectrumError::Order(*order));
    }
    let columns = 1 + 2 * orders.len();
    let bounds = [columns + 1, samples.len()];
    if !(bounds[0]..=bounds[1]).contains(&length) {
        return Err(SpectrumError::Segment { length, bounds });
    }
    let numbers = columns.saturating_mul(length);
    if numbers > NUMBERS_MAX {
        return Err(SpectrumError::Size { numbers, most: NUMBERS_MAX });
    }
    check_samples(0, samples)?;
    check_samples(1, phase)?;
    let pairs = samples.windows(length).zip(phase.windows(length)).enumerate().step_by(hop);
    pairs.map(|(start, (samples, phase))| fit(start, samples, phase, rate, orders)).collect()
}

/// The fit of one window.
fn fit(
    start: usize,
    samples: &[f64],
    phase: &[f64],
    rate: f64,
    orders: &[f64],
) -> Result<OrderWindow, SpectrumError> {
    let length = samples.len();
    let mut matrix = DMatrix::zeros(length, 1 + 2 * orders.len());
    matrix.column_mut(0).fill(1.0);
    for (k, order) in orders.iter().enumerate() {
        for (row, theta) in phase.iter().enumerate() {
            let (sine, cosine) = Angle::sin_cos(order * theta);
            matrix[(row, 1 + 2 * k)] = cosine;
            matrix[(row, 2 + 2 * k)] = sine;
        }
    }
    let values = DVector::from_column_slice(samples);
    let factors = matrix.clone().qr();
    let r = factors.r();
    let diagonal = || r.diagonal().iter().map(|d| d.abs()).collect::<Vec<_>>();
    let least = diagonal().into_iter().fold(f64::INFINITY, f64::min);
    let ratio = least / diagonal().into_iter().fold(0.0, f64::max);
    let dependent = SpectrumError::Dependent { start, ratio, bound: RATIO_MIN };
    if ratio.is_nan() || ratio < RATIO_MIN {
        return Err(dependent);
    }
    let mut projected = values.clone();
    factors.q_tr_mul(&mut projected);
    let right = projected.rows(0, matrix.ncols()).into_owned();
    let solution = r.solve_upper_triangular(&right).ok_or(dependent)?;
    let residual = (values - matrix * &solution).norm() / float(length).sqrt();
    let coefficients = solution.as_slice();
    let (mean, pairs) = coefficients.split_first().map_or((0.0, &[][..]), |(c, rest)| (*c, rest));
    let orders = orders.iter().zip(pairs.chunks_exact(2)).map(|(order, pair)| {
        let [a, b] = [pair.first(), pair.get(1)].map(|value| value.copied().unwrap_or_default());
        // a = A cos(phase), b = -A sin(phase).
        Order { order: *order, amplitude: a.hypot(b), phase: (-b).atan2(a) }
    });
    let ends = phase.first().zip(phase.last()).map_or(0.0, |(first, last)| last - first);
    let window = OrderWindow {
        start,
        rate: ends * rate / (float(length) - 1.0),
        mean,
        orders: orders.collect(),
        residual,
    };
    super::density::finite(&[window.mean, window.residual, window.rate])?;
    Ok(window)
}
