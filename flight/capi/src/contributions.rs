//! What the devices contribute to the equations of a hub that the caller has, and the accelerations of their joints
//! once those of that hub are known.
//!
//! Gains are in memory that the caller owns, as a spacecraft is.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::{
    Attitude as _, DeviceContributions, Devices, Each, Inputs, JointGains, JointReading, Mode,
    Quaternion, State,
};

use crate::craft::{Craft, StoredSpacecraft, made_by};
use crate::error::{Code, Fault, Rejection};
use crate::evaluate::{take_state_and_inputs, with};
use crate::memory::{self, OutputPointer, refer};
use crate::types;
use crate::version::{Interface, SetOf, Versions, give};

/// The first field of valid gains, as that of a spacecraft.
#[repr(C)]
pub(crate) struct Gains {
    made: u64,
}

/// The contents of the caller's memory.
#[repr(C)]
struct StoredGains<D: Devices<Scalar = f64>> {
    gains: Gains,
    of: JointGains<D>,
}

const fn fits<const J: usize>() -> bool
where
    Versions: Interface<J>,
{
    size_of::<StoredGains<SetOf<J>>>() <= Versions::GAINS_SIZE
        && align_of::<StoredGains<SetOf<J>>>() <= crate::craft::ALIGN
}

const _: () = assert!(fits::<3>() && fits::<7>());

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
        let mut of = craft.spacecraft.joint_gains();
        // SAFETY: by contract.
        let found = unsafe { eliminated(craft, state, inputs, &mut of) }?;
        out.write(structure_of(&found));
        Ok(())
    };
    // SAFETY: by contract.
    unsafe { with::<J>(craft, fault, call) }
}

/// See `precess.h`.
///
/// # Safety
///
/// `craft` points to a spacecraft, `gains` to `PRECESS_JOINT_GAINS_SIZE` bytes, the others to their structures; `fault` may
/// be null.
pub(crate) unsafe fn eliminate<const J: usize>(
    craft: *const Craft,
    state: *const types::State<J>,
    inputs: *const types::Inputs<J>,
    out: *mut types::Contributions,
    gains: *mut Gains,
    fault: *mut Fault,
) -> i32
where
    Versions: Interface<J>,
{
    let call = |craft: &StoredSpacecraft<SetOf<J>>| {
        // SAFETY: by contract.
        let out = unsafe { OutputPointer::new(out) }?;
        memory::check(gains)?;
        let mut of = craft.spacecraft.joint_gains();
        // SAFETY: by contract.
        let found = unsafe { eliminated(craft, state, inputs, &mut of) }?;
        out.write(structure_of(&found));
        // SAFETY: not null, aligned; large enough by contract and `fits`.
        unsafe {
            gains
                .cast::<StoredGains<SetOf<J>>>()
                .write(StoredGains { gains: Gains { made: made_by(J) }, of });
        }
        Ok(())
    };
    // SAFETY: by contract.
    unsafe { with::<J>(craft, fault, call) }
}

/// See `precess.h`.
///
/// # Safety
///
/// `craft` points to a spacecraft, `gains` to what [`eliminate`] has written, `linear` and `angular` to three numbers, `out` to
/// accelerations; `fault` may be null.
pub(crate) unsafe fn joint_accelerations_of<const J: usize>(
    craft: *const Craft,
    gains: *const Gains,
    linear: *const f64,
    angular: *const f64,
    out: *mut types::Accelerations<J>,
    fault: *mut Fault,
) -> i32
where
    Versions: Interface<J>,
{
    let call = |craft: &StoredSpacecraft<SetOf<J>>| {
        memory::check(gains)?;
        // SAFETY: not null, aligned, readable; the first field is a number.
        if unsafe { (&raw const (*gains).made).read() } != made_by(J) {
            return Err(Code::NotInitialised.into());
        }
        // SAFETY: `eliminate` of this version has written it.
        let gains = unsafe { &*gains.cast::<StoredGains<SetOf<J>>>() };
        // SAFETY: by contract.
        let out = unsafe { OutputPointer::new(out) }?;
        // SAFETY: by contract.
        let (linear, angular) = unsafe { (memory::vector(linear)?, memory::vector(angular)?) };
        let (a, omega_dot) = (Vector3::from(linear), Vector3::from(angular));
        let joint = [[0.0; J]; crate::MAX_DEVICES];
        let mut to = types::Accelerations { linear, angular, joint };
        let mut joints = craft.entry_map.joints();
        let written = craft.spacecraft.write_joint_accelerations(&gains.of, &a, &omega_dot, |of| {
            let place = joints.next();
            let place = place.and_then(|[entry, joint]| to.joint.get_mut(entry)?.get_mut(joint));
            if let Some(place) = place {
                *place = of;
            }
        });
        if !written {
            let found = craft.spacecraft.joint_accelerations(&gains.of, &a, &omega_dot)?;
            give(&mut to.joint, found.values(), &craft.entry_map, |acceleration| acceleration);
        }
        out.write(to);
        Ok(())
    };
    // SAFETY: by contract.
    unsafe { with::<J>(craft, fault, call) }
}

/// What the devices contribute; the gains are large, so that a result of them would be copied.
///
/// Joint by joint from the caller's structures. What that does not have, wrenches on bodies among it, and whatever is rejected
/// is evaluated from a state and inputs of the set, which name the cause.
///
/// # Safety
///
/// Both pointers are null, misaligned, or point to readable structures.
unsafe fn eliminated<const J: usize>(
    craft: &StoredSpacecraft<SetOf<J>>,
    state: *const types::State<J>,
    inputs: *const types::Inputs<J>,
    gains: &mut JointGains<SetOf<J>>,
) -> Result<DeviceContributions, Rejection>
where
    Versions: Interface<J>,
{
    // SAFETY: by contract.
    let (from, given) = unsafe { (refer(state)?, refer(inputs)?) };
    if is_usual(from, given) {
        let omega = Vector3::from(from.omega);
        let mut joints = craft.entry_map.joints();
        let mut read = core::iter::from_fn(|| {
            let [entry, joint] = joints.next()?;
            reading(from, given, entry, joint)
        });
        if let Some(found) = craft.spacecraft.eliminate_joints_of(&omega, &mut read, gains) {
            return Ok(found);
        }
        *gains = craft.spacecraft.joint_gains();
    }
    // SAFETY: by contract.
    unsafe { eliminated_from_set(craft, state, inputs, gains) }
}

/// Whether the elimination has nothing to reject but what is of joints: a free hub, no wrenches on bodies, finite numbers.
fn is_usual<const J: usize>(state: &types::State<J>, inputs: &types::Inputs<J>) -> bool {
    let of_hub = [&state.position, &state.velocity, &inputs.force, &inputs.torque];
    let vanishing: f64 = of_hub.into_iter().flatten().map(|number| 0.0 * number).sum();
    let [q0, q1, q2, q3] = state.attitude;
    (inputs.hub_mode, inputs.wrenches) == (0, 0)
        && (0..=2).contains(&inputs.gravity_model)
        && vanishing == 0.0
        && Quaternion { q0, q1, q2, q3 }.is_valid()
}

/// State and inputs of a joint; none of a mode that there is not.
fn reading<const J: usize>(
    state: &types::State<J>,
    inputs: &types::Inputs<J>,
    entry: usize,
    joint: usize,
) -> Option<JointReading> {
    let coordinate = *state.coordinate.get(entry)?.get(joint)?;
    let rate = *state.rate.get(entry)?.get(joint)?;
    let motor = *inputs.motor.get(entry)?.get(joint)?;
    let mode = match inputs.mode.get(entry)?.get(joint)? {
        0 => Mode::Driven,
        1 => Mode::Prescribed(*inputs.prescribed.get(entry)?.get(joint)?),
        2 => Mode::Locked,
        _ => return None,
    };
    Some(JointReading { coordinate, rate, motor, mode })
}

/// From a state and inputs of the set.
///
/// # Safety
///
/// Both pointers are null, misaligned, or point to readable structures.
#[inline(never)]
unsafe fn eliminated_from_set<const J: usize>(
    craft: &StoredSpacecraft<SetOf<J>>,
    state: *const types::State<J>,
    inputs: *const types::Inputs<J>,
    gains: &mut JointGains<SetOf<J>>,
) -> Result<DeviceContributions, Rejection>
where
    Versions: Interface<J>,
{
    let mut at = State::at_rest_for(&craft.spacecraft);
    let mut given = Inputs::driven_for(&craft.spacecraft);
    // SAFETY: by contract.
    unsafe { take_state_and_inputs(craft, state, inputs, (&mut at, &mut given)) }?;
    Ok(craft.spacecraft.eliminate_joints(&at, &given, gains)?)
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
