//! A reaction wheel on flexible bearings: whirls and translation modes of the linearised kernel against
//! the closed form, the power balance in any motion, and the stiff wheel as the bearings stiffen.
//!
//! Run with `--nocapture` to see the figures.

use std::f64::consts::PI;

use nalgebra::{DMatrix, Matrix3, Vector3};
use precess_dynamics::flexible_reaction_wheel::PerJoint;
use precess_dynamics::kind::Kind;
use precess_dynamics::{
    FlexibleReactionWheel, Hub, HubMode, Inputs, JointStates, LoadAxes, Outputs, Passive,
    ReactionWheel, Spacecraft, State, Variable, Wrench,
};
use precess_tests::bounds::POWER_EPSILONS;
use precess_tests::random::Random;

/// The bound of the project on frequencies against the closed form.
const FREQUENCY: f64 = 1e-9;

/// Rotor: mass, axial and transverse moment of inertia, kg and kg m².
pub(crate) const M: f64 = 4.0;
pub(crate) const I_S: f64 = 0.03;
pub(crate) const I_R: f64 = 0.02;

type Soft = FlexibleReactionWheel;

pub(crate) fn hub() -> Hub {
    let i_b_bc = Matrix3::new(12.0, 0.4, -0.3, 0.4, 10.0, 0.2, -0.3, 0.2, 9.0);
    Hub { m_b: 80.0, r_bc_b: Vector3::new(0.02, -0.03, 0.01), i_b_bc }
}

/// Springs and dampers of the slides (axial, radial) and of the tilts.
fn bearings([axial, radial, tilt]: [Passive; 3]) -> PerJoint<Passive> {
    PerJoint {
        axial_slide: axial,
        radial_slide_y: radial,
        radial_slide_z: radial,
        tilt_y: tilt,
        tilt_z: tilt,
        wheel: Passive::none(),
    }
}

/// Joints of the bearings: three slides, two tilts.
pub(crate) const BEARINGS: usize = 5;

/// Stiffness of the axial and radial slides and of the tilts, N/m and N m/rad.
pub(crate) const STIFFNESS: [f64; 3] = [3.0e4, 5.0e4, 900.0];

/// Steady spins, rad/s.
pub(crate) const SPINS: [f64; 4] = [0.0, 40.0, 300.0, -628.0];

/// The modes of the bearings, which are five joints from the first of these on, about a state in which they rest on a
/// fixed hub: `w = g / 2 +- sqrt(g^2 / 4 + k / I_r)` with `g = I_s Omega / I_r`, and `sqrt(k / m)`. The worst error.
pub(crate) fn error_of_modes<K: Kind<Scalar = f64>>(
    device: &K,
    first: usize,
    state: &State<K>,
    inputs: &Inputs<K>,
    spin: f64,
) -> f64 {
    let [k_a, k_r, k_t] = STIFFNESS;
    let half = I_S * spin / (2.0 * I_R);
    let root = (half * half + k_t / I_R).sqrt();
    let [axial, radial] = [k_a, k_r].map(|k| (k / M).sqrt());
    let mut expected = [axial, radial, radial, root + half, root - half];
    expected.sort_by(f64::total_cmp);
    let (modes, damping) = modes(device, first, state, inputs);
    assert_eq!(modes.len(), BEARINGS, "{spin}: {modes:?}");
    assert!(damping < FREQUENCY * expected[BEARINGS - 1], "{spin}: {damping:e}");
    let errors = modes.iter().zip(expected).map(|(mode, expected)| (mode / expected - 1.0).abs());
    let worst = errors.fold(0.0, f64::max);
    assert!(worst < FREQUENCY, "{spin}: {modes:?}, {expected:?}");
    worst
}

/// The angular frequencies of the modes, rad/s, ascending, and the largest real part of an eigenvalue, 1/s.
fn modes<K: Kind<Scalar = f64>>(
    device: &K,
    first: usize,
    state: &State<K>,
    inputs: &Inputs<K>,
) -> (Vec<f64>, f64) {
    let craft = Spacecraft::new(&hub(), device).expect("valid parameters");
    let outputs = Outputs { momentum: None, loads: None };
    let linear = craft.linearize(state, inputs, &outputs).expect("a state");
    // The rotor's angle and rate are no modes: nothing holds them.
    let of_bearings = |variable: &Variable| {
        variable.joint().is_some_and(|joint| (first..first + BEARINGS).contains(&joint))
    };
    let wanted: Vec<_> =
        (0..linear.states.len()).filter(|row| of_bearings(&linear.states[*row])).collect();
    assert_eq!(wanted.len(), 2 * BEARINGS);
    let a = DMatrix::from_fn(wanted.len(), wanted.len(), |row, column| {
        linear.a[(wanted[row], wanted[column])]
    });
    let values = a.complex_eigenvalues();
    let mut modes: Vec<f64> = values.iter().filter(|value| value.im > 0.0).map(|v| v.im).collect();
    modes.sort_by(f64::total_cmp);
    (modes, values.iter().map(|value| value.re.abs()).fold(0.0, f64::max))
}

#[test]
fn whirls_and_translations_are_those_of_the_closed_form() {
    let inertia = Matrix3::from_diagonal(&Vector3::new(I_S, I_R, I_R));
    let wheel = Soft {
        passive: bearings(STIFFNESS.map(|k| Passive::spring(k, 0.0))),
        ..Soft::bare_wheel(M, inertia)
    };
    let inputs = Inputs { hub: HubMode::Fixed, ..Inputs::<Soft>::none() };
    let of_spin = |spin| {
        let mut state: State<Soft> = State::at_rest();
        (state.devices.theta, state.devices.spin) = (0.7, spin);
        error_of_modes(&wheel, 0, &state, &inputs, spin)
    };
    println!("worst {:.1e} of a frequency", SPINS.map(of_spin).into_iter().fold(0.0, f64::max));
}

/// A wheel with an imbalance on damped bearings, off the reference point of the hub.
fn imbalanced() -> Soft {
    let inertia = Matrix3::new(I_S, 2e-4, -3e-4, 2e-4, I_R, 1e-4, -3e-4, 1e-4, I_R);
    Soft {
        r_sx_b: Vector3::new(0.4, -0.2, 0.3),
        d: 1e-3,
        passive: bearings(
            [(3e4, 20.0), (5e4, 30.0), (900.0, 0.2)].map(|(k, c)| Passive::spring(k, c)),
        ),
        ..Soft::bare_wheel(M, inertia)
    }
}

/// State and inputs over the ranges of a real wheel: bearings give by a millimetre and a milliradian.
/// The hub turns at up to `turning`, rad/s, and moves at up to `speed`, m/s.
fn drawn(random: &mut Random, [turning, speed]: [f64; 2]) -> (State<Soft>, Inputs<Soft>) {
    let mut state: State<Soft> = State::at_rest();
    for (joint, [coordinate, rate]) in state.devices.states_mut().enumerate() {
        let [give, fast] = if joint < BEARINGS { [1e-3, 0.1] } else { [PI, 600.0] };
        (*coordinate, *rate) = (random.within(-give, give), random.within(-fast, fast));
    }
    state.omega = Vector3::from_fn(|_, _| random.within(-turning, turning));
    state.r_b_n_dot = Vector3::from_fn(|_, _| random.within(-speed, speed));
    let mut inputs = Inputs::<Soft>::none();
    inputs.motors.u_w = random.within(-0.2, 0.2);
    inputs.torque_b = Vector3::from_fn(|_, _| random.within(-1.0, 1.0));
    (state, inputs)
}

/// The largest residual of the power balance over random states, in eps: of the ledger's magnitude, and of
/// that with the powers that cancel in it. These are the power that the load of the mount carries from the hub
/// to the device, and those of the force `U_s Omega^2` and the moment `U_d Omega^2` of the imbalance on what
/// carries the rotor.
fn residuals(rates: [f64; 2]) -> [f64; 2] {
    let wheel = imbalanced();
    let craft = Spacecraft::new(&hub(), &wheel).expect("valid parameters");
    let random = &mut Random::new(0x50F7);
    let mut largest = [0.0_f64; 2];
    for _ in 0..1000 {
        let (state, inputs) = drawn(random, rates);
        let found = craft.accelerations(&state, &inputs).expect("a state");
        let ledger = craft.ledger(&state, &inputs, &found).expect("a state");
        let loads = craft.loads(&state, &inputs, &found, LoadAxes::Hub).expect("a state");
        // The axes of the hub are those of N.
        let Wrench { force, moment } = loads.devices.mount;
        let at_mount = state.r_b_n_dot + state.omega.cross(&wheel.r_sx_b);
        let carried = force.component_mul(&at_mount).abs().sum()
            + moment.component_mul(&state.omega).abs().sum();
        let q = &state.devices;
        let slides = q.x_dot.abs() + q.y_dot.abs() + q.z_dot.abs();
        let tilts = q.tilt_y_dot.abs() + q.tilt_z_dot.abs();
        let (u_s, u_d) = (M * wheel.d, wheel.i_w_wc.m12.hypot(wheel.i_w_wc.m13));
        let imbalance = q.spin.powi(2)
            * (u_s * (slides + at_mount.abs().sum()) + u_d * (tilts + state.omega.abs().sum()));
        let units = [ledger.magnitude, ledger.magnitude + carried + imbalance];
        for (largest, unit) in largest.iter_mut().zip(units) {
            *largest = largest.max((ledger.residual / unit).abs() / f64::EPSILON);
        }
    }
    largest
}

/// The change of the kinetic energy is the power of motors, springs and dampers, in any motion.
///
/// A rotor on bearings turns about its own principal axis: the force and the moment of its imbalance, here up to
/// 1440 N and 130 N m, are balanced by its own acceleration and not by its springs, which carry 50 N and 1 N m. The
/// ledger adds the loads of all bodies before it multiplies by velocities, so what cancels in this sum is not in
/// its magnitude, but its rounding is in the residual. With those powers as part of the unit, the bound of
/// the suites holds at every rate.
#[test]
fn power_fed_in_is_the_rate_of_the_energy() {
    for rates in [[0.0, 0.0], [0.1, 0.01], [1.0, 1.0], [1.0, 10.0]] {
        let [of_magnitude, of_all] = residuals(rates);
        println!(
            "hub up to {} rad/s, {} m/s: {of_magnitude:.1} eps of the ledger's magnitude, \
             {of_all:.1} eps with what cancels in it",
            rates[0], rates[1]
        );
        assert!(of_all <= POWER_EPSILONS, "{rates:?}: {of_all} eps");
    }
}

/// The motion of a free hub with an imbalanced wheel differs from that with the stiff wheel as one over
/// the stiffness.
#[test]
fn stiff_wheel_is_the_limit_as_one_over_the_stiffness() {
    let (d, spin, omega) = (1e-3, 8.0, Vector3::new(0.03, -0.05, 0.04));
    let inertia = Matrix3::new(I_S, 2e-4, -3e-4, 2e-4, I_R, 0.0, -3e-4, 0.0, I_R);
    let r_w_b = Vector3::new(0.4, -0.2, 0.3);
    let stiff = ReactionWheel { r_w_b, d, ..ReactionWheel::bare_wheel(M, inertia) };
    let mut still: State<ReactionWheel> = State::at_rest();
    (still.omega, still.devices.spin) = (omega, spin);
    let slow = run(&stiff, still).omega;

    falls_as_one_over_the_stiffness(1.0, |[slide, tilt]| {
        let soft = Soft {
            r_sx_b: r_w_b,
            d,
            passive: bearings([slide, slide, tilt]),
            ..Soft::bare_wheel(M, inertia)
        };
        let mut state: State<Soft> = State::at_rest();
        (state.omega, state.devices.spin) = (omega, spin);
        (run(&soft, state).omega - slow).norm()
    });
}

/// How far the motion is off with springs of slides and tilts, the softest first, that are each four times as stiff.
pub(crate) fn falls_as_one_over_the_stiffness(softest: f64, off: impl Fn([Passive; 2]) -> f64) {
    let off = [1.0, 4.0, 16.0].map(|scale| {
        let scale = scale * softest;
        // Springs, and dampers in their proportion that let the transient of the start decay.
        let spring = |k: f64, m: f64| Passive::spring(k * scale, 1.2 * (k * scale * m).sqrt());
        off([spring(4e4, M), spring(400.0, I_R)])
    });
    let ratios = [off[0] / off[1], off[1] / off[2]];
    println!("{off:?} rad/s off, ratios {ratios:?}");
    // Four times the stiffness, a quarter of the distance; what is left of the next order halves.
    assert!(ratios.iter().all(|ratio| (ratio - 4.0).abs() < 0.05), "{off:?}, {ratios:?}");
    assert!((ratios[1] - 4.0).abs() < (ratios[0] - 4.0).abs(), "{off:?}, {ratios:?}");
}

/// The state after 0.4 s with nothing acting.
pub(crate) fn run<K: Kind<Scalar = f64>>(device: &K, mut state: State<K>) -> State<K> {
    let craft = Spacecraft::new(&hub(), device).expect("valid parameters");
    for _ in 0..4000 {
        state = craft.step(&state, &Inputs::none(), 1e-4).expect("a state");
    }
    state
}
