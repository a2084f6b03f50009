//! [`Batch`]: many states of one spacecraft, in the lanes of the widest registers at hand.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use std::vec::Vec;

use super::batch_inputs::BatchInputs;
use super::calls::{accelerations, run};
use super::constants::{CraftBlocks, OwnLoads};
use super::crafts::Crafts;
use super::laned_set::LanedSet;
use super::observers::{Observers, none};
use crate::equations::error::SolveError;
use crate::model::parameters::Hub;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::{Accelerations, State};
use crate::validation::parameter_error::ParameterError;

/// What became of each state of a batch, in order.
pub type BatchAccelerations<D> = Vec<Result<Accelerations<D>, SolveError<f64>>>;

/// A spacecraft that is evaluated at many states at a time.
///
/// A state has the result, or the error, that [`Spacecraft`] gives it by itself, to the bit. A state
/// falls back to the scalar path where it has what is [unsupported in lanes](crate::lanes), and where
/// anything fails.
#[derive(Clone, Debug)]
pub struct Batch<D: LanedSet> {
    craft: Spacecraft<D>,
    own: OwnLoads,
    #[cfg(feature = "threads")]
    on_threads: bool,
}

impl<D: LanedSet> Batch<D> {
    /// Checks the parameters and computes everything that depends only on them.
    ///
    /// # Errors
    ///
    /// As [`Spacecraft::new`].
    pub fn new(hub: &Hub, devices: &D) -> Result<Self, ParameterError<f64>> {
        let craft = Spacecraft::new(hub, devices)?;
        Ok(Self {
            own: OwnLoads::of(&craft),
            craft,
            #[cfg(feature = "threads")]
            on_threads: false,
        })
    }

    /// The same on the threads of rayon's pool: that in which a call is made, by
    /// `ThreadPool::install`, else the global one. The same results, by however many threads. Worth it
    /// for runs, and for the accelerations of several thousand states: those of a thousand or fewer
    /// are evaluated on one thread.
    #[cfg(feature = "threads")]
    #[must_use]
    pub fn on_threads(self) -> Self {
        Self { on_threads: true, ..self }
    }

    /// The spacecraft, for everything that is asked of one state.
    #[must_use]
    pub fn spacecraft(&self) -> &Spacecraft<D> {
        &self.craft
    }

    /// All accelerations of each state, as [`Spacecraft::accelerations`]. `out` is cleared first.
    ///
    /// # Errors
    ///
    /// [`SolveError::Count`] where there are inputs for another number of states; a state that
    /// cannot be evaluated has its own error in `out`.
    pub fn accelerations<'a>(
        &self,
        states: &[State<D>],
        inputs: impl Into<BatchInputs<'a, D>>,
        out: &mut BatchAccelerations<D>,
    ) -> Result<(), SolveError<f64>>
    where
        D: 'a,
    {
        accelerations(self, states, &inputs.into(), out)
    }

    /// Advances each state by so many steps, as [`Spacecraft::step`] does; a state that fails is
    /// left as it was before the step that failed. `out` is cleared first.
    ///
    /// # Errors
    ///
    /// As [`Self::accelerations`], and [`SolveError::NotFinite`] of a step that is not finite.
    pub fn run<'a>(
        &self,
        states: &mut [State<D>],
        inputs: impl Into<BatchInputs<'a, D>>,
        dt: f64,
        steps: usize,
        out: &mut Vec<Result<(), SolveError<f64>>>,
    ) -> Result<(), SolveError<f64>>
    where
        D: 'a,
    {
        run(self, states, &inputs.into(), (dt, steps), none(), out)
    }

    /// [`Self::run`], each state observed on the way.
    ///
    /// # Errors
    ///
    /// As [`Self::run`], and [`SolveError::Count`] where there are records for another number of
    /// states.
    pub fn run_observed<'a, R: Send, F: Fn(&mut R, usize, &State<D>) + Sync>(
        &self,
        states: &mut [State<D>],
        inputs: impl Into<BatchInputs<'a, D>>,
        dt: f64,
        steps: usize,
        observers: Observers<'_, R, F>,
        out: &mut Vec<Result<(), SolveError<f64>>>,
    ) -> Result<(), SolveError<f64>>
    where
        D: 'a,
    {
        run(self, states, &inputs.into(), (dt, steps), Some(observers), out)
    }
}

impl<D: LanedSet> Crafts<D> for Batch<D> {
    const EACH: bool = false;

    #[cfg(feature = "threads")]
    fn are_on_threads(&self) -> bool {
        self.on_threads
    }

    fn count(&self) -> Option<usize> {
        None
    }

    #[inline(always)]
    fn at(&self, _: usize) -> Option<&Spacecraft<D>> {
        Some(&self.craft)
    }

    #[inline(always)]
    fn blocks(&self, _: usize) -> Option<&CraftBlocks<D>> {
        None
    }

    #[inline(always)]
    fn own_loads(&self, _: usize) -> OwnLoads {
        self.own
    }
}
