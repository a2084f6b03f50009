//! Loads of joints and mounts, and the torques that prescribed and locked joints need.

use precess_dynamics::{Inputs, LoadAxes, State};

use crate::craft::{Craft, StoredSpacecraft};
use crate::error::{Code, Fault};
use crate::evaluate::{take_state_and_inputs, with};
use crate::memory::OutputPointer;
use crate::types::{self, Wrench};
use crate::version::{Interface, LoadsByEntry, SetOf, Versions};

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
) -> i32
where
    Versions: Interface<J>,
{
    let call = |craft: &StoredSpacecraft<SetOf<J>>| {
        // SAFETY: by contract.
        let out = unsafe { OutputPointer::new(out) }?;
        let axes = match axes {
            0 => LoadAxes::Body,
            1 => LoadAxes::Parent,
            2 => LoadAxes::Hub,
            3 => LoadAxes::Inertial,
            _ => return Err(Code::UnknownChoice.into()),
        };
        let mut at = State::at_rest_for(&craft.spacecraft);
        let mut given = Inputs::driven_for(&craft.spacecraft);
        // SAFETY: by contract.
        unsafe { take_state_and_inputs(craft, state, inputs, (&mut at, &mut given)) }?;
        let accelerations = craft.spacecraft.accelerations(&at, &given)?;
        let found = craft.spacecraft.loads(&at, &given, &accelerations, axes)?;
        let mut to = types::Loads {
            hub: Wrench::from_wrench(&found.hub),
            mount: [Wrench::NONE; crate::MAX_DEVICES],
            joint: [[Wrench::NONE; J]; crate::MAX_DEVICES],
            motor: [[0.0; J]; crate::MAX_DEVICES],
        };
        Versions::loads(
            &found.devices,
            &mut LoadsByEntry { entry_map: &craft.entry_map, next: 0, to: &mut to },
        );
        out.write(to);
        Ok(())
    };
    // SAFETY: by contract.
    unsafe { with::<J>(craft, fault, call) }
}
