//! A printed test compiles, passes where the property holds, and builds the case again to the bit.

use nalgebra::{Matrix3, Vector3};
use precess_attack::{Case, code};
use precess_dynamics::{
    BalancedVscmg, BuiltIn, Each, Gravity, Hub, HubMode, ImbalanceModel, Inputs, JointStates, Mode,
    Passive, Quaternion, SloshMass, Vscmg, Wrench,
};

/// The file that is included below: exactly what is printed.
const PRINTED: &str = include_str!("fixtures/printed.rs");

#[expect(clippy::unreadable_literal, reason = "numbers as `{:?}` prints them")]
mod printed {
    include!("fixtures/printed.rs");
}

fn hub() -> Hub {
    let i_b_bc = Matrix3::new(9.0, 0.1, -0.2, 0.1, 8.0, 0.3, -0.2, 0.3, 6.0);
    Hub { m_b: 100.0, r_bc_b: Vector3::new(0.0, 0.0, 0.05), i_b_bc }
}

fn disc() -> Matrix3<f64> {
    Matrix3::from_diagonal(&Vector3::new(0.2, 0.1, 0.1))
}

/// Two kinds with everything that can be said of them.
fn mixed() -> Case {
    let mut wheel = Vscmg { d: 1e-4, m_g: 1.0, i_g_gc: disc(), ..Vscmg::bare_wheel(4.0, disc()) };
    wheel.r_g_b = Vector3::new(0.1, 0.0, 1.0 / 3.0);
    wheel.mount = Matrix3::new(0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0);
    wheel.model = ImbalanceModel::Lumped;
    wheel.passive.gimbal = Passive { rest: 0.1, ..Passive::spring(20.0, 0.3) };
    wheel.passive.wheel = Passive::friction(0.0, 1e-3, 1e-2);
    let devices = vec![wheel.into(), SloshMass::bare_slosh_mass(2.0).into()];
    let mut case = Case::still(hub(), devices);
    (case.state.r_b_n, case.state.omega) =
        (Vector3::new(7e3, 0.0, -1.0), Vector3::new(0.1, 0.2, 0.3));
    case.state.attitude = Quaternion { q0: 0.5, q1: 0.5, q2: -0.5, q3: 0.5 };
    for (index, [q, rate]) in case.state.devices.states_mut().enumerate() {
        (*q, *rate) = ([0.3, 100.0, -0.01][index], [0.0, 300.0, 0.1][index]);
    }
    case.inputs.force = Vector3::new(1.0, -2.0, 5e-324);
    case.inputs.gravity = Gravity::Central { mu: 4e5 };
    let modes = [Mode::Locked, Mode::Prescribed(0.5), Mode::Driven];
    case.inputs.modes.values_mut().zip(modes).for_each(|(to, mode)| *to = mode);
    case.inputs.motors.values_mut().for_each(|motor| *motor = 0.25);
    let craft = case.list().expect("valid parameters").craft;
    let mut bodies = Inputs::no_wrenches_for(&craft);
    if let Some(wrench) = bodies.values_mut().next() {
        *wrench = Wrench { force: Vector3::x(), moment: Vector3::zeros() };
    }
    case.inputs.bodies = Some(bodies);
    case
}

/// Several states of one device, a bad one among them.
fn batch() -> Case {
    let device = BuiltIn::from(BalancedVscmg::bare_wheel(4.0, 0.2, 0.1));
    let mut case = Case::still(hub(), vec![device]);
    (case.steps, case.dt) = (3, 1e-4);
    let (mut state, mut inputs) = (case.state.clone(), case.inputs.clone());
    state.omega.x = f64::NAN;
    state.r_b_n.y = f64::NEG_INFINITY;
    inputs.gravity = Gravity::Uniform(Vector3::new(0.0, 0.0, -9.81));
    inputs.hub = HubMode::Fixed;
    case.more.push((state, inputs));
    let (mut state, inputs) = (case.state.clone(), case.inputs.clone());
    state.devices.states_mut().for_each(|[_, rate]| *rate = 1.0);
    case.more.push((state, inputs));
    case
}

#[test]
fn printed_code_is_what_is_compiled() {
    let tests = [
        code::test("mixed", "residual::inverse_dynamics", &mixed()),
        code::test("batch", "same::batch_is_spacecraft", &batch()),
        code::test("hub_alone", "energy::ledger_balances", &Case::still(hub(), Vec::new())),
    ]
    .join("\n");
    let found = format!("{}\n{tests}", code::imports(&tests));
    let path = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("printed.rs");
    if found != PRINTED {
        std::fs::write(&path, &found).expect("a file in the target folder");
    }
    assert!(found == PRINTED, "another text; see {}", path.display());
}
