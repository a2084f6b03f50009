//! Checkpoints of a run: all that its next steps depend on, and why there may be none.
//!
//! What it reports at its end, events, drifts and largest rates, is not part of it.

use std::fmt;

use precess_control::Checkpoint;

use super::{Changed, Run};
use crate::engine::equations::motors::MotorState;
use crate::engine::events::motors::MotorChange;
use crate::record::End;

/// Why there is no checkpoint of a run, or a run does not take one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CheckpointError {
    /// A run with a tolerance, or with a controller that is another program.
    Kept,
    /// The bytes are no checkpoint of a run of this scenario.
    Bytes,
}

impl fmt::Display for CheckpointError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Kept => {
                "a run with a tolerance, or with a controller that is another program, cannot be copied; state `integrator = \
                 \"rk4\"` and a `step` in `[run]`, and a law of the scenario"
            }
            Self::Bytes => {
                "the bytes are no state of a run of this scenario, or are damaged; save one of this scenario by this version"
            }
        })
    }
}

impl std::error::Error for CheckpointError {}

impl Run<'_> {
    /// Visits what its next steps depend on.
    pub(super) fn visit(&mut self, checkpoint: &mut Checkpoint<'_>) {
        let joints = self.system.layout.joints.len();
        self.system.visit(checkpoint);
        self.stepper.visit(checkpoint);
        self.segments.visit(checkpoint);
        self.controls.visit(checkpoint);
        checkpoint.numbers([&mut self.segment_end, &mut self.lost, &mut self.time]);
        self.moment.visit(checkpoint);
        checkpoint.flag(&mut self.at_boundary);
        let blank = || (0, 0.0);
        checkpoint.optional(&mut self.stopped, blank, |checkpoint, (joint, bound)| {
            checkpoint.index(joint, joints);
            checkpoint.number(bound);
        });
        let blank = || MotorChange { joint: 0, to: MotorState::default() };
        checkpoint.optional(&mut self.motor_change, blank, |checkpoint, of| {
            of.visit(joints, checkpoint);
        });
        let blank = || Changed::AtRest(0);
        checkpoint.optional(&mut self.changed, blank, |checkpoint, of| {
            of.visit(joints, checkpoint);
        });
        checkpoint.index(&mut self.changes_at_once, usize::MAX);
        let mut has_ended = self.end.is_some();
        checkpoint.flag(&mut has_ended);
        if has_ended != self.end.is_some() {
            self.end = has_ended.then_some(End::Finished);
        }
        checkpoint.flag(&mut self.failed);
    }
}

impl Changed {
    fn visit(&mut self, joints: usize, checkpoint: &mut Checkpoint<'_>) {
        let mut is_released = matches!(self, Self::Released(_));
        let (Self::AtRest(mut joint) | Self::Released(mut joint)) = *self;
        checkpoint.flag(&mut is_released);
        checkpoint.index(&mut joint, joints);
        *self = if is_released { Self::Released(joint) } else { Self::AtRest(joint) };
    }
}
