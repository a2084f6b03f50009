//! [`search`]: the passages of functions of time within a step.

use precess_dynamics::Attitude;

use super::motors::MotorChange;
use super::roots::bracket;
use super::{EventKind, StepEvent};
use crate::engine::equations::packing::Layout;
use crate::engine::equations::system::System;
use crate::engine::integration::{Moment, Stepper};
use crate::engine::quantities::joint_torques::TorquesOnce;
use crate::record::RunError;
use crate::record::columns::Quantity;

/// Width of the bracket of a passage, s.
const WIDTH: f64 = 1e-12;
/// The same in roundings of the time.
const ROUNDINGS: f64 = 4.0;
/// Intervals of a step that are searched.
const INTERVALS: u32 = 4;
/// Part of an interval to which an extremum is found, and over which the slope of a function of friction is taken.
const SHARE: f64 = 1e-3;
/// Halvings of an interval in search of a time shortly after its start.
const HALVINGS: i32 = 40;

/// A function whose sign changes at a passage: above zero within a stop, while a joint slides,
/// while it sticks, and before a motor's change.
#[derive(Clone, Copy)]
pub(super) struct Function {
    pub(super) of: FunctionOf,
    pub(super) what: EventKind,
}

/// What a function is of.
#[derive(Clone, Copy)]
pub(super) enum FunctionOf {
    /// `sign (quantity - value)`.
    State { quantity: Quantity, value: f64, sign: f64 },
    /// A joint's static friction less the size of what holds it.
    Slack { joint: usize, static_friction: f64 },
    /// How far a motor is from a change.
    Motor(MotorChange),
}

impl Function {
    /// Its value at the time of a moment.
    fn at(
        &self,
        system: &System<'_>,
        stepper: &Stepper,
        time: f64,
        moment: &Moment,
        torques: &mut TorquesOnce,
    ) -> Result<f64, RunError> {
        match self.of {
            FunctionOf::State { quantity, value, sign } => {
                Ok(sign * (state_value(stepper, moment, quantity) - value))
            }
            FunctionOf::Motor(change) => change.distance(system, time, &moment.state, torques),
            FunctionOf::Slack { joint, static_friction } => {
                let [_, held] = torques.of(system, time, &moment.state, joint)?;
                Ok(static_friction - held.abs())
            }
        }
    }

    /// Its rate where it is of a stop, whose extrema are searched by it; zero of others.
    fn rate(&self, stepper: &Stepper, moment: &Moment) -> f64 {
        match (self.what, self.of) {
            (EventKind::Stop { joint, .. }, FunctionOf::State { sign, .. }) => {
                sign * Layout::joint(joint, &moment.state, stepper.turns())[1]
            }
            _ => 0.0,
        }
    }

    /// Whether it may be zero at the start of a segment, but for rounding, and is searched for extrema by its values.
    fn starts_at_zero(&self) -> bool {
        matches!(
            self.what,
            EventKind::Rest { .. } | EventKind::Release { .. } | EventKind::Motor(_)
        )
    }

    /// Whether a passage lies between two values: out of a stop, or through a value either way.
    fn passes(&self, [from, to]: [f64; 2]) -> bool {
        match self.what {
            EventKind::Crossing { .. } => (from < 0.0 && to >= 0.0) || (from > 0.0 && to <= 0.0),
            _ => to < 0.0 && to < from,
        }
    }
}

/// Both ends of an interval, with value and rate of a function there, and its values close to both within it.
#[derive(Clone, Copy)]
struct Interval {
    span: [f64; 2],
    values: [f64; 2],
    rates: [f64; 2],
    inner: Option<[f64; 2]>,
}

/// Searches the last step.
pub(super) fn search(
    system: &System<'_>,
    stepper: &mut Stepper,
    functions: &[Function],
    moment: &mut Moment,
    found: &mut Vec<StepEvent>,
) -> Result<(), RunError> {
    let (start, end) = (stepper.time_before(), stepper.time());
    let intervals = if stepper.is_dense() { INTERVALS } else { 1 };
    let mut from = evaluated(system, stepper, functions, start, moment)?;
    let mut earlier = start;
    for interval in 1..=intervals {
        let later = if interval == intervals {
            end
        } else {
            start + (end - start) * f64::from(interval) / f64::from(intervals)
        };
        let to = evaluated(system, stepper, functions, later, moment)?;
        let inner = values_within(system, stepper, functions, [earlier, later], moment)?;
        for (index, (function, (from, to))) in
            functions.iter().zip(from.iter().zip(&to)).enumerate()
        {
            let inner =
                inner.as_ref().and_then(|[a, b]| Some([a.get(index)?[0], b.get(index)?[0]]));
            let within = Interval {
                span: [earlier, later],
                values: [from[0], to[0]],
                rates: [from[1], to[1]],
                inner,
            };
            let passage = if function.starts_at_zero() {
                of_start(system, stepper, function, within, moment)?
            } else {
                of_state(system, stepper, function, within, moment)?
            };
            let Some([time, after]) = passage else { continue };
            let time = match function.what {
                // Before, so that the joint is within its stop, and a motor within its limit.
                EventKind::Stop { .. } | EventKind::Rest { .. } | EventKind::Motor(_) => time,
                EventKind::Crossing { .. } => after,
                // After, so that the joint starts with an excess.
                EventKind::Release { .. } => after.max(time + width(later)).min(later),
            };
            found.push(StepEvent { time, what: function.what });
        }
        (from, earlier) = (to, later);
        // Whatever comes later lies beyond a cut.
        if found.iter().any(StepEvent::cuts) {
            break;
        }
    }
    Ok(())
}

/// Value and rate of each function at a time within the last step.
fn evaluated(
    system: &System<'_>,
    stepper: &mut Stepper,
    functions: &[Function],
    time: f64,
    moment: &mut Moment,
) -> Result<Vec<[f64; 2]>, RunError> {
    stepper.at(system, time, moment)?;
    let mut torques = TorquesOnce::default();
    let of = |function: &Function| {
        let value = function.at(system, stepper, time, moment, &mut torques)?;
        Ok([value, function.rate(stepper, moment)])
    };
    functions.iter().map(of).collect()
}

/// Values and rates of all functions close to both ends of an interval, where one is searched for extrema by its values
/// and a state within a step costs next to nothing, or a joint sticks or slides.
fn values_within(
    system: &System<'_>,
    stepper: &mut Stepper,
    functions: &[Function],
    [earlier, later]: [f64; 2],
    moment: &mut Moment,
) -> Result<Option<[Vec<[f64; 2]>; 2]>, RunError> {
    let is_dense = stepper.is_dense();
    let searched = |function: &Function| {
        function.starts_at_zero() && (is_dense || !matches!(function.what, EventKind::Motor(_)))
    };
    if !functions.iter().any(searched) {
        return Ok(None);
    }
    let apart = (later - earlier) * SHARE;
    let first = evaluated(system, stepper, functions, earlier + apart, moment)?;
    let last = evaluated(system, stepper, functions, later - apart, moment)?;
    Ok(Some([first, last]))
}

/// The bracket of the passage of a stop or a crossing in an interval.
fn of_state(
    system: &System<'_>,
    stepper: &mut Stepper,
    function: &Function,
    Interval { mut span, mut values, rates, .. }: Interval,
    moment: &mut Moment,
) -> Result<Option<[f64; 2]>, RunError> {
    let [earlier, later] = span;
    if !function.passes(values) {
        // Towards the stop at first, away from it at the end.
        if !(rates[0] < 0.0 && rates[1] > 0.0) {
            return Ok(None);
        }
        let [_, extremum] = bracket(span, rates, (later - earlier) * SHARE, |time| {
            stepper.at(system, time, moment)?;
            Ok::<_, RunError>(function.rate(stepper, moment))
        })?;
        stepper.at(system, extremum, moment)?;
        span[1] = extremum;
        values[1] = function.at(system, stepper, extremum, moment, &mut TorquesOnce::default())?;
        if !function.passes(values) {
            return Ok(None);
        }
    }
    bracketed(system, stepper, function, (span, values), moment).map(Some)
}

/// The bracket of the time in an interval at which a joint comes to rest, static friction no longer holds it, or a motor
/// changes. Each of these functions may be zero at the start of a segment, but for rounding: of a joint that was released
/// there, or that is held with nothing left.
fn of_start(
    system: &System<'_>,
    stepper: &mut Stepper,
    function: &Function,
    Interval { mut span, mut values, inner, .. }: Interval,
    moment: &mut Moment,
) -> Result<Option<[f64; 2]>, RunError> {
    let [earlier, later] = span;
    let [from, to] = values;
    let mut at = |time: f64| {
        stepper.at(system, time, moment)?;
        function.at(system, stepper, time, moment, &mut TorquesOnce::default())
    };
    if to >= 0.0 {
        let apart = (later - earlier) * SHARE;
        let falls = |[first, last]: [f64; 2]| first < from && last < to;
        if from <= 0.0 || !inner.is_some_and(falls) {
            return Ok(None);
        }
        let [_, extremum] = bracket(span, [-1.0, 1.0], apart, |time| {
            let times = [(time - apart).max(earlier), (time + apart).min(later)];
            Ok::<_, RunError>(at(times[1])? - at(times[0])?)
        })?;
        (span[1], values[1]) = (extremum, at(extremum)?);
        if values[1] >= 0.0 {
            return Ok(None);
        }
    }
    if from <= 0.0 {
        let mut length = span[1] - earlier;
        let above = (0..HALVINGS).find_map(|_| {
            length *= 0.5;
            match at(earlier + length) {
                Ok(value) if value <= 0.0 => None,
                other => Some(other),
            }
        });
        match above {
            Some(value) => (span[0], values[0]) = (earlier + length, value?),
            None => return Ok(Some([earlier; 2])),
        }
    }
    bracketed(system, stepper, function, (span, values), moment).map(Some)
}

/// The bracket of a passage by steps of their own.
fn bracketed(
    system: &System<'_>,
    stepper: &Stepper,
    function: &Function,
    (span, values): ([f64; 2], [f64; 2]),
    moment: &mut Moment,
) -> Result<[f64; 2], RunError> {
    bracket(span, values, width(span[1]), |time| {
        stepper.restep(system, time, moment)?;
        function.at(system, stepper, time, moment, &mut TorquesOnce::default())
    })
}

/// Width of the bracket of a passage before a time, s.
fn width(time: f64) -> f64 {
    WIDTH.max(ROUNDINGS * f64::EPSILON * time)
}

/// A quantity of the state.
fn state_value(stepper: &Stepper, moment: &Moment, quantity: Quantity) -> f64 {
    let joint = |joint| Layout::joint(joint, &moment.state, stepper.turns());
    let state = &moment.state;
    match quantity {
        Quantity::Position(axis) => state.r_b_n[axis],
        Quantity::Velocity(axis) => state.r_b_n_dot[axis],
        Quantity::Omega(axis) => state.omega[axis],
        Quantity::Quaternion(index) => {
            let q = state.attitude.normalised();
            [q.q0, q.q1, q.q2, q.q3][index]
        }
        Quantity::Coordinate(index) => joint(index)[0],
        Quantity::Rate(index) => joint(index)[1],
        Quantity::ModalCoordinate(mode) => moment.state.modal.eta[mode],
        Quantity::ModalRate(mode) => moment.state.modal.eta_dot[mode],
        _ => f64::NAN,
    }
}
