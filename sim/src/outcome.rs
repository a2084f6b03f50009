//! A scenario together with everything its run showed; the input of every output.

use precess_dynamics::{Spacecraft, Warning};

use crate::error::RunError;
use crate::history::History;
use crate::jitter::{Ripple, amplitudes, ripple};
use crate::ledger::Drift;
use crate::run::{Settings, run};
use crate::scenario::Scenario;

/// A scenario and its results.
pub struct Outcome<const N: usize> {
    /// What was run.
    pub scenario: Scenario<N>,
    /// How it was run.
    pub settings: Settings,
    /// The run.
    pub history: History<N>,
    /// Its jitter, empty if there is none to be seen (see [`ripple`]).
    pub ripple: Vec<Ripple>,
    /// The solver's warnings about the parameters.
    pub warnings: Vec<Warning>,
}

/// The few numbers that sum up an outcome.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Figures {
    /// Largest magnitude of the hub's angular velocity, rad/s.
    pub omega_peak: f64,
    /// Largest jitter of angular velocity, rad/s, and of position, m.
    pub jitter: Option<(f64, f64)>,
    /// Distance of B from where it started, at the end, m.
    pub position_drift: f64,
    /// Largest drift of what should not drift.
    pub drift: Drift,
}

/// Runs a scenario, and the same scenario with balanced wheels, to separate jitter from motion.
///
/// `progress` hears how much of both runs is done, 0 to 1.
///
/// # Errors
/// As [`run`].
pub fn outcome<const N: usize>(
    scenario: Scenario<N>,
    settings: Settings,
    progress: &mut dyn FnMut(f64),
) -> Result<Outcome<N>, RunError> {
    /// A balanced run takes larger steps; its samples are what costs.
    const BALANCED_SHARE: f64 = 0.4;
    let share = BALANCED_SHARE / settings.duration;
    let balanced = run(&scenario.balanced(), &settings, &mut |t| progress(share * t))?;
    let rest = (1.0 - BALANCED_SHARE) / settings.duration;
    let history = run(&scenario, &settings, &mut |t| progress(BALANCED_SHARE + rest * t))?;
    let spacecraft =
        Spacecraft::new(&scenario.hub, &scenario.devices).map_err(RunError::Parameters)?;
    let warnings = spacecraft.warnings().collect();
    let ripple = ripple(&history, &balanced);
    Ok(Outcome { scenario, settings, history, ripple, warnings })
}

impl<const N: usize> Outcome<N> {
    /// The numbers that sum it up.
    #[must_use]
    pub fn figures(&self) -> Figures {
        Figures {
            omega_peak: self.history.omega_peak(),
            jitter: amplitudes(&self.ripple),
            position_drift: self.history.position_drift(),
            drift: self.history.ledger.drift(),
        }
    }
}
