//! The results of a run: evenly spaced samples, the ledger of its steps, and their number.

use precess_dynamics::State;

use crate::ledger::{Entry, Ledger};
use crate::scenario::Set;

/// A run's results.
#[derive(Clone, Debug)]
pub struct History<const N: usize> {
    /// Samples at the rate of the settings, the last one at the end of the run.
    pub samples: Vec<Sample<N>>,
    /// Energy, work and momentum at the start and after each accepted step.
    pub ledger: Ledger,
    /// What the run cost.
    pub steps: Steps,
}

/// The state at one instant, and its entry for the ledger.
#[derive(Clone, Copy, Debug)]
pub struct Sample<const N: usize> {
    /// Time since the start, s.
    pub time: f64,
    /// State, quaternion of unit norm, wheel angle counted on through every turn.
    pub state: State<Set<N>>,
    /// Energy, work and momentum.
    pub entry: Entry,
}

/// Counts of an adaptive run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Steps {
    /// Steps accepted.
    pub accepted: usize,
    /// Steps rejected.
    pub rejected: usize,
    /// Evaluations of the equations of motion, those of the samples included.
    pub evaluations: usize,
}

impl<const N: usize> History<N> {
    /// Largest magnitude of the hub's angular velocity over the samples, rad/s.
    #[must_use]
    pub fn omega_peak(&self) -> f64 {
        self.samples.iter().map(|s| s.state.omega.norm()).fold(0.0, f64::max)
    }

    /// Distance of B from where it started, at the end of the run, m.
    #[must_use]
    pub fn position_drift(&self) -> f64 {
        match (self.samples.first(), self.samples.last()) {
            (Some(first), Some(last)) => (last.state.r_b_n - first.state.r_b_n).norm(),
            _ => 0.0,
        }
    }

    /// The ledger of the samples instead of the steps.
    #[must_use]
    pub fn sampled_ledger(&self) -> Ledger {
        Ledger { entries: self.samples.iter().map(|s| s.entry).collect() }
    }
}
