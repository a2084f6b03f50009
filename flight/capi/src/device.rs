//! A device from its structure, and the numbers of kinds.

use precess_dynamics::kind::{BodyParameters, ImbalanceModel};
use precess_dynamics::{BuiltIn, BuiltInKind, DeviceParameters, Passive};

use crate::craft::matrix;
use crate::error::{Code, Rejection};
use crate::types;

/// `PRECESS_KIND_`: the number of a kind, which never changes.
pub(crate) const fn number_of(kind: BuiltInKind) -> i32 {
    match kind {
        BuiltInKind::Dgvscmg => 1,
        BuiltInKind::BalancedDgvscmg => 2,
        BuiltInKind::Dgcmg => 3,
        BuiltInKind::BalancedDgcmg => 4,
        BuiltInKind::Vscmg => 5,
        BuiltInKind::BalancedVscmg => 6,
        BuiltInKind::Sgcmg => 7,
        BuiltInKind::BalancedSgcmg => 8,
        BuiltInKind::ReactionWheel => 9,
        BuiltInKind::BalancedReactionWheel => 10,
        BuiltInKind::HingedPanel => 11,
        BuiltInKind::SloshMass => 12,
    }
}

fn kind_of(number: i32) -> Option<BuiltInKind> {
    BuiltInKind::ALL.iter().copied().find(|kind| number_of(*kind) == number)
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
