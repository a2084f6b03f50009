//! What the devices contribute to the equations of a hub that the caller has, and the accelerations of their joints
//! once those of that hub are known.
//!
//! Gains are in memory that the caller owns, as a spacecraft is.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::{DeviceContributions, Devices, Each, Inputs, JointGains, State};

use crate::craft::{Craft, StoredSpacecraft, made_by};
use crate::error::{Code, Fault, Rejection};
use crate::evaluate::{take_state_and_inputs, with};
use crate::memory::{self, OutputPointer};
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
        let found = craft.spacecraft.joint_accelerations(&gains.of, &a, &omega_dot)?;
        let joint = [[0.0; J]; crate::MAX_DEVICES];
        let mut to = types::Accelerations { linear, angular, joint };
        give(&mut to.joint, found.values(), &craft.entry_map, |acceleration| acceleration);
        out.write(to);
        Ok(())
    };
    // SAFETY: by contract.
    unsafe { with::<J>(craft, fault, call) }
}

/// What the devices contribute; the gains are large, so that a result of them would be copied.
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
