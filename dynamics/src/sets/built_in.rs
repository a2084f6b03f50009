//! [`BuiltIn`]: a device of any of this crate's kinds, without a heap, for parameters that come on
//! board at run time.
//!
//! `[Option<BuiltIn>; 8]` is a set of up to eight of them. Which kind a device is costs one branch
//! a call; the equations are those of the kind, with the same bits. Kinds from outside the crate
//! are not among them: `AnyDevice` takes those, with a heap.

use crate::equations::arithmetic::Rounding;
use crate::equations::assembly::Assembly;
use crate::equations::device::Device;
use crate::equations::device_loads::{DeviceLoads, JointPower};
use crate::equations::error::SolveError;
use crate::equations::hub::BodySums;
use crate::equations::joint_inputs::Environment;
use crate::equations::load_sums::{Along, HubAccelerations, LoadSums};
use crate::equations::system::Solution;
#[allow(clippy::wildcard_imports, reason = "every kind, also one to come")]
use crate::generated::devices::*;
use crate::generated::every_kind;
use crate::generated::hub::Handed;
use crate::model::joint_array::{JointArray, MAX_JOINTS};
use crate::model::kernels::Kernels;
use crate::model::kind::{JointInfo, Kind};
use crate::model::passive::Passive;
use crate::model::wrench::Wrench;
use crate::numbers::each::Value;
use crate::numbers::real::{Scalar, zero};
use crate::numbers::vec3::Vec3;
use crate::sets::built_in_calls as calls;
use crate::sets::device_parameters::{DeviceParameters, UnsupportedParameter};
use crate::sets::devices::{Devices, SetInputs};
use crate::validation::parameter_error::ParameterError;

/// The enumerations over all kinds, and what passes a call on.
macro_rules! built_in {
    ($($kind:ident)*) => {
        /// A device of one of this crate's kinds.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub enum BuiltIn<T = f64> {
            $(
                #[doc = concat!("A [`", stringify!($kind), "`].")]
                $kind($kind<T>),
            )*
        }

        /// Which of this crate's kinds.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum BuiltInKind {
            $(
                #[doc = concat!("[`", stringify!($kind), "`].")]
                $kind,
            )*
        }

        /// A device of one of this crate's kinds, precomputed.
        #[derive(Clone, Copy, Debug)]
        pub enum ReadyBuiltIn<T: Scalar> {
            $(
                #[doc = concat!("Of a [`", stringify!($kind), "`].")]
                $kind(Device<$kind<T>>),
            )*
        }

        /// What an evaluation keeps of a device from elimination to back substitution.
        #[derive(Clone, Copy, Debug)]
        pub enum BuiltInGains<T: Scalar> {
            /// Not yet eliminated.
            None,
            $(
                #[doc = concat!("Of a [`", stringify!($kind), "`].")]
                $kind(<$kind<T> as Kernels>::Gains<T>),
            )*
        }

        $(
            const _: () = assert!(<$kind as Kind>::JOINTS.len() <= MAX_JOINTS);

            impl<T: Scalar> From<$kind<T>> for BuiltIn<T> {
                fn from(device: $kind<T>) -> Self {
                    Self::$kind(device)
                }
            }
        )*

        impl BuiltInKind {
            /// Every kind.
            pub const ALL: &'static [Self] = &[$(Self::$kind),*];

            /// The joints of the kind, from the hub to the tip.
            #[must_use]
            pub fn joints(self) -> &'static [JointInfo] {
                match self {
                    $(Self::$kind => <$kind as Kind>::JOINTS,)*
                }
            }
        }

        impl<T: Scalar> BuiltIn<T> {
            /// A device of a kind with these parameters.
            ///
            /// # Errors
            ///
            /// [`UnsupportedParameter`] names what the kind has no parameter for.
            pub fn new(kind: BuiltInKind, parameters: &DeviceParameters<T>) -> Result<Self, UnsupportedParameter> {
                match kind {
                    $(BuiltInKind::$kind => calls::device_of(parameters).map(Self::$kind),)*
                }
            }

            /// Its kind.
            #[must_use]
            pub fn kind(&self) -> BuiltInKind {
                match self {
                    $(Self::$kind(_) => BuiltInKind::$kind,)*
                }
            }

            /// Its parameters by body and joint; zero outboard of the last body.
            #[must_use]
            pub fn parameters(&self) -> DeviceParameters<T> {
                match self {
                    $(Self::$kind(device) => calls::parameters_of(device),)*
                }
            }

            fn ready(&self) -> ReadyBuiltIn<T> {
                match self {
                    $(Self::$kind(device) => ReadyBuiltIn::$kind(Device::new(device)),)*
                }
            }
        }

        impl<T: Scalar> ReadyBuiltIn<T> {
            fn joints(&self) -> &'static [JointInfo] {
                match self {
                    $(Self::$kind(_) => <$kind as Kind>::JOINTS,)*
                }
            }

            fn handed(&self) -> Handed<T> {
                match self {
                    $(Self::$kind(device) => <$kind<T> as Kind>::handed(&device.constants),)*
                }
            }

            fn excesses(&self) -> JointArray<T> {
                match self {
                    $(Self::$kind(device) => calls::joint_array(&device.excess, zero()),)*
                }
            }

            fn passives(&self) -> JointArray<Passive<T>> {
                match self {
                    $(Self::$kind(device) => calls::joint_array(&device.passive, Passive::none()),)*
                }
            }

            fn eliminate_kind<W: Rounding>(
                &self,
                joints: &JointArray<[T; 2]>,
                given: SetInputs<'_, BuiltIn<T>>,
                environment: &Environment<T>,
                assembly: &mut Assembly<T>,
                scratch: &mut BuiltInGains<T>,
                index: &mut usize,
            ) -> Result<(), SolveError<T>> {
                match self {
                    $(Self::$kind(device) => {
                        let gains = calls::eliminate_typed::<_, W>(
                            device, joints, given, environment, assembly, index,
                        )?;
                        *scratch = gains.map_or(BuiltInGains::None, BuiltInGains::$kind);
                    })*
                }
                Ok(())
            }

            fn add_sums(
                &self,
                joints: &JointArray<[T; 2]>,
                r_b_n_dot: Vec3<T>,
                omega: Vec3<T>,
                sums: &mut BodySums<T>,
            ) {
                match self {
                    $(Self::$kind(device) => {
                        device.add_sums(&calls::joints::<$kind<T>>(joints), r_b_n_dot, omega, sums);
                    })*
                }
            }

            fn add_first_moment(&self, joints: &JointArray<[T; 2]>, moment: &mut [Vec3<T>; 2]) {
                match self {
                    $(Self::$kind(device) => {
                        device.add_first_moment(&calls::joints::<$kind<T>>(joints), moment);
                    })*
                }
            }

            #[expect(clippy::too_many_arguments, reason = "as `Devices::loads`")]
            fn loads(
                &self,
                joints: &JointArray<[T; 2]>,
                given: SetInputs<'_, BuiltIn<T>>,
                environment: &Environment<T>,
                hub: &HubAccelerations<T>,
                accelerations: &JointArray<T>,
                along: &Along<T>,
                totals: &mut LoadSums<T>,
            ) -> BuiltInLoads<T> {
                match self {
                    $(Self::$kind(device) => calls::loads(
                        device, joints, given, environment, hub, accelerations, along, totals,
                    ),)*
                }
            }
        }

        impl<T: Scalar> BuiltInGains<T> {
            fn back_substitute(&self, hub: &Solution<T>, out: &mut JointArray<T>) {
                match self {
                    Self::None => {}
                    $(Self::$kind(gains) => {
                        calls::back_substitute::<$kind<T>>(gains, hub, out);
                    })*
                }
            }
        }
    };
}

every_kind!(built_in);

/// Loads of a device of one of this crate's kinds.
pub type BuiltInLoads<T = f64> =
    DeviceLoads<JointArray<Wrench<T>>, JointArray<T>, JointArray<JointPower<T>>, T>;

impl<T: Scalar> Devices for BuiltIn<T> {
    type Scalar = T;
    type Prepared = ReadyBuiltIn<T>;
    type Joints = JointArray<[T; 2]>;
    type Motors = JointArray<T>;
    type Accelerations = JointArray<T>;
    type PerJoint<V: Value> = JointArray<V>;
    type Loads = BuiltInLoads<T>;
    type Scratch = BuiltInGains<T>;

    fn check(&self, device: &mut usize) -> Result<(), ParameterError<T>> {
        macro_rules! each {
            ($($kind:ident)*) => {
                match self {
                    $(Self::$kind(member) => member.check(device),)*
                }
            };
        }
        every_kind!(each)
    }

    fn prepare(&self) -> ReadyBuiltIn<T> {
        self.ready()
    }

    fn handed(device: &ReadyBuiltIn<T>) -> impl Iterator<Item = Handed<T>> {
        core::iter::once(device.handed())
    }

    fn infos(device: &ReadyBuiltIn<T>) -> impl Iterator<Item = &'static JointInfo> {
        device.joints().iter()
    }

    fn excesses(device: &ReadyBuiltIn<T>) -> impl Iterator<Item = T> {
        device.excesses().into_iter()
    }

    fn passives(device: &ReadyBuiltIn<T>) -> impl Iterator<Item = Passive<T>> {
        device.passives().into_iter()
    }

    fn at_rest_for(device: &ReadyBuiltIn<T>) -> JointArray<[T; 2]> {
        Self::all_for(device, [zero(); 2])
    }

    fn motors_off_for(device: &ReadyBuiltIn<T>) -> JointArray<T> {
        Self::all_for(device, zero())
    }

    fn no_accelerations_for(device: &ReadyBuiltIn<T>) -> JointArray<T> {
        Self::all_for(device, zero())
    }

    fn all_for<V: Value>(device: &ReadyBuiltIn<T>, value: V) -> JointArray<V> {
        JointArray::all(device.joints().len(), value)
    }

    fn no_loads_for(device: &ReadyBuiltIn<T>) -> BuiltInLoads<T> {
        DeviceLoads {
            mount: Wrench::none(),
            joints: Self::all_for(device, Wrench::none()),
            motors: Self::all_for(device, zero()),
            powers: Self::all_for(device, JointPower::none()),
        }
    }

    fn scratch(_: &ReadyBuiltIn<T>) -> BuiltInGains<T> {
        BuiltInGains::None
    }

    fn fits(
        device: &ReadyBuiltIn<T>,
        joints: &JointArray<[T; 2]>,
        given: Option<SetInputs<'_, Self>>,
        accelerations: Option<&JointArray<T>>,
    ) -> Result<(), SolveError<T>> {
        let expected = device.joints().len();
        let counts = [
            Some(joints.as_slice().len()),
            given.map(|given| given.motors.as_slice().len()),
            given.map(|given| given.modes.as_slice().len()),
            given.and_then(|given| Some(given.bodies?.as_slice().len())),
            accelerations.map(|found| found.as_slice().len()),
        ];
        let wrong = counts.into_iter().flatten().find(|count| *count != expected);
        wrong.map_or(Ok(()), |found| Err(SolveError::Count { expected, found }))
    }

    fn eliminate_set<W: Rounding>(
        device: &ReadyBuiltIn<T>,
        joints: &JointArray<[T; 2]>,
        given: SetInputs<'_, Self>,
        environment: &Environment<T>,
        assembly: &mut Assembly<T>,
        scratch: &mut BuiltInGains<T>,
        index: &mut usize,
    ) -> Result<(), SolveError<T>> {
        device.eliminate_kind::<W>(joints, given, environment, assembly, scratch, index)
    }

    fn back_substitute(
        _: &ReadyBuiltIn<T>,
        scratch: &BuiltInGains<T>,
        hub: &Solution<T>,
        out: &mut JointArray<T>,
    ) {
        scratch.back_substitute(hub, out);
    }

    fn add_sums(
        device: &ReadyBuiltIn<T>,
        joints: &JointArray<[T; 2]>,
        r_b_n_dot: Vec3<T>,
        omega: Vec3<T>,
        sums: &mut BodySums<T>,
    ) {
        device.add_sums(joints, r_b_n_dot, omega, sums);
    }

    fn add_first_moment(
        device: &ReadyBuiltIn<T>,
        joints: &JointArray<[T; 2]>,
        moment: &mut [Vec3<T>; 2],
    ) {
        device.add_first_moment(joints, moment);
    }

    fn loads(
        device: &ReadyBuiltIn<T>,
        joints: &JointArray<[T; 2]>,
        given: SetInputs<'_, Self>,
        environment: &Environment<T>,
        hub: &HubAccelerations<T>,
        accelerations: &JointArray<T>,
        along: &Along<T>,
        out: &mut BuiltInLoads<T>,
        totals: &mut LoadSums<T>,
    ) {
        *out = device.loads(joints, given, environment, hub, accelerations, along, totals);
    }
}
