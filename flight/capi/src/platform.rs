//! A platform from its entry: the platform is the last of its six bodies, the others are links of the
//! suspension without mass.

use nalgebra::{Matrix6, Vector3, Vector6};
use precess_dynamics::{Coupled, Passive, Platform, Strut, Suspension, platform};

use crate::craft::matrix;
use crate::error::{Code, Rejection};
use crate::types::{self, Entry, PLATFORM_JOINTS};

/// `PRECESS_KIND_PLATFORM`.
pub(crate) const PLATFORM: i32 = 100;

/// Names of the child bodies, by which a rejection says a joint.
const BODIES: [&str; PLATFORM_JOINTS] =
    ["x slide", "y slide", "z slide", "x turn", "y turn", "platform"];

/// Whether an entry is a platform.
pub(crate) fn is_platform(entry: &Entry) -> bool {
    entry.device.kind == PLATFORM
}

/// The platform of an entry, and its suspension.
pub(crate) fn platform_of(
    index: usize,
    entry: &Entry,
) -> Result<(Platform, Suspension), Rejection> {
    let device = &entry.device;
    let reject = |joint| Rejection {
        entry: Some(index),
        joint: Some(joint),
        ..Code::UnsupportedParameter.into()
    };
    if device.model != 0 {
        return Err(reject("platform"));
    }
    let [first, y, z, turn_x, turn_y, last, ..] = &device.bodies;
    for (body, name) in [first, y, z, turn_x, turn_y].into_iter().zip(BODIES) {
        let origin = if name == "x slide" { [0.0; 3] } else { body.origin };
        let mut numbers = origin.iter().chain(&body.centre).chain(&body.inertia);
        if body.mass != 0.0 || numbers.any(|number| *number != 0.0) {
            return Err(reject(name));
        }
    }
    if last.origin.iter().any(|number| *number != 0.0) {
        return Err(reject("platform"));
    }
    let [x, y, z, turn_x, turn_y, turn_z, ..] = device.passive;
    let passive = [x, y, z, turn_x, turn_y, turn_z].map(|joint| Passive {
        stiffness: joint.stiffness,
        rest: joint.rest,
        viscous: joint.viscous,
        coulomb: joint.coulomb,
        coulomb_rate: joint.coulomb_rate,
    });
    let platform = Platform {
        mount: matrix(&device.mount),
        r_p_b: Vector3::from(first.origin),
        m_p: last.mass,
        r_pc_p: Vector3::from(last.centre),
        i_p_pc: matrix(&last.inertia),
        passive: platform::PerJoint::of(passive),
    };
    Ok((platform, suspension_of(&entry.suspension)))
}

/// Matrices and struts of zeros are none.
fn suspension_of(from: &types::Suspension) -> Suspension {
    let mut matrices = from.stiffness.iter().chain(&from.damping);
    let coupled = matrices.any(|number| *number != 0.0).then(|| Coupled {
        stiffness: Matrix6::from_row_slice(&from.stiffness),
        rest: Vector6::from(from.rest),
        damping: Matrix6::from_row_slice(&from.damping),
    });
    let struts = from.strut.map(|strut| {
        (strut != types::Strut::NONE).then(|| Strut {
            position: Vector3::from(strut.position),
            direction: Vector3::from(strut.direction),
            length: strut.length,
            stiffness: strut.stiffness,
            damping: strut.damping,
        })
    });
    Suspension { coupled, struts }
}
