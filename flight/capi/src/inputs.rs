//! Inputs: from a structure, and the structure in which nothing acts.

use nalgebra::Vector3;
use precess_dynamics::{Each, Gravity, HubMode, Inputs, Mode, Wrench};

use crate::craft::{Craft, StoredSpacecraft, code_number, craft};
use crate::error::{Code, Rejection};
use crate::memory::OutputPointer;
use crate::types;
use crate::version::{Interface, SetOf, Versions, give, take};

/// Writes the inputs that a structure states to inputs in which nothing acts. They are large: a
/// result of them would be copied.
pub(crate) fn take_inputs<const J: usize>(
    craft: &StoredSpacecraft<SetOf<J>>,
    from: &types::Inputs<J>,
    inputs: &mut Inputs<SetOf<J>>,
) -> Result<(), Rejection>
where
    Versions: Interface<J>,
{
    let StoredSpacecraft { spacecraft, entry_map, .. } = craft;
    let vector = Vector3::from;
    inputs.force = vector(from.force);
    inputs.torque_b = vector(from.torque);
    take(inputs.motors.values_mut(), &from.motor, entry_map, |motor| *motor);
    let mut joints = entry_map.joints();
    inputs.modes.values_mut().try_for_each(|to| {
        let Some([entry, joint]) = joints.next() else { return Ok(()) };
        let mode = from.mode.get(entry).and_then(|modes| modes.get(joint));
        let prescribed = from.prescribed.get(entry).and_then(|joints| joints.get(joint));
        *to = match (mode, prescribed) {
            (Some(0), _) => Mode::Driven,
            (Some(1), Some(acceleration)) => Mode::Prescribed(*acceleration),
            (Some(2), _) => Mode::Locked,
            _ => return Err(Rejection { entry: Some(entry), ..Code::UnknownChoice.into() }),
        };
        Ok(())
    })?;
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
            let wrench = |wrench: &types::Wrench| Wrench {
                force: vector(wrench.force),
                moment: vector(wrench.moment),
            };
            take(bodies.values_mut(), &from.wrench, entry_map, wrench);
            inputs.bodies = Some(bodies);
        }
        _ => return Err(Code::UnknownChoice.into()),
    }
    Ok(())
}

/// See `precess.h`.
///
/// # Safety
///
/// `craft` points to a spacecraft, `inputs` to inputs.
pub(crate) unsafe fn inputs_none<const J: usize>(
    pointer: *const Craft,
    inputs: *mut types::Inputs<J>,
) -> i32
where
    Versions: Interface<J>,
{
    // SAFETY: by contract.
    code_number(unsafe { craft::<J>(pointer) }.and_then(|craft| {
        // SAFETY: by contract.
        let inputs = unsafe { OutputPointer::new(inputs) }?;
        let mut to = types::Inputs {
            force: [0.0; 3],
            torque: [0.0; 3],
            motor: [[0.0; J]; crate::MAX_DEVICES],
            prescribed: [[0.0; J]; crate::MAX_DEVICES],
            hub_linear: [0.0; 3],
            hub_angular: [0.0; 3],
            gravity: [0.0; 3],
            mu: 0.0,
            wrench: [[types::Wrench::NONE; J]; crate::MAX_DEVICES],
            mode: [[0; J]; crate::MAX_DEVICES],
            hub_mode: 0,
            gravity_model: 0,
            wrenches: 0,
            reserved: 0,
        };
        let own = Inputs::none_for(&craft.spacecraft);
        give(&mut to.mode, own.modes.values(), &craft.entry_map, |mode| match mode {
            Mode::Driven => 0,
            Mode::Prescribed(_) => 1,
            Mode::Locked => 2,
        });
        inputs.write(to);
        Ok(())
    }))
}
