//! The same numbers in another scalar: exact where that is the wider one.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::dgvscmg::{JointAccelerations, Joints, MotorTorques, PerJoint};
use precess_dynamics::{
    Accelerations, Dgvscmg, Gravity, Hub, HubMode, Inputs, Mode, Passive, Quaternion, Scalar,
    State, Wrench,
};

use super::{Case, Set};

/// A whole case.
pub(super) fn case<const N: usize, T: Scalar, U: Scalar>(case: &Case<N, T>) -> Case<N, U> {
    Case {
        hub: hub(&case.hub),
        devices: case.devices.map(|d| device(&d)),
        state: state(&case.state),
        inputs: inputs(&case.inputs),
    }
}

/// Accelerations in another scalar: exact where `U` is the wider one.
#[must_use]
pub fn converted<const N: usize, T: Scalar, U: Scalar>(
    accelerations: &Accelerations<Set<N, T>>,
) -> Accelerations<Set<N, U>> {
    Accelerations {
        r_b_n_ddot: vector(&accelerations.r_b_n_ddot),
        omega_dot: vector(&accelerations.omega_dot),
        devices: accelerations.devices.map(|joint| JointAccelerations {
            gamma_o_ddot: scalar(joint.gamma_o_ddot),
            gamma_i_ddot: scalar(joint.gamma_i_ddot),
            spin_dot: scalar(joint.spin_dot),
        }),
        modal: (),
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

fn per_joint<V, W>(joints: PerJoint<V>, of: impl Fn(V) -> W) -> PerJoint<W> {
    let PerJoint { outer_gimbal, inner_gimbal, wheel } = joints;
    PerJoint { outer_gimbal: of(outer_gimbal), inner_gimbal: of(inner_gimbal), wheel: of(wheel) }
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
        passive: per_joint(device.passive, passive),
        model: device.model,
    }
}

fn passive<T: Scalar, U: Scalar>(passive: Passive<T>) -> Passive<U> {
    Passive {
        stiffness: scalar(passive.stiffness),
        rest: scalar(passive.rest),
        viscous: scalar(passive.viscous),
        coulomb: scalar(passive.coulomb),
        coulomb_rate: scalar(passive.coulomb_rate),
    }
}

fn state<const N: usize, T: Scalar, U: Scalar>(state: &State<Set<N, T>>) -> State<Set<N, U>> {
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
        modal: (),
    }
}

fn inputs<const N: usize, T: Scalar, U: Scalar>(inputs: &Inputs<Set<N, T>>) -> Inputs<Set<N, U>> {
    Inputs {
        force: vector(&inputs.force),
        torque_b: vector(&inputs.torque_b),
        motors: inputs.motors.map(|motor| MotorTorques {
            u_o: scalar(motor.u_o),
            u_i: scalar(motor.u_i),
            u_w: scalar(motor.u_w),
        }),
        modes: inputs.modes.map(|device| per_joint(device, mode)),
        hub: match inputs.hub {
            HubMode::Free => HubMode::Free,
            HubMode::Fixed => HubMode::Fixed,
            HubMode::Prescribed { r_b_n_ddot, omega_dot } => HubMode::Prescribed {
                r_b_n_ddot: vector(&r_b_n_ddot),
                omega_dot: vector(&omega_dot),
            },
        },
        gravity: match inputs.gravity {
            Gravity::None => Gravity::None,
            Gravity::Uniform(g) => Gravity::Uniform(vector(&g)),
            Gravity::Central { mu } => Gravity::Central { mu: scalar(mu) },
        },
        bodies: inputs.bodies.map(|bodies| bodies.map(|device| per_joint(device, wrench))),
        modal: (),
    }
}

fn mode<T: Scalar, U: Scalar>(mode: Mode<T>) -> Mode<U> {
    match mode {
        Mode::Driven => Mode::Driven,
        Mode::Prescribed(acceleration) => Mode::Prescribed(scalar(acceleration)),
        Mode::Locked => Mode::Locked,
    }
}

fn wrench<T: Scalar, U: Scalar>(wrench: Wrench<T>) -> Wrench<U> {
    Wrench { force: vector(&wrench.force), moment: vector(&wrench.moment) }
}
