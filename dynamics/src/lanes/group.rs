//! [`Group`]: as many states of a batch as there are lanes, with what acts on them.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use super::batch_inputs::BatchInputs;
use super::batch_spacecraft::BatchSpacecraft;
use super::constants::OwnLoads;
use super::evaluate::{HubInputs, LanedCraft};
use super::laned_set::{LanedSet, fit_inputs};
use super::loads::AddLoads;
use super::motion::{Forces, Motion};
use super::scratch;
use super::slot::{LoadDrives, SlotsOf, each_slot, load_joints, put_given};
use crate::attitude::quaternion::{Quaternion, bn, norm_squared};
use crate::equations::gravity::Gravity;
use crate::equations::hub::HubConstants;
use crate::model::mode::{HubMode, Mode};
use crate::numbers::each::Each;
use crate::numbers::laned::{Block, Number, WIDEST};
use crate::numbers::vec3::{add, components, rotate};
use crate::sets::per_device as data;
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::State;

/// As many states as there are lanes.
pub(super) struct Group<D: LanedSet, T: Number> {
    pub(super) slots: SlotsOf<D, T>,
    /// The lanes whose state and inputs lanes support.
    pub(super) laned: [bool; WIDEST],
    /// Whether what is given of the joints is there already, the same for every state.
    given: bool,
    /// The hub's motion.
    pub(super) motion: Motion<T>,
    /// What acts on the hub, on its way in.
    forces: Forces<Block>,
    /// What acts on bodies besides motors, springs and dampers.
    loads: GroupLoads,
}

/// What acts on the bodies of a group besides motors, springs and dampers; where there is none of
/// it, lanes compute none of it.
#[derive(Clone, Copy, Debug)]
pub(super) struct GroupLoads {
    /// The hub without its devices.
    pub(super) hub: HubConstants<Block>,
    /// The gravitational parameter of a central field, and one in the lanes that have one.
    pub(super) mu: Block,
    pub(super) central: Block,
    /// One in the lanes that have wrenches on bodies.
    pub(super) wrenches: Block,
    /// Whether there is such a lane.
    pub(super) any_central: bool,
    pub(super) any_wrenches: bool,
    /// What the spacecraft have of their own.
    pub(super) own: OwnLoads,
}

impl GroupLoads {
    /// Whether there are any.
    #[inline(always)]
    fn any(&self) -> bool {
        self.any_central || self.any_wrenches || self.own.any()
    }

    /// None yet but what the spacecraft have of their own.
    fn clear(&mut self, own: OwnLoads) {
        if self.any_central || self.any_wrenches {
            (self.central, self.wrenches) = (Block::ZERO, Block::ZERO);
        }
        (self.any_central, self.any_wrenches, self.own) = (false, false, own);
    }

    /// Puts what acts on bodies into one lane.
    fn put<D: LanedSet>(&mut self, lane: usize, inputs: &Inputs<D>) {
        if let Gravity::Central { mu } = inputs.gravity {
            self.mu.put(lane, mu);
            self.central.put(lane, 1.0);
            self.any_central = true;
        }
        if inputs.bodies.is_some() {
            self.wrenches.put(lane, 1.0);
            self.any_wrenches = true;
        }
    }
}

impl<D: LanedSet, T: Number> Group<D, T> {
    pub(super) fn new(craft: &Spacecraft<D>, zero: T) -> Self {
        let own = OwnLoads { dry: false, lumped: false };
        Self {
            slots: scratch::take::<D, T>(&craft.devices, zero),
            laned: [true; WIDEST],
            given: false,
            motion: Motion::filled(zero),
            forces: Forces::ZERO,
            loads: GroupLoads {
                hub: craft.hub.map(|number| Block([number; WIDEST])),
                mu: Block::ZERO,
                central: Block::ZERO,
                wrenches: Block::ZERO,
                any_central: false,
                any_wrenches: false,
                own,
            },
        }
    }

    /// Keeps the slots for the next call on this thread.
    pub(super) fn keep(self, craft: &Spacecraft<D>) {
        scratch::keep::<D, T>(&craft.devices, self.slots);
    }

    /// Takes states in. Lanes beyond the last of them repeat it: they cost nothing and harm
    /// nothing.
    #[inline(always)]
    pub(super) fn gather<C: BatchSpacecraft<D>>(
        &mut self,
        zero: T,
        (crafts, start): (&C, usize),
        states: &[State<D>],
        all: &BatchInputs<'_, D>,
    ) {
        let (Some(last), Some(end)) = (states.len().checked_sub(1), states.last()) else { return };
        let Some(first) = crafts.at(start) else { return };
        // Joints of another number would be put beside those of other lanes.
        let fit = |state: &State<D>| D::fits::<data::Joints>(&first.devices, &state.devices);
        if !states.iter().all(fit) {
            self.laned = [false; WIDEST];
            self.given = false;
            return;
        }
        let mut lanes = [end; WIDEST];
        lanes.iter_mut().zip(states).for_each(|(lane, state)| *lane = state);
        self.motion = Motion::in_lanes(zero, lanes);
        let joints = lanes.map(|state| &state.devices);
        load_joints::<D, _>(&first.devices, &mut self.slots, zero, joints);
        for lane in 0..T::WIDTH {
            let Some(state) = states.get(lane.min(last)) else { return };
            self.laned[lane & (WIDEST - 1)] = laned_state(state);
        }
        // Drives that loads complete are those of one spacecraft.
        self.given &= !(C::EACH && crafts.own_loads(start / T::WIDTH).any());
        if self.given {
            return;
        }
        self.put_inputs((crafts, start), states, all);
        each_slot::<D, _>(&first.devices, &mut self.slots, &mut LoadDrives(zero));
        // A locked joint is looked at in each state.
        self.given = match all {
            BatchInputs::Same(inputs) => {
                !(C::EACH && self.loads.any())
                    && self.laned == [true; WIDEST]
                    && inputs.modes.values().all(|mode| mode != Mode::Locked)
            }
            BatchInputs::Each(_) => false,
        };
    }

    /// Puts what acts on each state into its lane. Never inlined: no number is computed, and what is
    /// entered once is not to be in the way of what is evaluated often.
    #[inline(never)]
    fn put_inputs<C: BatchSpacecraft<D>>(
        &mut self,
        (crafts, start): (&C, usize),
        states: &[State<D>],
        all: &BatchInputs<'_, D>,
    ) {
        let Some(last) = states.len().checked_sub(1) else { return };
        let group = start / T::WIDTH;
        self.loads.clear(crafts.own_loads(group));
        for lane in 0..T::WIDTH {
            let index = lane.min(last);
            let (Some(state), Some(inputs)) = (states.get(index), all.at(index)) else { return };
            let Some(craft) = crafts.at(start + index) else { return };
            let (slots, joints) = (&mut self.slots, &state.devices);
            self.laned[lane & (WIDEST - 1)] &= lanes_support_inputs(inputs)
                && fit_inputs::<D>(&craft.devices, inputs.of_joints())
                && put_given::<D, _>(&craft.devices, slots, lane, joints, inputs.of_joints());
            self.forces.put(lane, inputs);
            self.loads.put(lane, inputs);
        }
        if let (true, Some(blocks)) = (self.loads.any_central, crafts.blocks(group)) {
            self.loads.hub = blocks.hub;
        }
    }

    /// Whether joints of the group have dry friction.
    #[inline(always)]
    pub(super) fn is_dry(&self) -> bool {
        self.loads.own.dry
    }

    /// What acts at a motion of the hub, where the joints are those of the slots; `holds` is cleared
    /// where lanes do not support that. `in_step` of a step that began at the start of the slots.
    #[inline(always)]
    pub(super) fn acting<const EACH: bool>(
        &mut self,
        craft: &LanedCraft<'_, D, T>,
        zero: T,
        motion: &Motion<T>,
        holds: &mut T::Holds,
        in_step: bool,
    ) -> HubInputs<T> {
        let Forces { force, torque_b, field, none } = self.forces.map(|block| zero.load(&block));
        let at_b = add(rotate(&bn(motion.q), field), [none; 3]);
        let with_loads = self.loads.any();
        let mut acting = HubInputs { omega: motion.omega, force, torque_b, at_b, with_loads };
        if with_loads {
            // Copies: numbers whose place another function knows do not stay in registers.
            let (mut with, mut holding, motion) = (acting, *holds, *motion);
            zero.apart(AddLoads::<D, T, EACH> {
                devices: craft.devices,
                slots: &mut self.slots,
                loads: &self.loads,
                motion: &motion,
                acting: &mut with,
                holds: &mut holding,
                in_step,
            });
            (acting, *holds) = (with, holding);
        }
        acting
    }
}

/// Whether lanes support this state: a quaternion near unit length, and finite numbers where the
/// result may not show that one is not.
#[inline(always)]
fn laned_state<D: LanedSet>(state: &State<D>) -> bool {
    let Quaternion { q0, q1, q2, q3 } = state.attitude;
    let [[a, b, c], [d, e, f]] = [components(&state.r_b_n), components(&state.r_b_n_dot)];
    (NEAR_ONE..=NEAR_ONE.recip()).contains(&norm_squared([q0, q1, q2, q3]))
        && (a + b + c + d + e + f).is_finite()
}

/// Whether lanes support these inputs, and those are finite that the result may not show; it shows
/// wrenches, which reach the hub.
#[inline(always)]
fn lanes_support_inputs<D: LanedSet>(inputs: &Inputs<D>) -> bool {
    let [[a, b, c], [d, e, f]] = [components(&inputs.force), components(&inputs.torque_b)];
    inputs.hub == HubMode::Free
        && inputs.motors.values().fold(a + b + c + d + e + f, |sum, u| sum + u).is_finite()
}

/// A quaternion whose squared length is between this and its reciprocal is taken as it is.
pub(super) const NEAR_ONE: f64 = 1e-20;
