//! What the devices contribute to the equations of a hub that the caller has.

use nalgebra::Matrix3;
use precess_dynamics::{DeviceContributions, Each, Inputs, State};

use crate::MAX_DEVICES;
use crate::craft::{Craft, StoredSpacecraft};
use crate::entry_map::EntryMap;
use crate::error::Fault;
use crate::evaluate::{take_state_and_inputs, with};
use crate::memory::OutputPointer;
use crate::types;
use crate::version::{Interface, SetOf, Versions, give};

/// See `precess.h`.
///
/// # Safety
///
/// `craft` points to a spacecraft, the others to their structures; `fault` may be null.
pub(crate) unsafe fn contributions_of<const J: usize>(
    craft: *const Craft,
    state: *const types::State<J>,
    inputs: *const types::Inputs<J>,
    out: *mut types::Contributions<J>,
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
        out.write(structure_of(&found, &craft.entry_map));
        Ok(())
    };
    // SAFETY: by contract.
    unsafe { with::<J>(craft, fault, call) }
}

fn structure_of<const J: usize>(
    found: &DeviceContributions<SetOf<J>>,
    entry_map: &EntryMap,
) -> types::Contributions<J>
where
    Versions: Interface<J>,
{
    let [f, m] = [found.h_v, found.h_w];
    let mut to = types::Contributions {
        force_by_linear: rows(&found.m_vv),
        force_by_angular: rows(&found.m_vw),
        moment_by_angular: rows(&found.m_ww),
        force: f.into(),
        moment: m.into(),
        mass: found.mass,
        first_moment: found.first_moment.into(),
        first_moment_prime: found.first_moment_prime.into(),
        inertia: rows(&found.inertia),
        joint: [[0.0; J]; MAX_DEVICES],
        by_hub: [[[0.0; 6]; J]; MAX_DEVICES],
    };
    give(&mut to.joint, found.joints.values(), entry_map, |acceleration| acceleration);
    let mut columns = found.joints_by_hub.each_ref().map(Each::values);
    let mut joints = entry_map.joints();
    // As many rows as there are joints.
    found.joints.values().for_each(|_| {
        let row = columns.each_mut().map(|column| column.next().unwrap_or(0.0));
        let to = joints.next().and_then(|[entry, joint]| to.by_hub.get_mut(entry)?.get_mut(joint));
        if let Some(to) = to {
            *to = row;
        }
    });
    to
}

/// A matrix row by row.
fn rows(of: &Matrix3<f64>) -> [f64; 9] {
    let mut rows = [0.0; 9];
    for (to, from) in rows.iter_mut().zip(of.transpose().iter()) {
        *to = *from;
    }
    rows
}
