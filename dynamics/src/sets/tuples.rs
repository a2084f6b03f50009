//! Sets of different members: tuples. Each call goes on to the members, in order.

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

macro_rules! tuples {
    ($(($($rest:ident $place:tt),*);)*) => {$(
        impl<A: Devices, $($rest: Devices<Scalar = A::Scalar>),*> Devices for (A, $($rest,)*) {
            type Scalar = A::Scalar;
            type Prepared = (A::Prepared, $($rest::Prepared,)*);
            type Joints = (A::Joints, $($rest::Joints,)*);
            type Motors = (A::Motors, $($rest::Motors,)*);
            type Accelerations = (A::Accelerations, $($rest::Accelerations,)*);
            type PerJoint<V: Value> = (A::PerJoint<V>, $($rest::PerJoint<V>,)*);
            type Loads = (A::Loads, $($rest::Loads,)*);
            type Scratch = (A::Scratch, $($rest::Scratch,)*);

            fn check(&self, device: &mut usize) -> Result<(), ParameterError<Self::Scalar>> {
                self.0.check(device)?;
                $(self.$place.check(device)?;)*
                Ok(())
            }

            fn prepare(&self) -> Self::Prepared {
                (self.0.prepare(), $(self.$place.prepare(),)*)
            }

            fn constant_shares(devices: &Self::Prepared) -> impl Iterator<Item = ConstantShare<Self::Scalar>> {
                A::constant_shares(&devices.0)$(.chain($rest::constant_shares(&devices.$place)))*
            }

            fn infos(devices: &Self::Prepared) -> impl Iterator<Item = &'static JointInfo> {
                A::infos(&devices.0)$(.chain($rest::infos(&devices.$place)))*
            }

            fn excesses(devices: &Self::Prepared) -> impl Iterator<Item = Self::Scalar> {
                A::excesses(&devices.0)$(.chain($rest::excesses(&devices.$place)))*
            }

            fn passives(devices: &Self::Prepared) -> impl Iterator<Item = Passive<Self::Scalar>> {
                A::passives(&devices.0)$(.chain($rest::passives(&devices.$place)))*
            }

            fn at_rest_for(devices: &Self::Prepared) -> Self::Joints {
                (A::at_rest_for(&devices.0), $($rest::at_rest_for(&devices.$place),)*)
            }

            fn motors_off_for(devices: &Self::Prepared) -> Self::Motors {
                (A::motors_off_for(&devices.0), $($rest::motors_off_for(&devices.$place),)*)
            }

            fn no_accelerations_for(devices: &Self::Prepared) -> Self::Accelerations {
                (
                    A::no_accelerations_for(&devices.0),
                    $($rest::no_accelerations_for(&devices.$place),)*
                )
            }

            fn all_for<V: Value>(devices: &Self::Prepared, value: V) -> Self::PerJoint<V> {
                (A::all_for(&devices.0, value), $($rest::all_for(&devices.$place, value),)*)
            }

            fn no_loads_for(devices: &Self::Prepared) -> Self::Loads {
                (A::no_loads_for(&devices.0), $($rest::no_loads_for(&devices.$place),)*)
            }

            fn scratch(devices: &Self::Prepared) -> Self::Scratch {
                (A::scratch(&devices.0), $($rest::scratch(&devices.$place),)*)
            }

            fn fits(
                devices: &Self::Prepared,
                joints: &Self::Joints,
                given: Option<SetInputs<'_, Self>>,
                accelerations: Option<&Self::Accelerations>,
            ) -> Result<(), SolveError<Self::Scalar>> {
                A::fits(&devices.0, &joints.0, given.map(|given| JointInputs {
                    motors: &given.motors.0,
                    modes: &given.modes.0,
                    bodies: given.bodies.map(|all| &all.0),
                }), accelerations.map(|found| &found.0))?;
                $($rest::fits(&devices.$place, &joints.$place, given.map(|given| JointInputs {
                    motors: &given.motors.$place,
                    modes: &given.modes.$place,
                    bodies: given.bodies.map(|all| &all.$place),
                }), accelerations.map(|found| &found.$place))?;)*
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
                let of = JointInputs {
                    motors: &given.motors.0,
                    modes: &given.modes.0,
                    bodies: given.bodies.map(|all| &all.0),
                };
                A::eliminate_set::<W>(
                    &devices.0, &joints.0, of, environment, assembly, &mut scratch.0, device,
                )?;
                $(
                    let of = JointInputs {
                        motors: &given.motors.$place,
                        modes: &given.modes.$place,
                        bodies: given.bodies.map(|all| &all.$place),
                    };
                    $rest::eliminate_set::<W>(
                        &devices.$place,
                        &joints.$place,
                        of,
                        environment,
                        assembly,
                        &mut scratch.$place,
                        device,
                    )?;
                )*
                Ok(())
            }

            #[inline(always)]
            fn back_substitute(
                devices: &Self::Prepared,
                scratch: &Self::Scratch,
                hub: &Solution<Self::Scalar>,
                out: &mut Self::Accelerations,
            ) {
                A::back_substitute(&devices.0, &scratch.0, hub, &mut out.0);
                $($rest::back_substitute(&devices.$place, &scratch.$place, hub, &mut out.$place);)*
            }

            fn add_sums(
                devices: &Self::Prepared,
                joints: &Self::Joints,
                r_b_n_dot: Vec3<Self::Scalar>,
                omega: Vec3<Self::Scalar>,
                sums: &mut BodySums<Self::Scalar>,
            ) {
                A::add_sums(&devices.0, &joints.0, r_b_n_dot, omega, sums);
                $($rest::add_sums(&devices.$place, &joints.$place, r_b_n_dot, omega, sums);)*
            }

            fn add_first_moment(
                devices: &Self::Prepared,
                joints: &Self::Joints,
                moment: &mut [Vec3<Self::Scalar>; 2],
            ) {
                A::add_first_moment(&devices.0, &joints.0, moment);
                $($rest::add_first_moment(&devices.$place, &joints.$place, moment);)*
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
                let of = JointInputs {
                    motors: &given.motors.0,
                    modes: &given.modes.0,
                    bodies: given.bodies.map(|all| &all.0),
                };
                A::loads(
                    &devices.0,
                    &joints.0,
                    of,
                    environment,
                    hub,
                    &accelerations.0,
                    along,
                    &mut out.0,
                    totals,
                );
                $(
                    let of = JointInputs {
                        motors: &given.motors.$place,
                        modes: &given.modes.$place,
                        bodies: given.bodies.map(|all| &all.$place),
                    };
                    $rest::loads(
                        &devices.$place,
                        &joints.$place,
                        of,
                        environment,
                        hub,
                        &accelerations.$place,
                        along,
                        &mut out.$place,
                        totals,
                    );
                )*
            }
        }

        impl<A: FixedSet, $($rest: FixedSet<Scalar = A::Scalar>),*> FixedSet for (A, $($rest,)*) {
            fn at_rest() -> Self::Joints {
                (A::at_rest(), $($rest::at_rest(),)*)
            }

            fn motors_off() -> Self::Motors {
                (A::motors_off(), $($rest::motors_off(),)*)
            }

            fn all<V: Value>(value: V) -> Self::PerJoint<V> {
                (A::all(value), $($rest::all(value),)*)
            }

            fn modes() -> Self::PerJoint<Mode<Self::Scalar>> {
                (A::modes(), $($rest::modes(),)*)
            }

            fn joint_infos() -> impl Iterator<Item = &'static JointInfo> {
                A::joint_infos()$(.chain($rest::joint_infos()))*
            }
        }
    )*};
}

tuples! {
    ();
    (B 1);
    (B 1, C 2);
    (B 1, C 2, D 3);
    (B 1, C 2, D 3, E 4);
    (B 1, C 2, D 3, E 4, F 5);
    (B 1, C 2, D 3, E 4, F 5, G 6);
    (B 1, C 2, D 3, E 4, F 5, G 6, H 7);
}
