//! The bound on the drifts of a run, and the error of a run that exceeds it.
//!
//! Energy less work and both momenta, each in its unit of [`crate::ledger`], stay within the bound
//! over ten seconds at tolerance 1e-13. A run that is no longer and has no larger tolerance fails
//! if it drifts further; for other runs the bound does not hold.

use std::fmt;

use crate::ledger::Drift;
use crate::run::Settings;

/// Largest drift of energy less work and of both momenta: a hundred times what a good
/// integrator reaches over ten seconds of Table 1.
pub const BOUND: f64 = 1e-12;

/// What should not drift.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Energy less work.
    Energy,
    /// Linear momentum.
    Linear,
    /// Angular momentum about the inertial origin.
    Angular,
}

/// One drift beyond the bound.
#[derive(Clone, Debug, PartialEq)]
pub struct Excess {
    /// The variant's name.
    pub scenario: String,
    /// What drifts.
    pub quantity: Quantity,
    /// How far, in its unit; NaN if the run lost itself.
    pub drift: f64,
}

/// Drifts are beyond the bound although the settings promise it.
#[derive(Clone, Debug, PartialEq)]
pub struct BoundError {
    /// Every one of them.
    pub excesses: Vec<Excess>,
}

/// Whether the settings are within those that the bound is promised for.
#[must_use]
pub fn promised(settings: &Settings) -> bool {
    let default = Settings::default();
    settings.duration <= default.duration && settings.tolerance <= default.tolerance
}

/// The drifts of one variant that are beyond the bound; one that is no number is.
#[must_use]
pub fn excesses(scenario: &str, drift: &Drift) -> Vec<Excess> {
    let Drift { energy, linear, angular } = *drift;
    [(Quantity::Energy, energy), (Quantity::Linear, linear), (Quantity::Angular, angular)]
        .into_iter()
        .filter(|(_, drift)| drift.is_nan() || *drift > BOUND)
        .map(|(quantity, drift)| Excess { scenario: scenario.to_owned(), quantity, drift })
        .collect()
}

/// Holds drifts beyond the bound against the settings they come from.
///
/// # Errors
/// If there are any, and the settings promise that there are none.
pub fn hold(settings: &Settings, excesses: Vec<Excess>) -> Result<(), BoundError> {
    if excesses.is_empty() || !promised(settings) { Ok(()) } else { Err(BoundError { excesses }) }
}

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Energy => "energy less work",
            Self::Linear => "linear momentum",
            Self::Angular => "angular momentum",
        })
    }
}

impl fmt::Display for Excess {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { scenario, quantity, drift } = self;
        let times = drift / BOUND;
        write!(f, "{scenario}: {quantity} drifts by {drift:.1e}, {times:.1} times the bound")
    }
}

impl fmt::Display for BoundError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for excess in &self.excesses {
            write!(f, "{excess}; ")?;
        }
        write!(
            f,
            "{BOUND:e} is promised at this tolerance and duration, so do not rely on the files \
             written: this is a fault of the program"
        )
    }
}

impl std::error::Error for BoundError {}

#[cfg(test)]
mod tests {
    use super::*;

    const GOOD: Drift = Drift { energy: 1e-14, linear: 1e-12, angular: 0.0 };

    fn held(settings: Settings, drift: Drift) -> Result<(), String> {
        hold(&settings, excesses("table1-printed-200", &drift)).map_err(|e| e.to_string())
    }

    #[test]
    fn a_drift_beyond_the_bound_fails_with_variant_and_amount() {
        assert_eq!(held(Settings::default(), GOOD), Ok(()));
        let text = held(Settings::default(), Drift { linear: 2.5e-12, ..GOOD });
        let expected = "table1-printed-200: linear momentum drifts by 2.5e-12, 2.5 times the \
                        bound; 1e-12 is promised at this tolerance and duration, so do not rely \
                        on the files written: this is a fault of the program";
        assert_eq!(text, Err(expected.to_owned()));
    }

    #[test]
    fn every_quantity_is_held_and_no_number_is_no_excuse() {
        let broken = [
            (Drift { energy: 2e-12, ..GOOD }, "energy less work drifts by 2.0e-12"),
            (Drift { angular: 1.0, ..GOOD }, "angular momentum drifts by 1.0e0"),
            (Drift { energy: f64::NAN, ..GOOD }, "energy less work drifts by NaN"),
        ];
        for (drift, words) in broken {
            let text = held(Settings::default(), drift).expect_err(words);
            assert!(text.contains(words), "{text}");
        }
    }

    #[test]
    fn a_looser_or_longer_run_has_been_told_to_drift() {
        let default = Settings::default();
        let far = Drift { energy: 1e-6, ..GOOD };
        assert_eq!(held(Settings { tolerance: 2e-13, ..default }, far), Ok(()));
        assert_eq!(held(Settings { duration: 10.5, ..default }, far), Ok(()));
        assert!(held(Settings { duration: 5.0, rate: 100.0, ..default }, far).is_err());
    }
}
