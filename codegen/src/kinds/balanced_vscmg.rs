//! The variable-speed control moment gyro whose wheel has no imbalance; its gimbal has.

use super::Kind;
use super::vscmg::{ARM, GIMBAL};
use super::wheel::{WheelAssembly, balanced};

/// The wheel's angle enters no equation.
pub const BALANCED_VSCMG: Kind = Kind {
    name: "balanced_vscmg",
    title: "variable-speed control moment gyro with a balanced wheel",
    source: "codegen/src/kinds/balanced_vscmg.rs",
    links: &[GIMBAL, balanced(ARM, ["g_x", "g_y", "g_z"], WheelAssembly::Wheel)],
};
