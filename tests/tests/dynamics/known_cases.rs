//! The Newton-Euler reference in cases known in closed form.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::dgvscmg::{Joints, MotorTorques, PerJoint};
use precess_dynamics::{Dgvscmg, FixedSet, Hub, ImbalanceModel, Inputs, Passive, State};
use precess_tests::case::Case;
use precess_tests::newton_euler::bodies::Device;
use precess_tests::newton_euler::vector::{Vector, dot};

fn free_hub(omega: Vector3<f64>) -> Case<0> {
    Case {
        hub: Hub {
            m_b: 10.0,
            r_bc_b: Vector3::zeros(),
            i_b_bc: Matrix3::from_diagonal(&Vector3::new(1.0, 2.0, 4.0)),
        },
        devices: [],
        state: State { omega, ..State::at_rest() },
        inputs: Inputs::none(),
    }
}

/// Euler's equations of a free body: `I_1 omega_1' = (I_2 - I_3) omega_2 omega_3`, and so on.
#[test]
fn free_hub_obeys_eulers_equations() {
    let a = free_hub(Vector3::new(0.5, 0.25, -0.5)).reference();
    assert_eq!(a.omega_dot, Vector3::new(0.25, -0.375, -0.03125));
    assert_eq!(a.r_b_n_ddot, Vector3::zeros());
}

/// A force through B turns a hub whose centre of mass lies aside: `I omega' = -r_c x F`, and B's
/// acceleration is the centre's less `omega' x r_c`.
#[test]
fn force_beside_the_centre_of_mass_turns_the_hub() {
    let mut case = free_hub(Vector3::zeros());
    case.hub.r_bc_b = Vector3::new(0.0, 2.0, 0.0);
    case.inputs.force = Vector3::new(20.0, 0.0, 0.0);
    let a = case.reference();
    assert_eq!(a.omega_dot, Vector3::new(0.0, 0.0, 10.0));
    assert_eq!(a.r_b_n_ddot, Vector3::new(2.0 + 20.0, 0.0, 0.0));
}

/// A balanced wheel about the hub's axis: the motor spins it up against the hub and both gimbals.
#[test]
fn balanced_wheel_and_hub_share_the_motor_torque() {
    let diagonal = |x, y, z| Matrix3::from_diagonal(&Vector3::new(x, y, z));
    let device = Dgvscmg {
        mount: Matrix3::identity(),
        r_go_b: Vector3::zeros(),
        m_go: 1.0,
        r_goc_go: Vector3::zeros(),
        i_go_goc: diagonal(2.0, 1.0, 1.0),
        l_o: Vector3::zeros(),
        m_gi: 1.0,
        r_gic_gi: Vector3::zeros(),
        i_gi_gic: diagonal(1.0, 1.0, 1.0),
        l_i: Vector3::zeros(),
        m_w: 1.0,
        d: 0.0,
        i_w_wc: diagonal(0.5, 0.25, 0.25),
        passive: PerJoint::all(Passive::none()),
        model: ImbalanceModel::Coupled,
    };
    let case = Case {
        hub: free_hub(Vector3::zeros()).hub,
        devices: [device],
        state: State {
            omega: Vector3::new(0.5, 0.0, 0.0),
            devices: [Joints { spin: 100.0, theta: 0.75, ..Dgvscmg::at_rest() }],
            ..State::at_rest()
        },
        inputs: Inputs {
            motors: [MotorTorques { u_o: 0.0, u_i: 0.0, u_w: 3.0 }],
            ..Inputs::none()
        },
    };
    let a = case.reference();
    // Hub and gimbals together: 1 + 2 + 1; the wheel: 0.5.
    assert!((a.omega_dot - Vector3::new(-3.0 / 4.0, 0.0, 0.0)).norm() < 1e-15);
    assert!((a.devices[0].spin_dot - (3.0 / 0.5 + 3.0 / 4.0)).abs() < 1e-14);
    assert!(a.devices[0].gamma_o_ddot.abs() + a.devices[0].gamma_i_ddot.abs() < 1e-15);
    assert!(a.r_b_n_ddot.norm() < 1e-15);
}

/// The conventions, written out: `s_x = cos(gi) g_x - sin(gi) s_z`,
/// `g_z = sin(gi) g_x + cos(gi) s_z`, `w_y = cos(th) s_y + sin(th) g_z`; columns of the mount are
/// the outer gimbal's axes at zero angle; each origin and centre of mass is given along the axes of
/// the frame it belongs to.
#[test]
fn frames_and_points_lie_where_the_conventions_put_them() {
    let unit_moments = Matrix3::from_diagonal(&Vector3::new(1.0, 2.0, 2.5));
    // x to y, y to z, z to x: the outer gimbal turns about b_x.
    let mount = Matrix3::new(0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0);
    let device = Dgvscmg {
        mount,
        r_go_b: Vector3::new(0.1, 0.2, 0.3),
        m_go: 1.0,
        r_goc_go: Vector3::new(0.4, 0.5, 0.6),
        i_go_goc: unit_moments,
        l_o: Vector3::new(0.7, 0.8, 0.9),
        m_gi: 1.0,
        r_gic_gi: Vector3::new(1.0, 1.1, 1.2),
        i_gi_gic: unit_moments,
        l_i: Vector3::new(1.3, 1.4, 1.5),
        m_w: 1.0,
        d: 1.6,
        i_w_wc: unit_moments,
        passive: PerJoint::all(Passive::none()),
        model: ImbalanceModel::Coupled,
    };
    let (go, gi, th) = (0.3_f64, 0.4_f64, 0.5_f64);
    let joints = Joints { gamma_o: go, gamma_i: gi, theta: th, ..Dgvscmg::at_rest() };
    let placed = Device::new(&device, &joints);

    let (m_x, m_y, m_z) = (Vector3::y(), Vector3::z(), Vector3::x());
    let s_z = m_z;
    let g_x = go.cos() * m_x + go.sin() * m_y;
    let s_y = go.cos() * m_y - go.sin() * m_x;
    let s_x = gi.cos() * g_x - gi.sin() * s_z;
    let g_z = gi.sin() * g_x + gi.cos() * s_z;
    let w_y = th.cos() * s_y + th.sin() * g_z;
    let along = |v: Vector3<f64>, x, y, z| v.x * x + v.y * y + v.z * z;

    let gi_origin = device.r_go_b + along(device.l_o, g_x, s_y, s_z);
    let w_origin = gi_origin + along(device.l_i, s_x, s_y, g_z);
    let expected = [
        device.r_go_b,
        gi_origin,
        w_origin,
        device.r_go_b + along(device.r_goc_go, g_x, s_y, s_z),
        gi_origin + along(device.r_gic_gi, s_x, s_y, g_z),
        w_origin + device.d * w_y,
    ];
    let centres = placed.bodies.map(|body| body.centre);
    for (point, expected) in placed.origins.into_iter().chain(centres).zip(expected) {
        assert!((point.r.to_nalgebra() - expected).norm() < 1e-15, "{point:?}, not {expected}");
    }
    for (axis, expected) in placed.axes.into_iter().zip([s_z, s_y, s_x]) {
        assert!((axis.to_nalgebra() - expected).norm() < 1e-15, "{axis:?}, not {expected}");
    }
    // The wheel's second moment of inertia, about w_y.
    let about_w_y = dot(Vector::from(&w_y), placed.bodies[2].inertia * Vector::from(&w_y));
    assert!((about_w_y - 2.0).abs() < 1e-15, "{about_w_y}");
}
