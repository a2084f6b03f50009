//! [`PointingError`]: what no metric can be computed of.

use std::fmt;

use crate::spectra::SpectrumError;
use crate::units::Plain;

/// What no metric can be computed of.
#[derive(Clone, Debug, PartialEq)]
pub enum PointingError {
    /// A window is not a whole number of samples, too short or too long.
    Window {
        /// Its length, s.
        window: f64,
        /// Samples per second, 1/s.
        rate: f64,
        /// Fewest samples.
        least: usize,
    },
    /// A time is not a positive finite number, s.
    Time(f64),
    /// A stability time is not a whole multiple of the window.
    Stability {
        /// Between the starts of two windows, s.
        stability: f64,
        /// Length of a window, s.
        window: f64,
    },
    /// A history is too short for one value.
    Short {
        /// Its samples.
        samples: usize,
        /// Fewest samples.
        least: usize,
    },
    /// A level of probability is not between zero and one.
    Level(f64),
    /// An interpretation that is not defined for this input.
    Interpretation {
        /// What is evaluated, and of what.
        of: &'static str,
    },
    /// Too few runs for a level with a confidence.
    Runs {
        /// Runs there are.
        runs: usize,
        /// Probability.
        level: f64,
        /// Confidence in it.
        confidence: f64,
    },
    /// A number is not finite, or negative where that has no meaning.
    Number {
        /// What it is.
        of: &'static str,
        /// Which one, from 0.
        index: usize,
        /// Its value.
        value: f64,
    },
    /// Frequencies of a table do not rise.
    Order {
        /// The first that does not, from 0.
        index: usize,
    },
    /// Motions and sensitivities are not of the same nodes.
    Nodes {
        /// Nodes with sensitivities.
        expected: usize,
        /// Motions.
        found: usize,
    },
    /// A boresight without direction, or a direction along it.
    Boresight([f64; 3]),
    /// A spectrum could not be computed.
    Spectrum(SpectrumError),
}

impl fmt::Display for PointingError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Window { window, rate, least } => write!(
                f,
                "a window of {window} s is {:.4} samples at {rate} 1/s; it is a whole number of \
                 samples, {least} to 4194304: choose another window or rate",
                window * rate,
                window = Plain(*window),
                rate = Plain(*rate)
            ),
            Self::Time(time) => {
                write!(f, "a time of {time} s; it is a positive finite number", time = Plain(*time))
            }
            Self::Stability { stability, window } => write!(
                f,
                "a stability time of {stability} s is not a whole multiple of the window of {window} \
                 s; choose 1, 2, 3 ... times the window",
                window = Plain(*window),
                stability = Plain(*stability)
            ),
            Self::Short { samples, least } => write!(
                f,
                "a history of {samples} samples; at least {least} are needed: record a longer run, \
                 or choose a shorter window"
            ),
            Self::Level(level) => {
                write!(
                    f,
                    "a level of {level} is not between 0 and 1; write 0.997",
                    level = Plain(*level)
                )
            }
            Self::Interpretation { of } => {
                write!(f, "{of} is not defined; choose another interpretation or input")
            }
            Self::Runs { runs, level, confidence } => write!(
                f,
                "{runs} runs state no bound of level {level} with confidence {confidence}; at least \
                 {:.0} are needed",
                ((1.0 - confidence).ln() / level.ln()).ceil(),
                level = Plain(*level)
            ),
            Self::Number { of, index, value } => {
                write!(
                    f,
                    "{of} {index} is {value}; it is a finite number of the right sign",
                    value = Plain(*value)
                )
            }
            Self::Order { index } => {
                write!(f, "frequency {index} is not above the one before it; sort them")
            }
            Self::Nodes { expected, found } => write!(
                f,
                "{found} motions for the sensitivities of {expected} nodes; give one for each"
            ),
            Self::Boresight([x, y, z]) => write!(
                f,
                "the direction {x}, {y}, {z} is zero, not finite or along the boresight; choose one \
                 across it",
                x = Plain(*x),
                y = Plain(*y),
                z = Plain(*z)
            ),
            Self::Spectrum(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for PointingError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Spectrum(error) => Some(error),
            _ => None,
        }
    }
}

impl From<SpectrumError> for PointingError {
    fn from(error: SpectrumError) -> Self {
        Self::Spectrum(error)
    }
}
