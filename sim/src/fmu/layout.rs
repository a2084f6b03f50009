//! [`Layout`]: where each number of a unit is in the one array of `precess_fmu.h`; a value reference is such a place.
//!
//! Time; states; their derivatives; inputs; parameters. The macros of `precess_fmu.h` are the same sums.

use crate::scenario::{Drive, Scenario};

/// States of the hub: position, velocity, quaternion, angular velocity.
pub(super) const HUB_STATES: usize = 13;
/// Inputs before the motors: force and torque on the hub, or its accelerations.
pub(super) const HUB_INPUTS: usize = 6;
/// Parameters before those of the devices: step, gravity, hub.
pub(super) const GRAVITY: usize = 1;
pub(super) const HUB: usize = 5;
pub(super) const MOUNTS: usize = 15;
/// Parameters of a body and its joint.
pub(super) const PER_BODY: usize = 18;
/// Numbers of a mount.
pub(super) const PER_MOUNT: usize = 9;

/// Sizes of a unit, and which input gives which joint.
#[derive(Clone, Debug)]
pub(super) struct Layout {
    pub(super) devices: usize,
    pub(super) joints: usize,
    /// Of each joint the number of the input that gives its torque or acceleration.
    pub(super) motors: Vec<Option<usize>>,
    pub(super) wrenches: usize,
}

impl Layout {
    pub(super) fn new(scenario: &Scenario) -> Self {
        let mut count = 0;
        let given = scenario.joints().zip(&scenario.drives).map(|((.., info), drive)| {
            (info.driven && *drive != Drive::Locked).then(|| {
                count += 1;
                count - 1
            })
        });
        let motors = given.collect();
        Self {
            devices: scenario.names.len(),
            joints: scenario.joint_count(),
            motors,
            wrenches: scenario.wrenches.len(),
        }
    }

    pub(super) fn states(&self) -> usize {
        HUB_STATES + 2 * self.joints
    }

    /// How many inputs give joints.
    pub(super) fn driven(&self) -> usize {
        self.motors.iter().flatten().count()
    }

    /// The place of a state.
    pub(super) fn state(index: usize) -> usize {
        1 + index
    }

    /// The place of the derivative of a state.
    pub(super) fn derivative(&self, index: usize) -> usize {
        1 + self.states() + index
    }

    /// The place of an input.
    pub(super) fn input(&self, index: usize) -> usize {
        1 + 2 * self.states() + index
    }

    /// The place of the first input of a wrench.
    pub(super) fn wrench(&self, index: usize) -> usize {
        self.input(HUB_INPUTS + self.driven() + 6 * index)
    }

    /// The place of a parameter.
    pub(super) fn parameter(&self, index: usize) -> usize {
        self.input(HUB_INPUTS + self.driven() + 6 * self.wrenches + index)
    }

    /// The places of the hub's parameters.
    pub(super) fn hub(&self) -> std::ops::Range<usize> {
        self.parameter(HUB)..self.parameter(MOUNTS)
    }

    /// The place of the first parameter of a body, by its joint.
    pub(super) fn body(&self, joint: usize) -> usize {
        self.parameter(MOUNTS + PER_MOUNT * self.devices + PER_BODY * joint)
    }

    /// How many numbers there are.
    pub(super) fn length(&self) -> usize {
        self.body(self.joints)
    }
}
