//! Five gyros whose gimbals are locked, at coordinates that -0.0 is among.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::{Hub, Inputs, JointStates, Mode, Scalar, Sgcmg, State};

/// Five gyros, which fill more than one register of lanes: each gimbal is locked, each wheel turns.
pub(crate) type Set<T = f64> = [Sgcmg<T>; 5];

/// Coordinates of the locked gimbals, rad.
const LOCKED: [f64; 5] = [-0.0, 0.0, 0.25, -1.5, -0.0];

/// Length of a step, s, and steps of a run.
pub(crate) const DT: f64 = 1e-3;
pub(crate) const STEPS: usize = 40;

pub(crate) fn hub<T: Scalar>() -> Hub<T> {
    let number = T::from_f64;
    let i_b_bc = (Matrix3::identity() * 60.0).map(number);
    Hub { m_b: number(60.0), r_bc_b: Vector3::zeros().map(number), i_b_bc }
}

pub(crate) fn devices<T: Scalar>() -> Set<T> {
    let disc = Matrix3::from_diagonal(&Vector3::new(0.02, 0.01, 0.01)).map(T::from_f64);
    [Sgcmg { d: T::from_f64(1e-4), ..Sgcmg::bare_wheel(T::from_f64(3.0), disc) }; 5]
}

pub(crate) fn state<T: Scalar>() -> State<Set<T>> {
    let mut state: State<Set<T>> = State::at_rest();
    state.omega = Vector3::new(0.1, -0.2, 0.05).map(T::from_f64);
    for (joints, gamma) in state.devices.iter_mut().zip(LOCKED) {
        (joints.gamma, joints.spin) = (T::from_f64(gamma), T::from_f64(300.0));
    }
    state
}

pub(crate) fn inputs<T: Scalar>() -> Inputs<Set<T>> {
    let mut inputs: Inputs<Set<T>> = Inputs::none();
    for (modes, motors) in inputs.modes.iter_mut().zip(&mut inputs.motors) {
        (modes.gimbal, motors.u_w) = (Mode::Locked, T::from_f64(0.1));
    }
    inputs
}

/// Compares the gimbals, the first joint of every two, by their bits.
#[track_caller]
pub(crate) fn kept<T: Scalar>(path: &str, joints: &impl JointStates<T>) {
    let gimbals: Vec<u64> = joints.states().step_by(2).map(|[q, _]| q.to_f64().to_bits()).collect();
    assert_eq!(gimbals, LOCKED.map(f64::to_bits), "{path}");
}
