//! Invariance of the accelerations under the order of devices, the inertial frame and the splitting
//! of a device; and the symmetry of the mass matrix.
//!
//! Run with `--nocapture` to see the figures.

use nalgebra::Vector3;
use precess_dynamics::dgvscmg::MotorTorques;
use precess_dynamics::{
    About, Accelerations, Dgvscmg, Inputs, Quaternion, Real, Scalar, SolveError, State,
};
use precess_tests::blocks::{Figures, errors, largest, worst};
use precess_tests::bounds::{LIMITS, ROUTES_IN_DOUBLE_DOUBLE};
use precess_tests::case::Case;
use precess_tests::cases;
use precess_tests::double_double::DoubleDouble as Wide;
use precess_tests::newton_euler::to_list;
use precess_tests::newton_euler::vector::Vector;
use precess_tests::random::{Sample, Visitor, visit};

/// Spacecraft tried for each claim.
const SPACECRAFT: u64 = 180;

/// A claim about one spacecraft, measured as an error against a bound.
struct Claim<F> {
    error: F,
    bound: f64,
    figures: Figures,
}

/// The error of a claim on one spacecraft.
trait Measure {
    fn measure<const N: usize>(&self, sample: &Sample<N>) -> f64;
}

impl<F: Measure> Visitor for Claim<F> {
    fn visit<const N: usize>(&mut self, sample: &Sample<N>) {
        let error = self.error.measure(sample);
        self.figures.add(error);
        let bound = self.bound;
        assert!(error <= bound, "{error:e} is above {bound:e} ({sample})");
    }
}

fn check(name: &str, bound: f64, error: impl Measure) {
    let mut claim = Claim { error, bound, figures: Figures::default() };
    visit(cases(SPACECRAFT), &mut claim);
    let Claim { figures, .. } = claim;
    println!("{name}: worst {:.2e}, median {:.2e}", figures.worst(), figures.median());
}

/// The inverse mass matrix, column by column: the accelerations of a spacecraft at rest under one
/// unit force or torque at a time. Largest asymmetry, in units of the geometric mean of the
/// diagonal entries.
fn asymmetry<const N: usize, T: Scalar>(sample: &Sample<N>) -> f64 {
    let mut case = sample.case::<T>();
    let (zero, one) = (T::from_f64(0.0), T::from_f64(1.0));
    case.state.omega = Vector3::from_element(zero);
    for joints in &mut case.state.devices {
        (joints.gamma_o_dot, joints.gamma_i_dot, joints.spin) = (zero, zero, zero);
    }
    let columns: Vec<_> = (0..6 + 3 * N)
        .map(|index| {
            let mut case = case;
            case.inputs = Inputs::none();
            match index {
                0..3 => case.inputs.force[index] = one,
                3..6 => case.inputs.torque_b[index - 3] = one,
                _ => {
                    let motor = &mut case.inputs.motors[(index - 6) / 3];
                    *[&mut motor.u_o, &mut motor.u_i, &mut motor.u_w][index % 3] = one;
                }
            }
            to_list(&case.solved(sample))
        })
        .collect();
    let pairs = (0..columns.len()).flat_map(|i| (0..i).map(move |k| (i, k)));
    largest(pairs.map(|(i, k)| {
        let unit = (columns[i][i] * columns[k][k]).sqrt();
        ((columns[i][k] - columns[k][i]).abs() * unit.recip()).to_f64()
    }))
}

#[test]
fn inverse_mass_matrix_of_the_solver_is_symmetric() {
    struct InDouble;
    impl Measure for InDouble {
        fn measure<const N: usize>(&self, sample: &Sample<N>) -> f64 {
            asymmetry::<N, f64>(sample)
        }
    }
    struct InDoubleDouble;
    impl Measure for InDoubleDouble {
        fn measure<const N: usize>(&self, sample: &Sample<N>) -> f64 {
            asymmetry::<N, Wide>(sample)
        }
    }
    check("symmetry", LIMITS, InDouble);
    check("symmetry in double-double", ROUTES_IN_DOUBLE_DOUBLE, InDoubleDouble);
}

#[test]
fn order_of_devices_changes_nothing() {
    struct Reversed;
    impl Measure for Reversed {
        fn measure<const N: usize>(&self, sample: &Sample<N>) -> f64 {
            let mut case = sample.case::<f64>();
            let expected = case.solved(sample);
            case.devices.reverse();
            case.state.devices.reverse();
            case.inputs.motors.reverse();
            let mut found = case.solved(sample);
            found.devices.reverse();
            worst(errors(&found, &expected)).0
        }
    }
    check("order of devices", LIMITS, Reversed);
}

/// Where the spacecraft is, how fast B moves and how it is turned does not enter: the same bits.
#[test]
fn inertial_frame_changes_nothing() {
    struct Elsewhere;
    impl Measure for Elsewhere {
        fn measure<const N: usize>(&self, sample: &Sample<N>) -> f64 {
            let case = sample.case::<f64>();
            let mut elsewhere = case;
            elsewhere.state.r_b_n = Vector3::zeros();
            elsewhere.state.r_b_n_dot = Vector3::new(-3.0, 2.0, 7.0e3);
            elsewhere.state.attitude = Quaternion { q0: 0.6, q1: 0.0, q2: -0.8, q3: 0.0 };
            if elsewhere.solved(sample) == case.solved(sample) { 0.0 } else { f64::INFINITY }
        }
    }
    check("inertial frame", 0.0, Elsewhere);
}

/// A device and its half: every mass, inertia and torque halved.
fn halved(device: &Dgvscmg, motor: &MotorTorques) -> (Dgvscmg, MotorTorques) {
    let device = Dgvscmg {
        m_go: device.m_go / 2.0,
        i_go_goc: device.i_go_goc / 2.0,
        m_gi: device.m_gi / 2.0,
        i_gi_gic: device.i_gi_gic / 2.0,
        m_w: device.m_w / 2.0,
        i_w_wc: device.i_w_wc / 2.0,
        ..*device
    };
    let motor = MotorTorques { u_o: motor.u_o / 2.0, u_i: motor.u_i / 2.0, u_w: motor.u_w / 2.0 };
    (device, motor)
}

/// Four devices split in eight halves that stay together: the number of devices is a loop bound.
#[test]
fn device_and_its_two_halves_move_alike() {
    let mut figures = Figures::default();
    for seed in 0..cases(SPACECRAFT) {
        let sample = Sample::<4>::new(seed);
        let whole = sample.case::<f64>();
        let half: [_; 4] =
            core::array::from_fn(|j| halved(&whole.devices[j], &whole.inputs.motors[j]));
        let State { r_b_n, r_b_n_dot, attitude, omega, devices, .. } = whole.state;
        let split: Case<8> = Case {
            hub: whole.hub,
            devices: core::array::from_fn(|j| half[j / 2].0),
            state: State {
                r_b_n,
                r_b_n_dot,
                attitude,
                omega,
                devices: core::array::from_fn(|j| devices[j / 2]),
                modal: (),
            },
            inputs: Inputs {
                force: whole.inputs.force,
                torque_b: whole.inputs.torque_b,
                motors: core::array::from_fn(|j| half[j / 2].1),
                ..Inputs::none()
            },
        };
        let (expected, found) = (whole.solved(sample), split.solved(sample));
        for parity in 0..2 {
            let found = Accelerations {
                r_b_n_ddot: found.r_b_n_ddot,
                omega_dot: found.omega_dot,
                devices: core::array::from_fn::<_, 4, _>(|j| found.devices[2 * j + parity]),
                modal: (),
            };
            let (error, block) = worst(errors(&found, &expected));
            figures.add(error);
            assert!(error <= LIMITS, "{error:e} in {block} is above {LIMITS:e} ({sample})");
        }
    }
    println!("halves: worst {:.2e}, median {:.2e}", figures.worst(), figures.median());
}

#[test]
fn energy_momentum_and_centre_of_mass_are_those_of_the_reference() {
    struct Totals;
    impl Measure for Totals {
        fn measure<const N: usize>(&self, sample: &Sample<N>) -> f64 {
            let case = sample.case::<Wide>();
            let spacecraft = case.spacecraft(sample);
            let snapshot = case.snapshot();
            let momenta = snapshot.momenta();
            let (mass, centre) = snapshot.centre_of_mass();

            let rejected = |error: SolveError<Wide>| -> ! { panic!("{sample}: {error}") };
            let energy = spacecraft.energy(&case.state).unwrap_or_else(|e| rejected(e));
            let found = spacecraft.momentum(&case.state, About::InertialOrigin);
            let found = found.unwrap_or_else(|e| rejected(e));
            let c = spacecraft.centre_of_mass(&case.state).unwrap_or_else(|e| rejected(e));
            let one = Wide::from_f64(1.0);
            let errors = [
                ((energy - snapshot.energy()).abs(), energy),
                (distance(&found.linear, momenta.linear), momenta.linear_magnitudes),
                (distance(&found.angular, momenta.angular), momenta.angular_magnitudes),
                (distance(&c.c, centre.r), centre.r.norm()),
                (distance(&c.c_prime, centre.r_prime), centre.r_prime.norm().max(one)),
                ((spacecraft.mass() - mass).abs(), mass),
            ];
            largest(errors.map(|(error, unit)| (error * unit.recip()).to_f64()))
        }
    }
    check("totals", ROUTES_IN_DOUBLE_DOUBLE, Totals);
}

fn distance(a: &Vector3<Wide>, b: Vector<Wide>) -> Wide {
    (Vector::from(a) - b).norm()
}
