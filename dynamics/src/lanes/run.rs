//! Whole runs of a batch: the steps of [`Spacecraft::step`](crate::Spacecraft::step), quaternions
//! and joints in lanes from the first step to the last.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use pulp::{Simd, WithSimd};

use super::batch_inputs::BatchInputs;
use super::batch_spacecraft::{BatchSpacecraft, entered};
use super::evaluate::{LanedCraft, evaluate};
use super::fallback;
use super::group::{Group, NEAR_ONE};
use super::laned_set::LanedSet;
use super::loads::CheckFriction;
use super::motion::Motion;
use super::part::See;
use super::slot::{EachSlot, Slot, each_slot, take_joints};
use crate::attitude::quaternion::{bn, norm_squared, rate};
use crate::equations::device::Device;
use crate::equations::error::SolveError;
use crate::equations::stiffness::ACCEPTED;
use crate::model::kind::Kind;
use crate::numbers::lane::Lane;
use crate::numbers::laned::{Number, WIDEST};
use crate::numbers::real::advanced_by;
use crate::numbers::vec3::rotate_transposed;
use crate::solve::state::State;

/// The runs of a part of a batch.
pub(super) struct Runs<'a, 's, 'o, D: LanedSet, C> {
    pub(super) crafts: &'a C,
    /// The first of the states in the batch; a group of lanes begins there.
    pub(super) start: usize,
    pub(super) states: &'s mut [State<D>],
    pub(super) inputs: BatchInputs<'a, D>,
    pub(super) dt: f64,
    pub(super) steps: usize,
    /// After how many steps the states are seen; none where they are not.
    pub(super) every: Option<usize>,
    /// Sees a state of the part, by its number there, after so many steps.
    pub(super) see: &'o mut See<'o, D>,
    /// One for each state.
    pub(super) out: &'o mut [Result<(), SolveError<f64>>],
}

/// The most steps after which states are taken out of the lanes: a state that fails in a lane falls
/// back only for the steps since then.
const STRETCH: usize = 32;

impl<D: LanedSet, C: BatchSpacecraft<D>> WithSimd for Runs<'_, '_, '_, D, C> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        self.run(Lane::splat(simd, 0.0));
    }
}

impl<D: LanedSet, C: BatchSpacecraft<D>> Runs<'_, '_, '_, D, C> {
    /// State by state, for a CPU without wide registers, and for spacecraft that lanes do not support.
    pub(super) fn one_by_one(self) {
        let Self { crafts, start, states, inputs, dt, steps, every, see, out } = self;
        for (index, (state, end)) in states.iter_mut().zip(out).enumerate() {
            let (Some(craft), Some(inputs)) = (crafts.at(start + index), inputs.at(index)) else {
                continue;
            };
            let mut done = 0;
            while done < steps && end.is_ok() {
                let to_see = every.map_or(steps, |every| every - done % every);
                let stretch = (steps - done).min(to_see);
                *end = fallback::run(craft, state, inputs, dt, stretch);
                done += stretch;
                if end.is_ok() && every.is_some_and(|every| done % every == 0) {
                    see(index, done, state);
                }
            }
        }
    }

    #[inline(always)]
    fn run<T: Number>(self, zero: T) {
        let Self { crafts, start, states, inputs, dt, steps, every, see, out } = self;
        let Some(first) = crafts.at(0) else { return };
        let mut group = Group::<D, T>::new(first, zero);
        let groups = states.chunks_mut(T::WIDTH).zip(out.chunks_mut(T::WIDTH));
        for (index, (states, out)) in groups.enumerate() {
            let in_part = index * T::WIDTH;
            let (inputs, start) = (inputs.starting(in_part), start + in_part);
            if !crafts.are_in_lanes(start / T::WIDTH) {
                let see = &mut |index, done, now: &State<D>| see(in_part + index, done, now);
                Runs { crafts, start, states, inputs, dt, steps, every, see, out }.one_by_one();
                continue;
            }
            let of_lanes = entered(crafts, start / T::WIDTH, &mut group.slots, zero);
            let Some(laned) = of_lanes else { return };
            let (mut done, mut taken_in, mut motion) = (0, false, group.motion);
            while done < steps {
                if !taken_in {
                    group.gather(zero, (crafts, start), states, &inputs);
                    each_slot::<D, _>(laned.devices, &mut group.slots, &mut Begin(zero));
                    motion = group.motion;
                }
                let to_see = every.map_or(steps, |every| every - done % every);
                let stretch = (steps - done).min(to_see).min(STRETCH);
                let mut holds = zero.same(zero);
                // Where no lane has a state that lanes support, there is nothing to do in lanes.
                let lanes = group.laned.iter().zip(&*out);
                let in_lanes = if lanes.into_iter().any(|(laned, end)| *laned && end.is_ok()) {
                    stretch
                } else {
                    0
                };
                for _ in 0..in_lanes {
                    let step_holds = if C::EACH {
                        step::<D, T, true>(&laned, &mut group, zero, dt, &mut motion)
                    } else {
                        step::<D, T, false>(&laned, &mut group, zero, dt, &mut motion)
                    };
                    holds = zero.both(holds, step_holds);
                }
                each_slot::<D, _>(laned.devices, &mut group.slots, &mut LeaveJoints);
                let blocks = motion.map(Number::store);
                let holds = zero.like(1.0).or(holds, zero).store();
                (done, taken_in) = (done + stretch, true);
                for (lane, (state, end)) in states.iter_mut().zip(&mut *out).enumerate() {
                    let (Ok(()), Some(inputs)) = (&end, inputs.at(lane)) else { continue };
                    if group.laned[lane & (WIDEST - 1)] && holds.at(lane) == 1.0 {
                        blocks.take(lane, state);
                        let joints = &mut state.devices;
                        take_joints::<D, _>(laned.devices, &mut group.slots, lane, joints);
                    } else {
                        let craft = crafts.at(start + lane).unwrap_or(first);
                        *end = fallback::run(craft, state, inputs, dt, stretch);
                        taken_in = false;
                    }
                    if end.is_ok() && every.is_some_and(|every| done % every == 0) {
                        see(in_part + lane, done, state);
                    }
                }
                if out.iter().all(Result::is_err) {
                    break;
                }
            }
        }
        group.keep(first);
    }
}

/// One step of the hub's motion and of the joints in their slots; the lanes where it holds.
#[inline(always)]
fn step<D: LanedSet, T: Number, const EACH: bool>(
    craft: &LanedCraft<'_, D, T>,
    group: &mut Group<D, T>,
    zero: T,
    dt: f64,
    motion: &mut Motion<T>,
) -> T::Holds {
    let (middle, sixth, third) = (0.5 * dt, dt * 6.0_f64.recip(), dt * 3.0_f64.recip());
    let (start, near) = (*motion, zero.like(NEAR_ONE));
    let (mut now, mut sum) = (start, start.map(|_| zero));
    let mut holds = zero.same(zero);
    for (weight, time) in [(sixth, middle), (third, middle), (third, dt), (sixth, 0.0)] {
        let (attitude, omega) = (now.q, now.omega);
        let square = norm_squared(attitude);
        let long = square.above(near);
        holds = zero.both(holds, zero.both(long, zero.like(NEAR_ONE.recip()).above(square)));
        let acting = group.acting::<EACH>(craft, zero, &now, &mut holds, true);
        let found = evaluate::<D, T, EACH>(craft, &mut group.slots, &acting);
        holds = zero.both(holds, found.holds);
        if craft.passive {
            // What a single step would look at closer is left to it.
            let accepted = zero.like(ACCEPTED);
            let [dt, square] = [dt.abs(), dt * dt].map(|time| zero.like(time));
            let damping = accepted.above(found.stiffness.damping * dt);
            let spring = accepted.above(found.stiffness.spring * square);
            holds = zero.both(holds, zero.both(damping, spring));
        }
        let slope = Motion {
            r: now.v,
            v: rotate_transposed(&bn(attitude), found.r_b_n_ddot),
            q: rate(attitude, omega),
            omega: found.omega_dot,
        };
        let (weight, time) = (zero.like(weight), zero.like(time));
        sum = sum.zip(&slope, |sum, slope| sum + weight * slope);
        now = start.zip(&slope, |start, slope| start + (zero + time * slope));
        each_slot::<D, _>(craft.devices, &mut group.slots, &mut Stage { zero, weight, time });
    }
    if group.is_dry() {
        let (slots, devices, mut moving) = (&mut group.slots, craft.devices, holds);
        let check = CheckFriction::<D, T, EACH> { devices, slots, like: zero, holds: &mut moving };
        zero.apart(check);
        holds = moving;
    }
    let mut end = End { zero, vanishing: zero };
    each_slot::<D, _>(craft.devices, &mut group.slots, &mut end);
    let mut next = start.zip(&sum, |start, sum| start + sum);
    let length = norm_squared(next.q);
    let long = length.above(near);
    holds = zero.both(holds, zero.both(long, zero.like(NEAR_ONE.recip()).above(length)));
    let (scale, [q0, q1, q2, q3]) = (length.sqrt().recip(), next.q);
    next.q = [scale * q0, scale * q1, scale * q2, scale * q3];
    let mut vanishing = end.vanishing;
    *motion = next.map(|number| {
        vanishing = vanishing + number * zero;
        number
    });
    zero.both(holds, vanishing.same(zero))
}

/// Begins the first step where the joints are.
struct Begin<T>(T);

impl<T: Number> EachSlot<T> for Begin<T> {
    #[inline(always)]
    fn each<K: Kind<Scalar = f64>>(&mut self, _: &Device<K>, slot: &mut Slot<K, T>) {
        slot.start = slot.joints;
        slot.sum = K::zip_joints(&slot.joints, &slot.joints, |_, _| self.0);
    }
}

/// Brings joints from lanes into blocks.
struct LeaveJoints;

impl<T: Number> EachSlot<T> for LeaveJoints {
    #[inline(always)]
    fn each<K: Kind<Scalar = f64>>(&mut self, _: &Device<K>, slot: &mut Slot<K, T>) {
        slot.block = K::zip_joints(&slot.joints, &slot.joints, |number, _| number.store());
    }
}

/// Adds a stage's slope to what the step adds up to, and moves on to the next stage.
struct Stage<T> {
    zero: T,
    weight: T,
    time: T,
}

impl<T: Number> EachSlot<T> for Stage<T> {
    #[inline(always)]
    fn each<K: Kind<Scalar = f64>>(&mut self, _: &Device<K>, slot: &mut Slot<K, T>) {
        let Self { zero, weight, time } = *self;
        let slope = K::slope(&slot.joints, &slot.found);
        slot.sum = K::zip_joints(&slot.sum, &slope, |sum, slope| sum + weight * slope);
        slot.joints =
            K::zip_joints(&slot.start, &slope, |start, slope| start + (zero + time * slope));
    }
}

/// Ends a step: the next one begins where it leads.
struct End<T> {
    zero: T,
    /// Zero where every number so far is finite, else NaN.
    vanishing: T,
}

impl<T: Number> EachSlot<T> for End<T> {
    #[inline(always)]
    fn each<K: Kind<Scalar = f64>>(&mut self, _: &Device<K>, slot: &mut Slot<K, T>) {
        slot.start = K::zip_joints(&slot.start, &slot.sum, |start, sum| {
            let next = advanced_by(start, sum);
            self.vanishing = self.vanishing + next * self.zero;
            next
        });
        slot.joints = slot.start;
        slot.sum = K::zip_joints(&slot.sum, &slot.sum, |_, _| self.zero);
    }
}
