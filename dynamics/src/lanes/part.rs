//! [`Parts`]: evaluation and runs of a part of a batch, whichever spacecraft it is of.
//!
//! A trait object in [`Batch`](super::Batch): a program compiles the lanes of those batches that it
//! constructs, of one spacecraft or of one for each state.

use core::fmt::Debug;

use super::accelerations::Evaluation;
use super::batch_inputs::BatchInputs;
use super::batch_spacecraft::BatchSpacecraft;
use super::laned_set::LanedSet;
use super::run::Runs;
use crate::equations::error::SolveError;
use crate::equations::side_by_side::registers::Registers;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::{Accelerations, State};

/// Some states of a batch, whole groups of lanes.
pub(super) struct Part<'a, S, O> {
    /// The first of them in the batch.
    pub(super) start: usize,
    pub(super) states: S,
    /// What became of each state.
    pub(super) out: &'a mut [Result<O, SolveError<f64>>],
}

/// The steps of a run.
#[derive(Clone, Copy)]
pub(super) struct Steps {
    pub(super) dt: f64,
    pub(super) count: usize,
    /// After how many the states are seen; none where they are not.
    pub(super) every: Option<usize>,
}

/// Sees a state of a part, by its number there, after so many steps.
pub(super) type See<'a, D> = dyn FnMut(usize, usize, &State<D>) + 'a;

/// The spacecraft of a batch, and what is done with a part of its states.
pub(super) trait Parts<D: LanedSet>: Debug + Send + Sync {
    /// The spacecraft.
    fn spacecraft(&self) -> &[Spacecraft<D>];
    /// The number of states that they are for; none where it is any.
    fn count(&self) -> Option<usize>;
    /// Writes the accelerations; each of `out` is nothing accelerating.
    fn accelerations(
        &self,
        part: Part<'_, &[State<D>], Accelerations<D>>,
        inputs: BatchInputs<'_, D>,
    );
    /// Advances the states.
    fn run(
        &self,
        part: Part<'_, &mut [State<D>], ()>,
        inputs: BatchInputs<'_, D>,
        steps: Steps,
        see: &mut See<'_, D>,
    );
}

impl<D: LanedSet, C: BatchSpacecraft<D>> Parts<D> for C {
    fn spacecraft(&self) -> &[Spacecraft<D>] {
        self.all()
    }

    fn count(&self) -> Option<usize> {
        C::EACH.then(|| self.all().len())
    }

    fn accelerations(
        &self,
        part: Part<'_, &[State<D>], Accelerations<D>>,
        inputs: BatchInputs<'_, D>,
    ) {
        let Part { start, states, out } = part;
        let work = Evaluation { crafts: self, start, states, inputs, out };
        match Registers::widest() {
            Some(registers) => registers.dispatch(work),
            // No copy for single numbers: the scalar path has the same bits.
            None => work.one_by_one(),
        }
    }

    fn run(
        &self,
        part: Part<'_, &mut [State<D>], ()>,
        inputs: BatchInputs<'_, D>,
        steps: Steps,
        see: &mut See<'_, D>,
    ) {
        let Part { start, states, out } = part;
        let Steps { dt, count: steps, every } = steps;
        let work = Runs { crafts: self, start, states, inputs, dt, steps, every, see, out };
        match Registers::widest() {
            Some(registers) => registers.dispatch(work),
            None => work.one_by_one(),
        }
    }
}
