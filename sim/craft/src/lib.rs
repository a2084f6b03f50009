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
//! | `tangent` | the set over dual numbers |

mod craft;
mod derivatives;
pub mod tangent;

use precess_dynamics::{
    BuiltIn, DeviceSet, Hub, Isolated, ListedModes, Modes, ModesError, ParameterError, Spacecraft,
    Wrench, platform, set,
};

pub use craft::{
    Craft, CraftAccelerations, CraftInputs, CraftState, FlexibleCraft, Structure, rigid_state,
};
pub use derivatives::{
    derivatives, linearize, linearize_rigid, linearize_step, parameter_derivatives,
    step_parameter_derivatives,
};

/// What stands on a platform: devices, and platforms that carry devices only.
pub type Carried = (Vec<BuiltIn>, Vec<Isolated<Vec<BuiltIn>>>);

/// The set that is run: devices on the hub, each of any kind, and platforms with what stands on them.
pub type Set = (Vec<BuiltIn>, Vec<Isolated<Carried>>);

/// A value for each member that stands on a platform.
pub type OfCarried<T> = (Vec<T>, Vec<platform::Data<T, Vec<T>>>);

/// A value for each member of the set.
pub type OfMembers<T> = (Vec<T>, Vec<platform::Data<T, OfCarried<T>>>);

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
