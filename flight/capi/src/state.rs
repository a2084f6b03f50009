//! States: from structures and back, and as numbers in a row to be saved and restored.

use nalgebra::Vector3;
use precess_dynamics::{JointArray, Quaternion, Spacecraft, State};

use crate::craft::{Craft, craft, query, report};
use crate::error::{Code, Fault, Rejection};
use crate::memory::{self, slice, slice_mut};
use crate::types::{self, PerJoint};
use crate::{List, MAX_DEVICES};

/// Copies from `[device][joint]` to what has one for each joint there is.
pub(crate) fn take<V: precess_dynamics::Value>(
    to: &mut [Option<JointArray<V>>; MAX_DEVICES],
    from: &[impl AsRef<[V]>; MAX_DEVICES],
) {
    for (to, from) in to.iter_mut().zip(from) {
        let to = to.iter_mut().flat_map(JointArray::as_mut_slice);
        for (to, from) in to.zip(from.as_ref()) {
            *to = *from;
        }
    }
}

/// Copies to `[device][joint]` by a function.
pub(crate) fn give<V: precess_dynamics::Value, U, const J: usize>(
    to: &mut PerJoint<U, J>,
    from: &[Option<JointArray<V>>; MAX_DEVICES],
    of: impl Fn(&V) -> U,
) {
    for (to, from) in to.iter_mut().zip(from) {
        let from = from.iter().flat_map(JointArray::as_slice);
        for (to, from) in to.iter_mut().zip(from) {
            *to = of(from);
        }
    }
}

/// The state that a structure states.
pub(crate) fn state_of<const J: usize>(
    spacecraft: &Spacecraft<List>,
    from: &types::State<J>,
) -> State<List> {
    let mut state = State::at_rest_for(spacecraft);
    let [q0, q1, q2, q3] = from.attitude;
    state.r_b_n = Vector3::from(from.position);
    state.r_b_n_dot = Vector3::from(from.velocity);
    state.attitude = Quaternion { q0, q1, q2, q3 };
    state.omega = Vector3::from(from.omega);
    let joints = from.coordinate.iter().zip(&from.rate);
    for (to, (coordinates, rates)) in state.devices.iter_mut().zip(joints) {
        let to = to.iter_mut().flat_map(JointArray::as_mut_slice);
        for (to, (coordinate, rate)) in to.zip(coordinates.iter().zip(rates)) {
            *to = [*coordinate, *rate];
        }
    }
    state
}

/// A state as a structure.
pub(crate) fn structure_of<const J: usize>(state: &State<List>) -> types::State<J> {
    let Quaternion { q0, q1, q2, q3 } = state.attitude;
    let mut to = types::State {
        position: state.r_b_n.into(),
        velocity: state.r_b_n_dot.into(),
        attitude: [q0, q1, q2, q3],
        omega: state.omega.into(),
        coordinate: [[0.0; J]; MAX_DEVICES],
        rate: [[0.0; J]; MAX_DEVICES],
    };
    give(&mut to.coordinate, &state.devices, |[coordinate, _]| *coordinate);
    give(&mut to.rate, &state.devices, |[_, rate]| *rate);
    to
}

/// The numbers of a state, in the order in which they are saved.
fn numbers<'a, const J: usize>(
    craft: &'a Spacecraft<List>,
    state: &'a mut types::State<J>,
) -> impl Iterator<Item = &'a mut f64> {
    let types::State { position, velocity, attitude, omega, coordinate, rate } = state;
    let devices = coordinate.iter_mut().zip(rate).enumerate();
    let joints = devices.flat_map(|(device, (coordinates, rates))| {
        let there = craft.joints().filter(move |(index, _)| *index == device);
        let joints = coordinates.iter_mut().zip(rates).zip(there);
        joints.flat_map(|((coordinate, rate), _)| [coordinate, rate])
    });
    position.iter_mut().chain(velocity).chain(attitude).chain(omega).chain(joints)
}

fn length(craft: &Spacecraft<List>) -> usize {
    13_usize.saturating_add(craft.joints().count().saturating_mul(2))
}

/// See `precess.h`.
///
/// # Safety
///
/// `craft` points to a spacecraft, `state` to a state, `fault` is null or points to a fault.
pub(crate) unsafe fn state_at_rest<const J: usize>(
    pointer: *const Craft,
    state: *mut types::State<J>,
) -> i32 {
    // SAFETY: by contract.
    let done = unsafe { craft::<J>(pointer) }.and_then(|craft| {
        let at_rest = structure_of(&State::at_rest_for(&craft.spacecraft));
        // SAFETY: by contract.
        unsafe { memory::write(state, at_rest) }
    });
    done.err().unwrap_or(Code::Ok) as i32
}

/// See `precess.h`.
///
/// # Safety
///
/// `craft` points to a spacecraft, `state` to a state.
pub(crate) unsafe fn state_wrap<const J: usize>(
    pointer: *const Craft,
    state: *mut types::State<J>,
) -> i32 {
    // SAFETY: by contract.
    let done = unsafe { craft::<J>(pointer) }.and_then(|craft| {
        // SAFETY: by contract.
        let from = state_of(&craft.spacecraft, &unsafe { memory::read(state.cast_const()) }?);
        // SAFETY: by contract.
        unsafe { memory::write(state, structure_of(&from.wrapped(&craft.spacecraft))) }
    });
    done.err().unwrap_or(Code::Ok) as i32
}

/// See `precess.h`.
///
/// # Safety
///
/// `craft` points to a spacecraft, `count` to a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn precess_state_length(pointer: *const Craft, count: *mut u32) -> i32 {
    // SAFETY: by contract.
    unsafe { query(pointer, count, |craft| u32::try_from(length(craft)).unwrap_or(u32::MAX)) }
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
) -> i32 {
    let save = || {
        // SAFETY: by contract.
        let craft = unsafe { craft::<J>(pointer) }?;
        // SAFETY: by contract.
        let mut state = unsafe { memory::read(state) }?;
        if (count as usize) < length(&craft.spacecraft) {
            return Err(Code::TooSmall);
        }
        // SAFETY: by contract.
        let to = unsafe { slice_mut(to, count as usize) }?;
        to.iter_mut()
            .zip(numbers(&craft.spacecraft, &mut state))
            .for_each(|(to, from)| *to = *from);
        Ok(())
    };
    save().err().unwrap_or(Code::Ok) as i32
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
) -> i32 {
    let restore = || {
        // SAFETY: by contract.
        let craft = &unsafe { craft::<J>(pointer) }?.spacecraft;
        if count as usize != length(craft) {
            return Err(Rejection::from(Code::TooSmall));
        }
        // SAFETY: by contract.
        let from = unsafe { slice(from, count as usize) }?;
        let mut restored = structure_of(&State::at_rest_for(craft));
        numbers(craft, &mut restored).zip(from).for_each(|(to, from)| *to = *from);
        // What is not finite, or no attitude, is rejected here, not at the next step.
        craft.energy(&state_of(craft, &restored))?;
        // SAFETY: by contract.
        unsafe { memory::write(state, restored) }?;
        Ok(())
    };
    let result = restore();
    // SAFETY: by contract.
    unsafe { report(craft::<J>(pointer).ok().map(|craft| &craft.spacecraft), result, fault) }
}
