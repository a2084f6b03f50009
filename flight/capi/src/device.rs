//! A device from its structure.

use precess_dynamics::kind::{BodyParameters, ImbalanceModel};
use precess_dynamics::{BuiltIn, BuiltInKind, DeviceParameters, MAX_JOINTS, Passive};

use crate::craft::matrix;
use crate::error::{Code, Rejection};
use crate::types;

/// The kind of a `PRECESS_KIND_`.
fn kind_of(number: i32) -> Option<BuiltInKind> {
    u8::try_from(number).ok().and_then(BuiltInKind::of_number)
}

/// The device that a structure states.
pub(crate) fn device_of<const J: usize>(
    index: usize,
    device: &types::Device<J>,
) -> Result<BuiltIn, Rejection> {
    let reject = |code: Code| Rejection { entry: Some(index), ..code.into() };
    let kind = kind_of(device.kind).ok_or(reject(Code::UnknownKind))?;
    if kind.joints().len() > J {
        return Err(reject(Code::ManyJoints));
    }
    let model = match device.model {
        0 => ImbalanceModel::Coupled,
        1 => ImbalanceModel::Lumped,
        _ => return Err(reject(Code::UnknownChoice)),
    };
    let inertia = matrix(&[0.0; 9]);
    let none = BodyParameters { origin: [0.0; 3], mass: 0.0, centre: [0.0; 3], inertia };
    let mut parameters = DeviceParameters {
        mount: matrix(&device.mount),
        bodies: [none; MAX_JOINTS],
        passive: [Passive::none(); MAX_JOINTS],
        model,
    };
    for (to, body) in parameters.bodies.iter_mut().zip(&device.bodies) {
        *to = BodyParameters {
            origin: body.origin,
            mass: body.mass,
            centre: body.centre,
            inertia: matrix(&body.inertia),
        };
    }
    for (to, joint) in parameters.passive.iter_mut().zip(&device.passive) {
        *to = Passive {
            stiffness: joint.stiffness,
            rest: joint.rest,
            viscous: joint.viscous,
            coulomb: joint.coulomb,
            coulomb_rate: joint.coulomb_rate,
        };
    }
    BuiltIn::new(kind, &parameters).map_err(|unsupported| Rejection {
        joint: Some(unsupported.body),
        ..reject(Code::UnsupportedParameter)
    })
}
