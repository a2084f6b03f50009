//! Dynamic mass of any set at its mount against closed forms: a wheel, locked devices, a sprung panel, a sprung
//! gimbal with a rotor, an isolated platform, a rotor on a soft tilting mount.

use std::f64::consts::FRAC_1_SQRT_2;

use nalgebra::{Complex, DMatrix, DVector, Matrix3, Matrix6, Rotation3, Vector3, Vector6};
use precess::structure::accelerance::ComplexMatrix;
use precess::structure::averaged::AveragedDevices;
use precess::structure::dynamic_mass::{Motor, Wheel};
use precess::structure::{Fault, RigidMass};
use precess_dynamics::{
    BuiltIn, Dgvscmg, HingedPanel, Inputs, Isolated, Passive, Platform, ReactionWheel, Sgcmg,
    Spacecraft, State, Suspension, platform,
};

use super::ROUNDING;
use super::wheel::{I, hub, wheel};

const FREE: Motor = Motor::ConstantTorque;
const HELD: Motor = Motor::ConstantRate;

/// Devices as scenarios have them: one instance of the solver serves most tests.
fn list<K: Into<BuiltIn>, const N: usize>(devices: [K; N]) -> Vec<BuiltIn> {
    devices.map(Into::into).to_vec()
}

fn apart(a: &ComplexMatrix, b: &ComplexMatrix) -> f64 {
    (a - b).norm() / b.norm()
}

fn real(matrix: &Matrix6<f64>) -> ComplexMatrix {
    DMatrix::from_column_slice(6, 6, matrix.as_slice()).map(|value| Complex::new(value, 0.0))
}

#[test]
fn a_wheel_has_the_dynamic_mass_of_the_closed_form() {
    let mount = Vector3::new(0.25, 0.3, -0.2);
    let mut imbalanced = wheel(1e-3);
    imbalanced.i_w_wc.m23 = 1e-4;
    imbalanced.i_w_wc.m32 = 1e-4;
    imbalanced.i_w_wc.m12 = 2e-4;
    imbalanced.i_w_wc.m21 = 2e-4;
    for device in [wheel(0.0), imbalanced] {
        for (rate, motor, frequency) in
            [(400.0, FREE, 37.0), (-90.0, HELD, 300.0), (0.0, HELD, 5.0)]
        {
            let closed = Wheel::from_reaction_wheel(&device, &mount, rate).expect("valid");
            let closed = Wheel { motor, ..closed };
            let found = AveragedDevices::new(&list([device]), &mount, &[[0.7, rate]], &[motor])
                .expect("valid");
            let mass = found.dynamic_mass(frequency).expect("above zero");
            let expected = closed.dynamic_mass(frequency).expect("above zero");
            // A wheel at rest has no turn to be averaged over.
            if rate != 0.0 || device.d == 0.0 {
                let error = apart(&mass, &expected);
                assert!(error < ROUNDING, "{rate} rad/s: {error:e}");
            }
            let left_out = found.periodic(frequency).expect("above zero");
            let imbalance = closed.periodic[0].max(closed.periodic[1]);
            assert!(rate == 0.0 || left_out >= 0.1 * imbalance, "{left_out:e} of {imbalance:e}");
            assert!(left_out < 1e-12 || device.d > 0.0, "{left_out:e}");
        }
    }
}

#[test]
fn no_inertia_about_the_axis_of_a_free_spin_reaches_the_mount() {
    let device = wheel(2e-4);
    let axis = device.mount.column(0);
    let turn =
        DVector::from_fn(6, |row, _| Complex::new(if row < 3 { 0.0 } else { axis[row - 3] }, 0.0));
    for (motor, inertia) in [(FREE, 0.0), (HELD, 0.02 + 4.0 * 4e-8)] {
        let found = AveragedDevices::new(&list([device]), &device.r_w_b, &[[0.0, 600.0]], &[motor]);
        let mass = found.and_then(|of| of.dynamic_mass(20.0)).expect("valid");
        let moment = (mass * &turn).rows(3, 3).into_owned();
        let along: Complex<f64> = moment.iter().zip(axis.iter()).map(|(m, a)| m * *a).sum();
        assert!((along - inertia).norm() < 1e-15, "{motor:?}: {along}");
    }
}

/// The rigid mass of devices that do not move, about B, from the accelerations of a spacecraft that has them.
fn rigid(devices: &Vec<BuiltIn>, joints: &[[f64; 2]]) -> Matrix6<f64> {
    let hub = hub();
    let craft = Spacecraft::new(&hub, devices).expect("valid");
    let mut state: State<Vec<BuiltIn>> = State::at_rest_for(&craft);
    for (to, from) in precess_dynamics::JointStates::states_mut(&mut state.devices).zip(joints) {
        *to[0] = from[0];
    }
    let mut inputs: Inputs<Vec<BuiltIn>> = Inputs::none_for(&craft);
    for mode in precess_dynamics::Each::values_mut(&mut inputs.modes) {
        *mode = precess_dynamics::Mode::Locked;
    }
    let mut inverse = Matrix6::zeros();
    for column in 0..6 {
        let unit = Vector6::ith(column, 1.0);
        inputs.force = unit.fixed_rows::<3>(0).into_owned();
        inputs.torque_b = unit.fixed_rows::<3>(3).into_owned();
        let found = craft.accelerations(&state, &inputs).expect("regular");
        inverse.fixed_view_mut::<3, 1>(0, column).copy_from(&found.r_b_n_ddot);
        inverse.fixed_view_mut::<3, 1>(3, column).copy_from(&found.omega_dot);
    }
    let of_hub = RigidMass::about_centre(hub.m_b, hub.r_bc_b, hub.i_b_bc).matrix();
    inverse.try_inverse().expect("positive definite") - of_hub
}

#[test]
fn locked_devices_are_a_rigid_mass() {
    let inertia = Matrix3::new(0.02, 0.001, 0.0, 0.001, 0.012, 0.0, 0.0, 0.0, 0.015);
    let gyro = Dgvscmg {
        mount: Rotation3::from_euler_angles(0.3, -0.8, 1.9).into_inner(),
        r_go_b: Vector3::new(0.2, -0.4, 0.3),
        m_go: 2.0,
        i_go_goc: Matrix3::from_diagonal(&Vector3::new(0.03, 0.02, 0.04)),
        m_gi: 1.5,
        i_gi_gic: Matrix3::from_diagonal(&Vector3::new(0.01, 0.02, 0.02)),
        d: 1e-3,
        ..Dgvscmg::bare_wheel(3.0, inertia)
    };
    let set: Vec<BuiltIn> = vec![gyro.into(), wheel(1e-3).into(), panel(0.0, 0.0).into()];
    let joints = [[0.5, 0.0], [-1.1, 0.0], [2.0, 0.0], [0.3, 0.0], [0.7, 0.0]];
    let found = AveragedDevices::new(&set, &Vector3::zeros(), &joints, &[HELD; 5]).expect("valid");
    assert_eq!((found.free_joints(), found.periodic(3.0).expect("above zero")), (0, 0.0));
    let expected = real(&rigid(&set, &joints));
    for frequency in [0.1, 1e4] {
        let mass = found.dynamic_mass(frequency).expect("above zero");
        // The rounding of the mass of the hub, ten times the devices', which is subtracted.
        assert!(apart(&mass, &expected) < 1e-11, "{:e}", apart(&mass, &expected));
    }
}

fn panel(stiffness: f64, viscous: f64) -> HingedPanel {
    let mut panel = HingedPanel {
        mount: Rotation3::from_euler_angles(0.4, -0.3, 0.9).into_inner(),
        r_p_b: Vector3::new(-0.3, 0.5, 0.1),
        r_pc_p: Vector3::new(0.4, 0.1, -0.05),
        ..HingedPanel::bare_panel(3.0, Matrix3::from_diagonal(&Vector3::new(0.05, 0.2, 0.24)))
    };
    panel.passive.panel = Passive { rest: 0.2, ..Passive::spring(stiffness, viscous) };
    panel
}

#[test]
fn a_sprung_panel_is_a_rigid_mass_and_one_effective_mass() {
    let panel = panel(40.0, 0.3);
    let turned = panel.mount * Rotation3::from_axis_angle(&Vector3::z_axis(), 0.7).into_inner();
    let (axis, arm) = (turned.column(2).into_owned(), turned * panel.r_pc_p);
    let inertia = turned * panel.i_p_pc * turned.transpose();
    let centre = panel.r_p_b + arm;
    let swept = axis.cross(&arm) * panel.m_p;
    let about_hinge = axis.dot(&(inertia * axis)) + axis.cross(&arm).dot(&swept);
    let angular = inertia * axis + centre.cross(&swept);
    let l = Vector6::new(swept.x, swept.y, swept.z, angular.x, angular.y, angular.z);
    let whole = RigidMass::about_centre(panel.m_p, centre, inertia).matrix();
    let found = AveragedDevices::new(&list([panel]), &Vector3::zeros(), &[[0.7, 0.0]], &[FREE])
        .expect("valid");
    for w in [0.5, 5.0, 7.0, 60.0] {
        let stiff = Complex::new(40.0 - w * w * about_hinge, 0.3 * w);
        let expected = real(&whole) + real(&(l * l.transpose())) * (w * w / stiff);
        let mass = found.dynamic_mass(w).expect("above zero");
        assert!(apart(&mass, &expected) < ROUNDING, "{w}: {:e}", apart(&mass, &expected));
    }
}

#[test]
fn a_sprung_gimbal_with_a_rotor_adds_its_momentum_squared_over_the_stiffness() {
    let (rate, stiffness) = (500.0_f64, 30.0_f64);
    let inertia = Matrix3::from_diagonal(&Vector3::new(0.02, 0.012, 0.012));
    let mut gyro = Sgcmg::bare_wheel(3.0, inertia);
    gyro.passive.gimbal = Passive::spring(stiffness, 0.0);
    let joints = [[0.0, 0.0], [0.4, rate]];
    let found = AveragedDevices::new(&list([gyro]), &Vector3::zeros(), &joints, &[FREE, FREE])
        .expect("valid");
    let h = 0.02 * rate;
    for w in [3.0, 20.0, 49.0, 51.0, 400.0] {
        let mass = found.dynamic_mass(w).expect("above zero");
        let of_gimbal = stiffness - w * w * 0.012;
        let expected: f64 = 0.012 + h * h / of_gimbal;
        let output = mass[(4, 4)];
        assert!((output - expected).norm() < ROUNDING * expected.abs(), "{w}: {output}");
        // About the gimbal's axis: the spring.
        let about: f64 = stiffness * 0.012 / of_gimbal;
        assert!((mass[(5, 5)] - about).norm() < ROUNDING * about.abs(), "{w}: {}", mass[(5, 5)]);
    }
    let locked = AveragedDevices::new(&list([gyro]), &Vector3::zeros(), &joints, &[HELD, FREE])
        .expect("valid");
    let mass = locked.dynamic_mass(20.0).expect("above zero");
    assert!((mass[(4, 4)] - 0.012).norm() < 1e-15 && (mass[(5, 5)] - 0.012).norm() < 1e-15);
}

/// A platform with one stiffness and damping of all slides and one of all turns, and a wheel on it.
fn isolated(slides: [f64; 2], turns: [f64; 2]) -> Isolated<ReactionWheel> {
    let inertia = Matrix3::from_diagonal_element(0.01);
    let mut body = Platform::bare(2.0, inertia);
    let [slide, turn] = [slides, turns].map(|[k, c]| Passive::spring(k, c));
    body.passive = platform::PerJoint::of([slide, slide, slide, turn, turn, turn]);
    let rotor = Matrix3::from_diagonal(&Vector3::new(0.02, 0.012, 0.012));
    Isolated {
        carrier: body,
        suspension: Suspension::none(),
        carried: ReactionWheel::bare_wheel(4.0, rotor),
    }
}

#[test]
fn an_isolated_wheel_is_in_series_with_its_mount_and_whirls() {
    let (slides, turns, rate) = ([900.0, 4.0], [50.0, 0.1], 300.0);
    let set = isolated(slides, turns);
    let mut joints = [[0.0; 2]; 7];
    joints[6][1] = rate;
    let found = AveragedDevices::new(&set, &Vector3::zeros(), &joints, &[FREE; 7]).expect("valid");
    // A spring k + i w c in series with an inertia z: k z / (k - w^2 z).
    let series = |[k, c]: [f64; 2], w: f64, z: Complex<f64>| {
        let k = Complex::new(k, w * c);
        k * z / (k - w * w * z)
    };
    for w in [2.0, 12.0, 45.0, 300.0] {
        let mass = found.dynamic_mass(w).expect("above zero");
        let slide = series(slides, w, Complex::new(6.0, 0.0));
        let near = |found: Complex<f64>, wanted: Complex<f64>| {
            (found - wanted).norm() < ROUNDING * wanted.norm()
        };
        assert!((0..3).all(|axis| near(mass[(axis, axis)], slide)), "{w}");
        // About the spin axis only the platform.
        assert!(near(mass[(3, 3)], series(turns, w, Complex::new(0.01, 0.0))), "{w}");
        // Turning about y and z a quarter apart, J_t -+ J_s Omega / w: the two whirls.
        for sign in [1.0, -1.0] {
            let whirl = [Complex::new(FRAC_1_SQRT_2, 0.0), I * (sign * FRAC_1_SQRT_2)];
            let moment = [4, 5].map(|row| mass[(row, 4)] * whirl[0] + mass[(row, 5)] * whirl[1]);
            // i s~ has the eigenvalue sign of (y + i sign z).
            let inertia = Complex::new(0.022 + sign * 0.02 * rate / w, 0.0);
            let wanted = series(turns, w, inertia);
            assert!(
                near(moment[0] / whirl[0], wanted) && near(moment[1] / whirl[1], wanted),
                "{w} {sign}: {} for {wanted}",
                moment[0] / whirl[0]
            );
        }
    }
}

#[test]
fn a_set_is_the_sum_of_its_devices_and_rotors_need_no_common_angle() {
    let devices =
        [wheel(1e-3), ReactionWheel { r_w_b: Vector3::new(-0.5, 0.1, 0.2), ..wheel(2e-3) }];
    let joints = [[0.3, 500.0], [1.9, -350.0]];
    let of = |set: &[ReactionWheel; 1], joint: [f64; 2]| {
        AveragedDevices::new(&list(*set), &Vector3::zeros(), &[joint], &[FREE]).expect("valid")
    };
    let both = AveragedDevices::new(&list(devices), &Vector3::zeros(), &joints, &[FREE; 2])
        .expect("valid");
    let one = [of(&[devices[0]], joints[0]), of(&[devices[1]], joints[1])];
    let sum = one.each_ref().map(|of| of.dynamic_mass(60.0).expect("above zero"));
    let mass = both.dynamic_mass(60.0).expect("above zero");
    assert!(apart(&mass, &(&sum[0] + &sum[1])) < ROUNDING);
    let moved = AveragedDevices::new(
        &devices,
        &Vector3::zeros(),
        &[[2.0, 500.0], [0.0, -350.0]],
        &[FREE; 2],
    );
    let moved = moved.and_then(|of| of.dynamic_mass(60.0)).expect("valid");
    assert!(apart(&mass, &moved) < ROUNDING);
}

#[test]
fn what_is_not_steady_is_rejected() {
    let new = |joints: &[[f64; 2]], motors: &[Motor]| {
        AveragedDevices::new(&list([wheel(0.0)]), &Vector3::zeros(), joints, motors)
    };
    assert!(matches!(new(&[], &[FREE]), Err(Fault::Shape { .. })));
    assert!(matches!(new(&[[0.0, f64::NAN]], &[FREE]), Err(Fault::Device(_))));
    let good = new(&[[0.0, 3.0]], &[FREE]).expect("valid");
    assert!(matches!(good.dynamic_mass(0.0), Err(Fault::Range { .. })));
    let mut sprung = wheel(0.0);
    sprung.passive.wheel = Passive::spring(1.0, 0.0);
    let found = AveragedDevices::new(&list([sprung]), &Vector3::zeros(), &[[0.0, 3.0]], &[FREE]);
    assert!(matches!(found, Err(Fault::Range { .. })), "a rotor on a spring");
    let mut joints = [[0.0; 2]; 7];
    joints[0][1] = 0.1;
    let found = AveragedDevices::new(
        &isolated([1.0, 0.0], [1.0, 0.0]),
        &Vector3::zeros(),
        &joints,
        &[FREE; 7],
    );
    assert!(matches!(found, Err(Fault::Range { .. })), "a slide that moves");
}
