//! [`RequirementState`]: what became of a requirement, and [`NoData`]: why it could not be evaluated.

use std::fmt;

use super::Margin;
use crate::units::Plain;

/// What became of a requirement. One without data is neither met nor violated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RequirementState {
    /// The value is not above the limit.
    Met,
    /// The value is above the limit.
    Violated,
    /// Nothing was measured.
    NotEvaluated(NoData),
}

/// Why a requirement could not be evaluated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NoData {
    /// No sample fell into its window.
    NoSample {
        /// The window, s.
        window: [f64; 2],
    },
    /// The run ended before the end of its window.
    WindowNotRun {
        /// When the run ended, s.
        end: f64,
        /// The end of the window, s.
        to: f64,
    },
    /// What its statistic needs is longer than its window.
    Short {
        /// The exposure or window of the statistic, with its stability time, s.
        needed: f64,
        /// Length of the requirement's window, s.
        length: f64,
    },
    /// A spectrum needs more samples than its window has.
    FewSamples {
        /// Fewest samples.
        least: usize,
        /// Length of the requirement's window, s.
        length: f64,
    },
    /// No frequency of the spectrum lies in the band.
    NoBin {
        /// The band, Hz.
        band: [f64; 2],
        /// Distance of the frequencies of the spectrum, Hz.
        resolution: f64,
    },
    /// No tone and no noise lies in the band at any speed.
    NoLine {
        /// The band, Hz.
        band: [f64; 2],
    },
    /// No tone and no noise has a share in exposures so long or so short.
    NoShare {
        /// The exposure, s.
        exposure: f64,
    },
    /// A run of a campaign has no number for it.
    NoNumber,
    /// The value is not a number.
    NotANumber,
}

impl RequirementState {
    /// Of a margin; a value that is no number is no measurement.
    #[must_use]
    pub fn from_margin(margin: &Margin) -> Self {
        if margin.value.is_nan() || margin.limit.is_nan() {
            Self::NotEvaluated(NoData::NotANumber)
        } else if margin.is_met() {
            Self::Met
        } else {
            Self::Violated
        }
    }

    /// Of the numbers of a campaign's runs, none where a run has none: violated where one is above the limit.
    #[must_use]
    pub fn from_numbers(numbers: &[Option<f64>], limit: f64) -> Self {
        if numbers.iter().flatten().any(|number| *number > limit) {
            Self::Violated
        } else if numbers.iter().any(Option::is_none) {
            Self::NotEvaluated(NoData::NoNumber)
        } else {
            Self::Met
        }
    }

    /// Whether it is met.
    #[must_use]
    pub fn is_met(&self) -> bool {
        matches!(self, Self::Met)
    }

    /// Whether it is violated.
    #[must_use]
    pub fn is_violated(&self) -> bool {
        matches!(self, Self::Violated)
    }

    /// The state in words: `met`, `violated`, `not evaluated`.
    #[must_use]
    pub const fn word(&self) -> &'static str {
        match self {
            Self::Met => "met",
            Self::Violated => "violated",
            Self::NotEvaluated(_) => "not evaluated",
        }
    }

    /// Why it could not be evaluated; none of one that was.
    #[must_use]
    pub const fn reason(&self) -> Option<&NoData> {
        match self {
            Self::NotEvaluated(reason) => Some(reason),
            Self::Met | Self::Violated => None,
        }
    }
}

/// The state in words, with the reason: `not evaluated: no sample in 2 s to 3 s`.
impl fmt::Display for RequirementState {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.word())?;
        self.reason().map_or(Ok(()), |reason| write!(f, ": {reason}"))
    }
}

impl fmt::Display for NoData {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::NoSample { window: [from, to] } => write!(
                f,
                "no sample in {} s to {} s; raise output.rate or choose another window",
                Plain(from),
                Plain(to)
            ),
            Self::WindowNotRun { end, to } => {
                write!(
                    f,
                    "the run ended at {end:.6} s, before the end of the window at {} s",
                    Plain(to)
                )
            }
            Self::Short { needed, length } => write!(
                f,
                "the statistic needs {} s, its window has {} s; run longer or choose shorter ones",
                rounded(needed),
                Plain(length)
            ),
            Self::FewSamples { least, length } => write!(
                f,
                "a spectrum needs {least} samples, its window of {} s has fewer; raise output.rate or \
                 run longer",
                Plain(length)
            ),
            Self::NoBin { band: [from, to], resolution } => {
                write!(
                    f,
                    "no frequency of the spectrum, multiples of {} Hz above 0, is within {} Hz to {} Hz; \
                     run longer or choose a wider band",
                    rounded(resolution),
                    Plain(from),
                    Plain(to)
                )
            }
            Self::NoLine { band: [from, to] } => write!(
                f,
                "no tone and no noise is within {} Hz to {} Hz at any speed; choose another band",
                Plain(from),
                Plain(to)
            ),
            Self::NoShare { exposure } => write!(
                f,
                "no tone and no noise has a share in exposures of {} s; choose another exposure",
                Plain(exposure)
            ),
            Self::NoNumber => f.write_str("a sample has no number for it"),
            Self::NotANumber => f.write_str("its value is not a number"),
        }
    }
}

/// A sum or a quotient in six digits, without those of its rounding.
fn rounded(value: f64) -> Plain {
    Plain(format!("{value:.5e}").parse().unwrap_or(value))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_that_is_no_number_is_neither_met_nor_violated() {
        let state = |value, limit| RequirementState::from_margin(&Margin { value, limit });
        assert_eq!(state(1.0, 1.0), RequirementState::Met);
        assert_eq!(state(1.1, 1.0), RequirementState::Violated);
        assert_eq!(state(f64::NAN, 1.0), RequirementState::NotEvaluated(NoData::NotANumber));
    }

    #[test]
    fn one_number_above_the_limit_outweighs_those_that_are_missing() {
        let state = |numbers: &[Option<f64>]| RequirementState::from_numbers(numbers, 1.0).word();
        assert_eq!(state(&[Some(0.5), Some(1.0)]), "met");
        assert_eq!(state(&[Some(0.5), None]), "not evaluated");
        assert_eq!(state(&[Some(2.0), None]), "violated");
    }
}
