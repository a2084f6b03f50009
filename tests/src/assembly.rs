//! The paper's own assembly: (16), (75), (80), (101) and (119), from the hand-checked pages.
//!
//! Every statement is one equation of `tests/derivation`, with its number in a comment, or `(step)`
//! where the paper gives none, in the form that the pages arrive at: positions by the expanded
//! (12)-(14), inertias by (35)-(73), the coefficients of (17), momenta by (30), (43), (58) and
//! (74), motor torques about the centres of mass of D and V. Of the forms that a page gives for one
//! quantity the last is taken; that they are equal is proved where the pages are. Nothing is
//! differentiated here: what the transport theorem does step by step in
//! [`newton_euler`](crate::newton_euler) a person did on the pages.
//!
//! With that the two share vectors, elimination and the layout of the system, and no equation.
//!
//! The left sides are evaluated for known accelerations, in which they are affine. So the system
//! needs no second notation: what is left of them without any rates, under one acceleration of 1,
//! is a column of the matrix; what is left without any accelerations changes sides.

mod inertias;
mod known;
mod motors;
mod positions;
mod rotation;
mod translation;

use core::ops::Range;

use nalgebra::Vector3;
use precess_dynamics::dgvscmg::Joints;
use precess_dynamics::{Accelerations, Hub, Scalar, State};

use crate::case::{Case, REGULAR, Set};
use crate::newton_euler::equations::System;
use crate::newton_euler::vector::{Tensor, Vector};
use crate::newton_euler::{elimination, from_list};
use inertias::Inertias;
use known::{Known, Motion};
use positions::Positions;

/// The accelerations by the paper's assembly; `None` where the matrix is singular.
#[must_use]
pub fn accelerations<const N: usize, T: Scalar>(
    case: &Case<N, T>,
) -> Option<Accelerations<Set<N, T>>> {
    let System { matrix, right } = system(case);
    Some(from_list(&elimination::solve(matrix, right)?))
}

/// The system in its accelerations: force (16), moment (75), then `u_z` (80), `u_y` (101) and `u_x`
/// (119) of each device.
#[must_use]
pub fn system<const N: usize, T: Scalar>(case: &Case<N, T>) -> System<T> {
    let (zero, one) = (T::from_f64(0.0), T::from_f64(1.0));
    let size = 6 + 3 * N;
    let still = at_rest(&case.state);
    let columns: Vec<Vec<T>> = (0..size)
        .map(|unknown| {
            let mut only_one = vec![zero; size];
            only_one[unknown] = one;
            left_sides(case, &still, &only_one, moved_by::<N>(unknown))
        })
        .collect();
    let matrix = (0..size).map(|row| columns.iter().map(|column| column[row]).collect()).collect();

    let known = left_sides(case, &case.state, &vec![zero; size], 0..N);
    let right = given_forces(case).into_iter().zip(known).map(|(right, left)| right - left);
    System { matrix, right: right.collect() }
}

/// The devices that one acceleration sets in motion from rest: the hub's all, a joint's its own.
fn moved_by<const N: usize>(unknown: usize) -> Range<usize> {
    match unknown.checked_sub(6) {
        None => 0..N,
        Some(joint) => joint / 3..joint / 3 + 1,
    }
}

/// The left sides of all equations for these accelerations; zero for devices not in `moved`.
fn left_sides<const N: usize, T: Scalar>(
    case: &Case<N, T>,
    state: &State<Set<N, T>>,
    accelerations: &[T],
    moved: Range<usize>,
) -> Vec<T> {
    let mut left = vec![T::from_f64(0.0); accelerations.len()];
    let accelerations: Accelerations<Set<N, T>> = from_list(accelerations);
    let motion = Motion {
        omega: Vector::from(&state.omega),
        omega_dot: Vector::from(&accelerations.omega_dot),
        r_b_n_ddot: Vector::from(&accelerations.r_b_n_ddot),
    };
    let device = |j: usize| {
        let (joints, ddot) = (&state.devices[j], &accelerations.devices[j]);
        Device::new(Known::new(&case.devices[j], joints, ddot, motion))
    };
    let devices: Vec<Device<T>> = moved.clone().map(device).collect();
    let body = Body::new(&case.hub);

    left[..3].copy_from_slice(&translation::force(&body, &motion, &devices).0);
    left[3..6].copy_from_slice(&rotation::torque_b(&body, &motion, &devices).0);
    for (j, device) in moved.zip(&devices) {
        let torques = [motors::u_o(device), motors::u_i(device), motors::u_w(device)];
        left[6 + 3 * j..9 + 3 * j].copy_from_slice(&torques);
    }
    left
}

/// The right sides: `F`, `L_B` and the motors' torques.
fn given_forces<const N: usize, T: Scalar>(case: &Case<N, T>) -> Vec<T> {
    let mut right = Vec::with_capacity(6 + 3 * N);
    right.extend(case.inputs.force.iter());
    right.extend(case.inputs.torque_b.iter());
    right.extend(case.inputs.motors.iter().flat_map(|motor| [motor.u_o, motor.u_i, motor.u_w]));
    right
}

/// The same pose without any rate.
fn at_rest<const N: usize, T: Scalar>(state: &State<Set<N, T>>) -> State<Set<N, T>> {
    let zero = T::from_f64(0.0);
    let devices = state.devices.map(|joints| Joints {
        gamma_o_dot: zero,
        gamma_i_dot: zero,
        spin: zero,
        ..joints
    });
    State { omega: Vector3::new(zero, zero, zero), devices, ..*state }
}

/// What the pages define for the hub: `m_b`, `r_bc_b` and `i_b_bc`, along B axes.
struct Body<T> {
    m_b: T,
    r_bc_b: Vector<T>,
    i_b_bc: Tensor<T>,
}

impl<T: Scalar> Body<T> {
    fn new(hub: &Hub<T>) -> Self {
        Self { m_b: hub.m_b, r_bc_b: Vector::from(&hub.r_bc_b), i_b_bc: Tensor::from(&hub.i_b_bc) }
    }
}

/// What the pages define for one device, ready for its equations.
struct Device<T> {
    known: Known<T>,
    positions: Positions<T>,
    inertias: Inertias<T>,
}

impl<T: Scalar> Device<T> {
    fn new(known: Known<T>) -> Self {
        let positions = Positions::new(&known);
        let inertias = Inertias::new(&known, &positions);
        Self { known, positions, inertias }
    }
}

impl<const N: usize, T: Scalar> Case<N, T> {
    /// The system of the paper's own assembly.
    #[must_use]
    pub fn assembly(&self) -> System<T> {
        system(self)
    }

    /// The accelerations by the paper's own assembly.
    ///
    /// # Panics
    ///
    /// If its matrix is singular: no spacecraft of these suites is.
    #[must_use]
    pub fn assembled(&self) -> Accelerations<Set<N, T>> {
        accelerations(self).expect(REGULAR)
    }
}

#[cfg(test)]
mod tests {
    use precess_dynamics::Scalar;

    use crate::double_double::DoubleDouble as Wide;
    use crate::random::{SEED, Sample};

    /// An identity in double-double: about a hundred operations of 1e-31 on entries that are
    /// themselves sums with some cancellation.
    const IDENTITY: f64 = 1e-28;

    /// Force, moment and motor torques come from three sets of pages; that each one's coefficients
    /// recur in the others is what none of them says.
    #[test]
    fn forces_moments_and_motors_share_one_symmetric_matrix() {
        for seed in SEED..SEED + 10 {
            let matrix = Sample::<2>::new(seed).case::<Wide>().assembly().matrix;
            for (i, row) in matrix.iter().enumerate() {
                for (k, entry) in row.iter().enumerate() {
                    let unit = (matrix[i][i] * matrix[k][k]).sqrt().to_f64();
                    let asymmetry = (*entry - matrix[k][i]).abs().to_f64();
                    assert!(asymmetry <= IDENTITY * unit, "[{i}][{k}] of seed {seed:#x}");
                }
            }
        }
    }
}
