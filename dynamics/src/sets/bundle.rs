//! [`Bundle`]: references to some data of a set, taken apart member by member; [`Part`]: where a
//! member is in its set.

#![expect(clippy::inline_always, reason = "instructions are reached only in what is inlined")]

use crate::equations::joint_inputs::JointInputs;
use crate::model::mode::Mode;
use crate::model::wrench::Wrench;
use crate::numbers::real::Scalar;
use crate::sets::devices::{DeviceSet, SetInputs};
use crate::sets::enumeration::{DeviceEnum, Variant};
use crate::sets::kind_data::{KindData, KindDataMut};
use crate::sets::per_device::{Motors, PerDevice, PerJoint};

/// Where a member is in a set `W`.
pub trait Part<W: DeviceSet>: Copy {
    /// The member.
    type Of: DeviceSet<Scalar = W::Scalar>;
    /// Its part of data; none where there is no such member.
    fn of<F: PerDevice<W::Scalar>>(
        self,
        whole: &W::Per<F>,
    ) -> Option<&<Self::Of as DeviceSet>::Per<F>>;
    /// Its part of data, to be changed.
    fn of_mut<F: PerDevice<W::Scalar>>(
        self,
        whole: &mut W::Per<F>,
    ) -> Option<&mut <Self::Of as DeviceSet>::Per<F>>;
}

/// A member in a row by its number.
#[derive(Clone, Copy, Debug)]
pub struct MemberIndex(pub(crate) usize);

/// Which data of a set a visitor gets, and by which reference: [`Shared`], [`Unique`], [`Maybe`],
/// [`Given`], or a tuple of these. A bundle names the references and holds none itself.
pub trait Bundle<T: Scalar> {
    /// The references, for a set.
    type Of<'a, D: DeviceSet<Scalar = T>>;
    /// A kind's data out of an enumeration's.
    type Typed<'a, K: Variant<E>, E: DeviceEnum<Scalar = T>>;

    /// Those of one member.
    fn part<'b, 'a: 'b, W: DeviceSet<Scalar = T>, P: Part<W>>(
        data: &'b mut Self::Of<'a, W>,
        part: P,
    ) -> Option<Self::Of<'b, P::Of>>;
    /// The number of members that each of the data is of, where it is known only at run time.
    fn counts<W: DeviceSet<Scalar = T>>(data: &Self::Of<'_, W>, each: &mut impl FnMut(usize));
    /// An enumeration's data as a kind's; none where they are of another kind.
    fn get<'a, K: Variant<E>, E: DeviceEnum<Scalar = T>>(
        data: Self::Of<'a, E>,
    ) -> Option<Self::Typed<'a, K, E>>;
    /// References to them.
    fn refer<'b, K: Variant<E>, E: DeviceEnum<Scalar = T>>(
        typed: &'b mut Self::Typed<'_, K, E>,
    ) -> Self::Of<'b, K>;
    /// What was changed of copies, put back.
    fn put<K: Variant<E>, E: DeviceEnum<Scalar = T>>(typed: Self::Typed<'_, K, E>);
}

/// A [`Bundle`]: a shared reference, `&`, to the set's data of the family `F`.
#[derive(Debug)]
pub struct Shared<F>(F);

/// A [`Bundle`]: a unique reference, `&mut`, to the set's data of the family `F`.
#[derive(Debug)]
pub struct Unique<F>(F);

/// A [`Bundle`]: the references of `B`, or none.
#[derive(Debug)]
pub struct Maybe<B>(B);

/// A [`Bundle`]: shared references to the inputs of the joints, which are motor torques, modes and
/// wrenches on the bodies.
#[derive(Debug)]
pub struct Given;

impl<T: Scalar, F: PerDevice<T>> Bundle<T> for Shared<F> {
    type Of<'a, D: DeviceSet<Scalar = T>> = &'a D::Per<F>;
    type Typed<'a, K: Variant<E>, E: DeviceEnum<Scalar = T>> = KindData<'a, F::Of<K>>;

    #[inline(always)]
    fn part<'b, 'a: 'b, W: DeviceSet<Scalar = T>, P: Part<W>>(
        data: &'b mut Self::Of<'a, W>,
        part: P,
    ) -> Option<Self::Of<'b, P::Of>> {
        part.of::<F>(data)
    }

    #[inline(always)]
    fn counts<W: DeviceSet<Scalar = T>>(data: &Self::Of<'_, W>, each: &mut impl FnMut(usize)) {
        if let Some(count) = W::count::<F>(data) {
            each(count);
        }
    }

    fn get<'a, K: Variant<E>, E: DeviceEnum<Scalar = T>>(
        data: Self::Of<'a, E>,
    ) -> Option<Self::Typed<'a, K, E>> {
        E::held::<F, K>(data)
    }

    #[inline(always)]
    fn refer<'b, K: Variant<E>, E: DeviceEnum<Scalar = T>>(
        typed: &'b mut Self::Typed<'_, K, E>,
    ) -> Self::Of<'b, K> {
        typed.refer()
    }

    fn put<K: Variant<E>, E: DeviceEnum<Scalar = T>>(_: Self::Typed<'_, K, E>) {}
}

impl<T: Scalar, F: PerDevice<T>> Bundle<T> for Unique<F> {
    type Of<'a, D: DeviceSet<Scalar = T>> = &'a mut D::Per<F>;
    type Typed<'a, K: Variant<E>, E: DeviceEnum<Scalar = T>> =
        KindDataMut<'a, F::Of<K>, F::OfEnum<E>>;

    #[inline(always)]
    fn part<'b, 'a: 'b, W: DeviceSet<Scalar = T>, P: Part<W>>(
        data: &'b mut Self::Of<'a, W>,
        part: P,
    ) -> Option<Self::Of<'b, P::Of>> {
        part.of_mut::<F>(data)
    }

    #[inline(always)]
    fn counts<W: DeviceSet<Scalar = T>>(data: &Self::Of<'_, W>, each: &mut impl FnMut(usize)) {
        if let Some(count) = W::count::<F>(data) {
            each(count);
        }
    }

    fn get<'a, K: Variant<E>, E: DeviceEnum<Scalar = T>>(
        data: Self::Of<'a, E>,
    ) -> Option<Self::Typed<'a, K, E>> {
        E::held_mut::<F, K>(data)
    }

    #[inline(always)]
    fn refer<'b, K: Variant<E>, E: DeviceEnum<Scalar = T>>(
        typed: &'b mut Self::Typed<'_, K, E>,
    ) -> Self::Of<'b, K> {
        typed.refer()
    }

    fn put<K: Variant<E>, E: DeviceEnum<Scalar = T>>(typed: Self::Typed<'_, K, E>) {
        if let KindDataMut::Copied(copy, to) = typed {
            F::put::<K, E>(&copy, to);
        }
    }
}

impl<T: Scalar, B: Bundle<T>> Bundle<T> for Maybe<B> {
    type Of<'a, D: DeviceSet<Scalar = T>> = Option<B::Of<'a, D>>;
    type Typed<'a, K: Variant<E>, E: DeviceEnum<Scalar = T>> = Option<B::Typed<'a, K, E>>;

    #[inline(always)]
    fn part<'b, 'a: 'b, W: DeviceSet<Scalar = T>, P: Part<W>>(
        data: &'b mut Self::Of<'a, W>,
        part: P,
    ) -> Option<Self::Of<'b, P::Of>> {
        match data {
            Some(data) => B::part(data, part).map(Some),
            None => Some(None),
        }
    }

    #[inline(always)]
    fn counts<W: DeviceSet<Scalar = T>>(data: &Self::Of<'_, W>, each: &mut impl FnMut(usize)) {
        if let Some(data) = data {
            B::counts::<W>(data, each);
        }
    }

    fn get<'a, K: Variant<E>, E: DeviceEnum<Scalar = T>>(
        data: Self::Of<'a, E>,
    ) -> Option<Self::Typed<'a, K, E>> {
        match data {
            Some(data) => B::get::<K, E>(data).map(Some),
            None => Some(None),
        }
    }

    #[inline(always)]
    fn refer<'b, K: Variant<E>, E: DeviceEnum<Scalar = T>>(
        typed: &'b mut Self::Typed<'_, K, E>,
    ) -> Self::Of<'b, K> {
        typed.as_mut().map(B::refer::<K, E>)
    }

    fn put<K: Variant<E>, E: DeviceEnum<Scalar = T>>(typed: Self::Typed<'_, K, E>) {
        if let Some(typed) = typed {
            B::put::<K, E>(typed);
        }
    }
}

impl<T: Scalar> Bundle<T> for Given {
    type Of<'a, D: DeviceSet<Scalar = T>> = SetInputs<'a, D>;
    type Typed<'a, K: Variant<E>, E: DeviceEnum<Scalar = T>> = (
        KindData<'a, K::Motors>,
        KindData<'a, K::PerJoint<Mode<T>>>,
        Option<KindData<'a, K::PerJoint<Wrench<T>>>>,
    );

    #[inline(always)]
    fn part<'b, 'a: 'b, W: DeviceSet<Scalar = T>, P: Part<W>>(
        data: &'b mut Self::Of<'a, W>,
        part: P,
    ) -> Option<Self::Of<'b, P::Of>> {
        let bodies = match data.bodies {
            Some(bodies) => Some(part.of::<PerJoint<Wrench<T>>>(bodies)?),
            None => None,
        };
        let motors = part.of::<Motors>(data.motors)?;
        Some(JointInputs { motors, modes: part.of::<PerJoint<Mode<T>>>(data.modes)?, bodies })
    }

    #[inline(always)]
    fn counts<W: DeviceSet<Scalar = T>>(data: &Self::Of<'_, W>, each: &mut impl FnMut(usize)) {
        if let Some(count) = W::count::<Motors>(data.motors) {
            each(count);
        }
        if let Some(count) = W::count::<PerJoint<Mode<T>>>(data.modes) {
            each(count);
        }
        if let Some(bodies) = data.bodies
            && let Some(count) = W::count::<PerJoint<Wrench<T>>>(bodies)
        {
            each(count);
        }
    }

    fn get<'a, K: Variant<E>, E: DeviceEnum<Scalar = T>>(
        data: Self::Of<'a, E>,
    ) -> Option<Self::Typed<'a, K, E>> {
        let bodies = match data.bodies {
            Some(bodies) => Some(E::held::<PerJoint<Wrench<T>>, K>(bodies)?),
            None => None,
        };
        let motors = E::held::<Motors, K>(data.motors)?;
        Some((motors, E::held::<PerJoint<Mode<T>>, K>(data.modes)?, bodies))
    }

    #[inline(always)]
    fn refer<'b, K: Variant<E>, E: DeviceEnum<Scalar = T>>(
        typed: &'b mut Self::Typed<'_, K, E>,
    ) -> Self::Of<'b, K> {
        let (motors, modes, bodies) = typed;
        JointInputs {
            motors: motors.refer(),
            modes: modes.refer(),
            bodies: bodies.as_ref().map(KindData::refer),
        }
    }

    fn put<K: Variant<E>, E: DeviceEnum<Scalar = T>>(_: Self::Typed<'_, K, E>) {}
}

macro_rules! tuples {
    ($(($($bundle:ident $place:tt),*);)*) => {$(
        impl<T: Scalar, $($bundle: Bundle<T>),*> Bundle<T> for ($($bundle,)*) {
            type Of<'a, D: DeviceSet<Scalar = T>> = ($($bundle::Of<'a, D>,)*);
            type Typed<'a, K: Variant<E>, E: DeviceEnum<Scalar = T>> =
                ($($bundle::Typed<'a, K, E>,)*);

            #[inline(always)]
            fn part<'b, 'a: 'b, W: DeviceSet<Scalar = T>, P: Part<W>>(
                data: &'b mut Self::Of<'a, W>,
                part: P,
            ) -> Option<Self::Of<'b, P::Of>> {
                Some(($($bundle::part(&mut data.$place, part)?,)*))
            }

            #[inline(always)]
            fn counts<W: DeviceSet<Scalar = T>>(
                data: &Self::Of<'_, W>,
                each: &mut impl FnMut(usize),
            ) {
                $($bundle::counts::<W>(&data.$place, each);)*
            }

            fn get<'a, K: Variant<E>, E: DeviceEnum<Scalar = T>>(
                data: Self::Of<'a, E>,
            ) -> Option<Self::Typed<'a, K, E>> {
                Some(($($bundle::get::<K, E>(data.$place)?,)*))
            }

            #[inline(always)]
            fn refer<'b, K: Variant<E>, E: DeviceEnum<Scalar = T>>(
                typed: &'b mut Self::Typed<'_, K, E>,
            ) -> Self::Of<'b, K> {
                ($($bundle::refer(&mut typed.$place),)*)
            }

            fn put<K: Variant<E>, E: DeviceEnum<Scalar = T>>(typed: Self::Typed<'_, K, E>) {
                $($bundle::put::<K, E>(typed.$place);)*
            }
        }
    )*};
}

tuples! {
    (A 0, B 1);
    (A 0, B 1, C 2);
    (A 0, B 1, C 2, D0 3);
    (A 0, B 1, C 2, D0 3, E0 4);
}
