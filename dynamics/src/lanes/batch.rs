//! [`Batch`]: many states of one spacecraft, in the lanes of the widest registers at hand.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use std::vec::Vec;

use pulp::{Arch, Simd, WithSimd};

use super::batch_inputs::BatchInputs;
use super::constants::{CraftBlocks, OwnLoads};
use super::crafts::{Crafts, entered};
use super::evaluate::evaluate;
use super::fallback;
use super::group::Group;
use super::lane::Lane;
use super::motion::at;
use super::number::{Number, WIDEST};
use super::run::Runs;
use super::slot::{LanedSet, Leave, each_slot, take_found};
use crate::equations::error::{Quantity, SolveError};
use crate::model::parameters::Hub;
use crate::numbers::vec3::{map, vector};
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
    own: OwnLoads,
    fused: bool,
}

impl<D: LanedSet> Batch<D> {
    /// Checks the parameters and computes everything that depends only on them.
    ///
    /// # Errors
    ///
    /// As [`Spacecraft::new`].
    pub fn new(hub: &Hub, devices: &D) -> Result<Self, ParameterError<f64>> {
        let craft = Spacecraft::new(hub, devices)?;
        Ok(Self { own: OwnLoads::of(&craft), craft, fused: false })
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

    #[inline(always)]
    fn own_loads(&self, _: usize) -> OwnLoads {
        self.own
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
            let Some(laned) = entered(crafts, index, &mut group.slots, zero) else { return };
            let (motion, mut holds) = (group.motion, zero.same(zero));
            let found = if C::EACH {
                let acting = group.acting::<true>(&laned, zero, &motion, &mut holds, false);
                evaluate::<D, T, true>(&laned, &mut group.slots, &acting)
            } else {
                let acting = group.acting::<false>(&laned, zero, &motion, &mut holds, false);
                evaluate::<D, T, false>(&laned, &mut group.slots, &acting)
            };
            each_slot::<D, _>(laned.devices, &mut group.slots, &mut Leave);
            let holds = zero.like(1.0).or(zero.both(found.holds, holds), zero).store();
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
                            *place = fallback::accelerations(craft, state, inputs);
                        }
                    }
                    (_, None) => {}
                }
            }
        }
    }
}
