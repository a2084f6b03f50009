//! Momentum, energy and the ledger.

use nalgebra::Vector3;
use precess_dynamics::kind::{Each, JointStates};
use precess_dynamics::{About, Devices, Gravity, HubMode, Inputs, Wrench};
use precess_tests::bounds::{ORDER, POWER_EPSILONS};

use crate::craft::{Case, SEED, Size};

/// Linear momentum, angular momentum about the origin, energy of everything.
fn conserved<D: Devices<Scalar = f64>>(case: &Case<D>) -> (Vector3<f64>, Vector3<f64>, f64) {
    let found = case.craft.accelerations(&case.state, &case.inputs).expect("a solution");
    let ledger = case.craft.ledger(&case.state, &case.inputs, &found).expect("a ledger");
    (ledger.momentum.linear, ledger.momentum.angular, ledger.energy())
}

/// Without damping, motors and external forces; with them only inside.
fn closed(seed: u64) -> Case {
    let size = Size { modes: 4, contained: seed % 2 == 1, rotation: 0.1, free: false };
    let mut case = Case::new(seed, size);
    case.modes.damping.fill(0.0);
    case.modes.frequencies.iter_mut().for_each(|w| *w = w.min(12.0));
    for joint in [&mut case.devices.0.passive.outer_gimbal, &mut case.devices.0.passive.wheel] {
        joint.viscous = 0.0;
    }
    case.devices.0.passive.inner_gimbal.viscous = 0.0;
    case.devices.1.passive.wheel.viscous = 0.0;
    case.devices.2.passive.panel.viscous = 0.0;
    for joint in case.devices.3.passive.values_mut() {
        joint.viscous = 0.0;
    }
    case.craft = precess_dynamics::Spacecraft::flexible(
        &case.hub,
        &case.modes,
        &case.devices,
        &crate::craft::ON_MOUNT,
    )
    .expect("valid");
    case.inputs = Inputs::none_for(&case.craft);
    case
}

/// Drifts of both momenta and of energy over half a second, in units of what moves.
pub(crate) fn drifts<D: Devices<Scalar = f64>>(mut case: Case<D>, steps: u32) -> [f64; 3] {
    let (p, h, energy) = conserved(&case);
    for _ in 0..steps {
        case.state = case.craft.step(&case.state, &case.inputs, 0.5 / f64::from(steps)).unwrap();
    }
    let (p_after, h_after, energy_after) = conserved(&case);
    [
        (p_after - p).norm() / p.norm(),
        (h_after - h).norm() / h.norm(),
        (energy_after - energy).abs() / energy,
    ]
}

#[test]
fn momentum_and_energy_drift_by_the_order_of_the_step_only() {
    for seed in [SEED + 400, SEED + 401] {
        let [whole, halved] = [100, 200].map(|steps| drifts(closed(seed), steps));
        println!("seed {seed:#x}: {whole:?} {halved:?}");
        let ratios: [f64; 3] = std::array::from_fn(|k| whole[k] / halved[k]);
        assert!(ratios[..2].iter().all(|ratio| ORDER.contains(ratio)), "{ratios:?}");
        // Energy of an oscillation falls with the fifth power, the rest with the fourth.
        assert!((14.0..36.0).contains(&ratios[2]), "{ratios:?}");
        assert!(halved.iter().all(|drift| *drift < 1e-8), "{halved:?}");
    }
}

/// The derivative of energy and momentum along the accelerations, by a difference of fourth order:
/// without an integrator, whatever the deformation.
#[test]
fn momentum_is_conserved_pointwise() {
    for seed in SEED + 410..SEED + 416 {
        let case = closed(seed);
        let found = case.craft.accelerations(&case.state, &case.inputs).expect("a solution");
        let at = |h: f64| {
            let mut moved = case.clone();
            let rigid = &mut moved.state;
            let bn = precess_dynamics::Attitude::dcm(&rigid.attitude);
            let a = bn.transpose() * found.r_b_n_ddot;
            rigid.r_b_n += rigid.r_b_n_dot * h + a * (0.5 * h * h);
            rigid.r_b_n_dot += a * h;
            let w = rigid.omega + found.omega_dot * (0.5 * h);
            let rate = precess_dynamics::Attitude::rate(&rigid.attitude, &w);
            // A step of half the size with the rate in the middle: exact to second order.
            let middle = precess_dynamics::Attitude::advanced(&rigid.attitude, &[(0.5 * h, rate)]);
            let rate = precess_dynamics::Attitude::rate(&middle, &w);
            rigid.attitude = precess_dynamics::Attitude::advanced(&rigid.attitude, &[(h, rate)]);
            rigid.omega += found.omega_dot * h;
            let joints = rigid.devices.states_mut().zip(found.devices.values());
            for ([q, rate], a) in joints {
                *q += *rate * h + 0.5 * a * h * h;
                *rate += a * h;
            }
            for (k, a) in found.modal.eta_ddot.iter().enumerate() {
                moved.state.modal.eta[k] += moved.state.modal.eta_dot[k] * h + 0.5 * a * h * h;
                moved.state.modal.eta_dot[k] += a * h;
            }
            conserved(&moved)
        };
        // Central: third derivatives, with rates of 20 rad/s, times the square of the step.
        let h = 1e-6;
        let ((p, l, e), (q, m, f)) = (at(h), at(-h));
        let (now_p, now_l, now_e) = conserved(&case);
        for (change, unit) in
            [((p - q).norm(), now_p.norm()), ((l - m).norm(), now_l.norm()), ((e - f).abs(), now_e)]
        {
            let rate = change / (2.0 * h) / unit;
            assert!(rate < 1e-7, "seed {seed:#x}: {rate:e} per second");
        }
    }
}

#[test]
fn power_balances_to_rounding_with_everything_on() {
    let mut worst = 0.0_f64;
    for seed in SEED + 420..SEED + 460 {
        let modes = usize::try_from(1 + seed % 40).unwrap();
        let size = Size { modes, contained: seed % 2 == 1, rotation: 0.2, free: false };
        let mut case = Case::new(seed, size);
        case.inputs.gravity = Gravity::Uniform(Vector3::new(0.4, -0.3, 9.0));
        let mut bodies = Inputs::no_wrenches_for(&case.craft);
        let pull =
            Wrench { force: Vector3::new(0.3, 0.1, -0.2), moment: Vector3::new(0.1, 0.2, 0.3) };
        bodies.values_mut().for_each(|wrench| *wrench = pull);
        case.inputs.bodies = Some(bodies);
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
        assert!(ledger.modal.damping <= 0.0 && ledger.modal.strain > 0.0);
    }
    println!("worst {worst:.1} eps");
}

/// Linear momentum is the mass times the velocity of the centre of mass.
#[test]
fn linear_momentum_is_mass_times_velocity_of_the_centre() {
    for seed in SEED + 470..SEED + 480 {
        let case = Case::new(
            seed,
            Size { modes: 7, contained: seed % 2 == 1, rotation: 0.3, free: false },
        );
        let centre = case.craft.centre_of_mass(&case.state).unwrap();
        let rigid = &case.state;
        let bn = precess_dynamics::Attitude::dcm(&rigid.attitude);
        let relative = rigid.omega.cross(&centre.c) + centre.c_prime;
        let velocity = rigid.r_b_n_dot + bn.transpose() * relative;
        let momentum = case.craft.momentum(&case.state, About::CentreOfMass).unwrap().linear;
        let difference = (momentum - velocity * case.craft.mass()).norm();
        assert!(difference <= 1e-14 * momentum.norm() * 8.0, "seed {seed:#x}: {difference:e}");
    }
}
