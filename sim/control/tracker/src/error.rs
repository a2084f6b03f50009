//! [`TrackerError`]: what is wrong with a number.

use core::fmt;

/// A number that is not in its range; the tracker stays as it was.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TrackerError {
    /// It is infinite or NaN.
    NotFinite {
        /// Which.
        what: &'static str,
        /// Its value.
        value: f64,
    },
    /// It is outside its bounds, infinite or NaN.
    NotWithin {
        /// Which.
        what: &'static str,
        /// Its value.
        value: f64,
        /// The least and the largest.
        bounds: (f64, f64),
    },
}

impl fmt::Display for TrackerError {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite { what, value } => write!(to, "{what} is {value}; it must be finite"),
            Self::NotWithin { what, value, bounds: (least, largest) } => {
                write!(to, "{what} is {value}; it must be from {least} to {largest}")
            }
        }
    }
}

impl core::error::Error for TrackerError {}

/// Rejects what is not finite.
pub(crate) fn finite(what: &'static str, value: f64) -> Result<(), TrackerError> {
    if value.is_finite() { Ok(()) } else { Err(TrackerError::NotFinite { what, value }) }
}

/// Rejects what is outside its bounds.
pub(crate) fn within(
    what: &'static str,
    value: f64,
    bounds: (f64, f64),
) -> Result<(), TrackerError> {
    let sound = value >= bounds.0 && value <= bounds.1;
    if sound { Ok(()) } else { Err(TrackerError::NotWithin { what, value, bounds }) }
}
