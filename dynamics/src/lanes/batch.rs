//! [`Batch`]: many states, in the lanes of the widest registers at hand.

use std::sync::Arc;
use std::vec::Vec;

use super::batch_inputs::BatchInputs;
use super::batch_spacecraft::{SharedSpacecraft, SpacecraftPerState};
use super::calls::{accelerations, run};
use super::laned_set::LanedSet;
use super::observers::{Observers, none};
use super::part::Parts;
use crate::equations::error::SolveError;
use crate::model::parameters::Hub;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::{Accelerations, State};
use crate::validation::parameter_error::ParameterError;

/// What became of each state of a batch, in order.
pub type BatchAccelerations<D> = Vec<Result<Accelerations<D>, SolveError<f64>>>;

/// Many states at a time: of one spacecraft ([`Self::new`]), or each of its own
/// ([`Self::from_spacecraft`]).
///
/// A state has the result, or the error, that its [`Spacecraft`] gives it by itself, to the bit. A
/// state falls back to the scalar path where it or its spacecraft has what is
/// [unsupported in lanes](crate::lanes), and where anything fails.
#[derive(Clone, Debug)]
pub struct Batch<D: LanedSet> {
    pub(super) crafts: Arc<dyn Parts<D>>,
    #[cfg(feature = "threads")]
    pub(super) on_threads: bool,
}

impl<D: LanedSet> Batch<D> {
    /// One spacecraft for all states: checks the parameters and computes everything that depends only
    /// on them.
    ///
    /// # Errors
    ///
    /// As [`Spacecraft::new`].
    pub fn new(hub: &Hub, devices: &D) -> Result<Self, ParameterError<f64>> {
        Ok(Self::of(Arc::new(SharedSpacecraft::new(Spacecraft::new(hub, devices)?))))
    }

    /// One spacecraft for each state, in their order: spacecraft of one shape whose parameters
    /// differ, such as masses, offsets, imbalances, mounts and springs of a campaign.
    ///
    /// Vectors of devices may differ in length. As many spacecraft as there are lanes are evaluated
    /// together where all of their vectors have the lengths of those of the first spacecraft of the
    /// batch; others fall back to the scalar path.
    #[must_use]
    pub fn from_spacecraft(spacecraft: Vec<Spacecraft<D>>) -> Self {
        Self::of(Arc::new(SpacecraftPerState::new(spacecraft)))
    }

    fn of(crafts: Arc<dyn Parts<D>>) -> Self {
        Self {
            crafts,
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

    /// The spacecraft: one, or one for each state.
    #[must_use]
    pub fn spacecraft(&self) -> &[Spacecraft<D>] {
        self.crafts.spacecraft()
    }

    /// All accelerations of each state, as [`Spacecraft::accelerations`]. `out` is cleared first.
    ///
    /// # Errors
    ///
    /// [`SolveError::Count`] where there are spacecraft or inputs for another number of states; a
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
