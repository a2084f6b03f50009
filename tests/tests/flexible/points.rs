//! Points of the structure, and forces on them.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::{Attitude, Inputs, State, Wrench};
use precess_tests::bounds::LIMITS;

use crate::accelerations::{block_error, listed};
use crate::craft::{Case, SEED, Size};

/// Inertial place and axes of a point.
fn pose(case: &Case, k: usize) -> (Vector3<f64>, Matrix3<f64>) {
    let point = &case.modes.mounts[k].point;
    let motion = case.craft.point_motion(point, &case.state).unwrap();
    let rigid = &case.state;
    let nb = rigid.attitude.dcm().transpose();
    (rigid.r_b_n + nb * (point.position + motion.displacement), nb * motion.axes)
}

/// Inertial velocity and angular velocity of a point, expressed in N.
fn rates(case: &Case, k: usize) -> (Vector3<f64>, Vector3<f64>) {
    let motion = case.craft.point_motion(&case.modes.mounts[k].point, &case.state).unwrap();
    let nb = case.state.attitude.dcm().transpose();
    (nb * motion.velocity, nb * motion.omega)
}

#[test]
fn velocities_and_accelerations_of_points_are_derivatives() {
    for seed in SEED + 600..SEED + 604 {
        let size = Size { modes: 5, contained: false, rotation: 0.4, free: false };
        let case = Case::new(seed, size);
        let h = 1e-5;
        let moved = |dt: f64| {
            let state = case.craft.step(&case.state, &case.inputs, dt).unwrap();
            Case { state, ..case.clone() }
        };
        let (ahead, behind) = (moved(h), moved(-h));
        let found = case.craft.accelerations(&case.state, &case.inputs).unwrap();
        for k in 0..3 {
            let ((r, a), (s, b)) = (pose(&ahead, k), pose(&behind, k));
            let (velocity, omega) = rates(&case, k);
            let spin = (a - b) / (2.0 * h) * pose(&case, k).1.transpose();
            let turning = Vector3::new(spin[(2, 1)], spin[(0, 2)], spin[(1, 0)]);
            // Central differences: rates of 50 rad/s cubed times h², and rounding over h.
            assert!(((r - s) / (2.0 * h) - velocity).norm() <= 1e-5 * velocity.norm());
            assert!((turning - omega).norm() <= 1e-5 * omega.norm());

            let ((v, w), (u, x)) = (rates(&ahead, k), rates(&behind, k));
            let point = &case.modes.mounts[k].point;
            let acceleration = case.craft.point_acceleration(point, &case.state, &found).unwrap();
            let nb = case.state.attitude.dcm().transpose();
            let linear = nb * acceleration.acceleration;
            let angular = nb * acceleration.omega_dot;
            assert!(((v - u) / (2.0 * h) - linear).norm() <= 1e-4 * linear.norm());
            assert!(((w - x) / (2.0 * h) - angular).norm() <= 1e-4 * angular.norm());
        }
    }
}

/// On the undeformed structure, a wrench at a mount and the same at its point are one.
#[test]
fn wrench_at_a_point_is_the_wrench_at_the_mount_there() {
    let size = Size { modes: 6, contained: true, rotation: 0.1, free: false };
    let mut case = Case::new(SEED + 610, size);
    case.state = State::at_rest_for(&case.craft);
    case.inputs = Inputs::none_for(&case.craft);
    let wrench =
        Wrench { force: Vector3::new(1.0, -2.0, 0.5), moment: Vector3::new(0.3, 0.1, -0.4) };
    let mut other = case.clone();
    case.inputs.modal.mounts[1] = wrench;
    other.inputs.add_wrench(&case.modes.mounts[1].point, &wrench.force, &wrench.moment);
    let error = block_error(&listed(&case), &listed(&other), 6);
    assert!(error <= LIMITS, "{error:e}");
}
