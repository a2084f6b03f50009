//! One spacecraft in one state under given forces, in any scalar.

use core::fmt::Display;

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::{
    Accelerations, Dgvscmg, Hub, JointAccelerations, Joints, MotorTorques, Quaternion, Scalar,
    Spacecraft, State, Torques,
};

use crate::newton_euler::equations::System;
use crate::newton_euler::{self, Snapshot};
use crate::{assembly, spatial};

const REGULAR: &str = "the mass matrix of a spacecraft with massive bodies is regular";

/// Parameters, state and forces, as solver and reference take them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Case<const N: usize, T = f64> {
    /// The hub.
    pub hub: Hub<T>,
    /// The devices.
    pub devices: [Dgvscmg<T>; N],
    /// The state.
    pub state: State<N, T>,
    /// Force, torque and motor torques.
    pub torques: Torques<N, T>,
}

impl<const N: usize, T: Scalar> Case<N, T> {
    /// The same numbers in another scalar: exact where `U` is the wider one.
    #[must_use]
    pub fn converted<U: Scalar>(&self) -> Case<N, U> {
        Case {
            hub: hub(&self.hub),
            devices: self.devices.map(|d| device(&d)),
            state: state(&self.state),
            torques: torques(&self.torques),
        }
    }

    /// The spacecraft, prepared.
    ///
    /// # Panics
    ///
    /// If the solver refuses the parameters, saying whose they are: a seed or a scenario.
    #[must_use]
    pub fn spacecraft(&self, whose: impl Display) -> Spacecraft<N, T> {
        Spacecraft::new(&self.hub, &self.devices).unwrap_or_else(|error| panic!("{whose}: {error}"))
    }

    /// The solver's accelerations.
    ///
    /// # Panics
    ///
    /// If the solver gives an error, saying whose case it is: a seed or a scenario.
    #[must_use]
    pub fn solved(&self, whose: impl Display) -> Accelerations<N, T> {
        self.spacecraft(&whose)
            .accelerations(&self.state, &self.torques)
            .unwrap_or_else(|error| panic!("{whose}: {error}"))
    }

    /// All bodies placed, for the reference.
    #[must_use]
    pub fn snapshot(&self) -> Snapshot<T> {
        Snapshot::new(&self.hub, &self.devices, &self.state, &self.torques)
    }

    /// The reference's system of equations.
    #[must_use]
    pub fn system(&self) -> System<T> {
        System::new(&self.snapshot())
    }

    /// The system of the paper's own assembly.
    #[must_use]
    pub fn assembly(&self) -> System<T> {
        assembly::system(self)
    }

    /// The accelerations by the paper's own assembly.
    ///
    /// # Panics
    ///
    /// If its matrix is singular: no spacecraft of these suites is.
    #[must_use]
    pub fn assembled(&self) -> Accelerations<N, T> {
        assembly::accelerations(self).expect(REGULAR)
    }

    /// The accelerations by recursion over articulated bodies.
    ///
    /// # Panics
    ///
    /// If the hub's articulated inertia is singular: no spacecraft of these suites is.
    #[must_use]
    pub fn recursive(&self) -> Accelerations<N, T> {
        spatial::accelerations(self).expect(REGULAR)
    }

    /// The reference's accelerations.
    ///
    /// # Panics
    ///
    /// If the reference's matrix is singular: no spacecraft of these suites is.
    #[must_use]
    pub fn reference(&self) -> Accelerations<N, T> {
        newton_euler::accelerations(&self.hub, &self.devices, &self.state, &self.torques)
            .expect(REGULAR)
    }
}

fn scalar<T: Scalar, U: Scalar>(x: T) -> U {
    // The two parts of a wide scalar, one after the other: exact for every pair of types.
    let leading = x.to_f64();
    U::from_f64(leading) + U::from_f64((x - T::from_f64(leading)).to_f64())
}

fn vector<T: Scalar, U: Scalar>(v: &Vector3<T>) -> Vector3<U> {
    v.map(scalar)
}

fn matrix<T: Scalar, U: Scalar>(m: &Matrix3<T>) -> Matrix3<U> {
    m.map(scalar)
}

fn hub<T: Scalar, U: Scalar>(hub: &Hub<T>) -> Hub<U> {
    Hub { m_b: scalar(hub.m_b), r_bc_b: vector(&hub.r_bc_b), i_b_bc: matrix(&hub.i_b_bc) }
}

fn device<T: Scalar, U: Scalar>(device: &Dgvscmg<T>) -> Dgvscmg<U> {
    Dgvscmg {
        mount: matrix(&device.mount),
        r_go_b: vector(&device.r_go_b),
        m_go: scalar(device.m_go),
        r_goc_go: vector(&device.r_goc_go),
        i_go_goc: matrix(&device.i_go_goc),
        l_o: vector(&device.l_o),
        m_gi: scalar(device.m_gi),
        r_gic_gi: vector(&device.r_gic_gi),
        i_gi_gic: matrix(&device.i_gi_gic),
        l_i: vector(&device.l_i),
        m_w: scalar(device.m_w),
        d: scalar(device.d),
        i_w_wc: matrix(&device.i_w_wc),
    }
}

fn state<const N: usize, T: Scalar, U: Scalar>(state: &State<N, T>) -> State<N, U> {
    let Quaternion { q0, q1, q2, q3 } = state.attitude;
    State {
        r_b_n: vector(&state.r_b_n),
        r_b_n_dot: vector(&state.r_b_n_dot),
        attitude: Quaternion { q0: scalar(q0), q1: scalar(q1), q2: scalar(q2), q3: scalar(q3) },
        omega: vector(&state.omega),
        devices: state.devices.map(|joints| Joints {
            gamma_o: scalar(joints.gamma_o),
            gamma_i: scalar(joints.gamma_i),
            theta: scalar(joints.theta),
            gamma_o_dot: scalar(joints.gamma_o_dot),
            gamma_i_dot: scalar(joints.gamma_i_dot),
            spin: scalar(joints.spin),
        }),
    }
}

fn torques<const N: usize, T: Scalar, U: Scalar>(torques: &Torques<N, T>) -> Torques<N, U> {
    Torques {
        force: vector(&torques.force),
        torque_b: vector(&torques.torque_b),
        motors: torques.motors.map(|motor| MotorTorques {
            u_o: scalar(motor.u_o),
            u_i: scalar(motor.u_i),
            u_w: scalar(motor.u_w),
        }),
    }
}

/// Accelerations in another scalar: exact where `U` is the wider one.
#[must_use]
pub fn converted<const N: usize, T: Scalar, U: Scalar>(
    accelerations: &Accelerations<N, T>,
) -> Accelerations<N, U> {
    Accelerations {
        r_b_n_ddot: vector(&accelerations.r_b_n_ddot),
        omega_dot: vector(&accelerations.omega_dot),
        devices: accelerations.devices.map(|joint| JointAccelerations {
            gamma_o_ddot: scalar(joint.gamma_o_ddot),
            gamma_i_ddot: scalar(joint.gamma_i_ddot),
            spin_dot: scalar(joint.spin_dot),
        }),
    }
}
