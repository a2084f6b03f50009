//! [`ControlSample`]: what the columns of a controller show at a time.

use precess_control::{Motion, Reference, Tracking, rotation};
use precess_craft::CraftState;

use crate::engine::equations::system::System;
use crate::record::columns::ControlQuantity;
use crate::scenario::BuiltGuidance;

/// A controller's reference at a time, and how far the hub is from it.
pub(super) struct ControlSample {
    reference: Reference,
    tracking: Tracking,
    error: [f64; 3],
}

impl ControlSample {
    pub(super) fn new(guidance: &BuiltGuidance, time: f64, state: &CraftState) -> Self {
        let reference = guidance.at(time);
        let motion = Motion { attitude: state.attitude, omega: state.omega };
        let tracking = Tracking::new(&motion, &reference);
        let error = rotation::to_vector(&tracking.attitude).into();
        Self { reference, tracking, error }
    }

    /// A number of the controller of an index; none of what has not been computed.
    pub(super) fn number(
        &self,
        system: &System<'_>,
        controller: usize,
        quantity: ControlQuantity,
    ) -> Option<f64> {
        let of_sample = || system.acting.held.values(controller);
        let at = |numbers: &[f64], index: usize| numbers.get(index).copied();
        let q = self.reference.attitude;
        match quantity {
            ControlQuantity::ErrorAngle => {
                let [x, y, z] = self.error;
                Some(libm::sqrt(x * x + y * y + z * z))
            }
            ControlQuantity::Error(axis) => at(&self.error, axis),
            ControlQuantity::RateError(axis) => at(self.tracking.omega_br.as_slice(), axis),
            ControlQuantity::ReferenceQuaternion(k) => at(&[q.q0, q.q1, q.q2, q.q3], k),
            ControlQuantity::ReferenceOmega(axis) => at(self.reference.omega.as_slice(), axis),
            ControlQuantity::Torque(axis) => at(&of_sample()?.torque, axis),
            ControlQuantity::TorqueError(axis) => at(&of_sample()?.torque_error, axis),
            ControlQuantity::Measure => Some(of_sample()?.measure),
            ControlQuantity::Limited => Some(of_sample()?.limited),
            ControlQuantity::Command(joint) => at(&of_sample()?.commands, joint),
            ControlQuantity::Gyro(axis) => at(&of_sample()?.measured.gyro, axis),
            ControlQuantity::GyroBias(axis) => at(&of_sample()?.measured.gyro_bias, axis),
            ControlQuantity::Accelerometer(axis) => at(&of_sample()?.measured.accelerometer, axis),
            ControlQuantity::MeasuredOmega(axis) => at(&of_sample()?.measured.omega, axis),
            ControlQuantity::MeasuredQuaternion(k) => at(&of_sample()?.measured.attitude, k),
            ControlQuantity::MeasurementError(axis) => at(&of_sample()?.measured.error, axis),
            ControlQuantity::EstimatedBias(axis) => at(&of_sample()?.measured.estimated_bias, axis),
            ControlQuantity::AttitudeDeviation(axis) => at(&of_sample()?.measured.deviation, axis),
            ControlQuantity::External(axis) => at(&of_sample()?.external, axis),
        }
    }
}
