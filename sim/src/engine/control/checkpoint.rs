//! Checkpoints of controllers: what each keeps from sample to sample, and what waits to act.

use precess_control::Checkpoint;

use super::{Control, Controls, JointCommands, Pending};

impl Controls<'_> {
    /// Visits what changes in the course of a run.
    pub(crate) fn visit(&mut self, checkpoint: &mut Checkpoint<'_>) {
        for control in &mut self.each {
            control.visit(checkpoint);
        }
    }
}

impl Control<'_> {
    fn visit(&mut self, checkpoint: &mut Checkpoint<'_>) {
        let joints = self.of.joints.len();
        self.controller.visit(checkpoint);
        self.allocator.visit(checkpoint);
        self.sensing.visit(checkpoint);
        self.samples.visit(checkpoint);
        if let Some(ticks) = &mut self.ticks {
            ticks.visit(checkpoint);
        }
        let blank = || Pending {
            at: 0.0,
            external: None,
            joints: JointCommands::Torques(vec![0.0; joints]),
        };
        checkpoint.queue(&mut self.pending, blank, |checkpoint, of| of.visit(checkpoint));
        let blank = || vec![0.0; joints];
        checkpoint.optional(&mut self.present, blank, |checkpoint, of| checkpoint.numbers(of));
        checkpoint.flag(&mut self.sampled);
        checkpoint.index(&mut self.bounded, usize::MAX);
        checkpoint.flag(&mut self.limited);
    }
}

impl Pending {
    fn visit(&mut self, checkpoint: &mut Checkpoint<'_>) {
        let Self { at, external, joints } = self;
        checkpoint.number(at);
        checkpoint.optional_vector(external);
        let mut are_commands = matches!(joints, JointCommands::Commands(_));
        checkpoint.flag(&mut are_commands);
        let (JointCommands::Torques(numbers) | JointCommands::Commands(numbers)) = joints;
        checkpoint.numbers(&mut *numbers);
        let numbers = std::mem::take(numbers);
        *joints = if are_commands {
            JointCommands::Commands(numbers)
        } else {
            JointCommands::Torques(numbers)
        };
    }
}
