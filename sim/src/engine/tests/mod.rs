//! Checks of the engine: what a run does, against closed forms and loops over the solver.

mod changes;
mod conservation;
mod friction;
mod motor_excursions;
mod motors;
mod points;
mod stops;
mod table1;
mod wrenches;

use std::ops::ControlFlow;

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::{
    BalancedReactionWheel, BuiltIn, Gravity, HingedPanel, Hub, HubMode, JointStates, Quaternion,
    State,
};

use super::run;
use crate::record::{Outcome, Samples};
use crate::scenario::{
    Drive, IntegratorChoice, Output, Profile, Scenario, Set, Settings, Source, members,
};

pub(crate) const DOP853: IntegratorChoice = IntegratorChoice::Dop853 { tolerance: 1e-13 };

/// Runs a scenario to its end.
pub(crate) fn recorded(scenario: &Scenario) -> (Outcome, Samples) {
    let mut samples = Samples::default();
    let outcome = run(scenario, &mut samples, &mut |_| ControlFlow::Continue(()));
    (outcome.unwrap_or_else(|error| panic!("{error}")), samples)
}

/// The history of a column.
pub(crate) fn column(samples: &Samples, name: &str) -> Vec<f64> {
    samples.column(name).unwrap_or_else(|| panic!("no column {name}"))
}

/// The last value of a column.
pub(crate) fn last(samples: &Samples, name: &str) -> f64 {
    *column(samples, name).last().expect("a sample")
}

/// A scenario with every joint driven by no torque, everything at rest.
pub(crate) fn scenario(names: &[&str], devices: Vec<BuiltIn>, duration: f64) -> Scenario {
    scenario_of(names, (devices, Vec::new(), Vec::new()), duration)
}

/// The same of a set with platforms.
pub(crate) fn scenario_of(names: &[&str], devices: Set, duration: f64) -> Scenario {
    let joints = members(&devices).iter().map(|member| member.joints().len()).sum();
    let free = Drive::Torque { profile: Profile::ZERO, limit: None };
    let hub = Hub {
        m_b: 100.0,
        r_bc_b: Vector3::zeros(),
        i_b_bc: Matrix3::from_diagonal(&Vector3::new(30.0, 40.0, 50.0)),
    };
    let mut scenario = Scenario {
        name: "check".to_owned(),
        title: "Check".to_owned(),
        description: String::new(),
        hub,
        hub_size: Vector3::repeat(1.0),
        names: names.iter().map(|name| (*name).to_owned()).collect(),
        mounts: Vec::new(),
        structure: None,
        initial: State {
            r_b_n: Vector3::zeros(),
            r_b_n_dot: Vector3::zeros(),
            attitude: Quaternion { q0: 1.0, q1: 0.0, q2: 0.0, q3: 0.0 },
            omega: Vector3::zeros(),
            devices: Default::default(),
            modal: (),
        },
        mean: None,
        reference: Quaternion { q0: 1.0, q1: 0.0, q2: 0.0, q3: 0.0 },
        devices,
        hub_mode: HubMode::Free,
        gravity: Gravity::None,
        drives: vec![free; joints],
        stops: Vec::new(),
        friction: Vec::new(),
        wrenches: Vec::new(),
        points: Vec::new(),
        disturbances: Vec::new(),
        controllers: Vec::new(),
        changes: Vec::new(),
        crossings: Vec::new(),
        settings: Settings { duration, integrator: DOP853 },
        output: Output { rate: 20.0 / duration, columns: Vec::new(), formats: Vec::new() },
        requirements: Vec::new(),
        margin_requirements: Vec::new(),
        source: Source::default(),
    };
    let spacecraft = scenario.spacecraft().expect("it is accepted");
    scenario.initial = State::at_rest_for(&spacecraft);
    scenario
}

/// Coordinate and rate of a joint at the start.
pub(crate) fn set_joint(scenario: &mut Scenario, joint: usize, state: [f64; 2]) {
    let [coordinate, rate] = scenario.initial.devices.states_mut().nth(joint).expect("a joint");
    [*coordinate, *rate] = state;
}

/// A panel whose centre of mass is on its hinge: on a clamped hub it turns at a constant rate.
pub(crate) fn panel() -> HingedPanel {
    HingedPanel::bare_panel(4.0, Matrix3::from_diagonal(&Vector3::new(0.5, 0.5, 0.8)))
}

/// A rotor of 0.2 kg m² about its axis.
pub(crate) fn wheel() -> BalancedReactionWheel {
    BalancedReactionWheel::bare_wheel(4.0, 0.2, 0.1)
}

/// A run of the panel on a clamped hub at a rate.
pub(crate) fn turning_panel(rate: f64, duration: f64) -> Scenario {
    let mut scenario = scenario(&["panel"], vec![panel().into()], duration);
    scenario.hub_mode = HubMode::Fixed;
    set_joint(&mut scenario, 0, [0.0, rate]);
    scenario
}
