//! The accelerations of a batch: each state once.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use pulp::{Simd, WithSimd};

use super::batch_inputs::BatchInputs;
use super::batch_spacecraft::{BatchSpacecraft, entered};
use super::evaluate::evaluate;
use super::fallback;
use super::group::Group;
use super::laned_set::LanedSet;
use super::motion::at;
use super::slot::{StoreAccelerations, each_slot, take_found};
use crate::equations::error::SolveError;
use crate::numbers::lane::Lane;
use crate::numbers::laned::{Number, WIDEST};
use crate::numbers::vec3::{map, vector};
use crate::solve::state::{Accelerations, State};

/// The accelerations of a part of a batch.
pub(super) struct Evaluation<'a, 'o, D: LanedSet, C> {
    pub(super) crafts: &'a C,
    /// The first of the states in the batch; a group of lanes begins there.
    pub(super) start: usize,
    pub(super) states: &'a [State<D>],
    pub(super) inputs: BatchInputs<'a, D>,
    /// One for each state, nothing accelerating.
    pub(super) out: &'o mut [Result<Accelerations<D>, SolveError<f64>>],
}

impl<D: LanedSet, C: BatchSpacecraft<D>> WithSimd for Evaluation<'_, '_, D, C> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        self.evaluate(Lane::splat(simd, 0.0));
    }
}

impl<D: LanedSet, C: BatchSpacecraft<D>> Evaluation<'_, '_, D, C> {
    /// State by state, for a CPU without wide registers, and for spacecraft that lanes do not support.
    pub(super) fn one_by_one(self) {
        for (index, (state, place)) in self.states.iter().zip(self.out).enumerate() {
            let craft = self.crafts.at(self.start + index);
            if let (Some(craft), Some(inputs)) = (craft, self.inputs.at(index)) {
                *place = fallback::accelerations(craft, state, inputs);
            }
        }
    }

    #[inline(always)]
    fn evaluate<T: Number>(self, zero: T) {
        let crafts = self.crafts;
        let Some(first) = crafts.at(0) else { return };
        let mut group = Group::<D, T>::new(first, zero);
        let groups = self.states.chunks(T::WIDTH).zip(self.out.chunks_mut(T::WIDTH));
        for (index, (states, places)) in groups.enumerate() {
            let inputs = self.inputs.starting(index * T::WIDTH);
            let start = self.start + index * T::WIDTH;
            if !crafts.are_in_lanes(start / T::WIDTH) {
                Evaluation { crafts, start, states, inputs, out: places }.one_by_one();
                continue;
            }
            group.gather(zero, (crafts, start), states, &inputs);
            let of_lanes = entered(crafts, start / T::WIDTH, &mut group.slots, zero);
            let Some(laned) = of_lanes else { return };
            let (motion, mut holds) = (group.motion, zero.same(zero));
            let found = if C::EACH {
                let acting = group.acting::<true>(&laned, zero, &motion, &mut holds, false);
                evaluate::<D, T, true>(&laned, &mut group.slots, &acting)
            } else {
                let acting = group.acting::<false>(&laned, zero, &motion, &mut holds, false);
                evaluate::<D, T, false>(&laned, &mut group.slots, &acting)
            };
            each_slot::<D, _>(laned.devices, &mut group.slots, &mut StoreAccelerations);
            let holds = zero.like(1.0).or(zero.both(found.holds, holds), zero).store();
            let r_b_n_ddot = map(found.r_b_n_ddot, Number::store);
            let omega_dot = map(found.omega_dot, Number::store);
            for (lane, (state, place)) in states.iter().zip(places).enumerate() {
                let sound = group.laned[lane & (WIDEST - 1)] && holds.at(lane) == 1.0;
                match (place, inputs.at(lane)) {
                    (Ok(found), _) if sound => {
                        found.r_b_n_ddot = vector(at(&r_b_n_ddot, lane));
                        found.omega_dot = vector(at(&omega_dot, lane));
                        let of_devices = &mut found.devices;
                        take_found::<D, _>(laned.devices, &mut group.slots, lane, of_devices);
                    }
                    (place, Some(inputs)) => {
                        if let Some(craft) = crafts.at(start + lane) {
                            *place = fallback::accelerations(craft, state, inputs);
                        }
                    }
                    (_, None) => {}
                }
            }
        }
        group.keep(first);
    }
}
