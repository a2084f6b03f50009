//! A wheel exerts the force and torque of its data sheet, and the imbalance converted back is the
//! same.

use core::f64::consts::{FRAC_PI_2, PI};

use nalgebra::{Matrix3, Rotation3, Vector3};

use crate::dgvscmg::Joints;
use crate::model::kind::Kind;
use crate::numbers::real::Scalar;
use crate::solve::spacecraft::Spacecraft;
use crate::validation::imbalance::{Imbalance, WheelImbalance};
use crate::{Dgvscmg, Hub, Inputs, State};

const M_W: f64 = 4.0;

/// Mass (kg) and inertia (kg m²) of what the wheel shakes, both gimbals' too.
const MOUNT: f64 = 1e12;

/// The mount moves by the ratio of the wheel's mass and inertia to its own, at most 4e-12, of
/// every force and torque.
const YIELDING: f64 = 1e-11;

fn disc() -> Matrix3<f64> {
    Matrix3::from_diagonal(&Vector3::new(0.2, 0.1, 0.1))
}

fn wheel(imbalance: &Imbalance) -> Dgvscmg {
    Dgvscmg::bare_wheel(M_W, disc()).with_imbalance(imbalance).unwrap()
}

/// Force and torque on a mount that hardly moves: the mount's own acceleration, and those
/// of two gimbals turning freely about `s_y` and `s_z`, each times what it moves.
fn felt(device: &Dgvscmg, theta: f64, spin: f64) -> (Vector3<f64>, Vector3<f64>) {
    let i_heavy = Matrix3::identity() * MOUNT;
    let hub = Hub { m_b: MOUNT, r_bc_b: Vector3::zeros(), i_b_bc: i_heavy };
    let device = Dgvscmg { i_go_goc: i_heavy, i_gi_gic: i_heavy, ..*device };
    let mut state: State<[Dgvscmg; 1]> = State::at_rest();
    state.devices = [Joints { theta, spin, ..Dgvscmg::at_rest() }];
    let spacecraft = Spacecraft::new(&hub, &[device]).unwrap();
    let found = spacecraft.accelerations(&state, &Inputs::none()).unwrap();
    let [joints] = found.devices;
    // The inner gimbal goes along with the outer one about s_z.
    let torque = Vector3::new(
        found.omega_dot.x * MOUNT,
        joints.gamma_i_ddot * MOUNT,
        joints.gamma_o_ddot * 2.0 * MOUNT,
    );
    (found.r_b_n_ddot * MOUNT, torque)
}

#[test]
fn still_mount_feels_what_the_data_sheet_says() {
    for phase in [0.0, 0.7, FRAC_PI_2, 2.5, -1.2, 9.0] {
        for (theta, spin) in [(0.0, 50.0), (1.1, 50.0), (-2.0, -50.0), (4.0, 600.0)] {
            let sheet = Imbalance { u_s: 3.2e-4, u_d: 1.54e-3, phase };
            let (force, torque) = felt(&wheel(&sheet), theta, spin);
            // At zero gimbal angles w_y is s_y turned by theta about s_x.
            let turned = |angle: f64| Vector3::new(0.0, angle.cos(), angle.sin());
            let (most_force, most_torque) = (3.2e-4 * spin * spin, 1.54e-3 * spin * spin);
            let force = force - turned(theta) * most_force;
            let torque = torque - turned(theta + phase) * most_torque;
            assert!(force.amax() <= YIELDING * most_force, "{phase}, {theta}: {force}");
            assert!(torque.amax() <= YIELDING * most_torque, "{phase}, {theta}: {torque}");
        }
    }
}

#[test]
fn phase_zero_is_the_choice_of_the_paper() {
    let WheelImbalance { d, j_12, j_13 } =
        Imbalance { u_s: 3.2e-4, u_d: 1.54e-6, phase: 0.0 }.in_wheel(M_W).unwrap();
    assert_eq!((d, j_13), (0.8e-4, 1.54e-6));
    assert!(j_12 == 0.0 && j_12.is_sign_positive());
}

#[test]
fn torque_is_a_quarter_turn_ahead_of_the_mass_at_the_positive_end() {
    /// Two masses of 1 g, 5 cm along the axis and 10 cm from it, on either side.
    const MASS: f64 = 1e-3;
    let heavy_side = 0.4_f64;
    let at_end = Vector3::new(0.05, 0.1 * heavy_side.cos(), 0.1 * heavy_side.sin());
    let j =
        (Matrix3::identity() * at_end.norm_squared() - at_end * at_end.transpose()) * (2.0 * MASS);
    let device = Dgvscmg { d: 1e-4, ..Dgvscmg::bare_wheel(M_W, disc() + j) };
    let found = device.imbalance().unwrap();
    // A couple of 1 g times 10 cm, with an arm of 10 cm; a few rounded operations.
    assert!((found.u_d - MASS * 0.1 * 0.1).abs() <= 4.0 * f64::EPSILON * found.u_d);
    assert!((found.phase - (heavy_side + FRAC_PI_2)).abs() <= 8.0 * f64::EPSILON);
}

/// W axes are marked on the wheel at will: half a turn on, `d` and both products change sign.
#[test]
fn negative_offset_is_the_same_wheel_marked_half_a_turn_on() {
    let sheet = Imbalance { u_s: 3.2e-4, u_d: 1.54e-3, phase: 0.7 };
    let device = wheel(&sheet);
    let half_turn = *Rotation3::from_axis_angle(&Vector3::x_axis(), PI).matrix();
    let i_w_wc = half_turn * device.i_w_wc * half_turn.transpose();
    let marked = Dgvscmg { d: -device.d, i_w_wc, ..device };
    let (force, torque) = felt(&device, 1.1, 50.0);
    let (force_marked, torque_marked) = felt(&marked, 1.1 + PI, 50.0);
    assert!((force - force_marked).amax() <= YIELDING * force.amax());
    assert!((torque - torque_marked).amax() <= YIELDING * torque.amax());
    assert_back(&sheet, &marked.imbalance().unwrap());
}

#[test]
fn everything_but_the_imbalance_stays() {
    let mut before = Dgvscmg { m_go: 1.0, d: 7.0, ..Dgvscmg::bare_wheel(M_W, disc()) };
    (before.i_w_wc.m23, before.i_w_wc.m32) = (0.03, 0.03);
    let after = before.with_imbalance(&Imbalance { u_s: 0.0, u_d: 0.0, phase: 1.0 }).unwrap();
    assert_eq!(after, Dgvscmg { d: 0.0, ..before });
}

#[test]
fn phase_without_a_counterpart_is_counted_from_w_y_or_zero() {
    let lumped = |d, j_12, j_13| WheelImbalance { d, j_12, j_13 }.lumped(M_W).unwrap();
    assert_eq!(lumped(0.5, 0.0, 0.0), Imbalance { u_s: 2.0, u_d: 0.0, phase: 0.0 });
    assert_eq!(lumped(-0.5, -0.0, 0.0), Imbalance { u_s: 2.0, u_d: 0.0, phase: 0.0 });
    assert_eq!(lumped(0.0, 3.0, 0.0), Imbalance { u_s: 0.0, u_d: 3.0, phase: -FRAC_PI_2 });
    assert_eq!(lumped(0.0, -3.0, 0.0), Imbalance { u_s: 0.0, u_d: 3.0, phase: FRAC_PI_2 });
    // Half a turn is positive for either sign of a zero.
    for (d, j_12, j_13) in [(0.0, 0.0, -3.0), (0.0, -0.0, -3.0), (-0.0, 0.0, -3.0)] {
        assert_eq!(lumped(d, j_12, j_13).phase, PI);
    }
    assert_eq!(lumped(-0.5, 0.0, 3.0).phase, PI);
    assert_eq!(lumped(-0.5, -0.0, 3.0).phase, PI);
}

/// The same imbalance to a few roundings: `d` and `U_s` take two each, the products and `U_d` some
/// six, and an angle's sine and cosine move by no more than the angle does.
#[track_caller]
fn assert_back<T: Scalar>(given: &Imbalance<T>, back: &Imbalance<T>) {
    let few = T::from_f64(4.0) * T::EPSILON;
    assert!((back.u_s - given.u_s).abs() <= few * given.u_s, "{given:?} came back as {back:?}");
    assert!((back.u_d - given.u_d).abs() <= few * given.u_d, "{given:?} came back as {back:?}");
    let ((sine, cosine), (s, c)) = (given.phase.sin_cos(), back.phase.sin_cos());
    assert!((sine - s).abs().max((cosine - c).abs()) <= few, "{given:?} came back as {back:?}");
    assert!(back.phase.abs() <= T::from_f64(PI), "{given:?} came back as {back:?}");
}

/// Ten thousand wheels: 0.1 to 5000 kg, `U_s` and `U_d` over eight decades, three turns in either
/// sense.
fn random_wheels_come_back<T: Scalar>() {
    // Knuth's multiplier for 64 bits; the upper half of the state is the number.
    let mut seed = 0x1AC_17C1_u64;
    let mut within = |low: f64, high: f64| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        let upper = u32::try_from(seed >> 32).unwrap_or(u32::MAX);
        low + (high - low) * f64::from(upper) / f64::from(u32::MAX)
    };
    for _ in 0..10_000 {
        let m_w = T::from_f64(0.1 * within(0.0, 50_000_f64.ln()).exp());
        let given = Imbalance {
            u_s: T::from_f64(10.0_f64.powf(within(-8.0, 0.0))),
            u_d: T::from_f64(10.0_f64.powf(within(-9.0, -1.0))),
            phase: T::from_f64(within(-6.0 * PI, 6.0 * PI)),
        };
        let wheel = given.in_wheel(m_w).unwrap();
        assert_back(&given, &wheel.lumped(m_w).unwrap());
    }
}

#[test]
fn random_wheels_come_back_in_double_precision() {
    random_wheels_come_back::<f64>();
}

#[test]
fn random_wheels_come_back_in_single_precision() {
    random_wheels_come_back::<f32>();
}

#[test]
fn imbalance_of_any_size_comes_back() {
    for size in [1e-300, 1e-160, 1e160, 1e300] {
        let given = Imbalance { u_s: size, u_d: size, phase: -2.0 };
        assert_back(&given, &given.in_wheel(M_W).unwrap().lumped(M_W).unwrap());
    }
    // The root of two times the smallest number rounds to that number.
    let least = f64::from_bits(1);
    let found = WheelImbalance { d: 0.0, j_12: -least, j_13: least }.lumped(M_W).unwrap();
    assert_eq!(found.u_d, least);
    assert!((found.phase - PI / 4.0).abs() <= f64::EPSILON);
}
