//! [`Batch`]: many states of one spacecraft, in the lanes of the widest registers at hand.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use std::vec::Vec;

use pulp::{Arch, Simd, WithSimd};

use super::batch_inputs::BatchInputs;
use super::constants::CraftBlocks;
use super::crafts::{Crafts, entered};
use super::evaluate::{Acting, evaluate};
use super::lane::Lane;
use super::motion::{Forces, Motion, at};
use super::number::{Block, Number, WIDEST};
use super::run::Runs;
use super::slot::{
    Enter, LanedSet, Leave, Slots, SlotsOf, each_slot, load_joints, put_given, take_found,
};
use crate::attitude::quaternion::{Quaternion, bn, norm_squared};
use crate::equations::error::{Quantity, SolveError};
use crate::model::mode::{HubMode, Mode};
use crate::model::parameters::Hub;
use crate::numbers::each::Each;
use crate::numbers::vec3::{add, components, map, rotate, vector};
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::{Accelerations, State};
use crate::validation::parameter_error::ParameterError;

/// What became of each state of a batch, in order.
pub type BatchAccelerations<D> = Vec<Result<Accelerations<D>, SolveError<f64>>>;

/// A spacecraft that is evaluated at many states at a time.
///
/// A state has the result, or the error, that [`Spacecraft`] gives it by itself, to the bit, unless
/// the lanes fuse ([`Self::fused`]). A state falls back to the scalar path where it has what is
/// [unsupported in lanes](crate::lanes), and where anything fails.
#[derive(Clone, Debug)]
pub struct Batch<D: LanedSet> {
    craft: Spacecraft<D>,
    fused: bool,
}

impl<D: LanedSet> Batch<D> {
    /// Checks the parameters and computes everything that depends only on them.
    ///
    /// # Errors
    ///
    /// As [`Spacecraft::new`].
    pub fn new(hub: &Hub, devices: &D) -> Result<Self, ParameterError<f64>> {
        Ok(Self { craft: Spacecraft::new(hub, devices)?, fused: false })
    }

    /// The same, product and sum rounded once where the CPU does that: other bits, and faster on
    /// some CPUs.
    #[must_use]
    pub fn fused(self) -> Self {
        Self { fused: true, ..self }
    }

    /// The spacecraft, for everything that is asked of one state.
    #[must_use]
    pub fn spacecraft(&self) -> &Spacecraft<D> {
        &self.craft
    }

    /// All accelerations of each state, as [`Spacecraft::accelerations`]. `out` is cleared first.
    ///
    /// # Errors
    ///
    /// [`SolveError::Count`] where there are inputs for another number of states; a state that
    /// cannot be evaluated has its own error in `out`.
    pub fn accelerations<'a>(
        &self,
        states: &[State<D>],
        inputs: impl Into<BatchInputs<'a, D>>,
        out: &mut BatchAccelerations<D>,
    ) -> Result<(), SolveError<f64>>
    where
        D: 'a,
    {
        accelerations(self, states, inputs.into(), out)
    }

    /// Advances each state by so many steps, as [`Spacecraft::step`] does; a state that fails is
    /// left as it was before the step that failed. `out` is cleared first.
    ///
    /// # Errors
    ///
    /// As [`Self::accelerations`], and [`SolveError::NotFinite`] of a step that is not finite.
    pub fn run<'a>(
        &self,
        states: &mut [State<D>],
        inputs: impl Into<BatchInputs<'a, D>>,
        dt: f64,
        steps: usize,
        out: &mut Vec<Result<(), SolveError<f64>>>,
    ) -> Result<(), SolveError<f64>>
    where
        D: 'a,
    {
        run(self, states, inputs.into(), (dt, steps), out)
    }
}

impl<D: LanedSet> Crafts<D> for Batch<D> {
    const EACH: bool = false;

    #[inline(always)]
    fn is_fused(&self) -> bool {
        self.fused
    }

    fn count(&self) -> Option<usize> {
        None
    }

    #[inline(always)]
    fn at(&self, _: usize) -> Option<&Spacecraft<D>> {
        Some(&self.craft)
    }

    #[inline(always)]
    fn blocks(&self, _: usize) -> Option<&CraftBlocks<D>> {
        None
    }
}

/// All accelerations of each state, once the numbers of spacecraft, states and inputs agree.
pub(super) fn accelerations<D: LanedSet, C: Crafts<D>>(
    crafts: &C,
    states: &[State<D>],
    inputs: BatchInputs<'_, D>,
    out: &mut BatchAccelerations<D>,
) -> Result<(), SolveError<f64>> {
    fit(crafts, states, &inputs)?;
    out.clear();
    out.reserve(states.len());
    Arch::new().dispatch(Evaluation { crafts, states, inputs, out });
    Ok(())
}

/// Each state advanced by so many steps, once the numbers of spacecraft, states and inputs agree.
pub(super) fn run<D: LanedSet, C: Crafts<D>>(
    crafts: &C,
    states: &mut [State<D>],
    inputs: BatchInputs<'_, D>,
    (dt, steps): (f64, usize),
    out: &mut Vec<Result<(), SolveError<f64>>>,
) -> Result<(), SolveError<f64>> {
    fit(crafts, states, &inputs)?;
    if !dt.is_finite() {
        return Err(SolveError::NotFinite { what: Quantity::TimeStep, value: dt });
    }
    out.clear();
    out.reserve(states.len());
    Arch::new().dispatch(Runs { crafts, states, inputs, dt, steps, out });
    Ok(())
}

/// Whether there are as many states as spacecraft, and as many inputs as states.
fn fit<D: LanedSet, C: Crafts<D>>(
    crafts: &C,
    states: &[State<D>],
    inputs: &BatchInputs<'_, D>,
) -> Result<(), SolveError<f64>> {
    let found = states.len();
    match crafts.count() {
        Some(expected) if expected != found => Err(SolveError::Count { expected, found }),
        _ => inputs.fit(found),
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

/// Whether lanes support these inputs, and those are finite that the result may not show.
#[inline(always)]
fn lanes_support_inputs<D: LanedSet>(inputs: &Inputs<D>) -> bool {
    let [[a, b, c], [d, e, f]] = [components(&inputs.force), components(&inputs.torque_b)];
    inputs.hub == HubMode::Free
        && inputs.bodies.is_none()
        && inputs.gravity.uniform().is_some()
        && inputs.motors.values().fold(a + b + c + d + e + f, |sum, u| sum + u).is_finite()
}

/// A quaternion whose squared length is between this and its reciprocal is taken as it is.
pub(super) const NEAR_ONE: f64 = 1e-20;

/// The accelerations of a batch.
struct Evaluation<'a, 'o, D: LanedSet, C> {
    crafts: &'a C,
    states: &'a [State<D>],
    inputs: BatchInputs<'a, D>,
    out: &'o mut BatchAccelerations<D>,
}

impl<D: LanedSet, C: Crafts<D>> WithSimd for Evaluation<'_, '_, D, C> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        if self.crafts.is_fused() {
            self.evaluate(Lane::<S, true>::splat(simd, 0.0));
        } else {
            self.evaluate(Lane::<S, false>::splat(simd, 0.0));
        }
    }
}

impl<D: LanedSet, C: Crafts<D>> Evaluation<'_, '_, D, C> {
    #[inline(always)]
    fn evaluate<T: Number>(self, zero: T) {
        let crafts = self.crafts;
        let Some(first) = crafts.at(0) else { return };
        let mut group = Group::<D, T>::new(first, zero);
        let still = first.no_accelerations();
        for (index, states) in self.states.chunks(T::WIDTH).enumerate() {
            let start = index * T::WIDTH;
            let inputs = self.inputs.starting(start);
            group.gather(zero, (crafts, start), states, &inputs);
            let acting = group.acting(zero);
            let Some(laned) = entered(crafts, index, &mut group.slots, zero) else { return };
            let found = if C::EACH {
                evaluate::<D, T, true>(&laned, &mut group.slots, &acting)
            } else {
                evaluate::<D, T, false>(&laned, &mut group.slots, &acting)
            };
            each_slot::<D, _>(laned.devices, &mut group.slots, &mut Leave);
            let holds = zero.like(1.0).or(found.holds, zero).store();
            let r_b_n_ddot = map(found.r_b_n_ddot, Number::store);
            let omega_dot = map(found.omega_dot, Number::store);
            // Filled in place: what was just put together number by number is slow to move.
            let first = self.out.len();
            self.out.resize(first + states.len(), Ok(still.clone()));
            let places = self.out.iter_mut().skip(first);
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
                            *place = craft.accelerations(state, inputs);
                        }
                    }
                    (_, None) => {}
                }
            }
        }
    }
}

/// As many states as there are lanes.
pub(super) struct Group<D: LanedSet, T: Number> {
    pub(super) slots: SlotsOf<D, T>,
    /// The lanes that have what is asked.
    pub(super) laned: [bool; WIDEST],
    /// Whether what is given of the joints stands there already, the same for every state.
    given: bool,
    /// The hub's motion.
    pub(super) motion: Motion<T>,
    /// What acts on the hub, on its way in.
    forces: Forces<Block>,
}

impl<D: LanedSet, T: Number> Group<D, T> {
    pub(super) fn new(craft: &Spacecraft<D>, zero: T) -> Self {
        Self {
            slots: D::new_data(&craft.devices, &Slots(zero)),
            laned: [true; WIDEST],
            given: false,
            motion: Motion::filled(zero),
            forces: Forces::ZERO,
        }
    }

    /// Takes states in. Lanes beyond the last of them repeat it: they cost nothing and harm
    /// nothing.
    #[inline(always)]
    pub(super) fn gather<C: Crafts<D>>(
        &mut self,
        zero: T,
        (crafts, start): (&C, usize),
        states: &[State<D>],
        all: &BatchInputs<'_, D>,
    ) {
        let (Some(last), Some(end)) = (states.len().checked_sub(1), states.last()) else { return };
        let Some(first) = crafts.at(start) else { return };
        let mut lanes = [end; WIDEST];
        lanes.iter_mut().zip(states).for_each(|(lane, state)| *lane = state);
        self.motion = Motion::in_lanes(zero, lanes);
        let joints = lanes.map(|state| &state.devices);
        load_joints::<D, _>(&first.devices, &mut self.slots, zero, joints);
        for lane in 0..T::WIDTH {
            let index = lane.min(last);
            let (Some(state), Some(inputs)) = (states.get(index), all.at(index)) else { return };
            let Some(craft) = crafts.at(start + index) else { return };
            let mut laned = laned_state(state);
            if !self.given {
                let given = inputs.of_joints();
                laned &= lanes_support_inputs(inputs)
                    && put_given::<D, _>(
                        &craft.devices,
                        &mut self.slots,
                        lane,
                        &state.devices,
                        given,
                    );
                self.forces.put(lane, inputs);
            }
            self.laned[lane & (WIDEST - 1)] = laned;
        }
        if self.given {
            return;
        }
        each_slot::<D, _>(&first.devices, &mut self.slots, &mut Enter(zero));
        // A locked joint is looked at in each state.
        self.given = match all {
            BatchInputs::Same(inputs) => {
                !C::EACH
                    && self.laned == [true; WIDEST]
                    && inputs.modes.values().all(|mode| mode != Mode::Locked)
            }
            BatchInputs::Each(_) => false,
        };
    }

    /// What acts at the state that was taken in.
    #[inline(always)]
    fn acting(&self, zero: T) -> Acting<T> {
        self.acting_at(zero, self.motion.q, self.motion.omega)
    }

    /// What acts at another attitude and angular velocity.
    #[inline(always)]
    pub(super) fn acting_at(&self, zero: T, attitude: [T; 4], omega: [T; 3]) -> Acting<T> {
        let Forces { force, torque_b, field } = self.forces.map(|block| zero.load(&block));
        // No field is `0.0` in a single evaluation, never `-0.0`.
        let at_b = add(rotate(&bn(attitude), field), [zero; 3]);
        Acting { omega, force, torque_b, at_b }
    }
}
