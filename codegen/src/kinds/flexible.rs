//! Wheels on flexible bearings: the rotor tilts and slides in its housing, which is part of its parent
//! body.
//!
//! The bearing centre slides along x, y and z, the rotor tilts about y and z and spins about x, in this
//! order and each by a joint: five links without a body, and the rotor. Springs and dampers of the
//! bearings and the web are the joints' `passive`. About a steady spin the small tilts are those of
//! the literature on wheel disturbances (Masterson, Miller and Grogan, J. Sound Vib. 249(3), 2002): the
//! rocking mode splits into two whirls,
//! `w = I_s Omega / (2 I_r) ± sqrt((I_s Omega / (2 I_r))^2 + k / I_r)`, and the translation modes are
//! at `sqrt(k / m)`.

use super::vscmg::{ARM, GIMBAL};
use super::wheel::{WheelAssembly, imbalanced};
use super::{Body, Centre, Drive, Equations, Inertia, Joint, Kind, Link, Motion, Triple};
use crate::space::Axis;

/// A reaction wheel with a housing that is part of the hub and a rotor on flexible bearings.
pub const FLEXIBLE_REACTION_WHEEL: Kind = Kind {
    name: "flexible_reaction_wheel",
    title: "flexible reaction wheel",
    source: "codegen/src/kinds/flexible.rs",
    links: &[first(ORIGIN, "d"), SLIDE_Y, SLIDE_Z, TILT_Y, TILT_Z, ROTOR],
};

/// A control moment gyro with one gimbal, which carries the housing, and a rotor on flexible bearings.
/// The spin is a joint with a motor, as that of a VSCMG; a steady one is prescribed.
pub const FLEXIBLE_VSCMG: Kind = Kind {
    name: "flexible_vscmg",
    title: "flexible variable-speed control moment gyro",
    source: "codegen/src/kinds/flexible.rs",
    links: &[GIMBAL, first(ARM, "sxa"), SLIDE_Y, SLIDE_Z, TILT_Y, TILT_Z, ROTOR],
};

/// The bearing centre in the hub, where no bearing gives.
const ORIGIN: Triple =
    Triple { symbol: "r_{SX/B}", name: "r_sx_b", names: ["r_sx_b_bx", "r_sx_b_by", "r_sx_b_bz"] };

/// A link of the bearings: a joint without a body, by letter, parent, title, motion, coordinate and what
/// the coordinate is written as.
macro_rules! bearing {
    ($letter:literal $upper:literal $parent:literal $above:literal, $title:literal, $motion:expr,
        $coordinate:literal $symbols:expr) => {
        Link {
            joint: Joint {
                tag: $letter,
                motion: $motion,
                coordinate: $coordinate,
                coordinate_symbol: $symbols[0],
                rate: concat!($coordinate, "_dot"),
                acceleration: concat!($coordinate, "_ddot"),
                symbols: [$symbols[1], $symbols[2]],
                torque: concat!("u_", $letter),
                drive: Drive::Motor,
                concentric: true,
                origin: Triple {
                    symbol: concat!("r_{", $upper, "/", $above, "}"),
                    name: concat!("r_", $letter, "_", $parent),
                    names: [
                        concat!("r_", $letter, "_", $parent, "_", $parent, "x"),
                        concat!("r_", $letter, "_", $parent, "_", $parent, "y"),
                        concat!("r_", $letter, "_", $parent, "_", $parent, "z"),
                    ],
                },
            },
            body: Body {
                title: $title,
                frame: $letter,
                origin: $letter,
                triad: [concat!($letter, "_x"), concat!($letter, "_y"), concat!($letter, "_z")],
                point: concat!($letter, "c"),
                mass: None,
                centre: Centre::At,
                inertia: Inertia::Point,
                letters: [$upper, concat!($upper, "c")],
                equations: Equations::NONE,
            },
            assembly: concat!($letter, "a"),
        }
    };
}

/// The first link of the bearings, with its own place in the parent body.
const fn first(origin: Triple, assembly: &'static str) -> Link {
    let link = bearing!("sx" "SX" "b" "B", "axial slide", Motion::Slide(Axis::X),
        "x" ["x", "ẋ", "ẍ"]);
    Link { joint: Joint { concentric: false, origin, ..link.joint }, assembly, ..link }
}

const SLIDE_Y: Link = bearing!("sy" "SY" "sx" "SX", "radial slide y", Motion::Slide(Axis::Y),
    "y" ["y", "ẏ", "ÿ"]);
const SLIDE_Z: Link = bearing!("sz" "SZ" "sy" "SY", "radial slide z", Motion::Slide(Axis::Z),
    "z" ["z", "ż", "z̈"]);
const TILT_Y: Link = bearing!("ty" "TY" "sz" "SZ", "tilt y", Motion::Turn(Axis::Y),
    "tilt_y" ["tilt_y", "ṫilt_y", "ẗilt_y"]);
const TILT_Z: Link = bearing!("tz" "TZ" "ty" "TY", "tilt z", Motion::Turn(Axis::Z),
    "tilt_z" ["tilt_z", "ṫilt_z", "ẗilt_z"]);

/// The wheel of every device with one, at the bearing centre.
const ROTOR: Link = {
    let origin = Triple {
        symbol: "r_{W/TZ}",
        name: "r_w_tz",
        names: ["r_w_tz_tzx", "r_w_tz_tzy", "r_w_tz_tzz"],
    };
    let wheel = imbalanced(origin, ["tz_x", "w_y", "w_z"], WheelAssembly::Wheel);
    let body = Body { equations: Equations::NONE, ..wheel.body };
    Link { joint: Joint { concentric: true, ..wheel.joint }, body, ..wheel }
};
