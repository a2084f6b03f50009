//! [`LoopCurve`]: a loop over its frequencies, computed once, and what is largest or crosses between them.
//!
//! What is looked for between two frequencies is found with the plant in Hessenberg form; the value there is that of
//! [`SampledLoop::response`].

use alloc::vec::Vec;

use nalgebra::Complex;

use crate::linear::margins::{AtFrequency, AxisMargins};
use crate::linear::resolvent::Resolvent;
use crate::linear::sampled_loop::{LoopResponse, SampledLoop};
use crate::model::error::ControlError;

/// A loop of this magnitude at the frequency zero integrates.
const INTEGRATES: f64 = 1e9;
/// Halvings of an interval of frequencies: to the last bit.
const HALVINGS: u32 = 80;
/// Of the largest value at the frequencies, what may still be the largest between them: they are so dense beside a pole that a
/// resonance is within a third of its height.
const PROMISING: f64 = 0.5;
/// Parts of the golden section: 1e-6 of two intervals, of which the square counts, as a maximum is flat.
const PARTS: u32 = 30;

/// A loop over its frequencies.
#[derive(Clone, Debug)]
pub struct LoopCurve<'a> {
    of: &'a SampledLoop,
    reduced: Resolvent,
    responses: Vec<LoopResponse>,
}

impl SampledLoop {
    /// The responses at [`Self::frequencies`].
    ///
    /// # Errors
    ///
    /// As [`Self::frequencies`].
    pub fn curve(&self) -> Result<LoopCurve<'_>, ControlError> {
        let frequencies = self.frequencies()?;
        let reduced = self.plant().reduced();
        let at = |omega: &f64| self.response_reduced(&reduced, *omega);
        let responses = frequencies.iter().filter_map(at).collect();
        Ok(LoopCurve { of: self, reduced, responses })
    }
}

impl LoopCurve<'_> {
    /// By rising frequency, without those at a pole.
    #[must_use]
    pub fn responses(&self) -> &[LoopResponse] {
        &self.responses
    }

    fn near(&self, omega: f64) -> Option<LoopResponse> {
        self.of.response_reduced(&self.reduced, omega)
    }

    /// Margins of each command, crossings refined to rounding; of a loop that is stable.
    #[must_use]
    pub fn margins(&self) -> Vec<AxisMargins> {
        (0..self.of.plant().inputs()).map(|axis| self.margins_of(axis)).collect()
    }

    fn margins_of(&self, axis: usize) -> AxisMargins {
        let exact = |omega: f64| self.of.response(omega).and_then(|found| found.axis(axis));
        let near = |omega: f64| self.near(omega).and_then(|found| found.axis(axis));
        let own =
            |at: &LoopResponse| at.sensitivity.get((axis, axis)).map_or(0.0, Complex::norm_sqr);
        let sensitivity = self.largest(own);
        let mut margins = AxisMargins {
            gain_up: None,
            gain_down: None,
            phase: None,
            sensitivity: AtFrequency { value: libm::sqrt(sensitivity.value), ..sensitivity },
        };
        let curve: Vec<_> =
            self.responses.iter().filter_map(|at| Some((at.omega, at.axis(axis)?))).collect();
        for pair in curve.windows(2) {
            if let Some((omega, l)) = crossing(pair, |l| l.norm_sqr() - 1.0, &near, &exact) {
                // A jump through a pole is none.
                if libm::fabs(l.norm_sqr() - 1.0) < 1e-6 {
                    let value = libm::fabs(libm::atan2(-l.im, -l.re));
                    keep(&mut margins.phase, AtFrequency { value, omega }, |new, old| new < old);
                }
            }
            if let Some((omega, l)) = crossing(pair, |l| l.im, &near, &exact)
                && libm::fabs(l.im) <= 1e-6 * libm::fabs(l.re)
            {
                margins.add_gain(l.re, omega);
            }
        }
        // At both ends the loop is real; at zero it may have a pole.
        for omega in [0.0, self.of.nyquist()] {
            if let Some(l) = exact(omega)
                && l.norm_sqr() < INTEGRATES * INTEGRATES
            {
                margins.add_gain(l.re, omega);
            }
        }
        margins
    }

    /// The largest value of a function of the response, each maximum at the frequencies refined between their neighbours that
    /// is not below half of the largest one.
    pub fn largest(&self, of: impl Fn(&LoopResponse) -> f64) -> AtFrequency {
        let values: Vec<AtFrequency> = self
            .responses
            .iter()
            .map(|at| AtFrequency { value: of(at), omega: at.omega })
            .collect();
        let none = AtFrequency { value: 0.0, omega: 0.0 };
        let larger = |a: AtFrequency, b: AtFrequency| if b.value > a.value { b } else { a };
        let mut best = values.iter().copied().fold(none, larger);
        let least = PROMISING * best.value;
        let at = |omega: f64| self.near(omega).map_or(0.0, |found| of(&found));
        let mut refined = none;
        for (number, own) in values.iter().enumerate() {
            let before = number.checked_sub(1).and_then(|number| values.get(number)).unwrap_or(own);
            let after = values.get(number.saturating_add(1)).unwrap_or(own);
            if own.value >= least && own.value >= before.value && own.value >= after.value {
                refined = larger(refined, largest((before.omega, after.omega), at));
            }
        }
        if refined.value > best.value
            && let Some(found) = self.of.response(refined.omega)
        {
            best = larger(best, AtFrequency { value: of(&found), ..refined });
        }
        best
    }
}

impl AxisMargins {
    /// The loop crosses the real axis.
    fn add_gain(&mut self, re: f64, omega: f64) {
        if re >= 0.0 {
            return;
        }
        let found = AtFrequency { value: -re.recip(), omega };
        if found.value > 1.0 {
            keep(&mut self.gain_up, found, |new, old| new < old);
        } else {
            keep(&mut self.gain_down, found, |new, old| new > old);
        }
    }
}

/// Keeps the better of two.
fn keep(kept: &mut Option<AtFrequency>, found: AtFrequency, better: fn(f64, f64) -> bool) {
    if kept.is_none_or(|old| better(found.value, old.value)) {
        *kept = Some(found);
    }
}

/// Where a function of the loop changes its sign between two frequencies, by halving.
fn crossing(
    pair: &[(f64, Complex<f64>)],
    of: fn(Complex<f64>) -> f64,
    near: &impl Fn(f64) -> Option<Complex<f64>>,
    exact: &impl Fn(f64) -> Option<Complex<f64>>,
) -> Option<(f64, Complex<f64>)> {
    let [(low, first), (high, last)] = pair else { return None };
    let (mut low, mut high) = (*low, *high);
    let start = of(*first);
    if (start < 0.0) == (of(*last) < 0.0) {
        return None;
    }
    for _ in 0..HALVINGS {
        let omega = f64::midpoint(low, high);
        if omega <= low || omega >= high {
            break;
        }
        if (of(near(omega)?) < 0.0) == (start < 0.0) {
            low = omega;
        } else {
            high = omega;
        }
    }
    Some((high, exact(high)?))
}

/// The largest value between two frequencies of a function that has one maximum there, by the golden section.
fn largest((mut low, mut high): (f64, f64), of: impl Fn(f64) -> f64) -> AtFrequency {
    const GOLDEN: f64 = 0.618_033_988_749_894_8;
    let mut left = high - GOLDEN * (high - low);
    let mut right = low + GOLDEN * (high - low);
    let (mut of_left, mut of_right) = (of(left), of(right));
    for _ in 0..PARTS {
        if of_left > of_right {
            (high, right, of_right) = (right, left, of_left);
            left = high - GOLDEN * (high - low);
            of_left = of(left);
        } else {
            (low, left, of_left) = (left, right, of_right);
            right = low + GOLDEN * (high - low);
            of_right = of(right);
        }
    }
    if of_left > of_right {
        AtFrequency { value: of_left, omega: left }
    } else {
        AtFrequency { value: of_right, omega: right }
    }
}
