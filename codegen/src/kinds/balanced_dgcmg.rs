//! The double-gimbal control moment gyro whose wheel has no imbalance; its gimbals have.

use super::Kind;
use super::dgvscmg::{ARM, INNER_GIMBAL, OUTER_GIMBAL};
use super::wheel::{WheelAssembly, balanced};

/// The wheel's angle enters no equation.
pub const BALANCED_DGCMG: Kind = Kind {
    name: "balanced_dgcmg",
    title: "double-gimbal control moment gyro with a balanced wheel",
    source: "codegen/src/kinds/balanced_dgcmg.rs",
    links: &[
        OUTER_GIMBAL,
        INNER_GIMBAL,
        balanced(ARM, ["s_x", "s_y", "g_z"], WheelAssembly::Wheel).prescribed(),
    ],
};
