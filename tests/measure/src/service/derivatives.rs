//! Derivatives of one state, and what they are compared with: an evaluation, a step, and central
//! differences of evaluations over the same variables.

use std::collections::BTreeMap;
use std::hint::black_box;

use nalgebra::Vector3;
use precess_dynamics::kind::{Each as _, JointStates as _};
use precess_dynamics::{
    AccelerationDerivatives, Accelerations, Axis, Dgvscmg, Inputs, Linearization, Outputs,
    Quaternion, Spacecraft, State, StepLinearization, Variable,
};
use precess_tests::measured::imbalance_of;
use precess_tests::stored::Stored;
use serde_json::{Value, json};

use super::single_state::{NUDGE, flat};
use super::{Name, Rejected, Service};

/// The change of a variable by which differences are taken.
const CHANGE: f64 = 1e-6;
/// Length of a step, s.
const STEP: f64 = 1e-3;

type Set<const N: usize> = [Dgvscmg; N];

/// A spacecraft in a state, and what is computed of it.
pub(super) struct Derivatives<const N: usize> {
    name: Name,
    stored: Stored,
    devices: Set<N>,
    craft: Spacecraft<Set<N>>,
    state: State<Set<N>, Quaternion>,
    inputs: Inputs<Set<N>>,
    variables: Vec<Variable>,
    kept: Linearization<Set<N>>,
    kept_accelerations: AccelerationDerivatives<Set<N>>,
    kept_step: StepLinearization<Set<N>>,
    /// A direction of states and of inputs, and the gradient by them.
    products: [Vec<f64>; 4],
}

impl<const N: usize> Derivatives<N> {
    pub(super) fn open(name: Name, stored: &Stored, devices: &Set<N>) -> Result<Self, Rejected> {
        let craft = Spacecraft::new(&stored.hub(), devices)?;
        let state = stored.motion(State::at_rest_for(&craft));
        let inputs = stored.forces(Inputs::none_for(&craft));
        let variables =
            craft.state_variables(&inputs).chain(craft.input_variables(&inputs)).collect();
        let (stored, devices) = (stored.clone(), *devices);
        let kept = craft.linearize(&state, &inputs, &Outputs::accelerations())?;
        let kept_accelerations = craft.acceleration_derivatives(&state, &inputs)?;
        let kept_step = craft.linearize_step(&state, &inputs, STEP)?;
        let sizes = [kept.states.len(), kept.inputs.len()];
        let [of_states, of_inputs] = sizes.map(|size| vec![1.0; size]);
        let products = [of_states.clone(), of_inputs.clone(), of_states, of_inputs];
        Ok(Self {
            name,
            stored,
            devices,
            craft,
            state,
            inputs,
            variables,
            kept,
            kept_accelerations,
            kept_step,
            products,
        })
    }

    /// One call; the angular acceleration that it finds on the way.
    fn call(&mut self) -> Result<Vector3<f64>, Rejected> {
        let (state, inputs) = (black_box(&self.state), &self.inputs);
        let none = Outputs::accelerations();
        match self.name {
            Name::Derivatives => {
                let by = self.variables.iter().copied();
                let each = |_, column: &_| {
                    black_box(column);
                };
                Ok(self.craft.derivatives(state, inputs, &none, by, each)?.omega_dot)
            }
            Name::Linearized => {
                let found = self.craft.linearize(state, inputs, &none)?;
                Ok(black_box(&found).accelerations.omega_dot)
            }
            Name::LinearizedInto => {
                self.craft.linearize_into(state, inputs, &none, &mut self.kept)?;
                Ok(black_box(&self.kept).accelerations.omega_dot)
            }
            Name::AccelerationDerivatives => {
                let kept = &mut self.kept_accelerations;
                self.craft.acceleration_derivatives_into(state, inputs, kept)?;
                Ok(black_box(&self.kept_accelerations).accelerations.omega_dot)
            }
            Name::Jvp => {
                let [of_states, of_inputs, ..] = black_box(&self.products);
                let found = self.craft.jvp(state, inputs, (of_states, of_inputs))?;
                Ok(black_box(&found).0.omega_dot)
            }
            Name::Vjp => {
                // As weights, the accelerations of the state as it was opened.
                let weights = black_box(&self.kept.accelerations);
                let [.., by_states, by_inputs] = &mut self.products;
                let found = self.craft.vjp(state, inputs, weights, (by_states, by_inputs))?;
                black_box(&self.products);
                Ok(found.omega_dot)
            }
            Name::Differences => {
                for variable in &self.variables {
                    let [up, down] =
                        [CHANGE, -CHANGE].map(|change| self.changed(*variable, change));
                    let up = self.craft.accelerations(&up.0, &up.1)?;
                    let down = self.craft.accelerations(&down.0, &down.1)?;
                    black_box((up.omega_dot - down.omega_dot) / (2.0 * CHANGE));
                }
                Ok(self.craft.accelerations(state, inputs)?.omega_dot)
            }
            Name::ByParameters => {
                let hub = self.stored.hub();
                let at = (state, inputs);
                let by = (0..N).flat_map(imbalance_of);
                let sum = |_, column: &_| {
                    black_box(column);
                };
                let of = &self.devices;
                let found = Spacecraft::parameter_derivatives(&hub, of, at, &none, by, sum)?;
                Ok(found.omega_dot)
            }
            Name::SingleStep => {
                let next = self.craft.step(state, inputs, STEP)?;
                Ok((black_box(&next).omega - state.omega) / STEP)
            }
            Name::LinearizedStep => {
                let found = self.craft.linearize_step(state, inputs, STEP)?;
                Ok((black_box(&found).state.omega - state.omega) / STEP)
            }
            Name::LinearizedStepInto => {
                self.craft.linearize_step_into(state, inputs, STEP, &mut self.kept_step)?;
                Ok((black_box(&self.kept_step).state.omega - state.omega) / STEP)
            }
            _ => {
                let found = self.craft.accelerations(state, inputs)?;
                Ok(black_box(&found).omega_dot)
            }
        }
    }

    /// State and inputs with a variable changed.
    fn changed(&self, variable: Variable, by: f64) -> (State<Set<N>, Quaternion>, Inputs<Set<N>>) {
        let (mut state, mut inputs) = (self.state, self.inputs);
        let along = |axis| match axis {
            Axis::X => Vector3::x() * by,
            Axis::Y => Vector3::y() * by,
            Axis::Z => Vector3::z() * by,
        };
        match variable {
            Variable::Position(axis) => state.r_b_n += along(axis),
            Variable::Velocity(axis) => state.r_b_n_dot += along(axis),
            Variable::Attitude(axis) => {
                let [x, y, z] = along(axis).map(|angle| 0.5 * angle).into();
                let Quaternion { q0, q1, q2, q3 } = state.attitude;
                state.attitude = Quaternion {
                    q0: q0 - x * q1 - y * q2 - z * q3,
                    q1: q1 + x * q0 + z * q2 - y * q3,
                    q2: q2 + y * q0 - z * q1 + x * q3,
                    q3: q3 + z * q0 + y * q1 - x * q2,
                };
            }
            Variable::Omega(axis) => state.omega += along(axis),
            Variable::Force(axis) => inputs.force += along(axis),
            Variable::TorqueB(axis) => inputs.torque_b += along(axis),
            Variable::Coordinate(joint) => {
                state.devices.states_mut().nth(joint).into_iter().for_each(|[q, _]| *q += by);
            }
            Variable::Rate(joint) => {
                state.devices.states_mut().nth(joint).into_iter().for_each(|[_, rate]| *rate += by);
            }
            Variable::Motor(joint) => {
                inputs.motors.values_mut().nth(joint).into_iter().for_each(|u| *u += by);
            }
            // Driven joints of a free hub without gravity have no others.
            _ => {}
        }
        (state, inputs)
    }
}

impl<const N: usize> Derivatives<N> {
    /// The derivatives of the accelerations by kind of row and kind of variable, as the peers print them.
    fn blocks(&self) -> Result<BTreeMap<String, Vec<f64>>, Rejected> {
        let (state, inputs, none) = (&self.state, &self.inputs, Outputs::accelerations());
        let mut blocks = BTreeMap::new();
        if matches!(self.name, Name::Derivatives) {
            let by = self.variables.iter().copied();
            self.craft.derivatives(state, inputs, &none, by, |variable, column| {
                add_column(&mut blocks, variable, column.outputs());
            })?;
            return Ok(blocks);
        }
        if let Some(found) = self.by_products()? {
            for (variable, column) in self.variables.iter().zip(found) {
                add_column(&mut blocks, *variable, column.into_iter());
            }
            return Ok(blocks);
        }
        let (by_states, by_inputs) = if self.name == Name::AccelerationDerivatives {
            let found = self.craft.acceleration_derivatives(state, inputs)?;
            (found.by_states, found.by_inputs)
        } else {
            let found = self.craft.linearize(state, inputs, &none)?;
            (found.c, found.d)
        };
        let (states, others) = self.variables.split_at(by_states.ncols());
        for (variables, matrix) in [(states, &by_states), (others, &by_inputs)] {
            for (variable, column) in variables.iter().zip(matrix.column_iter()) {
                add_column(&mut blocks, *variable, column.iter().copied());
            }
        }
        Ok(blocks)
    }
}

impl<const N: usize> Derivatives<N> {
    /// The columns by `jvp` along each variable, or by `vjp` of each acceleration; none of another service.
    fn by_products(&self) -> Result<Option<Vec<Vec<f64>>>, Rejected> {
        let (state, inputs, states) = (&self.state, &self.inputs, self.kept.states.len());
        let columns = self.variables.len();
        match self.name {
            Name::Jvp => {
                let mut found = Vec::new();
                for place in 0..columns {
                    let mut direction = vec![0.0; columns];
                    direction[place] = 1.0;
                    let of = self.craft.jvp(state, inputs, direction.split_at(states))?.1;
                    found.push(numbers(&of));
                }
                Ok(Some(found))
            }
            Name::Vjp => {
                let mut found = vec![Vec::new(); columns];
                for row in 0..self.kept.outputs.len() {
                    let mut weights = self.kept.accelerations;
                    of_numbers(&mut weights).enumerate().for_each(|(place, to)| {
                        *to = if place == row { 1.0 } else { 0.0 };
                    });
                    let mut gradient = vec![0.0; columns];
                    let into = gradient.split_at_mut(states);
                    self.craft.vjp(state, inputs, &weights, into)?;
                    found.iter_mut().zip(gradient).for_each(|(column, of)| column.push(of));
                }
                Ok(Some(found))
            }
            _ => Ok(None),
        }
    }
}

/// All accelerations in order.
fn numbers<const N: usize>(of: &Accelerations<Set<N>>) -> Vec<f64> {
    of.r_b_n_ddot.iter().chain(&of.omega_dot).copied().chain(of.devices.values()).collect()
}

/// The same, to be changed.
fn of_numbers<const N: usize>(
    of: &mut Accelerations<Set<N>>,
) -> impl Iterator<Item = &mut f64> + '_ {
    of.r_b_n_ddot.iter_mut().chain(&mut of.omega_dot).chain(of.devices.values_mut())
}

/// Adds a column to the blocks; the peers have none by position, velocity and attitude.
fn add_column(
    blocks: &mut BTreeMap<String, Vec<f64>>,
    variable: Variable,
    column: impl Iterator<Item = f64>,
) {
    let by = match variable {
        Variable::Coordinate(_) => "angles",
        Variable::Omega(_) => "omega",
        Variable::Rate(_) => "rates",
        Variable::Force(_) => "force",
        Variable::TorqueB(_) => "torque_b",
        Variable::Motor(_) => "motors",
        _ => return,
    };
    for (row, element) in column.enumerate() {
        let name = if row < 6 { ROWS[row / 3] } else { ROWS[2 + row % 3] };
        blocks.entry(format!("{name} by {by}")).or_default().push(element);
    }
}

/// Kinds of rows: two vectors of the hub, and of each device three joints.
const ROWS: [&str; 5] = ["r_b_n_ddot", "omega_dot", "gamma_o_ddot", "gamma_i_ddot", "spin_dot"];

impl<const N: usize> Service for Derivatives<N> {
    fn check(&mut self) -> Result<Value, Rejected> {
        self.call()?;
        let mut found = flat(&self.craft.accelerations(&self.state, &self.inputs)?);
        let by_all = [
            Name::Derivatives,
            Name::Linearized,
            Name::LinearizedInto,
            Name::AccelerationDerivatives,
            Name::Jvp,
            Name::Vjp,
        ];
        if by_all.contains(&self.name) {
            found["derivatives"] = json!(self.blocks()?);
        }
        Ok(found)
    }

    fn run(&mut self, calls: u32) -> Result<(), Rejected> {
        for _ in 0..calls {
            let found = self.call()?;
            self.state.omega += found * NUDGE;
        }
        Ok(())
    }

    fn units(&self) -> u32 {
        1
    }
}
