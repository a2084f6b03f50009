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

use crate::Set;

/// State of hub and devices, and modal coordinates, of which a rigid hub has none.
pub type CraftState = FlexibleState<Set, ListedModes>;
/// Forces, torques and modes.
pub type CraftInputs = FlexibleInputs<Set, ListedModes>;
/// Second derivatives of the state.
pub type CraftAccelerations = FlexibleAccelerations<Set, ListedModes>;

/// The equations of motion of a scenario.
#[derive(Clone, Debug)]
pub enum Craft {
    /// A rigid hub.
    Rigid(Box<Spacecraft<Set>>),
    /// A structure that bends.
    Flexible(Box<FlexibleSpacecraft<Set, ListedModes>>),
}

impl Craft {
    /// The structure undeformed, with the devices.
    #[must_use]
    pub fn rigid(&self) -> &Spacecraft<Set> {
        match self {
            Self::Rigid(craft) => craft,
            Self::Flexible(craft) => craft.rigid(),
        }
    }

    /// The structure that bends; none of a rigid hub.
    #[must_use]
    pub fn flexible(&self) -> Option<&FlexibleSpacecraft<Set, ListedModes>> {
        match self {
            Self::Rigid(_) => None,
            Self::Flexible(craft) => Some(craft),
        }
    }

    /// Everything at zero.
    #[must_use]
    pub fn at_rest(&self) -> CraftState {
        match self {
            Self::Rigid(craft) => rigid_state(State::at_rest_for(craft)),
            Self::Flexible(craft) => FlexibleState::at_rest_for(craft),
        }
    }

    /// Nothing acts.
    #[must_use]
    pub fn no_inputs(&self) -> CraftInputs {
        match self {
            Self::Rigid(craft) => FlexibleInputs {
                rigid: precess_dynamics::Inputs::none_for(craft),
                modal: Vec::new(),
                mounts: Vec::new(),
            },
            Self::Flexible(craft) => FlexibleInputs::none_for(craft),
        }
    }

    /// As [`Spacecraft::accelerations`] and [`FlexibleSpacecraft::accelerations`].
    ///
    /// # Errors
    ///
    /// Theirs.
    pub fn accelerations(
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

    /// The energy ledger at accelerations that were found; of a structure, of the whole.
    ///
    /// # Errors
    ///
    /// As [`Spacecraft::ledger`] and [`FlexibleSpacecraft::ledger`].
    pub fn ledger(
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

    /// Loads of the devices; at mounts on hub or structure in B, at those on a platform in its axes.
    ///
    /// # Errors
    ///
    /// As [`Spacecraft::loads`] and [`FlexibleSpacecraft::loads`].
    pub fn loads(
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

    /// Energies, and momenta about a point.
    ///
    /// # Errors
    ///
    /// As [`Spacecraft::energy_and_momentum`] and [`FlexibleSpacecraft::energy_and_momentum`].
    pub fn energy_and_momentum(
        &self,
        state: &CraftState,
        about: About,
    ) -> Result<EnergyAndMomentum, SolveError> {
        match self {
            Self::Rigid(craft) => craft.energy_and_momentum(&state.rigid, about),
            Self::Flexible(craft) => craft.energy_and_momentum(state, about),
        }
    }

    /// Momenta about a point.
    ///
    /// # Errors
    ///
    /// As [`Spacecraft::momentum`] and [`FlexibleSpacecraft::momentum`].
    pub fn momentum(&self, state: &CraftState, about: About) -> Result<Momentum, SolveError> {
        match self {
            Self::Rigid(craft) => craft.momentum(&state.rigid, about),
            Self::Flexible(craft) => craft.momentum(state, about),
        }
    }

    /// A step of RK4.
    ///
    /// # Errors
    ///
    /// As [`Spacecraft::step`] and [`FlexibleSpacecraft::step`].
    pub fn step(
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
    ///
    /// # Errors
    ///
    /// As [`Spacecraft::step_with_work`] and [`FlexibleSpacecraft::step_with_work`].
    pub fn step_with_work(
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
    ///
    /// # Errors
    ///
    /// As [`Spacecraft::stop`] and [`FlexibleSpacecraft::stop`].
    pub fn stop(
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
#[must_use]
pub fn rigid_state(rigid: State<Set>) -> CraftState {
    FlexibleState { rigid, eta: Vec::new(), eta_dot: Vec::new() }
}

fn rigid_accelerations(rigid: Accelerations<Set>) -> CraftAccelerations {
    FlexibleAccelerations { rigid, eta_ddot: Vec::new() }
}
