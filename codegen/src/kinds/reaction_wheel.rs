//! The reaction wheel: a wheel on the hub.

use super::wheel::{WheelAssembly, imbalanced};
use super::{Kind, Triple};

/// `W = Rx(theta)`: the wheel of the DGVSCMG, with both gimbals locked at zero and without mass.
pub const REACTION_WHEEL: Kind = Kind {
    name: "reaction_wheel",
    title: "reaction wheel",
    source: "codegen/src/kinds/reaction_wheel.rs",
    links: &[imbalanced(ORIGIN, ["b_x", "w_y", "w_z"], WheelAssembly::Device)],
};

/// Where the wheel is in the hub.
pub(super) const ORIGIN: Triple =
    Triple { symbol: "r_{W/B}", name: "r_w_b", names: ["r_w_b_bx", "r_w_b_by", "r_w_b_bz"] };
