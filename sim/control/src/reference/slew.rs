//! [`Slew`]: from rest to rest about the eigen-axis.

use nalgebra::Vector3;
use precess_dynamics::Quaternion;

use crate::model::error::{self, ControlError};
use crate::model::motion::Reference;
use crate::model::rotation::{from_vector, inverse, product, to_vector};
use crate::reference::Guidance;
use crate::reference::profile::{Profile, TurnLimits};

/// A turn about one axis, by the shorter way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slew {
    start: f64,
    from: Quaternion,
    axis: Vector3<f64>,
    profile: Profile,
}

impl Slew {
    /// From a time, s, and an attitude to another attitude, both of R relative to N.
    ///
    /// # Errors
    ///
    /// A time that is not finite, quaternions that are not an attitude, and errors of [`Profile::new`].
    pub fn new(
        start: f64,
        from: Quaternion,
        to: Quaternion,
        limits: &TurnLimits,
    ) -> Result<Self, ControlError> {
        error::finite("start", start)?;
        let from = error::attitude("attitude at the start", &from)?;
        let to = error::attitude("attitude at the end", &to)?;
        let vector = to_vector(&product(&inverse(&from), &to));
        let angle = vector.norm();
        let axis = if angle > 0.0 { vector / angle } else { Vector3::x() };
        Ok(Self { start, from, axis, profile: Profile::new(angle, limits)? })
    }

    /// The turn about its axis.
    #[must_use]
    pub fn profile(&self) -> &Profile {
        &self.profile
    }

    /// The axis, expressed in R (of any time: it does not move in R).
    #[must_use]
    pub fn axis(&self) -> Vector3<f64> {
        self.axis
    }

    /// When it ends, s.
    #[must_use]
    pub fn end(&self) -> f64 {
        self.start + self.profile.duration()
    }
}

impl Guidance for Slew {
    fn at(&self, time: f64) -> Reference {
        let point = self.profile.at(time - self.start);
        Reference {
            attitude: product(&self.from, &from_vector(&(self.axis * point.angle))),
            omega: self.axis * point.rate,
            omega_dot: self.axis * point.acceleration,
        }
    }
}
