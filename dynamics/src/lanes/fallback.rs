//! The scalar path of the states that lanes do not support, and of those that fail in a lane.

use crate::equations::error::SolveError;
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::{Accelerations, State};

use super::laned_set::LanedSet;
use crate::equations::side_by_side::fallbacks::count;

/// One state's accelerations.
pub(super) fn accelerations<D: LanedSet>(
    craft: &Spacecraft<D>,
    state: &State<D>,
    inputs: &Inputs<D>,
) -> Result<Accelerations<D>, SolveError<f64>> {
    count();
    craft.accelerations(state, inputs)
}

/// One state's steps; one that fails is left as it was before the step that failed.
pub(super) fn run<D: LanedSet>(
    craft: &Spacecraft<D>,
    state: &mut State<D>,
    inputs: &Inputs<D>,
    dt: f64,
    steps: usize,
) -> Result<(), SolveError<f64>> {
    count();
    for _ in 0..steps {
        *state = craft.step(state, inputs, dt)?;
    }
    Ok(())
}
