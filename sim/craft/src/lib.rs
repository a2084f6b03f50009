//! The solver over the set of a scenario: devices of any kind, platforms that carry some, a rigid hub or a flexible structure.
//!
//! A crate of its own, because its generic code takes minutes to compile: here once, and not again with every
//! change of the desktop tool and with its unit tests. In the profiles of development, compiled with `opt-level`
//! 1, the compiler takes from here what is instantiated here.
//!
//! | file | what |
//! |---|---|
//! | `craft` | [`Craft`]: a flexible structure, or a rigid hub as one without modes |
//! | `derivatives` | derivatives by state, inputs and parameters |
//! | `steering` | [`SteeringDevices`]: the steering terms of devices on the hub |
//! | `tangent` | the set over dual numbers |

mod craft;
mod derivatives;
mod steering;
pub mod tangent;

use precess_dynamics::{
    BuiltIn, DeviceSet, Hub, Isolated, ListedModes, Modes, ModesError, OnPanel, ParameterError,
    Spacecraft, Wrench, platform, set,
};

pub use craft::{
    Craft, CraftAccelerations, CraftInputs, CraftLinearization, CraftState, FlexibleCraft,
    Structure, rigid_state,
};
pub use derivatives::{
    accelerations_along, derivatives, jvp, linearize, linearize_into, linearize_rigid,
    linearize_step, parameter_derivatives, step_along, step_parameter_derivatives, vjp,
};
pub use steering::{SteeringDevices, SteeringSums};

/// What stands on a platform: devices, and platforms that carry devices only.
pub type Carried = (Vec<BuiltIn>, Vec<Isolated<Vec<BuiltIn>>>);

/// A panel with the devices on it: the third of a row.
pub type ThirdPanel = OnPanel<Vec<BuiltIn>>;

/// A panel with the devices on it, and third panels with theirs.
pub type SecondPanel = OnPanel<(Vec<BuiltIn>, Vec<ThirdPanel>)>;

/// A panel on the hub with the devices on it, and second panels with what stands on them.
pub type FirstPanel = OnPanel<(Vec<BuiltIn>, Vec<SecondPanel>)>;

/// The set that is run: devices on the hub, each of any kind, platforms with what stands on them, and panels with what
/// stands on them.
pub type Set = (Vec<BuiltIn>, Vec<Isolated<Carried>>, Vec<FirstPanel>);

/// A value for each member that stands on a carrier, which carries devices only where it is carried itself.
pub type OfCarried<T> = (Vec<T>, Vec<platform::Data<T, Vec<T>>>);

/// A value for each member of a row of panels.
pub type OfRow<T> = platform::Data<T, (Vec<T>, Vec<platform::Data<T, OfCarried<T>>>)>;

/// A value for each member of the set.
pub type OfMembers<T> = (Vec<T>, Vec<platform::Data<T, OfCarried<T>>>, Vec<OfRow<T>>);

/// A wrench on the child body of each joint.
pub type BodyWrenches = <Set as DeviceSet>::Per<set::PerJoint<Wrench>>;

/// The spacecraft, prepared for evaluation.
///
/// # Errors
///
/// As [`Spacecraft::new`].
pub fn spacecraft(hub: &Hub, devices: &Set) -> Result<Spacecraft<Set>, ParameterError> {
    Spacecraft::new(hub, devices)
}

/// The flexible structure, each device on one of its mounts.
///
/// # Errors
///
/// As [`Spacecraft::flexible_with_residual`].
pub fn flexible(
    hub: &Hub,
    modes: &Modes<ListedModes>,
    residual: usize,
    devices: &Set,
    on: &OfMembers<usize>,
) -> Result<FlexibleCraft, ModesError> {
    Spacecraft::flexible_with_residual(hub, modes, residual, devices, on)
}
