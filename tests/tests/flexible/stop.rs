//! The impulsive stop, by the mass matrix of the kinetic energy and by what it conserves.

use precess_dynamics::kind::JointStates;
use precess_dynamics::{About, Attitude, Devices, HubMode, Mode, Real, Scalar};
use precess_tests::bounds::{BACKWARD_EPSILONS, LIMITS};
use precess_tests::double_double::DoubleDouble as DD;

use crate::craft::{Case, SEED, Size};
use crate::reference::{dd, reference};

fn case(seed: u64) -> Case {
    let modes = usize::try_from(1 + seed % 5).unwrap();
    let size = Size { modes, contained: seed % 2 == 1, rotation: 0.3, free: false };
    let mut case = Case::new(seed, size);
    case.inputs.modes.0.inner_gimbal = Mode::Locked;
    case.inputs.modes.2.panel = Mode::Locked;
    case
}

/// Velocities `v, omega, eta', q'`, those of B expressed in B.
pub(crate) fn velocities<D: Devices<Scalar = f64>>(case: &Case<D>) -> Vec<f64> {
    let rigid = &case.state;
    let v = rigid.attitude.dcm() * rigid.r_b_n_dot;
    let hub = v.iter().chain(&rigid.omega).copied().collect::<Vec<_>>();
    let joints = rigid.devices.states().map(|[_, rate]| rate);
    hub.into_iter().chain(case.state.modal.eta_dot.iter().copied()).chain(joints).collect()
}

/// `M Δ` has an impulse at the locked joints and nowhere else: rows of the mass matrix that is
/// found from the places of all bodies.
#[test]
fn impulses_act_at_the_locked_joints_only() {
    let mut worst = 0.0_f64;
    for seed in SEED + 800..SEED + 808 {
        let mut case = case(seed);
        let before = velocities(&case);
        let mass = reference(&case).mass;
        let stopped = case.craft.stop(&case.state, &case.inputs).expect("a solution");
        case.state = stopped.state;
        assert_eq!(case.state.devices.0.gamma_i_dot, 0.0);
        let after = velocities(&case);
        let first = 6 + case.state.modal.eta.len();
        for (index, row) in mass.iter().enumerate() {
            let terms = row.iter().zip(after.iter().zip(&before));
            let start = [dd(0.0); 3];
            let [sum, jumps, size] = terms.fold(start, |[sum, jumps, size], (m, (a, b))| {
                let (after, before) = (*m * dd(*a), *m * dd(*b));
                let jump = after - before;
                [sum + jump, jumps + jump.abs(), size + after.abs() + before.abs()]
            });
            // The inner gimbal and the panel: of joints 0, 1, 2 of the gyro, 3 the wheel, 4.
            if index == first + 1 || index == first + 4 {
                let share = (sum.abs() * jumps.recip()).to_f64();
                assert!(share > 1e-3, "seed {seed:#x}, row {index}: no impulse");
            } else {
                // Velocities are stored with their rounding, not jumps.
                let share = (sum.abs() * size.recip()).to_f64();
                worst = worst.max(share / f64::EPSILON);
                let bound = BACKWARD_EPSILONS * f64::EPSILON;
                assert!(share <= bound, "seed {seed:#x}, row {index}: {share:e}");
            }
        }
    }
    println!("worst {worst:.1} eps");
}

#[test]
fn stop_conserves_momentum_and_loses_energy() {
    for seed in SEED + 810..SEED + 830 {
        let case = case(seed);
        let stopped = case.craft.stop(&case.state, &case.inputs).expect("a solution");
        let momentum = |state| case.craft.momentum(state, About::InertialOrigin).unwrap();
        let (before, after) = (momentum(&case.state), momentum(&stopped.state));
        let linear = (after.linear - before.linear).norm() / before.linear.norm();
        let angular = (after.angular - before.angular).norm() / before.angular.norm();
        assert!(linear <= LIMITS && angular <= LIMITS, "seed {seed:#x}: {linear:e} {angular:e}");
        assert!(stopped.energy_lost > 0.0);
        let energy = |state| case.craft.energy(state).unwrap();
        let lost = energy(&case.state) - energy(&stopped.state);
        // That of the orbit is counted here.
        assert!((lost - stopped.energy_lost).abs() <= LIMITS * energy(&case.state));
        assert!(
            stopped.state.modal.eta == case.state.modal.eta
                && stopped.state.modal.eta_dot != case.state.modal.eta_dot
        );
        // What is at rest is stopped without an impulse.
        let again = case.craft.stop(&stopped.state, &case.inputs).unwrap();
        assert!(again.energy_lost.abs() <= LIMITS * energy(&case.state));
        let found = case.craft.accelerations(&stopped.state, &case.inputs);
        assert!(found.is_ok(), "{found:?}");
    }
}

#[test]
fn fixed_frame_stops_and_the_modes_take_the_impulse() {
    let mut case = case(SEED + 840);
    case.inputs.hub = HubMode::Fixed;
    let stopped = case.craft.stop(&case.state, &case.inputs).expect("a solution");
    let rigid = &stopped.state;
    assert!(rigid.omega.norm() == 0.0 && rigid.r_b_n_dot.norm() == 0.0);
    assert!(stopped.energy_lost > 0.0);
    assert_ne!(stopped.state.modal.eta_dot, case.state.modal.eta_dot);
    // Rows of the modes: M Δ = 0, the momentum of each mode stays.
    let mass = reference(&case).mass;
    let before = velocities(&case);
    let state = stopped.state.clone();
    let after = velocities(&Case { state, ..case.clone() });
    for row in mass.iter().skip(6).take(case.state.modal.eta.len()) {
        let terms = row.iter().zip(after.iter().zip(&before));
        let terms: Vec<DD> = terms.map(|(m, (a, b))| *m * (dd(*a) - dd(*b))).collect();
        let sum = terms.iter().fold(dd(0.0), |sum, term| sum + *term).abs().to_f64();
        let size = terms.iter().fold(0.0, |sum, term| sum + term.abs().to_f64());
        assert!(sum <= 4.0 * BACKWARD_EPSILONS * f64::EPSILON * size, "{sum:e} of {size:e}");
    }
}
