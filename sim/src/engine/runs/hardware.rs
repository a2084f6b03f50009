//! [`HardwareChange`]: hardware that changes in the course of a run, as faults do: the state stays, its equations are others from then on.
//!
//! What changes is what the solver has of the spacecraft (masses, imbalances, springs, viscous and dry friction that does not stick), what motors
//! exert of their commands, and the bias of gyros. Drives, sources, controllers and friction that sticks stay those of the run's scenario. It is
//! exact where it is at a time at which a controller samples, since a step ends there. The energy ledger does not have it.

use nalgebra::Vector3;
use precess_dynamics::JointStates as _;

use super::Run;
use crate::engine::craft_of;
use crate::engine::integration::dop853::same;
use crate::record::RunError;
use crate::scenario::Scenario;

/// A change of hardware.
pub(crate) struct HardwareChange<'a> {
    /// When, s: at the end of the first step that reaches it.
    pub(crate) time: f64,
    /// What the spacecraft is from then on: the run's scenario with other numbers.
    pub(crate) scenario: &'a Scenario,
    /// Joints whose motors exert this multiple of what their controllers command.
    pub(crate) motors: Vec<(usize, f64)>,
    /// Joints whose angles jump, rad: of a wheel whose axes, not its mass, are turned.
    pub(crate) angles: Vec<(usize, f64)>,
    /// By which the bias of gyros jumps, their axes, rad/s.
    pub(crate) gyro_bias: Vector3<f64>,
}

impl HardwareChange<'_> {
    /// Whether a run has come to it.
    pub(super) fn is_due(&self, time: f64) -> bool {
        time >= self.time || same(time, self.time)
    }
}

impl Run<'_> {
    /// Changes the hardware at the present time.
    ///
    /// # Errors
    ///
    /// A spacecraft that cannot be built.
    pub(super) fn change_hardware(&mut self, change: &HardwareChange<'_>) -> Result<(), RunError> {
        self.system.craft = craft_of(change.scenario)?;
        for (joint, factor) in &change.motors {
            self.system.acting.held.set_factor(*joint, *factor);
        }
        for (joint, angle) in &change.angles {
            if let Some([coordinate, _]) = self.moment.state.devices.states_mut().nth(*joint) {
                *coordinate += angle;
            }
        }
        self.controls.add_gyro_bias(&change.gyro_bias);
        // A new segment: the integrator starts with the new equations.
        self.at_boundary = true;
        Ok(())
    }
}
