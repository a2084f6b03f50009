//! [`MomentumDumping`]: an external torque that takes momentum from the devices.

use nalgebra::Vector3;

use crate::model::error::{self, ControlError};

/// `L = -k (h - h_wanted)`, each component within its limit.
///
/// An external actuator exerts it, and the law of the attitude has it ([`Sample::external`](crate::Sample::external)): it
/// then commands the devices to exert the opposite, and the hub stays as it is. The momentum's error falls with the time
/// constant `1 / k`; of samples with period T by `1 - k T` a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MomentumDumping {
    gain: f64,
    wanted: Vector3<f64>,
    limit: Vector3<f64>,
}

impl MomentumDumping {
    /// With a gain, 1/s, the wanted momentum of the devices relative to the hub, expressed in B, N m s, and the largest
    /// magnitude of each component of the torque, N m; infinite where there is none.
    ///
    /// # Errors
    ///
    /// A gain or a limit that is not positive, or a momentum that is not finite.
    pub fn new(gain: f64, wanted: Vector3<f64>, limit: Vector3<f64>) -> Result<Self, ControlError> {
        error::positive("gain of momentum dumping", gain)?;
        for value in wanted.iter() {
            error::finite("wanted momentum", *value)?;
        }
        for value in limit.iter() {
            error::limit("torque limit", *value)?;
        }
        Ok(Self { gain, wanted, limit })
    }

    /// The external torque at a momentum of the devices, both expressed in B, N m.
    #[must_use]
    pub fn torque(&self, momentum: &Vector3<f64>) -> Vector3<f64> {
        let wanted = (self.wanted - momentum) * self.gain;
        wanted.zip_map(&self.limit, |torque, limit| torque.clamp(-limit, limit))
    }
}
