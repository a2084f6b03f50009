//! A device from its structure.

use precess_dynamics::kind::{BodyParameters, ImbalanceModel};
use precess_dynamics::{BuiltIn, BuiltInKind, DeviceParameters, Passive};

use crate::craft::matrix;
use crate::error::{Code, Rejection};
use crate::types;

/// The kind of a `PRECESS_KIND_`.
fn kind_of(number: i32) -> Option<BuiltInKind> {
    u8::try_from(number).ok().and_then(BuiltInKind::of_number)
}

/// The device that a structure states.
pub(crate) fn device_of(index: usize, device: &types::Device) -> Result<BuiltIn, Rejection> {
    let reject = |code: Code| Rejection { device: Some(index), ..code.into() };
    let kind = kind_of(device.kind).ok_or(reject(Code::UnknownKind))?;
    let model = match device.model {
        0 => ImbalanceModel::Coupled,
        1 => ImbalanceModel::Lumped,
        _ => return Err(reject(Code::UnknownChoice)),
    };
    let parameters = DeviceParameters {
        mount: matrix(&device.mount),
        bodies: device.bodies.map(|body| BodyParameters {
            origin: body.origin,
            mass: body.mass,
            centre: body.centre,
            inertia: matrix(&body.inertia),
        }),
        passive: device.passive.map(|joint| Passive {
            stiffness: joint.stiffness,
            rest: joint.rest,
            viscous: joint.viscous,
            coulomb: joint.coulomb,
            coulomb_rate: joint.coulomb_rate,
        }),
        model,
    };
    BuiltIn::new(kind, &parameters).map_err(|unsupported| Rejection {
        joint: Some(unsupported.body),
        ..reject(Code::UnsupportedParameter)
    })
}
