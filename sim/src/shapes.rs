//! The bodies as the replay and a viewer draw them: where their joints are, and a shape that their mass and
//! inertia suggest.

use nalgebra::Matrix3;
use precess_dynamics::kind::{BodyParameters, JointInfo};
use serde::Serialize;

use crate::file::read::has_mass;
use crate::scenario::Scenario;

/// Sides and thicknesses are at least this, m.
const THIN: f64 = 0.01;
/// What a slosh mass is drawn as: a ball of this density, kg/m³.
const DENSITY: f64 = 1000.0;
/// A gimbal's ring over the radius of what it holds.
const RING: f64 = 1.25;

/// The hub's box.
#[derive(Clone, Serialize)]
pub(crate) struct Hub {
    /// Along the axes of B, m.
    pub(crate) size: [f64; 3],
    /// From B, m.
    pub(crate) centre: [f64; 3],
}

/// A joint and its child body.
#[derive(Clone, Serialize)]
pub(crate) struct Joint {
    pub(crate) name: String,
    /// Index of the inboard joint; -1 for the hub.
    pub(crate) parent: i64,
    /// Row by row, from the joint's axes at zero to the parent's.
    pub(crate) mount: [f64; 9],
    /// In the parent's frame, m.
    pub(crate) origin: [f64; 3],
    pub(crate) axis: usize,
    pub(crate) slides: bool,
    pub(crate) body: Option<Body>,
}

/// What is drawn.
#[derive(Clone, Serialize)]
pub(crate) struct Body {
    pub(crate) shape: &'static str,
    pub(crate) radius: f64,
    pub(crate) width: f64,
    pub(crate) centre: [f64; 3],
    pub(crate) size: Option<[f64; 3]>,
    pub(crate) heavy: Option<[f64; 3]>,
}

/// The hub of a scenario.
pub(crate) fn hub(scenario: &Scenario) -> Hub {
    Hub { size: scenario.hub_size.into(), centre: scenario.hub.r_bc_b.into() }
}

/// The joints of a scenario, the inboard one of each device and platform first.
pub(crate) fn joints(scenario: &Scenario) -> Vec<Joint> {
    let mut joints: Vec<Joint> = Vec::new();
    // The last joint of each member, to whose body the devices on a platform are fixed.
    let mut tips: Vec<i64> = Vec::new();
    for (name, member) in scenario.members() {
        let (parameters, infos) = (member.bodies(), member.joints());
        let base = member.on().and_then(|on| tips.get(on)).copied().unwrap_or(-1);
        // From the tip to the hub, because a ring encloses what it holds.
        let mut reach = 0.0;
        let mut bodies: Vec<Option<Body>> = Vec::new();
        for (info, of) in infos.iter().zip(&parameters).rev() {
            // A platform's first five bodies have no mass, nor have links without a body.
            let has_body = match member.device() {
                Some(device) => has_mass(device.kind(), info),
                None => info.tip,
            };
            let drawn = has_body.then(|| body(info, of, reach));
            reach = drawn.as_ref().map_or(reach, |drawn| drawn.radius);
            bodies.push(drawn);
        }
        let of_joints = infos.iter().zip(&parameters).zip(bodies.into_iter().rev());
        for ((info, of), body) in of_joints {
            let inboard = i64::try_from(joints.len()).unwrap_or(0) - 1;
            let axes = if info.index == 0 { member.mount() } else { Matrix3::identity() };
            // nalgebra stores columns.
            let rows = axes.transpose();
            let mut mount = [0.0; 9];
            mount.iter_mut().zip(rows.iter()).for_each(|(to, from)| *to = *from);
            joints.push(Joint {
                name: format!("{name}.{}", info.body.replace(' ', "_")),
                parent: if info.index == 0 { base } else { inboard },
                mount,
                origin: of.origin,
                axis: info.axis,
                slides: info.slides,
                body,
            });
        }
        tips.push(i64::try_from(joints.len()).unwrap_or(0) - 1);
    }
    joints
}

/// A body by its name in the kind; `reach` is the radius of what is outboard of it.
fn body(info: &JointInfo, of: &BodyParameters<f64>, reach: f64) -> Body {
    let moment = |axis: usize| of.inertia[(axis, axis)];
    let per_mass = |inertia: f64| (inertia / of.mass).max(0.0);
    let plain = |shape, radius, width| Body {
        shape,
        radius,
        width,
        centre: of.centre,
        size: None,
        heavy: None,
    };
    match info.body {
        // J = m r² / 2 about the axis and m (3 r² + w²) / 12 across.
        "wheel" => {
            let across = 0.5 * (moment((info.axis + 1) % 3) + moment((info.axis + 2) % 3));
            let radius = (2.0 * per_mass(moment(info.axis))).sqrt().max(THIN);
            let width = (12.0 * per_mass(across) - 3.0 * radius * radius).max(0.0).sqrt();
            let mut centre = of.centre;
            let mut heavy = of.centre;
            for (index, (centre, heavy)) in centre.iter_mut().zip(&mut heavy).enumerate() {
                // The disc turns about its geometric axis; the offset is the heavy spot.
                if index == info.axis { *heavy = 0.0 } else { *centre = 0.0 }
            }
            let heavy = heavy.iter().any(|part| *part != 0.0).then_some(heavy);
            let width = width.clamp(0.2 * radius, 1.5 * radius);
            Body { centre, heavy, ..plain("wheel", radius, width) }
        }
        // J_x = m (b² + c²) / 12.
        "panel" | "platform" => {
            let sum = moment(0) + moment(1) + moment(2);
            let size =
                [0, 1, 2].map(|axis| (6.0 * per_mass(sum - 2.0 * moment(axis))).sqrt().max(THIN));
            Body { size: Some(size), ..plain("plate", 0.0, 0.0) }
        }
        _ if info.slides => {
            let radius = (0.75 * of.mass / (std::f64::consts::PI * DENSITY)).cbrt();
            plain("ball", radius.max(THIN), 0.0)
        }
        _ => {
            let held = if reach > 0.0 { reach } else { per_mass(2.0 * moment(info.axis)).sqrt() };
            let radius = (RING * held).max(THIN);
            // The ring encloses what it holds, wherever the gimbal's own centre of mass is.
            Body { centre: [0.0; 3], ..plain("ring", radius, 0.1 * radius) }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::joints;
    use crate::file::from_toml;

    /// Each body of the replay is in the frame of the body that its joint names: those of an inner platform in that of the
    /// outer one.
    #[test]
    fn the_replay_has_a_platform_in_the_frame_of_the_platform_below() {
        let platform = |name: &str, on: &str| {
            format!(
                "[[platform]]\nname = \"{name}\"\non = \"{on}\"\nmass = \"1 kg\"\ninertia = \"1, 1, 1 kg m^2\"\n\
                 position = \"0, 0, 2 m\"\n"
            )
        };
        let text = format!(
            "format = 1\n[hub]\nmass = \"9 kg\"\ninertia = \"9, 9, 9 kg m^2\"\n{}{}[[device]]\nname = \"rw\"\n\
             on = \"upper\"\nkind = \"reaction_wheel\"\nwheel = {{ mass = \"1 kg\", inertia = \"2, 1, 1 g m^2\" }}\n\
             [run]\nduration = \"1 s\"\n",
            platform("upper", "lower"),
            platform("lower", "hub"),
        );
        let (scenario, _) = from_toml("two", &text, Path::new("")).expect("a scenario");
        let joints = joints(&scenario);
        let parents: Vec<_> = joints.iter().map(|joint| joint.parent).collect();
        assert_eq!(parents, [-1, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11]);
        let names = [5, 6, 12].map(|index| joints[index].name.as_str());
        assert_eq!(names, ["lower.platform", "upper.x_slide", "rw.wheel"]);
        assert_eq!(joints[6].origin, [0.0, 0.0, 2.0]);
    }
}
