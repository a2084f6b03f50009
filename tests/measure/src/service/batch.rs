//! Many states in lanes: of one spacecraft, or of as many spacecraft, or on several threads. Putting
//! the states into lanes and taking the results out counts.

use std::hint::black_box;

use precess_dynamics::lanes::{Batch, LanedSet};
use precess_dynamics::{Hub, Inputs, Spacecraft, State};
use precess_tests::stored::Stored;
use serde_json::Value;

use super::single_state::{NUDGE, flat};
use super::{Rejected, Service};

/// By how much the body rate of a state exceeds that of the one before, of itself.
const APART: f64 = 1e-3;
/// By how much the mass of a spacecraft's hub exceeds that of the one before, of itself.
const HEAVIER: f64 = 1e-4;

/// Many states of one spacecraft.
pub(super) fn same<D: LanedSet>(hub: &Hub, devices: &D) -> Result<Batch<D>, Rejected> {
    Ok(Batch::new(hub, devices)?)
}

/// The same on several threads.
pub(super) fn on_threads<D: LanedSet>(hub: &Hub, devices: &D) -> Result<Batch<D>, Rejected> {
    Ok(Batch::new(hub, devices)?.on_threads())
}

/// So many spacecraft whose hubs have different masses; the first is that of the file.
pub(super) fn own<D: LanedSet>(hub: &Hub, devices: &D, states: u32) -> Result<Batch<D>, Rejected> {
    let craft = |k| {
        let m_b = hub.m_b * (1.0 + HEAVIER * f64::from(k));
        Spacecraft::new(&Hub { m_b, ..*hub }, devices)
    };
    let crafts: Result<Vec<_>, _> = (0..states).map(craft).collect();
    Ok(Batch::from_spacecraft(crafts?))
}

/// The spacecraft of the file.
pub(super) fn first<D: LanedSet>(batch: &Batch<D>) -> Result<&Spacecraft<D>, Rejected> {
    Ok(batch.spacecraft().first().ok_or("no spacecraft")?)
}

/// So many steps of every state.
pub(super) fn run<D: LanedSet>(
    batch: &Batch<D>,
    states: &mut [State<D>],
    inputs: &Inputs<D>,
    (dt, steps): (f64, usize),
) -> Result<(), Rejected> {
    let mut found = Vec::with_capacity(states.len());
    batch.run(states, inputs, dt, steps, &mut found)?;
    for found in &found {
        found.as_ref().map_err(ToString::to_string)?;
    }
    Ok(())
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
pub(crate) struct ManyStates<D: LanedSet> {
    batch: Batch<D>,
    states: Vec<State<D>>,
    inputs: Inputs<D>,
    /// How many states, as in `states`.
    count: u32,
}

impl<D: LanedSet> ManyStates<D> {
    pub(super) fn open(stored: &Stored, batch: Batch<D>, count: u32) -> Result<Self, Rejected> {
        let state = stored.motion(State::at_rest_for(first(&batch)?));
        let inputs = stored.forces(Inputs::none_for(first(&batch)?));
        Ok(Self { batch, states: apart(state, count), inputs, count })
    }
}

impl<D: LanedSet> Service for ManyStates<D> {
    fn check(&mut self) -> Result<Value, Rejected> {
        let mut found = Vec::new();
        self.batch.accelerations(&self.states, &self.inputs, &mut found)?;
        Ok(flat(&found.into_iter().next().ok_or("no state")??))
    }

    fn run(&mut self, calls: u32) -> Result<(), Rejected> {
        let Self { batch, states, inputs, .. } = self;
        let mut found = Vec::with_capacity(states.len());
        for _ in 0..calls {
            batch.accelerations(black_box(states), &*inputs, &mut found)?;
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
