//! What a spacecraft does, by laws that can be stated in a line.

use std::string::ToString;

use nalgebra::{Matrix3, Vector3};

use crate::attitude::mrp::Mrp;
use crate::equations::error::{Quantity, SolveError};
use crate::model::kind::Kind;
use crate::results::momentum::{About, EnergyAndMomentum, Momentum};
use crate::{
    Accelerations, Attitude, Dgvscmg, Gravity, Hub, HubMode, Inputs, JointPower, LoadAxes, Mode,
    ParameterError, Part, Passive, Spacecraft, State, Warning, dgvscmg,
};

/// A few dozen rounded operations on numbers of size 1 to 1000.
const ROUNDING: f64 = 1e-12;

fn hub() -> Hub {
    Hub {
        m_b: 20.0,
        r_bc_b: Vector3::new(0.1, -0.2, 0.3),
        i_b_bc: Matrix3::new(4.0, 0.3, -0.2, 0.3, 5.0, 0.6, -0.2, 0.6, 7.0),
    }
}

fn wheel() -> Dgvscmg {
    let disc = Matrix3::from_diagonal(&Vector3::new(0.2, 0.1, 0.1));
    Dgvscmg { r_go_b: Vector3::new(0.3, 0.0, 0.1), ..Dgvscmg::bare_wheel(4.0, disc) }
}

#[test]
fn plain_hub_obeys_newton_and_euler_about_its_centre_of_mass() {
    let spacecraft = Spacecraft::<[Dgvscmg; 0]>::new(&hub(), &[]).unwrap();
    let omega = Vector3::new(0.3, -0.5, 0.2);
    let state = State::<[Dgvscmg; 0]> { omega, ..State::at_rest() };
    let force = Vector3::new(1.0, 2.0, -3.0);
    let torque_b = Vector3::new(-0.4, 0.1, 0.6);
    let torques = Inputs { force, torque_b, ..Inputs::none() };
    let found = spacecraft.accelerations(&state, &torques).unwrap();

    let Hub { m_b, r_bc_b: c, i_b_bc } = hub();
    let at_c = found.r_b_n_ddot + found.omega_dot.cross(&c) + omega.cross(&omega.cross(&c));
    assert!((at_c * m_b - force).amax() <= ROUNDING);
    let euler = i_b_bc * found.omega_dot + omega.cross(&(i_b_bc * omega));
    assert!((euler - (torque_b - c.cross(&force))).amax() <= ROUNDING);
}

#[test]
fn mass_and_centre_of_mass_count_every_body() {
    let device = Dgvscmg { m_go: 1.0, m_gi: 2.0, ..wheel() };
    let spacecraft = Spacecraft::new(&hub(), &[device, wheel()]).unwrap();
    assert_eq!(spacecraft.mass(), 20.0 + 7.0 + 4.0);
    let found = spacecraft.centre_of_mass(&State::<[Dgvscmg; 2]>::at_rest()).unwrap();
    let expected = (hub().r_bc_b * 20.0 + wheel().r_go_b * 11.0) / 31.0;
    assert!((found.c - expected).amax() <= ROUNDING);
    assert!(found.c_prime.amax() <= ROUNDING);
}

#[test]
fn total_mass_must_be_finite() {
    let text = |heaviest: fn(&mut Hub, &mut Dgvscmg)| {
        let (mut hub, mut device) = (hub(), wheel());
        heaviest(&mut hub, &mut device);
        let error = Spacecraft::new(&hub, &[wheel(), device]).unwrap_err();
        assert_eq!(error, ParameterError::TotalMass { value: f64::INFINITY });
        error.to_string()
    };
    // Beyond f64 within one device, and with the hub only.
    let expected = "total mass inf kg is not finite; check the units of the masses";
    assert_eq!(text(|_, device| (device.m_go, device.m_gi) = (1e308, 1e308)), expected);
    assert_eq!(text(|hub, device| (hub.m_b, device.m_go) = (1e308, 1e308)), expected);
}

#[test]
fn mount_turns_the_wheel_axis_into_the_hub() {
    // The wheel's axis along b_z: the columns are the outer gimbal's x, y, z along B.
    let mount = Matrix3::new(0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0);
    let hub_at_b = Hub { r_bc_b: Vector3::zeros(), ..hub() };
    let device = Dgvscmg { mount, r_go_b: Vector3::zeros(), ..wheel() };
    let spacecraft = Spacecraft::new(&hub_at_b, &[device]).unwrap();
    let mut state = State::<[Dgvscmg; 1]>::at_rest();
    state.devices[0].spin = 10.0;
    let Momentum { angular, .. } = spacecraft.momentum(&state, About::CentreOfMass).unwrap();
    assert!((angular - Vector3::new(0.0, 0.0, 2.0)).amax() <= ROUNDING);
    assert!((spacecraft.energy(&state).unwrap() - 10.0).abs() <= ROUNDING);
}

#[test]
fn motor_accelerates_wheel_and_hub_against_each_other() {
    let hub_at_b = Hub {
        r_bc_b: Vector3::zeros(),
        i_b_bc: Matrix3::from_diagonal(&Vector3::new(4.0, 5.0, 7.0)),
        ..hub()
    };
    let device = Dgvscmg { r_go_b: Vector3::zeros(), ..wheel() };
    let spacecraft = Spacecraft::new(&hub_at_b, &[device]).unwrap();
    let mut torques = Inputs::<[Dgvscmg; 1]>::none();
    torques.motors[0].u_w = 0.6;
    let found = spacecraft.accelerations(&State::<[Dgvscmg; 1]>::at_rest(), &torques).unwrap();
    assert!((found.omega_dot - Vector3::new(-0.15, 0.0, 0.0)).amax() <= ROUNDING);
    assert!((found.devices[0].spin_dot - (3.0 + 0.15)).abs() <= ROUNDING);
}

#[test]
fn momentum_about_points_differs_by_the_arm() {
    let spacecraft = Spacecraft::new(&hub(), &[wheel()]).unwrap();
    let mut state = State::<[Dgvscmg; 1], Mrp> {
        r_b_n: Vector3::new(5.0, -3.0, 2.0),
        r_b_n_dot: Vector3::new(0.2, 0.7, -0.1),
        attitude: Mrp::from_components(0.1, 0.3, -0.2),
        omega: Vector3::new(0.3, -0.5, 0.2),
        ..State::at_rest()
    };
    state.devices[0].spin = 30.0;
    let about = |point| spacecraft.momentum(&state, point).unwrap();
    let origin = about(About::InertialOrigin);
    let point = Vector3::new(1.0, 2.0, 3.0);
    let shifted = about(About::Point(point));
    assert_eq!(origin.linear, shifted.linear);
    let expected = origin.angular - point.cross(&origin.linear);
    assert!((shifted.angular - expected).amax() <= 10.0 * ROUNDING);
    // The centre of mass as a point fixed in N gives the same.
    let c = spacecraft.centre_of_mass(&state).unwrap().c;
    let c_n = state.r_b_n + state.attitude.dcm().transpose() * c;
    let centre = about(About::CentreOfMass).angular;
    assert!((centre - about(About::Point(c_n)).angular).amax() <= 10.0 * ROUNDING);
    let lost = spacecraft.momentum(&state, About::Point(point * f64::INFINITY));
    let (what, value) = (Quantity::ReferencePoint, f64::INFINITY);
    assert_eq!(lost, Err(SolveError::NotFinite { what, value }));
}

#[test]
fn wheel_that_breaks_the_triangle_inequality_is_accepted_with_a_warning() {
    let mut printed = wheel();
    printed.i_w_wc[(0, 2)] = 0.0154;
    printed.i_w_wc[(2, 0)] = 0.0154;
    let spacecraft = Spacecraft::new(&hub(), &[wheel(), printed]).unwrap();
    let mut warnings = spacecraft.warnings();
    let Some(Warning::Triangle { part, excess }) = warnings.next() else {
        panic!("no warning");
    };
    assert_eq!(part, Part::Body { device: 1, body: "wheel" });
    // Largest minus the others, of the block 0.2, 0.0154, 0.1 and the 0.1 next to it.
    let root = (0.05_f64.powi(2) + 0.0154_f64.powi(2)).sqrt();
    assert!((excess - (2.0 * root - 0.1)).abs() <= ROUNDING);
    assert_eq!(warnings.next(), None);
}

#[test]
fn input_that_is_not_finite_is_named() {
    /// Not NaN, which equals nothing.
    const BAD: f64 = f64::NEG_INFINITY;
    let spacecraft = Spacecraft::new(&hub(), &[wheel(), wheel()]).unwrap();
    let found = |change: fn(&mut State<[Dgvscmg; 2]>, &mut Inputs<[Dgvscmg; 2]>)| {
        let (mut state, mut torques) = (State::at_rest(), Inputs::none());
        change(&mut state, &mut torques);
        spacecraft.accelerations(&state, &torques)
    };
    let rejected = |what| Err(SolveError::NotFinite { what, value: BAD });
    let joint = |field| Quantity::Joint { device: 1, field };
    assert!(found(|_, _| ()).is_ok());
    assert_eq!(found(|s, _| s.r_b_n.x = BAD), rejected(Quantity::Position));
    assert_eq!(found(|s, _| s.attitude.q0 = BAD), rejected(Quantity::Attitude));
    assert_eq!(found(|s, _| s.omega.z = BAD), rejected(Quantity::BodyRate));
    for (field, result) in [
        ("gamma_o", found(|s, _| s.devices[1].gamma_o = BAD)),
        ("gamma_i", found(|s, _| s.devices[1].gamma_i = BAD)),
        ("theta", found(|s, _| s.devices[1].theta = BAD)),
        ("gamma_o_dot", found(|s, _| s.devices[1].gamma_o_dot = BAD)),
        ("gamma_i_dot", found(|s, _| s.devices[1].gamma_i_dot = BAD)),
        ("spin", found(|s, _| s.devices[1].spin = BAD)),
    ] {
        assert_eq!(result, rejected(joint(field)));
    }
    let motor = Quantity::Motor { device: 0, joint: "inner gimbal" };
    assert_eq!(found(|_, t| t.motors[0].u_i = BAD), rejected(motor));
    assert_eq!(found(|_, t| t.torque_b.y = BAD), rejected(Quantity::TorqueB));
    // The square of this rate is beyond f64.
    assert_eq!(
        found(|s, _| s.omega.x = 1e200),
        Err(SolveError::Overflow { what: Quantity::HubAcceleration })
    );
}

#[test]
fn massless_gimbals_are_singular_at_a_quarter_turn_only() {
    let spacecraft = Spacecraft::new(&hub(), &[wheel()]).unwrap();
    let mut state = State::<[Dgvscmg; 1]>::at_rest();
    state.devices[0].gamma_i = 1.5;
    assert!(spacecraft.accelerations(&state, &Inputs::none()).is_ok());
    state.devices[0].gamma_i = core::f64::consts::FRAC_PI_2;
    let found = spacecraft.accelerations(&state, &Inputs::none());
    let Err(SolveError::Singular { device, joint, pivot, bound }) = found else {
        panic!("{found:?} is not a singular pose");
    };
    assert_eq!((device, joint), (Some(0), Some("outer gimbal")));
    assert!(pivot <= bound && bound < 1e-13);
}

#[test]
fn what_is_not_finite_is_rejected_even_where_it_does_nothing() {
    let spacecraft = Spacecraft::new(&hub(), &[wheel()]).unwrap();
    let state = State::<[Dgvscmg; 1]>::at_rest();
    let rejected = |change: fn(&mut Inputs<[Dgvscmg; 1]>)| {
        let mut inputs = Inputs::none();
        change(&mut inputs);
        let found = spacecraft.accelerations(&state, &inputs).map(|_| ());
        assert_eq!(spacecraft.step(&state, &inputs, 0.1).map(|_| ()), found);
        found
    };
    let up = f64::INFINITY;
    let what = Quantity::Force;
    let fixed = rejected(|i| (i.hub, i.force.y) = (HubMode::Fixed, f64::INFINITY));
    assert_eq!(fixed, Err(SolveError::NotFinite { what, value: up }));
    let what = Quantity::Motor { device: 0, joint: "wheel" };
    let locked = rejected(|i| {
        (i.modes[0].wheel, i.motors[0].u_w) = (Mode::Locked, f64::INFINITY);
    });
    assert_eq!(locked, Err(SolveError::NotFinite { what, value: up }));
    let what = Quantity::Wrench { device: 0, body: "wheel" };
    let held = rejected(|i| {
        let mut bodies = Inputs::<[Dgvscmg; 1]>::no_wrenches();
        bodies[0].wheel.force.y = f64::INFINITY;
        (i.hub, i.bodies) = (HubMode::Fixed, Some(bodies));
    });
    assert_eq!(held, Err(SolveError::NotFinite { what, value: up }));
    let centre = rejected(|i| i.gravity = Gravity::Central { mu: 1.0 });
    assert_eq!(centre, Err(SolveError::AtCentre));
}

#[test]
fn loads_that_overflow_are_rejected() {
    let mut stiff = wheel();
    stiff.passive.wheel = Passive::spring(1e300, 0.0);
    let spacecraft = Spacecraft::new(&hub(), &[stiff]).unwrap();
    let mut state = State::<[Dgvscmg; 1]>::at_rest();
    state.devices[0].theta = 1e10;
    let inputs = Inputs::none();
    let still = Accelerations {
        r_b_n_ddot: Vector3::zeros(),
        omega_dot: Vector3::zeros(),
        devices: [Dgvscmg::no_accelerations()],
        modal: (),
    };
    let loads = spacecraft.loads(&state, &inputs, &still, LoadAxes::Body);
    let what = Quantity::Load { device: 0, joint: "wheel" };
    assert_eq!(loads, Err(SolveError::Overflow { what }));
    assert_eq!(spacecraft.ledger(&state, &inputs, &still), Err(SolveError::Overflow { what }));
}

#[test]
fn powers_of_joints_add_up_to_those_of_the_ledger() {
    let mut sprung = wheel();
    sprung.passive.wheel = Passive { stiffness: 0.5, ..Passive::friction(0.1, 0.2, 0.3) };
    let spacecraft = Spacecraft::new(&hub(), &[sprung]).unwrap();
    let mut state = State::<[Dgvscmg; 1]>::at_rest();
    (state.devices[0].theta, state.devices[0].spin) = (0.7, 3.0);
    let mut inputs = Inputs::<[Dgvscmg; 1]>::none();
    inputs.motors[0].u_w = 0.4;
    let found = spacecraft.accelerations(&state, &inputs).unwrap();
    let [device] = spacecraft.loads(&state, &inputs, &found, LoadAxes::Body).unwrap().devices;
    let power = spacecraft.ledger(&state, &inputs, &found).unwrap().power;
    let JointPower { motor, spring, friction } = device.powers.wheel;
    assert!((motor - 1.2).abs() <= ROUNDING && (spring + 1.05).abs() <= ROUNDING);
    assert!(friction < -0.9 && friction > -1.5);
    assert_eq!([motor, spring, friction], [power.motors, power.springs, power.friction]);
}

#[test]
fn energy_lost_in_a_stop_does_not_drown_in_the_orbit() {
    let disc = Matrix3::from_diagonal(&Vector3::new(0.02, 0.01, 0.01));
    let light = Dgvscmg::bare_wheel(3.0, disc);
    let spacecraft = Spacecraft::new(&hub(), &[light]).unwrap();
    let mut brake = Inputs::<[Dgvscmg; 1]>::none();
    brake.modes[0] = dgvscmg::PerJoint::all(Mode::Locked);
    let lost = |speed: f64| {
        let mut state = State::<[Dgvscmg; 1]>::at_rest();
        state.r_b_n_dot.y = speed;
        state.devices[0].spin = 0.01;
        spacecraft.stop(&state, &brake).unwrap().energy_lost
    };
    // Half of 0.02 kg m² times the square of 0.01 rad/s is 1e-6 J, of 1e9 J in orbit.
    assert!((lost(7600.0) - lost(0.0)).abs() <= 1e-18 && lost(0.0) > 9e-7);
}

#[test]
fn energy_and_momentum_are_those_of_the_two_calls() {
    let device = Dgvscmg { d: 0.01, ..wheel() };
    let spacecraft = Spacecraft::new(&hub(), &[device, device]).unwrap();
    let mut state = State::<[Dgvscmg; 2]>::at_rest();
    state.r_b_n = Vector3::new(1.0, -2.0, 3.0);
    state.omega = Vector3::new(0.1, 0.2, -0.3);
    (state.devices[0].gamma_i, state.devices[1].spin) = (0.4, 300.0);
    let point = About::Point(Vector3::new(0.3, 0.2, 0.1));
    for about in [About::InertialOrigin, About::CentreOfMass, point] {
        let energy = spacecraft.energy(&state).unwrap();
        let momentum = spacecraft.momentum(&state, about).unwrap();
        let both = EnergyAndMomentum { energy, momentum };
        assert_eq!(spacecraft.energy_and_momentum(&state, about), Ok(both));
    }
    state.omega.x = f64::NAN;
    assert!(spacecraft.energy_and_momentum(&state, point).is_err());
}

#[test]
fn works_of_a_run_are_its_change_of_energy() {
    let mut sprung = wheel();
    sprung.passive.inner_gimbal = Passive::spring(3.0, 0.05);
    let spacecraft = Spacecraft::new(&hub(), &[Dgvscmg { d: 0.01, ..sprung }]).unwrap();
    let mut state = State::<[Dgvscmg; 1]>::at_rest();
    (state.devices[0].gamma_i, state.devices[0].spin) = (0.4, 3.0);
    let mut inputs = Inputs::<[Dgvscmg; 1]>::none();
    inputs.motors[0].u_w = 0.4;
    inputs.gravity = Gravity::Uniform(Vector3::new(0.1, -0.3, 0.2));
    inputs.force.x = 0.5;
    // The energy that is left over once every source's work is taken off it.
    let left = |steps: u32| {
        let (mut state, mut works) = (state, 0.0);
        let before = spacecraft.energy(&state).unwrap();
        for _ in 0..steps {
            let dt = 2.0 / f64::from(steps);
            let stepped = spacecraft.step_with_work(&state, &inputs, dt).unwrap();
            assert_eq!(spacecraft.step(&state, &inputs, dt), Ok(stepped.state));
            (state, works) = (stepped.state, works + stepped.work.total());
        }
        assert!(works.abs() > 1.0);
        (spacecraft.energy(&state).unwrap() - before - works).abs()
    };
    // Order four: a sixteenth with every halving.
    let ratio = left(160) / left(320);
    assert!((14.0..18.0).contains(&ratio), "{ratio}");
}
