//! [`Craft`]: what the engine evaluates, a rigid hub or a flexible structure, each with the devices of
//! the scenario.
//!
//! State, inputs and accelerations are those of a rigid hub, and lists of modes and mounts beside them,
//! which are empty where the hub is rigid.

use nalgebra::Vector3;
use precess_dynamics::{
    About, Accelerations, EnergyAndMomentum, Flexible, Inputs, Ledger, ListedModes, LoadAxes,
    Loads, ModalAccelerations, ModalInputs, ModalPoint, ModalState, Momentum, Power, Quaternion,
    SolveError, Spacecraft, State,
};

use crate::Set;

/// State of hub and devices, and modal coordinates, of which a rigid hub has none.
#[derive(Clone, Debug, PartialEq)]
pub struct CraftState {
    /// Of hub and devices.
    pub rigid: State<Set>,
    /// Of the modes.
    pub modal: ModalState<ListedModes>,
}

/// Forces, torques and modes.
#[derive(Clone, Debug, PartialEq)]
pub struct CraftInputs {
    /// Of hub and devices.
    pub rigid: Inputs<Set>,
    /// On modes and mounts.
    pub modal: ModalInputs<ListedModes>,
}

/// Second derivatives of the state.
#[derive(Clone, Debug, PartialEq)]
pub struct CraftAccelerations {
    /// Of hub and devices.
    pub rigid: Accelerations<Set>,
    /// Of the modal coordinates.
    pub modal: ModalAccelerations<ListedModes>,
}

/// A flexible structure with the devices of a scenario.
pub type FlexibleCraft = Spacecraft<Set, Flexible<ListedModes>>;

/// Its state.
pub type FlexibleState = State<Set, Quaternion, Flexible<ListedModes>>;

/// The equations of motion of a scenario.
#[derive(Clone, Debug)]
pub enum Craft {
    /// A rigid hub.
    Rigid(Box<Spacecraft<Set>>),
    /// A flexible structure, and the same undeformed.
    Flexible(Box<FlexibleCraft>, Box<Spacecraft<Set>>),
}

impl From<FlexibleCraft> for Craft {
    fn from(craft: FlexibleCraft) -> Self {
        let undeformed = craft.undeformed();
        Self::Flexible(Box::new(craft), Box::new(undeformed))
    }
}

impl Craft {
    /// The structure undeformed, with the devices.
    #[must_use]
    pub fn rigid(&self) -> &Spacecraft<Set> {
        match self {
            Self::Rigid(craft) | Self::Flexible(_, craft) => craft,
        }
    }

    /// The flexible structure; none of a rigid hub.
    #[must_use]
    pub fn flexible(&self) -> Option<&FlexibleCraft> {
        match self {
            Self::Rigid(_) => None,
            Self::Flexible(craft, _) => Some(craft),
        }
    }

    /// Everything at zero.
    #[must_use]
    pub fn at_rest(&self) -> CraftState {
        match self {
            Self::Rigid(craft) => rigid_state(State::at_rest_for(craft)),
            Self::Flexible(craft, _) => State::at_rest_for(craft).into(),
        }
    }

    /// Nothing acts.
    #[must_use]
    pub fn no_inputs(&self) -> CraftInputs {
        match self {
            Self::Rigid(craft) => {
                let modal = ModalInputs { forces: Vec::new(), mounts: Vec::new() };
                CraftInputs { rigid: Inputs::none_for(craft), modal }
            }
            Self::Flexible(craft, _) => {
                let inputs = Inputs::none_for(craft);
                let modal = inputs.modal.clone();
                CraftInputs { rigid: inputs.with_modal(()), modal }
            }
        }
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
        match self {
            Self::Rigid(craft) => {
                let rigid = craft.accelerations(&state.rigid, &inputs.rigid)?;
                Ok(CraftAccelerations { rigid, modal: ModalAccelerations { eta_ddot: Vec::new() } })
            }
            Self::Flexible(craft, _) => {
                craft.accelerations(&state.flexible(), &inputs.flexible()).map(Into::into)
            }
        }
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
        match self {
            Self::Rigid(craft) => craft.ledger(&state.rigid, &inputs.rigid, &found.rigid),
            Self::Flexible(craft, _) => {
                let found = found.flexible();
                Ok(craft.ledger(&state.flexible(), &inputs.flexible(), &found)?.with_modal(()))
            }
        }
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
    ) -> Result<Loads<Set>, SolveError> {
        let axes = LoadAxes::Body;
        match self {
            Self::Rigid(craft) => craft.loads(&state.rigid, &inputs.rigid, &found.rigid, axes),
            Self::Flexible(craft, _) => {
                let (state, inputs) = (state.flexible(), inputs.flexible());
                let loads = craft.loads(&state, &inputs, &found.flexible(), axes)?;
                Ok(Loads { devices: loads.devices, hub: loads.hub, modal: () })
            }
        }
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
        match self {
            Self::Rigid(craft) => craft.energy_and_momentum(&state.rigid, about),
            Self::Flexible(craft, _) => craft.energy_and_momentum(&state.flexible(), about),
        }
    }

    /// Momenta about a point.
    ///
    /// # Errors
    ///
    /// As [`Spacecraft::momentum`].
    pub fn momentum(&self, state: &CraftState, about: About) -> Result<Momentum, SolveError> {
        match self {
            Self::Rigid(craft) => craft.momentum(&state.rigid, about),
            Self::Flexible(craft, _) => craft.momentum(&state.flexible(), about),
        }
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
        match self {
            Self::Rigid(craft) => craft.step(&state.rigid, &inputs.rigid, length).map(rigid_state),
            Self::Flexible(craft, _) => {
                craft.step(&state.flexible(), &inputs.flexible(), length).map(Into::into)
            }
        }
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
        match self {
            Self::Rigid(craft) => {
                let stepped = craft.step_with_work(&state.rigid, &inputs.rigid, length)?;
                Ok((rigid_state(stepped.state), stepped.work))
            }
            Self::Flexible(craft, _) => {
                let (state, inputs) = (state.flexible(), inputs.flexible());
                let stepped = craft.step_with_work(&state, &inputs, length)?;
                Ok((stepped.state.into(), stepped.work))
            }
        }
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
        match self {
            Self::Rigid(craft) => {
                let stopped = craft.stop(&state.rigid, &inputs.rigid)?;
                Ok((rigid_state(stopped.state), stopped.energy_lost))
            }
            Self::Flexible(craft, _) => {
                let stopped = craft.stop(&state.flexible(), &inputs.flexible())?;
                Ok((stopped.state.into(), stopped.energy_lost))
            }
        }
    }
}

/// The state of a rigid hub.
#[must_use]
pub fn rigid_state(rigid: State<Set>) -> CraftState {
    CraftState { rigid, modal: ModalState { eta: Vec::new(), eta_dot: Vec::new() } }
}

impl CraftState {
    /// As the state of a flexible structure.
    #[must_use]
    pub fn flexible(&self) -> FlexibleState {
        self.rigid.clone().with_modal(self.modal.clone())
    }
}

impl From<FlexibleState> for CraftState {
    fn from(state: FlexibleState) -> Self {
        let State { r_b_n, r_b_n_dot, attitude, omega, devices, modal } = state;
        Self { rigid: State { r_b_n, r_b_n_dot, attitude, omega, devices, modal: () }, modal }
    }
}

impl CraftInputs {
    /// As the inputs of a flexible structure.
    #[must_use]
    pub fn flexible(&self) -> Inputs<Set, Flexible<ListedModes>> {
        self.rigid.clone().with_modal(self.modal.clone())
    }

    /// Adds a force, N, and a moment, N m, at a point of the structure, both expressed in B, to first
    /// order: the arm is that of the undeformed structure.
    pub fn add_wrench(
        &mut self,
        point: &ModalPoint<ListedModes>,
        force: &Vector3<f64>,
        moment: &Vector3<f64>,
    ) {
        self.rigid.add_force(&point.position, force);
        self.rigid.torque_b += moment;
        self.modal.add_wrench(point, force, moment);
    }
}

impl CraftAccelerations {
    /// As the accelerations of a flexible structure.
    #[must_use]
    pub fn flexible(&self) -> Accelerations<Set, Flexible<ListedModes>> {
        let Accelerations { r_b_n_ddot, omega_dot, devices, .. } = self.rigid.clone();
        Accelerations { r_b_n_ddot, omega_dot, devices, modal: self.modal.clone() }
    }
}

impl From<Accelerations<Set, Flexible<ListedModes>>> for CraftAccelerations {
    fn from(found: Accelerations<Set, Flexible<ListedModes>>) -> Self {
        let Accelerations { r_b_n_ddot, omega_dot, devices, modal } = found;
        let rigid = Accelerations { r_b_n_ddot, omega_dot, devices, modal: () };
        Self { rigid, modal }
    }
}
