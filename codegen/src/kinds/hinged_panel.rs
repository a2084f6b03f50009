//! A hinged panel: a body that turns about one axis of the hub.

use super::{Body, Centre, Drive, Inertia, Joint, Kind, Link, Motion, Triple, equations};
use crate::space::Axis;

/// `P = Rz(phi)`. A spring and a damper in the hinge come in through its torque:
/// `u_p = -k (phi - phi_0) - c phi_dot`.
///
/// It moves as the outer gimbal does with nothing outboard of it, whose equations it cites.
pub const HINGED_PANEL: Kind = Kind {
    name: "hinged_panel",
    title: "hinged panel",
    source: "codegen/src/kinds/hinged_panel.rs",
    links: &[Link {
        joint: Joint {
            tag: "p",
            motion: Motion::Turn(Axis::Z),
            coordinate: "phi",
            coordinate_symbol: "φ",
            rate: "phi_dot",
            acceleration: "phi_ddot",
            symbols: ["φ̇", "φ̈"],
            torque: "u_p",
            drive: Drive::Motor,
            concentric: false,
            origin: Triple {
                symbol: "r_{P/B}",
                name: "r_p_b",
                names: ["r_p_b_bx", "r_p_b_by", "r_p_b_bz"],
            },
        },
        body: Body {
            title: "panel",
            frame: "p",
            origin: "p",
            triad: ["p_x", "p_y", "b_z"],
            point: "pc",
            mass: Some("m_p"),
            centre: Centre::Free(Triple {
                symbol: "r_{Pc/P}",
                name: "r_pc_p",
                names: ["r_pc_p_px", "r_pc_p_py", "r_pc_p_pz"],
            }),
            inertia: Inertia::Full("i_p"),
            letters: ["P", "Pc"],
            equations: equations::OUTER_GIMBAL,
        },
        assembly: "d",
    }],
};
