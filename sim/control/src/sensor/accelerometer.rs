//! [`Accelerometer`]: three axes with white noise and bias.

use nalgebra::Vector3;

use crate::checkpoint::Checkpoint;
use crate::model::error::{self, ControlError};
use crate::sensor::noise::Noise;
use crate::sensor::quantum::Quantum;

/// Parameters of an accelerometer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AccelerometerParameters {
    /// Time from sample to sample, s.
    pub period: f64,
    /// Root of the one-sided density of the noise, m/s²/sqrt(Hz): up to half of the rate, so that a sample has the variance
    /// `density² / (2 T)`.
    pub noise_density: f64,
    /// Bias, m/s².
    pub bias: Vector3<f64>,
    /// Step of a reading, m/s²; zero for none.
    pub quantum: f64,
}

/// An accelerometer at a point.
#[derive(Clone, Debug, PartialEq)]
pub struct Accelerometer {
    bias: Vector3<f64>,
    deviation: f64,
    quantum: Quantum,
    noise: Noise,
    sample: u64,
}

impl Accelerometer {
    /// With the numbers of a seed and a sensor's name.
    ///
    /// # Errors
    ///
    /// A parameter that is not in its range.
    pub fn new(
        parameters: &AccelerometerParameters,
        seed: u64,
        sensor: &str,
    ) -> Result<Self, ControlError> {
        let AccelerometerParameters { period, noise_density, bias, quantum } = *parameters;
        error::positive("sampling period", period)?;
        error::not_negative("noise density", noise_density)?;
        for value in bias.iter() {
            error::finite("bias", *value)?;
        }
        Ok(Self {
            bias,
            deviation: noise_density / libm::sqrt(2.0 * period),
            quantum: Quantum::new(quantum)?,
            noise: Noise::new(seed, sensor),
            sample: 0,
        })
    }

    /// What is read at the next sample of the specific force at its point, along the axes in which that is expressed, m/s².
    pub fn measure(&mut self, specific_force: &Vector3<f64>) -> Vector3<f64> {
        let [n0, n1, n2, ..] = self.noise.at(self.sample);
        self.sample += 1;
        let noise = Vector3::new(n0, n1, n2) * self.deviation;
        self.quantum.read_each(&(specific_force + self.bias + noise))
    }

    /// Visits what it keeps from sample to sample.
    pub fn visit(&mut self, checkpoint: &mut Checkpoint<'_>) {
        checkpoint.count(&mut self.sample);
    }
}
