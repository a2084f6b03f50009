//! [`ControlError`]: what is wrong with a parameter.

use core::fmt;

use nalgebra::Matrix3;
use precess_dynamics::{Attitude as _, Quaternion};

/// A parameter that is not in its range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ControlError {
    /// It is negative, infinite or NaN.
    Negative {
        /// Which.
        what: &'static str,
        /// Its value.
        value: f64,
    },
    /// It is zero, negative, infinite or NaN.
    NotPositive {
        /// Which.
        what: &'static str,
        /// Its value.
        value: f64,
    },
    /// It is infinite or NaN.
    NotFinite {
        /// Which.
        what: &'static str,
        /// Its value.
        value: f64,
    },
    /// A matrix is not symmetric: an element and the one opposite.
    NotSymmetric {
        /// Which.
        what: &'static str,
        /// An element above the diagonal.
        upper: f64,
        /// The one below it.
        lower: f64,
    },
    /// A quaternion has no length, or one that is not finite.
    NotAnAttitude {
        /// Which.
        what: &'static str,
    },
    /// A filter has a pole that is not stable: the lower two coefficients of its denominator.
    Unstable {
        /// Of the power below the highest.
        first: f64,
        /// Of the lowest power.
        second: f64,
    },
    /// A frequency is not below half of the sampling rate.
    AboveNyquist {
        /// It, rad/s.
        frequency: f64,
        /// Half of the sampling rate, rad/s.
        nyquist: f64,
    },
    /// A latency has more periods than there is room for.
    TooLong {
        /// Latency in periods.
        periods: f64,
        /// The longest.
        longest: f64,
    },
    /// A measurement is older than the samples that an estimator has kept, or has more samples than may be kept.
    TooOld {
        /// Its age in samples.
        age: usize,
        /// How many samples there are.
        kept: usize,
    },
    /// A table has no rows.
    NoRows,
    /// The time of a row, counted from zero, is not above that of the row before.
    NotIncreasing {
        /// Which row.
        row: usize,
        /// Its time, s.
        time: f64,
    },
    /// From the row before to this one, counted from zero, the frame turns by more than half a turn.
    TooCoarse {
        /// Which row.
        row: usize,
    },
    /// A number of rows or columns is not that of what it is multiplied with.
    Count {
        /// Of what.
        what: &'static str,
        /// How many there are.
        found: usize,
        /// How many there must be.
        wanted: usize,
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
    /// An iteration did not converge.
    NotConverged {
        /// Of what.
        what: &'static str,
    },
    /// A symmetric matrix is not positive definite.
    NotDefinite {
        /// Which.
        what: &'static str,
        /// A leading minor that is not positive; of a matrix that may be singular, a principal minor that is negative.
        minor: f64,
    },
}

impl fmt::Display for ControlError {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Negative { what, value } => {
                write!(to, "{what} is {value}; it must be finite and not negative")
            }
            Self::NotPositive { what, value } => {
                write!(to, "{what} is {value}; it must be finite and positive")
            }
            Self::NotFinite { what, value } => write!(to, "{what} is {value}; it must be finite"),
            Self::NotSymmetric { what, upper, lower } => {
                write!(to, "{what} is not symmetric: {upper} is opposite {lower}")
            }
            Self::NotAnAttitude { what } => {
                write!(to, "{what} is no attitude: its length is zero or not finite")
            }
            Self::Unstable { first, second } => {
                write!(
                    to,
                    "a filter whose denominator ends in {first}, {second} has a pole that is not stable"
                )
            }
            Self::AboveNyquist { frequency, nyquist } => write!(
                to,
                "{frequency} rad/s is not below half of the sampling rate, {nyquist} rad/s"
            ),
            Self::TooLong { periods, longest } => {
                write!(to, "a latency of {periods} periods is above {longest}")
            }
            Self::TooOld { age, kept } => {
                write!(to, "an age of {age} samples is above the {kept} that are kept")
            }
            Self::NoRows => write!(to, "the table has no rows"),
            Self::NotIncreasing { row, time } => {
                write!(to, "time {time} of row {row} is not above that of the row before")
            }
            Self::TooCoarse { row } => {
                write!(
                    to,
                    "between row {row} and the row before are more than half a turn; add rows"
                )
            }
            Self::Count { what, found, wanted } => {
                write!(to, "{what}: {found}; there must be {wanted}")
            }
            Self::NotWithin { what, value, bounds: (least, largest) } => {
                write!(to, "{what} is {value}; it must be from {least} to {largest}")
            }
            Self::NotConverged { what } => write!(to, "{what} did not converge"),
            Self::NotDefinite { what, minor } => {
                write!(to, "{what} is not positive definite: a minor is {minor}")
            }
        }
    }
}

impl core::error::Error for ControlError {}

/// Rejects what is not finite.
pub(crate) fn finite(what: &'static str, value: f64) -> Result<(), ControlError> {
    if value.is_finite() { Ok(()) } else { Err(ControlError::NotFinite { what, value }) }
}

/// Rejects a number of rows or columns that does not agree.
pub(crate) fn count(what: &'static str, found: usize, wanted: usize) -> Result<(), ControlError> {
    if found == wanted { Ok(()) } else { Err(ControlError::Count { what, found, wanted }) }
}

/// Rejects what is outside its bounds.
pub(crate) fn within(
    what: &'static str,
    value: f64,
    bounds: (f64, f64),
) -> Result<(), ControlError> {
    let sound = value >= bounds.0 && value <= bounds.1;
    if sound { Ok(()) } else { Err(ControlError::NotWithin { what, value, bounds }) }
}

/// Rejects what is not positive and finite.
pub(crate) fn positive(what: &'static str, value: f64) -> Result<(), ControlError> {
    let sound = value > 0.0 && value.is_finite();
    if sound { Ok(()) } else { Err(ControlError::NotPositive { what, value }) }
}

/// Rejects a limit that is zero, negative or NaN; an infinite one is none.
pub(crate) fn limit(what: &'static str, value: f64) -> Result<(), ControlError> {
    if value > 0.0 { Ok(()) } else { Err(ControlError::NotPositive { what, value }) }
}

/// The quaternion by unit length.
pub(crate) fn attitude(
    what: &'static str,
    quaternion: &Quaternion,
) -> Result<Quaternion, ControlError> {
    if quaternion.is_valid() {
        Ok(quaternion.normalised())
    } else {
        Err(ControlError::NotAnAttitude { what })
    }
}

/// Rejects what is negative or not finite.
pub(crate) fn not_negative(what: &'static str, value: f64) -> Result<(), ControlError> {
    let sound = value >= 0.0 && value.is_finite();
    if sound { Ok(()) } else { Err(ControlError::Negative { what, value }) }
}

/// Rejects a matrix that is not finite and symmetric.
fn symmetric(what: &'static str, matrix: &Matrix3<f64>) -> Result<(), ControlError> {
    for value in matrix.iter() {
        finite(what, *value)?;
    }
    for (upper, lower) in
        [(matrix.m12, matrix.m21), (matrix.m13, matrix.m31), (matrix.m23, matrix.m32)]
    {
        if upper != lower {
            return Err(ControlError::NotSymmetric { what, upper, lower });
        }
    }
    Ok(())
}

/// Rejects a matrix that is not symmetric and positive definite: its leading minors are positive.
pub(crate) fn definite(what: &'static str, matrix: &Matrix3<f64>) -> Result<(), ControlError> {
    symmetric(what, matrix)?;
    for minor in
        [matrix.m11, matrix.m11 * matrix.m22 - matrix.m12 * matrix.m12, matrix.determinant()]
    {
        if minor <= 0.0 {
            return Err(ControlError::NotDefinite { what, minor });
        }
    }
    Ok(())
}

/// Rejects a matrix that is not symmetric and positive semidefinite: its principal minors are not negative but for
/// rounding of their terms.
pub(crate) fn semidefinite(what: &'static str, matrix: &Matrix3<f64>) -> Result<(), ControlError> {
    /// A few roundings of the terms of a determinant, in units of the cube of the largest element.
    const ROUNDING: f64 = 1e-14;
    symmetric(what, matrix)?;
    let size = matrix.amax();
    let m = matrix;
    let minors = [
        (m.m11, 1.0),
        (m.m22, 1.0),
        (m.m33, 1.0),
        (m.m11 * m.m22 - m.m12 * m.m12, size),
        (m.m11 * m.m33 - m.m13 * m.m13, size),
        (m.m22 * m.m33 - m.m23 * m.m23, size),
        (m.determinant(), size * size),
    ];
    for (minor, unit) in minors {
        if minor < -ROUNDING * unit * size {
            return Err(ControlError::NotDefinite { what, minor });
        }
    }
    Ok(())
}
