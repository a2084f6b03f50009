//! [`Kernels`]: the emitted kernels of one kind, over any number. Implemented by the emitted text.
//!
//! Pure arithmetic over [`Real`]: what compares, takes a root or finds an error is in
//! [`Kind`](crate::model::kind::Kind), for single numbers. Lanes of numbers run only what is here.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use core::fmt::Debug;

use crate::generated::hub::{BodyAcceleration, BodyRate, HubShare};
use crate::model::mode::Drive;
use crate::model::wrench::{Carried, Wrench};
use crate::numbers::each::{Each, JointStates, Value};
use crate::numbers::real::{Angle, Real};

/// The kernels of a device kind, and their records for numbers of any type.
///
/// Implemented by emitted text, next to each kernel; written by hand for nothing. Every function is
/// part of what calls it: lanes reach the wide instructions of their caller only so.
pub trait Kernels: 'static {
    /// What depends only on parameters.
    type Constants<T: Value>: Copy + Debug + Send + Sync;
    /// Coordinates and rates.
    type Joints<T: Value>: JointStates<T> + Copy;
    /// Joint accelerations.
    type Accelerations<T: Value>: Each<T> + Copy;
    /// A value per joint.
    type PerJoint<V: Value>: Each<V> + Copy;
    /// Sines, cosines and lengths.
    type Pose<T: Value>: Copy;
    /// What is left of a device once its joints are eliminated.
    type Eliminated<T: Value>: Copy + Debug;
    /// How the joints follow the hub: what back substitution needs.
    type Gains<T: Value>: Copy + Debug + Send + Sync;

    /// Sines, cosines and lengths of the joints.
    #[inline(always)]
    fn pose<T: Angle>(joints: &Self::Joints<T>) -> Self::Pose<T> {
        Self::pose_by(
            joints,
            #[inline(always)]
            |_, angle| angle.sin_cos(),
        )
    }
    /// The same, sine and cosine found by a function of the joint's number and of its angle.
    fn pose_by<T: Value>(
        joints: &Self::Joints<T>,
        sin_cos: impl FnMut(usize, T) -> (T, T),
    ) -> Self::Pose<T>;
    /// The emitted `eliminate`.
    fn eliminate<T: Real>(
        constants: &Self::Constants<T>,
        pose: &Self::Pose<T>,
        joints: &Self::Joints<T>,
        omega: &BodyRate<T>,
        drives: &Self::PerJoint<Drive<T>>,
    ) -> Self::Eliminated<T>;
    /// The share of the hub's equations.
    fn share<T: Real>(eliminated: &Self::Eliminated<T>) -> &HubShare<T>;
    /// How the joints follow the hub.
    fn gains<T: Real>(eliminated: &Self::Eliminated<T>) -> &Self::Gains<T>;
    /// Pivot and diagonal of each driven joint; none of the others.
    fn pivots<T: Real>(eliminated: &Self::Eliminated<T>) -> Self::PerJoint<Option<[T; 2]>>;
    /// The emitted `back_substitute`.
    fn back_substitute<T: Real>(
        gains: &Self::Gains<T>,
        hub: &BodyAcceleration<T>,
    ) -> Self::Accelerations<T>;
    /// What coordinates and rates change by: rates and accelerations.
    fn slope<T: Value>(
        joints: &Self::Joints<T>,
        accelerations: &Self::Accelerations<T>,
    ) -> Self::Joints<T>;

    /// The emitted `load_derivatives`, column by column; none of a kind that has none: a platform.
    #[inline(always)]
    fn load_derivatives<T: Real>(
        _constants: &Self::Constants<T>,
        _pose: &Self::Pose<T>,
        _joints: &Self::Joints<T>,
        _omega: &BodyRate<T>,
        _hub: &BodyAcceleration<T>,
        _accelerations: &Self::Accelerations<T>,
    ) -> Option<LoadDerivatives<Self, T>> {
        None
    }

    /// The emitted `external`: wrenches on the bodies, summed inwards.
    fn external<T: Real>(
        constants: &Self::Constants<T>,
        pose: &Self::Pose<T>,
        bodies: &Self::PerJoint<Wrench<T>>,
    ) -> Carried<Self::PerJoint<Wrench<T>>, Wrench<T>>;
    /// The emitted `gravity`: the wrench on each body in the linear field, and the device's second
    /// moment about B, entries 11, 12, 13, 22, 23, 33.
    fn gravity<T: Real>(
        constants: &Self::Constants<T>,
        pose: &Self::Pose<T>,
        gradient: [T; 6],
    ) -> (Self::PerJoint<Wrench<T>>, [T; 6]);

    /// Constants joined number by number.
    fn zip_constants<T: Value, U: Value, W: Value>(
        a: &Self::Constants<T>,
        b: &Self::Constants<U>,
        join: impl FnMut(T, U) -> W,
    ) -> Self::Constants<W>;
    /// Coordinates and rates joined number by number.
    fn zip_joints<T: Value, U: Value, W: Value>(
        a: &Self::Joints<T>,
        b: &Self::Joints<U>,
        join: impl FnMut(T, U) -> W,
    ) -> Self::Joints<W>;
    /// Gains joined number by number.
    fn zip_gains<T: Value, U: Value, W: Value>(
        a: &Self::Gains<T>,
        b: &Self::Gains<U>,
        join: impl FnMut(T, U) -> W,
    ) -> Self::Gains<W>;
    /// Accelerations joined number by number.
    fn zip_accelerations<T: Value, U: Value, W: Value>(
        a: &Self::Accelerations<T>,
        b: &Self::Accelerations<U>,
        join: impl FnMut(T, U) -> W,
    ) -> Self::Accelerations<W>;
    /// Values of the joints joined one by one.
    fn zip_per_joint<T: Value, U: Value, W: Value>(
        a: &Self::PerJoint<T>,
        b: &Self::PerJoint<U>,
        join: impl FnMut(T, U) -> W,
    ) -> Self::PerJoint<W>;
}

/// Derivatives of the loads of a device by one variable: of what each motor exerts, and of what the hub exerts,
/// about B, along the device's axes.
pub type LoadColumn<K, T> = Carried<<K as Kernels>::PerJoint<T>, Wrench<T>>;

/// Derivatives of the loads of a device.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoadDerivatives<K: Kernels + ?Sized, T: Value> {
    /// By each joint's coordinate.
    pub coordinates: K::PerJoint<LoadColumn<K, T>>,
    /// By each joint's rate.
    pub rates: K::PerJoint<LoadColumn<K, T>>,
    /// By each joint's acceleration: columns of the mass matrix.
    pub accelerations: K::PerJoint<LoadColumn<K, T>>,
    /// By the hub's angular velocity, along the device's axes.
    pub omega: [LoadColumn<K, T>; 3],
    /// By the hub's angular acceleration, along the device's axes.
    pub omega_dot: [LoadColumn<K, T>; 3],
}
