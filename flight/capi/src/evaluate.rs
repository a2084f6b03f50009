//! Accelerations, steps, the impulsive stop, energy and momentum.

use nalgebra::Vector3;
use precess_dynamics::{About, Accelerations, Each, Inputs, State};

use crate::craft::{Craft, StoredSpacecraft, craft, reporting};
use crate::entry_map::EntryMap;
use crate::error::{Code, Fault, Rejection};
use crate::inputs::take_inputs;
use crate::memory::{self, OutputPointer, refer};
use crate::state::{state_of, structure_of, take_state};
use crate::types;
use crate::version::{Interface, SetOf, Versions, give};

/// `PRECESS_MAX_SUBSTEPS`: what one call does is bounded.
pub const MAX_SUBSTEPS: u32 = 1000;

/// Calls a function of a spacecraft and returns its code. The function takes a place for each of its
/// results ([`OutputPointer`]) before it writes any.
///
/// # Safety
///
/// As `craft::craft`; `fault` is null or points to a writable fault.
pub(crate) unsafe fn with<const J: usize>(
    pointer: *const Craft,
    fault: *mut Fault,
    call: impl FnOnce(&StoredSpacecraft<SetOf<J>>) -> Result<(), Rejection>,
) -> i32
where
    Versions: Interface<J>,
{
    // SAFETY: by contract.
    let call = || match unsafe { craft::<J>(pointer) } {
        Ok(craft) => (Some(craft), call(craft)),
        Err(code) => (None, Err(code.into())),
    };
    // SAFETY: by contract.
    unsafe { reporting(fault, call) }
}

/// Writes the state and inputs of structures to a state at rest and inputs in which nothing acts; each
/// joint has its mode there.
///
/// # Safety
///
/// Both pointers are null, misaligned, or point to readable structures.
pub(crate) unsafe fn take_state_and_inputs<const J: usize>(
    craft: &StoredSpacecraft<SetOf<J>>,
    state: *const types::State<J>,
    inputs: *const types::Inputs<J>,
    to: (&mut State<SetOf<J>>, &mut Inputs<SetOf<J>>),
) -> Result<(), Rejection>
where
    Versions: Interface<J>,
{
    let (to_state, to_inputs) = to;
    // SAFETY: by contract.
    take_state(craft, unsafe { refer(state) }?, to_state);
    // SAFETY: by contract.
    take_inputs(craft, unsafe { refer(inputs) }?, to_inputs)
}

fn of_accelerations<const J: usize>(
    found: &Accelerations<SetOf<J>>,
    entry_map: &EntryMap,
) -> types::Accelerations<J>
where
    Versions: Interface<J>,
{
    let mut to = types::Accelerations {
        linear: found.r_b_n_ddot.into(),
        angular: found.omega_dot.into(),
        joint: [[0.0; J]; crate::MAX_DEVICES],
    };
    give(&mut to.joint, found.devices.values(), entry_map, |acceleration| acceleration);
    to
}

/// See `precess.h`.
///
/// # Safety
///
/// `craft` points to a spacecraft, the others to their structures; `fault` may be null.
pub(crate) unsafe fn accelerations_of<const J: usize>(
    craft: *const Craft,
    state: *const types::State<J>,
    inputs: *const types::Inputs<J>,
    out: *mut types::Accelerations<J>,
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
        let found = craft.spacecraft.accelerations(&at, &given)?;
        out.write(of_accelerations(&found, &craft.entry_map));
        Ok(())
    };
    // SAFETY: by contract.
    unsafe { with::<J>(craft, fault, call) }
}

/// See `precess.h`.
///
/// # Safety
///
/// `craft` points to a spacecraft, the others to their structures; `work` and `fault` may be null.
pub(crate) unsafe fn step<const J: usize>(
    craft: *const Craft,
    state: *mut types::State<J>,
    inputs: *const types::Inputs<J>,
    dt: f64,
    substeps: u32,
    work: *mut types::Power,
    fault: *mut Fault,
) -> i32
where
    Versions: Interface<J>,
{
    let call = |craft: &StoredSpacecraft<SetOf<J>>| {
        if substeps == 0 || substeps > MAX_SUBSTEPS {
            return Err(Code::TooMany.into());
        }
        // SAFETY: by contract.
        let (to, work) = unsafe { (OutputPointer::new(state)?, OutputPointer::optional(work)?) };
        let mut next = State::at_rest_for(&craft.spacecraft);
        let mut given = Inputs::driven_for(&craft.spacecraft);
        let from = state.cast_const();
        // SAFETY: by contract.
        unsafe { take_state_and_inputs(craft, from, inputs, (&mut next, &mut given)) }?;
        let mut sum = types::Power {
            external: 0.0,
            hub: 0.0,
            gravity: 0.0,
            motors: 0.0,
            springs: 0.0,
            friction: 0.0,
        };
        for _ in 0..substeps {
            if work.is_none() {
                next = craft.spacecraft.step(&next, &given, dt)?;
            } else {
                let stepped = craft.spacecraft.step_with_work(&next, &given, dt)?;
                next = stepped.state;
                sum.external += stepped.work.external;
                sum.hub += stepped.work.hub;
                sum.gravity += stepped.work.gravity;
                sum.motors += stepped.work.motors;
                sum.springs += stepped.work.springs;
                sum.friction += stepped.work.friction;
            }
        }
        if let Some(work) = work {
            work.write(sum);
        }
        to.write(structure_of(&next, &craft.entry_map));
        Ok(())
    };
    // SAFETY: by contract.
    unsafe { with::<J>(craft, fault, call) }
}

/// See `precess.h`.
///
/// # Safety
///
/// `craft` points to a spacecraft, the others to their structures; `lost` and `fault` may be null.
pub(crate) unsafe fn stop<const J: usize>(
    craft: *const Craft,
    state: *mut types::State<J>,
    inputs: *const types::Inputs<J>,
    lost: *mut f64,
    fault: *mut Fault,
) -> i32
where
    Versions: Interface<J>,
{
    let call = |craft: &StoredSpacecraft<SetOf<J>>| {
        // SAFETY: by contract.
        let (to, lost) = unsafe { (OutputPointer::new(state)?, OutputPointer::optional(lost)?) };
        let mut before = State::at_rest_for(&craft.spacecraft);
        let mut given = Inputs::driven_for(&craft.spacecraft);
        let from = state.cast_const();
        // SAFETY: by contract.
        unsafe { take_state_and_inputs(craft, from, inputs, (&mut before, &mut given)) }?;
        let stopped = craft.spacecraft.stop(&before, &given)?;
        if let Some(lost) = lost {
            lost.write(stopped.energy_lost);
        }
        to.write(structure_of(&stopped.state, &craft.entry_map));
        Ok(())
    };
    // SAFETY: by contract.
    unsafe { with::<J>(craft, fault, call) }
}

/// See `precess.h`.
///
/// # Safety
///
/// `craft` points to a spacecraft, the others to their structures; `fault` may be null.
pub(crate) unsafe fn energy<const J: usize>(
    craft: *const Craft,
    state: *const types::State<J>,
    energy: *mut f64,
    fault: *mut Fault,
) -> i32
where
    Versions: Interface<J>,
{
    let call = |craft: &StoredSpacecraft<SetOf<J>>| {
        // SAFETY: by contract.
        let energy = unsafe { OutputPointer::new(energy) }?;
        // SAFETY: by contract.
        let state = state_of(craft, unsafe { refer(state) }?);
        energy.write(craft.spacecraft.energy(&state)?);
        Ok(())
    };
    // SAFETY: by contract.
    unsafe { with::<J>(craft, fault, call) }
}

/// See `precess.h`.
///
/// # Safety
///
/// `craft` points to a spacecraft, the others to their structures; `point` is read only for
/// `PRECESS_ABOUT_POINT`; `fault` may be null.
pub(crate) unsafe fn momentum_of<const J: usize>(
    craft: *const Craft,
    state: *const types::State<J>,
    about: i32,
    point: *const f64,
    out: *mut types::Momentum,
    fault: *mut Fault,
) -> i32
where
    Versions: Interface<J>,
{
    let call = |craft: &StoredSpacecraft<SetOf<J>>| {
        // SAFETY: by contract.
        let out = unsafe { OutputPointer::new(out) }?;
        // SAFETY: by contract.
        let state = state_of(craft, unsafe { refer(state) }?);
        let about = match about {
            0 => About::InertialOrigin,
            1 => About::CentreOfMass,
            2 => {
                // SAFETY: by contract.
                About::Point(Vector3::from(unsafe { memory::vector(point) }?))
            }
            _ => return Err(Code::UnknownChoice.into()),
        };
        let found = craft.spacecraft.momentum(&state, about)?;
        out.write(types::Momentum { linear: found.linear.into(), angular: found.angular.into() });
        Ok(())
    };
    // SAFETY: by contract.
    unsafe { with::<J>(craft, fault, call) }
}

#[cfg(test)]
mod tests {
    use core::mem::MaybeUninit;
    use core::ptr::null_mut;

    use nalgebra::Matrix3;
    use precess_dynamics::{Dgvscmg, Hub, ReactionWheel, Spacecraft};

    use super::*;
    use crate::craft::init;

    const SIZE: usize = <Versions as Interface<7>>::SIZE;

    /// What a C caller states and what a Rust caller states is one spacecraft, to the last bit.
    #[test]
    fn c_interface_has_the_bits_of_the_typed_spacecraft() {
        let disc = Matrix3::from_diagonal(&Vector3::new(0.2, 0.1, 0.1));
        let gyro = Dgvscmg {
            d: 8e-5,
            r_go_b: Vector3::new(0.3, 0.0, 0.0),
            ..Dgvscmg::bare_wheel(4.0, disc)
        };
        let wheel = ReactionWheel { d: 2e-5, ..ReactionWheel::bare_wheel(3.0, disc) };
        let moments = Vector3::new(900.0, 800.0, 600.0);
        let hub = Hub {
            m_b: 800.0,
            r_bc_b: Vector3::new(0.1, 0.2, 0.3),
            i_b_bc: Matrix3::from_diagonal(&moments),
        };
        let typed = Spacecraft::new(&hub, &(gyro, wheel)).unwrap();
        let mut state: State<(Dgvscmg, ReactionWheel)> = State::at_rest();
        state.omega = Vector3::new(0.1, -0.2, 0.3);
        (state.devices.0.gamma_i, state.devices.0.spin, state.devices.1.spin) = (0.4, 50.0, 90.0);
        let mut inputs: Inputs<(Dgvscmg, ReactionWheel)> = Inputs::none();
        inputs.motors.0.u_w = 0.2;

        let diagonal = |[x, y, z]: [f64; 3]| [x, 0.0, 0.0, 0.0, y, 0.0, 0.0, 0.0, z];
        let devices = [gyro.into(), wheel.into()].map(|device: precess_dynamics::BuiltIn| {
            let parameters = device.parameters();
            let rows = |m: &Matrix3<f64>| m.transpose().as_slice().try_into().unwrap();
            let device = types::Device::<7> {
                kind: device.kind().number().into(),
                model: 0,
                mount: rows(&parameters.mount),
                bodies: parameters.bodies.map(|body| types::Body {
                    mass: body.mass,
                    origin: body.origin,
                    centre: body.centre,
                    inertia: rows(&body.inertia),
                }),
                passive: parameters.passive.map(|_| types::Passive {
                    stiffness: 0.0,
                    rest: 0.0,
                    viscous: 0.0,
                    coulomb: 0.0,
                    coulomb_rate: 0.0,
                }),
            };
            types::Entry { device, ..types::Entry::EMPTY }
        });
        let hub = types::Hub {
            mass: hub.m_b,
            centre: hub.r_bc_b.into(),
            inertia: diagonal(moments.into()),
        };
        let mut memory = MaybeUninit::<[u64; SIZE / 8]>::zeroed();
        let craft = memory.as_mut_ptr().cast::<Craft>();
        let (mut c_state, mut c_inputs) =
            (MaybeUninit::<types::State<7>>::zeroed(), MaybeUninit::<types::Inputs<7>>::zeroed());
        let none = null_mut();
        // SAFETY: every pointer is to a local of its type, or null where that is allowed.
        let codes = unsafe {
            [
                init::<7>(craft.cast(), SIZE, &raw const hub, devices.as_ptr(), 2, none),
                crate::state::state_at_rest::<7>(craft, c_state.as_mut_ptr()),
                crate::inputs::inputs_none::<7>(craft, c_inputs.as_mut_ptr()),
            ]
        };
        assert_eq!(codes, [0; 3]);
        // SAFETY: both have been written.
        let (mut c_state, mut c_inputs) =
            unsafe { (c_state.assume_init(), c_inputs.assume_init()) };
        c_state.omega = state.omega.into();
        c_state.coordinate[0][1] = 0.4;
        (c_state.rate[0][2], c_state.rate[1][0]) = (50.0, 90.0);
        c_inputs.motor[0][2] = 0.2;
        for _ in 0..1000 {
            state = typed.step(&state, &inputs, 1e-3).unwrap();
        }
        // SAFETY: as before.
        let code = unsafe {
            step(craft, &raw mut c_state, &raw const c_inputs, 1e-3, 1000, null_mut(), none)
        };
        assert_eq!(code, 0);
        let bits = |numbers: &[f64]| numbers.iter().map(|n| n.to_bits()).collect::<Vec<_>>();
        let (gyro, wheel) = (&state.devices.0, &state.devices.1);
        assert_eq!(bits(&c_state.omega), bits(state.omega.as_slice()));
        assert_eq!(bits(&c_state.position), bits(state.r_b_n.as_slice()));
        assert_eq!(
            bits(&c_state.coordinate[0][..3]),
            bits(&[gyro.gamma_o, gyro.gamma_i, gyro.theta])
        );
        assert_eq!(bits(&c_state.rate[1]), bits(&[wheel.spin, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]));
        let of_attitude = state.attitude;
        let attitude = [of_attitude.q0, of_attitude.q1, of_attitude.q2, of_attitude.q3];
        assert_eq!(bits(&c_state.attitude), bits(&attitude));
        for (size, most) in [
            (size_of::<StoredSpacecraft<SetOf<3>>>(), <Versions as Interface<3>>::SIZE),
            (size_of::<StoredSpacecraft<SetOf<7>>>(), SIZE),
        ] {
            assert!(size > most / 2, "{size} bytes: PRECESS_SPACECRAFT_SIZE is far too large");
            println!("{size} bytes of {most}");
        }
    }
}
