//! [`Craft`]: what the engine evaluates, a flexible structure with the devices of the scenario. A rigid hub
//! is one without modes: lists of modes and mounts are empty, results have the bits of a rigid hub.

use precess_dynamics::{
    About, Accelerations, EnergyAndMomentum, Flexible, Inputs, Ledger, Linearization, ListedModes,
    LoadAxes, Loads, ModalState, Momentum, Power, Quaternion, SolveError, Spacecraft, State,
};

use crate::{BodyWrenches, Set};

/// The structure of a scenario.
pub type Structure = Flexible<ListedModes>;

/// State of hub, devices and modes.
pub type CraftState = State<Set, Quaternion, Structure>;

/// Forces, torques and modes.
pub type CraftInputs = Inputs<Set, Structure>;

/// Second derivatives of the state.
pub type CraftAccelerations = Accelerations<Set, Structure>;

/// A system linearised about a state.
pub type CraftLinearization = Linearization<Set, Structure>;

/// A flexible structure with the devices of a scenario.
pub type FlexibleCraft = Spacecraft<Set, Structure>;

/// The equations of motion of a scenario.
#[derive(Clone, Debug)]
pub struct Craft(pub(crate) Box<FlexibleCraft>);

impl From<FlexibleCraft> for Craft {
    fn from(craft: FlexibleCraft) -> Self {
        Self(Box::new(craft))
    }
}

impl From<Spacecraft<Set>> for Craft {
    fn from(rigid: Spacecraft<Set>) -> Self {
        FlexibleCraft::from_rigid(rigid).into()
    }
}

impl Craft {
    /// The structure with its devices.
    #[must_use]
    pub fn structure(&self) -> &FlexibleCraft {
        &self.0
    }

    /// The structure undeformed, with the devices.
    #[must_use]
    pub fn undeformed(&self) -> Spacecraft<Set> {
        self.0.undeformed()
    }

    /// Whether there are modes, or mounts.
    #[must_use]
    pub fn is_flexible(&self) -> bool {
        self.0.modes() + self.0.mounts() > 0
    }

    /// Everything at zero.
    #[must_use]
    pub fn at_rest(&self) -> CraftState {
        State::at_rest_for(&self.0)
    }

    /// Nothing acts.
    #[must_use]
    pub fn no_inputs(&self) -> CraftInputs {
        Inputs::none_for(&self.0)
    }

    /// Zero wrenches on all bodies.
    #[must_use]
    pub fn no_wrenches(&self) -> BodyWrenches {
        Inputs::no_wrenches_for(&self.0)
    }

    /// As [`Spacecraft::accelerations`].
    ///
    /// # Errors
    ///
    /// Its own.
    pub fn accelerations(
        &self,
        state: &CraftState,
        inputs: &CraftInputs,
    ) -> Result<CraftAccelerations, SolveError> {
        self.0.accelerations(state, inputs)
    }

    /// The energy ledger at accelerations that were found.
    ///
    /// # Errors
    ///
    /// As [`Spacecraft::ledger`].
    pub fn ledger(
        &self,
        state: &CraftState,
        inputs: &CraftInputs,
        found: &CraftAccelerations,
    ) -> Result<Ledger, SolveError> {
        self.0.ledger(state, inputs, found).map(|ledger| ledger.with_modal(()))
    }

    /// Loads of the devices; at mounts on hub or structure in B, at those on a platform in its axes.
    ///
    /// # Errors
    ///
    /// As [`Spacecraft::loads`].
    pub fn loads(
        &self,
        state: &CraftState,
        inputs: &CraftInputs,
        found: &CraftAccelerations,
    ) -> Result<Loads<Set, Structure>, SolveError> {
        self.0.loads(state, inputs, found, LoadAxes::Body)
    }

    /// Energies, and momenta about a point.
    ///
    /// # Errors
    ///
    /// As [`Spacecraft::energy_and_momentum`].
    pub fn energy_and_momentum(
        &self,
        state: &CraftState,
        about: About,
    ) -> Result<EnergyAndMomentum, SolveError> {
        self.0.energy_and_momentum(state, about)
    }

    /// Momenta about a point.
    ///
    /// # Errors
    ///
    /// As [`Spacecraft::momentum`].
    pub fn momentum(&self, state: &CraftState, about: About) -> Result<Momentum, SolveError> {
        self.0.momentum(state, about)
    }

    /// A step of RK4.
    ///
    /// # Errors
    ///
    /// As [`Spacecraft::step`].
    pub fn step(
        &self,
        state: &CraftState,
        inputs: &CraftInputs,
        length: f64,
    ) -> Result<CraftState, SolveError> {
        self.0.step(state, inputs, length)
    }

    /// A step of RK4, and the work of each source during it, J.
    ///
    /// # Errors
    ///
    /// As [`Spacecraft::step_with_work`].
    pub fn step_with_work(
        &self,
        state: &CraftState,
        inputs: &CraftInputs,
        length: f64,
    ) -> Result<(CraftState, Power), SolveError> {
        let stepped = self.0.step_with_work(state, inputs, length)?;
        Ok((stepped.state, stepped.work))
    }

    /// The state after an impulsive stop of the joints that the inputs lock, and the energy lost, J.
    ///
    /// # Errors
    ///
    /// As [`Spacecraft::stop`].
    pub fn stop(
        &self,
        state: &CraftState,
        inputs: &CraftInputs,
    ) -> Result<(CraftState, f64), SolveError> {
        let stopped = self.0.stop(state, inputs)?;
        Ok((stopped.state, stopped.energy_lost))
    }
}

/// The state of a hub without modes.
#[must_use]
pub fn rigid_state(rigid: State<Set>) -> CraftState {
    rigid.with_modal(ModalState { eta: Vec::new(), eta_dot: Vec::new() })
}
