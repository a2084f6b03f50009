//! What the devices contribute to the equations of a hub that the caller has.

use nalgebra::Matrix3;
use precess_dynamics::{DeviceContributions, Inputs, State};

use crate::craft::{Craft, StoredSpacecraft};
use crate::error::Fault;
use crate::evaluate::{take_state_and_inputs, with};
use crate::memory::OutputPointer;
use crate::types;
use crate::version::{Interface, SetOf, Versions};

/// See `precess.h`.
///
/// # Safety
///
/// `craft` points to a spacecraft, the others to their structures; `fault` may be null.
pub(crate) unsafe fn contributions_of<const J: usize>(
    craft: *const Craft,
    state: *const types::State<J>,
    inputs: *const types::Inputs<J>,
    out: *mut types::Contributions,
    fault: *mut Fault,
) -> i32
where
    Versions: Interface<J>,
{
    let call = |craft: &StoredSpacecraft<SetOf<J>>| {
        // SAFETY: by contract.
        let out = unsafe { OutputPointer::new(out) }?;
        let mut at = State::at_rest_for(&craft.spacecraft);
        let mut given = Inputs::driven_for(&craft.spacecraft);
        // SAFETY: by contract.
        unsafe { take_state_and_inputs(craft, state, inputs, (&mut at, &mut given)) }?;
        let found = craft.spacecraft.device_contributions(&at, &given)?;
        out.write(structure_of(&found));
        Ok(())
    };
    // SAFETY: by contract.
    unsafe { with::<J>(craft, fault, call) }
}

fn structure_of(found: &DeviceContributions) -> types::Contributions {
    types::Contributions {
        force_by_linear: rows(&found.m_vv),
        force_by_angular: rows(&found.m_vw),
        moment_by_angular: rows(&found.m_ww),
        force: found.h_v.into(),
        moment: found.h_w.into(),
        mass: found.mass,
        first_moment: found.first_moment.into(),
        first_moment_prime: found.first_moment_prime.into(),
        inertia: rows(&found.inertia),
    }
}

/// A matrix row by row.
fn rows(of: &Matrix3<f64>) -> [f64; 9] {
    let mut rows = [0.0; 9];
    for (to, from) in rows.iter_mut().zip(of.transpose().iter()) {
        *to = *from;
    }
    rows
}
