//! [`HeldCommands`]: what controllers command of joints and hold until they command anew, and what they computed at their
//! last samples.

use crate::scenario::{SampledController, Scenario};

/// Commands in force.
#[derive(Clone, Debug)]
pub(crate) struct HeldCommands {
    /// Of each joint; none where no controller commands it.
    joints: Vec<Option<Held>>,
    /// Of each controller.
    values: Vec<ControlValues>,
}

/// The command of a joint.
#[derive(Clone, Copy, Debug, Default)]
struct Held {
    /// Torque of its motor before clipping, N m.
    torque: f64,
    /// Whether a change, a brake or an end stop has taken the place of its controller.
    replaced: bool,
}

/// What a controller computed at its last sample.
#[derive(Clone, Debug)]
pub(crate) struct ControlValues {
    /// Torque on the spacecraft, B, N m.
    pub(crate) torque: [f64; 3],
    /// What the commands give less that, N m.
    pub(crate) torque_error: [f64; 3],
    /// Rate or acceleration of each joint that it commands, rad/s or rad/s².
    pub(crate) commands: Vec<f64>,
    /// Measure of singularity, dimensionless.
    pub(crate) measure: f64,
    /// How many commands or torques are at a limit.
    pub(crate) limited: f64,
}

impl ControlValues {
    /// Those of a number of joints before anything is computed.
    fn nothing(joints: usize) -> Self {
        Self {
            torque: [0.0; 3],
            torque_error: [0.0; 3],
            commands: vec![0.0; joints],
            measure: f64::NAN,
            limited: 0.0,
        }
    }

    /// Leaves nothing of an earlier sample but how many are at a limit.
    pub(crate) fn clear(&mut self) {
        *self = Self { limited: self.limited, ..Self::nothing(self.commands.len()) };
    }
}

impl HeldCommands {
    /// No torques, and nothing computed.
    pub(crate) fn new(scenario: &Scenario) -> Self {
        let mut joints = vec![None; scenario.joint_count()];
        for of in scenario.controllers.iter().flat_map(|of| &of.joints) {
            if let Some(held) = joints.get_mut(of.joint) {
                *held = Some(Held::default());
            }
        }
        let nothing = |of: &SampledController| ControlValues::nothing(of.joints.len());
        Self { joints, values: scenario.controllers.iter().map(nothing).collect() }
    }

    /// The torque of a joint's motor before clipping, N m; none where no controller commands it at present.
    pub(crate) fn torque(&self, joint: usize) -> Option<f64> {
        let held = self.joints.get(joint).copied().flatten()?;
        (!held.replaced).then_some(held.torque)
    }

    /// Holds a torque of a joint that a controller commands; while another drive has its place it waits for its release.
    pub(crate) fn hold(&mut self, joint: usize, torque: f64) {
        if let Some(Some(held)) = self.joints.get_mut(joint) {
            held.torque = torque;
        }
    }

    /// Another drive takes the place of the controller, or it commands again.
    pub(crate) fn set_replaced(&mut self, joint: usize, replaced: bool) {
        if let Some(Some(held)) = self.joints.get_mut(joint) {
            held.replaced = replaced;
        }
    }

    /// What a controller computed at its last sample.
    pub(crate) fn values(&self, controller: usize) -> Option<&ControlValues> {
        self.values.get(controller)
    }

    /// The same, to be written.
    pub(crate) fn values_mut(&mut self, controller: usize) -> Option<&mut ControlValues> {
        self.values.get_mut(controller)
    }
}
