//! [`Observers`]: what sees the states of a run on the way.

use core::fmt;

/// What sees the states of a run on the way: after every so many steps, a function of each state and
/// of a record of its own.
///
/// A record may be a list of states, or what they are reduced to:
///
/// ```
/// # use nalgebra::{Matrix3, Vector3};
/// use precess_dynamics::lanes::{Batch, Observers};
/// # use precess_dynamics::{Hub, Inputs, ReactionWheel, State};
/// # let disc = Matrix3::from_diagonal(&Vector3::new(0.02, 0.01, 0.01));
/// # let hub = Hub { m_b: 50.0, r_bc_b: Vector3::zeros(), i_b_bc: Matrix3::identity() };
/// # let batch = Batch::new(&hub, &[ReactionWheel::bare_wheel(3.0, disc)])?;
/// # let mut inputs: Inputs<[ReactionWheel; 1]> = Inputs::none();
/// # inputs.motors[0].u_w = 0.1;
/// let mut states: Vec<State<[ReactionWheel; 1]>> = vec![State::at_rest(); 20];
/// let mut fastest = vec![0.0_f64; 20];
/// let observers = Observers::new(10, &mut fastest, |fastest, _, state: &State<_>| {
///     *fastest = fastest.max(state.omega.norm());
/// });
/// let mut ends = Vec::new();
/// batch.run_observed(&mut states, &inputs, 1e-3, 100, observers, &mut ends)?;
/// assert!(fastest.iter().zip(&states).all(|(rate, state)| *rate == state.omega.norm()));
///
/// // Every tenth state of each run.
/// let mut records = vec![Vec::new(); 20];
/// let observers = Observers::new(10, &mut records, |record: &mut Vec<_>, step, state: &State<_>| {
///     record.push((step, *state));
/// });
/// batch.run_observed(&mut states, &inputs, 1e-3, 100, observers, &mut ends)?;
/// assert!(records.iter().all(|record: &Vec<_>| record.len() == 10));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Observers<'o, R, F> {
    pub(super) every: usize,
    pub(super) records: &'o mut [R],
    pub(super) observe: F,
}

impl<'o, R, F> Observers<'o, R, F> {
    /// A function that is called after every so many steps (zero counts as one) with the record of a
    /// state, the number of its steps so far and the state. `records` has one for each state.
    ///
    /// The states at the start are not observed, nor is a state after a step that failed.
    #[must_use]
    pub fn new<S>(every: usize, records: &'o mut [R], observe: F) -> Self
    where
        F: Fn(&mut R, usize, &S) + Sync,
    {
        Self { every: every.max(1), records, observe }
    }
}

impl<R: fmt::Debug, F> fmt::Debug for Observers<'_, R, F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { every, records, .. } = self;
        let mut shown = f.debug_struct("Observers");
        shown.field("every", every).field("records", records).finish_non_exhaustive()
    }
}

/// The observers of a run that is not observed.
type Unobserved<'o, S> = Observers<'o, (), fn(&mut (), usize, &S)>;

/// No observers.
pub(super) fn none<'o, S>() -> Option<Unobserved<'o, S>> {
    None
}
