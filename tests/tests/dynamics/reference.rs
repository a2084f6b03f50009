//! The Newton-Euler reference against finite differences of positions and against equations derived
//! from the kinetic energy only (Boltzmann and Hamel).

use nalgebra::Vector3;
use precess_dynamics::dgvscmg::JointAccelerations;
use precess_dynamics::{Accelerations, Quaternion, Real, Scalar};
use precess_tests::case::{Case, Set};
use precess_tests::cases;
use precess_tests::double_double::DoubleDouble as Wide;
use precess_tests::newton_euler::Snapshot;
use precess_tests::newton_euler::vector::{Tensor, Vector, cross, tilde};
use precess_tests::random::{Sample, Visitor, visit};

/// Spacecraft tried in each of the suites below.
const SPACECRAFT: u64 = 36;

/// Exact identities, in double-double: about a hundred operations of 1e-31 on entries that are
/// themselves sums with some cancellation.
const IDENTITY: f64 = 1e-28;

/// Central differences in double-double with the step below: truncation `(628 h)^2 = 4e-20` for the
/// fastest wheel, rounding `100 m * 1e-32 / h = 3e-18` for a position far from the origin.
const DIFFERENCE: f64 = 1e-17;

/// Step of the central differences, s or rad.
const STEP: f64 = 3e-13;

fn wide(x: f64) -> Wide {
    Wide::from_f64(x)
}

/// The case moved along its own motion by `time`, to second order in the angles.
///
/// The attitude is unchanged where it is the identity and only body components matter; it is moved
/// to first order by `time * omega` otherwise, which is all a first derivative sees.
fn moved<const N: usize>(
    case: &Case<N, Wide>,
    accelerations: &Accelerations<Set<N, Wide>>,
    time: f64,
) -> Case<N, Wide> {
    let (t, half) = (wide(time), wide(time) * wide(0.5));
    let mut later = *case;
    for axis in 0..3 {
        later.state.omega[axis] = case.state.omega[axis] + t * accelerations.omega_dot[axis];
        later.state.r_b_n[axis] = case.state.r_b_n[axis] + t * case.state.r_b_n_dot[axis];
    }
    let Quaternion { q0, q1, q2, q3 } = case.state.attitude;
    let omega = case.state.omega;
    later.state.attitude = Quaternion {
        q0: q0 - half * (q1 * omega.x + q2 * omega.y + q3 * omega.z),
        q1: q1 + half * (q0 * omega.x + q2 * omega.z - q3 * omega.y),
        q2: q2 + half * (q0 * omega.y + q3 * omega.x - q1 * omega.z),
        q3: q3 + half * (q0 * omega.z + q1 * omega.y - q2 * omega.x),
    };
    for (joints, a) in later.state.devices.iter_mut().zip(&accelerations.devices) {
        joints.gamma_o = joints.gamma_o + t * (joints.gamma_o_dot + half * a.gamma_o_ddot);
        joints.gamma_i = joints.gamma_i + t * (joints.gamma_i_dot + half * a.gamma_i_ddot);
        joints.theta = joints.theta + t * (joints.spin + half * a.spin_dot);
        joints.gamma_o_dot = joints.gamma_o_dot + t * a.gamma_o_ddot;
        joints.gamma_i_dot = joints.gamma_i_dot + t * a.gamma_i_ddot;
        joints.spin = joints.spin + t * a.spin_dot;
    }
    later
}

/// `(after - before) / (2 STEP)`.
fn slope(after: Wide, before: Wide) -> Wide {
    (after - before) * wide(2.0 * STEP).recip()
}

fn slopes(after: Vector<Wide>, before: Vector<Wide>) -> Vector<Wide> {
    Vector(core::array::from_fn(|i| slope(after.0[i], before.0[i])))
}

#[track_caller]
fn assert_small(error: f64, unit: f64, bound: f64, what: &str, seed: u64, n: usize) {
    assert!(
        error <= bound * unit,
        "{what}: {error:e} in units of {unit:e} is above {bound:e} (seed {seed:#x}, N = {n})"
    );
}

#[test]
fn velocities_are_the_derivatives_of_positions() {
    struct Check;
    impl Visitor for Check {
        fn visit<const N: usize>(&mut self, sample: &Sample<N>) {
            let case = sample.case::<Wide>();
            let still = Accelerations {
                r_b_n_ddot: Vector3::from_element(wide(0.0)),
                omega_dot: Vector3::from_element(wide(0.0)),
                devices: [JointAccelerations {
                    gamma_o_ddot: wide(0.0),
                    gamma_i_ddot: wide(0.0),
                    spin_dot: wide(0.0),
                }; N],
                modal: (),
            };
            let now = case.snapshot();
            let (before, after) =
                (moved(&case, &still, -STEP).snapshot(), moved(&case, &still, STEP).snapshot());
            let inertial = |s: &Snapshot<Wide>, r| s.r_b_n + s.bn.transpose() * r;
            let axes = |s: &Snapshot<Wide>, frame: Tensor<Wide>| s.bn.transpose() * frame;
            let bodies = now.bodies().zip(before.bodies().zip(after.bodies()));
            for (body, (earlier, later)) in bodies {
                let difference =
                    slopes(inertial(&after, later.centre.r), inertial(&before, earlier.centre.r));
                let v = now.bn.transpose() * (now.v_b + body.centre.dot(now.omega));
                let error = (v - difference).norm().to_f64();
                assert_small(error, v.norm().to_f64().max(1.0), DIFFERENCE, "v", sample.seed, N);

                // d[NF]/dt = tilde(omega_{F/N}) [NF], omega along N axes.
                let omega = now.bn.transpose() * body.omega_n(now.omega);
                let turning = tilde(omega) * axes(&now, body.frame.axes);
                for k in 0..3 {
                    let difference = slopes(
                        axes(&after, later.frame.axes).column(k),
                        axes(&before, earlier.frame.axes).column(k),
                    );
                    let error = (turning.column(k) - difference).norm().to_f64();
                    let unit = omega.norm().to_f64().max(1.0);
                    assert_small(error, unit, DIFFERENCE, "axes", sample.seed, N);
                }
            }
        }
    }
    visit(cases(SPACECRAFT), &mut Check);
}

/// The rates on which the energy depends, along B axes: `v_B`, `omega`, then the joints'.
fn rates<const N: usize>(case: &Case<N, Wide>) -> Vec<Wide> {
    let mut list: Vec<Wide> = case.snapshot().v_b.0.to_vec();
    list.extend(case.state.omega.iter());
    list.extend(case.state.devices.iter().flat_map(|j| [j.gamma_o_dot, j.gamma_i_dot, j.spin]));
    list
}

/// The kinetic energy as a function of those rates, in the case's pose with B axes along N axes.
fn energy<const N: usize>(case: &Case<N, Wide>, rates: &[Wide]) -> Wide {
    let mut case = *case;
    case.state.attitude = Quaternion { q0: wide(1.0), q1: wide(0.0), q2: wide(0.0), q3: wide(0.0) };
    case.state.r_b_n_dot = Vector3::new(rates[0], rates[1], rates[2]);
    case.state.omega = Vector3::new(rates[3], rates[4], rates[5]);
    for (joints, rate) in case.state.devices.iter_mut().zip(rates[6..].chunks(3)) {
        (joints.gamma_o_dot, joints.gamma_i_dot, joints.spin) = (rate[0], rate[1], rate[2]);
    }
    case.snapshot().energy()
}

/// Derivatives of the energy by the rates: exact, since it is quadratic in them.
fn momenta<const N: usize>(case: &Case<N, Wide>, rates: &[Wide]) -> Vec<Wide> {
    let here = energy(case, rates);
    (0..rates.len())
        .map(|i| {
            let mut only_one = vec![wide(0.0); rates.len()];
            only_one[i] = wide(1.0);
            let mut shifted = rates.to_vec();
            shifted[i] = shifted[i] + wide(1.0);
            energy(case, &shifted) - here - energy(case, &only_one)
        })
        .collect()
}

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn mass_matrix_is_symmetric_and_that_of_the_kinetic_energy() {
    struct Check;
    impl Visitor for Check {
        fn visit<const N: usize>(&mut self, sample: &Sample<N>) {
            let case = sample.case::<Wide>();
            let matrix = case.system().matrix;
            let size = 6 + 3 * N;
            for i in 0..size {
                let mut only_one = vec![wide(0.0); size];
                only_one[i] = wide(1.0);
                let row = momenta(&case, &only_one);
                for k in 0..size {
                    let unit = (matrix[i][i] * matrix[k][k]).sqrt().to_f64();
                    let asymmetry = (matrix[i][k] - matrix[k][i]).abs().to_f64();
                    assert_small(asymmetry, unit, IDENTITY, "symmetry", sample.seed, N);
                    // A difference of energies: it keeps the digits of the larger of the two.
                    let unit = matrix[i][i].max(matrix[k][k]).to_f64();
                    let difference = (matrix[i][k] - row[k]).abs().to_f64();
                    assert_small(difference, unit, IDENTITY, "energy", sample.seed, N);
                }
            }
        }
    }
    visit(cases(SPACECRAFT), &mut Check);
}

/// Boltzmann and Hamel: with `p` the derivatives of the energy by the rates along B axes,
/// `dp_v/dt + omega x p_v = F`, `dp_omega/dt + omega x p_omega + v x p_v = L_B`, and for each joint
/// `dp/dt - dE/dq = u`. No Newton, no Euler, no moment about any D or V.
#[test]
fn accelerations_satisfy_the_equations_of_the_kinetic_energy() {
    struct Check;
    impl Visitor for Check {
        fn visit<const N: usize>(&mut self, sample: &Sample<N>) {
            let case = sample.case::<Wide>();
            let a = case.reference();
            let momenta_at = |time: f64| {
                let later = moved(&case, &a, time);
                let mut rates = rates(&later);
                // Components of v_B along B axes change by r_B'' - omega x v_B.
                let (v, omega) = (case.snapshot().v_b, case.snapshot().omega);
                let change = Vector::from(&a.r_b_n_ddot) - cross(omega, v);
                let shifted = v + change * wide(time);
                rates[..3].copy_from_slice(&shifted.0);
                momenta(&later, &rates)
            };
            let (after, before) = (momenta_at(STEP), momenta_at(-STEP));
            let mut left: Vec<Wide> =
                after.iter().zip(&before).map(|(a, b)| slope(*a, *b)).collect();
            let mut unit: Vec<f64> = left.iter().map(|x| x.abs().to_f64()).collect();

            let p = momenta(&case, &rates(&case));
            let (v, omega) = (case.snapshot().v_b, case.snapshot().omega);
            let p_v = Vector([p[0], p[1], p[2]]);
            let p_omega = Vector([p[3], p[4], p[5]]);
            let (force, moment) = (cross(omega, p_v), cross(omega, p_omega) + cross(v, p_v));
            let mut right = case.inputs.force.iter().copied().collect::<Vec<_>>();
            right.extend(case.inputs.torque_b.iter());
            right.extend(case.inputs.motors.iter().flat_map(|m| [m.u_o, m.u_i, m.u_w]));
            for axis in 0..3 {
                left[axis] = left[axis] + force.0[axis];
                left[3 + axis] = left[3 + axis] + moment.0[axis];
                unit[axis] += p_v.norm().to_f64() * omega.norm().to_f64();
                unit[3 + axis] += (p_v.norm() * v.norm() + p_omega.norm() * omega.norm()).to_f64();
            }
            for j in 0..N {
                for joint in 0..3 {
                    let bent = |by: f64| {
                        let mut bent = case;
                        let joints = &mut bent.state.devices[j];
                        let angle = [&mut joints.gamma_o, &mut joints.gamma_i, &mut joints.theta];
                        let [o, i, theta] = angle;
                        let angle = [o, i, theta].into_iter().nth(joint).expect("three joints");
                        *angle = *angle + wide(by);
                        energy(&bent, &rates(&case))
                    };
                    let row = 6 + 3 * j + joint;
                    let generalised = slope(bent(STEP), bent(-STEP));
                    left[row] = left[row] - generalised;
                    unit[row] += generalised.abs().to_f64();
                }
            }
            // Differences lose the digits by which the energy's total exceeds the row's own terms.
            let total = energy(&case, &rates(&case)).to_f64();
            for (row, right) in right.into_iter().enumerate() {
                let error = (left[row] - right).abs().to_f64();
                let unit = unit[row].max(total);
                assert_small(error, unit, DIFFERENCE, "row", sample.seed, N);
            }
        }
    }
    visit(cases(SPACECRAFT), &mut Check);
}

#[test]
fn power_fed_in_is_the_rate_of_the_energy() {
    struct Check;
    impl Visitor for Check {
        fn visit<const N: usize>(&mut self, sample: &Sample<N>) {
            let case = sample.case::<Wide>();
            let balance = case.snapshot().power_balance(&case.reference());
            let error = (balance.energy_dot - balance.power).abs().to_f64();
            let unit = balance.magnitudes.to_f64();
            assert_small(error, unit, IDENTITY, "power", sample.seed, N);
        }
    }
    visit(cases(SPACECRAFT), &mut Check);
}
