//! [`ParameterBatch`]: as many spacecraft of one shape as there are states, in lanes.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use std::sync::Arc;
use std::vec::Vec;

use super::batch::BatchAccelerations;
use super::batch_inputs::BatchInputs;
use super::calls::{accelerations, run};
use super::constants::{CraftBlocks, OwnLoads};
use super::crafts::Crafts;
use super::laned_set::LanedSet;
use super::observers::{Observers, none};
use super::width::widest_width;
use crate::equations::error::SolveError;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::State;

/// Spacecraft of one shape whose parameters differ, each at its own state: masses, offsets,
/// imbalances, mounts, springs of a campaign.
///
/// Vectors of devices may differ in length. As many spacecraft as there are lanes are evaluated
/// together where all of their vectors have the lengths of those of the first spacecraft of the batch;
/// others fall back to the scalar path.
///
/// A state has the result, or the error, that its [`Spacecraft`] gives it by itself, to the bit. A
/// state falls back to the scalar path where it or its spacecraft has what is
/// [unsupported in lanes](crate::lanes), and where anything fails.
#[derive(Clone, Debug)]
pub struct ParameterBatch<D: LanedSet> {
    crafts: Vec<Spacecraft<D>>,
    /// As many spacecraft as there are lanes, side by side; none where their lists differ in length.
    groups: Arc<[Option<CraftBlocks<D>>]>,
    #[cfg(feature = "threads")]
    on_threads: bool,
}

impl<D: LanedSet> ParameterBatch<D> {
    /// The batch of these spacecraft, in their order. Each was checked by [`Spacecraft::new`].
    #[must_use]
    pub fn new(spacecraft: Vec<Spacecraft<D>>) -> Self {
        // The registers that every evaluation chooses.
        let groups = spacecraft.chunks(widest_width());
        let groups = groups.map(|group| CraftBlocks::new(group, spacecraft.first()?)).collect();
        Self {
            crafts: spacecraft,
            groups,
            #[cfg(feature = "threads")]
            on_threads: false,
        }
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

    /// The spacecraft, for everything that is asked of one of them.
    #[must_use]
    pub fn spacecraft(&self) -> &[Spacecraft<D>] {
        &self.crafts
    }

    /// All accelerations of each spacecraft at its state, as [`Spacecraft::accelerations`]. `out` is
    /// cleared first.
    ///
    /// # Errors
    ///
    /// [`SolveError::Count`] where there are states or inputs for another number of spacecraft; a
    /// state that cannot be evaluated has its own error in `out`.
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

impl<D: LanedSet> Crafts<D> for ParameterBatch<D> {
    const EACH: bool = true;

    #[cfg(feature = "threads")]
    fn are_on_threads(&self) -> bool {
        self.on_threads
    }

    fn count(&self) -> Option<usize> {
        Some(self.crafts.len())
    }

    #[inline(always)]
    fn at(&self, state: usize) -> Option<&Spacecraft<D>> {
        self.crafts.get(state)
    }

    #[inline(always)]
    fn blocks(&self, group: usize) -> Option<&CraftBlocks<D>> {
        self.groups.get(group)?.as_ref()
    }

    #[inline(always)]
    fn own_loads(&self, group: usize) -> OwnLoads {
        self.blocks(group).map_or(OwnLoads { dry: false, lumped: false }, |group| group.own)
    }
}
