//! What calls read: a wheel, a law and a servo for it.

use crate::types::{Body, Device, Servo, SteeringLaw};

/// A wheel of 3 kg.
pub(super) fn wheel<const J: usize>() -> Device<J> {
    let mut device = Device { kind: 9, ..Device::EMPTY };
    let diagonal = |[x, y, z]: [f64; 3]| [x, 0.0, 0.0, 0.0, y, 0.0, 0.0, 0.0, z];
    device.mount = diagonal([1.0; 3]);
    let inertia = diagonal([0.02, 0.01, 0.01]);
    device.bodies[0] = Body { mass: 3.0, origin: [0.1; 3], centre: [0.0; 3], inertia };
    device
}

/// The acceleration of a wheel, by an inverse that needs no other.
pub(super) fn law<const J: usize>() -> SteeringLaw<J> {
    let none = [[0.0; J]; crate::MAX_DEVICES];
    let mut law = SteeringLaw {
        weight: [[1.0; J]; crate::MAX_DEVICES],
        lower: none,
        upper: none,
        reference: 1.0,
        lambda: 0.1,
        mu: 0.0,
        dither: [0.0; 3],
        wheel_mu: 0.0,
        steered: [[0; J]; crate::MAX_DEVICES],
        inverse: 1,
        bounded: 0,
    };
    law.steered[0][0] = 2;
    law
}

/// The acceleration of that wheel again.
pub(super) fn servo<const J: usize>() -> Servo<J> {
    let none = [[0.0; J]; crate::MAX_DEVICES];
    let mut servo = Servo {
        command: [[1.0; J]; crate::MAX_DEVICES],
        feed_forward: none,
        gain: none,
        limit: [[1e3; J]; crate::MAX_DEVICES],
        steered: [[0; J]; crate::MAX_DEVICES],
    };
    servo.steered[0][0] = 2;
    servo
}
