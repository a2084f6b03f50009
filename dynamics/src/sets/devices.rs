//! [`Devices`]: what a hub carries. One device, an array, a tuple, a list: each is a set, and sets
//! nest.
//!
//! Nothing here knows a kind: a set passes each call on to its members, in order, so that a device
//! costs the same wherever it stands. The set of a spacecraft is known when it is compiled, and
//! every call is direct; only a list of [`AnyDevice`](crate::AnyDevice) asks at run time.

use core::fmt::Debug;

use crate::equations::arithmetic::Rounding;
use crate::equations::assembly::Assembly;
use crate::equations::error::SolveError;
use crate::equations::hub::BodySums;
use crate::equations::joint_inputs::{Environment, JointInputs};
use crate::equations::load_sums::{Along, HubAccelerations, LoadSums};
use crate::equations::system::Solution;
use crate::generated::hub::ConstantShare;
use crate::model::kind::JointInfo;
use crate::model::mode::Mode;
use crate::model::passive::Passive;
use crate::model::wrench::Wrench;
use crate::numbers::each::{Each, JointStates, Value};
use crate::numbers::real::Scalar;
use crate::numbers::vec3::Vec3;
use crate::validation::parameter_error::ParameterError;

/// A set of devices, by their parameters.
///
/// Implemented for every [`Kind`](crate::model::kind::Kind), and for arrays, tuples (up to eight
/// members) and, with the feature `alloc`, vectors of sets. The data of a set have its shape: the
/// joints of `([ReactionWheel; 4], Dgvscmg)` are `([reaction_wheel::Joints; 4], dgvscmg::Joints)`.
/// Devices count from 0 through the whole set, in order.
pub trait Devices: Clone + Debug + PartialEq {
    /// The number type.
    type Scalar: Scalar;
    /// The devices, checked and precomputed.
    type Prepared: Clone + Debug;
    /// Coordinates and rates of the joints.
    type Joints: JointStates<Self::Scalar>;
    /// Motor torques.
    type Motors: Each<Self::Scalar>;
    /// Joint accelerations.
    type Accelerations: Each<Self::Scalar>;
    /// A value per joint.
    type PerJoint<V: Value>: Each<V>;
    /// Loads of the joints and of the mounts.
    type Loads: Clone + Debug + PartialEq;
    /// What an evaluation keeps from elimination to back substitution.
    type Scratch;

    /// Checks the parameters; `device` counts.
    ///
    /// # Errors
    /// The first [`ParameterError`].
    fn check(&self, device: &mut usize) -> Result<(), ParameterError<Self::Scalar>>;
    /// The devices, precomputed: what depends only on parameters, computed.
    fn prepare(&self) -> Self::Prepared;
    /// The constant share of the hub of each device.
    fn constant_shares(
        devices: &Self::Prepared,
    ) -> impl Iterator<Item = ConstantShare<Self::Scalar>>;
    /// The joints in order.
    fn infos(devices: &Self::Prepared) -> impl Iterator<Item = &'static JointInfo>;
    /// By how much each body's inertia breaks the triangle inequality, kg m².
    fn excesses(devices: &Self::Prepared) -> impl Iterator<Item = Self::Scalar>;
    /// Springs, dampers, friction of each joint.
    fn passives(devices: &Self::Prepared) -> impl Iterator<Item = Passive<Self::Scalar>>;
    /// All coordinates and rates zero.
    fn at_rest_for(devices: &Self::Prepared) -> Self::Joints;
    /// All motors off.
    fn motors_off_for(devices: &Self::Prepared) -> Self::Motors;
    /// No joint accelerating.
    fn no_accelerations_for(devices: &Self::Prepared) -> Self::Accelerations;
    /// One value at every joint.
    fn all_for<V: Value>(devices: &Self::Prepared, value: V) -> Self::PerJoint<V>;
    /// The modes that the kinds have by themselves.
    fn modes_for(devices: &Self::Prepared) -> Self::PerJoint<Mode<Self::Scalar>> {
        let mut modes = Self::all_for(devices, Mode::Driven);
        for (mode, info) in modes.values_mut().zip(Self::infos(devices)) {
            *mode = info.own_mode();
        }
        modes
    }
    /// No loads.
    fn no_loads_for(devices: &Self::Prepared) -> Self::Loads;
    /// Room for an evaluation.
    fn scratch(devices: &Self::Prepared) -> Self::Scratch;

    /// Whether there is data for as many devices as there are; sets of fixed size always fit.
    ///
    /// # Errors
    /// [`SolveError::Count`].
    fn fits(
        devices: &Self::Prepared,
        joints: &Self::Joints,
        given: Option<SetInputs<'_, Self>>,
        accelerations: Option<&Self::Accelerations>,
    ) -> Result<(), SolveError<Self::Scalar>>;
    /// Eliminates every joint, adds what is left to the hub's system; `device` counts.
    ///
    /// # Errors
    /// The first [`SolveError`].
    fn eliminate_set<W: Rounding>(
        devices: &Self::Prepared,
        joints: &Self::Joints,
        given: SetInputs<'_, Self>,
        environment: &Environment<Self::Scalar>,
        assembly: &mut Assembly<Self::Scalar>,
        scratch: &mut Self::Scratch,
        device: &mut usize,
    ) -> Result<(), SolveError<Self::Scalar>>;
    /// The joints' accelerations once the hub's are known.
    fn back_substitute(
        devices: &Self::Prepared,
        scratch: &Self::Scratch,
        hub: &Solution<Self::Scalar>,
        out: &mut Self::Accelerations,
    );
    /// Adds kinetic energy and momenta for the velocity of B and the angular velocity, B axes.
    fn add_sums(
        devices: &Self::Prepared,
        joints: &Self::Joints,
        r_b_n_dot: Vec3<Self::Scalar>,
        omega: Vec3<Self::Scalar>,
        sums: &mut BodySums<Self::Scalar>,
    );
    /// Adds the first moment about B and its derivative seen from B, B axes.
    fn add_first_moment(
        devices: &Self::Prepared,
        joints: &Self::Joints,
        moment: &mut [Vec3<Self::Scalar>; 2],
    );
    /// The loads that the accelerations need; adds what the devices ask of the hub.
    #[expect(clippy::too_many_arguments, reason = "state, inputs and accelerations, then results")]
    fn loads(
        devices: &Self::Prepared,
        joints: &Self::Joints,
        given: SetInputs<'_, Self>,
        environment: &Environment<Self::Scalar>,
        hub: &HubAccelerations<Self::Scalar>,
        accelerations: &Self::Accelerations,
        along: &Along<Self::Scalar>,
        out: &mut Self::Loads,
        totals: &mut LoadSums<Self::Scalar>,
    );
}

/// A set whose devices are known when it is compiled.
pub trait FixedSet: Devices {
    /// All coordinates and rates zero.
    fn at_rest() -> Self::Joints;
    /// All motors off.
    fn motors_off() -> Self::Motors;
    /// One value at every joint.
    fn all<V: Value>(value: V) -> Self::PerJoint<V>;
    /// The modes that the kinds have by themselves.
    fn modes() -> Self::PerJoint<Mode<Self::Scalar>>;
    /// The joints in order.
    fn joint_infos() -> impl Iterator<Item = &'static JointInfo>;
}

/// What is given of the joints of a set.
pub(crate) type SetInputs<'a, D> = JointInputs<
    'a,
    <D as Devices>::Motors,
    <D as Devices>::PerJoint<Mode<<D as Devices>::Scalar>>,
    <D as Devices>::PerJoint<Wrench<<D as Devices>::Scalar>>,
>;
