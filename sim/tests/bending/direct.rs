//! Runs against the library called directly, and reductions to the rigid spacecraft.

use nalgebra::Vector3;
use precess::file::{from_toml, to_toml};
use precess::scenario::{IntegratorChoice, Scenario};
use precess_dynamics::{
    Flexible, Inputs, ListedModes, ModalMount, Modes, Spacecraft, State, Wrench,
};

use super::{BEAM, columns, folder, ran, text};

fn craft(scenario: &Scenario) -> Spacecraft<precess::scenario::Set, Flexible<ListedModes>> {
    scenario.flexible().expect("a structure").expect("valid")
}

/// RK4 of the engine is a loop over `Spacecraft::step`, to the bit.
#[test]
fn rk4_is_the_library_to_the_bit() {
    let text_of = BEAM.replace(
        "duration = \"0.4 s\"",
        "duration = \"0.1 s\"\nintegrator = \"rk4\"\nstep = \"1 ms\"",
    );
    let mut scenario = text(&text_of);
    scenario.output.rate = 1000.0;
    let of = scenario.structure.as_ref().expect("a structure").clone();
    // The same modes by hand.
    let modes = Modes::<ListedModes> {
        frequencies: of.modes.iter().map(|mode| mode.frequency).collect(),
        damping: vec![0.01, 0.02],
        linear: vec![Vector3::new(0.0, 0.0, 1.2), Vector3::new(0.0, 0.7, 0.0)],
        angular: vec![Vector3::new(0.0, -1.1, 0.0), Vector3::new(0.1, 0.0, 0.2)],
        mounts: vec![ModalMount { point: of.nodes[0].point(), contained: None }],
    };
    let craft = Spacecraft::flexible(
        &scenario.hub,
        &modes,
        &scenario.devices,
        &(vec![0], Vec::new(), Vec::new()),
    );
    let craft = craft.expect("valid");
    let mut state = State::at_rest_for(&craft);
    state = scenario.initial.clone().with_modal(state.modal);
    let (samples, outcome) = ran(&scenario);
    let names = ["modes.eta_1", "modes.eta_dot_2", "omega_y", "rw.spin", "position_z"];
    let rows = columns(&samples, names);
    let mut inputs = Inputs::none_for(&craft);
    for (step, row) in (0_u32..).zip(&rows) {
        let rigid = &state;
        let expected = [
            state.modal.eta[0],
            state.modal.eta_dot[1],
            rigid.omega.y,
            rigid.devices.0[0][0][1],
            rigid.r_b_n.z,
        ];
        assert_eq!(*row, expected, "step {step}");
        let time = f64::from(step) * 1e-3;
        let phase = std::f64::consts::TAU * 3.0 * time;
        inputs.motors.0[0][0] = 5e-3 * precess_dynamics::Angle::sin_cos(phase).0;
        state = craft.step(&state, &inputs, 1e-3).expect("a step");
    }
    assert_eq!(rows.len(), 101);
    // The error of the method at 94 rad/s and 1 ms: 0.094^4 / 120 a step. Measured: 2e-11 and 2e-8.
    assert!(outcome.drift.energy.is_some_and(|drift| drift < 1e-9), "{:?}", outcome.drift);
    assert!(outcome.drift.linear.is_some_and(|drift| drift < 1e-6), "{:?}", outcome.drift);
}

/// Energy and momenta of a free structure with wheel, motor, friction and modal damping.
#[test]
fn the_ledger_closes_and_momentum_is_conserved() {
    let scenario =
        text(&BEAM.replace("duration = \"0.4 s\"", "duration = \"0.4 s\"\ntolerance = 1e-12"));
    let (samples, outcome) = ran(&scenario);
    let drift = outcome.drift;
    println!("{drift:?}");
    for found in [drift.energy, drift.linear, drift.angular] {
        assert!(found.is_some_and(|found| found < 1e-11), "{drift:?}");
    }
    // What dampers take is negative work: much more than the drift.
    let rows = columns(&samples, ["energy", "work", "tip.displacement_z"]);
    assert!(
        rows.iter().any(|row| row[1].abs() > 1e-6) && rows.iter().any(|row| row[2].abs() > 1e-6)
    );
}

/// Both integrators find the same motion: dop853 at its tolerance, RK4 at a tenth of a millisecond.
#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn both_integrators_agree() {
    let mut scenario = text(
        &BEAM
            .replace("torque = { sine = \"5 mN m\", frequency = \"3 Hz\" }", "torque = \"5 mN m\""),
    );
    let names = ["modes.eta_1", "modes.eta_2", "tip.rotation_y", "tip.omega_y", "tip.sigma_1"];
    let [dense, fixed] = [None, Some(1e-4)].map(|step| {
        if let Some(step) = step {
            scenario.settings.integrator = IntegratorChoice::Rk4 { step };
        }
        columns(&ran(&scenario).0, names)
    });
    for (a, b) in dense.iter().zip(&fixed) {
        for (a, b) in a.iter().zip(b) {
            assert!((a - b).abs() < 1e-8, "{a} {b}");
        }
    }
}

/// A step that is too long for the modes is refused with the longest.
#[test]
fn rk4_refuses_a_step_too_long_for_the_modes() {
    let mut scenario = text(BEAM);
    scenario.settings.integrator = IntegratorChoice::Rk4 { step: 0.1 };
    let mut samples = precess::record::Samples::default();
    let outcome =
        precess::engine::run(&scenario, &mut samples, &mut |_| std::ops::ControlFlow::Continue(()));
    let outcome = outcome.expect("it begins");
    let precess::record::End::Failed(error) = &outcome.end else { panic!("{}", outcome.end) };
    assert!(error.to_string().contains("too long for the modes"), "{error}");
}

/// Modes with shapes and momentum of zero move nothing: the rigid run, to rounding of another order
/// of operations.
const RIGID_MISS: f64 = 1e-12;

#[test]
fn without_shapes_it_is_the_rigid_run() {
    let mut bending =
        text(&BEAM.replace("duration = \"0.4 s\"", "duration = \"0.4 s\"\ntolerance = 1e-12"));
    let structure = bending.structure.as_mut().expect("a structure");
    for mode in &mut structure.modes {
        (mode.linear, mode.angular) = (Vector3::zeros(), Vector3::zeros());
    }
    for node in &mut structure.nodes {
        node.shapes.fill([0.0; 6]);
    }
    let mut rigid = bending.clone();
    rigid.structure = None;
    let names = ["omega_x", "omega_y", "omega_z", "position_x", "position_z", "rw.spin_dot", "q0"];
    let [bending, rigid] = [bending, rigid].map(|scenario| columns(&ran(&scenario).0, names));
    let mut miss: f64 = 0.0;
    for (a, b) in bending.iter().zip(&rigid) {
        miss = a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(miss, f64::max);
    }
    println!("{miss:e}");
    assert!(miss < RIGID_MISS, "{miss:e}");
}

/// Hub and modes that contain the devices' mass, and it subtracted: the same accelerations as of
/// those without it, where no mode moves the mount.
#[test]
fn contained_devices_are_subtracted() {
    let without = text(BEAM);
    let mut with = without.clone();
    let wheel = with.devices.0[0].parameters().bodies[0];
    let mut wheel_at = Vector3::from(wheel.origin);
    // The centre of mass of the wheel, from B, at the initial angle: along its y axis.
    wheel_at += with.devices.0[0].parameters().mount * Vector3::from(wheel.centre);
    let of = |m, c: Vector3<f64>, i: nalgebra::Matrix3<f64>| {
        precess::structure::RigidMass::about_centre(m, c, i)
    };
    let mount = with.devices.0[0].parameters().mount;
    let own = of(wheel.mass, wheel_at, mount * wheel.inertia * mount.transpose());
    let hub = of(with.hub.m_b, with.hub.r_bc_b, with.hub.i_b_bc);
    let mass = own.mass + hub.mass;
    let centre = (own.first_moment + hub.first_moment) / mass;
    let cross = centre.cross_matrix();
    with.hub.m_b = mass;
    with.hub.r_bc_b = centre;
    with.hub.i_b_bc = own.inertia + hub.inertia + mass * cross * cross;
    let structure = with.structure.as_mut().expect("a structure");
    structure.contains_devices = true;
    let mut without = without;
    for scenario in [&mut with, &mut without] {
        let structure = scenario.structure.as_mut().expect("a structure");
        for node in &mut structure.nodes {
            node.shapes.fill([0.0; 6]);
        }
    }
    let (a, b) = (craft(&with), craft(&without));
    assert!((a.mass() - b.mass()).abs() < 1e-12 * b.mass(), "{} {}", a.mass(), b.mass());
    let masses = [&with, &without].map(|scenario| scenario.spacecraft().expect("valid").mass());
    assert!((masses[0] - masses[1]).abs() < 1e-12 * masses[1], "{masses:?}");
    let accelerations = [(&a, &with), (&b, &without)].map(|(craft, scenario)| {
        let mut state = State::at_rest_for(craft);
        state = scenario.initial.clone().with_modal(state.modal);
        state.omega = Vector3::new(0.1, -0.2, 0.3);
        let mut inputs = Inputs::none_for(craft);
        inputs.modal.mounts[0] =
            Wrench { force: Vector3::new(1.0, 2.0, 3.0), moment: Vector3::zeros() };
        craft.accelerations(&state, &inputs).expect("regular")
    });
    let [a, b] = accelerations;
    assert!((a.omega_dot - b.omega_dot).norm() < 1e-12, "{a:?}\n{b:?}");
    assert!(
        (a.modal.eta_ddot[0] - b.modal.eta_ddot[0]).abs()
            < 1e-12 * b.modal.eta_ddot[0].abs().max(1.0)
    );
}

#[test]
fn a_structure_is_written_and_read_back_the_same() {
    let first = text(&BEAM.replace(
        "contains_devices = false",
        "contains_devices = false\ncoordinates = [0.001, 0]\nrates = [0, 0.02]",
    ));
    let written = to_toml(&first);
    let (second, _) = from_toml("written.toml", &written, &folder())
        .unwrap_or_else(|errors| panic!("{errors}\n{written}"));
    assert_eq!(second.structure, first.structure);
    assert_eq!(to_toml(&second), written);
    let structure = first.structure.expect("a structure");
    assert_eq!(structure.coordinates, [0.001, 0.0]);
    // The node that nothing uses is left out; the wheel is at its own.
    assert_eq!(structure.nodes.len(), 1);
    assert_eq!(first.devices.0[0].parameters().bodies[0].origin, [1.2, 0.0, 0.0]);
}
