//! Inputs of an elimination apart from the state of the joints: [`JointInputs`] and
//! [`Environment`].

use crate::equations::gravity::Central;
use crate::equations::mass_reduction::MassReduction;
use crate::model::kind::{Kernels, Kind, Wrenches};
use crate::model::mode::Mode;
use crate::numbers::vec3::Vec3;

/// Motor torques, modes and applied wrenches of the joints of one device or of a set.
#[derive(Debug)]
pub struct JointInputs<'a, Motors, Modes, Wrenches> {
    pub(crate) motors: &'a Motors,
    pub(crate) modes: &'a Modes,
    pub(crate) bodies: Option<&'a Wrenches>,
}

/// Those of one device.
pub(crate) type DeviceInputs<'a, K> = JointInputs<
    'a,
    <K as Kind>::Motors,
    <K as Kernels>::PerJoint<Mode<<K as Kind>::Scalar>>,
    Wrenches<K>,
>;

// Derived, both would require `Copy` members; only references are copied.
impl<Motors, Modes, Wrenches> Clone for JointInputs<'_, Motors, Modes, Wrenches> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<Motors, Modes, Wrenches> Copy for JointInputs<'_, Motors, Modes, Wrenches> {}

/// Motion of the hub and gravity as a device's equations need them, expressed in B.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Environment<T> {
    /// Angular velocity of B.
    pub(crate) omega: Vec3<T>,
    /// The gradient of a central field.
    pub(crate) central: Option<Central<T>>,
    /// Whether velocities jump: then torques are impulses, no other force matters, and rates count
    /// as zero.
    pub(crate) impulse: bool,
    /// With impulses: what is subtracted from the mass matrix, which then has to be positive
    /// definite. Rates are those at which friction is evaluated.
    pub(crate) reduction: Option<MassReduction<T>>,
}
