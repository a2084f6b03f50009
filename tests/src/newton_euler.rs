//! The Newton-Euler reference: each body by itself, with nothing optimised.
//!
//! The paper's laws, sections 3.1 to 3.3: force (6), (8), moment (75), motor torques about the
//! centres of mass of D and V, (78)-(83), (99)-(103), (117)-(119), over kinematics that follow from
//! positions and angular velocities only. None of the paper's expanded forms is used
//! (expanded positions, coefficients of (17), inertias about B): those are
//! [`assembly`](crate::assembly). It yields the full system of `6 + 3 N` equations, whose matrix is
//! *not* assumed symmetric, and solves it by Gaussian elimination. Generic over the scalar: in
//! [`DoubleDouble`] it is the reference of the solver. It shares with the solver the parameter and
//! state types and nothing else.
//!
//! Everything is expressed in B. Quantities of the state that are expressed in N (the
//! velocity of B) are rotated by a `[BN]` of its own.
//!
//! [`DoubleDouble`]: crate::double_double::DoubleDouble

pub mod affine;
pub mod bodies;
pub mod elimination;
pub mod equations;
pub mod totals;
pub mod vector;

use nalgebra::Vector3;
use precess_dynamics::dgvscmg::{JointAccelerations, MotorTorques};
use precess_dynamics::{Accelerations, Hub, Inputs, Quaternion, Scalar, State};

use crate::case::{Case, REGULAR, Set};
use affine::UNKNOWNS;
use bodies::{Body, Device, hub_body};
use equations::System;
use vector::{Tensor, Vector};

/// A spacecraft in one state, under known forces: position and rates of every body.
#[derive(Clone, Debug)]
pub struct Snapshot<T> {
    /// The hub.
    pub hub: Body<T>,
    /// The devices.
    pub devices: Vec<Device<T>>,
    /// `[BN]`.
    pub bn: Tensor<T>,
    /// Position of B from the inertial origin, along N axes, m.
    pub r_b_n: Vector<T>,
    /// Inertial velocity of B, along B axes, m/s.
    pub v_b: Vector<T>,
    /// `omega_{B/N}` along B axes, rad/s.
    pub omega: Vector<T>,
    /// Force through B, along B axes, N.
    pub force: Vector<T>,
    /// Torque about B, along B axes, N m.
    pub torque_b: Vector<T>,
    /// Motor torques with the rates of their joints, N m and rad/s: outer, inner, wheel.
    pub motors: Vec<[(T, T); 3]>,
}

impl<T: Scalar> Snapshot<T> {
    /// Computes the position of every body.
    #[must_use]
    pub fn new<const N: usize>(
        hub: &Hub<T>,
        devices: &Set<N, T>,
        state: &State<Set<N, T>>,
        inputs: &Inputs<Set<N, T>>,
    ) -> Self {
        let bn = direction_cosines(&state.attitude);
        let placed = devices.iter().zip(&state.devices).map(|(d, joints)| Device::new(d, joints));
        let motors = inputs.motors.iter().zip(&state.devices).map(|(motor, joints)| {
            let MotorTorques { u_o, u_i, u_w } = *motor;
            [(u_o, joints.gamma_o_dot), (u_i, joints.gamma_i_dot), (u_w, joints.spin)]
        });
        Self {
            hub: hub_body(hub),
            devices: placed.collect(),
            bn,
            r_b_n: Vector::from(&state.r_b_n),
            v_b: bn * Vector::from(&state.r_b_n_dot),
            omega: Vector::from(&state.omega),
            force: Vector::from(&inputs.force),
            torque_b: Vector::from(&inputs.torque_b),
            motors: motors.collect(),
        }
    }

    /// The hub, then three bodies a device.
    pub fn bodies(&self) -> impl Iterator<Item = &Body<T>> {
        core::iter::once(&self.hub).chain(self.devices.iter().flat_map(|device| &device.bodies))
    }
}

/// The accelerations by these equations; `None` where the matrix is singular.
#[must_use]
pub fn accelerations<const N: usize, T: Scalar>(
    hub: &Hub<T>,
    devices: &Set<N, T>,
    state: &State<Set<N, T>>,
    inputs: &Inputs<Set<N, T>>,
) -> Option<Accelerations<Set<N, T>>> {
    let system = System::new(&Snapshot::new(hub, devices, state, inputs));
    Some(from_list(&elimination::solve(system.matrix, system.right)?))
}

/// The unknowns in the order of the system: six of the hub, then three a device.
#[must_use]
pub fn to_list<const N: usize, T: Scalar>(accelerations: &Accelerations<Set<N, T>>) -> Vec<T> {
    let mut list = Vec::with_capacity(6 + 3 * N);
    list.extend(accelerations.r_b_n_ddot.iter());
    list.extend(accelerations.omega_dot.iter());
    for joint in &accelerations.devices {
        list.extend([joint.gamma_o_ddot, joint.gamma_i_ddot, joint.spin_dot]);
    }
    list
}

/// The inverse of [`to_list`].
pub(crate) fn from_list<const N: usize, T: Scalar>(list: &[T]) -> Accelerations<Set<N, T>> {
    let joints = core::array::from_fn(|j| JointAccelerations {
        gamma_o_ddot: list[6 + 3 * j],
        gamma_i_ddot: list[7 + 3 * j],
        spin_dot: list[8 + 3 * j],
    });
    Accelerations {
        r_b_n_ddot: Vector3::new(list[0], list[1], list[2]),
        omega_dot: Vector3::new(list[3], list[4], list[5]),
        devices: joints,
        modal: (),
    }
}

/// The nine unknowns that move the bodies of device `index` (any index serves the hub).
fn unknowns_of<T: Scalar>(list: &[T], index: usize) -> [T; UNKNOWNS] {
    let zero = T::from_f64(0.0);
    let joint = |k: usize| list.get(6 + 3 * index + k).copied().unwrap_or(zero);
    [list[0], list[1], list[2], list[3], list[4], list[5], joint(0), joint(1), joint(2)]
}

/// `[BN] = (q0^2 - q.q) 1 + 2 q q^T - 2 q0 tilde(q)`, of the attitude brought to unit norm.
fn direction_cosines<T: Scalar>(attitude: &Quaternion<T>) -> Tensor<T> {
    let q = Vector([attitude.q1, attitude.q2, attitude.q3]);
    let (q0, qq) = (attitude.q0, vector::dot(q, q));
    let (two, share) = (T::from_f64(2.0), (q0 * q0 + qq).recip());
    let turning = vector::tilde(q);
    Tensor(core::array::from_fn(|i| {
        core::array::from_fn(|k| {
            let diagonal = if i == k { q0 * q0 - qq } else { T::from_f64(0.0) };
            (diagonal + two * (q.0[i] * q.0[k] - q0 * turning.0[i][k])) * share
        })
    }))
}

impl<const N: usize, T: Scalar> Case<N, T> {
    /// All bodies placed, for the reference.
    #[must_use]
    pub fn snapshot(&self) -> Snapshot<T> {
        Snapshot::new(&self.hub, &self.devices, &self.state, &self.inputs)
    }

    /// The reference's system of equations.
    #[must_use]
    pub fn system(&self) -> System<T> {
        System::new(&self.snapshot())
    }

    /// The reference's accelerations.
    ///
    /// # Panics
    ///
    /// If the reference's matrix is singular: no spacecraft of these suites is.
    #[must_use]
    pub fn reference(&self) -> Accelerations<Set<N, T>> {
        accelerations(&self.hub, &self.devices, &self.state, &self.inputs).expect(REGULAR)
    }
}
