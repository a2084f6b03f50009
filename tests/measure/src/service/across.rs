//! One state, its devices side by side in lanes.

use std::hint::black_box;

use precess_dynamics::lanes::AcrossDevices;
use precess_dynamics::{Dgvscmg, Inputs, State};
use precess_tests::stored::Stored;
use serde_json::Value;

use super::one::{NUDGE, flat};
use super::{Rejected, Service};

/// A spacecraft in a state.
pub(crate) struct Across<const N: usize> {
    craft: AcrossDevices<Dgvscmg, N>,
    state: State<[Dgvscmg; N]>,
    inputs: Inputs<[Dgvscmg; N]>,
}

impl<const N: usize> Across<N> {
    pub(super) fn open(stored: &Stored, devices: &[Dgvscmg; N]) -> Result<Self, Rejected> {
        let craft = AcrossDevices::new(&stored.hub(), devices)?;
        let state = stored.motion(State::at_rest_for(craft.spacecraft()));
        let inputs = stored.forces(Inputs::none_for(craft.spacecraft()));
        Ok(Self { craft, state, inputs })
    }
}

impl<const N: usize> Service for Across<N> {
    fn check(&mut self) -> Result<Value, Rejected> {
        Ok(flat(&self.craft.accelerations(&self.state, &self.inputs)?))
    }

    fn run(&mut self, calls: u32) -> Result<(), Rejected> {
        for _ in 0..calls {
            let found = self.craft.accelerations(black_box(&self.state), &self.inputs)?;
            self.state.omega += black_box(&found).omega_dot * NUDGE;
        }
        Ok(())
    }

    fn units(&self) -> u32 {
        1
    }
}
