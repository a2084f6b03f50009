//! Frequencies of a curve that shows resonances: between them logarithmic, near a pole as dense as it is narrow.

use alloc::vec::Vec;
use core::f64::consts::PI;

use nalgebra::Complex;

/// Points in all, away from poles.
const POINTS: u32 = 400;
/// Decades below the frequency of Nyquist.
const DECADES: f64 = 5.0;
/// Points on each side of a pole.
const BESIDE: u32 = 24;
/// From this part of a pole's distance from the unit circle to that.
const NEAR: (f64, f64) = (0.03, 100.0);

/// A pole this near to 1 is one of the plant's integrators: at the lowest frequencies it is no resonance.
const INTEGRATOR: f64 = 1e-6;

/// Up to the frequency of Nyquist, rad/s, rising.
pub(super) fn all(period: f64, poles: impl Iterator<Item = Complex<f64>>) -> Vec<f64> {
    let along = |number: u32, count: u32| f64::from(number) / f64::from(count);
    let mut angles: Vec<f64> = (0..=POINTS)
        .map(|number| PI * libm::pow(10.0, DECADES * (along(number, POINTS) - 1.0)))
        .collect();
    let lowest = PI * libm::pow(10.0, -DECADES);
    for pole in poles.filter(|pole| (pole - 1.0).norm_sqr() > INTEGRATOR * INTEGRATOR) {
        let angle = libm::fabs(libm::atan2(pole.im, pole.re));
        // A pole on the circle would make it infinitely narrow.
        let width = libm::fmax(libm::fabs(1.0 - libm::hypot(pole.re, pole.im)), 1e-9);
        for number in 0..=BESIDE {
            let away = width * NEAR.0 * libm::pow(NEAR.1 / NEAR.0, along(number, BESIDE));
            angles.extend([angle - away, angle + away]);
        }
        angles.push(angle);
    }
    angles.retain(|angle| *angle >= lowest && *angle <= PI);
    angles.sort_by(f64::total_cmp);
    angles.dedup();
    angles.into_iter().map(|angle| angle / period).collect()
}
