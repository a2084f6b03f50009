//! [`Layout`]: the state of a spacecraft as one flat vector, with two running integrals at its end.
//!
//! Order: r (3), v (3), quaternion (4), omega (3), for each device its coordinates, then its rates,
//! the modal coordinates of a structure, then their rates, then work and throughput. The quaternion is integrated as it is and normalised wherever it is
//! read, so its norm is no degree of freedom of the motion.
//!
//! A wheel turns a hundred times in ten seconds. An angle of 600 rad is kept to 1e-13 rad only, and
//! rounding it in every step changes the sum of the momenta of wheel and hub; so the angle of a
//! joint is reduced by whole turns, which are counted, once it has completed one. Not that of a
//! joint with a spring, which counts them itself, nor that of a platform, whose springs may couple
//! its joints, nor the coordinate of a sliding joint.

use std::f64::consts::TAU;
use std::ops::Range;

use nalgebra::Vector3;
use precess_dynamics::kind::{Each, JointInfo};
use precess_dynamics::{Attitude, JointStates, ModalState, Quaternion};

use crate::record::columns::{Quantity, state_quantities};
use crate::scenario::Scenario;
use precess_craft::{CraftAccelerations, CraftState};

/// Numbers of the hub.
const HUB: usize = 13;

/// Lengths and speeds of a spacecraft's own motion are millimetres to decimetres, its rates degrees
/// per second, modal coordinates are displacements times the root of some hundred kilograms: "zero to within the tolerance" is counted in hundredths of SI units for them.
const SMALL: f64 = 1e-2;

/// Where the numbers of a joint are.
#[derive(Clone, Debug)]
pub(crate) struct JointPlace {
    /// The device or platform, from 0 through the set.
    pub(crate) device: usize,
    /// The name of its coordinate: `cmg1.gamma_o`.
    pub(crate) name: String,
    /// Names and axis, as the kind has them.
    pub(crate) info: &'static JointInfo,
    /// Index of the coordinate in the flat vector.
    coordinate: usize,
    /// Index of the rate.
    rate: usize,
    /// Whether whole turns are taken off the coordinate.
    wraps: bool,
}

/// The places of all numbers of a spacecraft.
#[derive(Clone, Debug)]
pub(crate) struct Layout {
    /// The joints in the order of the set.
    pub(crate) joints: Vec<JointPlace>,
    /// How many modes the structure has.
    pub(crate) modes: usize,
    /// Index of the first modal coordinate.
    modal: usize,
    work: usize,
}

impl Layout {
    pub(crate) fn new(scenario: &Scenario) -> Self {
        let mut joints = Vec::new();
        let mut next = HUB;
        for (index, (name, member)) in scenario.members().enumerate() {
            let (infos, passive) = (member.joints(), member.passive());
            // The springs of a platform may couple its turns.
            let is_device = member.device().is_some();
            for (info, passive) in infos.iter().zip(&passive) {
                joints.push(JointPlace {
                    device: index,
                    name: format!("{name}.{}", info.coordinate),
                    info,
                    coordinate: next + info.index,
                    rate: next + infos.len() + info.index,
                    wraps: is_device && !info.slides && passive.stiffness == 0.0,
                });
            }
            next += 2 * infos.len();
        }
        let modes = scenario.mode_count();
        Self { joints, modes, modal: next, work: next + 2 * modes }
    }

    /// How many numbers the state has, without the integrals.
    pub(crate) fn state_length(&self) -> usize {
        self.work
    }

    /// The place of a quantity of the state in the flat vector; none of any other.
    pub(crate) fn place(&self, quantity: Quantity) -> Option<usize> {
        match quantity {
            Quantity::Position(axis) => Some(axis),
            Quantity::Velocity(axis) => Some(3 + axis),
            Quantity::Quaternion(index) => Some(6 + index),
            Quantity::Omega(axis) => Some(10 + axis),
            Quantity::Coordinate(joint) => self.joints.get(joint).map(|place| place.coordinate),
            Quantity::Rate(joint) => self.joints.get(joint).map(|place| place.rate),
            Quantity::ModalCoordinate(mode) => Some(self.modal + mode),
            Quantity::ModalRate(mode) => Some(self.modal + self.modes + mode),
            _ => None,
        }
    }

    /// The quantities of the state, with name and unit.
    pub(crate) fn state_quantities(&self) -> Vec<(String, Quantity, &'static str)> {
        let joints = self.joints.iter().map(|place| {
            let device = place.name.split('.').next().unwrap_or_default();
            (device, place.info)
        });
        state_quantities(joints, self.modes)
    }

    /// The name of the number at a place of the flat vector, and the unit of its rate.
    pub(crate) fn named(&self, place: usize) -> (String, String) {
        let columns = self.state_quantities();
        let found =
            columns.into_iter().find(|(_, quantity, _)| self.place(*quantity) == Some(place));
        found.map_or_else(
            || ("the work".to_owned(), "W".to_owned()),
            |(name, _, unit)| {
                (name, if unit == "1" { "1/s".to_owned() } else { format!("{unit} per s") })
            },
        )
    }

    /// How many numbers the flat vector has.
    pub(crate) fn length(&self) -> usize {
        self.work + 2
    }

    /// Writes a state and both integrals to a flat vector.
    pub(crate) fn pack(&self, state: &CraftState, integrals: [f64; 2]) -> Vec<f64> {
        let ModalState { eta, eta_dot } = &state.modal;
        let mut y = vec![0.0; self.length()];
        y[..3].copy_from_slice(state.r_b_n.as_slice());
        y[3..6].copy_from_slice(state.r_b_n_dot.as_slice());
        let Quaternion { q0, q1, q2, q3 } = state.attitude;
        y[6..10].copy_from_slice(&[q0, q1, q2, q3]);
        y[10..HUB].copy_from_slice(state.omega.as_slice());
        for (place, [coordinate, rate]) in self.joints.iter().zip(state.devices.states()) {
            (y[place.coordinate], y[place.rate]) = (coordinate, rate);
        }
        let (coordinates, rates) = self.modal();
        y[coordinates].copy_from_slice(eta);
        y[rates].copy_from_slice(eta_dot);
        y[self.work..].copy_from_slice(&integrals);
        y
    }

    /// The places of the modal coordinates and of their rates.
    fn modal(&self) -> (Range<usize>, Range<usize>) {
        let middle = self.modal + self.modes;
        (self.modal..middle, middle..self.work)
    }

    /// Reads the state, its quaternion normalised.
    pub(crate) fn unpack(&self, y: &[f64], state: &mut CraftState) {
        let (coordinates, rates) = self.modal();
        state.modal.eta.copy_from_slice(&y[coordinates]);
        state.modal.eta_dot.copy_from_slice(&y[rates]);
        let vector = |i: usize| Vector3::new(y[i], y[i + 1], y[i + 2]);
        state.r_b_n = vector(0);
        state.r_b_n_dot = vector(3);
        state.attitude = Self::attitude(y).normalised();
        state.omega = vector(10);
        let states = state.devices.states_mut();
        for (place, [coordinate, rate]) in self.joints.iter().zip(states) {
            (*coordinate, *rate) = (y[place.coordinate], y[place.rate]);
        }
    }

    /// The quaternion as it is integrated.
    pub(crate) fn attitude(y: &[f64]) -> Quaternion {
        Quaternion { q0: y[6], q1: y[7], q2: y[8], q3: y[9] }
    }

    /// Work and throughput, J.
    pub(crate) fn integrals(&self, y: &[f64]) -> [f64; 2] {
        [y[self.work], y[self.work + 1]]
    }

    /// Writes time derivatives: those of the hub, of each joint's rate and of the modal coordinates'
    /// rates. `state` is that of the flat vector `y`.
    pub(crate) fn pack_rates(
        &self,
        y: &[f64],
        state: &CraftState,
        found: &CraftAccelerations,
        dydt: &mut [f64],
    ) {
        let bn = state.attitude.dcm();
        // The solver's inertial acceleration is expressed in B; positions are expressed in N.
        let acceleration = bn.tr_mul(&found.r_b_n_ddot);
        let quaternion_rate = Self::attitude(y).rate(&state.omega);
        dydt[..3].copy_from_slice(state.r_b_n_dot.as_slice());
        dydt[3..6].copy_from_slice(acceleration.as_slice());
        dydt[6..10].copy_from_slice(quaternion_rate.as_slice());
        dydt[10..HUB].copy_from_slice(found.omega_dot.as_slice());
        for (place, acceleration) in self.joints.iter().zip(found.devices.values()) {
            dydt[place.coordinate] = y[place.rate];
            dydt[place.rate] = acceleration;
        }
        let (coordinates, rates) = self.modal();
        dydt[coordinates].copy_from_slice(&y[rates.clone()]);
        dydt[rates].copy_from_slice(&found.modal.eta_ddot);
    }

    /// Writes the time derivatives of both integrals.
    pub(crate) fn pack_powers(&self, powers: [f64; 2], dydt: &mut [f64]) {
        dydt[self.work..].copy_from_slice(&powers);
    }

    /// Whether a joint has completed a turn since its angle was last reduced.
    pub(crate) fn once_round(&self, y: &[f64]) -> bool {
        self.joints.iter().any(|place| place.wraps && y[place.coordinate].abs() > TAU)
    }

    /// Brings the angles into -pi to pi, and counts the whole turns taken off each joint.
    pub(crate) fn wrap(&self, y: &mut [f64], turns: &mut [f64]) {
        for (place, turns) in self.joints.iter().zip(turns).filter(|(place, _)| place.wraps) {
            let whole = (y[place.coordinate] / TAU).round();
            y[place.coordinate] -= whole * TAU;
            *turns += whole;
        }
    }

    /// Coordinate, turns counted, and rate of a joint.
    pub(crate) fn joint(joint: usize, state: &CraftState, turns: &[f64]) -> [f64; 2] {
        let [coordinate, rate] = state.devices.states().nth(joint).unwrap_or([f64::NAN; 2]);
        [coordinate + turns[joint] * TAU, rate]
    }

    /// The rate of a joint in a flat vector.
    pub(crate) fn rate(&self, joint: usize, y: &[f64]) -> f64 {
        self.joints.get(joint).map_or(f64::NAN, |place| y[place.rate])
    }

    /// The absolute tolerance of each number.
    ///
    /// The throughput has none: its rate has a kink wherever a joint's rate changes sign, at which a
    /// controlled step would be halved until it hits the kink; it is a unit, of which two digits
    /// suffice.
    pub(crate) fn absolute_tolerance(&self, tolerance: f64) -> Vec<f64> {
        let small = tolerance * SMALL;
        let mut y = vec![small; self.length()];
        y[6..10].fill(tolerance);
        for place in self.joints.iter().filter(|place| !place.info.slides) {
            y[place.coordinate] = tolerance;
        }
        y[self.work..].copy_from_slice(&[tolerance, f64::INFINITY]);
        y
    }
}
