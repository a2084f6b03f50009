//! [`GivenInputs`]: what a program that is coupled to a run gives, held until it gives something else.

use nalgebra::Vector3;

/// Inputs beside those of the scenario.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct GivenInputs {
    /// Force on the hub through B, expressed in B, N.
    pub(crate) force: Vector3<f64>,
    /// Torque on the hub about B, expressed in B, N m.
    pub(crate) torque: Vector3<f64>,
    /// Of each joint the torque or force of its motor before clipping, in the place of the scenario's profile, N m or N; none
    /// where the scenario gives it.
    pub(crate) motors: Vec<Option<f64>>,
}

impl GivenInputs {
    /// Whether something acts on the hub.
    pub(crate) fn on_hub(&self) -> bool {
        self.force != Vector3::zeros() || self.torque != Vector3::zeros()
    }

    /// The torque or force of a joint's motor, where it is given.
    pub(crate) fn motor(&self, joint: usize) -> Option<f64> {
        self.motors.get(joint).copied().flatten()
    }
}
