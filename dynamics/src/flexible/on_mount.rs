//! [`OnMount`]: on which mount of the structure each device stands, in the shape of the set.

use crate::model::kind::Kind;
use crate::numbers::real::Scalar;
use crate::sets::enumeration::{DeviceEnum, Variant};
use crate::sets::per_device::PerDevice;

/// The number of the mount of each device, from 0; at first 0. A platform's is that of all it
/// carries, whose own are not read.
#[derive(Clone, Copy, Debug)]
pub struct OnMount;

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
