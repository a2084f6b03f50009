//! [`Craft`]: what the engine evaluates, a rigid hub or a structure that bends, each with the
//! devices of the scenario.
//!
//! State, inputs and accelerations are those of a structure; on a rigid hub the lists of modes and
//! mounts are empty and `rigid` is all there is.

use precess_dynamics::{
    About, Accelerations, EnergyAndMomentum, FlexibleAccelerations, FlexibleInputs,
    FlexibleSpacecraft, FlexibleState, Ledger, ListedModes, LoadAxes, Loads, Momentum, Power,
    SolveError, Spacecraft, State,
};

use super::error::RunError;
use crate::scenario::{Scenario, Set};

/// The state that is integrated.
pub(crate) type CraftState = FlexibleState<Set, ListedModes>;
/// What acts.
pub(crate) type CraftInputs = FlexibleInputs<Set, ListedModes>;
/// Second derivatives of the state.
pub(crate) type CraftAccelerations = FlexibleAccelerations<Set, ListedModes>;

/// The equations of motion of a scenario.
#[derive(Clone, Debug)]
pub(crate) enum Craft {
    /// A rigid hub.
    Rigid(Box<Spacecraft<Set>>),
    /// A structure that bends.
    Flexible(Box<FlexibleSpacecraft<Set, ListedModes>>),
}

impl Craft {
    /// That of a scenario.
    pub(crate) fn of(scenario: &Scenario) -> Result<Self, RunError> {
        Ok(match scenario.flexible() {
            Some(craft) => Self::Flexible(Box::new(craft.map_err(RunError::Modes)?)),
            None => Self::Rigid(Box::new(scenario.spacecraft().map_err(RunError::Parameters)?)),
        })
    }

    /// The structure undeformed, with the devices.
    pub(crate) fn rigid(&self) -> &Spacecraft<Set> {
        match self {
            Self::Rigid(craft) => craft,
            Self::Flexible(craft) => craft.rigid(),
        }
    }

    /// The structure that bends; none of a rigid hub.
    pub(crate) fn flexible(&self) -> Option<&FlexibleSpacecraft<Set, ListedModes>> {
        match self {
            Self::Rigid(_) => None,
            Self::Flexible(craft) => Some(craft),
        }
    }

    /// Everything at zero.
    pub(crate) fn at_rest(&self) -> CraftState {
        match self {
            Self::Rigid(craft) => rigid_state(State::at_rest_for(craft)),
            Self::Flexible(craft) => FlexibleState::at_rest_for(craft),
        }
    }

    /// Nothing acts.
    pub(crate) fn no_inputs(&self) -> CraftInputs {
        match self {
            Self::Rigid(craft) => FlexibleInputs {
                rigid: precess_dynamics::Inputs::none_for(craft),
                modal: Vec::new(),
                mounts: Vec::new(),
            },
            Self::Flexible(craft) => FlexibleInputs::none_for(craft),
        }
    }

    pub(crate) fn accelerations(
        &self,
        state: &CraftState,
        inputs: &CraftInputs,
    ) -> Result<CraftAccelerations, SolveError> {
        match self {
            Self::Rigid(craft) => {
                craft.accelerations(&state.rigid, &inputs.rigid).map(rigid_accelerations)
            }
            Self::Flexible(craft) => craft.accelerations(state, inputs),
        }
    }

    pub(crate) fn ledger(
        &self,
        state: &CraftState,
        inputs: &CraftInputs,
        found: &CraftAccelerations,
    ) -> Result<Ledger, SolveError> {
        match self {
            Self::Rigid(craft) => craft.ledger(&state.rigid, &inputs.rigid, &found.rigid),
            Self::Flexible(craft) => Ok(craft.ledger(state, inputs, found)?.whole),
        }
    }

    /// Loads of the devices; at the mounts of a structure in the axes of the present mount.
    pub(crate) fn loads(
        &self,
        state: &CraftState,
        inputs: &CraftInputs,
        found: &CraftAccelerations,
    ) -> Result<Loads<Set>, SolveError> {
        match self {
            Self::Rigid(craft) => {
                craft.loads(&state.rigid, &inputs.rigid, &found.rigid, LoadAxes::Body)
            }
            Self::Flexible(craft) => Ok(craft.loads(state, inputs, found, LoadAxes::Body)?.rigid),
        }
    }

    pub(crate) fn energy_and_momentum(
        &self,
        state: &CraftState,
        about: About,
    ) -> Result<EnergyAndMomentum, SolveError> {
        match self {
            Self::Rigid(craft) => craft.energy_and_momentum(&state.rigid, about),
            Self::Flexible(craft) => craft.energy_and_momentum(state, about),
        }
    }

    pub(crate) fn momentum(
        &self,
        state: &CraftState,
        about: About,
    ) -> Result<Momentum, SolveError> {
        match self {
            Self::Rigid(craft) => craft.momentum(&state.rigid, about),
            Self::Flexible(craft) => craft.momentum(state, about),
        }
    }

    /// A step of RK4.
    pub(crate) fn step(
        &self,
        state: &CraftState,
        inputs: &CraftInputs,
        length: f64,
    ) -> Result<CraftState, SolveError> {
        match self {
            Self::Rigid(craft) => craft.step(&state.rigid, &inputs.rigid, length).map(rigid_state),
            Self::Flexible(craft) => craft.step(state, inputs, length),
        }
    }

    /// A step of RK4, and the work of each source during it, J.
    pub(crate) fn step_with_work(
        &self,
        state: &CraftState,
        inputs: &CraftInputs,
        length: f64,
    ) -> Result<(CraftState, Power), SolveError> {
        match self {
            Self::Rigid(craft) => {
                let stepped = craft.step_with_work(&state.rigid, &inputs.rigid, length)?;
                Ok((rigid_state(stepped.state), stepped.work))
            }
            Self::Flexible(craft) => {
                let stepped = craft.step_with_work(state, inputs, length)?;
                Ok((stepped.state, stepped.work))
            }
        }
    }

    /// The state after an impulsive stop of the joints that the inputs lock, and the energy lost, J.
    pub(crate) fn stop(
        &self,
        state: &CraftState,
        inputs: &CraftInputs,
    ) -> Result<(CraftState, f64), SolveError> {
        match self {
            Self::Rigid(craft) => {
                let stopped = craft.stop(&state.rigid, &inputs.rigid)?;
                Ok((rigid_state(stopped.state), stopped.energy_lost))
            }
            Self::Flexible(craft) => {
                let stopped = craft.stop(state, inputs)?;
                Ok((stopped.state, stopped.energy_lost))
            }
        }
    }
}

/// The state of a rigid hub.
pub(crate) fn rigid_state(rigid: State<Set>) -> CraftState {
    FlexibleState { rigid, eta: Vec::new(), eta_dot: Vec::new() }
}

fn rigid_accelerations(rigid: Accelerations<Set>) -> CraftAccelerations {
    FlexibleAccelerations { rigid, eta_ddot: Vec::new() }
}
