//! Derivatives with the set of a scenario: of any structure by state and inputs, of a rigid hub by parameters.

use nalgebra::DMatrix;
use precess_dynamics::{
    Accelerations, Column, DerivativeError, Hub, Inputs, Linearization, Outputs, ParameterVariable,
    Spacecraft, State, StepLinearization, Variable,
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
    let Linearization { accelerations, states, inputs, outputs, a, b, c, d } = found;
    let accelerations = accelerations.with_modal(());
    Ok(Linearization { accelerations, states, inputs, outputs, a, b, c, d })
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
