//! The imaging satellite by kernels of its own: a crate that `precess bake` wrote.

use std::hint::black_box;

use imaging_satellite::{
    Body, Drive, Hub, Inputs, Parameters, Spacecraft, State,
    cmg::{Device, Drives, Joints},
};
use precess_description::Description;
use serde_json::{Value, json};

use super::imaging::{DEVICES, FORCE, OMEGA, TORQUE_B, WHEELS};
use super::single_state::NUDGE;
use super::{Rejected, Service};

/// The satellite in its state.
pub(crate) struct Baked {
    craft: Spacecraft,
    state: State,
    inputs: Inputs,
}

impl Baked {
    pub(super) fn open(description: &Description) -> Result<Self, Rejected> {
        let hub = &description.hub;
        let hub = Hub { mass: hub.mass, centre_of_mass: hub.centre_of_mass, inertia: hub.inertia };
        let body = |of: &precess_description::Body| Body {
            mass: of.mass,
            origin: of.origin,
            centre_of_mass: of.centre_of_mass,
            inertia: of.inertia,
        };
        let device = |of: &precess_description::Device| {
            let [outer, inner, wheel] = of.body.as_slice() else { return Err("no three bodies") };
            let (gamma_o, gamma_i) = (outer.locked_at, inner.locked_at);
            Ok(Device {
                mount: of.mount,
                bodies: [body(outer), body(inner), body(wheel)],
                gamma_o: gamma_o.ok_or("the outer gimbal moves")?,
                gamma_i: gamma_i.ok_or("the inner gimbal moves")?,
            })
        };
        let cmg: Result<Vec<_>, _> = description.device.iter().map(device).collect();
        let cmg: [Device; DEVICES] = cmg?.try_into().map_err(|_| "another number of devices")?;
        Ok(Self {
            craft: Spacecraft::new(&Parameters { hub, cmg }).map_err(|error| error.to_string())?,
            state: State {
                omega: OMEGA,
                cmg: WHEELS.map(|[theta, spin, _]| Joints { theta, spin }),
            },
            inputs: Inputs {
                force: FORCE,
                torque_b: TORQUE_B,
                cmg: WHEELS.map(|[_, _, u_w]| Drives { u_w: Drive::Torque(u_w) }),
            },
        })
    }
}

impl Service for Baked {
    /// The locked gimbals have none.
    fn check(&mut self) -> Result<Value, Rejected> {
        let found = self.craft.accelerations(&self.state, &self.inputs);
        let found = found.map_err(|error| error.to_string())?;
        let hub = found.r_b_n_ddot.into_iter().chain(found.omega_dot);
        let joints = found.cmg.into_iter().flat_map(|own| [0.0, 0.0, own.spin_dot]);
        Ok(json!({ "accelerations": hub.chain(joints).collect::<Vec<_>>() }))
    }

    fn run(&mut self, calls: u32) -> Result<(), Rejected> {
        for _ in 0..calls {
            let found = self.craft.accelerations(black_box(&self.state), &self.inputs);
            let found = black_box(found).map_err(|error| error.to_string())?;
            for (rate, derivative) in self.state.omega.iter_mut().zip(found.omega_dot) {
                *rate += derivative * NUDGE;
            }
        }
        Ok(())
    }

    fn units(&self) -> u32 {
        1
    }
}
