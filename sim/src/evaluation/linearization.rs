//! [`Linearized`]: the matrices of the linearised system with names, and columns by parameters.
//!
//! ```text
//! x' = f + A (x - x0) + B (u - u0) + P (p - p0)
//! y  = g + C (x - x0) + D (u - u0) + Q (p - p0)
//! ```

use nalgebra::DMatrix;
use precess_dynamics::Outputs;

use super::parameters::Parameter;
use super::{CraftInputs, CraftState, EvaluationError, Evaluator};

/// A spacecraft linearised about a state and inputs. The attitude in `x - x0` is a small rotation
/// about the axes of B.
#[derive(Clone, Debug, PartialEq)]
pub struct Linearized {
    /// Names of the states: rows and columns of `a`.
    pub states: Vec<String>,
    /// Names of the inputs: columns of `b` and `d`.
    pub inputs: Vec<String>,
    /// Names of the outputs: rows of `c` and `d`; first all accelerations.
    pub outputs: Vec<String>,
    /// Names of the parameters: columns of `p` and `q`.
    pub parameters: Vec<String>,
    /// Derivatives of `x'` by the states.
    pub a: DMatrix<f64>,
    /// Derivatives of `x'` by the inputs.
    pub b: DMatrix<f64>,
    /// Derivatives of the outputs by the states.
    pub c: DMatrix<f64>,
    /// Derivatives of the outputs by the inputs.
    pub d: DMatrix<f64>,
    /// Derivatives of `x'` by the parameters.
    pub p: DMatrix<f64>,
    /// Derivatives of the outputs by the parameters.
    pub q: DMatrix<f64>,
}

impl Evaluator {
    /// The spacecraft linearised about a state and inputs, exact to rounding; with columns by the
    /// parameters of these names ([`Parameter::all`]).
    ///
    /// # Errors
    ///
    /// [`EvaluationError::Friction`]; [`EvaluationError::Flexible`] for parameters of a flexible structure,
    /// [`EvaluationError::UnknownParameter`]; as [`precess_dynamics::Spacecraft::linearize`] and
    /// [`precess_dynamics::Spacecraft::parameter_derivatives`].
    pub fn linearize<N: AsRef<str>>(
        &self,
        state: &CraftState,
        inputs: &CraftInputs,
        outputs: &Outputs,
        parameters: &[N],
    ) -> Result<Linearized, EvaluationError> {
        self.check_smooth()?;
        let parameters = self.parameters_named(parameters)?;
        let found = precess_craft::linearize(&self.craft, state, inputs, outputs)?;
        let (rows, count) = (found.states.len(), parameters.len());
        let mut p = DMatrix::zeros(rows, count);
        let mut q = DMatrix::zeros(found.outputs.len(), count);
        if count > 0 {
            let hub = self.scenario.bare_hub()?;
            let mut columns = p.column_iter_mut().zip(q.column_iter_mut());
            let mut by = parameters.iter().map(Parameter::variable);
            // What no state of the linearised system is: the variable of a column by parameters.
            let none = precess_dynamics::Variable::Mu;
            let at = (&state.clone().with_modal(()), &inputs.clone().with_modal(()));
            precess_craft::parameter_derivatives(
                &hub,
                &self.scenario.devices,
                at,
                outputs,
                &mut by,
                &mut |_, column| {
                    let Some((mut slopes, mut results)) = columns.next() else { return };
                    for (to, of) in slopes.iter_mut().zip(&found.states) {
                        *to = column.element(*of, none, &state.omega).unwrap_or_default();
                    }
                    results.iter_mut().zip(column.outputs()).for_each(|(to, from)| *to = from);
                },
            )?;
        }
        let names = |of: &[precess_dynamics::Variable]| -> Vec<String> {
            of.iter().map(|variable| self.variable_name(*variable)).collect()
        };
        Ok(Linearized {
            states: names(&found.states),
            inputs: names(&found.inputs),
            outputs: found.outputs.iter().map(|output| self.output_name(*output)).collect(),
            parameters: parameters.into_iter().map(|parameter| parameter.name).collect(),
            a: found.a,
            b: found.b,
            c: found.c,
            d: found.d,
            p,
            q,
        })
    }

    /// The parameters of these names, which are variables only of a rigid hub.
    pub(super) fn parameters_named<N: AsRef<str>>(
        &self,
        names: &[N],
    ) -> Result<Vec<Parameter>, EvaluationError> {
        if self.is_flexible() && !names.is_empty() {
            return Err(EvaluationError::Flexible);
        }
        Parameter::named(&self.scenario, names)
    }
}
