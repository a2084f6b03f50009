//! Sets of different members: tuples.

use crate::model::kind::JointInfo;
use crate::numbers::real::Scalar;
use crate::sets::bundle::{Bundle, Part};
use crate::sets::devices::{DeviceSet, FixedSet, List, Visit};
use crate::sets::per_device::PerDevice;
use crate::validation::parameter_error::ParameterError;

/// A member by its place.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place<const PLACE: usize>;

/// One member of a tuple: `$member` at `$place` of `$all`.
macro_rules! part {
    ([$($all:ident)*] $member:ident $place:tt) => {
        impl<Z: Scalar, $($all: DeviceSet<Scalar = Z>),*> Part<($($all,)*)> for Place<$place> {
            type Of = $member;

            #[inline(always)]
            fn of<Y: PerDevice<Z>>(self, whole: &($($all::Per<Y>,)*)) -> Option<&$member::Per<Y>> {
                Some(&whole.$place)
            }

            #[inline(always)]
            fn of_mut<Y: PerDevice<Z>>(
                self,
                whole: &mut ($($all::Per<Y>,)*),
            ) -> Option<&mut $member::Per<Y>> {
                Some(&mut whole.$place)
            }
        }
    };
}

macro_rules! tuples {
    ($($all:tt $first:ident $($member:ident $place:tt)*;)*) => {$(
        part!($all $first 0);
        $(part!($all $member $place);)*

        impl<$first: DeviceSet, $($member: DeviceSet<Scalar = $first::Scalar>),*> DeviceSet
            for ($first, $($member,)*)
        {
            type Scalar = $first::Scalar;
            type Prepared = ($first::Prepared, $($member::Prepared,)*);
            type Per<Y: PerDevice<Self::Scalar>> = ($first::Per<Y>, $($member::Per<Y>,)*);

            fn check(&self, device: &mut usize) -> Result<(), ParameterError<Self::Scalar>> {
                self.0.check(device)?;
                $(self.$place.check(device)?;)*
                Ok(())
            }

            fn prepare(&self) -> Self::Prepared {
                (self.0.prepare(), $(self.$place.prepare(),)*)
            }

            fn new_data<Y: PerDevice<Self::Scalar>>(
                devices: &Self::Prepared,
                family: &Y,
            ) -> Self::Per<Y> {
                ($first::new_data(&devices.0, family), $($member::new_data(&devices.$place, family),)*)
            }

            fn list<L: List<Self::Scalar>>(
                devices: &Self::Prepared,
            ) -> impl Iterator<Item = L::Item> {
                $first::list::<L>(&devices.0)$(.chain($member::list::<L>(&devices.$place)))*
            }

            #[inline(always)]
            fn visit<Y: Bundle<Self::Scalar>, V: Visit<Self::Scalar, Y>>(
                devices: &Self::Prepared,
                mut data: Y::Of<'_, Self>,
                visitor: &mut V,
            ) -> Result<(), V::Error> {
                if let Some(data) = Y::part::<Self, Place<0>>(&mut data, Place) {
                    $first::visit::<Y, V>(&devices.0, data, visitor)?;
                }
                $(if let Some(data) = Y::part::<Self, Place<$place>>(&mut data, Place) {
                    $member::visit::<Y, V>(&devices.$place, data, visitor)?;
                })*
                Ok(())
            }

            fn count<Y: PerDevice<Self::Scalar>>(_: &Self::Per<Y>) -> Option<usize> {
                None
            }
        }

        impl<$first: FixedSet, $($member: FixedSet<Scalar = $first::Scalar>),*> FixedSet
            for ($first, $($member,)*)
        {
            fn new_fixed<Y: PerDevice<Self::Scalar>>(family: &Y) -> Self::Per<Y> {
                ($first::new_fixed(family), $($member::new_fixed(family),)*)
            }

            fn joint_infos() -> impl Iterator<Item = &'static JointInfo> {
                $first::joint_infos()$(.chain($member::joint_infos()))*
            }
        }
    )*};
}

tuples! {
    [A] A;
    [A B] A B 1;
    [A B C] A B 1 C 2;
    [A B C D] A B 1 C 2 D 3;
    [A B C D E] A B 1 C 2 D 3 E 4;
    [A B C D E F] A B 1 C 2 D 3 E 4 F 5;
    [A B C D E F G] A B 1 C 2 D 3 E 4 F 5 G 6;
    [A B C D E F G H] A B 1 C 2 D 3 E 4 F 5 G 6 H 7;
}
