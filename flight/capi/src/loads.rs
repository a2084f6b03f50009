//! Loads of joints and mounts, and the torques that prescribed and locked joints need.

use precess_dynamics::{LoadAxes, Spacecraft, Wrench};

use crate::List;
use crate::craft::Craft;
use crate::error::{Code, Fault};
use crate::evaluate::{state_and_inputs, with};
use crate::memory::write;
use crate::types;

fn of_wrench(wrench: &Wrench) -> types::Wrench {
    types::Wrench { force: wrench.force.into(), moment: wrench.moment.into() }
}

/// See `precess.h`.
///
/// # Safety
///
/// `craft` points to a spacecraft, the others to their structures; `fault` may be null.
pub(crate) unsafe fn loads_of<const J: usize>(
    craft: *const Craft,
    state: *const types::State<J>,
    inputs: *const types::Inputs<J>,
    axes: i32,
    out: *mut types::Loads<J>,
    fault: *mut Fault,
) -> i32 {
    let call = |craft: &Spacecraft<List>| {
        let axes = match axes {
            0 => LoadAxes::Body,
            1 => LoadAxes::Parent,
            2 => LoadAxes::Hub,
            3 => LoadAxes::Inertial,
            _ => return Err(Code::UnknownChoice.into()),
        };
        // SAFETY: by contract.
        let (state, inputs) = unsafe { state_and_inputs(craft, state, inputs) }?;
        let accelerations = craft.accelerations(&state, &inputs)?;
        let found = craft.loads(&state, &inputs, &accelerations, axes)?;
        let none = types::Wrench { force: [0.0; 3], moment: [0.0; 3] };
        let mut to = types::Loads {
            hub: of_wrench(&found.hub),
            mount: [none; crate::MAX_DEVICES],
            joint: [[none; J]; crate::MAX_DEVICES],
            motor: [[0.0; J]; crate::MAX_DEVICES],
        };
        let entries = to.mount.iter_mut().zip(&mut to.joint).zip(&mut to.motor);
        for (((mount, joints), motors), device) in entries.zip(found.devices.iter().flatten()) {
            *mount = of_wrench(&device.mount);
            for (to, from) in joints.iter_mut().zip(device.joints.as_slice()) {
                *to = of_wrench(from);
            }
            for (to, from) in motors.iter_mut().zip(device.motors.as_slice()) {
                *to = *from;
            }
        }
        // SAFETY: by contract.
        Ok(unsafe { write(out, to) }?)
    };
    // SAFETY: by contract.
    unsafe { with::<J>(craft, fault, call) }
}
