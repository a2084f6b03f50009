//! [`Trial`]: the state in which laws are evaluated, and residuals and differences that they are made of.

use std::ops::{Add, Mul, Sub};

use super::law::Law;
use crate::mutation::state::{Accelerations, Case, Probe};

/// What a group of laws reads.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(in crate::mutation) enum Role {
    /// The functions of the bodies.
    Body,
    /// `first_moment`.
    FirstMoment,
    /// `eliminate` and `back_substitute`.
    Solution,
    /// `energy_momentum`.
    Momenta,
    /// `axes`.
    Axes,
    /// `loads`.
    Loads,
    /// `load_derivatives`.
    LoadDerivatives,
    /// `steer`.
    Steering,
    /// `external`.
    External,
    /// `gravity`.
    Gravity,
}

/// A residual for each of some laws.
pub(in crate::mutation) type Residuals = Vec<(Law, f64)>;

/// One state, with joint and hub accelerations that obey no law, for what must hold whatever they
/// are.
pub(in crate::mutation) struct Trial {
    pub(in crate::mutation) case: Case,
    pub(in crate::mutation) any: Accelerations,
    /// Whether some joints' accelerations are given: for what depends on that.
    pub(in crate::mutation) mixed: bool,
    pub(in crate::mutation) probe: Probe,
}

/// Whether a change in `role` can move a law that reads these.
pub(super) fn concerns(role: Option<Role>, reads: &[Role]) -> bool {
    role.is_none_or(|role| reads.contains(&role))
}

/// The residual of `a = b`. What is not a number is as wrong as can be.
pub(super) fn gap(a: &[f64], b: &[f64]) -> f64 {
    let largest = a.iter().chain(b).fold(1.0_f64, |largest, x| largest.max(x.abs()));
    let off = a.iter().zip(b).map(|(a, b)| (a - b).abs());
    let worst = off.fold(0.0, f64::max);
    let finite = a.len() == b.len() && a.iter().chain(b).all(|x| x.is_finite());
    if finite { worst / largest } else { f64::INFINITY }
}

/// Half-width of one step of a difference. The functions are sines and cosines of angles that turn
/// at up to 1.5 rad/s: at this step the ninth derivative leaves about 1e-14 of them, and rounding
/// (eps over the step) as much.
const STEP: f64 = 1.0 / 128.0;

/// The derivative of `f` at zero: central, of eighth order.
pub(in crate::mutation) fn slope<V>(f: impl Fn(f64) -> V) -> V
where
    V: Add<Output = V> + Sub<Output = V> + Mul<f64, Output = V>,
{
    let pair = |k: f64| f(k * STEP) - f(-k * STEP);
    let weights = [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0].map(|weight| weight / STEP);
    pair(1.0) * weights[0]
        + pair(2.0) * weights[1]
        + pair(3.0) * weights[2]
        + pair(4.0) * weights[3]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_slope_of_a_fast_sine_is_its_derivative() {
        let slope = slope(|t: f64| libm::sin(4.0 * t + 0.3));
        // Fourfold the rate of one angle: as the products of several angles turn.
        assert!((slope - 4.0 * libm::cos(0.3)).abs() < 1e-12);
    }

    #[test]
    fn what_is_not_a_number_is_a_gap() {
        assert_eq!(gap(&[f64::NAN], &[f64::NAN]), f64::INFINITY);
        assert_eq!(gap(&[1.0], &[]), f64::INFINITY);
        assert_eq!(gap(&[4.0, 0.0], &[4.0, 1.0]), 0.25);
    }
}
