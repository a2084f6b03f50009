//! The wheel and its motor, as every device with a wheel has them: it spins about the x axis of
//! its parent body.

use super::{Body, Centre, Drive, Inertia, Joint, Link, Motion, Triple, equations};
use crate::space::Axis;

/// As it is made: the centre of mass lies on `w_y`, a distance d from the spin axis, and the
/// inertia has products.
pub(super) const fn imbalanced(
    origin: Triple,
    triad: [&'static str; 3],
    whole: WheelAssembly,
) -> Link {
    Link {
        joint: Joint {
            tag: "w",
            motion: Motion::Turn(Axis::X),
            coordinate: "theta",
            coordinate_symbol: "θ",
            rate: "spin",
            acceleration: "spin_dot",
            symbols: ["Ω", "Ω̇"],
            torque: "u_w",
            drive: Drive::Motor,
            concentric: false,
            origin,
        },
        body: Body {
            title: "wheel",
            frame: "w",
            origin: "w",
            triad,
            point: "wc",
            mass: Some("m_w"),
            centre: Centre::On(Axis::Y, "d"),
            inertia: Inertia::Full("j"),
            letters: ["W", "Wc"],
            equations: equations::WHEEL,
        },
        assembly: match whole {
            WheelAssembly::Device => "d",
            WheelAssembly::Wheel => "w",
        },
    }
}

/// As it should be: d = 0, no products, and the same inertia about every axis across that of the
/// spin; (18) of the paper. W's axes stay those of the parent body.
pub(super) const fn balanced(
    origin: Triple,
    triad: [&'static str; 3],
    whole: WheelAssembly,
) -> Link {
    let made = imbalanced(origin, triad, whole);
    let inertia = Inertia::Symmetric(Axis::X, "j");
    Link { body: Body { centre: Centre::At, inertia, ..made.body }, ..made }
}

/// What the wheel is, with all bodies outboard of it.
#[derive(Clone, Copy)]
pub(super) enum WheelAssembly {
    /// D: the device is a wheel only.
    Device,
    /// W: the tip of a longer chain.
    Wheel,
}
