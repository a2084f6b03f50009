//! [`Quantum`]: the step of a reading, as of a tachometer or an encoder.

use nalgebra::Vector3;

use crate::model::error::{self, ControlError};

/// Readings are whole multiples of a step, the nearest (half a step away from zero); with a step of zero the truth.
///
/// An encoder's step is an angle, rad, a tachometer's a rate, rad/s.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Quantum {
    step: f64,
}

impl Quantum {
    /// Of a step, zero for none.
    ///
    /// # Errors
    ///
    /// A step that is negative or not finite.
    pub fn new(step: f64) -> Result<Self, ControlError> {
        error::not_negative("quantum", step)?;
        Ok(Self { step })
    }

    /// What is read of a value.
    #[must_use]
    pub fn read(&self, value: f64) -> f64 {
        if self.step > 0.0 { self.step * libm::round(value / self.step) } else { value }
    }

    /// What is read of each component.
    #[must_use]
    pub fn read_each(&self, value: &Vector3<f64>) -> Vector3<f64> {
        value.map(|component| self.read(component))
    }
}
