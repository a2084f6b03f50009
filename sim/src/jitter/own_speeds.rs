//! [`AtOwnSpeeds`]: what a budget says of the scenario as it is, with each rotor at its own initial rate.
//!
//! A sweep gives one speed to all rotors that it sweeps. Here none is swept: lines of rotors at several speeds have several
//! frequencies, whose mean squares are added whatever is assumed of the phases; lines of one frequency are added as in the sweep.

use super::budget::{Budget, outputs_of, state_of};
use super::device::Steady;
use super::model::Model;
use super::sweep::{Phases, sweep};
use super::weight::Weight;
use crate::pointing::{Margin, NoData, RequirementState};
use crate::scenario::Scenario;
use crate::structure::Fault;

/// A limit with the rotors at their own speeds.
#[derive(Clone, Debug, PartialEq)]
pub struct AtOwnSpeeds {
    /// The margin by each assumption about phases, in the order of [`Budget::assumptions`]: that of the budget first.
    pub by_phases: Vec<(Phases, Margin)>,
    /// Why it could not be evaluated: no line and no noise has a share in the metric.
    pub no_data: Option<NoData>,
}

impl AtOwnSpeeds {
    /// What becomes of the limit by the margin of an assumption.
    #[must_use]
    pub fn state(&self, margin: &Margin) -> RequirementState {
        state_of(self.no_data, margin)
    }
}

impl Budget {
    /// Each limit with every rotor of a scenario at its own initial rate, in order. Sources that the frequency domain does not
    /// have are left out, as in the sweep.
    ///
    /// # Errors
    /// As [`Model::new`] and [`Model::lines`]: a tone at a resonance without damping.
    pub fn at_own_speeds(&self, scenario: &Scenario) -> Result<Vec<AtOwnSpeeds>, Fault> {
        let steady = Steady { motor: self.motor, sprung: self.sprung, swept: None };
        let mut model = Model::new(scenario, &self.outputs(), &steady)?;
        model.add_sources(scenario)?;
        // No rotor has the speed that is swept: any speed gives the same.
        let found = sweep(&model, &[0.0], 1, &|_| {})?;
        let one = |(sight, limit): &(usize, crate::pointing::Limit)| {
            let weight = Weight::of_metric(&limit.metric).unwrap_or(Weight::one());
            let outputs = outputs_of(*sight);
            let margin = |phases| {
                let value = found.mean_square(0, &outputs, phases, &weight).sqrt();
                (phases, Margin { value, limit: limit.limit })
            };
            AtOwnSpeeds {
                by_phases: self.assumptions().into_iter().map(margin).collect(),
                no_data: weight.no_data().filter(|_| !found.has_share(&weight)),
            }
        };
        Ok(self.limits.iter().map(one).collect())
    }
}
