//! Margins of a loop: gain, phase and delay, and the peak of its sensitivity.

use alloc::vec::Vec;

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
/// The longest delay looked at, in periods.
const LONGEST: f64 = 32.0;

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
        Ok(Some(self.curve()?.margins()))
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
        Ok(Some(self.curve()?.largest(LoopResponse::peak)))
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
