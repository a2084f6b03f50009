//! The state as the integrator sees it: one flat vector, with two running integrals at its end.
//!
//! Order: r (3), v (3), quaternion (4), omega (3), six numbers for each device (angles, then
//! rates), work, throughput. The quaternion is integrated as it is and normalised wherever it is
//! read, so its norm is no degree of freedom of the motion.

use std::f64::consts::TAU;

use nalgebra::Vector3;
use precess_dynamics::dgvscmg::Joints;
use precess_dynamics::{Attitude, Inputs, Quaternion, SolveError, Spacecraft, State};

use crate::scenario::Set;

const HUB: usize = 13;
const DEVICE: usize = 6;

/// Lengths and speeds of a spacecraft's own motion are millimetres to decimetres, its rates degrees
/// per second: "zero to within the tolerance" is counted in hundredths of SI units for them.
const SMALL: f64 = 1e-2;

/// The flat state of `N` devices.
pub(crate) struct Packed<const N: usize>(Vec<f64>);

impl<const N: usize> Packed<N> {
    const LENGTH: usize = HUB + DEVICE * N + 2;
    const WORK: usize = HUB + DEVICE * N;
    const THROUGHPUT: usize = Self::WORK + 1;

    /// A state with both integrals at zero.
    pub(crate) fn new(state: &State<Set<N>>) -> Self {
        let mut y = Vec::with_capacity(Self::LENGTH);
        y.extend(&state.r_b_n);
        y.extend(&state.r_b_n_dot);
        let Quaternion { q0, q1, q2, q3 } = state.attitude;
        y.extend([q0, q1, q2, q3]);
        y.extend(&state.omega);
        for j in &state.devices {
            y.extend([j.gamma_o, j.gamma_i, j.theta, j.gamma_o_dot, j.gamma_i_dot, j.spin]);
        }
        y.extend([0.0, 0.0]);
        Self(y)
    }

    pub(crate) fn from_slice(y: &[f64]) -> Self {
        Self(y.to_vec())
    }

    pub(crate) fn into_vec(self) -> Vec<f64> {
        self.0
    }

    pub(crate) fn as_slice(&self) -> &[f64] {
        &self.0
    }

    /// The state, its quaternion of unit norm.
    pub(crate) fn state(&self) -> State<Set<N>> {
        let mut state = self.raw();
        state.attitude = state.attitude.normalised();
        state
    }

    /// Work done since the start, J.
    pub(crate) fn work(&self) -> f64 {
        self.0[Self::WORK]
    }

    /// Integral of sum |u * rate| since the start, J.
    pub(crate) fn throughput(&self) -> f64 {
        self.0[Self::THROUGHPUT]
    }

    /// Whether a joint has gone once round since its angle was last wrapped.
    pub(crate) fn once_round(&self) -> bool {
        self.raw()
            .devices
            .iter()
            .any(|j| [j.gamma_o, j.gamma_i, j.theta].iter().any(|angle| angle.abs() > TAU))
    }

    /// Brings every joint angle into -pi to pi, and counts the whole turns taken off.
    pub(crate) fn wrap(&mut self, turns: &mut Turns<N>) {
        for (n, turns) in turns.0.iter_mut().enumerate() {
            for (k, count) in turns.iter_mut().enumerate() {
                let angle = &mut self.0[HUB + DEVICE * n + k];
                let whole = (*angle / TAU).round();
                *angle -= whole * TAU;
                *count += whole;
            }
        }
    }

    /// Time derivatives of everything packed.
    pub(crate) fn rates(
        &self,
        spacecraft: &Spacecraft<Set<N>>,
        inputs: &Inputs<Set<N>>,
    ) -> Result<Self, SolveError> {
        let state = self.state();
        let acceleration = spacecraft.accelerations(&state, inputs)?;
        let bn = state.attitude.dcm();
        let mut y = Vec::with_capacity(Self::LENGTH);
        y.extend(&state.r_b_n_dot);
        // The solver's inertial acceleration is expressed in B; positions are expressed in N.
        y.extend(&(bn.transpose() * acceleration.r_b_n_ddot));
        y.extend(&self.raw().attitude.rate(&state.omega));
        y.extend(&acceleration.omega_dot);
        // dW/dt = F . v_B + L_B . omega + sum(u * rate)
        let mut power = inputs.force.dot(&(bn * state.r_b_n_dot));
        power += inputs.torque_b.dot(&state.omega);
        let mut throughput = 0.0;
        for ((j, a), u) in state.devices.iter().zip(&acceleration.devices).zip(&inputs.motors) {
            y.extend([j.gamma_o_dot, j.gamma_i_dot, j.spin]);
            y.extend([a.gamma_o_ddot, a.gamma_i_ddot, a.spin_dot]);
            for motor in [u.u_o * j.gamma_o_dot, u.u_i * j.gamma_i_dot, u.u_w * j.spin] {
                power += motor;
                throughput += motor.abs();
            }
        }
        y.extend([power, throughput]);
        Ok(Self(y))
    }

    fn raw(&self) -> State<Set<N>> {
        let y = &self.0;
        let vector = |i: usize| Vector3::new(y[i], y[i + 1], y[i + 2]);
        State {
            r_b_n: vector(0),
            r_b_n_dot: vector(3),
            attitude: Quaternion { q0: y[6], q1: y[7], q2: y[8], q3: y[9] },
            omega: vector(10),
            devices: core::array::from_fn(|n| {
                let j = &y[HUB + DEVICE * n..];
                Joints {
                    gamma_o: j[0],
                    gamma_i: j[1],
                    theta: j[2],
                    gamma_o_dot: j[3],
                    gamma_i_dot: j[4],
                    spin: j[5],
                }
            }),
        }
    }
}

/// Whole turns taken off the joint angles: `gamma_o`, `gamma_i`, `theta` of each device.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Turns<const N: usize>([[f64; 3]; N]);

impl<const N: usize> Default for Turns<N> {
    fn default() -> Self {
        Self([[0.0; 3]; N])
    }
}

impl<const N: usize> Turns<N> {
    /// The state with its joint angles counted on through every turn.
    pub(crate) fn unwrapped(&self, state: &State<Set<N>>) -> State<Set<N>> {
        let mut state = *state;
        for (j, [gamma_o, gamma_i, theta]) in state.devices.iter_mut().zip(self.0) {
            j.gamma_o += gamma_o * TAU;
            j.gamma_i += gamma_i * TAU;
            j.theta += theta * TAU;
        }
        state
    }
}

/// The absolute tolerance of each packed number.
///
/// The throughput has none: its rate has a kink wherever a joint's rate changes sign, at which a
/// controlled step would be halved until it hits the kink; it is a unit, and two digits of it do.
pub(crate) fn absolute_tolerance<const N: usize>(tolerance: f64) -> Vec<f64> {
    let small = tolerance * SMALL;
    let mut y = vec![small; 6];
    y.extend([tolerance; 4]);
    y.extend([small; 3]);
    for _ in 0..N {
        y.extend([tolerance, tolerance, tolerance, small, small, small]);
    }
    y.extend([tolerance, f64::INFINITY]);
    y
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::table1::{Drive, Imbalance, Variant};

    #[test]
    fn a_packed_state_comes_back_the_same() {
        let mut state =
            Variant { imbalance: Imbalance::Printed, drive: Drive::Free }.scenario().state;
        state.r_b_n = Vector3::new(1.0, 2.0, 3.0);
        state.devices[0].gamma_i = 0.25;
        assert_eq!(Packed::new(&state).state(), state);
    }

    #[test]
    fn turns_taken_off_are_turns_counted() {
        let mut state =
            Variant { imbalance: Imbalance::Printed, drive: Drive::Free }.scenario().state;
        state.devices[0].theta = 3.0 * TAU + 0.5;
        state.devices[0].gamma_o = -6.0;
        let mut packed = Packed::new(&state);
        assert!(packed.once_round());
        let mut turns = Turns::default();
        packed.wrap(&mut turns);
        assert!(!packed.once_round());
        assert_eq!(turns, Turns([[-1.0, 0.0, 3.0]]));
        let back = turns.unwrapped(&packed.state());
        // One rounding of an angle of 20 rad.
        assert!((back.devices[0].theta - state.devices[0].theta).abs() <= 4e-15);
    }

    #[test]
    fn every_packed_number_has_a_tolerance() {
        assert_eq!(absolute_tolerance::<3>(1e-13).len(), Packed::<3>::LENGTH);
    }
}
