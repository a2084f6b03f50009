//! Inputs: from a structure, and the structure in which nothing acts.

use nalgebra::Vector3;
use precess_dynamics::{Gravity, HubMode, Inputs, JointArray, Mode, Spacecraft, Wrench};

use crate::List;
use crate::craft::{Craft, craft};
use crate::error::{Code, Rejection};
use crate::memory;
use crate::state::{give, take};
use crate::types;

/// The inputs that a structure states.
pub(crate) fn inputs_of<const J: usize>(
    spacecraft: &Spacecraft<List>,
    from: &types::Inputs<J>,
) -> Result<Inputs<List>, Rejection> {
    let vector = Vector3::from;
    let mut inputs = Inputs::none_for(spacecraft);
    inputs.force = vector(from.force);
    inputs.torque_b = vector(from.torque);
    take(&mut inputs.motors, &from.motor);
    let given = from.mode.iter().zip(&from.prescribed).enumerate();
    for (to, (device, (modes, prescribed))) in inputs.modes.iter_mut().zip(given) {
        let to = to.iter_mut().flat_map(JointArray::as_mut_slice);
        for (to, (mode, prescribed)) in to.zip(modes.iter().zip(prescribed)) {
            *to = match mode {
                0 => Mode::Driven,
                1 => Mode::Prescribed(*prescribed),
                2 => Mode::Locked,
                _ => return Err(Rejection { device: Some(device), ..Code::UnknownChoice.into() }),
            };
        }
    }
    inputs.hub = match from.hub_mode {
        0 => HubMode::Free,
        1 => HubMode::Fixed,
        2 => HubMode::Prescribed {
            r_b_n_ddot: vector(from.hub_linear),
            omega_dot: vector(from.hub_angular),
        },
        _ => return Err(Code::UnknownChoice.into()),
    };
    inputs.gravity = match from.gravity_model {
        0 => Gravity::None,
        1 => Gravity::Uniform(vector(from.gravity)),
        2 => Gravity::Central { mu: from.mu },
        _ => return Err(Code::UnknownChoice.into()),
    };
    match from.wrenches {
        0 => {}
        1 => {
            let mut bodies = Inputs::no_wrenches_for(spacecraft);
            let wrench = |wrench: types::Wrench| Wrench {
                force: vector(wrench.force),
                moment: vector(wrench.moment),
            };
            take(&mut bodies, &from.wrench.map(|device| device.map(wrench)));
            inputs.bodies = Some(bodies);
        }
        _ => return Err(Code::UnknownChoice.into()),
    }
    Ok(inputs)
}

/// See `precess.h`.
///
/// # Safety
///
/// `craft` points to a spacecraft, `inputs` to inputs.
pub(crate) unsafe fn inputs_none<const J: usize>(
    pointer: *const Craft,
    inputs: *mut types::Inputs<J>,
) -> i32 {
    // SAFETY: by contract.
    let done = unsafe { craft::<J>(pointer) }.and_then(|craft| {
        let none = types::Wrench { force: [0.0; 3], moment: [0.0; 3] };
        let mut to = types::Inputs {
            force: [0.0; 3],
            torque: [0.0; 3],
            motor: [[0.0; J]; crate::MAX_DEVICES],
            prescribed: [[0.0; J]; crate::MAX_DEVICES],
            hub_linear: [0.0; 3],
            hub_angular: [0.0; 3],
            gravity: [0.0; 3],
            mu: 0.0,
            wrench: [[none; J]; crate::MAX_DEVICES],
            mode: [[0; J]; crate::MAX_DEVICES],
            hub_mode: 0,
            gravity_model: 0,
            wrenches: 0,
            reserved: 0,
        };
        let own = Inputs::none_for(&craft.spacecraft);
        give(&mut to.mode, &own.modes, |mode| match mode {
            Mode::Driven => 0,
            Mode::Prescribed(_) => 1,
            Mode::Locked => 2,
        });
        // SAFETY: by contract.
        unsafe { memory::write(inputs, to) }
    });
    done.err().unwrap_or(Code::Ok) as i32
}
