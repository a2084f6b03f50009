//! Matrices and struts: stiffness at rest, forces as gradients of the potential in large turns,
//! rejected parameters.

use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};
use precess_dynamics::{
    Coupled, Hub, Inputs, Isolated, JointStates, LoadAxes, ParameterError, Platform, ReactionWheel,
    Spacecraft, State, Strut, Suspension,
};
use precess_tests::random::Random;

type Bare = Isolated<[ReactionWheel; 0]>;

/// A symmetric difference over this step, m or rad, of what is smooth over a tenth: relative error
/// 1e-8 of curvature, 1e-10 of rounding.
const STEP: f64 = 1e-5;

fn hub() -> Hub {
    Hub { m_b: 60.0, r_bc_b: Vector3::zeros(), i_b_bc: Matrix3::from_diagonal_element(5.0) }
}

fn set(suspension: &Suspension) -> Bare {
    let platform = Platform::bare(8.0, Matrix3::from_diagonal_element(0.3));
    Isolated { carrier: platform, suspension: *suspension, carried: [] }
}

fn craft(suspension: &Suspension) -> Spacecraft<Bare> {
    Spacecraft::new(&hub(), &set(suspension)).expect("sound")
}

/// A hexapod with cubic geometry, its struts of stiffness 1e4 N/m.
fn hexapod() -> [Strut; 6] {
    [0.0, 1.0, 2.0, 3.0, 4.0, 5.0].map(|index| {
        let angle: f64 = core::f64::consts::FRAC_PI_3 * index;
        let sign = if index % 2.0 == 0.0 { 1.0 } else { -1.0 };
        let position = Vector3::new(0.2 * angle.cos(), 0.2 * angle.sin(), 0.03);
        let across = Vector3::new(-angle.sin(), angle.cos(), 0.0) * (sign * 2.0_f64.sqrt());
        let direction = (across + Vector3::z()).normalize();
        Strut { position, direction, length: 0.15, stiffness: 1e4, damping: 20.0 }
    })
}

fn coupled(random: &mut Random) -> Coupled {
    let mut definite = |size: f64| {
        let root = Matrix6::from_fn(|_, _| random.within(-1.0, 1.0));
        let matrix = root * root.transpose();
        (matrix + matrix.transpose()) * size
    };
    let (stiffness, damping) = (definite(500.0), definite(2.0));
    Coupled { stiffness, damping, rest: Vector6::new(0.01, 0.0, -0.02, 0.1, 0.0, 0.05) }
}

/// Generalised forces of the suspension at rest, and its energy.
fn forces(craft: &Spacecraft<Bare>, q: &Vector6<f64>) -> (Vector6<f64>, f64) {
    let mut state: State<Bare> = State::at_rest();
    for ([coordinate, _], q) in state.devices.states_mut().zip(q.iter()) {
        *coordinate = *q;
    }
    let inputs = Inputs::none();
    let mut still = craft.accelerations(&state, &inputs).expect("regular");
    (still.r_b_n_ddot, still.omega_dot) = (Vector3::zeros(), Vector3::zeros());
    still.devices.carrier = precess_dynamics::platform::JointAccelerations::all(0.0);
    let loads = craft.loads(&state, &inputs, &still, LoadAxes::Body).expect("finite");
    let ledger = craft.ledger(&state, &inputs, &still).expect("finite");
    (-Vector6::from(loads.devices.carrier.motors.array()), ledger.springs)
}

#[test]
fn stiffness_of_a_hexapod_at_rest_is_the_sum_of_its_struts() {
    let craft = craft(&Suspension::hexapod(hexapod()));
    let (at_rest, energy) = forces(&craft, &Vector6::zeros());
    assert_eq!((at_rest.amax(), energy), (0.0, 0.0));
    let mut expected = Matrix6::zeros();
    for strut in hexapod() {
        let moment = strut.position.cross(&strut.direction);
        let along = Vector6::from_iterator(strut.direction.iter().chain(&moment).copied());
        expected += strut.stiffness * along * along.transpose();
    }
    for joint in 0..6 {
        let mut q = Vector6::zeros();
        q[joint] = STEP;
        let slope = (forces(&craft, &q).0 - forces(&craft, &-q).0) / (2.0 * STEP);
        let off = (slope + expected.column(joint)).amax() / expected.amax();
        assert!(off < 1e-7, "joint {joint}: {off:e}");
    }
    let frequencies = expected.diagonal();
    assert!(frequencies.iter().all(|k| *k > 0.0), "a hexapod holds every freedom");
}

#[test]
fn forces_are_the_gradient_of_the_potential_in_large_turns() {
    let random = &mut Random::new(3);
    for _ in 0..40 {
        let suspension = Suspension { coupled: Some(coupled(random)), struts: hexapod().map(Some) };
        let craft = craft(&suspension);
        let q = Vector6::from_fn(|i, _| random.within(-1.0, 1.0) * if i < 3 { 0.1 } else { 1.4 });
        let (found, energy) = forces(&craft, &q);
        for joint in 0..6 {
            let mut step = Vector6::zeros();
            step[joint] = STEP;
            let slope =
                (forces(&craft, &(q + step)).1 - forces(&craft, &(q - step)).1) / (2.0 * STEP);
            let unit = found.amax() + energy;
            let off = (slope + found[joint]).abs() / unit;
            assert!(off < 1e-7, "joint {joint}: {slope}, force {}", found[joint]);
        }
    }
}

/// The second derivative of the potential of matrices is the stiffness matrix anywhere.
#[test]
fn stiffness_matrix_is_the_second_derivative_in_the_coordinates() {
    let random = &mut Random::new(5);
    let of = coupled(random);
    let craft = craft(&Suspension { coupled: Some(of), ..Suspension::none() });
    let q = Vector6::new(0.05, -0.02, 0.01, 0.8, -1.1, 2.0);
    let (found, energy) = forces(&craft, &q);
    let expected = -(of.stiffness * (q - of.rest));
    assert!((found - expected).amax() < 1e-12 * expected.amax());
    let stored = 0.5 * (q - of.rest).dot(&(of.stiffness * (q - of.rest)));
    assert!((energy - stored).abs() < 1e-12 * stored);
}

#[test]
fn parameters_that_no_suspension_has_are_rejected() {
    let rejected = |suspension: &Suspension| {
        Spacecraft::new(&hub(), &set(suspension)).map(|_| ()).expect_err("rejected")
    };
    let with = |change: fn(&mut Coupled)| {
        let mut of = coupled(&mut Random::new(7));
        change(&mut of);
        rejected(&Suspension { coupled: Some(of), ..Suspension::none() })
    };
    assert!(matches!(
        with(|of| of.stiffness[(0, 4)] += 1.0),
        ParameterError::AsymmetricSuspension {
            device: 0, name: "stiffness", row: 1, column: 5, difference
        } if (difference - 1.0).abs() < 1e-9
    ));
    assert!(matches!(
        with(|of| of.damping[(2, 2)] = -1.0),
        ParameterError::Suspension { device: 0, name: "damping", value: -1.0, .. }
    ));
    let indefinite = with(|of| {
        let coupling = 1.01 * (of.stiffness[(0, 0)] * of.stiffness[(1, 1)]).sqrt();
        (of.stiffness[(0, 1)], of.stiffness[(1, 0)]) = (coupling, coupling);
    });
    assert!(matches!(indefinite, ParameterError::Suspension { name: "stiffness", .. }));
    assert!(matches!(
        with(|of| of.rest[3] = f64::NAN),
        ParameterError::NotFinite { value, .. } if value.is_nan()
    ));
    let strut = |change: fn(&mut Strut)| {
        let mut struts = hexapod();
        change(&mut struts[4]);
        rejected(&Suspension::hexapod(struts))
    };
    for (error, expected) in [
        (strut(|of| of.length = 0.0), "length"),
        (strut(|of| of.stiffness = -1.0), "stiffness"),
        (strut(|of| of.damping = -1.0), "damping"),
        (strut(|of| of.direction *= 2.0), "squared length of the direction"),
    ] {
        match error {
            ParameterError::Strut { device: 0, strut: 4, name, .. } => assert_eq!(name, expected),
            other => panic!("{other:?}"),
        }
        assert!(error.to_string().contains("strut 4 of device 0"), "{error}");
    }
}
