//! Derivatives of a rigid hub with the set of a scenario.

use nalgebra::DMatrix;
use precess_dynamics::{
    Accelerations, Column, DerivativeError, Hub, Inputs, Linearization, Outputs, ParameterVariable,
    Spacecraft, State, StepLinearization, Variable,
};

use crate::Set;

/// The linearised system.
///
/// # Errors
///
/// As [`Spacecraft::linearize`].
pub fn linearize(
    craft: &Spacecraft<Set>,
    state: &State<Set>,
    inputs: &Inputs<Set>,
    outputs: &Outputs,
) -> Result<Linearization<Set>, DerivativeError> {
    craft.linearize(state, inputs, outputs)
}

/// A column of derivatives for each state or input, and the accelerations.
///
/// # Errors
///
/// As [`Spacecraft::derivatives`].
pub fn derivatives(
    craft: &Spacecraft<Set>,
    (state, inputs): (&State<Set>, &Inputs<Set>),
    outputs: &Outputs,
    variables: &mut dyn Iterator<Item = Variable>,
    column: &mut dyn FnMut(Variable, &Column<Set>),
) -> Result<Accelerations<Set>, DerivativeError> {
    craft.derivatives(state, inputs, outputs, variables, column)
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
    craft: &Spacecraft<Set>,
    state: &State<Set>,
    inputs: &Inputs<Set>,
    length: f64,
) -> Result<StepLinearization<Set>, DerivativeError> {
    craft.linearize_step(state, inputs, length)
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
