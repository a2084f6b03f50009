//! [`Model`]: the spacecraft of some values of the unknowns, its state at the start, and what both change by with each.
//!
//! An imbalance at the angle alpha of the wheel's axes is a wheel whose `d` is along its own y axis, as its kind has it, and whose
//! angle at the start is larger by alpha; its derivatives are those of centre and inertia of the body in its own axes.

use nalgebra::{DMatrix, Matrix3, Rotation3, Vector3};
use precess_control::rotation;
use precess_craft::Set;
use precess_dynamics::kind::BodyParameters;
use precess_dynamics::{
    Axis, BuiltIn, DeviceParameters, Each as _, Hub, HubMode, Inputs, JointStates as _, Mode,
    ParameterDirection, Passive, Spacecraft, State, Variable,
};

use super::component::{Component, Target, tip_of, wheel_joint};
use super::error::IdentifyError;
use crate::scenario::{Drive, Profile, Scenario};

/// The spacecraft of some values.
pub(super) struct Model {
    pub(super) hub: Hub,
    pub(super) devices: Set,
    pub(super) craft: Spacecraft<Set>,
    pub(super) inputs: Inputs<Set>,
    pub(super) state: State<Set>,
    /// Rows of the changes.
    pub(super) states: Vec<Variable>,
    /// Of the components that change state or parameters: their numbers.
    pub(super) moved: Vec<usize>,
    pub(super) directions: Vec<ParameterDirection>,
    /// What the state at the start changes by with each of them.
    pub(super) changes: DMatrix<f64>,
    pub(super) bias: Vector3<f64>,
}

/// What a scenario has that the estimation has not.
pub(super) fn check(scenario: &Scenario) -> Result<(), IdentifyError> {
    let varies = |drive: &Drive| matches!(drive, Drive::Acceleration(profile) if !matches!(profile, Profile::Constant(_)));
    let has = [
        (scenario.structure.is_some(), "a flexible structure"),
        (scenario.devices_on_hub().is_none(), "platforms, or panels that carry devices"),
        (!scenario.disturbances.is_empty(), "sources"),
        (!scenario.wrenches.is_empty(), "wrenches"),
        (!scenario.changes.is_empty(), "changes at times"),
        (!scenario.stops.is_empty(), "end stops"),
        (!scenario.friction.is_empty(), "friction that sticks or quadratic drag"),
        (scenario.drives.iter().any(varies), "accelerations that vary over time"),
        (scenario.hub_mode != HubMode::Free, "a hub that is not free"),
        (matches!(scenario.gravity, precess_dynamics::Gravity::Central { .. }), "a central field"),
    ];
    match has.into_iter().find(|(has, _)| *has) {
        Some((_, what)) => Err(IdentifyError::Unsupported { what }),
        None => Ok(()),
    }
}

/// Nothing of a device.
fn no_change(of: &BuiltIn) -> DeviceParameters<f64> {
    let none =
        BodyParameters { origin: [0.0; 3], mass: 0.0, centre: [0.0; 3], inertia: Matrix3::zeros() };
    let passive =
        Passive { stiffness: 0.0, rest: 0.0, viscous: 0.0, coulomb: 0.0, coulomb_rate: 0.0 };
    let mut change = of.parameters();
    change.mount = Matrix3::zeros();
    change.bodies = change.bodies.map(|_| none);
    change.passive = change.passive.map(|_| passive);
    change
}

/// A rotation by a small vector on the left, and the rotation that one of its components then is.
fn left(of: &Vector3<f64>, index: usize) -> Vector3<f64> {
    let unit = Vector3::from_fn(|k, _| f64::from(u8::from(k == index)));
    unit + of.cross(&unit) * 0.5 + of.cross(&of.cross(&unit)) / 6.0
}

/// The values of the unknowns put into the numbers of a scenario.
struct Values {
    hub: Hub,
    devices: Vec<DeviceParameters<f64>>,
    /// By which the angle of the wheel of each device is larger.
    angles: Vec<f64>,
    tilts: Vec<Vector3<f64>>,
    attitude: Vector3<f64>,
    bias: Vector3<f64>,
    state: State<Set>,
}

impl Model {
    pub(super) fn new(
        scenario: &Scenario,
        components: &[Component],
        values: &[f64],
    ) -> Result<Self, IdentifyError> {
        let kinds = scenario.devices_on_hub().unwrap_or_default();
        let of = Values::new(scenario, components, values);
        let devices = kinds.iter().zip(&of.devices);
        let devices = devices.map(|(device, parameters)| BuiltIn::new(device.kind(), parameters));
        let devices: Set = (devices.collect::<Result<_, _>>()?, Vec::new(), Vec::new());
        let craft = precess_craft::spacecraft(&of.hub, &devices)?;
        let inputs = inputs(scenario, &craft);
        let states: Vec<Variable> = craft.state_variables(&inputs).collect();
        let mut moved = Vec::new();
        let (mut directions, mut columns) = (Vec::new(), Vec::new());
        for (index, component) in components.iter().enumerate() {
            let Some((direction, change)) = of.direction(scenario, component.target) else {
                continue;
            };
            moved.push(index);
            directions.push(direction);
            let mut column = vec![0.0; states.len()];
            for (variable, number) in change {
                if let Some(place) = states.iter().position(|state| *state == variable) {
                    column[place] = number;
                }
            }
            columns.extend(column);
        }
        let changes = DMatrix::from_vec(states.len(), moved.len(), columns);
        let Values { hub, state, bias, .. } = of;
        Ok(Self { hub, devices, craft, inputs, state, states, moved, directions, changes, bias })
    }
}

/// Motors off, joints in the modes of the scenario, its gravity.
fn inputs(scenario: &Scenario, craft: &Spacecraft<Set>) -> Inputs<Set> {
    let mut inputs = Inputs::none_for(craft);
    let driven: Vec<bool> = craft.joints().map(|(_, info)| info.driven).collect();
    let modes = inputs.modes.values_mut().zip(&scenario.drives).zip(&driven);
    for ((mode, drive), _) in modes.filter(|(_, driven)| **driven) {
        *mode = match drive {
            Drive::Torque { .. } => Mode::Driven,
            Drive::Acceleration(profile) => Mode::Prescribed(profile.at(0.0, false)),
            Drive::Locked => Mode::Locked,
        };
    }
    inputs.gravity = scenario.gravity;
    inputs
}

impl Values {
    fn new(scenario: &Scenario, components: &[Component], values: &[f64]) -> Self {
        let kinds = scenario.devices_on_hub().unwrap_or_default();
        let mut devices: Vec<_> = kinds.iter().map(BuiltIn::parameters).collect();
        let count = devices.len();
        let mut hub = scenario.hub;
        let mut state = scenario.initial.clone();
        let mut joints: Vec<[f64; 2]> = state.devices.states().collect();
        // In the axes of the scenario's angle: static and dynamic; none where it is as the scenario has it.
        let mut imbalances: Vec<Option<[[f64; 2]; 2]>> = vec![None; count];
        let (mut tilts, mut angles) = (vec![Vector3::zeros(); count], vec![0.0; count]);
        let (mut attitude, mut bias) = (Vector3::zeros(), Vector3::zeros());
        for (component, value) in components.iter().zip(values) {
            match component.target {
                Target::Inertia(row, column) => {
                    hub.i_b_bc[(row, column)] = *value;
                    hub.i_b_bc[(column, row)] = *value;
                }
                Target::Centre(k) => hub.r_bc_b[k] = *value,
                Target::Static(device, k) => {
                    imbalances[device].get_or_insert_default()[0][k] = *value;
                }
                Target::Dynamic(device, k) => {
                    imbalances[device].get_or_insert_default()[1][k] = *value;
                }
                Target::Viscous(joint) | Target::Coulomb(joint) => {
                    let Some((device, place)) = place_of(scenario, joint) else { continue };
                    let passive = &mut devices[device].passive[place];
                    // Friction that drives is none; a step that leads there stays at the bound.
                    let value = value.max(0.0);
                    match component.target {
                        Target::Viscous(_) => passive.viscous = value,
                        _ => passive.coulomb = value,
                    }
                }
                Target::Mount(device, k) => tilts[device][k] = *value,
                Target::Bias(k) => bias[k] = *value,
                Target::Attitude(k) => attitude[k] = *value,
                Target::Omega(k) => state.omega[k] = *value,
                Target::Coordinate(joint) => joints[joint][0] = *value,
                Target::Rate(joint) => joints[joint][1] = *value,
            }
        }
        for (device, tilt) in tilts.iter().enumerate() {
            let parameters = &mut devices[device];
            parameters.mount = Rotation3::new(*tilt).matrix() * parameters.mount;
            let (Some([s, j]), Some(tip)) =
                (imbalances[device], kinds.get(device).and_then(tip_of))
            else {
                continue;
            };
            let angle = if s == [0.0; 2] { 0.0 } else { s[1].atan2(s[0]) };
            angles[device] = angle;
            let body = &mut parameters.bodies[tip];
            (body.inertia[(0, 1)], body.inertia[(1, 0)]) = (j[0], j[0]);
            (body.inertia[(0, 2)], body.inertia[(2, 0)]) = (j[1], j[1]);
            let turn = Rotation3::from_axis_angle(&Vector3::x_axis(), -angle);
            let turned = turn.matrix() * body.inertia * turn.matrix().transpose();
            body.inertia = (turned + turned.transpose()) * 0.5;
            let d = s[0].hypot(s[1]) / body.mass;
            body.centre = [body.centre[0], d, 0.0];
            if let Some(joint) = wheel_joint(scenario, device) {
                joints[joint][0] += angle;
            }
        }
        state.attitude = rotation::product(&state.attitude, &rotation::from_vector(&attitude));
        for (to, from) in state.devices.states_mut().zip(&joints) {
            (*to[0], *to[1]) = (from[0], from[1]);
        }
        Self { hub, devices, angles, tilts, attitude, bias, state }
    }

    /// What parameters and the state at the start change by with a component; none of a bias.
    fn direction(
        &self,
        scenario: &Scenario,
        target: Target,
    ) -> Option<(ParameterDirection, Vec<(Variable, f64)>)> {
        let kinds = scenario.devices_on_hub().unwrap_or_default();
        let mut direction = ParameterDirection::none();
        let mut change = Vec::new();
        let none = || kinds.iter().map(no_change).collect::<Vec<_>>();
        let tip = |device: usize| kinds.get(device).and_then(tip_of);
        // The axis of the scenario's angle in those of the wheel.
        let turned = |device: usize, k: usize| {
            let (sine, cosine) = self.angles[device].sin_cos();
            if k == 0 { [cosine, -sine] } else { [sine, cosine] }
        };
        match target {
            Target::Bias(_) => return None,
            Target::Inertia(row, column) => {
                direction.hub.i_b_bc[(row, column)] = 1.0;
                direction.hub.i_b_bc[(column, row)] = 1.0;
            }
            Target::Centre(k) => direction.hub.r_bc_b[k] = 1.0,
            Target::Static(device, k) => {
                direction.devices = none();
                let tip = tip(device)?;
                let mass = self.devices[device].bodies[tip].mass;
                let [y, z] = turned(device, k);
                direction.devices[device].bodies[tip].centre = [0.0, y / mass, z / mass];
            }
            Target::Dynamic(device, k) => {
                direction.devices = none();
                let tip = tip(device)?;
                let [y, z] = turned(device, k);
                let inertia = &mut direction.devices[device].bodies[tip].inertia;
                (inertia[(0, 1)], inertia[(1, 0)]) = (y, y);
                (inertia[(0, 2)], inertia[(2, 0)]) = (z, z);
            }
            Target::Viscous(joint) | Target::Coulomb(joint) => {
                direction.devices = none();
                let (device, place) = place_of(scenario, joint)?;
                let passive = &mut direction.devices[device].passive[place];
                match target {
                    Target::Viscous(_) => passive.viscous = 1.0,
                    _ => passive.coulomb = 1.0,
                }
            }
            Target::Mount(device, k) => {
                direction.devices = none();
                let turn = left(&self.tilts[device], k);
                let mount = &self.devices[device].mount;
                direction.devices[device].mount = turn.cross_matrix() * mount;
            }
            Target::Attitude(k) => {
                let turn = left(&-self.attitude, k);
                change.extend(
                    Axis::ALL.into_iter().map(Variable::Attitude).zip(turn.iter().copied()),
                );
            }
            Target::Omega(k) => change.push((Variable::Omega(Axis::ALL[k]), 1.0)),
            Target::Coordinate(joint) => change.push((Variable::Coordinate(joint), 1.0)),
            Target::Rate(joint) => change.push((Variable::Rate(joint), 1.0)),
        }
        Some((direction, change))
    }
}

/// Device and place in it of a joint.
fn place_of(scenario: &Scenario, joint: usize) -> Option<(usize, usize)> {
    let (device, _, info) = scenario.joints().nth(joint)?;
    Some((device, info.index))
}
