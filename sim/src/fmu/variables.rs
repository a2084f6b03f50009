//! [`Variable`]: the variables of a unit: time, states, their derivatives, inputs, parameters.

use precess_dynamics::kind::JointInfo;
use precess_dynamics::{Gravity, HubMode, JointStates as _};

use super::dependencies::Couplings;
use super::layout::{HUB_STATES, Layout};
use super::names::Names;
use super::parameters::parameters;
use crate::scenario::{Drive, Scenario, Target, WrenchAxes};

/// What a variable is to the importer.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Role {
    /// Time.
    Independent,
    /// A state, which is an output.
    State,
    /// An output of a run.
    Output,
    /// The derivative of the state of a number, and the places of the states and inputs on which it depends.
    Derivative {
        /// The state, from 0.
        state: usize,
        /// Places, in order.
        depends: Vec<usize>,
        /// Whether it depends on parameters, too.
        on_parameters: bool,
    },
    /// An input; its largest magnitude where it has one.
    Input(Option<f64>),
    /// A parameter that is set before the end of initialisation.
    Fixed,
    /// A parameter that may change between steps and at events.
    Tunable,
}

/// A variable.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Variable {
    pub(super) name: String,
    /// Its place, which is its value reference.
    pub(super) place: usize,
    pub(super) role: Role,
    pub(super) unit: &'static str,
    /// The unit in which it is shown, where it is not that.
    pub(super) shown: Option<&'static str>,
    /// Its value in the scenario; of a derivative it is computed.
    pub(super) start: f64,
    pub(super) meaning: String,
}

/// Axes by name.
pub(super) const AXES: [&str; 3] = ["x", "y", "z"];

/// All variables of a scenario, in the order of their places.
pub(super) fn variables(
    scenario: &Scenario,
    layout: &Layout,
    step: f64,
    names: &mut Names,
) -> Vec<Variable> {
    let mut all = vec![Variable {
        name: names.of_hub("time"),
        place: 0,
        role: Role::Independent,
        unit: "s",
        shown: None,
        start: 0.0,
        meaning: "time".to_owned(),
    }];
    let states = states(scenario, names);
    let couplings = Couplings::new(scenario, layout);
    let derivatives = states.iter().enumerate().map(|(index, state)| {
        let (depends, on_parameters) = couplings.of_derivative(index);
        Variable {
            name: names.of_derivative(&state.name),
            place: layout.derivative(index),
            role: Role::Derivative { state: index, depends, on_parameters },
            unit: derivative_unit(state.unit),
            shown: None,
            start: 0.0,
            meaning: format!("derivative of {}", state.name),
        }
    });
    let derivatives: Vec<_> = derivatives.collect();
    all.extend(states);
    all.extend(derivatives);
    all.extend(hub_inputs(scenario, layout, names));
    all.extend(motors(scenario, layout, names));
    all.extend(wrenches(scenario, layout, names));
    all.extend(parameters(scenario, layout, step, names));
    all
}

fn states(scenario: &Scenario, names: &mut Names) -> Vec<Variable> {
    let mut all = Vec::new();
    let mut push = |name: String, unit, shown, start, meaning| {
        let place = Layout::state(all.len());
        all.push(Variable { name, place, role: Role::State, unit, shown, start, meaning });
    };
    let initial = &scenario.initial;
    for (axis, letter) in AXES.iter().enumerate() {
        let meaning = format!("position of B, expressed in N, {letter}");
        push(names.of_hub(&format!("position_{letter}")), "m", None, initial.r_b_n[axis], meaning);
    }
    for (axis, letter) in AXES.iter().enumerate() {
        let meaning = format!("inertial velocity of B, expressed in N, {letter}");
        let name = names.of_hub(&format!("velocity_{letter}"));
        push(name, "m/s", None, initial.r_b_n_dot[axis], meaning);
    }
    let q = initial.attitude;
    for (index, value) in [q.q0, q.q1, q.q2, q.q3].into_iter().enumerate() {
        let meaning = format!("attitude of B with respect to N: Euler parameter {index}");
        push(names.of_hub(&format!("q{index}")), "1", None, value, meaning);
    }
    for (axis, letter) in AXES.iter().enumerate() {
        let meaning = format!("angular velocity of the hub, expressed in B, {letter}");
        let name = names.of_hub(&format!("omega_{letter}"));
        push(name, "rad/s", Some("deg/s"), initial.omega[axis], meaning);
    }
    let values: Vec<[f64; 2]> = initial.devices.states().collect();
    for ((_, device, info), [coordinate, _]) in scenario.joints().zip(&values) {
        let meaning = format!("{device}: coordinate of the {}", info.body);
        let (unit, shown) = if info.slides { ("m", None) } else { ("rad", Some("deg")) };
        push(names.of_device(device, info.coordinate), unit, shown, *coordinate, meaning);
    }
    for ((_, device, info), [_, rate]) in scenario.joints().zip(&values) {
        let meaning = format!("{device}: rate of the {} relative to its parent body", info.body);
        let unit = if info.slides { "m/s" } else { "rad/s" };
        push(names.of_device(device, info.rate), unit, shown_rate(info), *rate, meaning);
    }
    all
}

/// The unit in which a rate is shown: turns per minute of a wheel.
fn shown_rate(info: &JointInfo) -> Option<&'static str> {
    match (info.slides, info.body) {
        (true, _) => None,
        (false, "wheel") => Some("rpm"),
        (false, _) => Some("deg/s"),
    }
}

/// The unit of the derivative of a state in a unit.
fn derivative_unit(unit: &str) -> &'static str {
    match unit {
        "m" => "m/s",
        "m/s" => "m/s2",
        "rad" => "rad/s",
        "rad/s" => "rad/s2",
        _ => "1/s",
    }
}

/// What acts on the hub; nothing of one that is fixed.
pub(super) fn hub_inputs(scenario: &Scenario, layout: &Layout, names: &mut Names) -> Vec<Variable> {
    type Vectors = [(&'static str, &'static str, &'static str, [f64; 3]); 2];
    let vectors: Vectors = match scenario.hub_mode {
        HubMode::Free => [
            ("force", "N", "force on the hub through B", [0.0; 3]),
            ("torque", "N.m", "torque on the hub about B", [0.0; 3]),
        ],
        HubMode::Fixed => return Vec::new(),
        HubMode::Prescribed { r_b_n_ddot, omega_dot } => [
            ("acceleration", "m/s2", "prescribed inertial acceleration of B", r_b_n_ddot.into()),
            ("omega_dot", "rad/s2", "prescribed angular acceleration of the hub", omega_dot.into()),
        ],
    };
    let mut all = Vec::new();
    for (name, unit, meaning, values) in vectors {
        for (letter, start) in AXES.iter().zip(values) {
            all.push(Variable {
                name: names.of_hub(&format!("{name}_{letter}")),
                place: layout.input(all.len()),
                role: Role::Input(None),
                unit,
                shown: None,
                start,
                meaning: format!("{meaning}, expressed in B, {letter}"),
            });
        }
    }
    all
}

fn motors(scenario: &Scenario, layout: &Layout, names: &mut Names) -> Vec<Variable> {
    let joints = scenario.joints().zip(&scenario.drives).zip(&layout.motors);
    let given = joints.filter_map(|(((_, device, info), drive), input)| {
        let place = layout.input(super::layout::HUB_INPUTS + (*input)?);
        motor((device, info), drive, place, names)
    });
    given.collect()
}

/// What gives a joint of a device; none of a locked one.
pub(super) fn motor(
    (device, info): (&str, &JointInfo),
    drive: &Drive,
    place: usize,
    names: &mut Names,
) -> Option<Variable> {
    let start = drive.profile()?.at(0.0, false);
    let (name, unit, meaning) = match drive {
        Drive::Torque { .. } if info.slides => (info.motor, "N", "motor force on"),
        Drive::Torque { .. } => (info.motor, "N.m", "motor torque on"),
        _ if info.slides => (info.acceleration, "m/s2", "prescribed acceleration of"),
        _ => (info.acceleration, "rad/s2", "prescribed acceleration of"),
    };
    let limits = drive.limits();
    Some(Variable {
        name: names.of_device(device, name),
        place,
        role: Role::Input(limits.torque.map(f64::abs)),
        unit,
        shown: None,
        start: limits.clipped(start),
        meaning: format!("{device}: {meaning} the {}", info.body),
    })
}

fn wrenches(scenario: &Scenario, layout: &Layout, names: &mut Names) -> Vec<Variable> {
    let mut all = Vec::new();
    for (index, wrench) in scenario.wrenches.iter().enumerate() {
        let (number, first) = (index + 1, layout.wrench(index));
        let body = match wrench.body {
            Target::Joint(joint) => {
                let found = scenario.joints().nth(joint);
                found.map_or_else(String::new, |(_, name, info)| {
                    format!("the {} of {name}", info.body)
                })
            }
            Target::Hub | Target::Node(_) => "the hub".to_owned(),
        };
        let axes = if wrench.axes == WrenchAxes::Inertial { "in N" } else { "in the body's axes" };
        let vectors = [("force", "N", &wrench.force), ("moment", "N.m", &wrench.moment)];
        for (of, (what, unit, profiles)) in vectors.into_iter().enumerate() {
            for (axis, (letter, profile)) in AXES.iter().zip(profiles).enumerate() {
                all.push(Variable {
                    name: names.of_hub(&format!("wrench_{number}_{what}_{letter}")),
                    place: first + 3 * of + axis,
                    role: Role::Input(None),
                    unit,
                    shown: None,
                    start: profile.at(0.0, false),
                    meaning: format!(
                        "wrench {number}: {what} on {body}, expressed {axes}, {letter}"
                    ),
                });
            }
        }
    }
    all
}

/// Sizes of states that are typical: those of the start, at least one; of a vector that of its largest component.
pub(super) fn nominals(scenario: &Scenario) -> Vec<f64> {
    let initial = &scenario.initial;
    let mut all = Vec::new();
    for vector in [&initial.r_b_n, &initial.r_b_n_dot] {
        all.extend([vector.amax().max(1.0); 3]);
    }
    all.extend([1.0; 4]);
    all.extend([initial.omega.amax().max(1.0); 3]);
    debug_assert_eq!(all.len(), HUB_STATES, "as many as the hub has");
    let values: Vec<[f64; 2]> = initial.devices.states().collect();
    for which in 0..2 {
        all.extend(values.iter().map(|of| of[which].abs().max(1.0)));
    }
    all
}

/// The numbers of gravity: a uniform field expressed in N, and the parameter of a central body.
pub(super) fn gravity(scenario: &Scenario) -> [f64; 4] {
    match scenario.gravity {
        Gravity::None => [0.0; 4],
        Gravity::Uniform(field) => [field.x, field.y, field.z, 0.0],
        Gravity::Central { mu } => [0.0, 0.0, 0.0, mu],
    }
}
