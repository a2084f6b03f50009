//! [`WatchSettings`]: lengths of blocks and of the reference, and the rate of false alarms.

use super::error::WatchError;

/// Lengths and the rate of false alarms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WatchSettings {
    /// Length of a block, s.
    pub block: f64,
    /// From the first block on, the time in which the reference is taken, s.
    pub learn: f64,
    /// False alarms an hour, of all tests together.
    pub false_alarms: f64,
}

impl WatchSettings {
    /// That lengths are positive and finite.
    pub(super) fn check(&self) -> Result<(), WatchError> {
        for (what, value) in
            [("the length of a block", self.block), ("the time of the reference", self.learn)]
        {
            let sound = value > 0.0 && value.is_finite();
            if !sound {
                return Err(WatchError::Length { what, value });
            }
        }
        Ok(())
    }

    /// Blocks of the reference.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "positive, bounded"
    )]
    pub(super) fn blocks(&self) -> usize {
        (self.learn / self.block).round().clamp(1.0, 1e6) as usize
    }
}
