//! One state, one evaluation after another: the latency of a call.

use std::hint::black_box;

use precess_dynamics::kind::Each;
use precess_dynamics::{
    Accelerations, Devices, Inputs, Quaternion, Rigid, Spacecraft, State, Structure, StructureData,
};
use precess_tests::stored::Stored;
use serde_json::{Value, json};

use super::{Rejected, Service};

/// By what share of its derivative the angular velocity of a call exceeds that of the one before:
/// enough to make each call wait for the last, not enough to move the state.
pub(super) const NUDGE: f64 = 1e-15;

/// A spacecraft, its hub rigid or a flexible structure, in a state.
pub(crate) struct SingleState<D: Devices<Scalar = f64>, S: Structure = Rigid> {
    pub(super) craft: Spacecraft<D, S>,
    pub(super) state: State<D, Quaternion, S>,
    pub(super) inputs: Inputs<D, S>,
}

impl<D: Devices<Scalar = f64>> SingleState<D> {
    pub(super) fn open(stored: &Stored, devices: &D) -> Result<Self, Rejected> {
        let craft = Spacecraft::new(&stored.hub(), devices)?;
        let state = stored.motion(State::at_rest_for(&craft));
        let inputs = stored.forces(Inputs::none_for(&craft));
        Ok(Self { craft, state, inputs })
    }
}

impl<D: Devices<Scalar = f64>, S: Structure> Service for SingleState<D, S> {
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

/// The accelerations in a row.
pub(super) fn flat<D: Devices<Scalar = f64>, S: StructureData>(
    found: &Accelerations<D, S>,
) -> Value {
    let hub = found.r_b_n_ddot.iter().chain(&found.omega_dot).copied();
    json!({ "accelerations": hub.chain(found.devices.values()).collect::<Vec<_>>() })
}
