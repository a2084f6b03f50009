//! [`BatchInputs`]: what acts on the states of a batch, the same on all or one for each.

use std::vec::Vec;

use super::laned_set::LanedSet;
use crate::equations::error::SolveError;
use crate::solve::inputs::Inputs;

/// What acts on the states of a batch.
#[derive(Clone, Copy, Debug)]
pub enum BatchInputs<'a, D: LanedSet> {
    /// The same on each.
    Same(&'a Inputs<D>),
    /// One for each state, in order.
    Each(&'a [Inputs<D>]),
}

impl<'a, D: LanedSet> From<&'a Inputs<D>> for BatchInputs<'a, D> {
    fn from(inputs: &'a Inputs<D>) -> Self {
        Self::Same(inputs)
    }
}

impl<'a, D: LanedSet> From<&'a [Inputs<D>]> for BatchInputs<'a, D> {
    fn from(inputs: &'a [Inputs<D>]) -> Self {
        Self::Each(inputs)
    }
}

impl<'a, D: LanedSet> From<&'a Vec<Inputs<D>>> for BatchInputs<'a, D> {
    fn from(inputs: &'a Vec<Inputs<D>>) -> Self {
        Self::Each(inputs)
    }
}

impl<'a, D: LanedSet> BatchInputs<'a, D> {
    pub(super) fn at(&self, index: usize) -> Option<&'a Inputs<D>> {
        match self {
            Self::Same(inputs) => Some(inputs),
            Self::Each(inputs) => inputs.get(index),
        }
    }

    /// The inputs from a state on.
    pub(super) fn starting(&self, start: usize) -> Self {
        match self {
            Self::Same(inputs) => Self::Same(inputs),
            Self::Each(inputs) => Self::Each(inputs.get(start..).unwrap_or(&[])),
        }
    }

    /// Whether there are as many as states.
    pub(super) fn fit(&self, states: usize) -> Result<(), SolveError<f64>> {
        match self {
            Self::Each(inputs) if inputs.len() != states => {
                Err(SolveError::Count { expected: states, found: inputs.len() })
            }
            _ => Ok(()),
        }
    }
}
