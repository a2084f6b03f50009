//! Known answers: corner frequencies and coupling of an isolator with an offset centre of mass, a
//! platform that nothing holds, one that is locked, the pose in which its turns are dependent.

use nalgebra::{Matrix2, Matrix3, Vector2, Vector3};
use precess_dynamics::{
    About, Each, Hub, HubMode, Inputs, Isolated, JointStates, LoadAxes, Mode, Passive, Platform,
    ReactionWheel, Sgcmg, SolveError, Spacecraft, State, Suspension, platform,
};
use precess_tests::bounds::LIMITS;

use crate::craft::{Options, cluster, mixed};
use crate::tree::Solved;

/// Platform and wheel that stand still on a clamped hub: what a table test of an isolator is.
type Table = Isolated<[ReactionWheel; 1]>;

const MASS: f64 = 12.0;
const WHEEL: f64 = 3.0;
const HEIGHT: f64 = 0.25;
const SLIDE: f64 = 4000.0;
const TURN: f64 = 90.0;

/// Deflection of the linearisation, rad or m: its square is the relative error of a symmetric
/// difference.
const SMALL: f64 = 1e-6;

fn table() -> Spacecraft<Table> {
    let hub =
        Hub { m_b: 100.0, r_bc_b: Vector3::zeros(), i_b_bc: Matrix3::from_diagonal_element(9.0) };
    let slides = Passive::spring(SLIDE, 0.0);
    let turns = Passive::spring(TURN, 0.0);
    let springs = platform::PerJoint::of([slides, slides, slides, turns, turns, turns]);
    let devices = Isolated {
        carrier: Platform {
            r_p_b: Vector3::new(0.4, 0.0, 0.1),
            r_pc_p: Vector3::new(0.0, 0.0, HEIGHT),
            passive: springs,
            ..Platform::bare(MASS, Matrix3::from_diagonal(&Vector3::new(0.5, 0.6, 0.7)))
        },
        suspension: Suspension::none(),
        carried: [ReactionWheel {
            r_w_b: Vector3::new(0.0, 0.0, 2.0 * HEIGHT),
            ..ReactionWheel::bare_wheel(WHEEL, Matrix3::from_diagonal_element(0.02))
        }],
    };
    Spacecraft::new(&hub, &devices).expect("sound")
}

/// In the plane of x and beta: mass matrix of platform and wheel about P.
fn closed_form() -> Matrix2<f64> {
    let first = MASS * HEIGHT + WHEEL * 2.0 * HEIGHT;
    let second = 0.6 + MASS * HEIGHT.powi(2) + 0.02 + WHEEL * (2.0 * HEIGHT).powi(2);
    Matrix2::new(MASS + WHEEL, first, first, second)
}

#[test]
fn corner_frequencies_and_coupling_of_an_offset_mass_are_those_of_two_freedoms() {
    let craft = table();
    let mut inputs: Inputs<Table> = Inputs::none();
    inputs.hub = HubMode::Fixed;
    inputs.modes.carried[0].wheel = Mode::Locked;
    let response = |x: f64, beta: f64| {
        let mut state: State<Table> = State::at_rest();
        (state.devices.carrier.x, state.devices.carrier.beta) = (x, beta);
        let found = craft.accelerations(&state, &inputs).expect("regular").devices.carrier;
        Vector2::new(found.x_ddot, found.beta_ddot)
    };
    let slope = |x: f64, beta: f64| (response(x, beta) - response(-x, -beta)) / (2.0 * SMALL);
    let found = Matrix2::from_columns(&[slope(SMALL, 0.0), slope(0.0, SMALL)]);
    let mass = closed_form();
    let stiffness = Matrix2::from_diagonal(&Vector2::new(SLIDE, TURN));
    let expected = -(mass.try_inverse().expect("definite") * stiffness);
    assert!((found - expected).amax() < 1e-9 * expected.amax(), "{found} not {expected}");
    // Corner frequencies, rad/s: roots of det(K - w² M) = 0.
    let (sum, product) = (-found.trace(), found.determinant());
    let root = (0.25 * sum * sum - product).sqrt();
    let (a, b, c) =
        (mass.determinant(), -(SLIDE * mass[(1, 1)] + TURN * mass[(0, 0)]), SLIDE * TURN);
    for sign in [-1.0, 1.0] {
        let found = (0.5 * sum + sign * root).sqrt();
        let expected = ((-b + sign * (b * b - 4.0 * a * c).sqrt()) / (2.0 * a)).sqrt();
        assert!((found / expected - 1.0).abs() < 1e-9, "{found} not {expected}");
    }
}

#[test]
fn platform_that_nothing_holds_leaves_the_hub_as_if_it_were_alone() {
    for seed in 0..40 {
        let mut of = cluster(seed, &Options { wrenches: false, ..Options::default() });
        of.inputs.motors.carrier = platform::MotorTorques::all(0.0);
        of.inputs.force = Vector3::new(3.0, -1.0, 2.0);
        let alone = Spacecraft::new(&of.tree.hub, &[] as &[ReactionWheel; 0]).expect("sound");
        let state: State<[ReactionWheel; 0]> = State {
            r_b_n: of.state.r_b_n,
            r_b_n_dot: of.state.r_b_n_dot,
            attitude: of.state.attitude,
            omega: of.state.omega,
            devices: [],
            modal: (),
        };
        let inputs = Inputs { force: of.inputs.force, ..Inputs::none() };
        let expected = alone.accelerations(&state, &inputs).expect("regular");
        let found = of.solver.accelerations(&of.state, &of.inputs).expect("regular");
        // What platform and wheels require of each other is a hundred times what the hub does.
        let Solved { conditions, .. } = of.tree.accelerations();
        let (r, omega) =
            (found.r_b_n_ddot - expected.r_b_n_ddot, found.omega_dot - expected.omega_dot);
        let unit = |at: usize| conditions[at].max(conditions[at + 1]).max(conditions[at + 2]);
        assert!(r.amax() < 50.0 * f64::EPSILON * unit(0), "seed {seed}: {r}");
        assert!(omega.amax() < 50.0 * f64::EPSILON * unit(3), "seed {seed}: {omega}");
    }
}

/// The cluster's devices on a hub that has the platform in it, where it is.
fn rigid(
    of: &Isolated<([ReactionWheel; 2], Sgcmg)>,
    hub: &Hub,
    state: &platform::Joints,
) -> (Hub, ([ReactionWheel; 2], Sgcmg)) {
    let turn = |axis: Vector3<f64>, angle: f64| nalgebra::Rotation3::new(axis * angle).into_inner();
    let turned = turn(Vector3::x(), state.alpha)
        * turn(Vector3::y(), state.beta)
        * turn(Vector3::z(), state.gamma);
    let of_platform = &of.carrier;
    let axes = of_platform.mount * turned;
    let p = of_platform.r_p_b + of_platform.mount * Vector3::new(state.x, state.y, state.z);
    let (wheels, gyro) = of.carried;
    let wheels = wheels.map(|wheel| ReactionWheel {
        mount: axes * wheel.mount,
        r_w_b: p + axes * wheel.r_w_b,
        ..wheel
    });
    let gyro = Sgcmg { mount: axes * gyro.mount, r_g_b: p + axes * gyro.r_g_b, ..gyro };
    let centre = p + axes * of_platform.r_pc_p;
    let m_b = hub.m_b + of_platform.m_p;
    let r_bc_b = (hub.m_b * hub.r_bc_b + of_platform.m_p * centre) / m_b;
    let parallel = |mass: f64, r: Vector3<f64>| {
        mass * (Matrix3::identity() * r.norm_squared() - r * r.transpose())
    };
    let inertia = axes * of_platform.i_p_pc * axes.transpose();
    let i_b_bc = hub.i_b_bc
        + parallel(hub.m_b, hub.r_bc_b - r_bc_b)
        + inertia
        + parallel(of_platform.m_p, centre - r_bc_b);
    (Hub { m_b, r_bc_b, i_b_bc: (i_b_bc + i_b_bc.transpose()) * 0.5 }, (wheels, gyro))
}

#[test]
fn locked_platform_is_part_of_the_hub() {
    for seed in 0..40 {
        let mut of = cluster(seed, &Options::default());
        let devices = of.devices;
        for [_, rate] in of.state.devices.carrier.states_mut() {
            *rate = 0.0;
        }
        of.inputs.modes.carrier = platform::PerJoint::all(Mode::Locked);
        let found = of.solver.accelerations(&of.state, &of.inputs).expect("regular");
        let (hub, set) = rigid(&devices, &of.tree.hub, &of.state.devices.carrier);
        let craft = Spacecraft::new(&hub, &set).expect("sound");
        let state: State<([ReactionWheel; 2], Sgcmg)> = State {
            r_b_n: of.state.r_b_n,
            r_b_n_dot: of.state.r_b_n_dot,
            attitude: of.state.attitude,
            omega: of.state.omega,
            devices: of.state.devices.carried,
            modal: (),
        };
        let mut inputs: Inputs<([ReactionWheel; 2], Sgcmg)> = Inputs::none();
        (inputs.motors, inputs.modes) = (of.inputs.motors.carried, of.inputs.modes.carried);
        let expected = craft.accelerations(&state, &inputs).expect("regular");
        let differ = |found: Vec<f64>, expected: Vec<f64>, block: &str| {
            let unit = expected.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
            for (found, expected) in found.iter().zip(&expected) {
                let off = (found - expected).abs() / unit;
                assert!(off < LIMITS, "seed {seed}, {block}: {found}, not {expected}: {off:e}");
            }
        };
        let of_vector = |v: &Vector3<f64>| v.iter().copied().collect();
        differ(of_vector(&found.r_b_n_ddot), of_vector(&expected.r_b_n_ddot), "B");
        differ(of_vector(&found.omega_dot), of_vector(&expected.omega_dot), "omega");
        let carried = |of: &(
            [precess_dynamics::reaction_wheel::JointAccelerations<f64>; 2],
            precess_dynamics::sgcmg::JointAccelerations<f64>,
        )| of.values().collect();
        differ(carried(&found.devices.carried), carried(&expected.devices), "devices");
        assert!(found.devices.carrier.array().iter().all(|q_ddot| *q_ddot == 0.0));
    }
}

/// Active isolation: the motors that prescribed joints need give those accelerations when driven.
#[test]
fn computed_motors_drive_what_was_prescribed() {
    let options = Options { springs: true, wrenches: true, modes: true, ..Options::default() };
    for seed in 0..40 {
        let mut of = cluster(seed, &options);
        let found = of.solver.accelerations(&of.state, &of.inputs).expect("regular");
        let loads = of.solver.loads(&of.state, &of.inputs, &found, LoadAxes::Body).expect("finite");
        for (joint, mode) in of.inputs.modes.carrier.values_mut().enumerate() {
            if let Mode::Prescribed(_) = mode {
                *mode = Mode::Driven;
                let motor = of.inputs.motors.carrier.values_mut().nth(joint).expect("a joint");
                *motor = loads.devices.carrier.motors.array()[joint];
                (of.tree.links[joint].mode, of.tree.links[joint].motor) = (Mode::Driven, *motor);
            }
        }
        let driven = of.solver.accelerations(&of.state, &of.inputs).expect("regular");
        let Solved { conditions, .. } = of.tree.accelerations();
        let joints = driven.devices.values().zip(found.devices.values());
        for ((driven, found), condition) in joints.zip(&conditions[6..]) {
            let bound = 100.0 * f64::EPSILON * condition;
            assert!((driven - found).abs() <= bound, "seed {seed}: {driven}, not {found}");
        }
    }
}

#[test]
fn turns_are_singular_at_a_quarter_turn_of_beta_unless_they_are_held() {
    let craft = table();
    let mut state: State<Table> = State::at_rest();
    state.devices.carrier.beta = core::f64::consts::FRAC_PI_2;
    let mut inputs: Inputs<Table> = Inputs::none();
    match craft.accelerations(&state, &inputs) {
        Err(SolveError::Singular { device: Some(0), joint: Some("x turn"), pivot, bound }) => {
            assert!(pivot.abs() <= bound);
        }
        other => panic!("{other:?}"),
    }
    inputs.modes.carrier.x_turn = Mode::Locked;
    let found = craft.accelerations(&state, &inputs).expect("two turns are independent");
    assert!(found.devices.values().all(f64::is_finite));
    // Near it the turns are still regular.
    inputs.modes.carrier.x_turn = Mode::Driven;
    state.devices.carrier.beta -= 1e-4;
    assert!(craft.accelerations(&state, &inputs).is_ok());
}

#[test]
fn stop_of_a_platform_keeps_momentum_and_loses_energy() {
    for seed in 0..40 {
        let mut of = mixed(seed, &Options { springs: true, ..Options::default() });
        let before = of.solver.energy_and_momentum(&of.state, About::CentreOfMass).expect("finite");
        of.inputs.modes.1.carrier = platform::PerJoint::all(Mode::Locked);
        assert!(matches!(
            of.solver.accelerations(&of.state, &of.inputs),
            Err(SolveError::LockedJointMoves { device: 1, .. })
        ));
        let stopped = of.solver.stop(&of.state, &of.inputs).expect("regular");
        let state = &stopped.state;
        assert!(state.devices.1.carrier.states().all(|[_, rate]| rate == 0.0));
        let after = of.solver.energy_and_momentum(state, About::CentreOfMass).expect("finite");
        let unit = before.energy.sqrt() * of.solver.mass().sqrt();
        assert!((before.momentum.linear - after.momentum.linear).norm() < 1e-12 * unit);
        assert!((before.momentum.angular - after.momentum.angular).norm() < 1e-12 * unit);
        let lost = before.energy - after.energy;
        assert!(stopped.energy_lost > 0.0, "seed {seed}");
        assert!((stopped.energy_lost - lost).abs() < 1e-12 * before.energy, "seed {seed}");
    }
}
