//! The pyramid of four single-gimbal gyros: its singular pose on the way along x, and how it is left. Wie (2001).

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::{
    BalancedSgcmg, Dither, Dual, Hub, Inverse, Spacecraft, State, Steered, SteeringError,
    SteeringLaw, SteeringMatrix, SteeringTerms,
};

/// Of each wheel, kg m²/s.
const MOMENTUM: f64 = 1.0;
const J_11: f64 = 0.01;

/// Four gyros on the faces of a pyramid with a skew angle of cos beta = 1/sqrt 3, momenta as Wie has them: along y, -x,
/// -y, x at zero angles.
fn pyramid() -> Spacecraft<[BalancedSgcmg; 4]> {
    let hub = Hub { m_b: 800.0, r_bc_b: Vector3::zeros(), i_b_bc: Matrix3::identity() * 500.0 };
    let cosine = (1.0_f64 / 3.0).sqrt();
    let sine = (1.0 - cosine * cosine).sqrt();
    let axes = [
        (Vector3::new(sine, 0.0, cosine), Vector3::y()),
        (Vector3::new(0.0, sine, cosine), -Vector3::x()),
        (Vector3::new(-sine, 0.0, cosine), -Vector3::y()),
        (Vector3::new(0.0, -sine, cosine), Vector3::x()),
    ];
    let devices = axes.map(|(gimbal, spin)| BalancedSgcmg {
        mount: Matrix3::from_columns(&[spin, gimbal.cross(&spin), gimbal]),
        ..BalancedSgcmg::bare_wheel(4.0, J_11, 0.6 * J_11)
    });
    Spacecraft::new(&hub, &devices).unwrap()
}

const GIMBALS: [Steered; 8] = {
    let (rate, none) = (Steered::Rate, Steered::Nothing);
    [rate, none, rate, none, rate, none, rate, none]
};

fn at(angles: [f64; 4]) -> State<[BalancedSgcmg; 4]> {
    let mut state: State<[BalancedSgcmg; 4]> = State::at_rest();
    for (joints, angle) in state.devices.iter_mut().zip(angles) {
        (joints.gamma, joints.spin) = (angle, MOMENTUM / J_11);
    }
    state
}

fn matrix(craft: &Spacecraft<[BalancedSgcmg; 4]>, angles: [f64; 4]) -> SteeringMatrix<f64, 8> {
    let terms: SteeringTerms<f64, 8> = craft.steering_terms(&at(angles)).unwrap();
    terms.matrix(&GIMBALS)
}

/// Gimbal angles while the wheels take up momentum along x at one unit a second, and that momentum, until the law has no
/// command or the time ends.
fn driven(inverse: impl Fn(f64) -> Inverse, end: f64) -> ([f64; 4], f64, Option<SteeringError>) {
    let craft = pyramid();
    let (mut angles, dt) = ([0.0; 4], 1e-3);
    let mut time = 0.0;
    let momentum = |angles| -> f64 {
        let terms: SteeringTerms<f64, 8> = craft.steering_terms(&at(angles)).unwrap();
        terms.momentum.x
    };
    while time < end {
        let law = SteeringLaw { inverse: inverse(time), ..SteeringLaw::exact() };
        let rates = |angles: [f64; 4]| {
            let found = law.allocate(&matrix(&craft, angles), &Vector3::new(-1.0, 0.0, 0.0))?;
            let [a, _, b, _, c, _, d, _] = found.commands;
            Ok([a, b, c, d].map(|rate: f64| rate.clamp(-2.0, 2.0)))
        };
        let step = |angles: [f64; 4], rates: [f64; 4], dt: f64| {
            core::array::from_fn(|k| angles[k] + dt * rates[k])
        };
        let middle = rates(angles).map(|start| step(angles, start, 0.5 * dt)).and_then(rates);
        match middle {
            Ok(middle) => angles = step(angles, middle, dt),
            Err(error) => return (angles, momentum(angles), Some(error)),
        }
        time += dt;
    }
    (angles, momentum(angles), None)
}

/// The momentum of the pyramid, in closed form, and the determinant at zero angles.
#[test]
fn the_matrix_is_that_of_the_closed_form() {
    let craft = pyramid();
    let cosine = (1.0_f64 / 3.0).sqrt();
    let sine = (1.0 - cosine * cosine).sqrt();
    for angles in [[0.0; 4], [0.3, -1.1, 2.0, 0.7]] {
        let [s, c]: [[f64; 4]; 2] = [angles.map(f64::sin), angles.map(f64::cos)];
        let expected = [
            Vector3::new(-cosine * c[0], -s[0], sine * c[0]),
            Vector3::new(s[1], -cosine * c[1], sine * c[1]),
            Vector3::new(cosine * c[2], s[2], sine * c[2]),
            Vector3::new(-s[3], cosine * c[3], sine * c[3]),
        ];
        let found = matrix(&craft, angles);
        for (k, column) in expected.iter().enumerate() {
            assert!((found.columns[2 * k] - column * MOMENTUM).norm() < 1e-14, "{k}");
            assert_eq!(found.columns[2 * k + 1], Vector3::zeros());
        }
        let a = nalgebra::Matrix3x4::from_columns(&expected);
        let (measure, determinant) = (found.measure(MOMENTUM), (a * a.transpose()).determinant());
        assert!((measure - determinant).abs() < 1e-14);
        let least = a.svd(false, false).singular_values.min();
        let (weakest, direction) = found.weakest();
        assert!((weakest - least).abs() < 1e-14, "{weakest} {least}");
        assert!(((a.transpose() * direction).norm() - least).abs() < 1e-13);
    }
}

/// Dual numbers give the gradient of the measure.
#[test]
fn the_gradient_of_the_measure_is_its_difference() {
    let craft = pyramid();
    let angles = [0.3, -1.1, 2.0, 0.7];
    let dual = craft.with_numbers(Dual::<f64, 4>::constant);
    let mut state: State<[BalancedSgcmg<Dual<f64, 4>>; 4]> = State::at_rest();
    for (k, (joints, angle)) in state.devices.iter_mut().zip(angles).enumerate() {
        joints.gamma = Dual::variable(angle, k);
        joints.spin = Dual::constant(MOMENTUM / J_11);
    }
    let terms: SteeringTerms<Dual<f64, 4>, 8> = dual.steering_terms(&state).unwrap();
    let measure = terms.matrix(&GIMBALS).measure(Dual::constant(MOMENTUM));
    for k in 0..4 {
        let changed = |change: f64| {
            let mut angles = angles;
            angles[k] += change;
            matrix(&craft, angles).measure(MOMENTUM)
        };
        let difference = (changed(1e-5) - changed(-1e-5)) / 2e-5;
        assert!((measure.derivative(k) - difference).abs() < 1e-9, "{k}");
    }
}

/// From zero angles the exact inverse runs along x into (-90, 0, 90, 0) degrees, at 2/sqrt 3 of a wheel's momentum, where
/// no rate gives a torque along x.
#[test]
fn the_exact_inverse_ends_in_the_singular_pose() {
    let (angles, momentum, _) = driven(|_| Inverse::Exact, 1.5);
    let degrees = angles.map(f64::to_degrees);
    for (found, expected) in degrees.iter().zip([-90.0, 0.0, 90.0, 0.0]) {
        assert!((found - expected).abs() < 3.0, "{degrees:?}");
    }
    assert!((momentum - 2.0 / 3.0_f64.sqrt()).abs() < 2e-3, "{momentum}");
    let at_singular = matrix(&pyramid(), [-90.0, 0.0, 90.0, 0.0].map(f64::to_radians));
    let (least, direction) = at_singular.weakest();
    assert!(least < 1e-14 && (direction.x.abs() - 1.0).abs() < 1e-12, "{least} {direction}");
    let refused = SteeringLaw::exact().allocate(&at_singular, &Vector3::x()).unwrap_err();
    assert!(matches!(refused, SteeringError::Singular { .. }), "{refused:?}");
}

/// The singularity-robust inverse stays there: of a torque along x it commands nothing.
#[test]
fn the_singularity_robust_inverse_stays_in_it() {
    let robust = |_| Inverse::SingularityRobust { lambda: 0.01, mu: 10.0 };
    let (_, momentum, error) = driven(robust, 4.0);
    assert!(error.is_none() && (momentum - 2.0 / 3.0_f64.sqrt()).abs() < 2e-3, "{momentum}");
}

/// With a dither beside the diagonal it leaves, and takes up more than twice as much.
#[test]
fn the_generalised_inverse_leaves_it() {
    let dither = Dither {
        amplitude: 0.01,
        frequency: core::f64::consts::FRAC_PI_2,
        phases: [0.0, core::f64::consts::FRAC_PI_2, core::f64::consts::PI],
    };
    let generalised =
        |time| Inverse::Generalised { lambda: 0.01, mu: 10.0, dither: dither.at(time) };
    let (_, momentum, error) = driven(generalised, 6.0);
    // At most 2 + 2/sqrt 3 of a wheel's momentum can be along x.
    let most = 2.0 + 2.0 / 3.0_f64.sqrt();
    assert!(error.is_none() && momentum > 0.9 * most && momentum <= most + 1e-9, "{momentum}");
}
