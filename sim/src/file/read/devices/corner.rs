//! [`Corner`]: a corner frequency f and a damping ratio zeta of a joint, instead of stiffness and damping, and the springs of
//! devices that have them.
//!
//! ```text
//! k = J (2 pi f)²,   c = 2 zeta J 2 pi f
//! ```
//!
//! with J what the joint moves where its base is fixed and every other joint held, at the initial coordinates: of a turn the moment
//! of inertia, about its axis, of all bodies outboard of it, also of devices that stand on a panel; of a slide their mass. It is
//! twice the kinetic energy at a unit rate of the joint.

use std::f64::consts::TAU;

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::{BuiltIn, Hub, JointStates, Passive, State};

use super::arrangement::HUB;
use super::device::{Device, DeviceOrPlatform};
use super::rows::set_on;
use crate::file::keys::Keys;
use crate::scenario::{Set, joint_key};
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

/// Springs and dampers of the joints of devices that have a corner frequency.
pub(super) fn springs_of_devices(keys: &Keys<'_>, arranged: &mut [Device]) {
    for index in 0..arranged.len() {
        let Some(of) = arranged.get(index..).and_then(|rest| with_springs(keys, rest)) else {
            continue;
        };
        if let Some(device) = arranged.get_mut(index) {
            device.of = DeviceOrPlatform::BuiltIn(Box::new(of));
        }
    }
}

/// The first device with its springs; none of one without corner frequencies, or where what is wrong with it is an error.
fn with_springs(keys: &Keys<'_>, rest: &[Device]) -> Option<BuiltIn> {
    let (device, after) = rest.split_first()?;
    let own = device.built_in().filter(|_| device.corners.iter().any(Option::is_some))?;
    // What stands on it, and on that, follows it.
    let mut names = vec![device.name.as_str()];
    for of in after {
        if !names.contains(&of.on.as_str()) {
            break;
        }
        names.push(&of.name);
    }
    let all: Vec<&Device> = rest.iter().take(names.len()).collect();
    // What the solver rejects is reported with the whole, by its own key.
    let hub = Hub { m_b: 1.0, r_bc_b: Vector3::zeros(), i_b_bc: Matrix3::identity() };
    let spacecraft = precess_craft::spacecraft(&hub, &set_on(HUB, all.iter().copied())).ok()?;
    let mut at_rest: State<Set> = State::at_rest_for(&spacecraft);
    let given = all.iter().flat_map(|device| device.state.iter());
    for ([own, _], [coordinate, _]) in at_rest.devices.states_mut().zip(given) {
        *own = *coordinate;
    }
    let mut parameters = own.parameters();
    let springs = parameters.passive.iter_mut().zip(&device.corners).enumerate();
    for (joint, (passive, corner)) in springs {
        let Some(corner) = corner else { continue };
        let mut state = at_rest.clone();
        if let Some([_, rate]) = state.devices.states_mut().nth(joint) {
            *rate = 1.0;
        }
        let size = 2.0 * spacecraft.energy(&state).ok()?;
        if size <= 0.0 {
            let body = device.joints().get(joint).map(joint_key).unwrap_or_default();
            let message = format!(
                "`device.{}.{body}` has a corner frequency, and nothing outboard of it has inertia",
                device.name
            );
            let help = "give `stiffness` and `damping`";
            keys.reports().borrow_mut().error_anywhere(message, help);
            return None;
        }
        corner.act(passive, size);
    }
    BuiltIn::new(own.kind(), &parameters).ok()
}
