//! Bodies as they are drawn, and devices of a kind made of them.

use nalgebra::{Matrix3, Quaternion as Turn, UnitQuaternion, Vector3};
use precess_dynamics::kind::BodyParameters;
use precess_dynamics::{
    BuiltIn, BuiltInKind, DeviceParameters, ImbalanceModel, MAX_JOINTS, Passive,
};

/// A body: mass, origin, centre of mass, edges, orientation.
#[derive(Clone, Debug)]
pub(crate) struct Body {
    pub(crate) mass: f64,
    pub(crate) origin: [f64; 3],
    pub(crate) centre: [f64; 3],
    pub(crate) edges: [f64; 3],
    pub(crate) turn: [f64; 4],
    /// Without mass, where the kind allows that, and without inertia.
    pub(crate) hollow: bool,
}

/// A device of a kind with these bodies, springs and friction.
pub(crate) fn built_in(
    kind: BuiltInKind,
    mount: [f64; 4],
    drawn: &[Body; MAX_JOINTS],
    passive: &[Passive; MAX_JOINTS],
    lumped: bool,
) -> BuiltIn {
    let infos = kind.joints();
    let balanced = format!("{kind:?}").starts_with("Balanced");
    let mut bodies = drawn.clone().map(|body| {
        let mass = if body.hollow { 0.0 } else { body.mass };
        let inertia = if body.hollow { Matrix3::zeros() } else { block(&body) };
        BodyParameters { origin: body.origin, mass, centre: body.centre, inertia }
    });
    for ((body, drawn), info) in bodies.iter_mut().zip(drawn).zip(infos) {
        if !info.tip {
            continue;
        }
        body.mass = drawn.mass;
        match info.body {
            "wheel" if balanced => {
                body.centre = [0.0; 3];
                let [axial, across] = disc(drawn);
                body.inertia = Matrix3::from_diagonal(&Vector3::new(axial, across, across));
            }
            "wheel" => {
                body.centre = [0.0, 0.1 * drawn.centre[1], 0.0];
                let [axial, across] = disc(drawn);
                let [w, x, y, z] = drawn.turn;
                let tilt = rotation([w.signum() * (1.0 + w.abs()), 0.1 * x, 0.1 * y, 0.1 * z]);
                body.inertia = turned(Vector3::new(axial, across, across), &tilt);
            }
            "slosh mass" => {
                (body.centre, body.inertia) = ([0.0; 3], Matrix3::zeros());
            }
            _ => {}
        }
    }
    if let Some(first) = infos.iter().position(|info| info.body == "axial slide") {
        concentric(&mut bodies[first..infos.len()]);
    }
    let lumped = lumped && !balanced && infos.last().is_some_and(|info| info.body == "wheel");
    let model = if lumped { ImbalanceModel::Lumped } else { ImbalanceModel::Coupled };
    let parameters = DeviceParameters { mount: rotation(mount), bodies, passive: *passive, model };
    BuiltIn::new(kind, &parameters).expect("what the kind has no parameter for is zero")
}

/// Links without a body inboard of a wheel, the last, all at the origin of the first.
fn concentric(bodies: &mut [BodyParameters<f64>]) {
    let last = bodies.len() - 1;
    for (index, body) in bodies.iter_mut().enumerate() {
        if index < last {
            (body.mass, body.centre, body.inertia) = (0.0, [0.0; 3], Matrix3::zeros());
        }
        if index > 0 {
            body.origin = [0.0; 3];
        }
    }
}

/// The quaternion of unit length, or the identity for one that is too short.
pub(crate) fn unit(q: [f64; 4]) -> [f64; 4] {
    let length = q.iter().map(|x| x * x).sum::<f64>().sqrt();
    if length > 1e-3 { q.map(|x| x / length) } else { [1.0, 0.0, 0.0, 0.0] }
}

/// The rotation of a quaternion of any length.
#[must_use]
pub fn rotation(q: [f64; 4]) -> Matrix3<f64> {
    let [w, x, y, z] = unit(q);
    *UnitQuaternion::from_quaternion(Turn::new(w, x, y, z)).to_rotation_matrix().matrix()
}

/// The inertia of a solid block.
pub(crate) fn block(body: &Body) -> Matrix3<f64> {
    let edges = Vector3::from(body.edges);
    let squares = edges.component_mul(&edges);
    let [x, y, z] = squares.into();
    turned(Vector3::new(y + z, z + x, x + y) * (body.mass / 12.0), &rotation(body.turn))
}

/// Moments of a solid disc about its axis and across it.
fn disc(body: &Body) -> [f64; 2] {
    let [radius, thickness, _] = body.edges.map(|edge| 0.2 * edge);
    let axial = body.mass * radius * radius / 2.0;
    [axial, axial / 2.0 + body.mass * thickness * thickness / 12.0]
}

/// Principal moments along turned axes: a matrix symmetric to the last bit.
fn turned(moments: Vector3<f64>, axes: &Matrix3<f64>) -> Matrix3<f64> {
    let inertia = axes * Matrix3::from_diagonal(&moments) * axes.transpose();
    (inertia + inertia.transpose()) * 0.5
}
