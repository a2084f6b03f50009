//! [`Carrier`]: a device whose last body can carry a set of devices, which a [`Platform`] and a
//! [`CarryingPanel`](crate::CarryingPanel) are.
//!
//! What the elimination, the loads and the momenta of a [`Carrying`](crate::Carrying) set need of its
//! carrier: where it stands, how it moves, how its joints are eliminated, what couples them.

use core::fmt::Debug;
use core::ops::Deref;

use crate::equations::assembly::Assembly;
use crate::equations::device::Device;
use crate::equations::suspension_forces::{Forces, Six};
use crate::generated::hub::BodyAcceleration;
use crate::isolation::checks::check_suspension;
use crate::isolation::elimination::eliminate;
use crate::isolation::kernels::Constants;
use crate::isolation::motion::{Motion, Moving, Spatial};
use crate::isolation::parameters::Platform;
use crate::isolation::records::{JointAccelerations, PerJoint};
use crate::isolation::suspension::{Coupled, Strut, Suspension};
use crate::model::kind::Kind;
use crate::model::mode::Drive;
use crate::numbers::real::Scalar;
use crate::numbers::vec3::Vec3;
use crate::sets::with_numbers::WithNumbers;
use crate::validation::parameter_error::ParameterError;

/// The suspension of a carrier in other numbers.
type SuspensionOver<C, U> = <<C as Carrier>::Over<U> as Carrier>::Suspension;

/// A carrier in other numbers, precomputed, with its suspension.
type PreparedOver<C, U> = (Device<<C as Carrier>::Over<U>>, SuspensionOver<C, U>);

/// A device whose last body can carry a set of devices.
///
/// Implemented for [`Platform`] and [`CarryingPanel`](crate::CarryingPanel), by hand.
pub trait Carrier: Kind {
    /// Springs and dampers that couple its joints; `()` where there are none.
    type Suspension: Copy + Debug + PartialEq + 'static;
    /// The same carrier with parameters of other numbers.
    type Over<U: Scalar>: Carrier<Scalar = U>;
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

    /// Parameters in other numbers.
    #[doc(hidden)]
    fn over<U: Scalar>(
        &self,
        suspension: &Self::Suspension,
        number: impl Fn(Self::Scalar) -> U + Copy,
    ) -> (Self::Over<U>, SuspensionOver<Self, U>);
    /// The same, precomputed.
    #[doc(hidden)]
    fn device_over<U: Scalar>(
        device: &Device<Self>,
        suspension: &Self::Suspension,
        number: impl Fn(Self::Scalar) -> U + Copy,
    ) -> PreparedOver<Self, U>;
}

impl<T: Scalar> Carrier for Platform<T> {
    type Suspension = Suspension<T>;
    type Over<U: Scalar> = Platform<U>;
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

    fn diagonals(suspension: &Suspension<T>, pose: Option<&Self::Pose<T>>) -> [Six<T>; 2] {
        suspension.diagonals(pose)
    }

    fn check_suspension(
        device: usize,
        suspension: &Suspension<T>,
    ) -> Result<(), ParameterError<T>> {
        check_suspension(device, suspension)
    }

    fn over<U: Scalar>(
        &self,
        suspension: &Suspension<T>,
        number: impl Fn(T) -> U + Copy,
    ) -> (Platform<U>, Suspension<U>) {
        (self.with_numbers(number), suspension.map(number))
    }

    fn device_over<U: Scalar>(
        device: &Device<Self>,
        suspension: &Suspension<T>,
        number: impl Fn(T) -> U + Copy,
    ) -> (Device<Platform<U>>, Suspension<U>) {
        (Self::convert(device, number), suspension.map(number))
    }
}

impl<T: Scalar> Suspension<T> {
    /// Each number converted.
    fn map<U: Scalar>(&self, number: impl Fn(T) -> U + Copy) -> Suspension<U> {
        let coupled = self.coupled.map(|of| Coupled {
            stiffness: of.stiffness.map(number),
            rest: of.rest.map(number),
            damping: of.damping.map(number),
        });
        let strut = |of: Strut<T>| Strut {
            position: of.position.map(number),
            direction: of.direction.map(number),
            length: number(of.length),
            stiffness: number(of.stiffness),
            damping: number(of.damping),
        };
        Suspension { coupled, struts: self.struts.map(|of| of.map(strut)) }
    }
}
