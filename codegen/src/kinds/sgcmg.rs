//! The single-gimbal control moment gyro: a gimbal and a wheel at constant speed.

use super::Kind;
use super::vscmg::{ARM, GIMBAL};
use super::wheel::{WheelAssembly, imbalanced};

/// The VSCMG with its wheel's acceleration prescribed: zero.
pub const SGCMG: Kind = Kind {
    name: "sgcmg",
    title: "single-gimbal control moment gyro",
    source: "codegen/src/kinds/sgcmg.rs",
    links: &[GIMBAL, imbalanced(ARM, ["g_x", "w_y", "w_z"], WheelAssembly::Wheel).prescribed()],
};
