//! Four reaction wheels on what gives: on flexible bearings, on an isolated platform, on a structure
//! that bends; and on a rigid hub.

use std::hint::black_box;

use nalgebra::Vector3;
use precess_dynamics::{
    Devices, FlexibleInputs, FlexibleReactionWheel, FlexibleSpacecraft, FlexibleState, Isolated,
    ListedModes, ModalMount, ModalPoint, ModalStorage as _, Modes, ReactionWheel, Spacecraft,
    Suspension,
};
use serde_json::Value;

use super::listed::Listed;
use super::one::{NUDGE, One, flat};
use super::{Rejected, Service};

/// The wheels of every case.
const WHEELS: usize = 4;

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
        for (k, eta) in (0_u16..).zip(&mut state.eta) {
            *eta = 1e-3 * f64::from(k).sin();
        }
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

/// Modes from 20 rad/s on, one every 10, with momentum, and shapes of some hundredths at the mounts.
fn structure(modes: usize, places: &[Vector3<f64>; WHEELS]) -> Modes<ListedModes> {
    // Phases that grow with the square of the number: no shape depends on a few others.
    let wave = |scale: f64, at: f64| {
        let numbers = (0_u16..).map(f64::from).take(modes);
        let shape = numbers.map(|k| {
            let phase = 1.3 * k * k + (at + 1.0) * k;
            let [x, z] = [phase, 1.9 * phase].map(f64::sin);
            Vector3::new(x, (0.7 * phase + at).cos(), z) * scale
        });
        shape.collect::<Vec<_>>()
    };
    let mount = |(at, position): (f64, &Vector3<f64>)| ModalMount {
        point: ModalPoint {
            position: *position,
            translation: wave(0.02, at),
            rotation: wave(0.02, at + 0.5),
        },
        contained: None,
    };
    Modes {
        frequencies: (0_u16..).map(|k| 20.0 + 10.0 * f64::from(k)).take(modes).collect(),
        damping: ListedModes::modes(modes, &0.005),
        linear: wave(0.5, 7.0),
        angular: wave(0.5, 8.0),
        mounts: [0.0, 1.0, 2.0, 3.0].into_iter().zip(places).map(mount).collect(),
    }
}
