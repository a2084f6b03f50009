//! [`MotorLimits`]: largest torque, power and rate of a motor.

use super::{Drive, Profile};

/// What a motor cannot exceed; each none where there is no limit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MotorLimits {
    /// Largest magnitude of its torque, N m, or force, N.
    pub torque: Option<f64>,
    /// Largest power that it delivers, W: torque times rate, where that is above zero.
    pub power: Option<f64>,
    /// Largest magnitude of the rate to which it drives its joint, rad/s or m/s.
    pub rate: Option<f64>,
}

impl MotorLimits {
    /// Whether what the motor does depends on the rate of its joint.
    #[must_use]
    pub fn depend_on_rate(&self) -> bool {
        self.power.is_some() || self.rate.is_some()
    }

    /// A torque within the largest one.
    #[must_use]
    pub fn clipped(&self, torque: f64) -> f64 {
        self.torque.map_or(torque, |limit| torque.clamp(-limit.abs(), limit.abs()))
    }
}

impl Drive {
    /// Its limits; all none of a drive without a motor torque.
    #[must_use]
    pub fn limits(&self) -> MotorLimits {
        match self {
            Self::Torque { limit: Some(limits), .. } => *limits,
            Self::Torque { limit: None, .. } | Self::Acceleration(_) | Self::Locked => {
                MotorLimits::default()
            }
        }
    }

    /// Its profile; none of a locked joint.
    #[must_use]
    pub fn profile(&self) -> Option<&Profile> {
        match self {
            Self::Torque { profile, .. } | Self::Acceleration(profile) => Some(profile),
            Self::Locked => None,
        }
    }
}
