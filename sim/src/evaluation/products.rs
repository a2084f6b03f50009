//! Derivatives of accelerations for many states: into matrices that are kept, along directions, and of weighted sums.

use precess_craft::CraftLinearization;
use precess_dynamics::{Each as _, Outputs, Variable};

use super::{CraftAccelerations, CraftInputs, CraftState, EvaluationError, Evaluator};

const NONE: Outputs = Outputs { momentum: None, loads: None };

impl Evaluator {
    /// The states and the inputs of [`Self::linearize`]: columns of `c` and of `d`.
    ///
    /// # Errors
    ///
    /// [`EvaluationError::Friction`].
    pub fn linearized_variables(
        &self,
        inputs: &CraftInputs,
    ) -> Result<[Vec<Variable>; 2], EvaluationError> {
        self.check_smooth()?;
        let craft = self.structure();
        Ok([craft.state_variables(inputs).collect(), craft.input_variables(inputs).collect()])
    }

    /// The spacecraft linearised about a state and inputs, into what an earlier call left: only accelerations are outputs,
    /// nothing has names. Rows and columns are those of [`Self::linearize`].
    ///
    /// # Errors
    ///
    /// [`EvaluationError::Friction`]; as [`precess_dynamics::Spacecraft::linearize_into`].
    pub fn linearize_into<'a>(
        &self,
        state: &CraftState,
        inputs: &CraftInputs,
        kept: &'a mut Option<CraftLinearization>,
    ) -> Result<&'a CraftLinearization, EvaluationError> {
        self.check_smooth()?;
        match kept {
            Some(kept) => {
                precess_craft::linearize_into(&self.craft, state, inputs, &NONE, kept)?;
                Ok(kept)
            }
            None => Ok(kept.insert(precess_craft::linearize(&self.craft, state, inputs, &NONE)?)),
        }
    }

    /// What the accelerations change by along a direction of the states and of the inputs of [`Self::linearize`]:
    /// `C dx + D du`, without the matrices. They change in the order of the rows of `C`.
    ///
    /// # Errors
    ///
    /// [`EvaluationError::Friction`]; as [`precess_dynamics::Spacecraft::jvp`].
    pub fn jvp(
        &self,
        state: &CraftState,
        inputs: &CraftInputs,
        direction: (&[f64], &[f64]),
        change: &mut [f64],
    ) -> Result<(), EvaluationError> {
        self.check_smooth()?;
        let (_, along) = precess_craft::jvp(&self.craft, state, inputs, direction)?;
        let hub = along.r_b_n_ddot.iter().chain(&along.omega_dot).copied();
        let found = hub.chain(along.devices.values()).chain(along.modal.eta_ddot.iter().copied());
        change.iter_mut().zip(found).for_each(|(to, from)| *to = from);
        Ok(())
    }

    /// The gradient of the sum of the accelerations times weights by states and inputs of [`Self::linearize`]: `C' w` and
    /// `D' w`, without the matrices. Weights are in the order of the rows of `C`; `kept` is what an earlier
    /// call left.
    ///
    /// # Errors
    ///
    /// [`EvaluationError::Friction`]; as [`precess_dynamics::Spacecraft::vjp`].
    pub fn vjp(
        &self,
        state: &CraftState,
        inputs: &CraftInputs,
        weights: &[f64],
        gradient: (&mut [f64], &mut [f64]),
        kept: &mut Option<CraftAccelerations>,
    ) -> Result<(), EvaluationError> {
        self.check_smooth()?;
        let weighed = match kept {
            Some(kept) => kept,
            None => kept.insert(self.craft.accelerations(state, inputs)?),
        };
        let hub = weighed.r_b_n_ddot.iter_mut().chain(&mut weighed.omega_dot);
        let all = hub.chain(weighed.devices.values_mut()).chain(&mut weighed.modal.eta_ddot);
        all.zip(weights).for_each(|(to, from)| *to = *from);
        precess_craft::vjp(&self.craft, state, inputs, weighed, gradient)?;
        Ok(())
    }
}
