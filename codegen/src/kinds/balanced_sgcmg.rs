//! The single-gimbal control moment gyro whose wheel has no imbalance; its gimbal has.

use super::Kind;
use super::vscmg::{ARM, GIMBAL};
use super::wheel::{WheelAssembly, balanced};

/// The wheel's angle enters no equation.
pub const BALANCED_SGCMG: Kind = Kind {
    name: "balanced_sgcmg",
    title: "single-gimbal control moment gyro with a balanced wheel",
    source: "codegen/src/kinds/balanced_sgcmg.rs",
    links: &[GIMBAL, balanced(ARM, ["g_x", "g_y", "g_z"], WheelAssembly::Wheel).prescribed()],
};
