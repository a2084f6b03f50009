//! One state, whole steps of the classical Runge-Kutta method.

use std::hint::black_box;

use precess_dynamics::Devices;

use super::one::One;
use super::{Rejected, Service};

/// Step of the integrator, s: small, so that no batch runs into a state unlike the first.
const STEP: f64 = 1e-6;

/// A spacecraft in a state that moves on.
pub(crate) struct Step<D: Devices>(pub(super) One<D>);

impl<D: Devices<Scalar = f64>> Service for Step<D> {
    /// Those that its steps are made of.
    fn accelerations(&mut self) -> Result<Vec<f64>, Rejected> {
        self.0.accelerations()
    }

    fn run(&mut self, calls: u32) -> Result<(), Rejected> {
        let mut state = self.0.state.clone();
        for _ in 0..calls {
            state = self.0.craft.step(black_box(&state), &self.0.inputs, STEP)?;
        }
        black_box(state);
        Ok(())
    }

    fn evaluations(&self) -> u32 {
        4
    }
}
