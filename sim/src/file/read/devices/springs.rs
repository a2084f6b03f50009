//! [`springs_of_devices`]: springs and dampers of devices whose joints have a [`Corner`](super::corner::Corner).
//!
//! Its J is what the joint moves where its base is fixed and every other joint held, at the initial coordinates: of a turn the
//! moment of inertia, about its axis, of all bodies outboard of it, also of devices that stand on a panel; of a slide their mass.
//! It is twice the kinetic energy at a unit rate of the joint.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::{BuiltIn, Hub, JointStates, State};

use super::arrangement::HUB;
use super::device::{Device, DeviceOrPlatform};
use super::rows::set_on;
use crate::file::keys::Keys;
use crate::scenario::{Set, joint_key};

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
