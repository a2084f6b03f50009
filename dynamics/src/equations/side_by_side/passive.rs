//! Springs, dampers and dry friction of joints in lanes.
//!
//! What `Passive` and `PassiveStep` decide by branches is a choice lane by lane here.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use super::blocks::DeviceConstants;
use crate::equations::stiffness::Stiffness;
use crate::model::kernels::Kernels;
use crate::model::mode::Drive;
use crate::model::passive::Passive;
use crate::numbers::each::JointStates;
use crate::numbers::laned::Number;

/// What is given of the joints, springs and dampers with the motors.
#[inline(always)]
pub(crate) fn with_passive<K: Kernels, T: Number>(
    joints: &K::Joints<T>,
    drives: &K::PerJoint<Drive<T>>,
    passive: &K::PerJoint<Passive<T>>,
) -> K::PerJoint<Drive<T>> {
    let mut states = joints.states();
    let states =
        K::zip_per_joint(drives, drives, |drive, _| states.next().unwrap_or([drive.torque; 2]));
    let own = K::zip_per_joint(&states, passive, |[coordinate, rate], passive| {
        let spring = -(passive.stiffness * (coordinate - passive.rest));
        spring + -(passive.viscous * rate)
    });
    add_own::<K, T>(drives, &own)
}

/// The same with dry friction.
#[inline(always)]
fn with_friction<K: Kernels, T: Number>(
    joints: &K::Joints<T>,
    drives: &K::PerJoint<Drive<T>>,
    passive: &K::PerJoint<Passive<T>>,
) -> K::PerJoint<Drive<T>> {
    let mut states = joints.states();
    let states =
        K::zip_per_joint(drives, drives, |drive, _| states.next().unwrap_or([drive.torque; 2]));
    let own = K::zip_per_joint(
        &states,
        passive,
        #[inline(always)]
        |[coordinate, rate], passive| {
            let spring = -(passive.stiffness * (coordinate - passive.rest));
            spring + of_friction(passive, rate)
        },
    );
    add_own::<K, T>(drives, &own)
}

/// The torques of springs and friction with those of the motors of driven joints.
#[inline(always)]
fn add_own<K: Kernels, T: Number>(
    drives: &K::PerJoint<Drive<T>>,
    own: &K::PerJoint<T>,
) -> K::PerJoint<Drive<T>> {
    K::zip_per_joint(drives, own, |drive, own| Drive {
        torque: drive.torque + own * drive.driven,
        ..drive
    })
}

/// The rate, and the rate below which friction fades, by the larger of the two; and the two factors
/// that they are multiplied by.
#[inline(always)]
fn by_larger<T: Number>(passive: Passive<T>, rate: T) -> ([T; 2], [T; 2]) {
    let larger = rate.abs().larger(passive.coulomb_rate);
    let (small, large) = (rate.like(f64::EPSILON), rate.like(f64::EPSILON.recip()));
    let power = small.or(larger.above(large), rate.like(1.0));
    let power = large.or(small.above(larger), power);
    let second = (power * larger).recip();
    ([rate * power * second, passive.coulomb_rate * power * second], [power, second])
}

/// Torque or force of friction, as `Passive::of_friction`.
#[inline(always)]
fn of_friction<T: Number>(passive: Passive<T>, rate: T) -> T {
    let viscous = -(passive.viscous * rate);
    let ([q, q_c], _) = by_larger(passive, rate);
    let dry = viscous - passive.coulomb * q * (q * q + q_c * q_c).sqrt().recip();
    viscous.or(passive.coulomb.same(rate.like(0.0)), dry)
}

/// By how much friction grows with the rate, as `Passive::damping`.
#[inline(always)]
fn damping<T: Number>(passive: Passive<T>, rate: T) -> T {
    let ([q, q_c], [first, second]) = by_larger(passive, rate);
    let share = (q * q + q_c * q_c).recip();
    let dry =
        passive.viscous + passive.coulomb * first * second * (q_c * q_c * share * share.sqrt());
    passive.viscous.or(passive.coulomb.same(rate.like(0.0)), dry)
}

/// The torques with springs and friction only where there are any: adding zero to a torque of minus
/// zero changes its sign.
#[inline(always)]
pub(crate) fn where_sprung<K: Kernels, T: Number>(
    sprung: T::Holds,
    drives: &K::PerJoint<Drive<T>>,
    without: &K::PerJoint<Drive<T>>,
) -> K::PerJoint<Drive<T>> {
    K::zip_per_joint(drives, without, |drive, without| Drive {
        torque: drive.torque.or(sprung, without.torque),
        ..drive
    })
}

/// Drives of a device's joints; damping and stiffness of the joints where any has a spring or friction.
type WithOwn<K, T> = (<K as Kernels>::PerJoint<Drive<T>>, Option<<K as Kernels>::PerJoint<[T; 2]>>);

/// What is given of the joints of a device, springs and friction with the motors; and damping and
/// stiffness of the joints. As the elimination does it where nothing is dry.
#[inline(always)]
pub(crate) fn with_own<K: Kernels, T: Number>(
    (device, dry): (&DeviceConstants<K, T>, bool),
    joints: &K::Joints<T>,
    given: &K::PerJoint<Drive<T>>,
) -> WithOwn<K, T> {
    let Some(passive) = &device.passive else { return (*given, None) };
    if !dry {
        let drives = with_passive::<K, T>(joints, given, passive);
        let drives = where_sprung::<K, T>(device.sprung, &drives, given);
        return (drives, Some(viscous::<K, T>(passive)));
    }
    let drives = with_friction::<K, T>(joints, given, passive);
    let mut states = joints.states();
    let coefficients = K::zip_per_joint(
        passive,
        passive,
        #[inline(always)]
        |passive, _| {
            let [_, rate] = states.next().unwrap_or([passive.viscous; 2]);
            [damping(passive, rate), passive.stiffness]
        },
    );
    (where_sprung::<K, T>(device.sprung, &drives, given), Some(coefficients))
}

/// Damping and stiffness of joints without dry friction.
#[inline(always)]
pub(crate) fn viscous<K: Kernels, T: Number>(
    passive: &K::PerJoint<Passive<T>>,
) -> K::PerJoint<[T; 2]> {
    K::zip_per_joint(passive, passive, |passive, _| [passive.viscous, passive.stiffness])
}

/// Adds damping and stiffness to what a step has to resolve.
#[inline(always)]
pub(crate) fn add_stiffness<K: Kernels, T: Number>(
    stiffness: &mut Stiffness<T>,
    coefficients: &K::PerJoint<[T; 2]>,
    eliminated: &K::Eliminated<T>,
    drives: &K::PerJoint<Drive<T>>,
) {
    stiffness.add::<K>(coefficients, &K::pivots(eliminated), drives);
}

/// Where no joint with dry friction has come to rest, or reversed, since it had other rates: what
/// `PassiveStep` resolves near rest.
#[inline(always)]
pub(crate) fn keeps_turning<K: Kernels, T: Number>(
    like: T,
    passive: &K::PerJoint<Passive<T>>,
    start: &K::Joints<T>,
    now: &K::Joints<T>,
) -> T::Holds {
    let (zero, one, mut holds) = (like.like(0.0), like.like(1.0), like.same(like));
    let (mut start, mut now) = (start.states(), now.states());
    K::zip_per_joint(
        passive,
        passive,
        #[inline(always)]
        |passive, _| {
            let [_, first] = start.next().unwrap_or([zero; 2]);
            let [_, rate] = now.next().unwrap_or([zero; 2]);
            let rests = like.either(zero.above(rate * first), rate.same(zero));
            // At rest from the start, or without dry friction.
            let never = like.either(first.same(zero), passive.coulomb.same(zero));
            let moves = zero.or(rests, one).above(zero);
            holds = like.both(holds, like.either(never, moves));
            zero
        },
    );
    holds
}
