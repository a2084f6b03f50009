//! [`Prepared`]: the model of a scenario for a budget, and the speeds at which it is swept.

use std::fmt;

use super::budget::Budget;
use super::campbell::{Branch, Crossing, branches, crossings, oscillations};
use super::coupled::CoupledError;
use super::device::Steady;
use super::model::Model;
use super::sweep::{refined, speeds};
use crate::scenario::steady::SteadyJoints;
use crate::scenario::{Scenario, members};
use crate::structure::Fault;

/// Speeds of the Campbell diagram, between which crossings are found.
const CAMPBELL_SPEEDS: usize = 61;

/// The model of a scenario, ready for [`sweep`](super::sweep::sweep).
#[derive(Clone, Debug)]
pub struct Prepared {
    /// Structure, devices, sources and lines of sight.
    pub model: Model,
    /// Whether a rotor has tones of its own: the runs of [`compare`](super::coupled::compare) are without sources.
    pub has_imbalance: bool,
    /// Why sources of the scenario are not in the model.
    pub left_out: Vec<String>,
    /// Names of wheels of the scenario that are at rest: they do not turn at any speed of the sweep.
    pub at_rest: Vec<String>,
    /// Speeds at which natural frequencies were computed, rad/s.
    pub campbell_speeds: Vec<f64>,
    /// Natural frequencies over these speeds.
    pub branches: Vec<Branch>,
    /// Where orders of the tones meet them.
    pub crossings: Vec<Crossing>,
    /// Speeds of the sweep, rad/s: those of the budget, and more about each crossing.
    pub speeds: Vec<f64>,
}

/// Why a budget cannot be swept.
#[derive(Debug)]
pub enum PrepareError {
    /// A rotor of the budget that the scenario does not have.
    Rotor {
        /// The rotor.
        rotor: String,
        /// The scenario.
        scenario: String,
        /// Bodies of the scenario.
        bodies: Vec<String>,
    },
    /// A model that cannot be made, or that has neither tones nor noise.
    Model(CoupledError),
}

impl fmt::Display for PrepareError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Rotor { rotor, scenario, bodies } => write!(
                f,
                "speed.rotors: `{rotor}` is no body of the scenario {scenario}; write one of {}",
                bodies.join(", ")
            ),
            Self::Model(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for PrepareError {}

impl From<Fault> for PrepareError {
    fn from(fault: Fault) -> Self {
        Self::Model(fault.into())
    }
}

impl Prepared {
    /// The model of a scenario for a budget.
    ///
    /// # Errors
    /// [`PrepareError::Rotor`]; a model that cannot be made; one without tones and noise.
    pub fn new(scenario: &Scenario, budget: &Budget) -> Result<Self, PrepareError> {
        check_rotors(scenario, budget)?;
        let steady =
            Steady { motor: budget.motor, sprung: budget.sprung, swept: Some(&budget.swept) };
        let mut model = Model::new(scenario, &budget.outputs(), &steady)?;
        let has_imbalance = !model.contributors().is_empty();
        let left_out = model.add_sources(scenario)?;
        let contributors = model.contributors();
        if contributors.is_empty() && model.noises.is_empty() {
            return Err(PrepareError::Model(CoupledError::NoTones));
        }
        let campbell_speeds = speeds(budget.speeds, CAMPBELL_SPEEDS);
        let natural: Result<Vec<_>, _> =
            campbell_speeds.iter().map(|speed| oscillations(&model, *speed)).collect();
        let branches = branches(&campbell_speeds, &natural?);
        let mut orders: Vec<f64> = contributors.iter().map(|of| of.order).collect();
        orders.sort_by(f64::total_cmp);
        orders.dedup();
        let crossings = crossings(&campbell_speeds, &branches, &orders);
        let speeds = refined(speeds(budget.speeds, budget.count), budget.speeds, &crossings);
        let all: Vec<usize> = (0..members(&scenario.devices).len()).collect();
        let at_rest = SteadyJoints::new(scenario, &all, budget.motor, budget.sprung).at_rest;
        Ok(Self {
            model,
            has_imbalance,
            left_out,
            at_rest,
            campbell_speeds,
            branches,
            crossings,
            speeds,
        })
    }

    /// Of each wheel at rest that the budget sweeps, a sentence.
    #[must_use]
    pub fn warnings_at_rest(&self, budget: &Budget) -> Vec<String> {
        let is_swept = |name: &&String| budget.swept.is_empty() || budget.swept.contains(name);
        let text = |name: &String| {
            format!(
                "`{name}` is at rest in the scenario: it does not turn, and has no tones at any speed; give it a rate, whose sign \
                 is its direction"
            )
        };
        self.at_rest.iter().filter(is_swept).map(text).collect()
    }

    /// The rotors that have the speed of the sweep, in words: all, how many where some are at rest, or the names of the budget.
    #[must_use]
    pub fn rotors(&self, budget: &Budget) -> String {
        if self.at_rest.is_empty() && budget.swept.is_empty() {
            return "all rotors".to_owned();
        }
        if budget.swept.is_empty() {
            let rotors = self.model.devices.iter().flat_map(|(_, device)| &device.rotors);
            let turning = rotors.filter(|rotor| rotor.is_swept()).count();
            let (all, at_rest) = (turning + self.at_rest.len(), self.at_rest.join(", "));
            return format!("{turning} of {all} rotors; at rest: {at_rest}");
        }
        let name = |name: &String| {
            let at_rest = if self.at_rest.contains(name) { " (at rest)" } else { "" };
            format!("{name}{at_rest}")
        };
        budget.swept.iter().map(name).collect::<Vec<_>>().join(", ")
    }
}

/// Rotors of a budget are rotors of its scenario.
fn check_rotors(scenario: &Scenario, budget: &Budget) -> Result<(), PrepareError> {
    let bodies: Vec<String> =
        scenario.joints().map(|(_, name, info)| format!("{name}.{}", info.body)).collect();
    let unknown = budget.swept.iter().find(|rotor| !bodies.contains(rotor));
    unknown.map_or(Ok(()), |rotor| {
        let (rotor, scenario) = (rotor.clone(), scenario.name.clone());
        Err(PrepareError::Rotor { rotor, scenario, bodies })
    })
}
