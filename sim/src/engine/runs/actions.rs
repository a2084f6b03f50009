//! What happens at the start of a segment: locks at end stops, new drives, brakes.

use precess_dynamics::Mode;
use precess_dynamics::kind::Each;

use super::Run;
use crate::engine::equations::inputs::LOCKED;
use crate::engine::equations::packing::Layout;
use crate::engine::integration::dop853::same;
use crate::record::{End, RunError};
use crate::scenario::{Action, Drive, Profile};
use precess_craft::CraftInputs;

impl Run<'_> {
    /// Applies what is due at the present time and begins the segment.
    pub(super) fn begin_segment(&mut self) -> Result<(), RunError> {
        loop {
            self.time = self.latest_of_same();
            let listed = self.segments.end_after(self.time);
            self.system.acting.begin(self.time, listed);
            let released = self.bring_to_rest()?;
            self.apply_actions()?;
            // What a sample commands may act after a delay, so this is known only now.
            let end = self.controls.next_after(self.time).min(listed);
            self.segment_end = end;
            self.system.acting.begin(self.time, end);
            self.decide_friction(released)?;
            // Two times that differ by rounding are one.
            if same(self.time, end) {
                self.time = end;
                if end < self.duration() {
                    continue;
                }
                self.end = Some(End::Finished);
                return Ok(());
            }
            self.stepper.begin(&self.system, [self.time, end], &self.moment)?;
            self.stepper.now(&self.system, &mut self.moment);
            self.at_boundary = false;
            return Ok(());
        }
    }

    /// The latest time at which something is due that differs from the present one by rounding: they are one.
    fn latest_of_same(&mut self) -> f64 {
        let mut time = self.time;
        loop {
            let next = self.controls.next_after(time).min(self.segments.end_after(time));
            if next <= time || !same(time, next) {
                return time;
            }
            time = next;
        }
    }

    fn apply_actions(&mut self) -> Result<(), RunError> {
        if let Some((joint, bound)) = self.stopped.take() {
            let lost = self.brake(&[joint])?;
            let place = &self.system.layout.joints[joint];
            let (name, [unit, ..]) = (&place.name, place.info.units());
            let text =
                format!("{name} reaches its end stop at {bound} {unit}; locked, {lost} J lost");
            self.note(self.time, text);
        }
        let changes = self.segments.due(self.time).to_vec();
        let mut brakes = Vec::new();
        for change in &changes {
            self.check_driven(change.joint, &change.action)?;
            if change.action == Action::Drive(Drive::Locked) {
                self.check_at_rest(change.joint)?;
            }
        }
        for change in changes {
            match &change.action {
                Action::Drive(drive) => {
                    self.system.acting.set_drive(change.joint, drive);
                    let words = match drive {
                        Drive::Torque { .. } => "driven by a torque",
                        Drive::Acceleration(_) => "accelerates as prescribed",
                        Drive::Locked => "locked",
                    };
                    let name = &self.system.layout.joints[change.joint].name;
                    let text = format!("{name}: {words}");
                    self.note(self.time, text);
                }
                Action::Brake => brakes.push(change.joint),
                Action::Release => self.release(change.joint),
            }
        }
        if !brakes.is_empty() {
            let lost = self.brake(&brakes)?;
            let names = brakes.iter().map(|joint| self.system.layout.joints[*joint].name.as_str());
            let names = names.collect::<Vec<_>>().join(", ");
            self.note(self.time, format!("{names}: braked, {lost} J lost"));
        }
        self.slide_what_moves();
        self.controls.act(&mut self.system, self.time, &self.moment)?;
        self.settle_motors()
    }

    /// Gives a joint back to its controller.
    fn release(&mut self, joint: usize) {
        let Some(drive) = self.scenario.drives.get(joint) else { return };
        self.system.acting.release(joint, drive);
        let name = self.system.layout.joints.get(joint).map_or("", |place| &place.name);
        let text = format!("{name}: commanded by its controller");
        self.note(self.time, text);
    }

    /// Stops joints impulsively, locks them, and enters the loss; returns it, J.
    fn brake(&mut self, joints: &[usize]) -> Result<f64, RunError> {
        // Friction gives way: it has no impulse.
        let inputs = self.system.inputs_without_friction(self.time, &self.moment.state);
        let lost = self.stop(joints, inputs)?;
        self.lost += lost;
        for joint in joints {
            self.system.acting.set_drive(*joint, LOCKED);
        }
        Ok(lost)
    }

    /// Stops joints impulsively; returns the energy lost, J.
    pub(super) fn stop(
        &mut self,
        joints: &[usize],
        mut inputs: CraftInputs,
    ) -> Result<f64, RunError> {
        for (joint, mode) in inputs.modes.values_mut().enumerate() {
            if joints.contains(&joint) {
                *mode = Mode::Locked;
            }
        }
        let stopped = self.system.craft.stop(&self.moment.state, &inputs);
        let failed = |source| RunError::solve(&self.system, self.time, source);
        let (state, energy_lost) = stopped.map_err(failed)?;
        self.moment.state = state;
        Ok(energy_lost)
    }

    /// Rejects a drive of a joint that its kind keeps at its rate, and a locked joint that moves.
    pub(super) fn check_drives(&self) -> Result<(), RunError> {
        for (joint, drive) in self.scenario.drives.iter().enumerate() {
            self.check_driven(joint, &Action::Drive(drive.clone()))?;
            if *drive == Drive::Locked {
                self.check_at_rest(joint)?;
            }
        }
        self.check_rates()
    }

    fn check_driven(&self, joint: usize, action: &Action) -> Result<(), RunError> {
        let place = &self.system.layout.joints[joint];
        let none = match action {
            Action::Drive(Drive::Torque { profile, .. } | Drive::Acceleration(profile)) => {
                Profile::is_zero(profile)
            }
            Action::Drive(Drive::Locked) | Action::Brake | Action::Release => false,
        };
        if place.info.driven || none {
            return Ok(());
        }
        Err(RunError::NotDriven { time: self.time, joint: place.name.clone() })
    }

    fn check_at_rest(&self, joint: usize) -> Result<(), RunError> {
        let [_, rate] = Layout::joint(joint, &self.moment.state, self.stepper.turns());
        if rate == 0.0 {
            return Ok(());
        }
        let place = &self.system.layout.joints[joint];
        let (time, joint, [_, unit, ..]) = (self.time, place.name.clone(), place.info.units());
        Err(RunError::LockedJointMoves { time, joint, rate, unit })
    }
}
