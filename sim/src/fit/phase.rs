//! Phases: of the torque of the dynamic imbalance from the force of the static one, and of lines from the
//! index of the wheel.
//!
//! The force of the static imbalance turns with the wheel, and so does the torque of the dynamic one, in the
//! same record: `phase = arg(A_T / H_T) - arg(A_F / H_F)` of `h = 1` needs no index. Phases from the index,
//! `arg(A / H)` with the angle of the wheel taken off, are known for whole harmonic numbers only; of others
//! the angle of the mechanism (a bearing's cage) is a new one in each record.
//!
//! Each is a weighted mean over records. Its variance is that of the noise beside the lines, or of the scatter
//! between records where that is larger (noise that force and moment share after the moments are referred to
//! the wheel, jitter of the index), and that of `arg H` by the fitted modes.

use std::f64::consts::PI;

use nalgebra::Complex;

use super::estimate::Estimate;
use super::modes::{Mode, amplification};
use super::powers::{GroupFit, Power, Sense};
use super::rotation::Rotation;

/// Records that a phase needs.
const RECORDS_MIN: usize = 4;

/// A phase counts where its standard deviation is below 0.35 rad.
const WEIGHT_MIN: f64 = 8.0;

/// Degrees of freedom of what is known well.
const MANY: f64 = 1e6;

/// An angle with its weight.
type Weighted = (f64, f64);

/// An angle between -π and π.
#[must_use]
pub(super) fn wrapped(angle: f64) -> f64 {
    angle - 2.0 * PI * (angle / (2.0 * PI)).round()
}

fn argument(value: Complex<f64>) -> f64 {
    value.im.atan2(value.re)
}

/// The weighted mean of angles whose weights are the reciprocals of their variances: value, variance, degrees
/// of freedom. The variance is that of the weights, times the mean square of the weighted residuals where that
/// is above 1. None of too few.
fn mean(angles: &[Weighted]) -> Option<(f64, f64, f64)> {
    let sum = angles.iter().fold(Complex::new(0.0, 0.0), |sum, (angle, weight)| {
        let (sine, cosine) = precess_dynamics::Angle::sin_cos(*angle);
        sum + Complex::new(cosine, sine) * *weight
    });
    let about = argument(sum);
    // Records in which noise may turn the phase right round do not count.
    let clear = || angles.iter().filter(|(_, weight)| *weight > WEIGHT_MIN);
    let weights: f64 = clear().map(|(_, weight)| weight).sum();
    let freedom = clear().count().checked_sub(1).and_then(|n| u32::try_from(n).ok())?;
    if clear().count() < RECORDS_MIN {
        return None;
    }
    let offsets = clear().map(|(angle, weight)| weight * wrapped(angle - about));
    let centre = about + offsets.sum::<f64>() / weights;
    let squares = clear().map(|(angle, weight)| weight * wrapped(angle - centre).powi(2));
    let scale = squares.sum::<f64>() / f64::from(freedom);
    // The noise beside the lines is the mean of many bins; the scatter is that of the records.
    let freedom = if scale > 1.0 { f64::from(freedom) } else { MANY };
    Some((wrapped(centre), scale.max(1.0) / weights, freedom))
}

/// A phase that is known to less than a quarter of a turn to either side; another says nothing.
fn determined(phase: Estimate) -> Option<Estimate> {
    let half = 0.5 * (phase.interval[1] - phase.interval[0]);
    // Also not a number.
    (half < 0.5 * PI).then_some(phase)
}

fn point(fit: &GroupFit, record: usize, line: usize, sense: Sense) -> Option<&Power> {
    fit.points.iter().find(|p| p.record == record && p.line == line && p.sense == sense)
}

/// Whether a power has a phase; that of a waterfall has none.
fn has_phase(point: &Power) -> bool {
    point.amplitude.norm_sqr() > 0.0
}

/// The variance of the phase of a line in one record, by its model: 1 / (2 signal to noise).
fn variance(fit: &GroupFit, point: &Power, modes: &[Mode]) -> f64 {
    let c = fit.coefficient(point.line, point.sense);
    let gain = amplification(modes, point.frequency, point.spin).norm();
    let magnitude = c * point.spin * point.spin * gain;
    point.noise / (2.0 * magnitude * magnitude)
}

/// The angle by which the torque of a line leads its force, both turning with the wheel, rad.
#[must_use]
pub(super) fn torque_from_force(
    force: &GroupFit,
    torque: &GroupFit,
    line: usize,
) -> Option<Estimate> {
    let pairs: Vec<(&Power, &Power)> = force
        .points
        .iter()
        .filter(|p| p.line == line && p.sense == Sense::Forward && has_phase(p))
        .filter_map(|p| Some((p, point(torque, p.record, line, Sense::Forward)?)))
        .collect();
    let angles = |force_modes: &[Mode], torque_modes: &[Mode]| -> Vec<Weighted> {
        let each = pairs.iter().map(|(f, t)| {
            let h_f = amplification(force_modes, f.frequency, f.spin);
            let h_t = amplification(torque_modes, t.frequency, t.spin);
            let turned = t.amplitude / h_t * (f.amplitude / h_f).conj();
            let weight =
                1.0 / (variance(force, f, force_modes) + variance(torque, t, torque_modes));
            (argument(turned), weight)
        });
        each.filter(|(angle, weight)| angle.is_finite() && weight.is_finite()).collect()
    };
    let (own, other) = (force.shapes(), torque.shapes());
    let (value, scatter, freedom) = mean(&angles(&own, &other))?;
    let from = |found: Vec<Weighted>| mean(&found).map_or(0.0, |(a, _, _)| wrapped(a - value));
    let by_force = force.variance_of(&|modes| from(angles(modes, &other)));
    let by_torque = torque.variance_of(&|modes| from(angles(&own, modes)));
    let deviation = (scatter + by_force + by_torque).sqrt();
    determined(Estimate::new(value, deviation, freedom))
}

/// The phase of a line from the index: of `A = |A| exp(i (h theta + phase))`, rad, forward or backward; none
/// without an index, and none of a number that is not whole.
#[must_use]
pub(super) fn from_index(
    fit: &GroupFit,
    line: usize,
    sense: Sense,
    rotations: &[Rotation],
) -> Option<Estimate> {
    let points: Vec<&Power> = fit
        .points
        .iter()
        .filter(|p| p.line == line && p.sense == sense)
        .filter(|p| rotations.get(p.record).is_some_and(|rotation| rotation.indexed))
        .collect();
    let angles = |modes: &[Mode]| -> Vec<Weighted> {
        let each = points.iter().map(|p| {
            let gain = amplification(modes, p.frequency, p.spin);
            // The amplitude of what turns backward is stored as its conjugate.
            let gain = if sense == Sense::Backward { gain.conj() } else { gain };
            (argument(p.amplitude / gain), 1.0 / variance(fit, p, modes))
        });
        each.filter(|(angle, weight)| angle.is_finite() && weight.is_finite()).collect()
    };
    let (value, scatter, freedom) = mean(&angles(&fit.shapes()))?;
    let moved = |found: Vec<Weighted>| mean(&found).map_or(0.0, |(a, _, _)| wrapped(a - value));
    let by_modes = fit.variance_of(&|modes| moved(angles(modes)));
    determined(Estimate::new(value, (scatter + by_modes).sqrt(), freedom))
}
