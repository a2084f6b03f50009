//! [`LinearizedStep`]: derivatives of steps of RK4 with names, and columns by parameters.
//!
//! ```text
//! x1 = F + A (x - x0) + B (u - u0) + P (p - p0)
//! ```

use nalgebra::DMatrix;
use precess_dynamics::Variable;

use super::parameters::Parameter;
use super::{CraftInputs, CraftState, EvaluationError, Evaluator};

/// Steps of RK4 linearised about a state and inputs, which are held. The attitude in `x - x0`, and in
/// the change of `x1`, is a small rotation about the axes of B: of B before the steps, and after them.
#[derive(Clone, Debug, PartialEq)]
pub struct LinearizedStep {
    /// The state after the steps.
    pub state: CraftState,
    /// Names of the states: rows of all, columns of `a`.
    pub states: Vec<String>,
    /// Names of the inputs: columns of `b`.
    pub inputs: Vec<String>,
    /// Names of the parameters: columns of `p`.
    pub parameters: Vec<String>,
    /// Derivatives of the state after the steps by that before them.
    pub a: DMatrix<f64>,
    /// Derivatives by the inputs.
    pub b: DMatrix<f64>,
    /// Derivatives by the parameters.
    pub p: DMatrix<f64>,
}

impl Evaluator {
    /// So many steps of RK4, s, linearised: exact to rounding, with columns by the parameters of these
    /// names. See [`precess_dynamics::StepLinearization`] for what is zero by structure.
    ///
    /// # Errors
    ///
    /// [`EvaluationError::Friction`]; [`EvaluationError::Flexible`] for parameters of a flexible structure,
    /// [`EvaluationError::UnknownParameter`]; as [`precess_dynamics::Spacecraft::linearize_step`]
    /// and [`precess_dynamics::Spacecraft::step_parameter_derivatives`].
    pub fn linearize_steps<N: AsRef<str>>(
        &self,
        state: &CraftState,
        inputs: &CraftInputs,
        (length, steps): (f64, usize),
        parameters: &[N],
    ) -> Result<LinearizedStep, EvaluationError> {
        self.check_smooth()?;
        let parameters = self.parameters_named(parameters)?;
        let by: Vec<_> = parameters.iter().map(Parameter::variable).collect();
        let hub = if by.is_empty() { None } else { Some(self.scenario.bare_hub()?) };
        let names = |of: &mut dyn Iterator<Item = Variable>| -> Vec<String> {
            of.map(|variable| self.variable_name(variable)).collect()
        };
        let states = names(&mut self.structure().state_variables(inputs));
        let by_inputs = names(&mut self.structure().input_variables(inputs));
        let mut reached = LinearizedStep {
            state: state.clone(),
            a: DMatrix::identity(states.len(), states.len()),
            b: DMatrix::zeros(states.len(), by_inputs.len()),
            p: DMatrix::zeros(states.len(), by.len()),
            states,
            inputs: by_inputs,
            parameters: parameters.iter().map(|parameter| parameter.name.clone()).collect(),
        };
        for _ in 0..steps {
            let now = &reached.state;
            let step = precess_craft::linearize_step(&self.craft, now, inputs, length)?;
            if let Some(hub) = &hub {
                let rigid = (now.clone().with_modal(()), inputs.clone().with_modal(()));
                let (devices, at) = (&self.scenario.devices, (&rigid.0, &rigid.1));
                let found =
                    precess_craft::step_parameter_derivatives(hub, devices, at, length, &by)?;
                reached.p = &step.a * &reached.p + found;
            }
            reached.a = &step.a * &reached.a;
            reached.b = &step.a * &reached.b + step.b;
            reached.state = step.state;
        }
        Ok(reached)
    }
}
