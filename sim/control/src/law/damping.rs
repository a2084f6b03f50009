//! [`RateDamping`]: a torque against the angular velocity, as after separation.

use nalgebra::{Matrix3, Vector3};

use crate::law::{Law, Sample};
use crate::model::error::{self, ControlError};

/// `u = -D omega_bn`. Of a rigid body with energy `T = omega_bn . I omega_bn / 2`, in any gyroscopic torque,
/// `T' = -omega_bn . D omega_bn`. Attitude and reference are not read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RateDamping {
    rate: Matrix3<f64>,
}

impl RateDamping {
    /// With `D`, N m s: positive definite.
    ///
    /// # Errors
    ///
    /// A gain whose symmetric part is not positive definite.
    pub fn new(rate: Matrix3<f64>) -> Result<Self, ControlError> {
        error::definite("rate gain", &(rate + rate.transpose()))?;
        Ok(Self { rate })
    }
}

impl Law for RateDamping {
    fn torque(&mut self, sample: &Sample) -> Vector3<f64> {
        -(self.rate * sample.motion.omega)
    }

    fn reset(&mut self) {}
}
