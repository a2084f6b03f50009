//! [`WithNumbers`]: a set of devices with parameters of other numbers, such as
//! [`Dual`](crate::Dual) ones, and its parameters device by device, to be changed.

use crate::equations::device::Device;
use crate::model::kind::Kind;
use crate::model::passive::Passive;
use crate::numbers::each::{Each, filled};
use crate::numbers::real::{Scalar, zero};
use crate::numbers::vec3::map;
use crate::sets::devices::{DeviceSet, Devices};

/// A set whose numbers can be converted. Implemented for every set of this crate.
pub trait WithNumbers: Devices {
    /// The same set with parameters of other numbers.
    type With<U: Scalar>: WithNumbers<Scalar = U>;

    /// The set with each number of its parameters converted.
    fn with_numbers<U: Scalar>(&self, number: impl Fn(Self::Scalar) -> U + Copy) -> Self::With<U>;
    /// The precomputed devices with each number converted.
    fn convert<U: Scalar>(
        devices: &Self::Prepared,
        number: impl Fn(Self::Scalar) -> U + Copy,
    ) -> <Self::With<U> as DeviceSet>::Prepared;
    /// Changes the parameters of each device, in order.
    fn change<C: Change<Self::Scalar>>(&mut self, change: &mut C);
}

/// What is changed of the parameters of a device.
pub trait Change<T: Scalar> {
    /// Changes them.
    fn change<K: Kind<Scalar = T>>(&mut self, device: &mut K);
}

impl<K: Kind> WithNumbers for K {
    type With<U: Scalar> = <K as Kind>::With<U>;

    fn with_numbers<U: Scalar>(
        &self,
        number: impl Fn(K::Scalar) -> U + Copy,
    ) -> <K as Kind>::With<U> {
        let empty = crate::model::kind::no_body;
        let mut bodies = <K as Kind>::With::<U>::all(empty());
        for (to, from) in bodies.values_mut().zip(self.bodies().values()) {
            to.origin = map(from.origin, number);
            to.mass = number(from.mass);
            to.centre = map(from.centre, number);
            to.inertia = from.inertia.map(number);
        }
        let none = <K as Kind>::With::<U>::all(Passive::none());
        let passive = filled(none, self.passive().values().map(|passive| passive.map(number)));
        <K as Kind>::With::<U>::of_bodies(
            &self.mount().map(number),
            &bodies,
            &passive,
            self.model(),
        )
    }

    fn convert<U: Scalar>(
        device: &Device<K>,
        number: impl Fn(K::Scalar) -> U + Copy,
    ) -> Device<<K as Kind>::With<U>> {
        let per_joint = |values: &K::PerJoint<K::Scalar>| {
            filled(<K as Kind>::With::<U>::all(zero()), values.values().map(number))
        };
        let none = <K as Kind>::With::<U>::all(Passive::none());
        Device {
            #[cfg(feature = "lanes")]
            group: None,
            mount: map(device.mount, |column| map(column, number)),
            constants: K::zip_constants(&device.constants, &device.constants, |constant, _| {
                number(constant)
            }),
            passive: filled(none, device.passive.values().map(|passive| passive.map(number))),
            bound: per_joint(&device.bound),
            free: device.free,
            lumped: device.lumped.map(|lumped| lumped.map(number)),
            excess: per_joint(&device.excess),
        }
    }

    fn change<C: Change<K::Scalar>>(&mut self, change: &mut C) {
        change.change(self);
    }
}

impl<D: WithNumbers, const N: usize> WithNumbers for [D; N] {
    type With<U: Scalar> = [D::With<U>; N];

    fn with_numbers<U: Scalar>(&self, number: impl Fn(D::Scalar) -> U + Copy) -> [D::With<U>; N] {
        self.each_ref().map(|member| member.with_numbers(number))
    }

    fn convert<U: Scalar>(
        devices: &[D::Prepared; N],
        number: impl Fn(D::Scalar) -> U + Copy,
    ) -> [<D::With<U> as DeviceSet>::Prepared; N] {
        devices.each_ref().map(|member| D::convert(member, number))
    }

    fn change<C: Change<D::Scalar>>(&mut self, change: &mut C) {
        for member in self.iter_mut() {
            member.change(change);
        }
    }
}

#[cfg(feature = "alloc")]
impl<D: WithNumbers> WithNumbers for alloc::vec::Vec<D> {
    type With<U: Scalar> = alloc::vec::Vec<D::With<U>>;

    fn with_numbers<U: Scalar>(
        &self,
        number: impl Fn(D::Scalar) -> U + Copy,
    ) -> alloc::vec::Vec<D::With<U>> {
        self.iter().map(|member| member.with_numbers(number)).collect()
    }

    fn convert<U: Scalar>(
        devices: &alloc::vec::Vec<D::Prepared>,
        number: impl Fn(D::Scalar) -> U + Copy,
    ) -> alloc::vec::Vec<<D::With<U> as DeviceSet>::Prepared> {
        devices.iter().map(|member| D::convert(member, number)).collect()
    }

    fn change<C: Change<D::Scalar>>(&mut self, change: &mut C) {
        for member in self.iter_mut() {
            member.change(change);
        }
    }
}

impl<D: WithNumbers> WithNumbers for Option<D> {
    type With<U: Scalar> = Option<D::With<U>>;

    fn with_numbers<U: Scalar>(
        &self,
        number: impl Fn(D::Scalar) -> U + Copy,
    ) -> Option<D::With<U>> {
        self.as_ref().map(|member| member.with_numbers(number))
    }

    fn convert<U: Scalar>(
        devices: &Option<D::Prepared>,
        number: impl Fn(D::Scalar) -> U + Copy,
    ) -> Option<<D::With<U> as DeviceSet>::Prepared> {
        devices.as_ref().map(|member| D::convert(member, number))
    }

    fn change<C: Change<D::Scalar>>(&mut self, change: &mut C) {
        for member in self.iter_mut() {
            member.change(change);
        }
    }
}

macro_rules! tuples {
    ($($first:ident $($member:ident $place:tt)*;)*) => {$(
        impl<$first: WithNumbers, $($member: WithNumbers<Scalar = $first::Scalar>),*> WithNumbers
            for ($first, $($member,)*)
        {
            type With<Z: Scalar> = ($first::With<Z>, $($member::With<Z>,)*);

            fn with_numbers<Z: Scalar>(
                &self,
                number: impl Fn($first::Scalar) -> Z + Copy,
            ) -> Self::With<Z> {
                (self.0.with_numbers(number), $(self.$place.with_numbers(number),)*)
            }

            fn convert<Z: Scalar>(
                devices: &Self::Prepared,
                number: impl Fn($first::Scalar) -> Z + Copy,
            ) -> <Self::With<Z> as DeviceSet>::Prepared {
                ($first::convert(&devices.0, number), $($member::convert(&devices.$place, number),)*)
            }

            fn change<Y: Change<$first::Scalar>>(&mut self, change: &mut Y) {
                self.0.change(change);
                $(self.$place.change(change);)*
            }
        }
    )*};
}

tuples! {
    A;
    A B 1;
    A B 1 C 2;
    A B 1 C 2 D 3;
    A B 1 C 2 D 3 E 4;
    A B 1 C 2 D 3 E 4 F 5;
    A B 1 C 2 D 3 E 4 F 5 G 6;
    A B 1 C 2 D 3 E 4 F 5 G 6 H 7;
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Dual, ReactionWheel, Sgcmg, SloshMass};
    use nalgebra::Matrix3;

    /// Counts the devices that it is shown.
    struct Count(usize);

    impl<T: Scalar> Change<T> for Count {
        fn change<K: Kind<Scalar = T>>(&mut self, device: &mut K) {
            device.passive_mut().values_mut().for_each(|passive| passive.rest = zero());
            self.0 += 1;
        }
    }

    #[test]
    fn a_set_with_other_numbers_has_its_values() {
        let inertia = Matrix3::new(0.2, 0.01, 0.02, 0.01, 0.1, 0.03, 0.02, 0.03, 0.15);
        let mut wheel = ReactionWheel { d: 1e-3, ..ReactionWheel::bare_wheel(4.0, inertia) };
        wheel.passive.wheel = Passive::friction(0.1, 0.2, 0.3);
        let set =
            ([wheel; 2], Some(Sgcmg::bare_wheel(3.0, inertia)), SloshMass::bare_slosh_mass(7.0));
        let mut dual = set.with_numbers(Dual::<f64, 2>::constant);
        assert_eq!(dual.with_numbers(|number| number.value), set);
        let mut count = Count(0);
        dual.change(&mut count);
        assert_eq!(count.0, 4);
    }
}
