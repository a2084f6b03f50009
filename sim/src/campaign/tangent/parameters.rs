//! The numbers that a run depends on, in one order: of hub, devices, drives, gravity and initial state; and their
//! derivatives by a key.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::kind::{BodyParameters, Each as _};
use precess_dynamics::{
    BuiltInKind, DeviceParameters, Devices, Gravity, Hub, HubMode, Inputs, JointStates, Mode,
    Quaternion, Scalar, Spacecraft, State,
};

use crate::scenario::{Drive, Profile, Scenario};

/// Everything that a run depends on.
pub(super) struct Parts<T> {
    pub(super) hub: Hub<T>,
    pub(super) devices: Vec<(BuiltInKind, DeviceParameters<T>)>,
    pub(super) motors: Vec<T>,
    pub(super) modes: Vec<Mode<T>>,
    pub(super) gravity: Gravity<T>,
    pub(super) position: Vector3<T>,
    pub(super) velocity: Vector3<T>,
    pub(super) attitude: Quaternion<T>,
    pub(super) omega: Vector3<T>,
    pub(super) joints: Vec<[T; 2]>,
}

/// What a scenario has that is not differentiated.
pub(super) fn supported(scenario: &Scenario) -> Result<(), String> {
    let constant = |drive: &Drive| match drive {
        Drive::Torque { profile, .. } | Drive::Acceleration(profile) => {
            matches!(profile, Profile::Constant(_))
        }
        Drive::Locked => true,
    };
    let has = [
        (scenario.structure.is_some(), "a flexible structure"),
        (scenario.devices_on_hub().is_none(), "platforms, or panels that carry devices"),
        (!scenario.disturbances.is_empty(), "sources"),
        (!scenario.wrenches.is_empty(), "wrenches"),
        (!scenario.changes.is_empty(), "changes at times"),
        (!scenario.stops.is_empty(), "end stops"),
        (!scenario.friction.is_empty(), "friction that sticks or quadratic drag"),
        (!scenario.crossings.is_empty(), "crossings"),
        (!scenario.controllers.is_empty(), "controllers"),
        (!scenario.drives.iter().all(constant), "drives that vary over time"),
        (
            scenario.drives.iter().any(|drive| drive.limits().depend_on_rate()),
            "motors with a largest power or rate",
        ),
        (matches!(scenario.hub_mode, HubMode::Prescribed { .. }), "a prescribed hub"),
    ];
    match has.into_iter().find(|(has, _)| *has) {
        Some((_, what)) => Err(format!("the scenario has {what}")),
        None => Ok(()),
    }
}

/// The parts of a scenario, each number through a function, always in the same order.
pub(super) fn parts<T: Scalar>(scenario: &Scenario, number: &mut dyn FnMut(f64) -> T) -> Parts<T> {
    let hub = &scenario.hub;
    let hub = Hub {
        m_b: number(hub.m_b),
        r_bc_b: vector(&hub.r_bc_b, number),
        i_b_bc: matrix(&hub.i_b_bc, number),
    };
    let mut devices = Vec::new();
    for device in &scenario.devices.0 {
        let of = device.parameters();
        let parameters = DeviceParameters {
            mount: matrix(&of.mount, number),
            bodies: of.bodies.map(|body| BodyParameters {
                origin: body.origin.map(&mut *number),
                mass: number(body.mass),
                centre: body.centre.map(&mut *number),
                inertia: matrix(&body.inertia, number),
            }),
            passive: of.passive.map(|passive| passive.map(&mut *number)),
            model: of.model,
        };
        devices.push((device.kind(), parameters));
    }
    let (mut motors, mut modes) = (Vec::new(), Vec::new());
    for drive in &scenario.drives {
        let (motor, mode) = match drive {
            Drive::Torque { profile, .. } => {
                // Beyond its limit a motor has its limit, whatever the key.
                let torque = drive.limits().clipped(profile.at(0.0, false));
                (number(torque), Mode::Driven)
            }
            Drive::Acceleration(profile) => {
                (number(0.0), Mode::Prescribed(number(profile.at(0.0, false))))
            }
            Drive::Locked => (number(0.0), Mode::Locked),
        };
        motors.push(motor);
        modes.push(mode);
    }
    let gravity = match scenario.gravity {
        Gravity::None => Gravity::None,
        Gravity::Uniform(g) => Gravity::Uniform(vector(&g, number)),
        Gravity::Central { mu } => Gravity::Central { mu: number(mu) },
    };
    let initial = &scenario.initial;
    let Quaternion { q0, q1, q2, q3 } = initial.attitude;
    Parts {
        hub,
        devices,
        motors,
        modes,
        gravity,
        position: vector(&initial.r_b_n, number),
        velocity: vector(&initial.r_b_n_dot, number),
        attitude: Quaternion { q0: number(q0), q1: number(q1), q2: number(q2), q3: number(q3) },
        omega: vector(&initial.omega, number),
        joints: initial.devices.states().map(|state| state.map(&mut *number)).collect(),
    }
}

impl<T: Scalar> Parts<T> {
    /// Initial state and inputs of a spacecraft of these parts.
    pub(super) fn start<D: Devices<Scalar = T>>(
        &self,
        scenario: &Scenario,
        craft: &Spacecraft<D>,
    ) -> (State<D>, Inputs<D>) {
        let mut state: State<D> = State::at_rest_for(craft);
        (state.r_b_n, state.r_b_n_dot) = (self.position, self.velocity);
        (state.attitude, state.omega) = (self.attitude, self.omega);
        for (to, from) in state.devices.states_mut().zip(&self.joints) {
            (*to[0], *to[1]) = (from[0], from[1]);
        }
        let mut inputs = Inputs::none_for(craft);
        let driven: Vec<bool> = craft.joints().map(|(_, info)| info.driven).collect();
        let motors = inputs.motors.values_mut().zip(&self.motors).zip(&driven);
        motors.filter(|(_, driven)| **driven).for_each(|((to, from), _)| *to = *from);
        let modes = inputs.modes.values_mut().zip(&self.modes).zip(&driven);
        modes.filter(|(_, driven)| **driven).for_each(|((to, from), _)| *to = *from);
        inputs.gravity = self.gravity;
        if matches!(scenario.hub_mode, HubMode::Fixed) {
            inputs.hub = HubMode::Fixed;
        }
        (state, inputs)
    }
}

fn vector<T: Scalar>(of: &Vector3<f64>, number: &mut dyn FnMut(f64) -> T) -> Vector3<T> {
    Vector3::new(number(of.x), number(of.y), number(of.z))
}

fn matrix<T: Scalar>(of: &Matrix3<f64>, number: &mut dyn FnMut(f64) -> T) -> Matrix3<T> {
    of.map(number)
}

/// The numbers of a scenario.
fn numbers(scenario: &Scenario) -> Vec<f64> {
    let mut numbers = Vec::new();
    parts(scenario, &mut |value| {
        numbers.push(value);
        value
    });
    numbers
}

/// Derivatives of the numbers by a key: `at` reads the scenario at so many steps from the middle. Of sixth order, so exact but
/// for rounding where a number is a polynomial of the key, as masses, inertias and imbalances are.
pub(super) fn slopes(
    at: &dyn Fn(i32) -> Result<Scenario, String>,
    step: f64,
) -> Result<Vec<f64>, String> {
    let mut sum: Vec<f64> = Vec::new();
    for (steps, weight) in [(1, 45.0), (2, -9.0), (3, 1.0)] {
        let [below, above] = [at(-steps)?, at(steps)?];
        supported(&below)?;
        supported(&above)?;
        let kinds = |of: &Scenario| -> Vec<_> {
            of.devices.0.iter().map(|device| (device.kind(), device.parameters().model)).collect()
        };
        let (low, high) = (numbers(&below), numbers(&above));
        if kinds(&below) != kinds(&above) || low.len() != high.len() {
            return Err("a key changes which devices there are".to_owned());
        }
        if below.settings != above.settings || below.output.rate != above.output.rate {
            return Err("a key changes the run, and not the spacecraft".to_owned());
        }
        sum.resize(low.len(), 0.0);
        for (sum, (low, high)) in sum.iter_mut().zip(low.iter().zip(&high)) {
            *sum += weight * (high - low) / (60.0 * step);
        }
    }
    Ok(sum)
}
