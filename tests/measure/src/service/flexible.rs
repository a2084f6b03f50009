//! Four reaction wheels on what gives: on flexible bearings, on an isolated platform, on a structure
//! that bends; and on a rigid hub.

use std::hint::black_box;

use precess_dynamics::{
    Devices, FlexibleInputs, FlexibleReactionWheel, FlexibleSpacecraft, FlexibleState, Isolated,
    ListedModes, ReactionWheel, Spacecraft, Suspension,
};
use precess_tests::bending::{WHEELS, structure, swing};
use serde_json::Value;

use super::listed::Listed;
use super::one::{NUDGE, One, flat};
use super::{Rejected, Service};

/// Opens a case, by what is in its file.
pub(super) fn open(
    listed: &Listed,
    rigid: Option<Vec<ReactionWheel>>,
    soft: Option<Vec<FlexibleReactionWheel>>,
) -> Result<Box<dyn Service>, Rejected> {
    if let Some(soft) = soft {
        return Ok(Box::new(one(listed, &four(soft)?)?));
    }
    let wheels = four(rigid.ok_or("other devices than reaction wheels")?)?;
    if let Some(platform) = listed.platform() {
        let set = Isolated { platform, suspension: Suspension::none(), carried: wheels };
        return Ok(Box::new(one(listed, &set)?));
    }
    match listed.modes {
        0 => Ok(Box::new(one(listed, &wheels)?)),
        _ => Ok(Box::new(Bending::open(listed, &wheels)?)),
    }
}

fn four<K>(devices: Vec<K>) -> Result<[K; WHEELS], Rejected> {
    devices.try_into().map_err(|_| "another number of devices".into())
}

fn one<D: Devices<Scalar = f64>>(listed: &Listed, devices: &D) -> Result<One<D>, Rejected> {
    let craft = Spacecraft::new(&listed.hub(), devices)?;
    let (state, inputs) = (listed.state(&craft), listed.inputs(&craft));
    Ok(One { craft, state, inputs })
}

/// A structure with a wheel on each of four mounts.
struct Bending {
    craft: FlexibleSpacecraft<[ReactionWheel; WHEELS], ListedModes>,
    state: FlexibleState<[ReactionWheel; WHEELS], ListedModes>,
    inputs: FlexibleInputs<[ReactionWheel; WHEELS], ListedModes>,
}

impl Bending {
    fn open(listed: &Listed, wheels: &[ReactionWheel; WHEELS]) -> Result<Self, Rejected> {
        let rigid = one(listed, wheels)?;
        let modes = structure(listed.modes, &wheels.map(|wheel| wheel.r_w_b));
        let craft = FlexibleSpacecraft::new(&listed.hub(), &modes, wheels, &[0, 1, 2, 3])?;
        let mut state = FlexibleState::at_rest(&craft);
        state.rigid = rigid.state;
        swing(&mut state.eta);
        let mut inputs = FlexibleInputs::none_for(&craft);
        inputs.rigid = rigid.inputs;
        Ok(Self { craft, state, inputs })
    }
}

impl Service for Bending {
    fn check(&mut self) -> Result<Value, Rejected> {
        Ok(flat(&self.craft.accelerations(&self.state, &self.inputs)?.rigid))
    }

    fn run(&mut self, calls: u32) -> Result<(), Rejected> {
        for _ in 0..calls {
            let found = self.craft.accelerations(black_box(&self.state), &self.inputs)?;
            self.state.rigid.omega += black_box(&found).rigid.omega_dot * NUDGE;
        }
        Ok(())
    }

    fn units(&self) -> u32 {
        1
    }
}
