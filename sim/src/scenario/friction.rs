//! [`JointFriction`]: dry friction that sticks, and quadratic drag, of a joint.
//!
//! ```text
//! u = -sign(q') (u_c + (u_s - u_c) exp(-(q' / q_s')²)) - c_2 |q'| q'     while the joint slides
//! |u| <= u_s                                                            while it sticks: q' = 0
//! ```
//!
//! It acts in runs of the desktop's integrators, beside spring, damper and smoothed Coulomb friction of
//! [`Passive`](precess_dynamics::Passive). What evaluates the spacecraft otherwise rejects a scenario that has it.

use precess_dynamics::kind::JointInfo;

use super::check::range;
use super::{Scenario, ScenarioError, joint_key};
use crate::units::Plain;

/// Friction of a joint that sticks, and quadratic drag.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointFriction {
    /// The joint.
    pub joint: usize,
    /// Dry friction that sticks; none where there is none.
    pub dry: Option<DryFriction>,
    /// Quadratic drag `c_2`, N m s²/rad² or N s²/m². Not negative.
    pub drag: f64,
}

/// Dry friction that sticks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DryFriction {
    /// Static friction `u_s`, the most with which it sticks, N m or N. Not below `coulomb`.
    pub static_friction: f64,
    /// Coulomb friction `u_c`, that of fast sliding, N m or N. Not negative.
    pub coulomb: f64,
    /// Stribeck's rate `q_s'`, about which sliding friction falls from `u_s` to `u_c`, rad/s or m/s; zero where
    /// it is `u_c` at any rate.
    pub stribeck_rate: f64,
}

impl JointFriction {
    /// Torque or force while the joint slides with this sign of its rate, N m or N.
    pub(crate) fn sliding(&self, rate: f64, sign: f64) -> f64 {
        let dry = self.dry.map_or(0.0, |dry| sign * dry.size(rate));
        -(dry + self.drag * rate.abs() * rate)
    }

    /// Whether it varies with the rate.
    pub(crate) fn varies(&self) -> bool {
        self.drag != 0.0 || self.dry.is_some_and(|dry| dry.stribeck_rate != 0.0)
    }
}

impl DryFriction {
    /// Of sliding at a rate.
    fn size(&self, rate: f64) -> f64 {
        if self.stribeck_rate == 0.0 {
            return self.coulomb;
        }
        let share = rate / self.stribeck_rate;
        self.coulomb + (self.static_friction - self.coulomb) * (-(share * share)).exp()
    }
}

impl Scenario {
    /// Friction that sticks and quadratic drag of a joint.
    pub(crate) fn friction_of(&self, joint: usize) -> Option<&JointFriction> {
        self.friction.iter().find(|of| of.joint == joint)
    }

    /// The first joint with friction that sticks or quadratic drag, by the name of its coordinate.
    #[must_use]
    pub fn first_friction(&self) -> Option<String> {
        let of = self.friction.first()?;
        let (_, name, info) = self.joints().nth(of.joint)?;
        Some(format!("{name}.{}", info.coordinate))
    }

    pub(super) fn check_friction(&self) -> Vec<ScenarioError> {
        let joints: Vec<_> = self.joints().collect();
        let tables: Vec<_> =
            self.members().map(|(_, member)| member.platform().is_some()).collect();
        let mut errors = Vec::new();
        for of in &self.friction {
            let Some((member, name, info)) = joints.get(of.joint) else {
                let (joint, count) = (of.joint, joints.len());
                errors.push(range("friction", format!("joint {joint} of {count}")));
                continue;
            };
            let passive = self.members().nth(*member).map(|(_, member)| member.passive());
            let passive = passive.and_then(|all| all.get(info.index).copied());
            let platform = tables.get(*member).copied().unwrap_or(false);
            let table = if platform { "platform" } else { "device" };
            let path = format!("{table}.{name}.{}", joint_key(info));
            if of.dry.is_some() && passive.is_some_and(|passive| passive.coulomb != 0.0) {
                let message = "the joint has smoothed Coulomb friction, too; remove one of the two";
                errors.push(range(&format!("{path}.static_friction"), message.to_owned()));
            }
            errors.extend(
                of.faults(info)
                    .into_iter()
                    .map(|(key, message)| range(&format!("{path}.{key}"), message)),
            );
        }
        errors
    }
}

impl JointFriction {
    /// Keys with what is wrong with their values.
    fn faults(&self, info: &JointInfo) -> Vec<(&'static str, String)> {
        let [torque, rate, drag] =
            if info.slides { ["N", "m/s", "N s^2/m^2"] } else { ["N m", "rad/s", "N m s^2/rad^2"] };
        let dry = self.dry.unwrap_or(DryFriction {
            static_friction: 0.0,
            coulomb: 0.0,
            stribeck_rate: 0.0,
        });
        let mut faults = Vec::new();
        for (key, value, unit) in [
            ("coulomb", dry.coulomb, torque),
            ("static_friction", dry.static_friction, torque),
            ("stribeck_rate", dry.stribeck_rate, rate),
            ("quadratic_drag", self.drag, drag),
        ] {
            if !(value >= 0.0 && value.is_finite()) {
                faults.push((key, format!("{} {unit}; it is not negative", Plain(value))));
            }
        }
        if dry.static_friction < dry.coulomb {
            let [most, coulomb] = [dry.static_friction, dry.coulomb].map(Plain);
            let message = format!(
                "{most} {torque} is below the Coulomb friction of {coulomb} {torque}: what slides would not stick; \
                 exchange them, or correct one"
            );
            faults.push(("static_friction", message));
        }
        faults
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sliding_friction_falls_from_static_to_coulomb_and_drag_grows() {
        let dry = DryFriction { static_friction: 3.0, coulomb: 2.0, stribeck_rate: 0.5 };
        let of = JointFriction { joint: 0, dry: Some(dry), drag: 0.0 };
        assert_eq!((of.sliding(0.0, 1.0), of.sliding(0.0, -1.0)), (-3.0, 3.0));
        assert!((of.sliding(0.5, 1.0) + 2.0 + (-1.0_f64).exp()).abs() < 1e-15);
        assert!((of.sliding(-5.0, -1.0) - 2.0).abs() < 1e-15);
        assert!(of.varies());
        let plain = DryFriction { stribeck_rate: 0.0, ..dry };
        let of = JointFriction { dry: Some(plain), ..of };
        assert_eq!((of.sliding(1e-9, 1.0), of.varies()), (-2.0, false));
        let drag = JointFriction { joint: 0, dry: None, drag: 0.25 };
        assert_eq!((drag.sliding(-4.0, -1.0), drag.sliding(4.0, 1.0)), (4.0, -4.0));
    }
}
