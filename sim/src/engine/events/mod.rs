//! [`Monitors`]: end stops, crossings and limits of motors, found within the step that passes them.
//!
//! A step is searched at its ends and, where a state within it costs next to nothing, at three times
//! in between; and at the extremum of a joint that approaches its stop at the start of an interval
//! and leaves it at the end. The passage is bracketed by steps of their own from the start of the
//! step, so its time is that of the numerical solution, to 1e-12 s or four roundings of the time.

mod clipping;
pub(super) mod motors;
mod roots;
pub(super) mod segments;

use precess_dynamics::Attitude;

use crate::engine::equations::packing::Layout;
use crate::engine::equations::system::System;
use crate::engine::integration::{Moment, Stepper};
use crate::nearest::nearest;
use crate::record::RunError;
use crate::record::columns::Quantity;
use crate::scenario::{Action, Drive, EndStop, Scenario, StopAction};
use motors::MotorChange;
use roots::bracket;

/// Width of the bracket of a passage, s.
const WIDTH: f64 = 1e-12;
/// The same in roundings of the time.
const ROUNDINGS: f64 = 4.0;
/// Intervals of a step that are searched.
const INTERVALS: u32 = 4;

/// The end stops and crossings of a scenario.
pub(crate) struct Monitors<'a> {
    stops: Vec<&'a EndStop>,
    crossings: Vec<MonitoredCrossing>,
    /// Whether a motor has a largest power or rate.
    motors: bool,
    /// States at the ends of an interval and within it.
    moment: Option<Moment>,
}

/// A crossing, and the quantity that it is of.
struct MonitoredCrossing {
    index: usize,
    quantity: Quantity,
    value: f64,
    ends: bool,
}

/// What a step has passed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct StepEvent {
    /// When, s: the last time found before it.
    pub(crate) time: f64,
    pub(crate) what: EventKind,
}

/// A stop of a joint or a crossing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum EventKind {
    /// The joint and the bound reached, rad or m.
    Stop { joint: usize, bound: f64, action: StopAction },
    /// The index of the crossing.
    Crossing { index: usize, ends: bool },
    /// A motor comes to one of its limits, or leaves it.
    Motor(MotorChange),
}

impl StepEvent {
    /// Whether the step ends there.
    fn cuts(&self) -> bool {
        !matches!(self.what, EventKind::Crossing { ends: false, .. })
    }
}

/// A function whose sign changes at a passage: above zero within a stop, and before a motor's change.
#[derive(Clone, Copy)]
struct Function {
    quantity: Quantity,
    value: f64,
    /// One, or minus one of an upper stop.
    sign: f64,
    what: EventKind,
}

impl<'a> Monitors<'a> {
    /// # Errors
    ///
    /// [`RunError::Crossing`] of a column that is none of the state, [`RunError::BeyondStop`].
    pub(crate) fn new(
        scenario: &'a Scenario,
        system: &System<'_>,
        start: &Moment,
    ) -> Result<Self, RunError> {
        let names = system.layout.state_quantities();
        let watched = |(index, crossing): (usize, &crate::scenario::Crossing)| {
            let found = names.iter().find(|(name, ..)| *name == crossing.column);
            let (_, quantity, _) = found.ok_or_else(|| RunError::Crossing {
                name: crossing.name.clone(),
                column: crossing.column.clone(),
                nearest: nearest(&crossing.column, names.iter().map(|(name, ..)| name.as_str())),
            })?;
            let (value, ends) = (crossing.value, crossing.ends);
            Ok(MonitoredCrossing { index, quantity: *quantity, value, ends })
        };
        let crossings = scenario.crossings.iter().enumerate().map(watched);
        let crossings = crossings.collect::<Result<_, RunError>>()?;
        let turns = vec![0.0; system.layout.joints.len()];
        for stop in &scenario.stops {
            let [value, _] = Layout::joint(stop.joint, &start.state, &turns);
            if !(stop.lower..=stop.upper).contains(&value) {
                let place = &system.layout.joints[stop.joint];
                let (joint, [unit, ..]) = (place.name.clone(), place.info.units());
                let stops = [stop.lower, stop.upper];
                return Err(RunError::BeyondStop { joint, value, stops, unit });
            }
        }
        let stops: Vec<_> = scenario.stops.iter().collect();
        let changed = scenario.changes.iter().filter_map(|change| match &change.action {
            Action::Drive(drive) => Some(drive),
            Action::Brake => None,
        });
        let mut drives = scenario.drives.iter().chain(changed);
        let motors = drives.any(|drive| drive.limits().depend_on_rate());
        Ok(Self { stops, crossings, motors, moment: Some(start.clone()) })
    }

    /// Whether there are none.
    #[cfg(feature = "lanes")]
    pub(crate) fn is_empty(&self) -> bool {
        self.stops.is_empty() && self.crossings.is_empty() && !self.motors
    }

    /// What the last step passed, in the order of time, up to the first passage that cuts it.
    pub(crate) fn passed(
        &mut self,
        system: &System<'_>,
        stepper: &mut Stepper,
    ) -> Result<Vec<StepEvent>, RunError> {
        let functions = self.functions(system);
        let mut found = Vec::new();
        if functions.is_empty() {
            return Ok(found);
        }
        let Some(mut moment) = self.moment.take() else { return Ok(found) };
        let searched = search(system, stepper, &functions, &mut moment, &mut found);
        self.moment = Some(moment);
        searched?;
        found.sort_by(|a, b| a.time.total_cmp(&b.time));
        if let Some(cut) = found.iter().position(StepEvent::cuts) {
            found.truncate(cut + 1);
        }
        Ok(found)
    }

    /// The functions that are searched: not those of locked joints.
    fn functions(&self, system: &System<'_>) -> Vec<Function> {
        let mut functions = Vec::new();
        for stop in &self.stops {
            if matches!(system.acting.drive(stop.joint), Drive::Locked) {
                continue;
            }
            for (bound, sign) in [(stop.lower, 1.0), (stop.upper, -1.0)] {
                if bound.is_finite() {
                    let what = EventKind::Stop { joint: stop.joint, bound, action: stop.action };
                    let quantity = Quantity::Coordinate(stop.joint);
                    functions.push(Function { quantity, value: bound, sign, what });
                }
            }
        }
        functions.extend(self.crossings.iter().map(|watched| Function {
            quantity: watched.quantity,
            value: watched.value,
            sign: 1.0,
            what: EventKind::Crossing { index: watched.index, ends: watched.ends },
        }));
        if self.motors {
            functions.extend(motors::possible(system).into_iter().map(|change| Function {
                quantity: Quantity::Rate(change.joint),
                value: 0.0,
                sign: 1.0,
                what: EventKind::Motor(change),
            }));
        }
        functions
    }
}

impl Function {
    fn at(
        &self,
        system: &System<'_>,
        stepper: &Stepper,
        time: f64,
        moment: &Moment,
    ) -> Result<f64, RunError> {
        if let EventKind::Motor(change) = &self.what {
            return change.distance(system, time, &moment.state);
        }
        let value = state_value(stepper, moment, self.quantity);
        Ok(self.sign * (value - self.value))
    }

    /// Whether a passage lies between two values: out of a stop, or through a value either way.
    fn passes(&self, [from, to]: [f64; 2]) -> bool {
        match self.what {
            EventKind::Stop { .. } | EventKind::Motor(_) => to < 0.0 && to < from,
            EventKind::Crossing { .. } => (from < 0.0 && to >= 0.0) || (from > 0.0 && to <= 0.0),
        }
    }
}

/// Searches the last step.
fn search(
    system: &System<'_>,
    stepper: &mut Stepper,
    functions: &[Function],
    moment: &mut Moment,
    found: &mut Vec<StepEvent>,
) -> Result<(), RunError> {
    let (start, end) = (stepper.time_before(), stepper.time());
    let intervals = if stepper.is_dense() { INTERVALS } else { 1 };
    stepper.at(system, start, moment)?;
    let values = |stepper: &Stepper, time: f64, moment: &Moment| {
        let value = |function: &Function| function.at(system, stepper, time, moment);
        functions.iter().map(value).collect::<Result<Vec<f64>, RunError>>()
    };
    let mut from = values(stepper, start, moment)?;
    let mut rates_from = rates(stepper, functions, moment);
    let mut earlier = start;
    for interval in 1..=intervals {
        let later = if interval == intervals {
            end
        } else {
            start + (end - start) * f64::from(interval) / f64::from(intervals)
        };
        stepper.at(system, later, moment)?;
        let to = values(stepper, later, moment)?;
        let rates_to = rates(stepper, functions, moment);
        for (i, function) in functions.iter().enumerate() {
            let mut span = [earlier, later];
            let mut values = [from[i], to[i]];
            if !function.passes(values) {
                // Towards the stop at first, away from it at the end.
                if !(rates_from[i] < 0.0 && rates_to[i] > 0.0) {
                    continue;
                }
                let slope = [rates_from[i], rates_to[i]];
                let [_, extremum] = bracket(span, slope, (later - earlier) * 1e-3, |time| {
                    stepper.at(system, time, moment)?;
                    let rate = rates(stepper, std::slice::from_ref(function), moment);
                    Ok::<_, RunError>(rate[0])
                })?;
                stepper.at(system, extremum, moment)?;
                span[1] = extremum;
                values[1] = function.at(system, stepper, extremum, moment)?;
                if !function.passes(values) {
                    continue;
                }
            }
            let width = WIDTH.max(ROUNDINGS * f64::EPSILON * later);
            let [time, after] = bracket(span, values, width, |time| {
                stepper.restep(system, time, moment)?;
                function.at(system, stepper, time, moment)
            })?;
            // Before a stop, so that the joint is within it; after a crossing.
            let is_crossing = matches!(function.what, EventKind::Crossing { .. });
            let time = if is_crossing { after } else { time };
            found.push(StepEvent { time, what: function.what });
        }
        (from, rates_from, earlier) = (to, rates_to, later);
        // Whatever comes later lies beyond a cut.
        if found.iter().any(StepEvent::cuts) {
            break;
        }
    }
    Ok(())
}

/// The rate of each function of a stop; zero of others, which are not searched for extrema.
fn rates(stepper: &Stepper, functions: &[Function], moment: &Moment) -> Vec<f64> {
    let rate = |function: &Function| match function.what {
        EventKind::Stop { joint, .. } => {
            function.sign * Layout::joint(joint, &moment.state, stepper.turns())[1]
        }
        EventKind::Crossing { .. } | EventKind::Motor(_) => 0.0,
    };
    functions.iter().map(rate).collect()
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
