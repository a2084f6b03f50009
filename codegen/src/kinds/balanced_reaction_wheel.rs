//! The reaction wheel without imbalance.

use super::Kind;
use super::reaction_wheel::ORIGIN;
use super::wheel::{WheelAssembly, balanced};

/// Its angle enters no equation.
pub const BALANCED_REACTION_WHEEL: Kind = Kind {
    name: "balanced_reaction_wheel",
    title: "balanced reaction wheel",
    source: "codegen/src/kinds/balanced_reaction_wheel.rs",
    links: &[balanced(ORIGIN, ["b_x", "b_y", "b_z"], WheelAssembly::Device)],
};
