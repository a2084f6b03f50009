//! What an evaluation is made of: operations as counted, sines and hub as timed by themselves, and
//! the longest chain of operations that wait for each other.

use std::hint::black_box;

use precess_dynamics::kind::{Each, JointStates};
use precess_dynamics::{Angle, Spacecraft, State};
use precess_tests::counted::{Counted, count, timed};
use precess_tests::measured::{Measured, dgvscmg};
use precess_tests::stored::Stored;
use serde_json::{Value, json};

use crate::latency::latencies;
use crate::service::{Rejected, Service, open_hub};
use crate::timing::time;

/// The parts of an evaluation of this spacecraft.
pub(crate) fn parts(stored: &Stored) -> Result<Value, Rejected> {
    let counted = Measured::new(&vec![dgvscmg::<Counted>(); stored.devices.len()]);
    let (found, operations) = count(|| counted.accelerations());
    found.map_err(|error| error.to_string())?;
    let found =
        timed(latencies(), || counted.accelerations()).map_err(|error| error.to_string())?;
    let hub = found.r_b_n_ddot.iter().chain(&found.omega_dot).copied();
    let ready = hub.chain(found.devices.values()).map(Counted::ready).fold(0.0, f64::max);
    let craft = Spacecraft::new(&stored.hub(), &stored.dgvscmgs().collect::<Vec<_>>())?;
    let state = stored.motion(State::at_rest_for(&craft));
    let angles = state.devices.states().map(|[angle, _]| angle).collect();
    Ok(json!({
        "operations": operations.arithmetic(),
        "chain_ns": ready,
        "sin_cos": operations.sin_cos,
        "sin_cos_ns": time(&mut Sines(angles))?["ns"],
        "hub_ns": time(open_hub(stored)?.as_mut())?["ns"],
    }))
}

/// Sine and cosine of each angle: as many as an evaluation computes, by themselves.
struct Sines(Vec<f64>);

impl Service for Sines {
    fn check(&mut self) -> Result<Value, Rejected> {
        Ok(Value::Null)
    }

    fn run(&mut self, calls: u32) -> Result<(), Rejected> {
        for _ in 0..calls {
            for angle in black_box(&self.0) {
                black_box(Angle::sin_cos(*angle));
            }
        }
        Ok(())
    }

    fn units(&self) -> u32 {
        1
    }
}
