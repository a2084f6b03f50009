//! Arrays of wheels: the least largest acceleration, and null motion out of bands of speed.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::{
    BalancedReactionWheel, Hub, KeepOut, Spacecraft, State, Steered, SteeringLaw, SteeringMatrix,
    SteeringTerms,
};
use precess_tests::random::{Random, SEED};

/// Of a wheel about its axis, kg m².
const J_11: f64 = 0.02;

fn matrix<const N: usize>(axes: [Vector3<f64>; N], speeds: [f64; N]) -> SteeringMatrix<f64, N> {
    let hub = Hub { m_b: 100.0, r_bc_b: Vector3::zeros(), i_b_bc: Matrix3::identity() * 20.0 };
    let devices = axes.map(|axis| {
        let x = axis.normalize();
        let other = if x.x.abs() < 0.7 { Vector3::x() } else { Vector3::y() };
        let y = x.cross(&other).normalize();
        BalancedReactionWheel {
            mount: Matrix3::from_columns(&[x, y, x.cross(&y)]),
            ..BalancedReactionWheel::bare_wheel(2.0, J_11, 0.6 * J_11)
        }
    });
    let craft = Spacecraft::new(&hub, &devices).unwrap();
    let mut state: State<[BalancedReactionWheel; N]> = State::at_rest();
    for (joints, speed) in state.devices.iter_mut().zip(speeds) {
        joints.spin = speed;
    }
    let terms: SteeringTerms<f64, N> = craft.steering_terms(&state).unwrap();
    terms.matrix(&[Steered::Acceleration; N])
}

fn largest(list: &[f64]) -> f64 {
    list.iter().fold(0.0, |most: f64, x| most.max(x.abs()))
}

/// The least largest command by its dual: no direction demands more. Sampled directions, then steps at random from the best
/// one: where the torque is ahead its share has one maximum, since it is a linear function over a convex one.
fn by_directions<const N: usize>(matrix: &SteeringMatrix<f64, N>, torque: Vector3<f64>) -> f64 {
    let mut random = Random::new(SEED);
    let share = |y: Vector3<f64>| {
        let sum: f64 = matrix.columns.iter().map(|q| q.dot(&y).abs()).sum();
        y.dot(&torque).abs() / sum
    };
    let (mut best, mut found) = (torque, share(torque));
    for k in 0..4000 {
        let step = if k < 1000 { 1.0 } else { 0.995_f64.powi(k - 1000) };
        let next = if k < 1000 { random.vector(1.0) } else { best + random.vector(step) };
        if share(next) > found {
            (best, found) = (next.normalize(), share(next));
        }
    }
    found
}

#[test]
fn the_largest_command_is_the_least_that_can_be() {
    let mut random = Random::new(SEED);
    for _ in 0..precess_tests::cases(100) {
        let axes = core::array::from_fn::<_, 6, _>(|_| random.vector(1.0));
        let matrix = matrix(axes, [0.0; 6]);
        let torque = random.vector(0.1);
        let found = matrix.least_largest(&torque).unwrap();
        assert!((matrix.torque(&found.commands) - torque).norm() < 1e-13);
        assert!(found.torque_error.norm() < 1e-13);
        let (most, bound) = (largest(&found.commands), by_directions(&matrix, torque));
        // Directions come near the best one from below.
        assert!(most >= bound * (1.0 - 1e-12) && most < 1.001 * bound, "{most} {bound}");
        let least_norm = SteeringLaw::exact().allocate(&matrix, &torque).unwrap();
        assert!(most <= largest(&least_norm.commands) * (1.0 + 1e-12));
    }
}

/// Four wheels whose axes lean alike: along the axis of symmetry all are alike; across it, the known 1/(2 sqrt 2 s).
#[test]
fn four_wheels_of_a_pyramid_have_the_known_envelope() {
    let (s, c) = (0.6_f64, 0.8_f64);
    let axes = [[s, 0.0, c], [0.0, s, c], [-s, 0.0, c], [0.0, -s, c]].map(Vector3::from);
    let matrix = matrix(axes, [0.0; 4]);
    for (torque, expected) in [
        (Vector3::z(), 1.0 / (4.0 * c)),
        (Vector3::x(), 1.0 / (2.0 * s)),
        (Vector3::new(1.0, 1.0, 0.0), 1.0 / (2.0 * s)),
    ] {
        let found = matrix.least_largest(&torque).unwrap();
        let most = largest(&found.commands) * J_11;
        assert!((most - expected).abs() < 1e-13, "{torque}: {most} {expected}");
        assert!((matrix.torque(&found.commands) - torque).norm() < 1e-13);
    }
    let flat = [[s, 0.0, 0.0], [0.0, s, 0.0], [-s, 0.0, 0.0], [0.0, -s, 0.0]].map(Vector3::from);
    assert!(self::matrix(flat, [0.0; 4]).least_largest(&Vector3::x()).is_err());
}

/// Redundant wheels a tenth of a degree apart share their axis's torque, as if their axes were one.
#[test]
fn nearly_parallel_wheels_share_their_torque() {
    let (small, torque) = (1.75e-3_f64, Vector3::new(0.3, -0.2, 0.1));
    let axes = [
        [1.0, 0.0, 0.0],
        [1.0, small, 0.0],
        [0.0, 1.0, 0.0],
        [small, 1.0, 0.0],
        [0.0, 0.0, 1.0],
        [0.0, small, 1.0],
    ];
    let matrix = matrix(axes.map(Vector3::from), [0.0; 6]);
    let found = matrix.least_largest(&torque).unwrap();
    assert!((matrix.torque(&found.commands) - torque).norm() < 1e-13);
    let most = largest(&found.commands) * J_11;
    // Two wheels bear 0.3 N m along x, less than a share of the others' lean.
    assert!(most <= 0.15 * (1.0 + 2.0 * small) && most > 0.149, "{most}");
    let bound = by_directions(&matrix, torque) * J_11;
    assert!(most >= bound * (1.0 - 1e-12), "{most} {bound}");
}

/// Small wheels in single precision: products of several inertias are below the smallest number.
#[test]
fn small_wheels_in_single_precision_have_the_least_largest_command() {
    let (s, c, inertia) = (0.6_f32, 0.8_f32, 1e-5_f32);
    let axes = [[s, 0.0, c], [0.0, s, c], [-s, 0.0, c], [0.0, -s, c]];
    let columns = axes.map(|axis| Vector3::from(axis) * inertia);
    let matrix = SteeringMatrix { columns, drift: Vector3::zeros() };
    let found = matrix.least_largest(&Vector3::new(1e-3, 1e-3, 0.0)).unwrap();
    let most = found.commands.iter().fold(0.0_f32, |most, x| most.max(x.abs()));
    let expected = 1e-3 / (2.0 * s) / inertia;
    assert!((most - expected).abs() < 1e-4 * expected, "{most} {expected}");
}

/// The wheel inside the band leaves it along the null space of the array; the torque stays zero.
#[test]
fn null_motion_takes_a_wheel_out_of_a_band_without_torque() {
    let (s, c) = (0.6_f64, 0.8_f64);
    let axes = [[s, 0.0, c], [0.0, s, c], [-s, 0.0, c], [0.0, -s, c]].map(Vector3::from);
    let band = KeepOut { lower: 180.0, upper: 220.0 };
    let mut speeds = [195.0, -150.0, 150.0, -230.0];
    let law = SteeringLaw::exact();
    for _ in 0..4000 {
        let matrix = matrix(axes, speeds);
        let preferred = speeds.map(|speed| band.acceleration(speed, 1.0));
        let null = law.null_motion(&matrix, &preferred).unwrap();
        assert!(matrix.times(&null).norm() < 1e-14);
        for (speed, acceleration) in speeds.iter_mut().zip(null) {
            *speed += 0.01 * acceleration;
        }
    }
    assert!(speeds[0] <= 180.0, "{speeds:?}");
    assert_eq!(band.acceleration(179.0, 1.0), 0.0);
    assert_eq!((band.acceleration(190.0, 2.0), band.acceleration(215.0, 2.0)), (-28.0, 18.0));
}
