//! Many states in lanes: of one spacecraft, or of as many spacecraft, or on several threads. Putting
//! the states into lanes and taking the results out counts.

use std::hint::black_box;

use precess_dynamics::lanes::{Batch, BatchAccelerations, LanedSet, ParameterBatch};
use precess_dynamics::{Hub, Inputs, SolveError, Spacecraft, State};
use precess_tests::stored::Stored;
use serde_json::Value;

use super::one::{NUDGE, flat};
use super::{Rejected, Service};

/// By how much the body rate of a state exceeds that of the one before, of itself.
const APART: f64 = 1e-3;
/// By how much the mass of a spacecraft's hub exceeds that of the one before, of itself.
const HEAVIER: f64 = 1e-4;

/// A batch of either sort.
pub(super) enum Crafts<D: LanedSet> {
    /// Many states of one spacecraft.
    Same(Batch<D>),
    /// Each state's own spacecraft; the first is that of the file.
    Own(ParameterBatch<D>),
}

impl<D: LanedSet> Crafts<D> {
    /// One spacecraft.
    pub(super) fn same(hub: &Hub, devices: &D) -> Result<Self, Rejected> {
        Ok(Self::Same(Batch::new(hub, devices)?))
    }

    /// The same on several threads.
    pub(super) fn on_threads(hub: &Hub, devices: &D) -> Result<Self, Rejected> {
        Ok(Self::Same(Batch::new(hub, devices)?.on_threads()))
    }

    /// So many spacecraft whose hubs have different masses.
    pub(super) fn own(hub: &Hub, devices: &D, states: u32) -> Result<Self, Rejected> {
        let craft = |k| {
            let m_b = hub.m_b * (1.0 + HEAVIER * f64::from(k));
            Spacecraft::new(&Hub { m_b, ..*hub }, devices)
        };
        let crafts: Result<Vec<_>, _> = (0..states).map(craft).collect();
        Ok(Self::Own(ParameterBatch::new(crafts?)))
    }

    /// The spacecraft of the file.
    pub(super) fn first(&self) -> Result<&Spacecraft<D>, Rejected> {
        match self {
            Self::Same(batch) => Ok(batch.spacecraft()),
            Self::Own(batch) => Ok(batch.spacecraft().first().ok_or("no spacecraft")?),
        }
    }

    fn accelerations(
        &self,
        states: &[State<D>],
        inputs: &Inputs<D>,
        found: &mut BatchAccelerations<D>,
    ) -> Result<(), SolveError<f64>> {
        match self {
            Self::Same(batch) => batch.accelerations(states, inputs, found),
            Self::Own(batch) => batch.accelerations(states, inputs, found),
        }
    }

    /// So many steps of every state.
    pub(super) fn run(
        &self,
        states: &mut [State<D>],
        inputs: &Inputs<D>,
        (dt, steps): (f64, usize),
    ) -> Result<(), Rejected> {
        let mut found = Vec::with_capacity(states.len());
        match self {
            Self::Same(batch) => batch.run(states, inputs, dt, steps, &mut found)?,
            Self::Own(batch) => batch.run(states, inputs, dt, steps, &mut found)?,
        }
        for found in &found {
            found.as_ref().map_err(ToString::to_string)?;
        }
        Ok(())
    }
}

/// States that differ in their body rates; the first is the one passed.
pub(super) fn apart<D: LanedSet>(mut state: State<D>, states: u32) -> Vec<State<D>> {
    let next = |_| {
        let this = state.clone();
        state.omega *= 1.0 + APART;
        this
    };
    (0..states).map(next).collect()
}

/// Their accelerations.
pub(crate) struct Many<D: LanedSet> {
    crafts: Crafts<D>,
    states: Vec<State<D>>,
    inputs: Inputs<D>,
    /// How many states, as in `states`.
    count: u32,
}

impl<D: LanedSet> Many<D> {
    pub(super) fn open(stored: &Stored, crafts: Crafts<D>, count: u32) -> Result<Self, Rejected> {
        let state = stored.motion(State::at_rest_for(crafts.first()?));
        let inputs = stored.forces(Inputs::none_for(crafts.first()?));
        Ok(Self { crafts, states: apart(state, count), inputs, count })
    }
}

impl<D: LanedSet> Service for Many<D> {
    fn check(&mut self) -> Result<Value, Rejected> {
        let mut found = Vec::new();
        self.crafts.accelerations(&self.states, &self.inputs, &mut found)?;
        Ok(flat(&found.into_iter().next().ok_or("no state")??))
    }

    fn run(&mut self, calls: u32) -> Result<(), Rejected> {
        let Self { crafts, states, inputs, .. } = self;
        let mut found = Vec::with_capacity(states.len());
        for _ in 0..calls {
            crafts.accelerations(black_box(states), inputs, &mut found)?;
            for (state, found) in states.iter_mut().zip(&found) {
                let found = found.as_ref().map_err(ToString::to_string)?;
                state.omega += found.omega_dot * NUDGE;
            }
        }
        Ok(())
    }

    fn units(&self) -> u32 {
        self.count
    }
}
