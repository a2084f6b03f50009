//! One state, whole steps of the classical Runge-Kutta method.

use std::hint::black_box;

use precess_dynamics::{Devices, Each as _, Inputs, JointStates as _, Spacecraft, State};
use serde_json::{Value, json};

use super::listed::Listed;
use super::{Rejected, Service};

/// Step of the integrator while it is timed, s: small, so that no turn runs into a state unlike the
/// first.
pub(super) const STEP: f64 = 1e-7;
/// Steps over which motions are compared.
pub(super) const CHECKED: u32 = 100;

/// A spacecraft in a state that moves on.
pub(crate) struct Step<D: Devices> {
    craft: Spacecraft<D>,
    state: State<D>,
    inputs: Inputs<D>,
    /// Step of what is compared, s.
    dt: f64,
}

impl<D: Devices<Scalar = f64>> Step<D> {
    pub(super) fn open(listed: &Listed, craft: Spacecraft<D>) -> Self {
        let (state, inputs) = (listed.state(&craft), listed.inputs(&craft));
        Self { craft, state, inputs, dt: listed.step }
    }
}

impl<D: Devices<Scalar = f64>> Service for Step<D> {
    fn check(&mut self) -> Result<Value, Rejected> {
        let mut state = self.state.clone();
        for _ in 0..CHECKED {
            state = self.craft.step(&state, &self.inputs, self.dt)?;
        }
        Ok(motions(&[(&self.state, &state)], self.dt))
    }

    fn run(&mut self, calls: u32) -> Result<(), Rejected> {
        let mut state = self.state.clone();
        for _ in 0..calls {
            state = self.craft.step(black_box(&state), &self.inputs, STEP)?;
        }
        black_box(state);
        Ok(())
    }

    fn units(&self) -> u32 {
        1
    }
}

/// What moved of each pair of states in [`CHECKED`] steps: B from where its first velocity would have
/// taken it, the change of its velocity, the vector part of the quaternion (from axes along N),
/// angular velocity, and the joints.
pub(super) fn motions<D: Devices<Scalar = f64>>(
    pairs: &[(&State<D>, &State<D>)],
    dt: f64,
) -> Value {
    let time = dt * f64::from(CHECKED);
    let mut blocks: [Vec<f64>; 6] = Default::default();
    for (start, end) in pairs {
        let [displacement, velocity, attitude, omega, coordinates, rates] = &mut blocks;
        displacement.extend(&(end.r_b_n - start.r_b_n - start.r_b_n_dot * time));
        velocity.extend(&(end.r_b_n_dot - start.r_b_n_dot));
        let q = end.attitude;
        attitude.extend([q.q1, q.q2, q.q3].map(|x| x * q.q0.signum()));
        omega.extend(&end.omega);
        for [coordinate, rate] in end.devices.states() {
            coordinates.push(coordinate);
            rates.push(rate);
        }
    }
    let [displacement, velocity, attitude, omega, coordinates, rates] = blocks;
    json!({ "motion": {
        "displacement": displacement, "velocity": velocity, "attitude": attitude, "omega": omega,
        "coordinates": coordinates, "rates": rates,
    }})
}

/// Puts values into places, as long as there are both.
pub(super) fn fill<'a, V: 'a>(to: impl Iterator<Item = &'a mut V>, from: impl Iterator<Item = V>) {
    for (to, from) in to.zip(from) {
        *to = from;
    }
}

impl Listed {
    /// The state of the file, B at rest at N's origin with its axes along N's.
    pub(super) fn state<D: Devices<Scalar = f64>>(&self, craft: &Spacecraft<D>) -> State<D> {
        let mut state = State { omega: self.omega.into(), ..State::at_rest_for(craft) };
        for (joint, from) in state.devices.states_mut().zip(self.joints()) {
            let [coordinate, rate] = joint;
            [*coordinate, *rate] = from;
        }
        state
    }

    /// Its forces and torques.
    pub(super) fn inputs<D: Devices<Scalar = f64>>(&self, craft: &Spacecraft<D>) -> Inputs<D> {
        let (force, torque_b) = (self.force.into(), self.torque_b.into());
        let mut inputs = Inputs { force, torque_b, ..Inputs::none_for(craft) };
        fill(inputs.motors.values_mut(), self.motors());
        inputs
    }
}
