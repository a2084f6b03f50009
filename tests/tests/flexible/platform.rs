//! Isolated platforms on the mounts of a flexible structure.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::kind::{Each, JointStates};
use precess_dynamics::set::OnMount;
use precess_dynamics::{
    About, Accelerations, Coupled, DeviceSet, Flexible, Gravity, HubMode, Inputs, Isolated,
    ListedModes, LoadAxes, Mode, Platform, ReactionWheel, Spacecraft, State, Strut, Suspension,
    Vscmg, Wrench, platform,
};
use precess_tests::blocks::largest;
use precess_tests::bounds::{
    ACCELERATIONS_WORST, BACKWARD_EPSILONS, LIMITS, ORDER, POWER_EPSILONS,
};
use precess_tests::random::Random;

use crate::accelerations::{block_error, errors};
use crate::conservation::drifts;
use crate::craft::{Case, SEED, Size, chain, draw_inputs, draw_motion, mounted, structure};
use crate::reference::reference;
use crate::stop::velocities;

/// A wheel on one mount, a gyro on a platform on another.
pub(crate) type Carried = (ReactionWheel, Isolated<Vscmg>);

/// That of the gyro is not read.
pub(crate) const ON_MOUNT: <Carried as DeviceSet>::Per<OnMount> =
    (1, platform::Data { carrier: 2, carried: 0 });

/// As on a rigid hub, with the platform's axes those of the gyro's mount: one chain of eight joints.
pub(crate) fn case(seed: u64, size: Size, suspension: &Suspension) -> Case<Carried> {
    let random = &mut Random::new(seed);
    let (wheel, platform) =
        (crate::craft::device(random, 4.0), crate::craft::device::<Platform>(random, 10.0));
    let carried = mounted(random, 6.0, &Matrix3::identity());
    let devices = (wheel, Isolated { carrier: platform, suspension: *suspension, carried });
    let (hub, modes) = structure(random, size, &[6.0, 14.0, 20.0]);
    let craft = Spacecraft::flexible(&hub, &modes, &devices, &ON_MOUNT).expect("valid");
    let (mut on_platform, gyro) = (chain(&devices.1.carrier, 2), chain(&devices.1.carried, 2));
    on_platform.links.extend(gyro.links);
    let chains = vec![chain(&devices.0, 1), on_platform];
    let mut state = State::at_rest_for(&craft);
    let mut inputs = Inputs::none_for(&craft);
    draw_motion(random, size, &mut state);
    draw_inputs(random, &mut inputs);
    // Its second turn is far from a right angle.
    for [coordinate, _] in state.devices.1.carrier.states_mut() {
        *coordinate *= 0.4;
    }
    Case { seed, hub, modes, devices, craft, chains, state, inputs }
}

/// Springs that couple joints, and a strut, without damping if so wished.
pub(crate) fn suspension(damping: f64) -> Suspension {
    let stiffness = nalgebra::Matrix6::from_fn(|i, j| if i == j { 40.0 } else { 3.0 });
    let rest = nalgebra::Vector6::from_element(0.01);
    let strut = Strut {
        position: Vector3::new(0.1, -0.2, 0.05),
        direction: Vector3::new(0.36, 0.48, 0.8),
        length: 0.2,
        stiffness: 30.0,
        damping,
    };
    let mut struts = [None; 6];
    struts[2] = Some(strut);
    Suspension {
        coupled: Some(Coupled { stiffness, rest, damping: stiffness * 0.01 * damping }),
        struts,
    }
}

#[test]
fn accelerations_are_those_of_the_kinetic_energy() {
    let (mut worst, mut backward) = (0.0_f64, 0.0_f64);
    let sizes = [(1, 0.02), (3, 0.3), (4, 1.5), (5, 0.02)];
    for (number, (modes, rotation)) in (0..).zip(sizes.into_iter().cycle().take(8)) {
        let size = Size { modes, contained: number % 2 == 1, rotation, free: false };
        let mut case = case(SEED + 1100 + number, size, &Suspension::none());
        if number % 4 == 3 {
            case.inputs.gravity = Gravity::Central { mu: 900.0 };
        }
        let [error, residual] = errors(&case);
        println!("seed {:#x}, {size:?}: {error:.1e}, {residual:.1e}", case.seed);
        (worst, backward) = (worst.max(error), backward.max(residual));
    }
    assert!(worst <= ACCELERATIONS_WORST, "{worst:e}");
    assert!(backward <= BACKWARD_EPSILONS * f64::EPSILON, "{backward:e}");
}

/// What a brake within and below a platform stops, by the mass matrix of the kinetic energy.
#[test]
fn impulses_act_at_the_locked_joints_only() {
    for seed in SEED + 1120..SEED + 1124 {
        let size = Size { modes: 3, contained: seed % 2 == 1, rotation: 0.3, free: false };
        let mut case = case(seed, size, &suspension(0.0));
        case.inputs.modes.1.carrier.y_slide = Mode::Locked;
        case.inputs.modes.1.carried.gimbal = Mode::Locked;
        let momentum = |case: &Case<Carried>| {
            case.craft.momentum(&case.state, About::InertialOrigin).expect("a momentum")
        };
        let before = (velocities(&case), momentum(&case));
        let mass = reference(&case).mass;
        case.state = case.craft.stop(&case.state, &case.inputs).expect("a solution").state;
        let after = (velocities(&case), momentum(&case));
        let drift = (after.1.angular - before.1.angular).norm() / before.1.angular.norm();
        assert!(drift <= LIMITS, "seed {seed:#x}: {drift:e}");
        // The wheel's joint, the platform's six, the gyro's two.
        let first = 6 + case.state.modal.eta.len();
        for (index, row) in mass.iter().enumerate() {
            let terms = row.iter().zip(after.0.iter().zip(&before.0));
            let terms = terms.map(|(m, (a, b))| {
                let m = precess_dynamics::Scalar::to_f64(*m);
                [m * (a - b), (m * a).abs() + (m * b).abs()]
            });
            let [sum, size] = terms.fold([0.0; 2], |[s, t], [a, b]| [s + a, t + b]);
            let share = sum.abs() / size;
            if index == first + 2 || index == first + 7 {
                assert!(share > 1e-6, "seed {seed:#x}, row {index}: no impulse");
            } else {
                // Differences of stored velocities, and a matrix by differences, in double.
                assert!(share <= 1e-13, "seed {seed:#x}, row {index}: {share:e}");
            }
        }
    }
}

#[test]
fn power_balances_and_nothing_is_needed_beside_the_inputs() {
    let (mut worst, mut needed) = (0.0_f64, 0.0_f64);
    for seed in SEED + 1130..SEED + 1150 {
        let modes = usize::try_from(1 + seed % 30).expect("small");
        let size = Size { modes, contained: seed % 2 == 1, rotation: 0.2, free: false };
        let mut case = case(seed, size, &suspension(2.0));
        case.inputs.gravity = match seed % 3 {
            0 => Gravity::Central { mu: 900.0 },
            _ => Gravity::Uniform(Vector3::new(0.4, -0.3, 9.0)),
        };
        let mut bodies = Inputs::no_wrenches_for(&case.craft);
        let pull =
            Wrench { force: Vector3::new(0.3, 0.1, -0.2), moment: Vector3::new(0.1, 0.2, 0.3) };
        bodies.values_mut().for_each(|wrench| *wrench = pull);
        case.inputs.bodies = Some(bodies);
        if seed % 5 == 0 {
            case.inputs.hub = HubMode::Prescribed {
                r_b_n_ddot: Vector3::new(0.2, -0.1, 0.3),
                omega_dot: Vector3::new(0.1, 0.3, -0.2),
            };
        }
        case.inputs.modes.1.carrier.z_slide = Mode::Prescribed(0.4);
        let found = case.craft.accelerations(&case.state, &case.inputs).expect("a solution");
        let ledger = case.craft.ledger(&case.state, &case.inputs, &found).expect("a ledger");
        let balance = ledger.residual.abs() / ledger.magnitude;
        worst = worst.max(balance / f64::EPSILON);
        assert!(balance <= POWER_EPSILONS * f64::EPSILON, "seed {seed:#x}: {balance:e}");

        let loads = case.craft.loads(&case.state, &case.inputs, &found, LoadAxes::Hub);
        let loads = loads.expect("loads");
        let unit = largest(loads.modal.mounts.iter().map(|wrench| wrench.force.norm()));
        let mut rest = largest(loads.modal.forces.iter().map(|force| force.abs())) / unit;
        if case.inputs.hub == HubMode::Free {
            let hub = loads.hub;
            rest = rest.max(hub.force.norm().max(hub.moment.norm()) / unit);
        }
        needed = needed.max(rest);
        assert!(rest <= LIMITS, "seed {seed:#x}: {rest:e}");
    }
    println!("balance {worst:.1} eps, loads {needed:.1e}");
}

/// Without damping, motors and external forces.
fn closed(seed: u64) -> Case<Carried> {
    let size = Size { modes: 4, contained: seed % 2 == 1, rotation: 0.1, free: false };
    let mut case = case(seed, size, &suspension(0.0));
    case.modes.damping.fill(0.0);
    case.modes.frequencies.iter_mut().for_each(|w| *w = w.min(12.0));
    let (wheel, isolated) = &mut case.devices;
    let joints = wheel.passive.values_mut().chain(isolated.carrier.passive.values_mut());
    joints.chain(isolated.carried.passive.values_mut()).for_each(|joint| joint.viscous = 0.0);
    case.craft =
        Spacecraft::flexible(&case.hub, &case.modes, &case.devices, &ON_MOUNT).expect("valid");
    case.inputs = Inputs::none_for(&case.craft);
    case
}

#[test]
fn momentum_and_energy_drift_by_the_order_of_the_step_only() {
    for seed in [SEED + 1160, SEED + 1161] {
        let [whole, halved] = [200, 400].map(|steps| drifts(closed(seed), steps));
        println!("seed {seed:#x}: {whole:?} {halved:?}");
        let ratios: [f64; 3] = std::array::from_fn(|k| whole[k] / halved[k]);
        assert!(ratios[..2].iter().all(|ratio| ORDER.contains(ratio)), "{ratios:?}");
        // Energy of an oscillation falls with the fifth power, the rest with the fourth.
        assert!(ratios[2] > *ORDER.start(), "{ratios:?}");
    }
}

/// A structure without modes is a rigid hub, whatever stands on it: also a platform on a platform.
#[test]
fn no_modes_are_the_rigid_hub() {
    type Stacked = Isolated<(Isolated<Vscmg>, ReactionWheel)>;
    let random = &mut Random::new(SEED + 1170);
    let mut worst = 0.0_f64;
    for _ in 0..4 {
        let inner = Isolated {
            carrier: crate::craft::device(random, 3.0),
            suspension: suspension(1.0),
            carried: crate::craft::device::<Vscmg>(random, 5.0),
        };
        let devices: Stacked = Isolated {
            carrier: crate::craft::device(random, 9.0),
            suspension: suspension(0.5),
            carried: (inner, crate::craft::device(random, 4.0)),
        };
        let size = Size { modes: 0, contained: false, rotation: 0.0, free: false };
        let (hub, modes) = structure(random, size, &[1.0]);
        let on_mount =
            platform::Data { carrier: 0, carried: (platform::Data { carrier: 7, carried: 7 }, 7) };
        let rigid = Spacecraft::new(&hub, &devices).expect("valid");
        let bending: Spacecraft<Stacked, Flexible<ListedModes>> =
            Spacecraft::flexible(&hub, &modes, &devices, &on_mount).expect("valid");
        let mut state = State::at_rest_for(&bending);
        let mut inputs = Inputs::none_for(&bending);
        draw_motion(random, size, &mut state);
        draw_inputs(random, &mut inputs);
        inputs.modal.mounts[0] = Wrench::none();
        for [coordinate, _] in state.devices.states_mut() {
            *coordinate *= 0.4;
        }
        inputs.gravity = Gravity::Central { mu: 900.0 };
        let (motion, acting) = (state.clone().with_modal(()), inputs.clone().with_modal(()));
        let expected = rigid.accelerations(&motion, &acting).expect("a solution");
        let found = bending.accelerations(&state, &inputs).expect("a solution");
        let list = |of: &Accelerations<Stacked>| -> Vec<f64> {
            let hub = of.r_b_n_ddot.iter().chain(&of.omega_dot).copied();
            hub.chain(of.devices.values()).collect()
        };
        worst = worst.max(block_error(&list(&found.clone().with_modal(())), &list(&expected), 0));

        let other = rigid.ledger(&motion, &acting, &expected).expect("a ledger");
        let own = bending.ledger(&state, &inputs, &found).expect("a ledger");
        for (own, other, unit) in [
            (own.kinetic, other.kinetic, other.kinetic),
            (own.gravity, other.gravity, other.gravity.abs()),
            (own.springs, other.springs, other.springs),
            (own.power.friction, other.power.friction, other.magnitude),
            (own.kinetic_rate, other.kinetic_rate, other.magnitude),
        ] {
            worst = worst.max((own - other).abs() / unit);
        }
    }
    println!("worst {worst:.1e}");
    assert!(worst <= LIMITS, "{worst:e}");
}

/// On a base that is held, a platform that gives along one slide is a mode of one mount: the same
/// spring, with a point mass whose shape is its mass's inverse root.
#[test]
fn a_platform_on_a_mode_is_a_platform_on_a_sliding_platform() {
    type Nested = Isolated<Isolated<Vscmg>>;
    let random = &mut Random::new(SEED + 1180);
    let mut worst = 0.0_f64;
    for _ in 0..6 {
        let (mass, stiffness, place) = (random.within(5.0, 20.0), 700.0, random.vector(0.8));
        let mut isolated = Isolated {
            carrier: crate::craft::device::<Platform>(random, 4.0),
            suspension: suspension(1.0),
            carried: crate::craft::device::<Vscmg>(random, 5.0),
        };
        let hub = precess_dynamics::Hub {
            m_b: 80.0 + mass,
            r_bc_b: Vector3::zeros(),
            i_b_bc: Matrix3::identity() * (90.0 + mass),
        };
        let shape = Vector3::x() / mass.sqrt();
        let point = precess_dynamics::ModalPoint {
            position: place,
            translation: vec![shape],
            rotation: vec![Vector3::zeros()],
        };
        let modes = precess_dynamics::Modes {
            frequencies: vec![(stiffness / mass).sqrt()],
            damping: vec![0.0],
            linear: vec![shape * mass],
            angular: vec![place.cross(&shape) * mass],
            mounts: vec![precess_dynamics::ModalMount { point, contained: None }],
        };
        let on_mount = platform::Data { carrier: 0, carried: 0 };
        isolated.carrier.r_p_b = place + random.vector(0.2);
        let bending: Spacecraft<_, Flexible<ListedModes>> =
            Spacecraft::flexible(&hub, &modes, &isolated, &on_mount).expect("valid");
        // The same from the outer platform's origin, at the mount.
        let mut carried = isolated;
        carried.carrier.r_p_b -= place;
        let mut outer = Platform::bare(mass, Matrix3::identity() * mass);
        outer.r_p_b = place;
        outer.passive.x_slide.stiffness = stiffness;
        let nested: Nested = Isolated { carrier: outer, suspension: Suspension::none(), carried };
        let rigid = Spacecraft::new(&hub, &nested).expect("valid");

        let size = Size { modes: 1, contained: false, rotation: 0.05, free: false };
        let mut state = State::at_rest_for(&bending);
        let mut inputs = Inputs::none_for(&bending);
        draw_motion(random, size, &mut state);
        draw_inputs(random, &mut inputs);
        (state.omega, state.r_b_n_dot) = (Vector3::zeros(), Vector3::zeros());
        (inputs.modal.forces[0], inputs.modal.mounts[0]) = (0.0, Wrench::none());
        inputs.hub = HubMode::Fixed;
        inputs.gravity = Gravity::None;
        for [coordinate, _] in state.devices.states_mut() {
            *coordinate *= 0.4;
        }
        let found = bending.accelerations(&state, &inputs).expect("a solution");

        let mut same = State::at_rest_for(&rigid);
        same.attitude = state.attitude;
        let root = mass.sqrt();
        same.devices.carrier.x = state.modal.eta[0] / root;
        same.devices.carrier.x_dot = state.modal.eta_dot[0] / root;
        same.devices.carried = state.devices;
        let mut given = Inputs::none_for(&rigid);
        given.hub = HubMode::Fixed;
        given.motors.carried = inputs.motors;
        let held = &mut given.modes.carrier;
        held.values_mut().skip(1).for_each(|mode| *mode = Mode::Locked);
        let expected = rigid.accelerations(&same, &given).expect("a solution");
        let list = |slide: f64, joints: Vec<f64>| -> Vec<f64> {
            std::iter::once(slide).chain(joints).collect()
        };
        let found = list(found.modal.eta_ddot[0] / root, found.devices.values().collect());
        let expected =
            list(expected.devices.carrier.x_ddot, expected.devices.carried.values().collect());
        let unit = largest(expected.iter().map(|a| a.abs()));
        let pairs = found.iter().zip(&expected);
        worst = worst.max(largest(pairs.map(|(a, b)| (a - b).abs())) / unit);
    }
    println!("worst {worst:.1e}");
    assert!(worst <= LIMITS, "{worst:e}");
}
