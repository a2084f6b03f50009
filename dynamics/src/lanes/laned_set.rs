//! [`LanedSet`]: the sets of devices that can be evaluated in lanes.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use super::constants::EachConstants;
use crate::model::kind::Kind;
use crate::model::mode::Mode;
use crate::model::wrench::Wrench;
use crate::sets::devices::{DeviceSet, Devices, SetInputs};
use crate::sets::per_device::{self as data, PerDevice};

/// A set of devices that can be evaluated in lanes: every kind, arrays, tuples, vectors.
///
/// Lanes evaluate the same devices at several states. Data of a vector with another number of members
/// fall back to the scalar path, which returns the error; so do spacecraft of a
/// [`Batch`](super::Batch) whose vectors have other numbers of members.
pub trait LanedSet:
    Devices<Scalar = f64> + DeviceSet<Prepared: Send + Sync, Per<EachConstants>: Send + Sync>
{
    /// Whether data are of as many members as the devices.
    fn fits<F: PerDevice<f64>>(devices: &Self::Prepared, data: &Self::Per<F>) -> bool;
    /// Whether two sets have as many members.
    fn is_alike(devices: &Self::Prepared, other: &Self::Prepared) -> bool;
}

impl<K: Kind<Scalar = f64>> LanedSet for K {
    #[inline(always)]
    fn fits<F: PerDevice<f64>>(_: &Self::Prepared, _: &Self::Per<F>) -> bool {
        true
    }

    #[inline(always)]
    fn is_alike(_: &Self::Prepared, _: &Self::Prepared) -> bool {
        true
    }
}

impl<D: LanedSet, const N: usize> LanedSet for [D; N] {
    #[inline(always)]
    fn fits<F: PerDevice<f64>>(devices: &Self::Prepared, data: &Self::Per<F>) -> bool {
        devices.iter().zip(data).all(|(device, data)| D::fits::<F>(device, data))
    }

    #[inline(always)]
    fn is_alike(devices: &Self::Prepared, other: &Self::Prepared) -> bool {
        devices.iter().zip(other).all(|(device, other)| D::is_alike(device, other))
    }
}

impl<D: LanedSet> LanedSet for std::vec::Vec<D> {
    fn fits<F: PerDevice<f64>>(devices: &Self::Prepared, data: &Self::Per<F>) -> bool {
        let members = || devices.iter().zip(data);
        devices.len() == data.len() && members().all(|(device, data)| D::fits::<F>(device, data))
    }

    fn is_alike(devices: &Self::Prepared, other: &Self::Prepared) -> bool {
        let members = || devices.iter().zip(other);
        devices.len() == other.len() && members().all(|(device, other)| D::is_alike(device, other))
    }
}

macro_rules! tuples {
    ($($($member:ident $place:tt)*;)*) => {$(
        impl<$($member: LanedSet),*> LanedSet for ($($member,)*) {
            #[inline(always)]
            fn fits<Y: PerDevice<f64>>(devices: &Self::Prepared, data: &Self::Per<Y>) -> bool {
                $($member::fits::<Y>(&devices.$place, &data.$place) &&)* true
            }

            #[inline(always)]
            fn is_alike(devices: &Self::Prepared, other: &Self::Prepared) -> bool {
                $($member::is_alike(&devices.$place, &other.$place) &&)* true
            }
        }
    )*};
}

tuples! {
    A 0;
    A 0 B 1;
    A 0 B 1 C 2;
    A 0 B 1 C 2 D 3;
    A 0 B 1 C 2 D 3 E 4;
    A 0 B 1 C 2 D 3 E 4 F 5;
    A 0 B 1 C 2 D 3 E 4 F 5 G 6;
    A 0 B 1 C 2 D 3 E 4 F 5 G 6 H 7;
}

/// Whether inputs are of as many devices.
#[inline(always)]
pub(crate) fn fit_inputs<D: LanedSet>(devices: &D::Prepared, inputs: SetInputs<'_, D>) -> bool {
    D::fits::<data::Motors>(devices, inputs.motors)
        && D::fits::<data::PerJoint<Mode<f64>>>(devices, inputs.modes)
        && inputs.bodies.is_none_or(|of| D::fits::<data::PerJoint<Wrench<f64>>>(devices, of))
}
