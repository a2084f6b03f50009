//! The variable-speed control moment gyro: one gimbal and a wheel.

use super::wheel::{WheelAssembly, imbalanced};
use super::{Body, Centre, Drive, Inertia, Joint, Kind, Link, Motion, Triple, equations};
use crate::space::Axis;

/// `G = Rz(gamma)`, `W = G Rx(theta)`: the DGVSCMG with its inner gimbal locked at zero and without
/// mass.
pub const VSCMG: Kind = Kind {
    name: "vscmg",
    title: "variable-speed control moment gyro",
    source: "codegen/src/kinds/vscmg.rs",
    links: &[GIMBAL, imbalanced(ARM, ["g_x", "w_y", "w_z"], WheelAssembly::Wheel)],
};

/// The gimbal: the outer one of the DGVSCMG.
pub(super) const GIMBAL: Link = Link {
    joint: Joint {
        tag: "g",
        motion: Motion::Turn(Axis::Z),
        coordinate: "gamma",
        coordinate_symbol: "γ",
        rate: "gamma_dot",
        acceleration: "gamma_ddot",
        symbols: ["γ̇", "γ̈"],
        torque: "u_g",
        drive: Drive::Motor,
        concentric: false,
        origin: Triple {
            symbol: "r_{G/B}",
            name: "r_g_b",
            names: ["r_g_b_bx", "r_g_b_by", "r_g_b_bz"],
        },
    },
    body: Body {
        title: "gimbal",
        frame: "g",
        origin: "g",
        triad: ["g_x", "g_y", "g_z"],
        point: "gc",
        mass: Some("m_g"),
        centre: Centre::Free(Triple {
            symbol: "r_{Gc/G}",
            name: "r_gc_g",
            names: ["r_gc_g_gx", "r_gc_g_gy", "r_gc_g_gz"],
        }),
        inertia: Inertia::Full("i_g"),
        letters: ["G", "Gc"],
        equations: equations::OUTER_GIMBAL,
    },
    assembly: "d",
};

/// From the gimbal to the wheel.
pub(super) const ARM: Triple =
    Triple { symbol: "Lᵍ", name: "l_g", names: ["l_g_x", "l_g_y", "l_g_z"] };
