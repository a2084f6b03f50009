//! [`Evaluator`]: a scenario's spacecraft evaluated at any state and inputs: accelerations, energy,
//! momentum, loads, the energy ledger, the mass matrix, the linearised system, a step and its
//! derivatives; and states as flat vectors with names.
//!
//! What the scenario prescribes over time acts only where [`Evaluator::inputs`] requests it: drives,
//! wrenches and disturbances from the start, without the changes at later times, which a run makes.
//!
//! | file | what |
//! |---|---|
//! | `names` | names of states, inputs and outputs, as columns and kinds have them |
//! | `mass_matrix` | [`MassMatrix`]: mass matrix and bias |
//! | `linearization` | [`Linearized`]: matrices of the linearised system, columns by parameters |
//! | `step` | [`LinearizedStep`]: derivatives of steps of RK4 |
//! | `parameters` | [`Parameter`]: the numbers of hub and devices by name |
//! | `error` | [`EvaluationError`] |
//!
//! ```
//! use precess::evaluation::Evaluator;
//! # let text = "format = 1\n[hub]\nmass = \"350 kg\"\ninertia = \"80, 70, 60 kg m^2\"\n[run]\nduration = \"1 s\"";
//! # let (scenario, _) = precess::file::from_toml("bus", text, std::path::Path::new(""))?;
//! let evaluator = Evaluator::new(&scenario)?;
//! let mut inputs = evaluator.no_inputs();
//! inputs.torque_b.x = 8.0;
//! let found = evaluator.accelerations(&evaluator.initial(), &inputs)?;
//! assert!((found.omega_dot.x - 0.1).abs() < 1e-15);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod error;
mod linearization;
mod mass_matrix;
mod names;
mod parameters;
mod products;
mod step;
#[cfg(test)]
mod tests;

use precess_dynamics::{About, EnergyAndMomentum, Ledger, ModalState, Power, SolveError};

pub use error::EvaluationError;
pub use linearization::Linearized;
pub use mass_matrix::MassMatrix;
pub use names::JointNames;
pub use parameters::Parameter;
pub use step::LinearizedStep;

use crate::engine::{Chain, Craft, Layout, MemberLoads, SegmentInputs, craft_of, rigid_state};
use crate::record::{Column, Columns, RunError};
use crate::scenario::Scenario;

pub use precess_craft::{
    BodyWrenches, CraftAccelerations, CraftInputs, CraftLinearization, CraftState, FlexibleCraft,
};

/// A scenario's spacecraft, prepared for evaluation.
#[derive(Clone, Debug)]
pub struct Evaluator {
    scenario: Scenario,
    craft: Craft,
    layout: Layout,
    chains: Vec<Chain>,
    /// Names of the joints, in the order of the set.
    joints: Vec<JointNames>,
    /// Every column of a load.
    loads: Vec<Column>,
}

impl Evaluator {
    /// Checks a scenario and prepares its spacecraft.
    ///
    /// # Errors
    ///
    /// [`RunError::Scenario`], [`RunError::Parameters`] and [`RunError::Modes`], as a run has them.
    pub fn new(scenario: &Scenario) -> Result<Self, RunError> {
        let errors = scenario.check();
        if !errors.is_empty() {
            return Err(RunError::Scenario(errors));
        }
        let craft = craft_of(scenario)?;
        let layout = Layout::new(scenario);
        let columns = Columns::all(scenario).into_iter();
        let loads = columns.filter(|column| column.quantity.is_load()).collect();
        let chains = Chain::all(&scenario.devices);
        let joints = JointNames::all(scenario);
        Ok(Self { scenario: scenario.clone(), craft, layout, chains, joints, loads })
    }

    /// The scenario.
    #[must_use]
    pub fn scenario(&self) -> &Scenario {
        &self.scenario
    }

    /// The spacecraft of the library, with no modes where the hub is rigid.
    #[must_use]
    pub fn structure(&self) -> &FlexibleCraft {
        self.craft.structure()
    }

    /// Whether the spacecraft is a flexible structure.
    #[must_use]
    pub fn is_flexible(&self) -> bool {
        self.craft.is_flexible()
    }

    /// The initial state of the scenario.
    #[must_use]
    pub fn initial(&self) -> CraftState {
        let mut state = rigid_state(self.scenario.initial.clone());
        if let Some(of) = &self.scenario.structure {
            state.modal = ModalState { eta: of.coordinates.clone(), eta_dot: of.rates.clone() };
        }
        state
    }

    /// Everything at zero.
    #[must_use]
    pub fn at_rest(&self) -> CraftState {
        self.craft.at_rest()
    }

    /// No force, torque or gravity, motors off, every joint in the mode of its kind, a free hub.
    #[must_use]
    pub fn no_inputs(&self) -> CraftInputs {
        self.craft.no_inputs()
    }

    /// Zero wrenches on all bodies, for [`CraftInputs::bodies`].
    #[must_use]
    pub fn no_wrenches(&self) -> BodyWrenches {
        self.craft.no_wrenches()
    }

    /// What acts at a time, s, and state: the scenario's gravity, mode of the hub, initial drives,
    /// wrenches and disturbances, motors within their power; friction that sticks, and quadratic drag, of joints that slide as part of the motors'
    /// torques.
    ///
    /// # Errors
    ///
    /// [`EvaluationError::Sticks`] of a joint with static friction that is at rest, [`EvaluationError::AtLargestRate`] of one
    /// at the largest rate of its motor.
    pub fn inputs(&self, time: f64, state: &CraftState) -> Result<CraftInputs, EvaluationError> {
        let mut acting = SegmentInputs::new(&self.scenario, &self.layout.joints);
        acting.begin(0.0, f64::INFINITY);
        if let Some(joint) = acting.sliding_at(time, state) {
            let joint = self.layout.joints.get(joint).map_or("", |place| &place.name).to_owned();
            return Err(EvaluationError::Sticks { joint });
        }
        if let Some(joint) = acting.limited_at(time, state) {
            let joint = self.layout.joints.get(joint).map_or("", |place| &place.name).to_owned();
            return Err(EvaluationError::AtLargestRate { joint });
        }
        let mut inputs = acting.inputs(&self.scenario, &self.craft);
        acting.fill(time, state, &mut inputs);
        Ok(inputs)
    }

    /// Rejects derivatives with friction that sticks and with quadratic drag.
    fn check_smooth(&self) -> Result<(), EvaluationError> {
        match self.scenario.first_friction() {
            Some(joint) => Err(EvaluationError::Friction { joint }),
            None => Ok(()),
        }
    }

    /// How many numbers a flat state has.
    #[must_use]
    pub fn state_size(&self) -> usize {
        self.layout.state_length()
    }

    /// A state as a flat vector: position and velocity (N), quaternion (scalar first), angular
    /// velocity (B), for each device its coordinates and then its rates, modal coordinates and then
    /// their rates. See [`Self::state_columns`].
    #[must_use]
    pub fn pack(&self, state: &CraftState) -> Vec<f64> {
        let mut y = self.layout.pack(state, [0.0; 2]);
        y.truncate(self.state_size());
        y
    }

    /// Reads a flat vector, its quaternion normalised.
    ///
    /// # Errors
    ///
    /// [`SolveError::Count`] for another length.
    pub fn unpack(&self, y: &[f64]) -> Result<CraftState, SolveError> {
        if y.len() != self.state_size() {
            return Err(SolveError::Count { expected: self.state_size(), found: y.len() });
        }
        let mut state = self.at_rest();
        self.layout.unpack(y, &mut state);
        Ok(state)
    }

    /// All accelerations: of B and of the hub, both in B, of the joints, of the modal coordinates.
    ///
    /// # Errors
    ///
    /// As [`FlexibleCraft::accelerations`].
    pub fn accelerations(
        &self,
        state: &CraftState,
        inputs: &CraftInputs,
    ) -> Result<CraftAccelerations, SolveError> {
        self.craft.accelerations(state, inputs)
    }

    /// Time derivative of a flat state, whose accelerations those of `state` are.
    #[must_use]
    pub fn derivative(
        &self,
        y: &[f64],
        state: &CraftState,
        found: &CraftAccelerations,
    ) -> Vec<f64> {
        let mut dydt = vec![0.0; self.layout.length()];
        self.layout.pack_rates(y, state, found, &mut dydt);
        dydt.truncate(self.state_size());
        dydt
    }

    /// Kinetic energy, J, and momenta, expressed in N.
    ///
    /// # Errors
    ///
    /// As [`FlexibleCraft::energy_and_momentum`].
    pub fn energy_and_momentum(
        &self,
        state: &CraftState,
        about: About,
    ) -> Result<EnergyAndMomentum, SolveError> {
        self.craft.energy_and_momentum(state, about)
    }

    /// The energy ledger.
    ///
    /// # Errors
    ///
    /// As [`FlexibleCraft::ledger`].
    pub fn ledger(
        &self,
        state: &CraftState,
        inputs: &CraftInputs,
        found: &CraftAccelerations,
    ) -> Result<Ledger, SolveError> {
        self.craft.ledger(state, inputs, found)
    }

    /// The columns that [`Self::loads`] returns the numbers of.
    #[must_use]
    pub fn load_columns(&self) -> &[Column] {
        &self.loads
    }

    /// Loads at mounts and joints, N and N m, as [`Self::load_columns`] names them.
    ///
    /// # Errors
    ///
    /// As [`FlexibleCraft::loads`].
    pub fn loads(
        &self,
        state: &CraftState,
        inputs: &CraftInputs,
        found: &CraftAccelerations,
    ) -> Result<Vec<f64>, SolveError> {
        let of = self.member_loads(state, inputs, found)?;
        let number = |column: &Column| of.number(column.quantity).unwrap_or(f64::NAN);
        Ok(self.loads.iter().map(number).collect())
    }

    /// Motor torque or force of each joint: what its motion requires where that is prescribed.
    ///
    /// # Errors
    ///
    /// As [`Self::loads`].
    pub fn motors(
        &self,
        state: &CraftState,
        inputs: &CraftInputs,
        found: &CraftAccelerations,
    ) -> Result<Vec<f64>, SolveError> {
        Ok(self.member_loads(state, inputs, found)?.motors)
    }

    fn member_loads(
        &self,
        state: &CraftState,
        inputs: &CraftInputs,
        found: &CraftAccelerations,
    ) -> Result<MemberLoads, SolveError> {
        let of = self.craft.loads(state, inputs, found)?;
        Ok(MemberLoads::new(&of, &self.chains))
    }

    /// A step of RK4, inputs held, s.
    ///
    /// # Errors
    ///
    /// As [`FlexibleCraft::step`].
    pub fn step(
        &self,
        state: &CraftState,
        inputs: &CraftInputs,
        length: f64,
    ) -> Result<CraftState, SolveError> {
        self.craft.step(state, inputs, length)
    }

    /// A step of RK4, and the work of each source during it, J.
    ///
    /// # Errors
    ///
    /// As [`FlexibleCraft::step_with_work`].
    pub fn step_with_work(
        &self,
        state: &CraftState,
        inputs: &CraftInputs,
        length: f64,
    ) -> Result<(CraftState, Power), SolveError> {
        self.craft.step_with_work(state, inputs, length)
    }

    /// The state after an impulsive stop of the joints that the inputs lock, and the energy lost, J.
    ///
    /// # Errors
    ///
    /// As [`FlexibleCraft::stop`].
    pub fn stop(
        &self,
        state: &CraftState,
        inputs: &CraftInputs,
    ) -> Result<(CraftState, f64), SolveError> {
        self.craft.stop(state, inputs)
    }
}
