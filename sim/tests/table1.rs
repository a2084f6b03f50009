//! Table 1 is written three times, independently from the paper: for the suites, in the
//! scenario files of the desktop tool, and in codegen for the consequences of printed slips. They agree.

use std::path::Path;

use nalgebra::{Matrix3, Vector3};
use precess::scenario::{Drive, Profile};
use precess_dynamics::dgvscmg::{Joints, MotorTorques, PerJoint};
use precess_dynamics::{
    BuiltIn, Dgvscmg, Each, FixedSet, Gravity, Hub, HubMode, ImbalanceModel, Inputs, JointStates,
    Mode, Passive, Quaternion, State,
};
use precess_review::consequence::table1 as derived;
use precess_tests::case::Set;
use precess_tests::table1::{Drive as Motors, Imbalance, SCENARIOS, scenario};

/// Units are turned into SI by other factors here and there (`500 * tau / 60`, `500 * pi / 30`):
/// two roundings of half an epsilon each.
const ROUNDING: f64 = f64::EPSILON;

type NamedColumns = Vec<(&'static str, Vec<f64>)>;

/// Every number of a scenario. A field that is added to one of the types does not compile here
/// until it is compared too.
fn numbers(
    hub: &Hub,
    device: &Dgvscmg,
    state: &State<Set<1>>,
    inputs: &Inputs<Set<1>>,
) -> NamedColumns {
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
        passive,
        model,
    } = device;
    let State { r_b_n, r_b_n_dot, attitude, omega, devices: [joints], .. } = state;
    let Quaternion { q0, q1, q2, q3 } = *attitude;
    let Joints { gamma_o, gamma_i, theta, gamma_o_dot, gamma_i_dot, spin } = *joints;
    let Inputs { force, torque_b, motors: [motor], modes, hub, gravity, bodies, .. } = inputs;
    let MotorTorques { u_o, u_i, u_w } = *motor;
    // What the table knows nothing of.
    assert_eq!((*passive, *model), (PerJoint::all(Passive::none()), ImbalanceModel::Coupled));
    assert_eq!((*modes, *hub), ([PerJoint::all(Mode::Driven)], HubMode::Free));
    assert_eq!((*gravity, *bodies), (Gravity::None, None));
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

/// The scenario file of a variant, as the typed structures of the suites.
fn tool(name: &str) -> (Hub, Dgvscmg, State<Set<1>>, Inputs<Set<1>>) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../scenarios/{name}.toml"));
    let (file, _) =
        precess::file::from_file(&path, &[]).unwrap_or_else(|errors| panic!("{errors}"));
    let Some([BuiltIn::Dgvscmg(device)]) = file.devices_on_hub() else {
        panic!("{:?}", file.devices)
    };
    let device = *device;
    let mut state = State::<Set<1>>::at_rest();
    (state.r_b_n, state.r_b_n_dot) = (file.initial.r_b_n, file.initial.r_b_n_dot);
    (state.attitude, state.omega) = (file.initial.attitude, file.initial.omega);
    for ([q, rate], [from, from_rate]) in
        state.devices.states_mut().zip(file.initial.devices.states())
    {
        (*q, *rate) = (from, from_rate);
    }
    let mut inputs = Inputs::<Set<1>>::none();
    for (torque, drive) in inputs.motors.values_mut().zip(&file.drives) {
        let Drive::Torque { profile: Profile::Constant(value), limit: None } = drive else {
            panic!("{drive:?}");
        };
        *torque = *value;
    }
    (inputs.hub, inputs.gravity) = (file.hub_mode, file.gravity);
    assert!(file.wrenches.is_empty() && file.changes.is_empty() && file.stops.is_empty());
    (file.hub, device, state, inputs)
}

#[test]
fn desktop_tool_and_suites_run_the_same_table_1() {
    for (imbalance, drive) in SCENARIOS {
        let case = scenario(imbalance, drive);
        let wheel = match imbalance {
            Imbalance::Printed => "printed",
            Imbalance::Catalogue => "catalogue",
        };
        let motors = match drive {
            Motors::Free => "free",
            Motors::Wheel200 => "200",
            Motors::Wheel250 => "250",
        };
        let (hub, device, state, inputs) = tool(&format!("table1-{wheel}-{motors}"));
        let here = numbers(&case.hub, &case.devices[0], &case.state, &case.inputs);
        let there = numbers(&hub, &device, &state, &inputs);
        for ((what, here), (_, there)) in here.iter().zip(&there) {
            let agree = here.iter().zip(there).all(|(a, b)| (a - b).abs() <= ROUNDING * b.abs());
            assert!(agree, "{imbalance:?} {drive:?}, {what}: {here:?}, but {there:?} in the tool");
        }
    }
}

/// The six entries of a symmetric matrix by name.
fn entries(stem: &str, matrix: &Matrix3<f64>) -> Vec<(String, f64)> {
    assert_eq!(*matrix, matrix.transpose(), "{stem}");
    [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)]
        .map(|(i, j)| (format!("{stem}_{}{}", i + 1, j + 1), matrix[(i, j)]))
        .to_vec()
}

/// The three components of a vector by name.
fn components(stem: &str, axes: &str, vector: &Vector3<f64>) -> Vec<(String, f64)> {
    let named = |(axis, value): (&str, &f64)| (format!("{stem}_{axes}{axis}"), *value);
    ["x", "y", "z"].into_iter().zip(vector.iter()).map(named).collect()
}

#[test]
fn printed_slips_are_run_on_the_same_table_1() {
    let case = scenario(Imbalance::Printed, Motors::Wheel200);
    let Hub { m_b, r_bc_b, i_b_bc } = &case.hub;
    let [
        Dgvscmg {
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
            passive,
            model,
        },
    ] = &case.devices;
    assert_eq!(*mount, Matrix3::identity(), "the pages know no mount");
    assert_eq!((*passive, *model), (PerJoint::all(Passive::none()), ImbalanceModel::Coupled));
    let masses = [
        ("m_b", *m_b),
        ("m_go", *m_go),
        ("m_gi", *m_gi),
        ("m_w", *m_w),
        ("m_v", m_gi + m_w),
        ("m_d", m_go + m_gi + m_w),
        ("m_sc", m_b + m_go + m_gi + m_w),
        ("d", *d),
    ];
    let mut parameters = [
        masses.map(|(name, value)| (name.to_owned(), value)).to_vec(),
        components("r_bc_b", "b", r_bc_b),
        entries("i_b", i_b_bc),
        components("r_go_b", "b", r_go_b),
        components("r_goc_go", "go", r_goc_go),
        entries("i_go", i_go_goc),
        components("l_o", "", l_o),
        components("r_gic_gi", "gi", r_gic_gi),
        entries("i_gi", i_gi_gic),
        components("l_i", "", l_i),
        entries("j", i_w_wc),
    ]
    .concat();
    let mut there = derived::PARAMETERS.map(|(name, value)| (name.to_owned(), value)).to_vec();
    parameters.sort_by(|a, b| a.0.cmp(&b.0));
    there.sort_by(|a, b| a.0.cmp(&b.0));
    assert_eq!(parameters, there);

    // Runs there start at rest but for these rates, and without force or torque from outside.
    let ([joints], [motor]) = (case.state.devices, case.inputs.motors);
    let start = State::at_rest();
    let omega = case.state.omega;
    let devices = [Joints { spin: joints.spin, ..Dgvscmg::at_rest() }];
    assert_eq!(case.state, State { omega, devices, ..start });
    assert_eq!(case.inputs, Inputs { motors: [motor], ..Inputs::none() });
    let MotorTorques { u_o, u_i, u_w } = motor;
    assert_eq!([u_o, u_i, u_w], derived::TORQUES);
    let [gamma_o_dot, gamma_i_dot, spin] = derived::RATES;
    assert_eq!([gamma_o_dot, gamma_i_dot], [0.0, 0.0]);
    let rates = [joints.spin, omega.x, omega.y, omega.z];
    let [x, y, z] = derived::OMEGA;
    for (here, there) in rates.into_iter().zip([spin, x, y, z]) {
        assert!((here - there).abs() <= ROUNDING * there.abs(), "{here} {there}");
    }
}
