//! A recursive route, written from scratch: the articulated-body algorithm of a floating base.
//!
//! R. Featherstone, *Rigid Body Dynamics Algorithms*, Springer 2008: spatial algebra of chapter 2,
//! the algorithm of chapter 7, floating bases of chapter 9. Nothing of the paper is in it but what
//! a device is made of: no centre of mass of the system, no derivative seen from B, no moment about
//! a centre of mass, and no system of `6 + 3 N` equations. Every body has its own coordinates;
//! velocities are seen from the inertial frame that moves along with B at the moment, which changes
//! no acceleration.
//!
//! With the solver it shares the types of parameters, state and result; with the other routes of
//! these suites the Gaussian elimination, here of the hub's six equations.

mod algebra;
mod articulated_body;
mod links;

use nalgebra::Vector3;
use precess_dynamics::dgvscmg::JointAccelerations;
use precess_dynamics::{Accelerations, Scalar};

use crate::case::{Case, REGULAR, Set};
use crate::newton_euler::elimination;
use algebra::{Matrix, Spatial, force_cross};
use articulated_body::Articulated;

/// The accelerations by recursion; `None` where the hub's articulated inertia is singular.
#[must_use]
pub fn accelerations<const N: usize, T: Scalar>(
    case: &Case<N, T>,
) -> Option<Accelerations<Set<N, T>>> {
    let hub = links::rigid_inertia(case.hub.m_b, &case.hub.r_bc_b, &case.hub.i_b_bc);
    let v = Spatial::new(components(&case.state.omega), [T::from_f64(0.0); 3]);
    let applied = Spatial::new(components(&case.inputs.torque_b), components(&case.inputs.force));

    // Outwards for velocities, inwards for inertias and bias forces.
    let chains: [_; N] = core::array::from_fn(|j| {
        let device = &case.devices[j];
        let links = links::chain(device, &case.state.devices[j], &case.inputs.motors[j]);
        Articulated::chain(links, v)
    });
    let mut inertia = hub;
    let mut bias = force_cross(v, hub * v) - applied;
    for chain in &chains {
        inertia = inertia + chain.seen.inertia;
        bias = bias + chain.seen.bias;
    }

    // The base is free: no joint force acts on its articulated inertia. Then the outward pass.
    let a = solve(inertia, -bias)?;
    let devices = chains.map(|chain| {
        let [gamma_o_ddot, gamma_i_ddot, spin_dot] = chain.accelerate(a);
        JointAccelerations { gamma_o_ddot, gamma_i_ddot, spin_dot }
    });

    // A spatial acceleration is that of the flow through a point, not of the point; for B, which
    // is at rest in that frame, the two are the same.
    let [omega_dot, r_b_n_ddot] = a.halves();
    Some(Accelerations {
        r_b_n_ddot: Vector3::from(r_b_n_ddot),
        omega_dot: Vector3::from(omega_dot),
        devices,
        modal: (),
    })
}

fn solve<T: Scalar>(inertia: Matrix<T>, force: Spatial<T>) -> Option<Spatial<T>> {
    let rows = inertia.0.iter().map(|row| row.to_vec()).collect();
    let solution = elimination::solve(rows, force.0.to_vec())?;
    Some(Spatial(core::array::from_fn(|i| solution[i])))
}

fn components<T: Scalar>(v: &Vector3<T>) -> [T; 3] {
    [v.x, v.y, v.z]
}

impl<const N: usize, T: Scalar> Case<N, T> {
    /// The accelerations by recursion over articulated bodies.
    ///
    /// # Panics
    ///
    /// If the hub's articulated inertia is singular: no spacecraft of these suites is.
    #[must_use]
    pub fn recursive(&self) -> Accelerations<Set<N, T>> {
        accelerations(self).expect(REGULAR)
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Matrix3, Vector3};
    use precess_dynamics::{Hub, Inputs, State};

    use crate::case::Case;

    /// Rounding of some hundred operations, those of the elimination, on numbers of about one.
    const ROUNDING: f64 = 1e-14;

    /// A symmetric top in free motion about a fixed centre of mass: Euler's
    /// `omega_x' = (2 - 3) / 2 omega_y omega_z`, and B, at `-arm`, is accelerated towards it.
    #[test]
    fn a_lone_hub_precesses_as_euler_says() {
        let arm = Vector3::new(0.5, 0.0, 0.0);
        let omega = Vector3::new(0.0, 1.0, 2.0);
        let case: Case<0> = Case {
            hub: Hub {
                m_b: 4.0,
                r_bc_b: arm,
                i_b_bc: Matrix3::from_diagonal(&Vector3::new(2.0, 2.0, 3.0)),
            },
            devices: [],
            state: State { omega, ..State::at_rest() },
            inputs: Inputs::none(),
        };
        let found = super::accelerations(&case).expect("a hub with mass and inertia");
        let omega_dot = Vector3::new(-1.0, 0.0, 0.0);
        let r_b_n_ddot = -(omega_dot.cross(&arm) + omega.cross(&omega.cross(&arm)));
        assert!((found.omega_dot - omega_dot).norm() <= ROUNDING, "{found:?}");
        assert!((found.r_b_n_ddot - r_b_n_ddot).norm() <= ROUNDING, "{found:?}");
    }
}
