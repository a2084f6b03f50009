//! Parameters of a device from its bodies.

use nalgebra::Matrix3;
use precess_dynamics::kind::{BodyParameters, ImbalanceModel};
use precess_dynamics::{DeviceParameters, MAX_JOINTS, Passive};

/// The parameters of a device without springs, dampers and friction.
pub(super) fn parameters(
    mount: Matrix3<f64>,
    from: impl Iterator<Item = BodyParameters<f64>>,
) -> DeviceParameters {
    let none =
        BodyParameters { origin: [0.0; 3], mass: 0.0, centre: [0.0; 3], inertia: Matrix3::zeros() };
    let mut bodies = [none; MAX_JOINTS];
    for (to, body) in bodies.iter_mut().zip(from) {
        *to = body;
    }
    DeviceParameters {
        mount,
        bodies,
        passive: [Passive::none(); MAX_JOINTS],
        model: ImbalanceModel::Coupled,
    }
}
