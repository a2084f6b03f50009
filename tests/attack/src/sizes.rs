//! Magnitudes of what is added up in the equations: the unit of an error that is rounding.
//!
//! Bounds by lengths and norms, body by body: mass times every acceleration that its centre can
//! have, inertia times every angular acceleration. They do not depend on how well the equations are
//! conditioned.

use nalgebra::Vector3;
use precess_dynamics::{Each, Gravity, HubMode, Inputs, JointStates, Passive, State};

use super::case::{Case, List};

/// Sums of magnitudes of the terms of each equation.
#[derive(Clone, Debug)]
pub struct Sizes {
    /// Of the hub's forces, N.
    pub force: f64,
    /// Of the hub's moments about B, N m.
    pub moment: f64,
    /// Of what acts at each joint, N m or N.
    pub joints: Vec<f64>,
}

/// Magnitudes of the momenta and of twice the kinetic energy.
#[derive(Clone, Copy, Debug)]
pub struct Motion {
    /// Linear momentum, kg m/s.
    pub linear: f64,
    /// Angular momentum about B, kg m²/s.
    pub angular: f64,
    /// Twice the kinetic energy, J.
    pub energy: f64,
}

/// A body and all that moves it.
struct Moved {
    mass: f64,
    inertia: f64,
    /// From B to its centre of mass, m.
    arm: f64,
    /// Velocity of its centre of mass and rate.
    velocity: [f64; 2],
    /// Acceleration of its centre of mass and angular acceleration, products of rates among them.
    acceleration: [f64; 2],
}

/// Field and its gradient at a distance from B.
fn field(state: &State<List>, inputs: &Inputs<List>, arm: f64) -> [f64; 2] {
    match inputs.gravity {
        Gravity::None => [0.0; 2],
        Gravity::Uniform(g) => [g.norm(), 0.0],
        Gravity::Central { mu } => {
            let r = state.r_b_n.norm();
            let (g, ratio) = (mu.abs() / (r * r), arm / r);
            [g * (1.0 + 3.0 * ratio + 12.0 * ratio * ratio), 3.0 * g / r]
        }
    }
}

/// Hub and devices, each device by its bodies from the hub outwards.
fn bodies(
    case: &Case,
    state: &State<List>,
    inputs: &Inputs<List>,
    found: &[f64],
) -> Vec<Vec<Moved>> {
    let [a, alpha] = match found {
        [x, y, z, p, q, r, ..] => [Vector3::new(*x, *y, *z), Vector3::new(*p, *q, *r)],
        _ => [Vector3::zeros(); 2],
    };
    let (speed, omega) = (state.r_b_n_dot.norm(), state.omega.norm());
    let moved = |mass, inertia, arm: f64, rates: [f64; 2], joints: f64, slide: [f64; 2]| {
        let [rate, rate_dot] = rates;
        let turning = alpha.norm() + rate_dot + rate * joints;
        let [g, gradient] = field(state, inputs, arm);
        let linear =
            a.norm() + g + turning * arm + rate * rate * arm + slide[1] + 2.0 * rate * slide[0];
        Moved {
            mass,
            inertia,
            arm,
            velocity: [speed + rate * arm + slide[0], rate],
            acceleration: [linear, turning + rate * rate + gradient],
        }
    };
    let arm = case.hub.r_bc_b.norm();
    let hub = moved(case.hub.m_b, case.hub.i_b_bc.norm(), arm, [omega, 0.0], 0.0, [0.0; 2]);
    let mut all = vec![vec![hub]];
    let mut states = state.devices.states();
    let mut accelerations = found.iter().skip(6);
    for device in &case.devices {
        let (parameters, infos) = (device.parameters(), device.kind().joints());
        let (mut reach, mut rates, mut joints) = (0.0, [omega, 0.0], 0.0);
        let mut slide = [0.0; 2];
        let of_device = parameters.bodies.iter().zip(infos).map(|(body, info)| {
            let [q, rate] = states.next().unwrap_or_default();
            let q_ddot = accelerations.next().copied().unwrap_or_default();
            reach += Vector3::from(body.origin).norm();
            if info.slides {
                reach += q.abs();
                slide = [rate.abs(), q_ddot.abs()];
            } else {
                rates = [rates[0] + rate.abs(), rates[1] + q_ddot.abs()];
                joints += rate.abs();
            }
            let arm = reach + Vector3::from(body.centre).norm();
            moved(body.mass, body.inertia.norm(), arm, rates, joints, slide)
        });
        all.push(of_device.collect());
    }
    all
}

/// The sizes for accelerations, given as numbers: hub, then joints.
#[must_use]
pub fn sizes(case: &Case, state: &State<List>, inputs: &Inputs<List>, found: &[f64]) -> Sizes {
    let (mut force, mut moment) = (inputs.force.norm(), inputs.torque_b.norm());
    let mut joints = Vec::new();
    let none = vec![];
    let wrenches: Vec<_> = inputs.bodies.as_ref().unwrap_or(&none).iter().collect();
    let motors: Vec<f64> = inputs.motors.values().collect();
    let states: Vec<_> = state.devices.states().collect();
    let all = bodies(case, state, inputs, found);
    let mut devices = case.devices.iter();
    for (index, of_device) in all.iter().enumerate() {
        let mut of_joints = [0.0; 2];
        let device = if index == 0 { None } else { devices.next() };
        let mut own = [0.0; 2];
        for (body, moved) in of_device.iter().enumerate() {
            let [linear, turning] = moved.acceleration;
            let f = moved.mass * linear;
            let n = moved.inertia * turning + moved.arm * f;
            own = [own[0] + f, own[1] + n];
            if let Some(wrench) = device
                .and(wrenches.get(index.wrapping_sub(1)))
                .and_then(|of_device| of_device.as_slice().get(body))
            {
                own[0] += wrench.force.norm();
                own[1] += wrench.moment.norm() + moved.arm * wrench.force.norm();
            }
        }
        of_joints = [of_joints[0] + own[0], of_joints[1] + own[1]];
        (force, moment) = (force + own[0], moment + own[1]);
        let Some(device) = device else { continue };
        for (info, passive) in device.kind().joints().iter().zip(device.parameters().passive) {
            let load = if info.slides { of_joints[0] } else { of_joints[1] };
            let [q, rate] = states.get(joints.len()).copied().unwrap_or_default();
            let motor = motors.get(joints.len()).copied().unwrap_or_default().abs();
            let Passive { stiffness, rest, viscous, coulomb, .. } = passive;
            let bound = stiffness * (q.abs() + rest.abs()) + viscous * rate.abs() + coulomb;
            joints.push(load + motor + bound);
        }
    }
    Sizes { force, moment, joints }
}

/// The magnitudes of momenta and energy in a state.
#[must_use]
pub fn motion(case: &Case, state: &State<List>) -> Motion {
    let still = Inputs { hub: HubMode::Free, ..case.inputs.clone() };
    let mut sum = Motion { linear: 0.0, angular: 0.0, energy: 0.0 };
    for moved in bodies(case, state, &still, &[]).iter().flatten() {
        let [v, rate] = moved.velocity;
        sum.linear += moved.mass * v;
        sum.angular += moved.arm * moved.mass * v + moved.inertia * rate;
        sum.energy += moved.mass * v * v + moved.inertia * rate * rate;
    }
    sum
}
