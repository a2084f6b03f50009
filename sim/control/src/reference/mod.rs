//! References: attitude, rate and its derivative of the frame R at a time.

pub(crate) mod profile;
pub(crate) mod slew;
pub(crate) mod table;
pub(crate) mod turning;

use crate::model::motion::Reference;

/// What the hub is to follow, as a function of time.
pub trait Guidance {
    /// The reference at a time, s. At a time that is not finite its numbers need not be, either.
    fn at(&self, time: f64) -> Reference;
}
