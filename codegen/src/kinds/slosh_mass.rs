//! A slosh mass: a point mass that slides along one axis of the hub.

use super::{Body, Centre, Drive, Inertia, Joint, Kind, Link, Motion, Triple, equations};
use crate::space::Axis;

/// The mass is at `r_{S/B} + x b_x`. Its spring and damper come in through the force along the
/// axis: `u_s = -k x - c x_dot`.
///
/// The paper has no sliding joint. The numbers are those of the outer gimbal's equations, which hold
/// here with "slides along" for "turns about".
pub const SLOSH_MASS: Kind = Kind {
    name: "slosh_mass",
    title: "slosh mass",
    source: "codegen/src/kinds/slosh_mass.rs",
    links: &[Link {
        joint: Joint {
            tag: "s",
            motion: Motion::Slide(Axis::X),
            coordinate: "x",
            coordinate_symbol: "x",
            rate: "x_dot",
            acceleration: "x_ddot",
            symbols: ["ẋ", "ẍ"],
            torque: "u_s",
            drive: Drive::Motor,
            concentric: false,
            origin: Triple {
                symbol: "r_{S/B}",
                name: "r_s_b",
                names: ["r_s_b_bx", "r_s_b_by", "r_s_b_bz"],
            },
        },
        body: Body {
            title: "slosh mass",
            frame: "s",
            origin: "s",
            triad: ["b_x", "b_y", "b_z"],
            point: "sc",
            mass: Some("m_s"),
            centre: Centre::At,
            inertia: Inertia::Point,
            letters: ["S", "Sc"],
            equations: equations::OUTER_GIMBAL,
        },
        assembly: "d",
    }],
};
