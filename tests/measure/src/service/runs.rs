//! Many states in lanes, whole steps of the classical Runge-Kutta method.

use std::hint::black_box;

use nalgebra::Vector3;
use precess_dynamics::lanes::{Batch, LanedSet};
use precess_dynamics::{Inputs, State};
use serde_json::Value;

use super::batch::{apart, first, run};
use super::listed::Listed;
use super::step::{CHECKED, STEP, motions};
use super::{Rejected, Service};

/// States, as many as of the peers' batches.
pub(super) const STATES: u32 = 256;
/// Steps in a call.
const STEPS: u32 = 10;
/// Step where motions are compared, s: short, since the attitude of `MuJoCo` 3.14, which one peer needs,
/// differs with longer ones (`tests/peers/README.md`).
const COMPARED: f64 = 2e-7;

/// States that move on.
pub(crate) struct Runs<D: LanedSet> {
    batch: Batch<D>,
    states: Vec<State<D>>,
    inputs: Inputs<D>,
}

impl<D: LanedSet> Runs<D> {
    pub(super) fn open(listed: &Listed, batch: Batch<D>) -> Result<Self, Rejected> {
        let craft = first(&batch)?;
        // MuJoCo takes a force along the world's axes, we along B's: none acts.
        let inputs = Inputs { force: Vector3::zeros(), ..listed.inputs(craft) };
        let state = listed.state(craft);
        Ok(Self { batch, states: apart(state, STATES), inputs })
    }
}

impl<D: LanedSet> Service for Runs<D> {
    /// The first state's motion and, of one spacecraft, the last one's.
    fn check(&mut self) -> Result<Value, Rejected> {
        let mut states = self.states.clone();
        let steps = (COMPARED, usize::try_from(CHECKED)?);
        run(&self.batch, &mut states, &self.inputs, steps)?;
        let mut pairs: Vec<_> = self.states.iter().zip(&states).collect();
        pairs.drain(1..pairs.len() - 1);
        if self.batch.spacecraft().len() > 1 {
            pairs.truncate(1);
        }
        Ok(motions(&pairs, COMPARED))
    }

    fn run(&mut self, calls: u32) -> Result<(), Rejected> {
        let (mut states, steps) = (self.states.clone(), usize::try_from(STEPS)?);
        for _ in 0..calls {
            run(&self.batch, black_box(&mut states), &self.inputs, (STEP, steps))?;
        }
        black_box(states);
        Ok(())
    }

    fn units(&self) -> u32 {
        STATES * STEPS
    }
}
