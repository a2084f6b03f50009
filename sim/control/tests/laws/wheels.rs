//! MRP feedback by the motors of three reaction wheels of the solver: `V' = -omega . P omega` with balanced wheels, to
//! rounding, and what imbalances add.

use nalgebra::{Matrix3, Vector3};
use precess_control::rotation::from_vector;
use precess_control::{
    Gyroscopic, Law as _, Motion, MrpFeedback, MrpGains, Reference, Sample, Tracking,
};
use precess_dynamics::{
    About, Attitude as _, Hub, Inputs, Mrp, Quaternion, ReactionWheel, Spacecraft, State,
};

use crate::random::Random;
use crate::rigid_body::{definite, vector};

type Wheels = [ReactionWheel; 3];
type Plant = Spacecraft<Wheels>;

/// Of the magnitudes of the terms: the solver's elimination, and the inertias found as differences of momenta.
const ROUNDING: f64 = 1e-13;

/// Wheels along inclined axes, off B, with a static and a dynamic imbalance.
fn plant(offset: f64, product: f64) -> Plant {
    let hub = Hub {
        m_b: 400.0,
        r_bc_b: Vector3::new(0.02, -0.01, 0.03),
        i_b_bc: Matrix3::new(200.0, 5.0, -3.0, 5.0, 180.0, 8.0, -3.0, 8.0, 120.0),
    };
    let wheel = |place: Vector3<f64>, turn: Vector3<f64>| ReactionWheel {
        mount: from_vector(&turn).dcm().transpose(),
        r_w_b: place,
        d: offset,
        i_w_wc: Matrix3::new(0.08, 0.0, product, 0.0, 0.05, 0.0, product, 0.0, 0.05),
        ..ReactionWheel::bare_wheel(6.0, Matrix3::identity())
    };
    let wheels = [
        wheel(Vector3::new(0.4, 0.1, 0.0), Vector3::new(0.1, 0.3, -0.2)),
        wheel(Vector3::new(-0.1, 0.5, 0.2), Vector3::new(0.0, 0.2, 1.4)),
        wheel(Vector3::new(0.0, -0.2, 0.4), Vector3::new(0.2, -1.3, 0.1)),
    ];
    Spacecraft::new(&hub, &wheels).unwrap()
}

/// Angular momentum about the centre of mass, expressed in B.
fn momentum(plant: &Plant, omega: Vector3<f64>, spins: [f64; 3]) -> Vector3<f64> {
    let mut state: State<Wheels, Quaternion> = State::at_rest();
    state.omega = omega;
    for (joint, spin) in state.devices.iter_mut().zip(spins) {
        joint.spin = spin;
    }
    plant.momentum(&state, About::CentreOfMass).unwrap().angular
}

/// Columns of a linear function.
fn columns(of: impl Fn(usize) -> Vector3<f64>) -> Matrix3<f64> {
    Matrix3::from_columns(&[of(0), of(1), of(2)])
}

/// Of a random state: `V' + omega_br . P omega_br` over the magnitudes of its terms.
fn remainder(plant: &Plant, balanced: &Plant, random: &mut Random) -> f64 {
    let one = |axis: usize| [0, 1, 2].map(|other| f64::from(u8::from(axis == other)));
    let axes = columns(|wheel| momentum(balanced, Vector3::zeros(), one(wheel)));
    let directions = columns(|wheel| axes.column(wheel).normalize());
    // The inertia that motors accelerate: without that of the wheels about their axes.
    let whole = columns(|axis| momentum(balanced, Vector3::from(one(axis)), [0.0; 3]));
    let inertia = whole - axes * directions.transpose();
    let inertia = (inertia + inertia.transpose()) / 2.0;

    let motion = Motion { attitude: from_vector(&vector(random, 1.5)), omega: vector(random, 0.1) };
    let reference = Reference {
        attitude: from_vector(&vector(random, 1.5)),
        omega: vector(random, 0.05),
        omega_dot: vector(random, 0.01),
    };
    let spins = [(); 3].map(|()| 300.0 * random.signed());
    let mut sample = Sample::new(motion, reference);
    sample.momentum = momentum(balanced, motion.omega, spins) - inertia * motion.omega;
    let gains = MrpGains { rate: definite(random, 20.0), ..MrpGains::new(5.0, 1.0) };
    let mut law = MrpFeedback::new(gains, inertia, Gyroscopic::Whole).unwrap();
    let torque = law.torque(&sample);

    let mut state: State<Wheels, Quaternion> = State::at_rest();
    (state.attitude, state.omega) = (motion.attitude, motion.omega);
    let mut inputs: Inputs<Wheels> = Inputs::none();
    let motors = directions.try_inverse().unwrap() * -torque;
    for (wheel, joint) in state.devices.iter_mut().enumerate() {
        (joint.theta, joint.spin) = (3.0 * random.signed(), spins[wheel]);
        inputs.motors[wheel].u_w = motors[wheel];
    }
    let omega_dot = plant.accelerations(&state, &inputs).unwrap().omega_dot;

    let error = Tracking::new(&motion, &reference);
    let sigma = error.sigma();
    let sigma_dot = Mrp(sigma).rate(&error.omega_br);
    let kinetic = error.omega_br.dot(&(inertia * error.omega_br_dot(&omega_dot)));
    let potential = 4.0 * gains.attitude * sigma.dot(&sigma_dot) / (1.0 + sigma.norm_squared());
    let dissipated = error.omega_br.dot(&(gains.rate * error.omega_br));
    let gyroscopic = motion.omega.norm() * sample.momentum.norm();
    let unit = error.omega_br.norm() * (torque.norm() + gyroscopic) + dissipated;
    (kinetic + potential + dissipated) / unit
}

#[test]
fn with_balanced_wheels_the_function_falls_by_the_rate_gain_only() {
    let balanced = plant(0.0, 0.0);
    let mut random = Random::new(41);
    let worst =
        (0..200).map(|_| remainder(&balanced, &balanced, &mut random).abs()).fold(0.0, f64::max);
    println!("balanced: {worst:.1e} of the terms");
    assert!(worst < ROUNDING, "{worst:e}");
}

/// Imbalances add what they exert on the hub at their speed: a part of the terms that falls with them.
#[test]
fn imbalances_add_a_remainder_in_proportion() {
    let balanced = plant(0.0, 0.0);
    let of = |share: f64| {
        let imbalanced = plant(5e-6 * share, 1e-5 * share);
        let mut random = Random::new(42);
        (0..200).map(|_| remainder(&imbalanced, &balanced, &mut random).abs()).fold(0.0, f64::max)
    };
    let (whole, tenth) = (of(1.0), of(0.1));
    println!("imbalances of 30 g mm and 100 g cm² a wheel: {whole:.1e} of the terms");
    assert!(whole > 1e4 * ROUNDING && whole < 1.0);
    assert!((whole / tenth / 10.0 - 1.0).abs() < 0.05, "{whole:e} {tenth:e}");
}
