//! What the templates of the emitted tests are filled from.

use precess_description::Description;
use serde::Serialize;
use tera::Context;

use crate::error::BakeError;
use crate::numbers::{float, list, matrix, vector};
use crate::parameters::{Parameter, ParameterLocation, parameters};
use crate::reference::{Case, JointCase, cases};
use crate::shape::Shape;
use crate::sources::written;
use crate::values::Assigned;

#[derive(Serialize)]
struct BodyText {
    mass: String,
    origin: String,
    centre_of_mass: String,
    inertia: String,
    /// Six entries.
    inertia_c: String,
}

#[derive(Serialize)]
struct DeviceText {
    mount: String,
    bodies: Vec<BodyText>,
    locked: Vec<Assigned>,
}

#[derive(Serialize)]
struct DevicesText {
    module: &'static str,
    devices: Vec<DeviceText>,
}

#[derive(Clone, Serialize)]
struct CaseShape {
    module: &'static str,
    moves: bool,
    is_driven: bool,
    joints: Vec<String>,
    drives: Vec<String>,
    /// The same in C: in order, without names.
    joints_c: Vec<String>,
    drives_c: Vec<String>,
}

#[derive(Serialize)]
struct Block {
    module: &'static str,
    acceleration: &'static str,
    values: String,
    count: usize,
}

#[derive(Serialize)]
struct CaseText {
    name: &'static str,
    omega: String,
    force: String,
    torque_b: String,
    shapes: Vec<CaseShape>,
    /// Those of which a joint moves.
    moving: Vec<CaseShape>,
    r_b_n_ddot: String,
    omega_dot: String,
    blocks: Vec<Block>,
}

#[derive(Serialize)]
struct Broken {
    name: String,
    module: &'static str,
    parameter: String,
    change: String,
    change_c: String,
}

/// What the emitted tests are made of.
pub(crate) fn reference(
    description: &Description,
    shapes: &[Shape<'_>],
) -> Result<Context, BakeError> {
    let mut context = Context::new();
    context.insert("name", &description.name);
    context.insert("upper", &description.name.to_uppercase());
    let hub = &description.hub;
    let [[xx, xy, xz], [_, yy, yz], [.., zz]] = hub.inertia;
    context.insert(
        "hub",
        &BodyText {
            inertia_c: list([xx, xy, xz, yy, yz, zz].into_iter()),
            mass: float(hub.mass),
            origin: String::new(),
            centre_of_mass: vector(&hub.centre_of_mass),
            inertia: matrix(&hub.inertia),
        },
    );
    let devices = shapes.iter().map(|shape| DevicesText {
        module: shape.kind.name,
        devices: shape
            .devices
            .iter()
            .map(|device| {
                let body = |body: &precess_description::Body| BodyText {
                    mass: float(body.mass),
                    origin: vector(&body.origin),
                    centre_of_mass: vector(&body.centre_of_mass),
                    inertia: matrix(&body.inertia),
                    inertia_c: String::new(),
                };
                let locked = device.body.iter().zip(shape.kind.links).filter_map(|(body, link)| {
                    let name = link.joint.coordinate.to_owned();
                    let locked_at = body.locked_at.filter(|_| link.is_locked());
                    locked_at.map(|at| Assigned::new(name, float(at)))
                });
                DeviceText {
                    mount: matrix(&device.mount),
                    bodies: device.body.iter().map(body).collect(),
                    locked: locked.collect(),
                }
            })
            .collect(),
    });
    context.insert("shapes", &devices.collect::<Vec<_>>());
    let names = ["all_joints_driven", "some_joints_prescribed", "all_joints_prescribed"];
    let upper = description.name.to_uppercase();
    let cases = cases(description, shapes)?;
    let cases: Vec<_> =
        cases.iter().zip(names).map(|(case, name)| case_text(case, name, shapes, &upper)).collect();
    context.insert("cases", &cases);
    context.insert("broken", &shapes.iter().filter_map(broken).collect::<Vec<_>>());
    Ok(context)
}

fn case_text(case: &Case, name: &'static str, shapes: &[Shape<'_>], upper: &str) -> CaseText {
    let link = |shape: &Shape<'_>, joint: &JointCase| shape.kind.links[joint.link];
    let shape = |(shape, devices): (&Shape<'_>, &Vec<Vec<JointCase>>)| {
        let joints = devices.iter().map(|joints| {
            let own = joints.iter().map(|joint| {
                let data = link(shape, joint).joint;
                let (at, rate) = (float(joint.coordinate), float(joint.rate));
                format!("{}: {at}, {}: {rate}", data.coordinate, data.rate)
            });
            own.collect::<Vec<_>>().join(", ")
        });
        let drives = devices.iter().map(|joints| {
            let driven = joints.iter().filter(|joint| link(shape, joint).is_driven());
            let own = driven.map(|joint| {
                let way = if joint.driven { "Torque" } else { "Acceleration" };
                format!("{}: Drive::{way}({})", link(shape, joint).joint.torque, float(joint.given))
            });
            own.collect::<Vec<_>>().join(", ")
        });
        let joints_c = devices.iter().map(|joints| {
            let own = joints.iter().flat_map(|joint| [joint.coordinate, joint.rate]);
            own.map(float).collect::<Vec<_>>().join(", ")
        });
        let drives_c = devices.iter().map(|joints| {
            let driven = joints.iter().filter(|joint| link(shape, joint).is_driven());
            let own = driven.map(|joint| {
                let way = if joint.driven { "TORQUE" } else { "ACCELERATION" };
                format!("{{ {upper}_{way}, {} }}", float(joint.given))
            });
            own.collect::<Vec<_>>().join(", ")
        });
        CaseShape {
            module: shape.kind.name,
            moves: shape.kind.links.iter().any(|link| !link.is_locked()),
            is_driven: shape.kind.driven().next().is_some(),
            joints: joints.collect(),
            drives: drives.collect(),
            joints_c: joints_c.collect(),
            drives_c: drives_c.collect(),
        }
    };
    let blocks = shapes.iter().zip(&case.devices).flat_map(|(shape, devices)| {
        let moving = shape.kind.links.iter().filter(|link| !link.is_locked());
        moving.enumerate().map(|(k, link)| Block {
            module: shape.kind.name,
            acceleration: link.joint.acceleration,
            count: devices.len(),
            values: list(devices.iter().map(|joints| joints[k].acceleration)),
        })
    });
    let all: Vec<_> = shapes.iter().zip(&case.devices).map(shape).collect();
    CaseText {
        name,
        omega: vector(&case.omega),
        force: vector(&case.force),
        torque_b: vector(&case.torque_b),
        moving: all.iter().filter(|shape| shape.moves).cloned().collect(),
        shapes: all,
        r_b_n_ddot: list(case.hub[..3].iter().copied()),
        omega_dot: list(case.hub[3..].iter().copied()),
        blocks: blocks.collect(),
    }
}

/// A change of the first parameter that was assumed zero.
fn broken(shape: &Shape<'_>) -> Option<Broken> {
    let list = parameters(shape.general);
    let zero = |parameter: &&Parameter| {
        let along_b = matches!(parameter.place, ParameterLocation::Origin(0, _));
        shape.assumed.zero.contains(&parameter.name) && !along_b
    };
    let parameter = list.iter().find(zero)?;
    let place = written(parameter.place);
    let scale = match parameter.place {
        // Well above the bound, and far below what the body has.
        ParameterLocation::Inertia(..) => float(1e-12 * parameter.place.scale(shape.devices[0])),
        _ => "1e-12".to_owned(),
    };
    let module = shape.kind.name;
    // An inertia stays symmetric.
    let mut change = format!("{place} = {scale};");
    if let ParameterLocation::Inertia(k, row, column) = parameter.place
        && row != column
    {
        let other = written(ParameterLocation::Inertia(k, column, row));
        change = format!("{change} {other} = {scale};");
    }
    Some(Broken {
        name: format!("{module}_with_{}", parameter.name),
        module,
        parameter: parameter.name.clone(),
        change_c: change.clone(),
        change: format!("let b = &mut parameters.{module}[0].bodies; {change}"),
    })
}
