//! [`Carrier`]: a device whose last body can carry a set of devices, which a [`Platform`] and a
//! [`CarryingPanel`](crate::CarryingPanel) are.
//!
//! What the elimination, the loads and the momenta of a [`Carrying`](crate::Carrying) set need of its
//! carrier: where it stands, how it moves, how its joints are eliminated, what couples them.

use core::fmt::Debug;
use core::ops::Deref;

use crate::equations::assembly::Assembly;
use crate::equations::suspension_forces::{Forces, Six};
use crate::generated::hub::BodyAcceleration;
use crate::isolation::checks::check_suspension;
use crate::isolation::elimination::eliminate;
use crate::isolation::kernels::Constants;
use crate::isolation::motion::{Motion, Moving, Spatial};
use crate::isolation::parameters::Platform;
use crate::isolation::records::{JointAccelerations, PerJoint};
use crate::isolation::suspension::Suspension;
use crate::model::kind::Kind;
use crate::model::mode::Drive;
use crate::numbers::real::Scalar;
use crate::numbers::vec3::Vec3;
use crate::validation::parameter_error::ParameterError;

/// A device whose last body can carry a set of devices.
///
/// Implemented for [`Platform`] and [`CarryingPanel`](crate::CarryingPanel), by hand.
pub trait Carrier: Kind {
    /// Springs and dampers that couple its joints; `()` where there are none.
    type Suspension: Copy + Debug + PartialEq + 'static;
    #[doc(hidden)]
    type Moving: Deref<Target = Motion<Self::Scalar>> + Copy;

    #[doc(hidden)]
    fn base(constants: &Self::Constants<Self::Scalar>) -> &Constants<Self::Scalar>;
    /// The motion on a base that turns, expressed in it.
    #[doc(hidden)]
    fn moving(
        constants: &Self::Constants<Self::Scalar>,
        pose: &Self::Pose<Self::Scalar>,
        joints: &Self::Joints<Self::Scalar>,
        omega: Vec3<Self::Scalar>,
    ) -> Self::Moving;
    /// Its acceleration for those of base and joints, carrier axes.
    #[doc(hidden)]
    fn acceleration(
        moving: &Self::Moving,
        base: Spatial<Self::Scalar>,
        joints: &Self::Accelerations<Self::Scalar>,
    ) -> Spatial<Self::Scalar>;
    /// The directions of its joints' accelerations, carrier axes; zero after the last.
    #[doc(hidden)]
    fn directions(moving: &Self::Moving) -> [Spatial<Self::Scalar>; 6];
    /// Its joints eliminated, with what it carries in the assembly.
    #[doc(hidden)]
    fn eliminate_with(
        moving: &Self::Moving,
        field: Vec3<Self::Scalar>,
        assembly: &Assembly<Self::Scalar>,
        drives: &Self::PerJoint<Drive<Self::Scalar>>,
    ) -> Self::Eliminated<Self::Scalar>;
    /// Accelerations of joints and carrier from those of the base.
    #[doc(hidden)]
    fn outward(
        gains: &Self::Gains<Self::Scalar>,
        base: &BodyAcceleration<Self::Scalar>,
    ) -> (Self::Accelerations<Self::Scalar>, Spatial<Self::Scalar>);
    /// What each pivot is beside, of a mass and an inertia.
    #[doc(hidden)]
    fn scales(
        gains: &Self::Gains<Self::Scalar>,
        mass: Self::Scalar,
        inertia: Self::Scalar,
    ) -> Self::PerJoint<Self::Scalar>;

    /// What couples the joints: forces and energy.
    #[doc(hidden)]
    fn forces(
        suspension: &Self::Suspension,
        pose: &Self::Pose<Self::Scalar>,
        joints: &Self::Joints<Self::Scalar>,
    ) -> Forces<Self::Scalar>;
    /// How these forces change with coordinates and with rates, each by columns.
    #[doc(hidden)]
    fn force_slopes(
        suspension: &Self::Suspension,
        joints: &Self::Joints<Self::Scalar>,
    ) -> [[Six<Self::Scalar>; 6]; 2];
    /// Diagonals, damping and stiffness, that bound it.
    #[doc(hidden)]
    fn diagonals(
        suspension: &Self::Suspension,
        pose: Option<&Self::Pose<Self::Scalar>>,
    ) -> [Six<Self::Scalar>; 2];
    #[doc(hidden)]
    fn check_suspension(
        device: usize,
        suspension: &Self::Suspension,
    ) -> Result<(), ParameterError<Self::Scalar>>;
}

impl<T: Scalar> Carrier for Platform<T> {
    type Suspension = Suspension<T>;
    type Moving = Moving<T, 6>;

    fn base(constants: &Constants<T>) -> &Constants<T> {
        constants
    }

    fn moving(
        constants: &Constants<T>,
        pose: &Self::Pose<T>,
        joints: &Self::Joints<T>,
        omega: Vec3<T>,
    ) -> Moving<T, 6> {
        constants.moving(pose, joints, omega)
    }

    fn acceleration(
        moving: &Moving<T, 6>,
        base: Spatial<T>,
        joints: &JointAccelerations<T>,
    ) -> Spatial<T> {
        moving.acceleration(base, joints.array())
    }

    fn directions(moving: &Moving<T, 6>) -> [Spatial<T>; 6] {
        moving.directions
    }

    fn eliminate_with(
        moving: &Moving<T, 6>,
        field: Vec3<T>,
        assembly: &Assembly<T>,
        drives: &PerJoint<Drive<T>>,
    ) -> Self::Eliminated<T> {
        eliminate(moving, field, assembly, drives.array())
    }

    fn outward(
        gains: &Self::Gains<T>,
        base: &BodyAcceleration<T>,
    ) -> (JointAccelerations<T>, Spatial<T>) {
        let (joints, carrier) = gains.outward(base);
        (JointAccelerations::of(joints), carrier)
    }

    fn scales(gains: &Self::Gains<T>, mass: T, inertia: T) -> PerJoint<T> {
        PerJoint::of(gains.scales(Self::JOINTS, mass, inertia))
    }

    fn forces(
        suspension: &Suspension<T>,
        pose: &Self::Pose<T>,
        joints: &Self::Joints<T>,
    ) -> Forces<T> {
        suspension.forces(pose, joints)
    }

    fn force_slopes(suspension: &Suspension<T>, joints: &Self::Joints<T>) -> [[Six<T>; 6]; 2] {
        suspension.slopes(joints)
    }

    fn diagonals(suspension: &Suspension<T>, pose: Option<&Self::Pose<T>>) -> [Six<T>; 2] {
        suspension.diagonals(pose)
    }

    fn check_suspension(
        device: usize,
        suspension: &Suspension<T>,
    ) -> Result<(), ParameterError<T>> {
        check_suspension(device, suspension)
    }
}
