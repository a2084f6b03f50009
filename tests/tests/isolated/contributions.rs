//! What the devices contribute to a hub that another program has: with that hub, the accelerations of the whole.

use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};
use precess_dynamics::{
    About, BuiltIn, Devices, Each, Gravity, Hub, HubMode, JointGains, JointReading, JointStates,
    Mode, Quantity, ReactionWheel, Sgcmg, SolveError, Spacecraft,
};
use precess_tests::cases;

use crate::craft::{Craft, Options, cluster, mixed, stacked};
use crate::panels::rows;

/// Seeds of each set and each choice of options.
const SEEDS: u64 = 40;

/// Rounding of sums of some tens of products, of the sum of their magnitudes.
const ROUNDING: f64 = 1e-13;

fn hub() -> Hub {
    let inertia = Matrix3::new(40.0, 1.5, -1.1, 1.5, 35.0, 0.9, -1.1, 0.9, 30.0);
    Hub { m_b: 180.0, r_bc_b: Vector3::new(0.02, -0.01, 0.05), i_b_bc: inertia }
}

fn joined(v: &Vector3<f64>, w: &Vector3<f64>) -> Vector6<f64> {
    Vector6::from_iterator(v.iter().chain(w).copied())
}

/// Mass matrix of the hub, and its load without force and torque.
fn of_hub(hub: &Hub, omega: &Vector3<f64>) -> (Matrix6<f64>, Vector6<f64>) {
    let c = hub.r_bc_b.cross_matrix();
    let inertia = hub.i_b_bc - c * c * hub.m_b;
    let mut m = Matrix6::identity() * hub.m_b;
    m.fixed_view_mut::<3, 3>(0, 3).copy_from(&(-c * hub.m_b));
    m.fixed_view_mut::<3, 3>(3, 0).copy_from(&(c * hub.m_b));
    m.fixed_view_mut::<3, 3>(3, 3).copy_from(&inertia);
    let force = omega.cross(&omega.cross(&hub.r_bc_b)) * -hub.m_b;
    (m, joined(&force, &-omega.cross(&(inertia * omega))))
}

fn equations_are_those_of_the_whole<D: Devices<Scalar = f64>>(of: &Craft<D>, what: &str) {
    let craft = Spacecraft::new(&hub(), &of.devices).expect("a spacecraft");
    let mut inputs = of.inputs.clone();
    inputs.hub = HubMode::Free;
    let found = craft.accelerations(&of.state, &inputs).expect("regular");
    let mut gains = craft.joint_gains();
    let devices = craft.eliminate_joints(&of.state, &inputs, &mut gains).expect("regular");
    assert_eq!(Ok(devices), craft.device_contributions(&of.state, &inputs), "{what}");
    let field = match inputs.gravity {
        Gravity::Uniform(g) => precess_dynamics::Attitude::dcm(&of.state.attitude) * g,
        _ => Vector3::zeros(),
    };
    let a = joined(&(found.r_b_n_ddot - field), &found.omega_dot);
    let (mut m, mut h) = of_hub(&hub(), &of.state.omega);
    let mut own = Matrix6::zeros();
    own.fixed_view_mut::<3, 3>(0, 0).copy_from(&devices.m_vv);
    own.fixed_view_mut::<3, 3>(0, 3).copy_from(&devices.m_vw);
    own.fixed_view_mut::<3, 3>(3, 0).copy_from(&devices.m_vw.transpose());
    own.fixed_view_mut::<3, 3>(3, 3).copy_from(&devices.m_ww);
    m += own;
    let load = joined(&devices.h_v, &devices.h_w);
    h += load + joined(&inputs.force, &inputs.torque_b);
    let scale = m.abs() * a.abs() + h.abs() + load.abs();
    let residual = (m * a - h).abs();
    for (residual, scale) in residual.iter().zip(&scale) {
        assert!(*residual <= ROUNDING * scale, "{what}: {residual:e} of {scale:e}");
    }
    let prescribed =
        HubMode::Prescribed { r_b_n_ddot: found.r_b_n_ddot - field, omega_dot: found.omega_dot };
    (inputs.hub, inputs.gravity) = (prescribed, Gravity::None);
    let joints = craft.accelerations(&of.state, &inputs).expect("regular").devices;
    let a = found.r_b_n_ddot - field;
    let by_gains = craft.joint_accelerations(&gains, &a, &found.omega_dot).expect("regular");
    for (joint, expected) in by_gains.values().zip(joints.values()) {
        assert!(
            (joint - expected).abs() <= ROUNDING * (1.0 + expected.abs()),
            "{what}: {joint:e} by gains, {expected:e}"
        );
    }
    for (joint, expected) in joints.values().zip(found.devices.values()) {
        assert!(
            (joint - expected).abs() <= ROUNDING * (1.0 + expected.abs()),
            "{what}: {joint:e}, {expected:e}"
        );
    }
}

/// State and inputs of the joints of a case.
fn readings<D: Devices<Scalar = f64>>(of: &Craft<D>) -> Vec<JointReading> {
    let inputs = of.inputs.motors.values().zip(of.inputs.modes.values());
    let joints = of.state.devices.states().zip(inputs);
    joints
        .map(|([coordinate, rate], (motor, mode))| JointReading { coordinate, rate, motor, mode })
        .collect()
}

fn joint_by_joint_the_bits_are_the_same<D: Devices<Scalar = f64>>(of: &Craft<D>, what: &str) {
    let Craft { solver, state, inputs, .. } = of;
    let mut gains = solver.joint_gains();
    let expected = solver.eliminate_joints(state, inputs, &mut gains).expect("regular");
    let joints = readings(of);
    let mut own = solver.joint_gains();
    let found = solver.eliminate_joints_of(&state.omega, &mut joints.iter().copied(), &mut own);
    assert_eq!(found, Some(expected), "{what}");
    let (a, omega_dot) = (Vector3::new(0.3, -0.2, 0.7), Vector3::new(-0.05, 0.02, 0.04));
    let expected = solver.joint_accelerations(&gains, &a, &omega_dot).expect("regular");
    let mut found = Vec::new();
    assert!(solver.write_joint_accelerations(&own, &a, &omega_dot, |of| found.push(of)), "{what}");
    assert_eq!(found, expected.values().collect::<Vec<_>>(), "{what}");
    // Whatever is rejected is none: a joint is missing, a number of any of them is not finite.
    let eliminate = |joints: &[JointReading]| {
        let mut gains = solver.joint_gains();
        solver.eliminate_joints_of(&state.omega, &mut joints.iter().copied(), &mut gains)
    };
    assert_eq!(eliminate(&joints[1..]), None, "{what}");
    for joint in 0..joints.len() {
        let mut changed = joints.clone();
        changed[joint].rate = f64::NAN;
        assert_eq!(eliminate(&changed), None, "{what}, rate of joint {joint}");
        changed.clone_from(&joints);
        changed[joint].motor = f64::INFINITY;
        assert_eq!(eliminate(&changed), None, "{what}, motor of joint {joint}");
    }
    let hub = Vector3::new(0.0, f64::NAN, 0.0);
    assert!(!solver.write_joint_accelerations(&own, &a, &hub, |_| ()), "{what}");
    assert!(!solver.write_joint_accelerations(&solver.joint_gains(), &a, &a, |_| ()), "{what}");
}

fn mass_properties_are_those_of_the_whole<D: Devices<Scalar = f64>>(of: &Craft<D>, what: &str) {
    let hub = hub();
    let craft = Spacecraft::new(&hub, &of.devices).expect("a spacecraft");
    let devices = craft.device_contributions(&of.state, &of.inputs).expect("regular");
    let near = |found: f64, expected: f64| (found - expected).abs() <= ROUNDING * expected.abs();
    assert!(near(devices.mass + hub.m_b, craft.mass()), "{what}");
    let centre = craft.centre_of_mass(&of.state).expect("finite");
    let first = devices.first_moment + hub.r_bc_b * hub.m_b;
    let size = devices.first_moment.norm() + hub.r_bc_b.norm() * hub.m_b;
    assert!((first - centre.c * craft.mass()).norm() <= ROUNDING * size, "{what}");
    let prime = devices.first_moment_prime;
    let error = (prime - centre.c_prime * craft.mass()).norm();
    assert!(error <= 1e-12 * prime.norm(), "{what}: {error:e} of {:e}", prime.norm());
    // With joints at rest the angular momentum about B is that of a rigid body.
    let mut still = of.state.clone();
    still.r_b_n_dot = Vector3::zeros();
    still.devices.states_mut().for_each(|[_, rate]| *rate = 0.0);
    let about = About::Point(still.r_b_n);
    let angular = craft.momentum(&still, about).expect("finite").angular;
    let c = hub.r_bc_b.cross_matrix();
    let inertia = devices.inertia + hub.i_b_bc - c * c * hub.m_b;
    let expected = inertia * still.omega;
    let found = precess_dynamics::Attitude::dcm(&still.attitude) * angular;
    assert!((found - expected).norm() <= 1e-12 * inertia.norm() * still.omega.norm(), "{what}");
}

#[test]
fn contributions_and_a_hub_are_the_whole_spacecraft() {
    let none = Options::default();
    let uniform = Some(Gravity::Uniform(Vector3::new(0.3, -9.0, 2.0)));
    let all = [
        none,
        Options { springs: true, dry: true, ..none },
        Options { wrenches: true, modes: true, ..none },
        Options { gravity: uniform, springs: true, ..none },
    ];
    for (number, options) in all.iter().enumerate() {
        for seed in 0..cases(SEEDS) {
            let what = format!("options {number}, seed {seed}");
            equations_are_those_of_the_whole(&cluster(seed, options), &what);
            equations_are_those_of_the_whole(&mixed(seed, options), &what);
            equations_are_those_of_the_whole(&stacked(seed, options), &what);
            equations_are_those_of_the_whole(&rows(seed, options), &what);
            mass_properties_are_those_of_the_whole(&mixed(seed, options), &what);
            mass_properties_are_those_of_the_whole(&stacked(seed, options), &what);
        }
    }
}

#[test]
fn joint_by_joint_an_elimination_has_the_same_bits() {
    let none = Options::default();
    let all = [none, Options { springs: true, dry: true, modes: true, ..none }];
    for (number, options) in all.iter().enumerate() {
        for seed in 0..cases(SEEDS) {
            let what = format!("options {number}, seed {seed}");
            joint_by_joint_the_bits_are_the_same(&cluster(seed, options), &what);
            joint_by_joint_the_bits_are_the_same(&mixed(seed, options), &what);
            joint_by_joint_the_bits_are_the_same(&stacked(seed, options), &what);
            joint_by_joint_the_bits_are_the_same(&rows(seed, options), &what);
        }
    }
}

/// Gains are of the devices that they were made for.
#[test]
fn joint_by_joint_gains_of_other_devices_are_rejected() {
    let spacecraft = |devices: &[Option<BuiltIn>; 2]| Spacecraft::new(&hub(), devices);
    let wheel: BuiltIn = ReactionWheel::bare_wheel(4.0, Matrix3::identity()).into();
    let gyro: BuiltIn = Sgcmg::bare_wheel(4.0, Matrix3::identity()).into();
    let wheels = spacecraft(&[Some(wheel), Some(wheel)]).expect("a spacecraft");
    let at_rest = JointReading { coordinate: 0.1, rate: 0.0, motor: 0.2, mode: Mode::Driven };
    let omega = Vector3::new(0.01, 0.02, 0.03);
    let eliminate = |gains: &mut JointGains<_>| {
        wheels.eliminate_joints_of(&omega, &mut [at_rest; 2].into_iter(), gains)
    };
    assert!(eliminate(&mut wheels.joint_gains()).is_some());
    for others in [[Some(wheel), Some(gyro)], [Some(wheel), None]] {
        let others = spacecraft(&others).expect("a spacecraft");
        assert_eq!(eliminate(&mut others.joint_gains()), None);
        let gains = others.joint_gains();
        assert!(!wheels.write_joint_accelerations(&gains, &omega, &omega, |_| ()));
    }
}

#[test]
fn a_state_or_a_locked_joint_that_accelerations_reject_is_rejected() {
    let mut of = cluster(3, &Options::default());
    for mode in of.inputs.modes.values_mut() {
        *mode = Mode::Locked;
    }
    let rejected = of.solver.device_contributions(&of.state, &of.inputs);
    assert!(matches!(rejected, Err(SolveError::LockedJointMoves { .. })), "{rejected:?}");
    let mut of = cluster(3, &Options::default());
    of.state.omega.x = f64::NAN;
    let rejected = of.solver.device_contributions(&of.state, &of.inputs);
    assert!(matches!(rejected, Err(SolveError::NotFinite { .. })), "{rejected:?}");
}

#[test]
fn gains_of_no_elimination_and_a_hub_that_is_not_finite_are_rejected() {
    let of = mixed(3, &Options::default());
    let still = Vector3::zeros();
    let mut gains = of.solver.joint_gains();
    let rejected = of.solver.joint_accelerations(&gains, &still, &still);
    let first = matches!(
        rejected,
        Err(SolveError::Overflow { what: Quantity::JointAcceleration { device: 0, .. } })
    );
    assert!(first, "{rejected:?}");
    of.solver.eliminate_joints(&of.state, &of.inputs, &mut gains).expect("regular");
    assert!(of.solver.joint_accelerations(&gains, &still, &still).is_ok());
    let rejected = of.solver.joint_accelerations(&gains, &still, &Vector3::new(0.0, f64::NAN, 0.0));
    let what = Quantity::HubAcceleration;
    assert!(
        matches!(rejected, Err(SolveError::NotFinite { what: of, .. }) if of == what),
        "{rejected:?}"
    );
}
