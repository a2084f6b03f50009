//! The double-gimbal variable-speed control moment gyro: outer gimbal, inner gimbal, wheel.

use super::{Body, Centre, Equations, Joint, Kind, Link, Triple};
use crate::space::Axis;

/// `Go = Rz(gamma_o)`, `Gi = Go Ry(gamma_i)`, `W = Gi Rx(theta)`; the wheel's centre of mass lies
/// on `w_y`, a distance d from the spin axis.
pub const DGVSCMG: Kind = Kind {
    name: "dgvscmg",
    title: "double-gimbal variable-speed control moment gyro",
    source: "codegen/src/kinds/dgvscmg.rs",
    links: &[
        Link {
            joint: Joint {
                tag: "o",
                axis: Axis::Z,
                angle: "gamma_o",
                rate: "gamma_o_dot",
                acceleration: "gamma_o_ddot",
                symbols: ["ᵒγ̇", "ᵒγ̈"],
                torque: "u_o",
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
                mass: "m_go",
                centre: Centre::Free(Triple {
                    symbol: "r_{Gᵒc/Gᵒ}",
                    name: "r_goc_go",
                    names: ["r_goc_go_gox", "r_goc_go_goy", "r_goc_go_goz"],
                }),
                inertia: "i_go",
                letters: ["Gᵒ", "Gᵒc"],
                equations: Equations {
                    omega: "(31)",
                    r_dprime: "(12)",
                    i_prime: "(36)",
                    i_b: "(40)",
                    i_b_prime: "(42)",
                    torque: "(80)",
                },
            },
            assembly: "d",
        },
        Link {
            joint: Joint {
                tag: "i",
                axis: Axis::Y,
                angle: "gamma_i",
                rate: "gamma_i_dot",
                acceleration: "gamma_i_ddot",
                symbols: ["ⁱγ̇", "ⁱγ̈"],
                torque: "u_i",
                origin: Triple { symbol: "Lᵒ", name: "l_o", names: ["l_o_x", "l_o_y", "l_o_z"] },
            },
            body: Body {
                title: "inner gimbal",
                frame: "gi",
                origin: "gi",
                triad: ["s_x", "s_y", "g_z"],
                point: "gic",
                mass: "m_gi",
                centre: Centre::Free(Triple {
                    symbol: "r_{Gⁱc/Gⁱ}",
                    name: "r_gic_gi",
                    names: ["r_gic_gi_gix", "r_gic_gi_giy", "r_gic_gi_giz"],
                }),
                inertia: "i_gi",
                letters: ["Gⁱ", "Gⁱc"],
                equations: Equations {
                    omega: "(44)",
                    r_dprime: "(13)",
                    i_prime: "(49)-(52)",
                    i_b: "(55)",
                    i_b_prime: "(57)",
                    torque: "(101)",
                },
            },
            assembly: "v",
        },
        Link {
            joint: Joint {
                tag: "w",
                axis: Axis::X,
                angle: "theta",
                rate: "spin",
                acceleration: "spin_dot",
                symbols: ["Ω", "Ω̇"],
                torque: "u_w",
                origin: Triple { symbol: "Lⁱ", name: "l_i", names: ["l_i_x", "l_i_y", "l_i_z"] },
            },
            body: Body {
                title: "wheel",
                frame: "w",
                origin: "w",
                triad: ["s_x", "w_y", "w_z"],
                point: "wc",
                mass: "m_w",
                centre: Centre::On(Axis::Y, "d"),
                inertia: "j",
                letters: ["W", "Wc"],
                equations: Equations {
                    omega: "(59)",
                    r_dprime: "(14)",
                    i_prime: "(64)",
                    i_b: "(71)",
                    i_b_prime: "(73)",
                    torque: "(119)",
                },
            },
            assembly: "w",
        },
    ],
};
