//! [`Monitors`]: end stops, friction that comes to hold a joint or no longer does, crossings and limits of motors, found
//! within the step that passes them.
//!
//! A step is searched at its ends and, where a state within it costs next to nothing, at three times
//! in between; and at the extremum of a joint that approaches its stop at the start of an interval
//! and leaves it at the end. The rate of a joint that slides and what is left of the static friction of one that sticks
//! are searched likewise. The passage is bracketed by steps of their own from the start of the
//! step, so its time is that of the numerical solution, to 1e-12 s or four roundings of the time.

mod clipping;
mod function;
pub(super) mod motors;
mod roots;
pub(super) mod segments;

use crate::engine::equations::friction::Contact;
use crate::engine::equations::packing::Layout;
use crate::engine::equations::system::System;
use crate::engine::integration::{Moment, Stepper};
use crate::nearest::nearest;
use crate::record::RunError;
use crate::record::columns::Quantity;
use crate::scenario::{Action, Drive, EndStop, Scenario, StopAction};
use function::{Function, FunctionOf, search};
use motors::MotorChange;

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
    /// The rate of a joint that slides is zero.
    Rest { joint: usize },
    /// Static friction no longer holds a joint that sticks.
    Release { joint: usize },
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
            Action::Brake | Action::Release => None,
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
                    let of = FunctionOf::State { quantity, value: bound, sign };
                    functions.push(Function { of, what });
                }
            }
        }
        let acting = &system.acting;
        for (of, contact) in acting.friction.dry() {
            let joint = of.joint;
            if acting.motor(joint, 0.0).is_none() {
                continue;
            }
            let (of, what) = match (contact, of.dry) {
                (Contact::Slides(sign), _) => {
                    let quantity = Quantity::Rate(joint);
                    (FunctionOf::State { quantity, value: 0.0, sign }, EventKind::Rest { joint })
                }
                (Contact::Sticks, Some(dry)) => {
                    let static_friction = dry.static_friction;
                    (FunctionOf::Slack { joint, static_friction }, EventKind::Release { joint })
                }
                (Contact::Sticks, None) => continue,
            };
            functions.push(Function { of, what });
        }
        functions.extend(self.crossings.iter().map(|watched| Function {
            of: FunctionOf::State { quantity: watched.quantity, value: watched.value, sign: 1.0 },
            what: EventKind::Crossing { index: watched.index, ends: watched.ends },
        }));
        if self.motors {
            functions.extend(motors::possible(system).into_iter().map(|change| Function {
                of: FunctionOf::Motor(change),
                what: EventKind::Motor(change),
            }));
        }
        functions
    }
}
