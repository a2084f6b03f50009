//! [`Corner`]: a corner frequency f and a damping ratio zeta of a joint, instead of stiffness and damping.
//!
//! ```text
//! k = J (2 pi f)²,   c = 2 zeta J 2 pi f
//! ```

use std::f64::consts::TAU;

use precess_dynamics::Passive;

use crate::file::keys::Keys;
use crate::units::{Measure, Plain};

/// What a joint's spring is given by.
#[derive(Clone, Copy, Debug)]
pub(in crate::file::read) struct Corner {
    /// Hz.
    pub(super) frequency: f64,
    pub(super) ratio: f64,
}

impl Corner {
    /// Writes stiffness and damping for a mass or a moment of inertia.
    pub(super) fn act(self, passive: &mut Passive, size: f64) {
        let omega = TAU * self.frequency;
        passive.stiffness = size * omega * omega;
        passive.viscous = 2.0 * self.ratio * size * omega;
    }
}

/// `corner_frequency` and `damping_ratio`; nothing where they are wrong, which has been reported.
#[expect(clippy::option_option, reason = "wrong, none, some")]
pub(super) fn corner(keys: &Keys<'_>) -> Option<Option<Corner>> {
    let frequency = keys.quantity("corner_frequency", Measure::FREQUENCY);
    let ratio = keys.number("damping_ratio");
    if !keys.has("corner_frequency") {
        if keys.has("damping_ratio") {
            let message = "a damping ratio is of a corner frequency";
            keys.error("damping_ratio", message, "give `corner_frequency`, or `damping` instead");
            return None;
        }
        return Some(None);
    }
    for (key, other) in [("stiffness", "corner_frequency"), ("damping", "damping_ratio")] {
        if keys.has(key) {
            let message = format!("`{}` has `{key}` and `corner_frequency`", keys.path());
            let help = format!("keep `{key}`, or `corner_frequency` with `damping_ratio`");
            keys.error(if keys.has(other) { other } else { "corner_frequency" }, message, &help);
            return None;
        }
    }
    let (frequency, ratio) = (frequency?, ratio.unwrap_or(0.0));
    for (key, value) in [("corner_frequency", frequency), ("damping_ratio", ratio)] {
        if !(value >= 0.0 && value.is_finite()) {
            let message = format!("`{}.{key}` is {}", keys.path(), Plain(value));
            keys.error(key, message, "it is not negative");
            return None;
        }
    }
    Some(Some(Corner { frequency, ratio }))
}
