//! States: from structures and back, and as numbers in a row to be saved and restored.

use nalgebra::Vector3;
use precess_dynamics::{Devices, JointStates, Quaternion, State};

use crate::MAX_DEVICES;
use crate::craft::{Craft, Query, StoredSpacecraft, code_number, craft, query};
use crate::entry_map::EntryMap;
use crate::error::{Code, Fault, Rejection};
use crate::evaluate::with;
use crate::memory::{self, OutputPointer, slice, slice_mut};
use crate::types;
use crate::version::{Interface, SetOf, Versions};

/// The state that a structure states.
pub(crate) fn state_of<const J: usize>(
    craft: &StoredSpacecraft<SetOf<J>>,
    from: &types::State<J>,
) -> State<SetOf<J>>
where
    Versions: Interface<J>,
{
    let mut state = State::at_rest_for(&craft.spacecraft);
    take_state(craft, from, &mut state);
    state
}

/// Writes the state that a structure states to one at rest.
pub(crate) fn take_state<const J: usize>(
    craft: &StoredSpacecraft<SetOf<J>>,
    from: &types::State<J>,
    state: &mut State<SetOf<J>>,
) where
    Versions: Interface<J>,
{
    let [q0, q1, q2, q3] = from.attitude;
    state.r_b_n = Vector3::from(from.position);
    state.r_b_n_dot = Vector3::from(from.velocity);
    state.attitude = Quaternion { q0, q1, q2, q3 };
    state.omega = Vector3::from(from.omega);
    let mut joints = craft.entry_map.joints();
    state.devices.states_mut().for_each(|[coordinate, rate]| {
        let Some([entry, joint]) = joints.next() else { return };
        let at = |of: &types::PerJoint<f64, J>| of.get(entry).and_then(|of| of.get(joint)).copied();
        if let (Some(x), Some(x_dot)) = (at(&from.coordinate), at(&from.rate)) {
            (*coordinate, *rate) = (x, x_dot);
        }
    });
}

/// A state as a structure.
pub(crate) fn structure_of<const J: usize>(
    state: &State<SetOf<J>>,
    entry_map: &EntryMap,
) -> types::State<J>
where
    Versions: Interface<J>,
{
    let Quaternion { q0, q1, q2, q3 } = state.attitude;
    let mut to = types::State {
        position: state.r_b_n.into(),
        velocity: state.r_b_n_dot.into(),
        attitude: [q0, q1, q2, q3],
        omega: state.omega.into(),
        coordinate: [[0.0; J]; MAX_DEVICES],
        rate: [[0.0; J]; MAX_DEVICES],
    };
    let mut joints = entry_map.joints();
    state.devices.states().for_each(|[coordinate, rate]| {
        let Some([entry, joint]) = joints.next() else { return };
        let coordinates = to.coordinate.get_mut(entry).and_then(|joints| joints.get_mut(joint));
        let rates = to.rate.get_mut(entry).and_then(|joints| joints.get_mut(joint));
        if let (Some(to), Some(to_rate)) = (coordinates, rates) {
            (*to, *to_rate) = (coordinate, rate);
        }
    });
    to
}

struct Length;

impl Query<u32> for Length {
    fn value<D: Devices<Scalar = f64>>(&self, craft: &StoredSpacecraft<D>) -> u32 {
        u32::try_from(length(&craft.entry_map)).unwrap_or(u32::MAX)
    }
}

/// The numbers of a state, in the order in which they are saved: that of the entries.
fn numbers<'a, const J: usize>(
    entry_map: &'a EntryMap,
    state: &'a mut types::State<J>,
) -> impl Iterator<Item = &'a mut f64> {
    let types::State { position, velocity, attitude, omega, coordinate, rate } = state;
    let entries = coordinate.iter_mut().zip(rate).enumerate();
    let joints = entries.flat_map(|(entry, (coordinates, rates))| {
        let joints = coordinates.iter_mut().zip(rates).take(entry_map.joints_of(entry));
        joints.flat_map(|(coordinate, rate)| [coordinate, rate])
    });
    position.iter_mut().chain(velocity).chain(attitude).chain(omega).chain(joints)
}

/// How many there are.
fn length(entry_map: &EntryMap) -> usize {
    13_usize.saturating_add(entry_map.count().saturating_mul(2))
}

/// See `precess.h`.
///
/// # Safety
///
/// `craft` points to a spacecraft, `state` to a state.
pub(crate) unsafe fn state_at_rest<const J: usize>(
    pointer: *const Craft,
    state: *mut types::State<J>,
) -> i32
where
    Versions: Interface<J>,
{
    // SAFETY: by contract.
    code_number(unsafe { craft::<J>(pointer) }.and_then(|craft| {
        // SAFETY: by contract.
        let to = unsafe { OutputPointer::new(state) }?;
        to.write(structure_of(&State::at_rest_for(&craft.spacecraft), &craft.entry_map));
        Ok(())
    }))
}

/// See `precess.h`.
///
/// # Safety
///
/// `craft` points to a spacecraft, `state` to a state.
pub(crate) unsafe fn state_wrap<const J: usize>(
    pointer: *const Craft,
    state: *mut types::State<J>,
) -> i32
where
    Versions: Interface<J>,
{
    // SAFETY: by contract.
    code_number(unsafe { craft::<J>(pointer) }.and_then(|craft| {
        // SAFETY: by contract.
        let to = unsafe { OutputPointer::new(state) }?;
        // SAFETY: by contract.
        let from = state_of(craft, unsafe { memory::refer(state.cast_const()) }?);
        to.write(structure_of(&from.wrapped(&craft.spacecraft), &craft.entry_map));
        Ok(())
    }))
}

/// See `precess.h`.
///
/// # Safety
///
/// `craft` points to a spacecraft, `count` to a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn precess_state_length(pointer: *const Craft, count: *mut u32) -> i32 {
    // SAFETY: by contract.
    unsafe { query(pointer, count, &Length) }
}

/// See `precess.h`.
///
/// # Safety
///
/// `craft` points to a spacecraft, `state` to a state, `to` to `count` numbers.
pub(crate) unsafe fn state_save<const J: usize>(
    pointer: *const Craft,
    state: *const types::State<J>,
    to: *mut f64,
    count: u32,
) -> i32
where
    Versions: Interface<J>,
{
    let save = || {
        // SAFETY: by contract.
        let craft = unsafe { craft::<J>(pointer) }?;
        // SAFETY: by contract.
        let mut state = unsafe { memory::read(state) }?;
        if (count as usize) < length(&craft.entry_map) {
            return Err(Code::TooSmall);
        }
        // SAFETY: by contract.
        let to = unsafe { slice_mut(to, count as usize) }?;
        to.iter_mut().zip(numbers(&craft.entry_map, &mut state)).for_each(|(to, from)| *to = *from);
        Ok(())
    };
    code_number(save())
}

/// See `precess.h`.
///
/// # Safety
///
/// `craft` points to a spacecraft, `from` to `count` numbers, `state` to a state, `fault` is null
/// or points to a fault.
pub(crate) unsafe fn state_restore<const J: usize>(
    pointer: *const Craft,
    from: *const f64,
    count: u32,
    state: *mut types::State<J>,
    fault: *mut Fault,
) -> i32
where
    Versions: Interface<J>,
{
    let restore = |craft: &StoredSpacecraft<SetOf<J>>| {
        // SAFETY: by contract.
        let to = unsafe { OutputPointer::new(state) }?;
        if count as usize != length(&craft.entry_map) {
            return Err(Rejection::from(Code::TooSmall));
        }
        // SAFETY: by contract.
        let from = unsafe { slice(from, count as usize) }?;
        let at_rest = State::at_rest_for(&craft.spacecraft);
        let mut restored = structure_of(&at_rest, &craft.entry_map);
        numbers(&craft.entry_map, &mut restored).zip(from).for_each(|(to, from)| *to = *from);
        // What is not finite, or no attitude, is rejected here, not at the next step.
        craft.spacecraft.energy(&state_of(craft, &restored))?;
        to.write(restored);
        Ok(())
    };
    // SAFETY: by contract.
    unsafe { with::<J>(pointer, fault, restore) }
}
