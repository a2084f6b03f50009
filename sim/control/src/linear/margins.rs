//! Margins of a loop: gain, phase and delay, and the peak of its sensitivity.

use alloc::vec::Vec;

use nalgebra::Complex;

use crate::linear::feedback::Feedback;
use crate::linear::plant::{Plant, SampledPlant, Sampling};
use crate::linear::sampled_loop::{LoopResponse, SampledLoop};
use crate::model::error::ControlError;

/// A number and the angular frequency at which it was found, rad/s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AtFrequency {
    /// The number.
    pub value: f64,
    /// rad/s.
    pub omega: f64,
}

/// Margins of the loop that one command sees with the others closed. They say how far a stable loop is from the point -1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxisMargins {
    /// The smallest factor above one of this command with which the loop reaches -1; none: no factor does.
    pub gain_up: Option<AtFrequency>,
    /// The largest factor below one.
    pub gain_down: Option<AtFrequency>,
    /// The smallest turn of the loop, either way, that takes it to -1, rad.
    pub phase: Option<AtFrequency>,
    /// The largest magnitude of `1 / (1 + L_i)`.
    pub sensitivity: AtFrequency,
}

/// Delays looked at in a period.
const PER_PERIOD: f64 = 8.0;
/// A loop of this magnitude at the frequency zero integrates.
const INTEGRATES: f64 = 1e9;
/// The longest delay looked at, in periods.
const LONGEST: f64 = 32.0;
/// Halvings of an interval of frequencies: to the last bit.
const HALVINGS: u32 = 80;

impl SampledLoop {
    /// Margins of each command, crossings refined to rounding between [`Self::frequencies`]; none of a loop that is not
    /// stable.
    ///
    /// # Errors
    ///
    /// As [`Self::frequencies`].
    pub fn margins(&self) -> Result<Option<Vec<AxisMargins>>, ControlError> {
        if !self.is_stable()? {
            return Ok(None);
        }
        let frequencies = self.frequencies()?;
        let responses: Vec<_> =
            frequencies.iter().filter_map(|omega| self.response(*omega)).collect();
        let axes = 0..self.plant().inputs();
        let of = |axis: usize| {
            let curve = responses.iter().filter_map(|at| Some((at.omega, at.axis(axis)?)));
            self.margins_of(axis, &curve.collect::<Vec<_>>())
        };
        Ok(Some(axes.map(of).collect()))
    }

    fn margins_of(&self, axis: usize, curve: &[(f64, Complex<f64>)]) -> AxisMargins {
        let at = |omega: f64| self.response(omega).and_then(|found| found.axis(axis));
        let mut margins = AxisMargins {
            gain_up: None,
            gain_down: None,
            phase: None,
            sensitivity: AtFrequency { value: 0.0, omega: 0.0 },
        };
        for pair in curve.windows(2) {
            let [(low, _), (high, _)] = pair else { continue };
            if let Some((omega, l)) = crossing(pair, |l| l.norm_sqr() - 1.0, &at) {
                // A jump through a pole is none.
                if libm::fabs(l.norm_sqr() - 1.0) < 1e-6 {
                    let value = libm::fabs(libm::atan2(-l.im, -l.re));
                    keep(&mut margins.phase, AtFrequency { value, omega }, |new, old| new < old);
                }
            }
            if let Some((omega, l)) = crossing(pair, |l| l.im, &at)
                && libm::fabs(l.im) <= 1e-6 * libm::fabs(l.re)
            {
                margins.add_gain(l.re, omega);
            }
            let peak = largest((*low, *high), |omega| {
                at(omega).map_or(0.0, |l| (l + 1.0).inv().norm_sqr())
            });
            if peak.value > margins.sensitivity.value {
                margins.sensitivity = peak;
            }
        }
        // At both ends the loop is real; at zero it may have a pole.
        for omega in [0.0, self.nyquist()] {
            if let Some(l) = at(omega)
                && l.norm_sqr() < INTEGRATES * INTEGRATES
            {
                margins.add_gain(l.re, omega);
            }
        }
        margins.sensitivity.value = libm::sqrt(margins.sensitivity.value);
        margins
    }

    /// The largest singular value of the sensitivity: the reciprocal of the smallest change of the whole loop, by all commands
    /// together, that takes it to the limit of stability. None of a loop that is not stable.
    ///
    /// # Errors
    ///
    /// As [`Self::frequencies`].
    pub fn peak(&self) -> Result<Option<AtFrequency>, ControlError> {
        if !self.is_stable()? {
            return Ok(None);
        }
        self.largest(LoopResponse::peak).map(Some)
    }

    /// The largest value of a function of the response over [`Self::frequencies`], each maximum between two of them refined.
    ///
    /// # Errors
    ///
    /// As [`Self::frequencies`].
    pub fn largest(&self, of: impl Fn(&LoopResponse) -> f64) -> Result<AtFrequency, ControlError> {
        let frequencies = self.frequencies()?;
        let at = |omega: f64| self.response(omega).map_or(0.0, |found| of(&found));
        let mut best = AtFrequency { value: 0.0, omega: 0.0 };
        for pair in frequencies.windows(2) {
            let [low, high] = pair else { continue };
            let found = largest((*low, *high), at);
            if found.value > best.value {
                best = found;
            }
        }
        Ok(best)
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
    at: &impl Fn(f64) -> Option<Complex<f64>>,
) -> Option<(f64, Complex<f64>)> {
    let [(low, first), (high, last)] = pair else { return None };
    let (mut low, mut high) = (*low, *high);
    let start = of(*first);
    if (start < 0.0) == (of(*last) < 0.0) {
        return None;
    }
    let mut found = (high, *last);
    for _ in 0..HALVINGS {
        let omega = f64::midpoint(low, high);
        if omega <= low || omega >= high {
            break;
        }
        let l = at(omega)?;
        if (of(l) < 0.0) == (start < 0.0) {
            low = omega;
        } else {
            high = omega;
            found = (omega, l);
        }
    }
    Some(found)
}

/// The largest value between two frequencies of a function that has one maximum there, by the golden section.
fn largest((mut low, mut high): (f64, f64), of: impl Fn(f64) -> f64) -> AtFrequency {
    const GOLDEN: f64 = 0.618_033_988_749_894_8;
    /// A maximum is flat: its place is known to the root of the last bit.
    const PARTS: u32 = 24;
    let mut ends = [(low, of(low)), (high, of(high))];
    let mut left = high - GOLDEN * (high - low);
    let mut right = low + GOLDEN * (high - low);
    let (mut of_left, mut of_right) = (of(left), of(right));
    // Monotonic as far as four points show.
    if of_left.max(of_right) <= ends[0].1.max(ends[1].1) {
        ends.sort_by(|a, b| b.1.total_cmp(&a.1));
        return AtFrequency { value: ends[0].1, omega: ends[0].0 };
    }
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

/// How much longer than it is the delay may become before the loop is unstable, s, to 1e-12 of the period; none where it may be
/// 32 periods. Zero of a loop that is unstable as it is.
///
/// Exact for delays that are no whole number of periods: the poles are computed at each.
///
/// # Errors
///
/// As [`SampledPlant::new`], [`SampledLoop::new`] and [`SampledLoop::poles`].
pub fn delay_margin(
    plant: &Plant,
    sampling: Sampling,
    feedback: &Feedback,
) -> Result<Option<f64>, ControlError> {
    let period = sampling.period;
    let closed = |delay: f64| {
        let plant = SampledPlant::new(plant, Sampling { period, delay })?;
        SampledLoop::new(plant, feedback.clone())
    };
    longest_delay(sampling, closed)
}

/// [`delay_margin`] of any loop by its delay, s.
///
/// # Errors
///
/// Those of the loop, and [`SampledLoop::poles`].
pub fn longest_delay<E: From<ControlError>>(
    sampling: Sampling,
    closed: impl Fn(f64) -> Result<SampledLoop, E>,
) -> Result<Option<f64>, E> {
    let Sampling { period, delay } = sampling;
    let stable = |delay: f64| closed(delay)?.is_stable().map_err(E::from);
    let (mut low, mut high) = (delay, delay);
    while stable(high)? {
        low = high;
        high += period / PER_PERIOD;
        if high > LONGEST * period {
            return Ok(None);
        }
    }
    while high - low > 1e-12 * period {
        let middle = f64::midpoint(low, high);
        if middle <= low || middle >= high {
            break;
        }
        if stable(middle)? {
            low = middle;
        } else {
            high = middle;
        }
    }
    Ok(Some(low - delay))
}
