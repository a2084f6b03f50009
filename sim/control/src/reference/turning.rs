//! [`Turning`]: a frame that turns at a constant rate, as an orbital frame does in a circular orbit; and [`Hold`].

use nalgebra::Vector3;
use precess_dynamics::Quaternion;

use crate::model::error::{self, ControlError};
use crate::model::motion::Reference;
use crate::model::rotation::{from_vector, product};
use crate::reference::Guidance;

/// A frame at rest in N.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hold {
    attitude: Quaternion,
}

impl Hold {
    /// Of an attitude of R relative to N.
    ///
    /// # Errors
    ///
    /// A quaternion that is not an attitude.
    pub fn new(attitude: Quaternion) -> Result<Self, ControlError> {
        Ok(Self { attitude: error::attitude("attitude", &attitude)? })
    }
}

impl Guidance for Hold {
    fn at(&self, _: f64) -> Reference {
        Reference::at_rest(self.attitude)
    }
}

/// A frame that turns about one axis at a constant rate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turning {
    time: f64,
    attitude: Quaternion,
    omega: Vector3<f64>,
}

impl Turning {
    /// From its attitude relative to N at a time, s, and its angular velocity relative to N, expressed in R, rad/s.
    ///
    /// In a circular orbit of rate n the frame with z to the centre and y against the orbit's normal turns by
    /// `(0, -n, 0)`: nadir.
    ///
    /// # Errors
    ///
    /// A number that is not finite, or a quaternion that is not an attitude.
    pub fn new(time: f64, attitude: Quaternion, omega: Vector3<f64>) -> Result<Self, ControlError> {
        error::finite("time", time)?;
        for value in omega.iter() {
            error::finite("rate", *value)?;
        }
        Ok(Self { time, attitude: error::attitude("attitude", &attitude)?, omega })
    }
}

impl Guidance for Turning {
    fn at(&self, time: f64) -> Reference {
        let turn = from_vector(&(self.omega * (time - self.time)));
        Reference {
            attitude: product(&self.attitude, &turn),
            omega: self.omega,
            omega_dot: Vector3::zeros(),
        }
    }
}
