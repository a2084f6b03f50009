//! Runs of the Newton-Euler reference in double-double conserve energy less work and both momenta
//! to the order of the method.
//!
//! Accelerations, kinematics, energy and momenta are the reference's own; the fourth-order steps
//! are taken here on a list of numbers. Run with `--nocapture` to see the figures.

use nalgebra::Vector3;
use precess_dynamics::dgvscmg::Joints;
use precess_dynamics::{Quaternion, Real, Scalar, State};
use precess_tests::bounds::ORDER;
use precess_tests::case::{Case, Set};
use precess_tests::double_double::DoubleDouble as Wide;
use precess_tests::newton_euler::vector::Vector;
use precess_tests::random::Sample;

/// Duration of a run, s, and steps of the coarsest one: 0.03 rad a step of the fastest wheel.
const DURATION: f64 = 0.01;
const COARSEST: u32 = 200;

fn wide(x: f64) -> Wide {
    Wide::from_f64(x)
}

fn to_numbers<const N: usize>(state: &State<Set<N, Wide>>) -> Vec<Wide> {
    let Quaternion { q0, q1, q2, q3 } = state.attitude;
    let vectors = [state.r_b_n, state.r_b_n_dot, state.omega];
    let mut numbers: Vec<_> = vectors.iter().flatten().copied().collect();
    numbers.extend([q0, q1, q2, q3]);
    for j in &state.devices {
        numbers.extend([j.gamma_o, j.gamma_i, j.theta, j.gamma_o_dot, j.gamma_i_dot, j.spin]);
    }
    numbers
}

fn from_numbers<const N: usize>(numbers: &[Wide]) -> State<Set<N, Wide>> {
    let vector = |first: usize| Vector3::from_column_slice(&numbers[first..first + 3]);
    let [q0, q1, q2, q3] = core::array::from_fn(|k| numbers[9 + k]);
    State {
        r_b_n: vector(0),
        r_b_n_dot: vector(3),
        omega: vector(6),
        attitude: Quaternion { q0, q1, q2, q3 },
        devices: core::array::from_fn(|j| {
            let [gamma_o, gamma_i, theta, gamma_o_dot, gamma_i_dot, spin] =
                core::array::from_fn(|k| numbers[13 + 6 * j + k]);
            Joints { gamma_o, gamma_i, theta, gamma_o_dot, gamma_i_dot, spin }
        }),
        modal: (),
    }
}

/// Time derivative of the list.
fn slope<const N: usize>(case: &Case<N, Wide>, numbers: &[Wide]) -> Vec<Wide> {
    let case = Case { state: from_numbers(numbers), ..*case };
    let (a, state, half) = (case.reference(), &case.state, wide(0.5));
    let Quaternion { q0, q1, q2, q3 } = state.attitude;
    let omega = state.omega;
    let nb = case.snapshot().bn.transpose();
    let v_dot = nb * Vector::from(&a.r_b_n_ddot);
    let mut slope: Vec<_> = state.r_b_n_dot.iter().copied().collect();
    slope.extend(v_dot.0);
    slope.extend(a.omega_dot.iter());
    slope.extend([
        -half * (q1 * omega.x + q2 * omega.y + q3 * omega.z),
        half * (q0 * omega.x + q2 * omega.z - q3 * omega.y),
        half * (q0 * omega.y + q3 * omega.x - q1 * omega.z),
        half * (q0 * omega.z + q1 * omega.y - q2 * omega.x),
    ]);
    for (j, a) in state.devices.iter().zip(&a.devices) {
        slope.extend([j.gamma_o_dot, j.gamma_i_dot, j.spin]);
        slope.extend([a.gamma_o_ddot, a.gamma_i_ddot, a.spin_dot]);
    }
    slope
}

/// One classical Runge-Kutta step.
fn step<const N: usize>(case: &Case<N, Wide>, numbers: &[Wide], dt: Wide) -> Vec<Wide> {
    let moved = |time: Wide, slope: &[Wide]| -> Vec<Wide> {
        numbers.iter().zip(slope).map(|(x, k)| *x + time * *k).collect()
    };
    let middle = dt * wide(0.5);
    let k_1 = slope(case, numbers);
    let k_2 = slope(case, &moved(middle, &k_1));
    let k_3 = slope(case, &moved(middle, &k_2));
    let k_4 = slope(case, &moved(dt, &k_3));
    let sum: Vec<_> =
        (0..numbers.len()).map(|i| k_1[i] + wide(2.0) * (k_2[i] + k_3[i]) + k_4[i]).collect();
    moved(dt * wide(6.0).recip(), &sum)
}

/// Energy less the motors' work, linear and angular momentum, each in its own unit.
fn drift<const N: usize>(case: &Case<N, Wide>, steps: u32) -> [f64; 3] {
    let dt = wide(DURATION) * wide(f64::from(steps)).recip();
    let start = case.snapshot();
    let mut numbers = to_numbers(&case.state);
    for _ in 0..steps {
        numbers = step(case, &numbers, dt);
    }
    let end = Case { state: from_numbers(&numbers), ..*case };
    let joints = end.state.devices.iter().zip(&case.state.devices).zip(&case.inputs.motors);
    let work = joints.fold(wide(0.0), |work, ((now, start), motor)| {
        work + motor.u_o * (now.gamma_o - start.gamma_o)
            + motor.u_i * (now.gamma_i - start.gamma_i)
            + motor.u_w * (now.theta - start.theta)
    });
    let (before, after) = (start.momenta(), end.snapshot().momenta());
    let energy = (end.snapshot().energy() - start.energy() - work).abs();
    [
        (energy * start.energy().recip()).to_f64(),
        ((after.linear - before.linear).norm() * before.linear_magnitudes.recip()).to_f64(),
        ((after.angular - before.angular).norm() * before.angular_magnitudes.recip()).to_f64(),
    ]
}

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn drift_of_the_reference_falls_sixteenfold() {
    for seed in 0..2 {
        let mut case = Sample::<2>::new(seed).case::<Wide>();
        case.inputs.force = Vector3::from_element(wide(0.0));
        case.inputs.torque_b = Vector3::from_element(wide(0.0));
        let (coarse, fine) = (drift(&case, COARSEST), drift(&case, 2 * COARSEST));
        for ((coarse, fine), what) in
            coarse.into_iter().zip(fine).zip(["energy less work", "linear", "angular momentum"])
        {
            let ratio = coarse / fine;
            println!("seed {seed}, {what}: {coarse:.2e} -> {fine:.2e}, {ratio:.2}-fold");
            assert!(ORDER.contains(&ratio), "seed {seed}, {what}: {coarse:e} to {fine:e}, {ratio}");
        }
    }
}
