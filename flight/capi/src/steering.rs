//! Steering: the terms, commands for a torque, motor torques for commands.

use nalgebra::Vector3;
use precess_dynamics::{
    Inputs, Inverse, Servo, State, Steered, SteeringError, SteeringLaw, SteeringTerms, Value,
    steering_weights,
};

use crate::craft::{Craft, StoredSpacecraft};
use crate::entry_map::EntryMap;
use crate::error::{Code, Fault, Rejection};
use crate::evaluate::{take_state_and_inputs, with};
use crate::memory::{OutputPointer, refer, vector};
use crate::state::state_of;
use crate::types::{self, PerJoint};
use crate::version::{Interface, SetOf, Versions, give, take};
use crate::{MAX_DEVICES, VERSIONS};

/// Joints of a spacecraft of each version at most.
const JOINTS: [usize; 2] = [MAX_DEVICES * VERSIONS[0], MAX_DEVICES * VERSIONS[1]];

/// A value per joint of the set, those beyond its last joint unset.
fn joints<V: Value, U, const J: usize, const N: usize>(
    unset: V,
    from: &PerJoint<U, J>,
    entry_map: &EntryMap,
    of: impl Fn(&U) -> V,
) -> [V; N] {
    let mut to = [unset; N];
    take(to.iter_mut(), from, entry_map, of);
    to
}

/// What is commanded of each joint.
fn steered<const J: usize, const N: usize>(
    from: &PerJoint<i32, J>,
    entry_map: &EntryMap,
) -> Result<[Steered; N], Rejection> {
    let mut to = [Steered::Nothing; N];
    for (to, [entry, joint]) in to.iter_mut().zip(entry_map.joints()) {
        *to = match from.get(entry).and_then(|joints| joints.get(joint)) {
            Some(0) => Steered::Nothing,
            Some(1) => Steered::Rate,
            Some(2) => Steered::Acceleration,
            _ => return Err(Rejection { entry: Some(entry), ..Code::UnknownChoice.into() }),
        };
    }
    Ok(to)
}

/// A rejection with the joint whose number is at fault.
fn at_joint(error: SteeringError, entry_map: &EntryMap) -> Rejection {
    let of_joints = ["weight", "bound", "command", "feed-forward", "gain", "torque limit"];
    let joint = match &error {
        // Byte by byte: no call of the C library's `memcmp`.
        SteeringError::Argument { what, index, .. }
            if of_joints.iter().any(|of| of.bytes().eq(what.bytes())) =>
        {
            entry_map.joints().nth(*index)
        }
        _ => None,
    };
    let rejection = Rejection::from(error);
    joint.map_or(rejection, |[entry, joint]| Rejection {
        entry: Some(entry),
        joint_index: Some(joint),
        ..rejection
    })
}

/// See `precess_steering.h`.
///
/// # Safety
///
/// `craft` points to a spacecraft, the others to their structures; `fault` may be null.
pub(crate) unsafe fn steering_terms_of<const J: usize>(
    craft: *const Craft,
    state: *const types::State<J>,
    out: *mut types::SteeringTerms<J>,
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
        out.write(if J == VERSIONS[0] {
            terms::<J, { JOINTS[0] }>(craft, &state)?
        } else {
            terms::<J, { JOINTS[1] }>(craft, &state)?
        });
        Ok(())
    };
    // SAFETY: by contract.
    unsafe { with::<J>(craft, fault, call) }
}

fn terms<const J: usize, const N: usize>(
    craft: &StoredSpacecraft<SetOf<J>>,
    state: &State<SetOf<J>>,
) -> Result<types::SteeringTerms<J>, Rejection>
where
    Versions: Interface<J>,
{
    let found: SteeringTerms<f64, N> = craft.spacecraft.steering_terms(state)?;
    let [x, y, z] = found.inertia.transpose().data.0;
    let [[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]] = [x, y, z];
    let mut to = types::SteeringTerms {
        by_rate: [[[0.0; 3]; J]; MAX_DEVICES],
        by_acceleration: [[[0.0; 3]; J]; MAX_DEVICES],
        momentum: found.momentum.into(),
        first_moment: found.first_moment.into(),
        inertia: [xx, xy, xz, yx, yy, yz, zx, zy, zz],
        gyroscopic: found.gyroscopic.into(),
    };
    give(&mut to.by_rate, found.by_rate.into_iter(), &craft.entry_map, Into::into);
    let columns = found.by_acceleration.into_iter();
    give(&mut to.by_acceleration, columns, &craft.entry_map, Into::into);
    Ok(to)
}

/// See `precess_steering.h`.
///
/// # Safety
///
/// `craft` points to a spacecraft, `torque` to three numbers, the others to their structures; `fault` may be null.
pub(crate) unsafe fn allocate<const J: usize>(
    craft: *const Craft,
    state: *const types::State<J>,
    law: *const types::SteeringLaw<J>,
    torque: *const f64,
    out: *mut types::Allocation<J>,
    fault: *mut Fault,
) -> i32
where
    Versions: Interface<J>,
{
    let call = |craft: &StoredSpacecraft<SetOf<J>>| {
        // SAFETY: by contract.
        let out = unsafe { OutputPointer::new(out) }?;
        // SAFETY: by contract.
        let (state, law) = unsafe { (state_of(craft, refer(state)?), refer(law)?) };
        // SAFETY: by contract.
        let torque = Vector3::from(unsafe { vector(torque) }?);
        out.write(if J == VERSIONS[0] {
            allocated::<J, { JOINTS[0] }>(craft, &state, law, &torque)?
        } else {
            allocated::<J, { JOINTS[1] }>(craft, &state, law, &torque)?
        });
        Ok(())
    };
    // SAFETY: by contract.
    unsafe { with::<J>(craft, fault, call) }
}

fn allocated<const J: usize, const N: usize>(
    craft: &StoredSpacecraft<SetOf<J>>,
    state: &State<SetOf<J>>,
    from: &types::SteeringLaw<J>,
    torque: &Vector3<f64>,
) -> Result<types::Allocation<J>, Rejection>
where
    Versions: Interface<J>,
{
    let entry_map = &craft.entry_map;
    let rejected = |error| at_joint(error, entry_map);
    let number = |number: &f64| *number;
    let steered: [Steered; N] = steered(&from.steered, entry_map)?;
    let inverse = match from.inverse {
        0 => Inverse::Exact,
        1 => Inverse::SingularityRobust { lambda: from.lambda, mu: from.mu },
        2 => Inverse::Generalised { lambda: from.lambda, mu: from.mu, dither: from.dither },
        _ => return Err(Code::UnknownChoice.into()),
    };
    let terms: SteeringTerms<f64, N> = craft.spacecraft.steering_terms(state)?;
    let rates = steered.map(|of| if of == Steered::Rate { of } else { Steered::Nothing });
    let reference = from.reference;
    let measure = terms.matrix(&rates).measure(reference);
    let weights = joints(0.0, &from.weight, entry_map, number);
    let mut law = SteeringLaw { inverse, weights, reference };
    if from.wheel_mu != 0.0 {
        let shares = steering_weights(&steered, [1.0, 1.0], from.wheel_mu, measure);
        for (weight, share) in law.weights.iter_mut().zip(shares) {
            *weight *= share;
        }
    }
    let matrix = terms.matrix(&steered);
    let found = match from.bounded {
        0 => law.allocate(&matrix, torque),
        1 => {
            let lower: [f64; N] = joints(0.0, &from.lower, entry_map, number);
            let upper: [f64; N] = joints(0.0, &from.upper, entry_map, number);
            let mut bounds = [[0.0; 2]; N];
            for (bounds, ends) in bounds.iter_mut().zip(lower.into_iter().zip(upper)) {
                *bounds = [ends.0, ends.1];
            }
            law.allocate_within(&matrix, torque, &bounds)
        }
        _ => return Err(Code::UnknownChoice.into()),
    };
    let found = found.map_err(rejected)?;
    if !measure.is_finite() {
        return Err(Code::Overflow.into());
    }
    let mut to = types::Allocation {
        command: [[0.0; J]; MAX_DEVICES],
        torque_error: found.torque_error.into(),
        measure,
        at_bound: i32::try_from(found.bounded).unwrap_or(i32::MAX),
        reserved: 0,
    };
    give(&mut to.command, found.commands.into_iter(), entry_map, |command| command);
    Ok(to)
}

/// See `precess_steering.h`.
///
/// # Safety
///
/// `craft` points to a spacecraft, the others to their structures; `fault` may be null.
pub(crate) unsafe fn servo_torques_of<const J: usize>(
    craft: *const Craft,
    state: *const types::State<J>,
    inputs: *const types::Inputs<J>,
    servo: *const types::Servo<J>,
    out: *mut types::ServoTorques<J>,
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
        // SAFETY: by contract.
        let servo = unsafe { refer(servo) }?;
        out.write(if J == VERSIONS[0] {
            torques::<J, { JOINTS[0] }>(craft, &at, &given, servo)?
        } else {
            torques::<J, { JOINTS[1] }>(craft, &at, &given, servo)?
        });
        Ok(())
    };
    // SAFETY: by contract.
    unsafe { with::<J>(craft, fault, call) }
}

fn torques<const J: usize, const N: usize>(
    craft: &StoredSpacecraft<SetOf<J>>,
    state: &State<SetOf<J>>,
    inputs: &Inputs<SetOf<J>>,
    from: &types::Servo<J>,
) -> Result<types::ServoTorques<J>, Rejection>
where
    Versions: Interface<J>,
{
    let entry_map = &craft.entry_map;
    let numbers = |of| -> [f64; N] { joints(0.0, of, entry_map, |number| *number) };
    let steered = steered(&from.steered, entry_map)?;
    let servo = Servo { steered, gains: numbers(&from.gain), limits: numbers(&from.limit) };
    let [commands, forward] = [numbers(&from.command), numbers(&from.feed_forward)];
    let found = craft.spacecraft.servo(&servo, state, inputs, &commands, &forward);
    let found = found.map_err(|error| at_joint(error, entry_map))?;
    let mut to = types::ServoTorques {
        motor: [[0.0; J]; MAX_DEVICES],
        limited: i32::try_from(found.limited).unwrap_or(i32::MAX),
        reserved: 0,
    };
    give(&mut to.motor, found.torques.into_iter(), entry_map, |torque| torque);
    Ok(to)
}
