//! Table 1 stands twice, typed independently from the paper: here for the suites and in the desktop
//! tool for its runs. They agree.

use nalgebra::{Matrix3, Vector3};
use precess::scenario::table1::{self as tool, variants};
use precess_dynamics::{Dgvscmg, Hub, Joints, MotorTorques, Quaternion, State, Torques};
use precess_tests::table1::{Drive, Imbalance, SCENARIOS, scenario};

/// Units are turned into SI by other factors here and there (`500 * tau / 60`, `500 * pi / 30`):
/// two roundings of half an epsilon each.
const ROUNDING: f64 = f64::EPSILON;

type Named = Vec<(&'static str, Vec<f64>)>;

/// Every number of a scenario. A field that is added to one of the types does not compile here
/// until it is compared too.
fn numbers(hub: &Hub, device: &Dgvscmg, state: &State<1>, torques: &Torques<1>) -> Named {
    let vector = |v: &Vector3<f64>| v.iter().copied().collect();
    let matrix = |m: &Matrix3<f64>| m.iter().copied().collect();
    let Hub { m_b, r_bc_b, i_b_bc } = hub;
    let Dgvscmg {
        mount,
        r_go_b,
        m_go,
        r_goc_go,
        i_go_goc,
        l_o,
        m_gi,
        r_gic_gi,
        i_gi_gic,
        l_i,
        m_w,
        d,
        i_w_wc,
    } = device;
    let State { r_b_n, r_b_n_dot, attitude, omega, devices: [joints] } = state;
    let Quaternion { q0, q1, q2, q3 } = *attitude;
    let Joints { gamma_o, gamma_i, theta, gamma_o_dot, gamma_i_dot, spin } = *joints;
    let Torques { force, torque_b, motors: [motor] } = torques;
    let MotorTorques { u_o, u_i, u_w } = *motor;
    vec![
        ("m_b, m_go, m_gi, m_w, d", vec![*m_b, *m_go, *m_gi, *m_w, *d]),
        ("r_bc_b", vector(r_bc_b)),
        ("i_b_bc", matrix(i_b_bc)),
        ("mount", matrix(mount)),
        ("r_go_b", vector(r_go_b)),
        ("r_goc_go", vector(r_goc_go)),
        ("i_go_goc", matrix(i_go_goc)),
        ("l_o", vector(l_o)),
        ("r_gic_gi", vector(r_gic_gi)),
        ("i_gi_gic", matrix(i_gi_gic)),
        ("l_i", vector(l_i)),
        ("i_w_wc", matrix(i_w_wc)),
        ("r_b_n", vector(r_b_n)),
        ("r_b_n_dot", vector(r_b_n_dot)),
        ("attitude", vec![q0, q1, q2, q3]),
        ("omega", vector(omega)),
        ("joints", vec![gamma_o, gamma_i, theta, gamma_o_dot, gamma_i_dot, spin]),
        ("force", vector(force)),
        ("torque_b", vector(torque_b)),
        ("motors", vec![u_o, u_i, u_w]),
    ]
}

#[test]
fn desktop_tool_and_suites_run_the_same_table_1() {
    assert_eq!(variants(None, None).len(), SCENARIOS.len());
    for (imbalance, drive) in SCENARIOS {
        let case = scenario(imbalance, drive);
        let variant = tool::Variant {
            imbalance: match imbalance {
                Imbalance::Printed => tool::Imbalance::Printed,
                Imbalance::Catalogue => tool::Imbalance::Catalogue,
            },
            drive: match drive {
                Drive::Free => tool::Drive::Free,
                Drive::Wheel200 => tool::Drive::Wheel200,
                Drive::Wheel250 => tool::Drive::Wheel250,
            },
        };
        let run = variant.scenario();
        let here = numbers(&case.hub, &case.devices[0], &case.state, &case.torques);
        let there = numbers(&run.hub, &run.devices[0], &run.state, &run.torques);
        for ((what, here), (_, there)) in here.iter().zip(&there) {
            let agree = here.iter().zip(there).all(|(a, b)| (a - b).abs() <= ROUNDING * b.abs());
            assert!(agree, "{imbalance:?} {drive:?}, {what}: {here:?}, but {there:?} in the tool");
        }
    }
}
