//! Accelerations, steps, the impulsive stop, energy and momentum.

use nalgebra::Vector3;
use precess_dynamics::{About, Accelerations, Inputs, Spacecraft, State};

use crate::List;
use crate::craft::{Craft, answer, craft};
use crate::error::{Code, Fault, Refusal};
use crate::inputs::inputs_of;
use crate::memory::{self, offer, read, write};
use crate::state::{give, state_of, told};
use crate::types;

/// `PRECESS_MAX_SUBSTEPS`: what one call does is bounded.
pub const MAX_SUBSTEPS: u32 = 1000;

/// Does what is asked of a spacecraft and answers.
///
/// # Safety
///
/// As `craft::craft`; `fault` is null or points to a writable fault.
pub(crate) unsafe fn with(
    pointer: *const Craft,
    fault: *mut Fault,
    ask: impl FnOnce(&Spacecraft<List>) -> Result<(), Refusal>,
) -> i32 {
    // SAFETY: by contract.
    match unsafe { craft(pointer) } {
        Ok(craft) => {
            let result = ask(&craft.spacecraft);
            // SAFETY: by contract.
            unsafe { answer(Some(&craft.spacecraft), result, fault) }
        }
        // SAFETY: by contract.
        Err(code) => unsafe { answer(None, Err(code.into()), fault) },
    }
}

/// State and inputs.
///
/// # Safety
///
/// Both pointers are null, misaligned, or point to readable structures.
pub(crate) unsafe fn given(
    spacecraft: &Spacecraft<List>,
    state: *const types::State,
    inputs: *const types::Inputs,
) -> Result<(State<List>, Inputs<List>), Refusal> {
    // SAFETY: by contract.
    let state = state_of(spacecraft, &unsafe { read(state) }?);
    // SAFETY: by contract.
    let inputs = inputs_of(spacecraft, &unsafe { read(inputs) }?)?;
    Ok((state, inputs))
}

fn of_accelerations(found: &Accelerations<List>) -> types::Accelerations {
    let mut to = types::Accelerations {
        linear: found.r_b_n_ddot.into(),
        angular: found.omega_dot.into(),
        joint: Default::default(),
    };
    give(&mut to.joint, &found.devices, |acceleration| *acceleration);
    to
}

/// See `precess.h`.
///
/// # Safety
///
/// `craft` points to a spacecraft, the others to their structures; `fault` may be null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn precess_accelerations_of(
    craft: *const Craft,
    state: *const types::State,
    inputs: *const types::Inputs,
    out: *mut types::Accelerations,
    fault: *mut Fault,
) -> i32 {
    let ask = |craft: &Spacecraft<List>| {
        // SAFETY: by contract.
        let (state, inputs) = unsafe { given(craft, state, inputs) }?;
        let found = craft.accelerations(&state, &inputs)?;
        // SAFETY: by contract.
        Ok(unsafe { write(out, of_accelerations(&found)) }?)
    };
    // SAFETY: by contract.
    unsafe { with(craft, fault, ask) }
}

/// See `precess.h`.
///
/// # Safety
///
/// `craft` points to a spacecraft, the others to their structures; `work` and `fault` may be null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn precess_step(
    craft: *const Craft,
    state: *mut types::State,
    inputs: *const types::Inputs,
    dt: f64,
    substeps: u32,
    work: *mut types::Power,
    fault: *mut Fault,
) -> i32 {
    let ask = |craft: &Spacecraft<List>| {
        if substeps == 0 || substeps > MAX_SUBSTEPS {
            return Err(Code::TooMany.into());
        }
        // SAFETY: by contract.
        let (mut next, inputs) = unsafe { given(craft, state.cast_const(), inputs) }?;
        let mut sum = types::Power {
            external: 0.0,
            hub: 0.0,
            gravity: 0.0,
            motors: 0.0,
            springs: 0.0,
            friction: 0.0,
        };
        for _ in 0..substeps {
            if work.is_null() {
                next = craft.step(&next, &inputs, dt)?;
            } else {
                let stepped = craft.step_with_work(&next, &inputs, dt)?;
                next = stepped.state;
                sum.external += stepped.work.external;
                sum.hub += stepped.work.hub;
                sum.gravity += stepped.work.gravity;
                sum.motors += stepped.work.motors;
                sum.springs += stepped.work.springs;
                sum.friction += stepped.work.friction;
            }
        }
        // SAFETY: by contract; `work` first, so that a refusal leaves the state as it was.
        unsafe { offer(work, sum) }?;
        // SAFETY: by contract.
        Ok(unsafe { write(state, told(&next)) }?)
    };
    // SAFETY: by contract.
    unsafe { with(craft, fault, ask) }
}

/// See `precess.h`.
///
/// # Safety
///
/// `craft` points to a spacecraft, the others to their structures; `lost` and `fault` may be null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn precess_stop(
    craft: *const Craft,
    state: *mut types::State,
    inputs: *const types::Inputs,
    lost: *mut f64,
    fault: *mut Fault,
) -> i32 {
    let ask = |craft: &Spacecraft<List>| {
        // SAFETY: by contract.
        let (before, inputs) = unsafe { given(craft, state.cast_const(), inputs) }?;
        let stopped = craft.stop(&before, &inputs)?;
        // SAFETY: by contract.
        unsafe { offer(lost, stopped.energy_lost) }?;
        // SAFETY: by contract.
        Ok(unsafe { write(state, told(&stopped.state)) }?)
    };
    // SAFETY: by contract.
    unsafe { with(craft, fault, ask) }
}

/// See `precess.h`.
///
/// # Safety
///
/// `craft` points to a spacecraft, the others to their structures; `fault` may be null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn precess_energy(
    craft: *const Craft,
    state: *const types::State,
    energy: *mut f64,
    fault: *mut Fault,
) -> i32 {
    let ask = |craft: &Spacecraft<List>| {
        // SAFETY: by contract.
        let state = state_of(craft, &unsafe { read(state) }?);
        // SAFETY: by contract.
        Ok(unsafe { write(energy, craft.energy(&state)?) }?)
    };
    // SAFETY: by contract.
    unsafe { with(craft, fault, ask) }
}

/// See `precess.h`.
///
/// # Safety
///
/// `craft` points to a spacecraft, the others to their structures; `point` is read for
/// `PRECESS_ABOUT_POINT` alone; `fault` may be null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn precess_momentum_of(
    craft: *const Craft,
    state: *const types::State,
    about: i32,
    point: *const f64,
    out: *mut types::Momentum,
    fault: *mut Fault,
) -> i32 {
    let ask = |craft: &Spacecraft<List>| {
        // SAFETY: by contract.
        let state = state_of(craft, &unsafe { read(state) }?);
        let about = match about {
            0 => About::InertialOrigin,
            1 => About::CentreOfMass,
            2 => {
                // SAFETY: by contract.
                let &[x, y, z] = unsafe { memory::slice(point, 3) }? else {
                    return Err(Code::Null.into());
                };
                About::Point(Vector3::new(x, y, z))
            }
            _ => return Err(Code::UnknownChoice.into()),
        };
        let found = craft.momentum(&state, about)?;
        let found = types::Momentum { linear: found.linear.into(), angular: found.angular.into() };
        // SAFETY: by contract.
        Ok(unsafe { write(out, found) }?)
    };
    // SAFETY: by contract.
    unsafe { with(craft, fault, ask) }
}
