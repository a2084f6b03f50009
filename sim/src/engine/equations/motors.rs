//! [`MotorState`]: which of its limits a motor is at, and the torque that it then exerts.
//!
//! Within a segment a motor stays in one state, so that its torque is a smooth function of time and rate; a step ends
//! where the state changes (`engine::events::motors`).

use precess_control::Checkpoint;
use precess_dynamics::Mode;

use crate::scenario::MotorLimits;

/// Which limit a motor is at, beside its largest torque.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) enum MotorState {
    /// None: its torque is that of its profile, within the largest one.
    #[default]
    Commanded,
    /// It delivers its largest power.
    LargestPower,
    /// It holds the joint at the largest rate, of this sign.
    LargestRate(f64),
    /// The joint is beyond the largest rate, of this sign: it brakes with its largest torque.
    Beyond(f64),
}

/// A power beyond the largest one by less than this part of it is rounding.
pub(crate) const POWER: f64 = 1e-9;

/// The share of the torque of a profile that a limited one does not exceed, within a step that is not accepted.
const TORQUE_MAX: f64 = 2.0;

impl MotorState {
    /// Visits which limit it is.
    pub(crate) fn visit(&mut self, checkpoint: &mut Checkpoint<'_>) {
        let (mut limit, mut sign) = match *self {
            Self::Commanded => (0, 0.0),
            Self::LargestPower => (1, 0.0),
            Self::LargestRate(sign) => (2, sign),
            Self::Beyond(sign) => (3, sign),
        };
        checkpoint.index(&mut limit, 4);
        checkpoint.number(&mut sign);
        *self = match limit {
            0 => Self::Commanded,
            1 => Self::LargestPower,
            2 => Self::LargestRate(sign),
            _ => Self::Beyond(sign),
        };
    }

    /// Torque and mode of a joint at a rate, for the torque of a profile.
    pub(super) fn acting(self, profile: f64, limits: &MotorLimits, rate: f64) -> (f64, Mode) {
        let commanded = limits.clipped(profile);
        match (self, limits.power) {
            (Self::LargestPower, Some(power)) => {
                let torque = (power / rate.abs()).min(TORQUE_MAX * commanded.abs());
                (commanded.signum() * torque, Mode::Driven)
            }
            (Self::Commanded | Self::LargestPower, _) => (commanded, Mode::Driven),
            (Self::LargestRate(_), _) => (0.0, Mode::Prescribed(0.0)),
            (Self::Beyond(sign), _) => (-sign * limits.torque.unwrap_or(0.0).abs(), Mode::Driven),
        }
    }
}
