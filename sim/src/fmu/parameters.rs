//! The parameters of a unit: step, gravity, mass properties, mounts, springs and friction.

use nalgebra::Matrix3;
use precess_dynamics::kind::{BodyParameters, JointInfo};
use precess_dynamics::{BuiltIn, DeviceParameters, Gravity, Passive};

use super::layout::{GRAVITY, HUB, Layout, MOUNTS, PER_MOUNT};
use super::names::Names;
use super::variables::{AXES, Role, Variable, gravity};
use crate::scenario::{Drive, Scenario, body_key};

/// Entries of an inertia in the order of the solver: rows, columns, names.
const ENTRIES: [(usize, usize, &str); 6] =
    [(0, 0, "xx"), (0, 1, "xy"), (0, 2, "xz"), (1, 1, "yy"), (1, 2, "yz"), (2, 2, "zz")];
/// Mass, origin, centre of mass, inertia.
const RIGID: usize = 13;

/// A parameter that is being listed: name, place, unit, value, meaning.
struct Listed {
    all: Vec<Variable>,
}

impl Listed {
    fn push(
        &mut self,
        (name, place): (String, usize),
        role: Role,
        unit: &'static str,
        start: f64,
        meaning: String,
    ) {
        self.all.push(Variable { name, place, role, unit, shown: None, start, meaning });
    }
}

/// All of them, in the order of their places.
pub(super) fn parameters(
    scenario: &Scenario,
    layout: &Layout,
    step: f64,
    names: &mut Names,
) -> Vec<Variable> {
    let mut list = Listed { all: Vec::new() };
    let meaning = "largest step of the Runge-Kutta method in Co-Simulation".to_owned();
    list.push((names.of_hub("step"), layout.parameter(0)), Role::Fixed, "s", step, meaning);
    of_gravity(scenario, layout, names, &mut list);
    of_hub(scenario, layout, names, &mut list);
    for (index, (device, member)) in scenario.members().enumerate() {
        let first = MOUNTS + PER_MOUNT * index;
        let mount = member.mount();
        for place in 0..PER_MOUNT {
            let (row, column) = (place / 3, place % 3);
            let (r, c) = (AXES[row], AXES[column]);
            let name = names.of_device(device, &format!("mount_{r}{c}"));
            let meaning =
                format!("{device}: component along B's {r} axis of the device's {c} axis");
            let place = layout.parameter(first + place);
            list.push((name, place), Role::Fixed, "1", mount[(row, column)], meaning);
        }
    }
    let mut joint = 0;
    for (device, member) in scenario.members() {
        let Some(own) = member.device() else { continue };
        for (body, info) in member.joints().iter().enumerate() {
            // A spring acts on a joint that moves by its motor torque only.
            let moves =
                info.driven && matches!(scenario.drives.get(joint), Some(Drive::Torque { .. }));
            of_body((&own, moves), (device, body, info), layout.body(joint), names, &mut list);
            joint += 1;
        }
    }
    list.all
}

fn of_gravity(scenario: &Scenario, layout: &Layout, names: &mut Names, list: &mut Listed) {
    let values = gravity(scenario);
    let place = |index: usize| layout.parameter(GRAVITY + index);
    match scenario.gravity {
        Gravity::None => {}
        Gravity::Uniform(_) => {
            for (axis, letter) in AXES.iter().enumerate() {
                let name = names.of_hub(&format!("gravity_{letter}"));
                let meaning = format!("acceleration of a uniform field, expressed in N, {letter}");
                list.push((name, place(axis)), Role::Tunable, "m/s2", values[axis], meaning);
            }
        }
        Gravity::Central { mu } => {
            let meaning = "gravitational parameter of the central body".to_owned();
            let name = names.of_hub("gravity_mu");
            list.push((name, place(3)), Role::Tunable, "m3/s2", mu, meaning);
        }
    }
}

fn of_hub(scenario: &Scenario, layout: &Layout, names: &mut Names, list: &mut Listed) {
    let hub = &scenario.hub;
    let place = |index: usize| layout.parameter(HUB + index);
    let name = names.of_hub("hub_mass");
    list.push((name, place(0)), Role::Tunable, "kg", hub.m_b, "mass of the hub".to_owned());
    for (axis, letter) in AXES.iter().enumerate() {
        let name = names.of_hub(&format!("hub_centre_of_mass_{letter}"));
        let meaning = format!("centre of mass of the hub from B, {letter}");
        list.push((name, place(1 + axis)), Role::Tunable, "m", hub.r_bc_b[axis], meaning);
    }
    for (index, (row, column, entry)) in ENTRIES.into_iter().enumerate() {
        let name = names.of_hub(&format!("hub_inertia_{entry}"));
        let meaning = format!("inertia of the hub about its centre of mass, {entry}");
        let value = hub.i_b_bc[(row, column)];
        list.push((name, place(4 + index)), Role::Tunable, "kg.m2", value, meaning);
    }
}

/// The parameters of a body, and of its joint where that moves; not those that the kind has zero.
fn of_body(
    (device, moves): (&BuiltIn, bool),
    (name, index, info): (&str, usize, &JointInfo),
    first: usize,
    names: &mut Names,
    list: &mut Listed,
) {
    let parameters = device.parameters();
    let (Some(body), Some(passive)) = (parameters.bodies.get(index), parameters.passive.get(index))
    else {
        return;
    };
    let key = body_key(info);
    let values = rigid(body);
    for (place, value) in values.into_iter().enumerate() {
        if value == 0.0 && !is_parameter(device, &parameters, index, place) {
            continue;
        }
        let (what, unit, meaning) = rigid_name(place);
        let variable = names.of_device(name, &format!("{key}_{what}"));
        let meaning = format!("{name}: {meaning} of the {}", info.body);
        list.push((variable, first + place), Role::Tunable, unit, value, meaning);
    }
    for (place, (what, units, value, meaning)) in of_passive(passive).into_iter().enumerate() {
        if !moves {
            break;
        }
        let variable = names.of_device(name, &format!("{key}_{what}"));
        let unit = units[usize::from(info.slides)];
        let meaning = format!("{name}: {meaning} of the joint of the {}", info.body);
        list.push((variable, first + RIGID + place), Role::Tunable, unit, value, meaning);
    }
}

/// Names, units of a joint that turns and of one that slides, values, meanings.
fn of_passive(passive: &Passive) -> [(&'static str, [&'static str; 2], f64, &'static str); 5] {
    let Passive { stiffness, rest, viscous, coulomb, coulomb_rate } = *passive;
    [
        ("stiffness", ["N.m/rad", "N/m"], stiffness, "stiffness of the spring"),
        ("rest", ["rad", "m"], rest, "coordinate at which the spring is at rest,"),
        ("damping", ["N.m.s/rad", "N.s/m"], viscous, "viscous friction"),
        ("coulomb", ["N.m", "N"], coulomb, "dry friction"),
        ("coulomb_rate", ["rad/s", "m/s"], coulomb_rate, "rate below which dry friction fades,"),
    ]
}

/// The numbers of a rigid body in the order of the solver.
pub(super) fn rigid(body: &BodyParameters<f64>) -> [f64; RIGID] {
    let mut values = [0.0; RIGID];
    values[0] = body.mass;
    values[1..4].copy_from_slice(&body.origin);
    values[4..7].copy_from_slice(&body.centre);
    for (value, (row, column, _)) in values[7..].iter_mut().zip(ENTRIES) {
        *value = body.inertia[(row, column)];
    }
    values
}

fn rigid_name(place: usize) -> (String, &'static str, String) {
    match place {
        0 => ("mass".to_owned(), "kg", "mass".to_owned()),
        1..=3 => {
            let axis = AXES[place - 1];
            (format!("origin_{axis}"), "m", format!("origin {axis}"))
        }
        4..=6 => {
            let axis = AXES[place - 4];
            (format!("centre_of_mass_{axis}"), "m", format!("centre of mass {axis}"))
        }
        _ => {
            let (_, _, entry) = ENTRIES[(place - 7).min(5)];
            (
                format!("inertia_{entry}"),
                "kg.m2",
                format!("inertia about the centre of mass {entry}"),
            )
        }
    }
}

/// Whether a kind has a parameter where a device has zero.
fn is_parameter(
    device: &BuiltIn,
    parameters: &DeviceParameters,
    index: usize,
    place: usize,
) -> bool {
    let mut changed = *parameters;
    let Some(body) = changed.bodies.get_mut(index) else { return false };
    match place {
        0 => body.mass = 1.0,
        1..=3 => body.origin[place - 1] = 1.0,
        4..=6 => body.centre[place - 4] = 1.0,
        _ => {
            let (row, column, _) = ENTRIES[(place - 7).min(5)];
            let mut inertia: Matrix3<f64> = body.inertia;
            (inertia[(row, column)], inertia[(column, row)]) = (1.0, 1.0);
            body.inertia = inertia;
        }
    }
    BuiltIn::new(device.kind(), &changed).is_ok()
}
