//! Whether friction holds a joint at rest, decided at the start of a segment.
//!
//! All joints at rest are held at first. One that takes more than its static friction is released, the one with the
//! largest excess first, and the others are judged with it free; so each is released at most once. It slides against
//! the friction that held it.

use precess_dynamics::JointStates as _;

use super::Run;
use crate::engine::equations::friction::Contact;
use crate::engine::quantities::joint_torques::joint_torques;
use crate::record::RunError;

/// Changes at one time beyond those of each joint: more, and the run does not go on.
const CHANGES_AT_ONCE_MAX: usize = 100;

/// What an event says of the friction of a joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Changed {
    /// A joint that slides has come to rest.
    AtRest(usize),
    /// A joint that sticks takes more than its static friction.
    Released(usize),
}

impl Run<'_> {
    /// Counts changes of friction and of motors at one time.
    pub(super) fn count_changes(&mut self, reached: f64) -> Result<(), RunError> {
        let of_friction =
            self.changed.map(|(Changed::AtRest(joint) | Changed::Released(joint))| joint);
        let of_motor = self.motor_change.map(|change| change.joint);
        let Some(joint) = of_friction.or(of_motor) else {
            self.changes_at_once = 0;
            return Ok(());
        };
        let again = reached <= self.time;
        self.changes_at_once = if again { self.changes_at_once + 1 } else { 0 };
        let most = CHANGES_AT_ONCE_MAX + self.scenario.joint_count();
        if self.changes_at_once <= most {
            return Ok(());
        }
        let joint = self.system.layout.joints.get(joint).map_or("", |place| &place.name).to_owned();
        let motor = of_friction.is_none();
        Err(RunError::Undecided { time: reached, joint, motor, changes: self.changes_at_once })
    }

    /// Gives joints that have just come to rest a rate of exactly zero, by an impulse that keeps the momenta; returns the
    /// joint that takes more than its static friction, if that is what has happened.
    pub(super) fn bring_to_rest(&mut self) -> Result<Option<usize>, RunError> {
        let Some(changed) = self.changed.take() else { return Ok(None) };
        let rates: Vec<_> = self.moment.state.devices.states().map(|[_, rate]| rate).collect();
        // Others may have passed zero within the width of the event.
        let passed = |joint: usize, contact: Contact| match (contact, rates.get(joint)) {
            (Contact::Slides(sign), Some(rate)) => sign * rate < 0.0,
            _ => false,
        };
        let acting = &self.system.acting;
        let joints: Vec<_> = acting
            .friction
            .dry()
            .filter(|(of, contact)| {
                changed == Changed::AtRest(of.joint)
                    || (passed(of.joint, *contact) && acting.motor(of.joint, self.time).is_some())
            })
            .map(|(of, _)| of.joint)
            .collect();
        if !joints.is_empty() {
            // What is lost is the square of a rounding.
            let inputs = self.system.inputs(self.time, &self.moment.state);
            self.stop(&joints, inputs)?;
        }
        Ok(match changed {
            Changed::Released(joint) => Some(joint),
            Changed::AtRest(_) => None,
        })
    }

    /// Lets joints slide that stuck and now have a rate, by the impulse of a brake on another or since they are driven by a
    /// torque again: what evaluates before friction is decided would hold them.
    pub(super) fn slide_what_moves(&mut self) {
        let rates: Vec<_> = self.moment.state.devices.states().map(|[_, rate]| rate).collect();
        let sticking = self.system.acting.friction.dry();
        let sticking = sticking.filter(|(_, contact)| *contact == Contact::Sticks);
        let joints: Vec<usize> = sticking.map(|(of, _)| of.joint).collect();
        for joint in joints {
            let rate = rates.get(joint).copied().unwrap_or_default();
            if rate == 0.0 {
                continue;
            }
            self.system.acting.friction.set(joint, Contact::Slides(rate.signum()));
            if self.system.acting.motor(joint, self.time).is_some() {
                let name = self.system.layout.joints.get(joint).map_or("", |place| &place.name);
                let text = format!("{name}: slides");
                self.note(self.time, text);
            }
        }
    }

    /// Decides of each joint with dry friction whether it sticks or slides; the one that an event has released slides.
    pub(super) fn decide_friction(&mut self, released: Option<usize>) -> Result<(), RunError> {
        let before: Vec<_> = self.system.acting.friction.dry().collect();
        if before.is_empty() {
            return Ok(());
        }
        let rates: Vec<_> = self.moment.state.devices.states().map(|[_, rate]| rate).collect();
        let rate = |joint: usize| rates.get(joint).copied().unwrap_or_default();
        for (of, _) in &before {
            let rate = rate(of.joint);
            let contact =
                if rate == 0.0 { Contact::Sticks } else { Contact::Slides(rate.signum()) };
            self.system.acting.friction.set(of.joint, contact);
        }
        let mut released = released;
        while let Some((joint, held)) = self.exceeded(released.take())? {
            self.system.acting.friction.set(joint, Contact::Slides(-held.signum()));
        }
        let after: Vec<_> = self.system.acting.friction.dry().collect();
        for ((of, before), (_, after)) in before.iter().zip(&after) {
            if self.system.acting.motor(of.joint, self.time).is_none() {
                continue;
            }
            let words = match (before, after) {
                (Contact::Slides(_), Contact::Sticks) => "sticks",
                (Contact::Sticks, Contact::Slides(_)) => "slides",
                (Contact::Slides(from), Contact::Slides(to)) if from != to => "slides back",
                _ => continue,
            };
            let name = self.system.layout.joints.get(of.joint).map_or("", |place| &place.name);
            let text = format!("{name}: {words}");
            self.note(self.time, text);
        }
        Ok(())
    }

    /// The joint that sticks and exceeds its static friction by most, and the friction that would hold it, N m or N;
    /// the one that an event has found before all others.
    fn exceeded(&self, found: Option<usize>) -> Result<Option<(usize, f64)>, RunError> {
        let friction = self.system.acting.friction.dry();
        let sticking: Vec<_> = friction
            .filter(|(of, contact)| {
                *contact == Contact::Sticks
                    && self.system.acting.motor(of.joint, self.time).is_some()
            })
            .collect();
        if sticking.is_empty() {
            return Ok(None);
        }
        let held = joint_torques(&self.system, self.time, &self.moment.state);
        let held = held.map_err(|source| RunError::solve(&self.system, self.time, source))?;
        let excess = sticking.into_iter().filter_map(|(of, _)| {
            let ([_, held], most) = (*held.get(of.joint)?, of.dry?.static_friction);
            let excess = if found == Some(of.joint) { f64::INFINITY } else { held.abs() / most };
            (excess > 1.0).then_some((of.joint, held, excess))
        });
        let most = excess.max_by(|a, b| a.2.total_cmp(&b.2));
        Ok(most.map(|(joint, held, _)| (joint, held)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::tests::turning_panel;
    use crate::scenario::{DryFriction, JointFriction};

    #[test]
    fn changes_without_end_at_one_time_are_an_error_with_the_joint() {
        let mut scenario = turning_panel(0.0, 1.0);
        let dry = Some(DryFriction { static_friction: 2.0, coulomb: 1.0, stribeck_rate: 0.0 });
        scenario.friction = vec![JointFriction { joint: 0, dry, drag: 0.0 }];
        let mut run = Run::new(&scenario).expect("it is accepted");
        let mut change = |time: f64| {
            run.changed = Some(Changed::AtRest(0));
            run.count_changes(time)
        };
        for _ in 0..=CHANGES_AT_ONCE_MAX {
            change(0.0).expect("not yet");
        }
        let error = change(0.0).expect_err("too many").to_string();
        assert!(
            error.contains("at t = 0 s the friction of panel.phi has changed 102 times"),
            "{error}"
        );
        change(0.5).expect("it goes on");
    }
}
