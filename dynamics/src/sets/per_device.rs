//! [`PerDevice`]: a family of data with one type for each kind of device. A set has such data in
//! its own shape: of `([ReactionWheel; 4], Dgvscmg)`, [`Joints`] are
//! `([reaction_wheel::Joints; 4], dgvscmg::Joints)`.

use core::fmt::Debug;

use crate::equations::device_loads::{DeviceLoads, JointPower, LoadsOf};
use crate::model::joint_array::JointArray;
use crate::model::kind::Kind;
use crate::model::wrench::Wrench;
use crate::numbers::each::{Each, JointStates, Value, filled};
use crate::numbers::real::{Scalar, zero};
use crate::sets::enumeration::{DeviceEnum, Variant};
use crate::sets::kind_data::{KindData, KindDataMut};

/// Data with one type for each kind of device; a value of the family is what new data begin with.
pub trait PerDevice<T: Scalar>: 'static {
    /// The type for a kind.
    type Of<K: Kind<Scalar = T>>;
    /// The type for an enumeration of kinds.
    type OfEnum<E: DeviceEnum<Scalar = T>>;

    /// New data of a kind.
    fn initial<K: Kind<Scalar = T>>(&self) -> Self::Of<K>;
    /// New data of an enumeration's device of a kind.
    fn initial_of_enum<K: Variant<E>, E: DeviceEnum<Scalar = T>>(&self) -> Self::OfEnum<E>;
    /// A kind's data out of an enumeration's; none where they are of another kind.
    fn get<K: Variant<E>, E: DeviceEnum<Scalar = T>>(of: &Self::OfEnum<E>) -> Option<Self::Of<K>>;
    /// A kind's data into an enumeration's.
    fn put<K: Variant<E>, E: DeviceEnum<Scalar = T>>(of: &Self::Of<K>, to: &mut Self::OfEnum<E>);
    /// A kind's data out of an enumeration's, to be read: here a copy.
    fn held<K: Variant<E>, E: DeviceEnum<Scalar = T>>(
        of: &Self::OfEnum<E>,
    ) -> Option<KindData<'_, Self::Of<K>>> {
        Self::get::<K, E>(of).map(KindData::Copied)
    }
    /// A kind's data out of an enumeration's, to be changed: here a copy that is put back.
    fn held_mut<K: Variant<E>, E: DeviceEnum<Scalar = T>>(
        of: &mut Self::OfEnum<E>,
    ) -> Option<KindDataMut<'_, Self::Of<K>, Self::OfEnum<E>>> {
        Some(KindDataMut::Copied(Self::get::<K, E>(of)?, of))
    }
    /// The number of joints that an enumeration's data are of; none where they do not say.
    fn count<E: DeviceEnum<Scalar = T>>(of: &Self::OfEnum<E>) -> Option<usize>;
}

/// Coordinates and rates of the joints, at first zero.
#[derive(Clone, Copy, Debug)]
pub struct Joints;

/// Motor torques and forces, at first zero.
#[derive(Clone, Copy, Debug)]
pub struct Motors;

/// Accelerations of the joints, at first zero.
#[derive(Clone, Copy, Debug)]
pub struct Accelerations;

/// A value at each joint, at first this one.
#[derive(Clone, Copy, Debug)]
pub struct PerJoint<V>(pub V);

/// Loads of the joints and of the mount, at first none.
#[derive(Clone, Copy, Debug)]
pub struct Loads;

/// What an evaluation keeps from elimination to back substitution, at first nothing.
#[derive(Clone, Copy, Debug)]
pub struct Gains;

/// The number of the mount of each device, from 0; at first 0. A carrier's is that of all it
/// carries, whose own are not read.
#[derive(Clone, Copy, Debug)]
pub struct OnMount;

/// Loads of a device whose kind is known only at run time.
pub type EnumLoads<T = f64> =
    DeviceLoads<JointArray<Wrench<T>>, JointArray<T>, JointArray<JointPower<T>>, T>;

impl<T: Scalar> PerDevice<T> for Joints {
    type Of<K: Kind<Scalar = T>> = K::Joints<T>;
    type OfEnum<E: DeviceEnum<Scalar = T>> = JointArray<[T; 2]>;

    fn initial<K: Kind<Scalar = T>>(&self) -> K::Joints<T> {
        K::at_rest()
    }

    fn initial_of_enum<K: Variant<E>, E: DeviceEnum<Scalar = T>>(&self) -> JointArray<[T; 2]> {
        JointArray::all(K::JOINTS.len(), [zero(); 2])
    }

    fn get<K: Variant<E>, E: DeviceEnum<Scalar = T>>(
        of: &JointArray<[T; 2]>,
    ) -> Option<K::Joints<T>> {
        let mut joints = K::at_rest();
        for ([coordinate, rate], [x, x_dot]) in joints.states_mut().zip(of.states()) {
            (*coordinate, *rate) = (x, x_dot);
        }
        Some(joints)
    }

    fn put<K: Variant<E>, E: DeviceEnum<Scalar = T>>(
        of: &K::Joints<T>,
        to: &mut JointArray<[T; 2]>,
    ) {
        to.fill(of.states());
    }

    fn count<E: DeviceEnum<Scalar = T>>(of: &JointArray<[T; 2]>) -> Option<usize> {
        Some(of.as_slice().len())
    }
}

/// A family of one number per joint: the type for a kind, and its zero.
macro_rules! numbers {
    ($($family:ty, $kind:ident: $of:ty = $zero:expr;)*) => {$(
        impl<T: Scalar> PerDevice<T> for $family {
            type Of<$kind: Kind<Scalar = T>> = $of;
            type OfEnum<E: DeviceEnum<Scalar = T>> = JointArray<T>;

            fn initial<$kind: Kind<Scalar = T>>(&self) -> $of {
                $zero
            }

            fn initial_of_enum<$kind: Variant<E>, E: DeviceEnum<Scalar = T>>(&self) -> JointArray<T> {
                JointArray::all($kind::JOINTS.len(), zero())
            }

            fn get<$kind: Variant<E>, E: DeviceEnum<Scalar = T>>(of: &JointArray<T>) -> Option<$of> {
                Some(filled($zero, of.values()))
            }

            fn put<$kind: Variant<E>, E: DeviceEnum<Scalar = T>>(of: &$of, to: &mut JointArray<T>) {
                to.fill(of.values());
            }

            fn count<E: DeviceEnum<Scalar = T>>(of: &JointArray<T>) -> Option<usize> {
                Some(of.as_slice().len())
            }
        }
    )*};
}

numbers! {
    Motors, K: K::Motors = K::motors_off();
    Accelerations, K: K::Accelerations<T> = K::no_accelerations();
}

impl<T: Scalar, V: Value> PerDevice<T> for PerJoint<V> {
    type Of<K: Kind<Scalar = T>> = K::PerJoint<V>;
    type OfEnum<E: DeviceEnum<Scalar = T>> = JointArray<V>;

    fn initial<K: Kind<Scalar = T>>(&self) -> K::PerJoint<V> {
        K::all(self.0)
    }

    fn initial_of_enum<K: Variant<E>, E: DeviceEnum<Scalar = T>>(&self) -> JointArray<V> {
        JointArray::all(K::JOINTS.len(), self.0)
    }

    fn get<K: Variant<E>, E: DeviceEnum<Scalar = T>>(of: &JointArray<V>) -> Option<K::PerJoint<V>> {
        of.as_slice().first().map(|first| filled(K::all(*first), of.values()))
    }

    fn put<K: Variant<E>, E: DeviceEnum<Scalar = T>>(of: &K::PerJoint<V>, to: &mut JointArray<V>) {
        to.fill(of.values());
    }

    fn count<E: DeviceEnum<Scalar = T>>(of: &JointArray<V>) -> Option<usize> {
        Some(of.as_slice().len())
    }
}

impl<T: Scalar> PerDevice<T> for Loads {
    type Of<K: Kind<Scalar = T>> = LoadsOf<K>;
    type OfEnum<E: DeviceEnum<Scalar = T>> = EnumLoads<T>;

    fn initial<K: Kind<Scalar = T>>(&self) -> LoadsOf<K> {
        DeviceLoads {
            mount: Wrench::none(),
            joints: K::all(Wrench::none()),
            motors: K::all(zero()),
            powers: K::all(JointPower::none()),
        }
    }

    fn initial_of_enum<K: Variant<E>, E: DeviceEnum<Scalar = T>>(&self) -> EnumLoads<T> {
        let count = K::JOINTS.len();
        DeviceLoads {
            mount: Wrench::none(),
            joints: JointArray::all(count, Wrench::none()),
            motors: JointArray::all(count, zero()),
            powers: JointArray::all(count, JointPower::none()),
        }
    }

    fn get<K: Variant<E>, E: DeviceEnum<Scalar = T>>(of: &EnumLoads<T>) -> Option<LoadsOf<K>> {
        let DeviceLoads { mount, joints, motors, powers } = of;
        Some(DeviceLoads {
            mount: *mount,
            joints: filled(K::all(Wrench::none()), joints.values()),
            motors: filled(K::all(zero()), motors.values()),
            powers: filled(K::all(JointPower::none()), powers.values()),
        })
    }

    fn put<K: Variant<E>, E: DeviceEnum<Scalar = T>>(of: &LoadsOf<K>, to: &mut EnumLoads<T>) {
        to.mount = of.mount;
        to.joints.fill(of.joints.values());
        to.motors.fill(of.motors.values());
        to.powers.fill(of.powers.values());
    }

    fn count<E: DeviceEnum<Scalar = T>>(of: &EnumLoads<T>) -> Option<usize> {
        Some(of.motors.as_slice().len())
    }
}

impl<T: Scalar> PerDevice<T> for Gains {
    type Of<K: Kind<Scalar = T>> = Option<K::Gains<T>>;
    type OfEnum<E: DeviceEnum<Scalar = T>> = E::Gains;

    fn initial<K: Kind<Scalar = T>>(&self) -> Option<K::Gains<T>> {
        None
    }

    fn initial_of_enum<K: Variant<E>, E: DeviceEnum<Scalar = T>>(&self) -> E::Gains {
        K::gains_of_enum(None)
    }

    fn get<K: Variant<E>, E: DeviceEnum<Scalar = T>>(of: &E::Gains) -> Option<Option<K::Gains<T>>> {
        K::gains_in_enum(of).copied()
    }

    fn held<K: Variant<E>, E: DeviceEnum<Scalar = T>>(
        of: &E::Gains,
    ) -> Option<KindData<'_, Option<K::Gains<T>>>> {
        K::gains_in_enum(of).map(KindData::InPlace)
    }

    fn held_mut<K: Variant<E>, E: DeviceEnum<Scalar = T>>(
        of: &mut E::Gains,
    ) -> Option<KindDataMut<'_, Option<K::Gains<T>>, E::Gains>> {
        K::gains_in_enum_mut(of).map(KindDataMut::InPlace)
    }

    fn put<K: Variant<E>, E: DeviceEnum<Scalar = T>>(of: &Option<K::Gains<T>>, to: &mut E::Gains) {
        *to = K::gains_of_enum(*of);
    }

    fn count<E: DeviceEnum<Scalar = T>>(_: &E::Gains) -> Option<usize> {
        None
    }
}

impl<T: Scalar> PerDevice<T> for OnMount {
    type Of<K: Kind<Scalar = T>> = usize;
    type OfEnum<E: DeviceEnum<Scalar = T>> = usize;

    fn initial<K: Kind<Scalar = T>>(&self) -> usize {
        0
    }

    fn initial_of_enum<K: Variant<E>, E: DeviceEnum<Scalar = T>>(&self) -> usize {
        0
    }

    fn get<K: Variant<E>, E: DeviceEnum<Scalar = T>>(of: &usize) -> Option<usize> {
        Some(*of)
    }

    fn put<K: Variant<E>, E: DeviceEnum<Scalar = T>>(of: &usize, to: &mut usize) {
        *to = *of;
    }

    fn count<E: DeviceEnum<Scalar = T>>(_: &usize) -> Option<usize> {
        None
    }
}
