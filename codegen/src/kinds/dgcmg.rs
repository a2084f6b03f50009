//! The double-gimbal control moment gyro: two gimbals and a wheel at constant speed.

use super::Kind;
use super::dgvscmg::{ARM, INNER_GIMBAL, OUTER_GIMBAL};
use super::wheel::{WheelAssembly, imbalanced};

/// The DGVSCMG with its wheel's acceleration prescribed: zero.
pub const DGCMG: Kind = Kind {
    name: "dgcmg",
    title: "double-gimbal control moment gyro",
    source: "codegen/src/kinds/dgcmg.rs",
    links: &[
        OUTER_GIMBAL,
        INNER_GIMBAL,
        imbalanced(ARM, ["s_x", "w_y", "w_z"], WheelAssembly::Wheel).prescribed(),
    ],
};
