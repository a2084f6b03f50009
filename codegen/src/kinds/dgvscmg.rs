//! The double-gimbal variable-speed control moment gyro: outer gimbal, inner gimbal, wheel.

use super::wheel::{WheelAssembly, imbalanced};
use super::{Body, Centre, Drive, Inertia, Joint, Kind, Link, Motion, Triple, equations};
use crate::space::Axis;

/// `Go = Rz(gamma_o)`, `Gi = Go Ry(gamma_i)`, `W = Gi Rx(theta)`; the wheel's centre of mass lies
/// on `w_y`, a distance d from the spin axis.
pub const DGVSCMG: Kind = Kind {
    name: "dgvscmg",
    title: "double-gimbal variable-speed control moment gyro",
    source: "codegen/src/kinds/dgvscmg.rs",
    links: &[
        OUTER_GIMBAL,
        INNER_GIMBAL,
        imbalanced(ARM, ["s_x", "w_y", "w_z"], WheelAssembly::Wheel),
    ],
};

/// The gimbal on the hub.
pub(super) const OUTER_GIMBAL: Link = Link {
    joint: Joint {
        tag: "o",
        motion: Motion::Turn(Axis::Z),
        coordinate: "gamma_o",
        coordinate_symbol: "ᵒγ",
        rate: "gamma_o_dot",
        acceleration: "gamma_o_ddot",
        symbols: ["ᵒγ̇", "ᵒγ̈"],
        torque: "u_o",
        drive: Drive::Motor,
        concentric: false,
        origin: Triple {
            symbol: "r_{Gᵒ/B}",
            name: "r_go_b",
            names: ["r_go_b_bx", "r_go_b_by", "r_go_b_bz"],
        },
    },
    body: Body {
        title: "outer gimbal",
        frame: "go",
        origin: "go",
        triad: ["g_x", "s_y", "s_z"],
        point: "goc",
        mass: Some("m_go"),
        centre: Centre::Free(Triple {
            symbol: "r_{Gᵒc/Gᵒ}",
            name: "r_goc_go",
            names: ["r_goc_go_gox", "r_goc_go_goy", "r_goc_go_goz"],
        }),
        inertia: Inertia::Full("i_go"),
        letters: ["Gᵒ", "Gᵒc"],
        equations: equations::OUTER_GIMBAL,
    },
    assembly: "d",
};

/// The gimbal within it, parent body of the wheel.
pub(super) const INNER_GIMBAL: Link = Link {
    joint: Joint {
        tag: "i",
        motion: Motion::Turn(Axis::Y),
        coordinate: "gamma_i",
        coordinate_symbol: "ⁱγ",
        rate: "gamma_i_dot",
        acceleration: "gamma_i_ddot",
        symbols: ["ⁱγ̇", "ⁱγ̈"],
        torque: "u_i",
        drive: Drive::Motor,
        concentric: false,
        origin: Triple { symbol: "Lᵒ", name: "l_o", names: ["l_o_x", "l_o_y", "l_o_z"] },
    },
    body: Body {
        title: "inner gimbal",
        frame: "gi",
        origin: "gi",
        triad: ["s_x", "s_y", "g_z"],
        point: "gic",
        mass: Some("m_gi"),
        centre: Centre::Free(Triple {
            symbol: "r_{Gⁱc/Gⁱ}",
            name: "r_gic_gi",
            names: ["r_gic_gi_gix", "r_gic_gi_giy", "r_gic_gi_giz"],
        }),
        inertia: Inertia::Full("i_gi"),
        letters: ["Gⁱ", "Gⁱc"],
        equations: equations::INNER_GIMBAL,
    },
    assembly: "v",
};

/// From the inner gimbal to the wheel.
pub(super) const ARM: Triple =
    Triple { symbol: "Lⁱ", name: "l_i", names: ["l_i_x", "l_i_y", "l_i_z"] };
