//! Many states of one spacecraft in lanes: evaluations, and whole runs. Putting the states into
//! lanes and taking the results out counts.

use std::hint::black_box;

use precess_dynamics::lanes::{Batch, LanedSet};
use precess_dynamics::{Inputs, State};
use precess_tests::stored::Stored;

use super::one::{NUDGE, flat};
use super::{Rejected, Service};

/// States in a call: enough that starting costs nothing, and their data stay in the first cache.
const STATES: usize = 64;
/// The same as evaluations.
const EVALUATIONS: u32 = 64;
/// Steps of a run in one call.
const STEPS: usize = 10;
/// The evaluations of those steps of all states, four in each step.
const IN_RUNS: u32 = 2560;
/// Step of the integrator, s, as of a single state's steps.
const STEP: f64 = 1e-6;
/// By how much the body rate of a state exceeds that of the one before, of itself.
const APART: f64 = 1e-3;

/// A spacecraft in many states.
pub(crate) struct Many<D: LanedSet> {
    craft: Batch<D>,
    states: Vec<State<D>>,
    inputs: Inputs<D>,
}

impl<D: LanedSet> Many<D> {
    pub(super) fn open(stored: &Stored, devices: &D) -> Result<Self, Rejected> {
        let craft = Batch::new(&stored.hub(), devices)?.fused();
        let mut state = stored.motion(State::at_rest_for(craft.spacecraft()));
        let inputs = stored.forces(Inputs::none_for(craft.spacecraft()));
        let mut states = Vec::new();
        while states.len() < STATES {
            states.push(state.clone());
            state.omega *= 1.0 + APART;
        }
        Ok(Self { craft, states, inputs })
    }
}

/// Their accelerations.
pub(crate) struct Evaluated<D: LanedSet>(pub(super) Many<D>);

impl<D: LanedSet> Service for Evaluated<D> {
    fn accelerations(&mut self) -> Result<Vec<f64>, Rejected> {
        let Many { craft, states, inputs } = &self.0;
        let mut found = Vec::new();
        craft.accelerations(states, inputs, &mut found)?;
        Ok(flat(&found.into_iter().next().ok_or("no state")??))
    }

    fn run(&mut self, calls: u32) -> Result<(), Rejected> {
        let Many { craft, states, inputs } = &mut self.0;
        let mut found = Vec::with_capacity(STATES);
        for _ in 0..calls {
            craft.accelerations(black_box(states), &*inputs, &mut found)?;
            for (state, found) in states.iter_mut().zip(&found) {
                let found = found.as_ref().map_err(ToString::to_string)?;
                state.omega += found.omega_dot * NUDGE;
            }
        }
        Ok(())
    }

    fn evaluations(&self) -> u32 {
        EVALUATIONS
    }
}

/// Their runs.
pub(crate) struct Runs<D: LanedSet>(pub(super) Many<D>);

impl<D: LanedSet> Service for Runs<D> {
    /// Those that the runs are made of.
    fn accelerations(&mut self) -> Result<Vec<f64>, Rejected> {
        let Many { craft, states, inputs } = &self.0;
        let mut found = Vec::new();
        craft.accelerations(states, inputs, &mut found)?;
        Ok(flat(&found.into_iter().next().ok_or("no state")??))
    }

    fn run(&mut self, calls: u32) -> Result<(), Rejected> {
        let Many { craft, states, inputs } = &self.0;
        let (mut states, mut found) = (states.clone(), Vec::with_capacity(STATES));
        for _ in 0..calls {
            craft.run(black_box(&mut states), inputs, STEP, STEPS, &mut found)?;
            for found in &found {
                found.as_ref().map_err(ToString::to_string)?;
            }
        }
        black_box(states);
        Ok(())
    }

    fn evaluations(&self) -> u32 {
        IN_RUNS
    }
}
