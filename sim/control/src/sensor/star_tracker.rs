//! [`StarTracker`]: attitude with noise about the axes of the sensor.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::{Attitude as _, Quaternion};

use crate::checkpoint::Checkpoint;
use crate::model::error::{self, ControlError};
use crate::model::rotation::{from_vector, product};
use crate::sensor::noise::Noise;

/// A star tracker, whose frame S is fixed in B.
#[derive(Clone, Debug, PartialEq)]
pub struct StarTracker {
    mount: Quaternion,
    deviations: Vector3<f64>,
    noise: Noise,
    sample: u64,
}

impl StarTracker {
    /// With the attitude of S relative to B, and the standard deviations of the noise about the axes of S, rad: about the
    /// boresight it is larger than across.
    ///
    /// # Errors
    ///
    /// A quaternion that is not an attitude, a deviation that is negative or not finite.
    pub fn new(
        mount: Quaternion,
        deviations: Vector3<f64>,
        seed: u64,
        sensor: &str,
    ) -> Result<Self, ControlError> {
        for value in deviations.iter() {
            error::not_negative("deviation", *value)?;
        }
        let mount = error::attitude("mount", &mount)?;
        Ok(Self { mount, deviations, noise: Noise::new(seed, sensor), sample: 0 })
    }

    /// Covariance of the noise, expressed in B, rad².
    #[must_use]
    pub fn covariance(&self) -> Matrix3<f64> {
        let squares = self.deviations.map(|deviation| deviation * deviation);
        let to_s = self.mount.dcm();
        let covariance = to_s.transpose() * Matrix3::from_diagonal(&squares) * to_s;
        (covariance + covariance.transpose()) * 0.5
    }

    /// What is read of an attitude of B relative to N at the next sample: the attitude, turned by the noise about B axes.
    pub fn measure(&mut self, attitude: &Quaternion) -> Quaternion {
        let [n0, n1, n2, ..] = self.noise.at(self.sample);
        self.sample += 1;
        let error = Vector3::new(n0, n1, n2).component_mul(&self.deviations);
        product(attitude, &from_vector(&(self.mount.dcm().transpose() * error)))
    }

    /// Visits what it keeps from sample to sample.
    pub fn visit(&mut self, checkpoint: &mut Checkpoint<'_>) {
        checkpoint.count(&mut self.sample);
    }
}
