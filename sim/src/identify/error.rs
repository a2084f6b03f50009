//! [`IdentifyError`]: why nothing is identified.

use std::fmt;

use precess_dynamics::{DerivativeError, ParameterError, SolveError, UnsupportedParameter};

use crate::telemetry::LayoutError;
use crate::units::Plain;

/// Why nothing is identified.
#[derive(Clone, Debug, PartialEq)]
pub enum IdentifyError {
    /// The scenario has what the estimation does not.
    Unsupported {
        /// What.
        what: &'static str,
    },
    /// Its controller, which says what the sensors are.
    Layout(LayoutError),
    /// A reading that is needed is missing in the telemetry.
    NoReadings {
        /// Of which sensor.
        sensor: String,
    },
    /// The noise of a sensor is not stated.
    NoNoise {
        /// Of which.
        sensor: String,
        /// What states it.
        key: &'static str,
    },
    /// Too few readings.
    Few {
        /// How many.
        found: usize,
        /// How many are needed.
        needed: usize,
    },
    /// A number is unknown twice.
    Twice {
        /// Its name.
        name: String,
    },
    /// Nothing is unknown.
    Nothing,
    /// A device without a wheel that may be off balance.
    NoWheel {
        /// Its name.
        device: String,
    },
    /// Coulomb friction without the rate below which it fades.
    NoCoulombRate {
        /// The joint.
        joint: String,
    },
    /// The gyro's axes or unit are others than the model's.
    Axes {
        /// What would agree: `x reads -y, y reads x`.
        what: String,
        /// Share of the readings' variance that the model explains as they are, and so.
        explained: [f64; 2],
    },
    /// Columns of wheels are those of others.
    Wheels {
        /// What would agree: `rw1.spin is the column rw2.spin`.
        what: String,
        /// The readings that say so.
        of: &'static str,
        /// Share of their variance that the model explains as they are, and so.
        explained: [f64; 2],
    },
    /// A tachometer's unit or a motor's is another.
    Unit {
        /// The sensor.
        sensor: String,
        /// The unit in which it would agree.
        unit: &'static str,
        /// The key that states it.
        key: &'static str,
        /// What it reads by what the model has.
        ratio: f64,
    },
    /// A spacecraft with the numbers of a step is none.
    Parameters(ParameterError<f64>),
    /// A device with them is none.
    Device(UnsupportedParameter),
    /// The motion cannot be computed.
    Solve(SolveError),
    /// Its derivatives cannot.
    Derivatives(DerivativeError),
    /// A motion that leaves all bounds.
    Diverged {
        /// When, s.
        time: f64,
    },
    /// No step makes the readings more probable, and none is small.
    NotConverged {
        /// The largest step by its standard deviation.
        step: f64,
    },
    /// Manoeuvres are compared, and only the bias of the gyro is unknown.
    NothingOfSpacecraft,
    /// A manoeuvre whose information is not computed.
    Manoeuvre {
        /// Its name.
        name: String,
        /// Why.
        reason: String,
    },
    /// The normal equations have no solution.
    Singular,
    /// It was interrupted.
    Interrupted,
}

impl fmt::Display for IdentifyError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unsupported { what } => {
                write!(
                    f,
                    "the scenario has {what}, of which the estimation has no derivatives; remove it"
                )
            }
            Self::Layout(error) => error.fmt(f),
            Self::NoReadings { sensor } => write!(
                f,
                "the telemetry has no readings of the {sensor}; add its columns, or remove what needs it"
            ),
            Self::NoNoise { sensor, key } => {
                write!(f, "the noise of the {sensor} is unknown; state `{key}`")
            }
            Self::Few { found, needed } => write!(
                f,
                "there are {found} readings, and {needed} numbers are to be found; take a longer record"
            ),
            Self::Twice { name } => write!(f, "`{name}` is unknown twice; state it once"),
            Self::Nothing => f.write_str("nothing is unknown; state `[unknown]`"),
            Self::NoWheel { device } => write!(
                f,
                "`{device}` has no wheel with an imbalance; take a kind that has one, or remove `imbalance`"
            ),
            Self::NoCoulombRate { joint } => write!(
                f,
                "`{joint}` states no rate below which its Coulomb friction fades; state `coulomb_rate` in the scenario"
            ),
            Self::Axes { what, explained: [as_it_is, so] } => write!(
                f,
                "the gyro's axes or unit are others than the model's: if {what}, the model explains {:.0} % of its variance, and as it \
                 is {:.0} %; correct the columns",
                100.0 * so,
                100.0 * as_it_is.max(0.0)
            ),
            Self::Wheels { what, of, explained: [as_it_is, so] } => write!(
                f,
                "columns of wheels are others than the model's: if {what}, the model explains {:.0} % of the variance of {of}, and as they \
                 are {:.0} %; correct the columns",
                100.0 * so,
                100.0 * as_it_is.max(0.0)
            ),
            Self::Unit { sensor, unit, key, ratio } => write!(
                f,
                "the {sensor} reads {} times what the model has: its unit is {unit}; state `{key} = \"{unit}\"`",
                Plain(*ratio)
            ),
            Self::Parameters(error) => error.fmt(f),
            Self::Device(error) => error.fmt(f),
            Self::Solve(error) => error.fmt(f),
            Self::Derivatives(error) => error.fmt(f),
            Self::Diverged { time } => write!(
                f,
                "the motion leaves all bounds at {} s: first guesses too far from the truth; state priors, or cut the record",
                Plain(*time)
            ),
            Self::NotConverged { step } => write!(
                f,
                "the estimation has not converged, and its last step was {} standard deviations; state priors, or better first values \
                 in the scenario",
                Plain(*step)
            ),
            Self::NothingOfSpacecraft => f.write_str(
                "manoeuvres tell numbers of the spacecraft, and of those none is unknown; state one in `[unknown]`",
            ),
            Self::Manoeuvre { name, reason } => write!(f, "of the manoeuvre `{name}`: {reason}"),
            Self::Singular => f.write_str("the normal equations have no solution; state priors"),
            Self::Interrupted => f.write_str("it was interrupted"),
        }
    }
}

impl std::error::Error for IdentifyError {}

impl From<LayoutError> for IdentifyError {
    fn from(error: LayoutError) -> Self {
        Self::Layout(error)
    }
}

impl From<ParameterError<f64>> for IdentifyError {
    fn from(error: ParameterError<f64>) -> Self {
        Self::Parameters(error)
    }
}

impl From<UnsupportedParameter> for IdentifyError {
    fn from(error: UnsupportedParameter) -> Self {
        Self::Device(error)
    }
}

impl From<SolveError> for IdentifyError {
    fn from(error: SolveError) -> Self {
        Self::Solve(error)
    }
}

impl From<DerivativeError> for IdentifyError {
    fn from(error: DerivativeError) -> Self {
        Self::Derivatives(error)
    }
}
