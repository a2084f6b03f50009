//! Derivatives with the set of a scenario: of any structure by state and inputs, of a rigid hub by parameters.

use nalgebra::DMatrix;
use precess_dynamics::{
    Accelerations, Column, DerivativeError, Hub, Inputs, Linearization, Outputs,
    ParameterDirection, ParameterVariable, Spacecraft, State, StepLinearization, Variable,
    WithChanges,
};

use crate::{Craft, CraftAccelerations, CraftInputs, CraftState, Set, Structure, rigid_state};

/// The linearised system.
///
/// # Errors
///
/// As [`Spacecraft::linearize`].
pub fn linearize(
    craft: &Craft,
    state: &CraftState,
    inputs: &CraftInputs,
    outputs: &Outputs,
) -> Result<Linearization<Set, Structure>, DerivativeError> {
    craft.0.linearize(state, inputs, outputs)
}

/// The linearised system of a rigid hub.
///
/// # Errors
///
/// As [`Spacecraft::linearize`].
pub fn linearize_rigid(
    craft: &Spacecraft<Set>,
    state: &State<Set>,
    inputs: &Inputs<Set>,
    outputs: &Outputs,
) -> Result<Linearization<Set>, DerivativeError> {
    let craft = Craft::from(craft.clone());
    let inputs = inputs.clone().with_modal(craft.no_inputs().modal);
    let found = linearize(&craft, &rigid_state(state.clone()), &inputs, outputs)?;
    let accelerations = found.accelerations.clone().with_modal(());
    Ok(found.with_accelerations(accelerations))
}

/// A column of derivatives for each state or input, and the accelerations.
///
/// # Errors
///
/// As [`Spacecraft::derivatives`].
pub fn derivatives(
    craft: &Craft,
    (state, inputs): (&CraftState, &CraftInputs),
    outputs: &Outputs,
    variables: &mut dyn Iterator<Item = Variable>,
    column: &mut dyn FnMut(Variable, &Column<Set, Structure>),
) -> Result<CraftAccelerations, DerivativeError> {
    craft.0.derivatives(state, inputs, outputs, variables, column)
}

/// A column of derivatives for each parameter, and the accelerations.
///
/// # Errors
///
/// As [`Spacecraft::parameter_derivatives`].
pub fn parameter_derivatives<'a>(
    hub: &Hub,
    devices: &Set,
    at: (&State<Set>, &Inputs<Set>),
    outputs: &Outputs,
    variables: &mut dyn Iterator<Item = ParameterVariable<'a>>,
    column: &mut dyn FnMut(ParameterVariable<'a>, &Column<Set>),
) -> Result<Accelerations<Set>, DerivativeError> {
    Spacecraft::parameter_derivatives(hub, devices, at, outputs, variables, column)
}

/// A step of RK4 linearised.
///
/// # Errors
///
/// As [`Spacecraft::linearize_step`].
pub fn linearize_step(
    craft: &Craft,
    state: &CraftState,
    inputs: &CraftInputs,
    length: f64,
) -> Result<StepLinearization<Set, Structure>, DerivativeError> {
    craft.0.linearize_step(state, inputs, length)
}

/// Derivatives of the state after a step by parameters.
///
/// # Errors
///
/// As [`Spacecraft::step_parameter_derivatives`].
pub fn step_parameter_derivatives(
    hub: &Hub,
    devices: &Set,
    at: (&State<Set>, &Inputs<Set>),
    length: f64,
    variables: &[ParameterVariable<'_>],
) -> Result<DMatrix<f64>, DerivativeError> {
    Spacecraft::step_parameter_derivatives(hub, devices, at, length, variables)
}

/// Second derivatives of the state, and what they change by along directions of parameters; none in a central field, on
/// carriers and with lumped imbalance.
///
/// # Errors
///
/// As [`Spacecraft::accelerations_along`].
pub fn accelerations_along(
    craft: &Spacecraft<Set>,
    of: (&Hub, &Set),
    at: (&State<Set>, &Inputs<Set>),
    changes: &DMatrix<f64>,
    directions: &[ParameterDirection],
) -> Result<Option<WithChanges<Accelerations<Set>>>, DerivativeError> {
    craft.accelerations_along(of, at, changes, directions)
}

/// The state after a step, and what it changes by along directions of parameters; none where accelerations are none.
///
/// # Errors
///
/// As [`Spacecraft::step_along`].
pub fn step_along(
    craft: &Spacecraft<Set>,
    of: (&Hub, &Set),
    at: (&State<Set>, &Inputs<Set>),
    length: f64,
    changes: &DMatrix<f64>,
    directions: &[ParameterDirection],
) -> Result<Option<WithChanges<State<Set>>>, DerivativeError> {
    craft.step_along(of, at, length, changes, directions)
}

/// The linearised system into matrices that are kept.
///
/// # Errors
///
/// As [`Spacecraft::linearize_into`].
pub fn linearize_into(
    craft: &Craft,
    state: &CraftState,
    inputs: &CraftInputs,
    outputs: &Outputs,
    into: &mut Linearization<Set, Structure>,
) -> Result<(), DerivativeError> {
    craft.0.linearize_into(state, inputs, outputs, into)
}

/// The accelerations, and their derivative along a direction of states and of inputs.
///
/// # Errors
///
/// As [`Spacecraft::jvp`].
pub fn jvp(
    craft: &Craft,
    state: &CraftState,
    inputs: &CraftInputs,
    direction: (&[f64], &[f64]),
) -> Result<(CraftAccelerations, CraftAccelerations), DerivativeError> {
    craft.0.jvp(state, inputs, direction)
}

/// The accelerations, and the gradient of a weighted sum of them by states and by inputs.
///
/// # Errors
///
/// As [`Spacecraft::vjp`].
pub fn vjp(
    craft: &Craft,
    state: &CraftState,
    inputs: &CraftInputs,
    weights: &CraftAccelerations,
    gradient: (&mut [f64], &mut [f64]),
) -> Result<CraftAccelerations, DerivativeError> {
    craft.0.vjp(state, inputs, weights, gradient)
}
