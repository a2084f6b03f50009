//! The bodies as `foxglove.SceneUpdate`: a cylinder for a wheel, a box for hub, panel and platform, a ring for a gimbal,
//! a ball for a slosh mass, each in the frame of its body.

use nalgebra::Vector3;
use serde::Serialize;

use super::frames::HUB;
use super::messages::{Colour, Orientation, Time, Xyz};
use crate::scenario::Scenario;
use crate::shapes::{Joint, hub, joints};

/// Points of a ring.
const RING_POINTS: u32 = 48;
const HUB_COLOUR: Colour = Colour::new(0.65, 0.68, 0.72, 0.25);
const WHEEL_COLOUR: Colour = Colour::new(0.25, 0.45, 0.75, 0.9);
const GIMBAL_COLOUR: Colour = Colour::new(0.80, 0.60, 0.20, 1.0);
const PANEL_COLOUR: Colour = Colour::new(0.15, 0.25, 0.50, 0.8);
const BALL_COLOUR: Colour = Colour::new(0.20, 0.60, 0.60, 0.8);
const HEAVY_COLOUR: Colour = Colour::new(0.85, 0.15, 0.10, 1.0);

/// `foxglove.SceneUpdate`.
#[derive(Serialize)]
pub(super) struct SceneUpdate {
    deletions: [(); 0],
    pub(super) entities: Vec<Entity>,
}

/// `foxglove.SceneEntity`: it stays until the end of the file and moves with its frame.
#[derive(Serialize)]
pub(super) struct Entity {
    timestamp: Time,
    frame_id: String,
    id: String,
    lifetime: Time,
    frame_locked: bool,
    metadata: [(); 0],
    arrows: [(); 0],
    cubes: Vec<Solid>,
    spheres: Vec<Solid>,
    cylinders: Vec<Cylinder>,
    lines: Vec<Ring>,
    triangles: [(); 0],
    texts: [(); 0],
    models: [(); 0],
}

#[derive(Serialize)]
struct Pose {
    position: Xyz,
    orientation: Orientation,
}

/// A box or an ellipsoid with these sides or diameters, m.
#[derive(Serialize)]
struct Solid {
    pose: Pose,
    size: Xyz,
    color: Colour,
}

#[derive(Serialize)]
struct Cylinder {
    pose: Pose,
    size: Xyz,
    bottom_scale: f64,
    top_scale: f64,
    color: Colour,
}

/// A closed line.
#[derive(Serialize)]
struct Ring {
    #[serde(rename = "type")]
    kind: u8,
    pose: Pose,
    thickness: f64,
    scale_invariant: bool,
    points: Vec<Xyz>,
    color: Colour,
    colors: [(); 0],
    indices: [(); 0],
}

/// The bodies of a scenario.
pub(super) fn update(time: Time, scenario: &Scenario) -> SceneUpdate {
    let box_of_hub = hub(scenario);
    let mut body = Entity::new(time, HUB);
    body.cubes.push(solid(box_of_hub.centre, box_of_hub.size, HUB_COLOUR));
    let joints = joints(scenario);
    let mut entities = vec![body];
    for (index, joint) in joints.iter().enumerate() {
        let outboard = joints.iter().find(|of| usize::try_from(of.parent) == Ok(index));
        entities.extend(entity(time, joint, outboard));
    }
    SceneUpdate { deletions: [], entities }
}

fn entity(time: Time, joint: &Joint, outboard: Option<&Joint>) -> Option<Entity> {
    let body = joint.body.as_ref()?;
    let mut entity = Entity::new(time, &joint.name);
    let diameter = 2.0 * body.radius;
    match (body.shape, body.size) {
        ("wheel", _) => entity.cylinders.push(Cylinder {
            pose: pose(body.centre, joint.axis),
            size: Xyz { x: diameter, y: diameter, z: body.width },
            bottom_scale: 1.0,
            top_scale: 1.0,
            color: WHEEL_COLOUR,
        }),
        ("ring", _) => {
            // Its plane has its own axis and that of the joint it carries.
            let normal = outboard.map_or((joint.axis + 1) % 3, |of| normal(joint.axis, of));
            entity.lines.push(ring(body.centre, normal, body.radius, body.width));
        }
        (_, Some(size)) => entity.cubes.push(solid(body.centre, size, PANEL_COLOUR)),
        _ => entity.spheres.push(solid(body.centre, [diameter; 3], BALL_COLOUR)),
    }
    if let Some(heavy) = body.heavy {
        // On the rim, in the direction of the centre of mass.
        let direction = Vector3::from(heavy).normalize() * (0.82 * body.radius);
        let size = (0.3 * body.radius).max(1.1 * body.width);
        entity.spheres.push(solid(direction.into(), [size; 3], HEAVY_COLOUR));
    }
    Some(entity)
}

/// The coordinate axis nearest to the normal of both axes, in the axes of the body of the first.
fn normal(own: usize, outboard: &Joint) -> usize {
    // Row by row, from the joint's axes at zero to the parent's: a column is an axis of the joint.
    let carried = [0, 1, 2].map(|row| outboard.mount[3 * row + outboard.axis.min(2)]);
    let [a, b] = [(own + 1) % 3, (own + 2) % 3];
    if carried[a].abs() < carried[b].abs() { a } else { b }
}

impl Entity {
    fn new(timestamp: Time, frame: &str) -> Self {
        Self {
            timestamp,
            frame_id: frame.to_owned(),
            id: frame.to_owned(),
            lifetime: Time::default(),
            frame_locked: true,
            metadata: [],
            arrows: [],
            cubes: Vec::new(),
            spheres: Vec::new(),
            cylinders: Vec::new(),
            lines: Vec::new(),
            triangles: [],
            texts: [],
            models: [],
        }
    }
}

fn solid(centre: [f64; 3], [x, y, z]: [f64; 3], color: Colour) -> Solid {
    Solid { pose: pose(centre, 2), size: Xyz { x, y, z }, color }
}

/// A pose whose z axis is the axis of a number.
fn pose([x, y, z]: [f64; 3], axis: usize) -> Pose {
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let turn = match axis {
        0 => [half, 0.0, half, 0.0],
        1 => [half, -half, 0.0, 0.0],
        _ => [1.0, 0.0, 0.0, 0.0],
    };
    Pose { position: Xyz { x, y, z }, orientation: Orientation::new(turn) }
}

fn ring(centre: [f64; 3], normal: usize, radius: f64, thickness: f64) -> Ring {
    let point = |index: u32| {
        let angle = std::f64::consts::TAU * f64::from(index) / f64::from(RING_POINTS);
        let (sin, cos) = precess_dynamics::Angle::sin_cos(angle);
        Xyz { x: radius * cos, y: radius * sin, z: 0.0 }
    };
    Ring {
        // LINE_LOOP.
        kind: 1,
        pose: pose(centre, normal),
        thickness,
        scale_invariant: false,
        points: (0..RING_POINTS).map(point).collect(),
        color: GIMBAL_COLOUR,
        colors: [],
        indices: [],
    }
}
