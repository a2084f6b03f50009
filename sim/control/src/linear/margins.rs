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
const PER_PERIOD: u32 = 8;
/// Of a part of a period: 1e-12 of the whole.
const WIDTH: f64 = 8e-12;
/// Of a step towards the middle, by the square of the interval: the interpolated place is on one side of the change after the other.
const TRUNCATION: f64 = 0.2;
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
    let held = plant.held()?;
    sampling.checked()?;
    let closed = |periods: usize, rest: f64| {
        let delay = (sampling.period, (periods, rest));
        let plant = SampledPlant::from_held(&held, &plant.c, delay)?;
        SampledLoop::new(plant, feedback.clone())
    };
    longest_delay(sampling, closed)
}

/// [`delay_margin`] of any loop by its delay, of whole periods and a rest that is less than one, s. The rest is one of eight times, again and
/// again, until the last stable delay and the first unstable one of these are known.
///
/// # Errors
///
/// Those of the loop, and [`SampledLoop::poles`].
pub fn longest_delay<E: From<ControlError>>(
    sampling: Sampling,
    mut closed: impl FnMut(usize, f64) -> Result<SampledLoop, E>,
) -> Result<Option<f64>, E> {
    let Sampling { period, delay } = sampling;
    let (periods, rest) = sampling.split();
    let part = period / f64::from(PER_PERIOD);
    // Of a delay that is longer by so many parts and a share of one.
    let mut growth = |parts: u32, share: f64| -> Result<f64, E> {
        let mut whole = periods.saturating_add(usize::try_from(parts / PER_PERIOD).unwrap_or(0));
        let mut more = rest + part * (f64::from(parts % PER_PERIOD) + share);
        if more >= period {
            whole = whole.saturating_add(1);
            more -= period;
        }
        closed(whole, more)?.growth().map_err(E::from)
    };
    let mut before = growth(0, 0.0)?;
    if before >= 0.0 {
        return Ok(Some(0.0));
    }
    let mut parts = 1_u32;
    while delay + f64::from(parts) * part <= LONGEST * period {
        let after = growth(parts, 0.0)?;
        if after >= 0.0 {
            let last = parts.saturating_sub(1);
            let share = sign_change([before, after], |share| growth(last, share))?;
            return Ok(Some(part * (f64::from(last) + share)));
        }
        before = after;
        parts = parts.saturating_add(1);
    }
    Ok(None)
}

/// The last number before a function that is negative at 0 and not at 1 changes its sign, to [`WIDTH`].
///
/// Oliveira and Takahashi, ACM Trans. Math. Softw. 47(1), 2020: interpolated, and at most one step more than by halving.
fn sign_change<E>(
    [mut first, mut last]: [f64; 2],
    mut of: impl FnMut(f64) -> Result<f64, E>,
) -> Result<f64, E> {
    let (mut low, mut high) = (0.0, 1.0);
    // What the middle of an interval may be away from, so that halving would be no faster.
    let mut radius = 0.5 * WIDTH;
    while radius < 1.0 {
        radius *= 2.0;
    }
    while high - low > WIDTH {
        let (middle, half) = (f64::midpoint(low, high), 0.5 * (high - low));
        if middle <= low || middle >= high {
            break;
        }
        let interpolated = (last * low - first * high) / (last - first);
        let to_middle = libm::copysign(1.0, middle - interpolated);
        let shift = TRUNCATION * 4.0 * half * half;
        let mut at = middle;
        if libm::fabs(middle - interpolated) >= shift {
            at = interpolated + to_middle * shift;
        }
        let reach = libm::fmax(radius - half, 0.0);
        if libm::fabs(at - middle) > reach {
            at = middle - to_middle * reach;
        }
        let found = of(at)?;
        if found < 0.0 {
            (low, first) = (at, found);
        } else {
            (high, last) = (at, found);
        }
        radius *= 0.5;
    }
    Ok(low)
}
