//! [`Frictions`]: friction of joints that sticks or slides during a segment, and quadratic drag.
//!
//! Within a segment a joint either sticks, and is locked, or slides, with a sign of its rate that stays. What ends
//! either is an event; [`Run`](crate::engine::Run) then decides which of the two follows.

use precess_control::Checkpoint;
use precess_dynamics::kind::Each;
use precess_dynamics::{JointStates, Mode};

use crate::scenario::{JointFriction, Scenario};
use precess_craft::{CraftInputs, CraftState};

/// What a joint with dry friction does during a segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Contact {
    /// It is locked, as long as static friction holds it.
    Sticks,
    /// It moves with this sign of its rate, 1 or -1.
    Slides(f64),
}

/// The friction of all joints that have any of this kind.
#[derive(Clone, Debug)]
pub(crate) struct Frictions<'a> {
    all: Vec<(&'a JointFriction, Contact)>,
}

impl<'a> Frictions<'a> {
    /// Joints at rest stick until it is decided.
    pub(crate) fn new(scenario: &'a Scenario) -> Self {
        let rates: Vec<_> = scenario.initial.devices.states().map(|[_, rate]| rate).collect();
        let contact = |of: &JointFriction| match rates.get(of.joint) {
            Some(rate) if *rate != 0.0 => Contact::Slides(rate.signum()),
            _ => Contact::Sticks,
        };
        let all: Vec<_> = scenario.friction.iter().map(|of| (of, contact(of))).collect();
        Self { all }
    }

    /// Joints with dry friction, and what they do.
    pub(crate) fn dry(&self) -> impl Iterator<Item = (&'a JointFriction, Contact)> {
        self.all.iter().copied().filter(|(of, _)| of.dry.is_some())
    }

    pub(crate) fn set(&mut self, joint: usize, contact: Contact) {
        for (_, present) in self.all.iter_mut().filter(|(of, _)| of.joint == joint) {
            *present = contact;
        }
    }

    /// Visits what each joint does.
    pub(crate) fn visit(&mut self, checkpoint: &mut Checkpoint<'_>) {
        for (_, contact) in &mut self.all {
            let mut sign = match contact {
                Contact::Sticks => None,
                Contact::Slides(sign) => Some(*sign),
            };
            checkpoint.optional(&mut sign, || 0.0, Checkpoint::number);
            *contact = sign.map_or(Contact::Sticks, Contact::Slides);
        }
    }

    /// Whether friction varies with a rate.
    pub(crate) fn vary(&self) -> bool {
        self.all.iter().any(|(of, _)| of.varies())
    }

    /// Adds friction to the motor torques of joints that slide, and locks those that stick.
    pub(crate) fn add(&self, state: &CraftState, inputs: &mut CraftInputs) {
        for (of, contact) in &self.all {
            let rate = rate(state, of.joint);
            let motor = inputs.motors.values_mut().nth(of.joint);
            let mode = inputs.modes.values_mut().nth(of.joint);
            let (Some(motor), Some(mode)) = (motor, mode) else { continue };
            if *mode != Mode::Driven {
                continue;
            }
            match contact {
                Contact::Sticks if of.dry.is_some() => (*motor, *mode) = (0.0, Mode::Locked),
                Contact::Sticks => *motor += of.sliding(rate, 0.0),
                Contact::Slides(sign) => *motor += of.sliding(rate, *sign),
            }
        }
    }

    /// Splits the torques of all joints into those of motors and of friction, N m or N.
    ///
    /// `of_motor` is a joint's motor torque where its profile says it, none of one whose motion is prescribed, which is locked
    /// or whose motor delivers its largest power: there it is the total less friction.
    pub(crate) fn split(
        &self,
        totals: &[f64],
        state: &CraftState,
        of_motor: impl Fn(usize) -> Option<f64>,
    ) -> Vec<[f64; 2]> {
        let mut split: Vec<_> = totals.iter().map(|total| [*total, 0.0]).collect();
        for (of, contact) in &self.all {
            let Some([motor, friction]) = split.get_mut(of.joint) else { continue };
            let rate = rate(state, of.joint);
            let total = *motor;
            let sliding = if rate == 0.0 { 0.0 } else { of.sliding(rate, rate.signum()) };
            (*motor, *friction) = match (of_motor(of.joint), contact) {
                (Some(own), Contact::Sticks) if of.dry.is_some() => (own, total - own),
                (Some(own), Contact::Slides(sign)) => (own, of.sliding(rate, *sign)),
                (Some(own), Contact::Sticks) => (own, sliding),
                (None, _) => (total - sliding, sliding),
            };
        }
        split
    }
}

fn rate(state: &CraftState, joint: usize) -> f64 {
    state.devices.states().nth(joint).map_or(0.0, |[_, rate]| rate)
}
