//! Sets of sets: arrays, tuples, vectors. Each call goes on to the members, in order.

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
use crate::numbers::each::Value;
use crate::numbers::vec3::Vec3;
use crate::sets::devices::{Devices, FixedSet, SetInputs};
use crate::validation::parameter_error::ParameterError;

/// An array of members.
macro_rules! array {
    ($member:ty) => {
        [$member; N]
    };
}

/// An array made of the members of another.
macro_rules! array_of {
    ($members:expr, $of:expr) => {
        $members.each_ref().map($of)
    };
}

/// Members in a row: an array, or a vector. `$map` makes one of the same length.
macro_rules! row {
    ($row:ident, $map:ident $(, $n:ident)?) => {
        impl<D: Devices $(, const $n: usize)?> Devices for $row!(D) {
            type Scalar = D::Scalar;
            type Prepared = $row!(D::Prepared);
            type Joints = $row!(D::Joints);
            type Motors = $row!(D::Motors);
            type Accelerations = $row!(D::Accelerations);
            type PerJoint<V: Value> = $row!(D::PerJoint<V>);
            type Loads = $row!(D::Loads);
            type Scratch = $row!(D::Scratch);

            fn check(&self, device: &mut usize) -> Result<(), ParameterError<Self::Scalar>> {
                self.iter().try_for_each(|member| member.check(device))
            }

            fn prepare(&self) -> Self::Prepared {
                $map!(self, D::prepare)
            }

            fn constant_shares(devices: &Self::Prepared) -> impl Iterator<Item = ConstantShare<Self::Scalar>> {
                devices.iter().flat_map(D::constant_shares)
            }

            fn infos(devices: &Self::Prepared) -> impl Iterator<Item = &'static JointInfo> {
                devices.iter().flat_map(D::infos)
            }

            fn excesses(devices: &Self::Prepared) -> impl Iterator<Item = Self::Scalar> {
                devices.iter().flat_map(D::excesses)
            }

            fn passives(devices: &Self::Prepared) -> impl Iterator<Item = Passive<Self::Scalar>> {
                devices.iter().flat_map(D::passives)
            }

            fn at_rest_for(devices: &Self::Prepared) -> Self::Joints {
                $map!(devices, D::at_rest_for)
            }

            fn motors_off_for(devices: &Self::Prepared) -> Self::Motors {
                $map!(devices, D::motors_off_for)
            }

            fn no_accelerations_for(devices: &Self::Prepared) -> Self::Accelerations {
                $map!(devices, D::no_accelerations_for)
            }

            fn all_for<V: Value>(devices: &Self::Prepared, value: V) -> Self::PerJoint<V> {
                $map!(devices, |device| D::all_for(device, value))
            }

            fn no_loads_for(devices: &Self::Prepared) -> Self::Loads {
                $map!(devices, D::no_loads_for)
            }

            fn scratch(devices: &Self::Prepared) -> Self::Scratch {
                $map!(devices, D::scratch)
            }

            fn fits(
                devices: &Self::Prepared,
                joints: &Self::Joints,
                given: Option<SetInputs<'_, Self>>,
                accelerations: Option<&Self::Accelerations>,
            ) -> Result<(), SolveError<Self::Scalar>> {
                let expected = devices.len();
                let counts = [
                    Some(joints.len()),
                    given.map(|given| given.motors.len()),
                    given.map(|given| given.modes.len()),
                    given.and_then(|given| Some(given.bodies?.len())),
                    accelerations.map(|found| found.len()),
                ];
                if let Some(found) = counts.into_iter().flatten().find(|count| *count != expected) {
                    return Err(SolveError::Count { expected, found });
                }
                let members = devices.iter().zip(joints).enumerate();
                for (index, (member, joints)) in members {
                    let given = given.and_then(|given| given.member(index));
                    let accelerations = accelerations.and_then(|found| found.get(index));
                    D::fits(member, joints, given, accelerations)?;
                }
                Ok(())
            }

            #[inline(always)]
            fn eliminate_set<W: Rounding>(
                devices: &Self::Prepared,
                joints: &Self::Joints,
                given: SetInputs<'_, Self>,
                environment: &Environment<Self::Scalar>,
                assembly: &mut Assembly<Self::Scalar>,
                scratch: &mut Self::Scratch,
                device: &mut usize,
            ) -> Result<(), SolveError<Self::Scalar>> {
                let members = devices.iter().zip(joints).zip(given.members()).zip(scratch);
                for (((member, joints), given), scratch) in members {
                    D::eliminate_set::<W>(member, joints, given, environment, assembly, scratch, device)?;
                }
                Ok(())
            }

            #[inline(always)]
            fn back_substitute(
                devices: &Self::Prepared,
                scratch: &Self::Scratch,
                hub: &Solution<Self::Scalar>,
                out: &mut Self::Accelerations,
            ) {
                for ((member, scratch), out) in devices.iter().zip(scratch).zip(out) {
                    D::back_substitute(member, scratch, hub, out);
                }
            }

            fn add_sums(
                devices: &Self::Prepared,
                joints: &Self::Joints,
                r_b_n_dot: Vec3<Self::Scalar>,
                omega: Vec3<Self::Scalar>,
                sums: &mut BodySums<Self::Scalar>,
            ) {
                for (member, joints) in devices.iter().zip(joints) {
                    D::add_sums(member, joints, r_b_n_dot, omega, sums);
                }
            }

            fn add_first_moment(
                devices: &Self::Prepared,
                joints: &Self::Joints,
                moment: &mut [Vec3<Self::Scalar>; 2],
            ) {
                for (member, joints) in devices.iter().zip(joints) {
                    D::add_first_moment(member, joints, moment);
                }
            }

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
            ) {
                let members = devices.iter().zip(joints).zip(given.members()).zip(accelerations);
                for ((((member, joints), given), accelerations), out) in members.zip(out) {
                    D::loads(
                        member, joints, given, environment, hub, accelerations, along, out, totals,
                    );
                }
            }
        }

        impl<'a, M, P, W $(, const $n: usize)?> JointInputs<'a, $row!(M), $row!(P), $row!(W)> {
            /// What is given of one member.
            fn member(self, index: usize) -> Option<JointInputs<'a, M, P, W>> {
                let (motors, modes) = (self.motors.get(index)?, self.modes.get(index)?);
                Some(JointInputs { motors, modes, bodies: self.bodies.and_then(|all| all.get(index)) })
            }

            /// What is given of each member.
            fn members(self) -> impl Iterator<Item = JointInputs<'a, M, P, W>> {
                let pairs = self.motors.iter().zip(self.modes).enumerate();
                pairs.map(move |(index, (motors, modes))| {
                    let bodies = self.bodies.and_then(|all| all.get(index));
                    JointInputs { motors, modes, bodies }
                })
            }
        }
    };
}

row!(array, array_of, N);

impl<D: FixedSet, const N: usize> FixedSet for [D; N] {
    fn at_rest() -> Self::Joints {
        [(); N].map(|()| D::at_rest())
    }

    fn motors_off() -> Self::Motors {
        [(); N].map(|()| D::motors_off())
    }

    fn all<V: Value>(value: V) -> Self::PerJoint<V> {
        [(); N].map(|()| D::all(value))
    }

    fn modes() -> Self::PerJoint<Mode<Self::Scalar>> {
        [(); N].map(|()| D::modes())
    }

    fn joint_infos() -> impl Iterator<Item = &'static JointInfo> {
        [(); N].into_iter().flat_map(|()| D::joint_infos())
    }
}

/// A vector of members.
#[cfg(feature = "alloc")]
macro_rules! vector {
    ($member:ty) => {
        alloc::vec::Vec<$member>
    };
}

/// A vector made of the members of another.
#[cfg(feature = "alloc")]
macro_rules! vector_of {
    ($members:expr, $of:expr) => {
        $members.iter().map($of).collect()
    };
}

#[cfg(feature = "alloc")]
row!(vector, vector_of);
