//! Energy and momentum of every kind of device, with springs, friction and gravity; and momenta of
//! the bodies against those of the solver.

use nalgebra::{Matrix3, Rotation3, Vector3};
use precess_dynamics::kind::{BodyParameters, ParameterValue, Shape};
use precess_dynamics::{
    About, BuiltIn, BuiltInKind, DeviceParameters, Gravity, ImbalanceModel, JointStates,
    MAX_JOINTS, Passive, Quaternion,
};

use super::{DOP853, column, last, recorded, scenario};
use crate::engine::equations::kinematics::{Chain, momenta};
use crate::engine::{Run, rigid_state};
use crate::scenario::{IntegratorChoice, Scenario};

/// Sums over some bodies in another order; a few hundred roundings of 2e-16.
const ROUNDING: f64 = 1e-13;

/// A device of a kind with every parameter set, and a joint of each property.
fn device(kind: BuiltInKind, passive: Passive) -> BuiltIn {
    let none =
        BodyParameters { origin: [0.0; 3], mass: 0.0, centre: [0.0; 3], inertia: Matrix3::zeros() };
    let bodies = [none; MAX_JOINTS];
    let parameters = DeviceParameters {
        mount: Matrix3::identity(),
        bodies,
        passive: [passive; MAX_JOINTS],
        model: ImbalanceModel::Coupled,
    };
    let mut device = BuiltIn::new(kind, &parameters).expect("nothing that it lacks");
    for (number, info) in (0_u8..).zip(kind.parameters()) {
        let x = 0.1 + 0.01 * f64::from(number);
        let value = match info.shape {
            Shape::Scalar if info.name == "d" => ParameterValue::Scalar(0.01),
            Shape::Scalar => ParameterValue::Scalar(0.5 + x),
            Shape::Vector => ParameterValue::Vector(Vector3::new(x, -0.7 * x, 0.4 * x)),
            Shape::Rotation => {
                ParameterValue::Matrix(Rotation3::from_euler_angles(0.3, -0.8, 1.1).into_inner())
            }
            Shape::Symmetric => ParameterValue::Matrix(Matrix3::new(
                0.9, 0.02, -0.03, 0.02, 0.8, 0.01, -0.03, 0.01, 0.7,
            )),
            Shape::Model => continue,
        };
        device.set_parameter(info.name, value).expect("its own");
    }
    device
}

/// One device of each kind, everything moving.
fn every_kind(passive: Passive) -> Scenario {
    let devices: Vec<BuiltIn> =
        BuiltInKind::ALL.iter().map(|kind| device(*kind, passive)).collect();
    let names: Vec<&str> = BuiltInKind::ALL.iter().map(|kind| kind.name()).collect();
    let mut scenario = scenario(&names, devices, 0.5);
    scenario.initial.r_b_n = Vector3::new(0.3, -0.2, 0.1);
    scenario.initial.r_b_n_dot = Vector3::new(-0.1, 0.4, 0.2);
    scenario.initial.attitude = Quaternion { q0: 0.5, q1: -0.5, q2: 0.5, q3: 0.5 };
    scenario.initial.omega = Vector3::new(0.3, -0.1, 0.2);
    for (number, [coordinate, rate]) in (0_u8..).zip(scenario.initial.devices.states_mut()) {
        let x = f64::from(number);
        (*coordinate, *rate) = (0.2 + 0.03 * x, 0.4 - 0.06 * x);
    }
    scenario
}

#[test]
fn momenta_of_the_bodies_add_up_to_the_solvers() {
    let scenario = every_kind(Passive::none());
    let chains = Chain::all(&scenario.devices);
    let (mut linear, mut angular, mut bodies) = (Vector3::zeros(), Vector3::zeros(), 0);
    momenta(&scenario.hub, &chains, &rigid_state(scenario.initial.clone()), |body| {
        linear += body.linear;
        angular += body.angular;
        bodies += 1;
    });
    assert_eq!(bodies, 1 + scenario.joint_count());
    let spacecraft = scenario.spacecraft().expect("it is accepted");
    let solver = spacecraft.momentum(&scenario.initial, About::InertialOrigin).expect("finite");
    assert!((linear - solver.linear).norm() <= ROUNDING * solver.linear.norm());
    assert!((angular - solver.angular).norm() <= ROUNDING * solver.angular.norm());
}

#[test]
fn every_kind_keeps_energy_and_momentum() {
    let springs = Passive { rest: 0.1, ..Passive::spring(2.0, 0.3) };
    for passive in [Passive::none(), springs] {
        let mut scenario = every_kind(passive);
        for (integrator, bound) in [(DOP853, 1e-12), (IntegratorChoice::Rk4 { step: 2e-3 }, 1e-8)] {
            scenario.settings.integrator = integrator;
            let (outcome, _) = recorded(&scenario);
            let drift = outcome.drift;
            for part in [drift.energy, drift.linear, drift.angular] {
                assert!(part.is_some_and(|part| part < bound), "{integrator:?} {drift:?}");
            }
        }
    }
}

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn an_orbit_keeps_its_energy_with_that_of_gravity() {
    let mut scenario = every_kind(Passive::none());
    scenario.gravity = Gravity::Central { mu: 3.986e14 };
    scenario.initial.r_b_n = Vector3::new(7e6, 0.0, 0.0);
    scenario.initial.r_b_n_dot = Vector3::new(0.0, 7.5e3, 0.0);
    scenario.settings.duration = 20.0;
    let (outcome, samples) = recorded(&scenario);
    let drift = outcome.drift;
    assert!(drift.energy.is_some_and(|part| part < 1e-12) && drift.linear.is_none(), "{drift:?}");
    // Bound: below zero.
    assert!(column(&samples, "energy").iter().all(|energy| *energy < 0.0));
}

#[test]
fn loads_are_recorded_only_where_they_are_selected() {
    let mut scenario = every_kind(Passive::none());
    scenario.settings.duration = 0.01;
    scenario.output.rate = 1000.0;
    let (_, without) = recorded(&scenario);
    let header = without.header.as_ref().expect("a header");
    assert!(header.index("dgcmg.mount.force_x").is_none());
    scenario.output.columns = vec!["loads".to_owned(), "omega".to_owned()];
    let (_, with) = recorded(&scenario);
    let header = with.header.as_ref().expect("a header");
    assert_eq!(header.columns[0].name, "time");
    assert_eq!(header.quantity("omega").expect("three").len(), 3);
    assert!(header.index("energy").is_none());
    let count = 6 * (scenario.names.len() + scenario.joint_count());
    assert_eq!(header.columns.len(), 1 + 3 + count);
    assert!(with.rows.iter().flatten().all(|number| number.is_finite()));
    assert!(last(&with, "dgvscmg.inner_gimbal.load_moment_y") != 0.0);
}

#[test]
fn a_state_that_is_no_number_is_an_error_before_the_start() {
    let mut scenario = every_kind(Passive::none());
    scenario.initial.omega.x = f64::NAN;
    let Err(error) = Run::new(&scenario) else { panic!("accepted") };
    assert!(error.to_string().starts_with("at t = 0 s: NaN in angular velocity"), "{error}");
}
