//! [`Prepared`]: the model of a scenario for a budget, and the speeds at which it is swept.

use std::fmt;

use super::budget::Budget;
use super::campbell::{Branch, Crossing, branches, crossings, oscillations};
use super::coupled::CoupledError;
use super::device::Steady;
use super::model::Model;
use super::sweep::{refined, speeds};
use crate::scenario::Scenario;
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
        Ok(Self { model, has_imbalance, left_out, campbell_speeds, branches, crossings, speeds })
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
