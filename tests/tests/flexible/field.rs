//! The field of a central body: forces from differences of its potential in double-double, momentum
//! and energy.
//!
//! `V = -m mu / R - g . s - ½ G : S` to second order about B, with mass, first and second moment of
//! everything; the structure's second moment is that of the undeformed one.

use nalgebra::Vector3;
use precess_dynamics::{Attitude, Devices, Gravity, HubMode, Real, Scalar};
use precess_tests::blocks::largest;
use precess_tests::bounds::{ACCELERATIONS_WORST, BACKWARD_EPSILONS, LIMITS, POWER_EPSILONS};
use precess_tests::double_double::DoubleDouble as DD;
use precess_tests::newton_euler::vector::{Tensor, Vector, cross, dot};

use crate::accelerations::{block_error, listed};
use crate::craft::{Case, SEED, Size};
use crate::reference::{bodies, dd, difference, poses, reference, shifted, tensor, vector};

/// Gravitational parameter, m³/s², for a spacecraft at ten metres: every term of the field matters.
const MU: f64 = 900.0;

/// Step of the differences of the potential: truncation of the fourth power, 1e-24.
const STEP: f64 = 1e-6;

/// Of the field: force through B and torque about B, expressed in B, and the forces of modes and
/// joints.
pub(crate) struct Forces {
    pub(crate) force: Vector<DD>,
    pub(crate) torque: Vector<DD>,
    pub(crate) generalised: Vec<DD>,
}

/// The forces: B turned by a small angle sees the centre turned back, so that the torque about B is
/// `-rho x F` with the place rho of B expressed in B.
pub(crate) fn forces<D: Devices<Scalar = f64>>(case: &Case<D>, mu: DD, x: &[DD]) -> Forces {
    let rho = place(case);
    let slope = |at: &dyn Fn(DD) -> DD| {
        difference(STEP, at, |a: &DD, b: &DD, h, c: &DD, d: &DD| {
            (*a - *d + (*c - *b) * dd(8.0)) * h
        })
    };
    let along = |axis: usize| -slope(&|by| potential(case, mu, rho + Vector::unit(axis) * by, x));
    let force = Vector([along(0), along(1), along(2)]);
    let torque = cross(rho, force) * dd(-1.0);
    let generalised =
        (0..x.len()).map(|index| -slope(&|by| potential(case, mu, rho, &shifted(x, index, by))));
    Forces { force, torque, generalised: generalised.collect() }
}

/// The place of B from the centre, expressed in B.
fn place<D: Devices<Scalar = f64>>(case: &Case<D>) -> Vector<DD> {
    tensor(&case.state.attitude.dcm()) * vector(&case.state.r_b_n)
}

fn potential<D: Devices<Scalar = f64>>(case: &Case<D>, mu: DD, rho: Vector<DD>, x: &[DD]) -> DD {
    let (c, m) = (vector(&case.hub.r_bc_b), dd(case.hub.m_b));
    let dyad = |v: Vector<DD>| Tensor([0, 1, 2].map(|i| (v * v.0[i]).0));
    let about_centre = |inertia: Tensor<DD>| {
        let trace = inertia.0[0][0] + inertia.0[1][1] + inertia.0[2][2];
        Tensor::identity() * (trace * dd(0.5)) + inertia * dd(-1.0)
    };
    let linear = case.modes.linear.iter().zip(x);
    let mut first = linear.fold(c * m, |sum, (p, eta)| sum + vector(p) * *eta);
    let mut second = about_centre(tensor(&case.hub.i_b_bc)) + dyad(c) * m;
    let mut mass = m;
    for (body, pose) in bodies(case).iter().zip(poses(case, x)) {
        mass = mass + body.mass;
        first = first + pose.at * body.mass;
        let own = about_centre(body.inertia).resolved_from(pose.axes);
        second = second + own + dyad(pose.at) * body.mass;
    }
    let square = dot(rho, rho);
    let distance = square.sqrt();
    let along = dot(rho, first);
    let spread = dot(rho, second * rho) * dd(3.0) * square.recip();
    let trace = second.0[0][0] + second.0[1][1] + second.0[2][2];
    let cube = (square * distance).recip();
    // g = -mu rho / R³, G = mu / R³ (3 n nᵀ - 1).
    (along * cube - mass * distance.recip() - (spread - trace) * cube * dd(0.5)) * mu
}

fn case(seed: u64, modes: usize) -> Case {
    let size = Size { modes, contained: seed % 2 == 1, rotation: 0.3, free: false };
    let mut case = Case::new(seed, size);
    case.state.r_b_n = Vector3::new(6.0, -5.0, 7.0);
    case.inputs.gravity = Gravity::Central { mu: MU };
    case
}

#[test]
fn accelerations_in_a_central_field_are_those_of_the_potential() {
    let (mut worst, mut backward) = (0.0_f64, 0.0_f64);
    for (number, modes) in (0..).zip([1, 3, 4, 5]) {
        let case = case(SEED + 700 + number, modes);
        let (found, expected) = (listed(&case), reference(&case));
        worst = worst.max(block_error(&found, &expected.accelerations, modes));
        backward = backward.max(expected.backward_error(&found));
        // The field matters.
        let mut without = case.clone();
        without.inputs.gravity = Gravity::None;
        assert!(block_error(&listed(&without), &found, modes) > 0.1);
    }
    println!("{worst:.1e}, {backward:.1e}");
    assert!(worst <= ACCELERATIONS_WORST, "{worst:e}");
    assert!(backward <= BACKWARD_EPSILONS * f64::EPSILON, "{backward:e}");
}

/// The ledger's gravity is the work of the field: power balances to rounding, and the potential
/// energy is that of the differences above.
#[test]
fn power_balances_in_a_central_field() {
    let mut worst = 0.0_f64;
    for seed in SEED + 710..SEED + 722 {
        let mut case = case(seed, usize::try_from(1 + seed % 40).unwrap());
        if seed % 3 == 0 {
            case.inputs.hub = HubMode::Prescribed {
                r_b_n_ddot: Vector3::new(0.2, -0.1, 0.3),
                omega_dot: Vector3::new(0.1, 0.3, -0.2),
            };
        }
        let found = case.craft.accelerations(&case.state, &case.inputs).expect("a solution");
        let ledger = case.craft.ledger(&case.state, &case.inputs, &found).expect("a ledger");
        let balance = ledger.residual.abs() / ledger.magnitude;
        worst = worst.max(balance / f64::EPSILON);
        assert!(balance <= POWER_EPSILONS * f64::EPSILON, "seed {seed:#x}: {balance:e}");
        let joints = precess_dynamics::kind::JointStates::states(&case.state.devices);
        let x = case.state.modal.eta.iter().copied().chain(joints.map(|[q, _]| q)).map(dd);
        let x: Vec<DD> = x.collect();
        let expected = potential(&case, dd(MU), place(&case), &x).to_f64();
        assert!((ledger.gravity - expected).abs() <= LIMITS * expected.abs(), "seed {seed:#x}");
        // And its power is the derivative along the motion.
        let of_field = forces(&case, dd(MU), &x);
        let rigid = &case.state;
        let v = rigid.attitude.dcm() * rigid.r_b_n_dot;
        let joints = precess_dynamics::kind::JointStates::states(&rigid.devices);
        let rates = case.state.modal.eta_dot.iter().copied().chain(joints.map(|[_, rate]| rate));
        let hub = dot(of_field.force, vector(&v)) + dot(of_field.torque, vector(&rigid.omega));
        let pairs = of_field.generalised.iter().zip(rates);
        let terms: Vec<DD> = pairs.map(|(force, rate)| *force * dd(rate)).collect();
        let power = terms.iter().fold(hub, |sum, term| sum + *term).to_f64();
        let size = largest(terms.iter().map(|term| term.abs().to_f64())) + hub.abs().to_f64();
        assert!((ledger.power.gravity - power).abs() <= LIMITS * size, "seed {seed:#x}");
    }
    println!("worst {worst:.1} eps");
}

/// The field has no torque about its centre: angular momentum about it stays, of all orders.
#[test]
fn angular_momentum_about_the_centre_is_conserved() {
    for seed in [SEED + 750, SEED + 751] {
        let drift = |steps: u32| {
            let mut case = case(seed, 4);
            case.inputs = precess_dynamics::Inputs::none_for(&case.craft);
            case.inputs.gravity = Gravity::Central { mu: MU };
            let about = precess_dynamics::About::InertialOrigin;
            let angular = |case: &Case| case.craft.momentum(&case.state, about).unwrap().angular;
            let before = angular(&case);
            for _ in 0..steps {
                let dt = 0.3 / f64::from(steps);
                case.state = case.craft.step(&case.state, &case.inputs, dt).unwrap();
            }
            (angular(&case) - before).norm() / before.norm()
        };
        let (whole, halved) = (drift(150), drift(300));
        let ratio = whole / halved;
        assert!(precess_tests::bounds::ORDER.contains(&ratio), "{whole:e} {halved:e}");
        assert!(halved < 1e-8, "{halved:e}");
    }
}

#[test]
fn at_the_centre_of_the_field_is_an_error() {
    let mut case = case(SEED + 760, 3);
    case.state.r_b_n = Vector3::zeros();
    let rejected = case.craft.accelerations(&case.state, &case.inputs);
    assert_eq!(rejected, Err(precess_dynamics::SolveError::AtCentre));
}
