//! Modes that nobody stated: one or two for each group, where they explain the powers of the lines.
//!
//! A fit without modes is compared with fits that have one, started from the best of a grid of frequencies,
//! damping ratios and, of a radial torque, inertia ratios. A mode is kept where it lowers
//! `sum (y - m)² / var + ln var` by 25: its three parameters lower it by 3 where there is none, and a grid of
//! a hundred starts by some more. The first mode carries all that acts; it gets a share where that lowers the
//! sum as much again.

use super::error::FitError;
use super::measurement::Group;
use super::modes::{Mode, ModeGuess, amplification};
use super::powers::{GroupFit, Power, Sense, fit};

/// What a mode or a share lowers the sum by, to be kept.
const GAIN_MIN: f64 = 25.0;
/// Frequencies, damping ratios and inertia ratios of the grid.
const FREQUENCIES: u32 = 48;
const DAMPINGS: [f64; 3] = [0.005, 0.02, 0.08];
const RATIOS: [f64; 4] = [0.6, 1.0, 1.4, 1.8];
/// Fits that are started from the best of the grid.
const STARTS: usize = 3;
/// A line shows modes where its power is this many times its noise.
const SIGNAL: f64 = 10.0;
/// Modes of a group.
const MODES_MAX: usize = 2;

/// `sum (y - m)² / var + ln var`.
fn sum_of(points: &[Power], modes: &[Mode], power: &dyn Fn(&Power) -> f64) -> f64 {
    let each = points.iter().map(|point| {
        let square = point.spin * point.spin;
        let gain = amplification(modes, point.frequency, point.spin).norm_sqr();
        let m = power(point) * square * square * gain;
        let variance = point.variance(m);
        (point.power - m).powi(2) / variance + variance.ln()
    });
    each.sum()
}

fn fitted_sum(fit: &GroupFit) -> f64 {
    let power = |point: &Power| {
        let both = fit.powers.get(point.line).copied().unwrap_or_default();
        both[usize::from(point.sense == Sense::Backward)].map_or(0.0, |p| p.value)
    };
    sum_of(&fit.points, &fit.shapes(), &power)
}

/// Guesses from a grid, best first: the powers of each line by weighted least squares.
fn grid(group: Group, points: &[Power], lines: usize, others: &[ModeGuess]) -> Vec<ModeGuess> {
    let strong = points.iter().filter(|point| point.power > SIGNAL * point.noise);
    let (low, high) = strong.fold((f64::INFINITY, 0.0_f64), |(low, high), point| {
        (low.min(point.frequency.abs()), high.max(point.frequency.abs()))
    });
    let spans = low < high;
    if !spans {
        return Vec::new();
    }
    let tilts = group == Group::RadialTorque;
    let ratios: &[f64] = if tilts { &RATIOS } else { &[0.0] };
    let mut found = Vec::new();
    for k in 0..FREQUENCIES {
        let share = f64::from(k) / f64::from(FREQUENCIES - 1);
        let frequency = low * (high / low).powf(share);
        for damping in DAMPINGS {
            for ratio in ratios {
                let mode = Mode { frequency, damping, inertia_ratio: *ratio, share: 1.0 };
                let modes: Vec<Mode> =
                    others.iter().map(|guess| guess.mode).chain([mode]).collect();
                let powers = linear(points, lines, &modes);
                let power = |point: &Power| powers[place(point)];
                found.push((sum_of(points, &modes, &power), mode));
            }
        }
    }
    found.retain(|(sum, _)| sum.is_finite());
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    let guess = |mode| ModeGuess { group, mode, fit_ratio: tilts, fit_share: false };
    found.into_iter().take(STARTS).map(|(_, mode)| guess(mode)).collect()
}

fn place(point: &Power) -> usize {
    2 * point.line + usize::from(point.sense == Sense::Backward)
}

fn linear(points: &[Power], lines: usize, modes: &[Mode]) -> Vec<f64> {
    let mut sums = vec![[0.0; 2]; 2 * lines];
    for point in points {
        let square = point.spin * point.spin;
        let gain = square * square * amplification(modes, point.frequency, point.spin).norm_sqr();
        let n = point.noise;
        let weight = 1.0 / (2.0 * n * point.power.max(0.0) + n * n);
        let sum = &mut sums[place(point)];
        sum[0] += weight * gain * gain;
        sum[1] += weight * gain * point.power;
    }
    sums.into_iter().map(|[a, b]| if a > 0.0 { b / a } else { 0.0 }).collect()
}

/// Fits a group with as many modes as its lines show.
///
/// # Errors
/// Those of the fit without modes.
pub(super) fn search(group: Group, lines: usize, points: &[Power]) -> Result<GroupFit, FitError> {
    let mut best = fit(group, lines, points.to_vec(), &[])?;
    let mut sum = fitted_sum(&best);
    let mut guesses: Vec<ModeGuess> = Vec::new();
    while guesses.len() < MODES_MAX {
        let mut better: Option<(f64, GroupFit, Vec<ModeGuess>)> = None;
        for start in grid(group, points, lines, &guesses) {
            // Of two modes neither carries all.
            let shares: &[bool] = if guesses.is_empty() { &[false, true] } else { &[true] };
            for share in shares {
                let mut trial: Vec<ModeGuess> = guesses.iter().copied().chain([start]).collect();
                for guess in &mut trial {
                    guess.fit_share = *share;
                }
                let Ok(found) = fit(group, lines, points.to_vec(), &trial) else { continue };
                let next = fitted_sum(&found);
                let bound = match &better {
                    None => sum - GAIN_MIN,
                    Some((least, _, of)) if *share && !of.iter().any(|g| g.fit_share) => {
                        least - GAIN_MIN
                    }
                    Some((least, ..)) => *least,
                };
                if next < bound && sensible(&found) {
                    for (guess, mode) in trial.iter_mut().zip(found.shapes()) {
                        guess.mode = mode;
                    }
                    better = Some((next, found, trial));
                }
            }
        }
        let Some((least, found, trial)) = better else { break };
        (sum, best, guesses) = (least, found, trial);
    }
    Ok(best)
}

/// Whether the modes are at frequencies that the lines cross, with intervals that are not all of them.
fn sensible(fit: &GroupFit) -> bool {
    let highest = fit.points.iter().map(|p| p.frequency.abs()).fold(0.0, f64::max);
    fit.modes.iter().all(|mode| {
        mode.mode.frequency < 2.0 * highest
            && mode.frequency.deviation < 0.2 * mode.frequency.value
            && mode.mode.share > 3.0 * mode.share.deviation
    })
}

#[cfg(test)]
mod tests {
    use nalgebra::Complex;

    use super::*;

    /// Speeds, rad/s, with power and noise, N² m², of h = 1 forward and backward and of h = 2 likewise: a wheel with
    /// `U_d = 2e-9 kg m²` and no mode. In the second record pure noise is 6.6 times its mean at h = 2.
    #[rustfmt::skip]
    const POWERS: [(f64, [(f64, f64); 4]); 10] = [
        (104.71376, [(4.80839e-10, 2.36337e-12), (-1.06035e-12, 2.04149e-12), (-1.36219e-12, 2.58502e-12), (-3.35135e-13, 2.16158e-12)]),
        (158.25353, [(2.53527e-9, 2.33758e-12), (-5.21806e-13, 2.11822e-12), (1.30292e-11, 1.95984e-12), (-1.45662e-12, 2.25031e-12)]),
        (211.80318, [(8.18715e-9, 2.22279e-12), (-2.17885e-12, 2.21032e-12), (-2.25612e-12, 3.05912e-12), (-8.16214e-13, 1.85076e-12)]),
        (265.27853, [(1.95843e-8, 2.31105e-12), (-1.42238e-12, 2.06871e-12), (1.25297e-12, 2.59727e-12), (-1.52332e-12, 2.09111e-12)]),
        (318.77184, [(4.11151e-8, 2.08713e-12), (-1.24762e-12, 1.97358e-12), (4.56332e-13, 2.22717e-12), (-1.56942e-12, 1.84414e-12)]),
        (372.34899, [(7.69160e-8, 1.73557e-12), (-1.63777e-12, 1.84723e-12), (2.64122e-12, 1.63001e-12), (1.29834e-12, 2.25027e-12)]),
        (425.90778, [(1.30968e-7, 1.66463e-12), (6.83516e-13, 2.06820e-12), (-1.42099e-12, 2.44432e-12), (-8.52403e-13, 1.90076e-12)]),
        (479.41018, [(2.10809e-7, 1.60832e-12), (4.53004e-13, 2.08799e-12), (-1.97443e-12, 2.42960e-12), (-8.48571e-13, 1.71223e-12)]),
        (532.91609, [(3.22144e-7, 1.81353e-12), (-1.63405e-12, 2.11434e-12), (-1.44406e-12, 2.25955e-12), (-8.40228e-14, 1.79859e-12)]),
        (586.46755, [(4.72966e-7, 1.79589e-12), (1.83390e-12, 1.97878e-12), (-4.09515e-13, 2.30994e-12), (-9.56889e-13, 1.70030e-12)]),
    ];
    /// Bins of the noise.
    const BINS: [f64; 2] = [80.0, 29.8];

    fn points() -> Vec<Power> {
        let mut points = Vec::new();
        for (record, (spin, powers)) in POWERS.into_iter().enumerate() {
            for (place, (power, noise)) in powers.into_iter().enumerate() {
                let (line, sense) =
                    (place / 2, if place % 2 == 0 { Sense::Forward } else { Sense::Backward });
                let order = if line == 0 { spin } else { 2.0 * spin };
                points.push(Power {
                    record,
                    line,
                    sense,
                    spin,
                    frequency: if sense == Sense::Forward { order } else { -order },
                    power,
                    noise,
                    bins: BINS[line],
                    segments: 1.0,
                    amplitude: Complex::new(0.0, 0.0),
                });
            }
        }
        points
    }

    #[test]
    fn noise_of_one_record_is_no_mode() {
        let found = search(Group::RadialTorque, 2, &points()).expect("a fit without modes");
        assert!(found.modes.is_empty(), "{:?}", found.modes);
        let u_d = found.coefficient(0, Sense::Forward);
        assert!((u_d / 2e-9 - 1.0).abs() < 0.01, "{u_d}");
    }

    #[test]
    fn a_stated_mode_that_no_line_shows_is_an_error() {
        let mode = Mode { frequency: 216.0, damping: 0.02, inertia_ratio: 1.0, share: 1.0 };
        for (fit_ratio, fit_share) in [(true, false), (false, false), (false, true)] {
            let guess = ModeGuess { group: Group::RadialTorque, mode, fit_ratio, fit_share };
            let found = fit(Group::RadialTorque, 2, points(), &[guess]);
            let Ok(found) = found else { continue };
            // What is reported is known: ends of intervals are finite, and not zero.
            for of in found.modes.iter().flat_map(|mode| [mode.frequency, mode.damping]) {
                assert!(of.interval[0] > 0.0 && of.interval[1] < 100.0 * of.interval[0], "{of:?}");
            }
        }
    }
}
