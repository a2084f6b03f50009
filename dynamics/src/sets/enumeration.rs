//! [`DeviceEnum`]: an enumeration of kinds, so that a device's kind may be known only at run time,
//! without a heap. It is a set of one device.
//!
//! Data of the joints are in [`JointArray`](crate::JointArray), whatever the kind. A visitor sees
//! them in the kind's own structures, as of any other device; what it changes is put back.

use crate::equations::device::Device;
use crate::model::joint_array::MAX_JOINTS;
use crate::model::kind::Kind;
use crate::sets::bundle::Bundle;
use crate::sets::devices::{DeviceSet, List, Visit, compare};
use crate::sets::kind_data::{KindData, KindDataMut};
use crate::sets::per_device::PerDevice;

/// An enumeration of kinds. Written by [`device_enum`](crate::device_enum).
pub trait DeviceEnum: DeviceSet {
    /// What an evaluation keeps of a device from elimination to back substitution.
    type Gains: Clone + core::fmt::Debug;

    /// Does something with the device, whose kind it is.
    fn with<W: WithKind<Self>>(prepared: &Self::Prepared, with: W) -> W::Output;
    /// [`PerDevice::held`] of this enumeration.
    fn held<F: PerDevice<Self::Scalar>, K: Variant<Self>>(
        of: &Self::Per<F>,
    ) -> Option<KindData<'_, F::Of<K>>>;
    /// [`PerDevice::held_mut`] of this enumeration.
    fn held_mut<F: PerDevice<Self::Scalar>, K: Variant<Self>>(
        of: &mut Self::Per<F>,
    ) -> Option<KindDataMut<'_, F::Of<K>, F::OfEnum<Self>>>;
}

/// What is done with the device of an enumeration.
pub trait WithKind<E: DeviceEnum> {
    /// What it gives.
    type Output;
    /// Does it.
    fn with<K: Variant<E>>(self, device: &Device<K>) -> Self::Output;
}

/// A kind that an enumeration has.
pub trait Variant<E: DeviceEnum>: Kind<Scalar = E::Scalar> {
    /// The kind's gains, if they are of this kind.
    fn gains_in_enum(gains: &E::Gains) -> Option<&Option<Self::Gains<E::Scalar>>>;
    /// The kind's gains, if they are of this kind, to be written.
    fn gains_in_enum_mut(gains: &mut E::Gains) -> Option<&mut Option<Self::Gains<E::Scalar>>>;
    /// The device, if it is of this kind.
    fn device_in_enum(device: &E::Prepared) -> Option<&Device<Self>>;
    /// The device, if it is of this kind, to be written.
    fn device_in_enum_mut(device: &mut E::Prepared) -> Option<&mut Device<Self>>;
    /// The gains as the enumeration's.
    fn gains_of_enum(gains: Option<Self::Gains<E::Scalar>>) -> E::Gains;
}

/// New data of a family.
#[doc(hidden)]
#[derive(Debug)]
pub struct NewData<'a, F>(pub &'a F);

impl<E: DeviceEnum, F: PerDevice<E::Scalar>> WithKind<E> for NewData<'_, F> {
    type Output = F::OfEnum<E>;

    fn with<K: Variant<E>>(self, _: &Device<K>) -> F::OfEnum<E> {
        self.0.initial_of_enum::<K, E>()
    }
}

/// What a device lists: one entry per joint at most.
#[doc(hidden)]
#[derive(Debug)]
pub struct Listed<L>(pub core::marker::PhantomData<L>);

impl<E: DeviceEnum, L: List<E::Scalar>> WithKind<E> for Listed<L> {
    type Output = [Option<L::Item>; MAX_JOINTS];

    fn with<K: Variant<E>>(self, device: &Device<K>) -> Self::Output {
        let mut items = L::of(device);
        [(); MAX_JOINTS].map(|()| items.next())
    }
}

/// A visit by the kind's own structures.
#[doc(hidden)]
#[expect(missing_debug_implementations, reason = "what it refers to may have none")]
pub struct Visited<'a, 'd, E: DeviceEnum, B: Bundle<E::Scalar>, V> {
    pub data: B::Of<'d, E>,
    pub visitor: &'a mut V,
}

impl<E: DeviceEnum, B: Bundle<E::Scalar>, V: Visit<E::Scalar, B>> WithKind<E>
    for Visited<'_, '_, E, B, V>
{
    type Output = Result<(), V::Error>;

    fn with<K: Variant<E>>(self, device: &Device<K>) -> Self::Output {
        let Self { data, visitor } = self;
        compare::<E, B, V>(K::JOINTS.len(), &data, visitor)?;
        let Some(mut typed) = B::get::<K, E>(data) else { return Ok(()) };
        visitor.visit(device, B::refer::<K, E>(&mut typed))?;
        B::put::<K, E>(typed);
        Ok(())
    }
}

/// Enumerates kinds, also of other crates, so that a device's kind may be known only at run time:
/// the enumeration is a set of one device, as [`BuiltIn`](crate::BuiltIn) is of this crate's kinds.
///
/// ```
/// use precess_dynamics::{ReactionWheel, Sgcmg, device_enum};
///
/// device_enum! {
///     /// What the catalogue has.
///     pub enum Catalogue { ReactionWheel, Sgcmg }
///     prepared PreparedCatalogue;
///     gains CatalogueGains;
/// }
///
/// # use nalgebra::Matrix3;
/// let wheel = ReactionWheel::bare_wheel(4.0, Matrix3::identity());
/// let gyro = Sgcmg::bare_wheel(4.0, Matrix3::identity());
/// let list: [Catalogue; 2] = [wheel.into(), gyro.into()];
/// # let hub = precess_dynamics::Hub {
/// #     m_b: 50.0,
/// #     r_bc_b: Default::default(),
/// #     i_b_bc: Matrix3::identity(),
/// # };
/// let craft = precess_dynamics::Spacecraft::new(&hub, &list)?;
/// let names: Vec<_> = craft.joints().map(|(device, joint)| (device, joint.coordinate)).collect();
/// assert_eq!(names, [(0, "theta"), (1, "gamma"), (1, "theta")]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[macro_export]
macro_rules! device_enum {
    (
        $(#[$attribute:meta])*
        $vis:vis enum $name:ident { $($kind:ident),* $(,)? }
        prepared $prepared:ident;
        gains $gains:ident;
    ) => {
        $(#[$attribute])*
        #[derive(Clone, Debug, PartialEq)]
        $vis enum $name<T = f64> {
            $(
                #[doc = concat!("A [`", stringify!($kind), "`].")]
                $kind($kind<T>),
            )*
        }

        #[doc = concat!("A device of [`", stringify!($name), "`], precomputed.")]
        #[derive(Clone, Debug)]
        $vis enum $prepared<T: $crate::Scalar> {
            $(
                #[doc = concat!("Of a [`", stringify!($kind), "`].")]
                $kind($crate::set::Device<$kind<T>>),
            )*
        }

        /// What an evaluation keeps of a device from elimination to back substitution.
        #[derive(Clone, Copy, Debug)]
        $vis enum $gains<T: $crate::Scalar> {
            $(
                #[doc = concat!("Of a [`", stringify!($kind), "`]; none before it is eliminated.")]
                $kind(Option<<$kind<T> as $crate::kind::Kernels>::Gains<T>>),
            )*
        }

        impl<T: $crate::Scalar> $crate::DeviceSet for $name<T> {
            type Scalar = T;
            type Prepared = $prepared<T>;
            type Per<F: $crate::set::PerDevice<T>> = F::OfEnum<Self>;

            fn check(&self, device: &mut usize) -> Result<(), $crate::ParameterError<T>> {
                match self {
                    $(Self::$kind(member) => $crate::DeviceSet::check(member, device),)*
                }
            }

            fn prepare(&self) -> $prepared<T> {
                match self {
                    $(Self::$kind(member) => $prepared::$kind($crate::DeviceSet::prepare(member)),)*
                }
            }

            fn new_data<F: $crate::set::PerDevice<T>>(
                device: &$prepared<T>,
                family: &F,
            ) -> F::OfEnum<Self> {
                <Self as $crate::set::DeviceEnum>::with(device, $crate::set::NewData(family))
            }

            fn list<L: $crate::set::List<T>>(
                device: &$prepared<T>,
            ) -> impl Iterator<Item = L::Item> {
                let listed = $crate::set::Listed::<L>(core::marker::PhantomData);
                <Self as $crate::set::DeviceEnum>::with(device, listed).into_iter().flatten()
            }

            fn visit<B: $crate::set::Bundle<T>, V: $crate::set::Visit<T, B>>(
                device: &$prepared<T>,
                data: B::Of<'_, Self>,
                visitor: &mut V,
            ) -> Result<(), V::Error> {
                visitor.visit_enum::<Self>(device, data)
            }

            fn count<F: $crate::set::PerDevice<T>>(data: &F::OfEnum<Self>) -> Option<usize> {
                F::count::<Self>(data)
            }

            fn set_groups(devices: &mut [$prepared<T>]) {
                $crate::set::set_groups_of_enum::<Self>(devices);
            }

            fn visit_row<W, B, V>(
                devices: &[$prepared<T>],
                data: &mut B::Of<'_, W>,
                first: usize,
                visitor: &mut V,
            ) -> Result<usize, V::Error>
            where
                W: $crate::DeviceSet<Scalar = T>,
                B: $crate::set::Bundle<T>,
                V: $crate::set::Visit<T, B>,
                $crate::set::MemberIndex: $crate::set::Part<W, Of = Self>,
            {
                visitor.visit_row_of_enum::<Self, W>(devices, data, first)
            }
        }

        impl<T: $crate::Scalar> $crate::set::WithNumbers for $name<T> {
            type With<U: $crate::Scalar> = $name<U>;

            fn with_numbers<U: $crate::Scalar>(
                &self,
                number: impl Fn(T) -> U + Copy,
            ) -> $name<U> {
                match self {
                    $(Self::$kind(member) => {
                        $name::$kind($crate::set::WithNumbers::with_numbers(member, number))
                    })*
                }
            }

            fn convert<U: $crate::Scalar>(
                device: &$prepared<T>,
                number: impl Fn(T) -> U + Copy,
            ) -> $prepared<U> {
                match device {
                    $($prepared::$kind(device) => $prepared::$kind(
                        <$kind<T> as $crate::set::WithNumbers>::convert(device, number),
                    ),)*
                }
            }

            fn change<C: $crate::set::Change<T>>(&mut self, change: &mut C) {
                match self {
                    $(Self::$kind(member) => $crate::set::Change::change(change, member),)*
                }
            }
        }

        impl<T: $crate::Scalar> $crate::set::DeviceEnum for $name<T> {
            type Gains = $gains<T>;

            fn with<W: $crate::set::WithKind<Self>>(device: &$prepared<T>, with: W) -> W::Output {
                match device {
                    $($prepared::$kind(device) => with.with(device),)*
                }
            }

            fn held<F: $crate::set::PerDevice<T>, K: $crate::set::Variant<Self>>(
                of: &F::OfEnum<Self>,
            ) -> Option<$crate::set::KindData<'_, F::Of<K>>> {
                F::held::<K, Self>(of)
            }

            fn held_mut<F: $crate::set::PerDevice<T>, K: $crate::set::Variant<Self>>(
                of: &mut F::OfEnum<Self>,
            ) -> Option<$crate::set::KindDataMut<'_, F::Of<K>, F::OfEnum<Self>>> {
                F::held_mut::<K, Self>(of)
            }
        }

        $(
            const _: () = assert!(
                <$kind as $crate::kind::Kind>::JOINTS.len() <= $crate::MAX_JOINTS,
                "a device of an enumeration has at most MAX_JOINTS joints; one of a tuple or an \
                 array may have more"
            );

            impl<T: $crate::Scalar> From<$kind<T>> for $name<T> {
                fn from(device: $kind<T>) -> Self {
                    Self::$kind(device)
                }
            }

            impl<T: $crate::Scalar> $crate::set::Variant<$name<T>> for $kind<T> {
                fn gains_in_enum(
                    gains: &$gains<T>,
                ) -> Option<&Option<<Self as $crate::kind::Kernels>::Gains<T>>> {
                    match gains {
                        $gains::$kind(gains) => Some(gains),
                        #[allow(unreachable_patterns, reason = "of one kind")]
                        _ => None,
                    }
                }

                fn gains_in_enum_mut(
                    gains: &mut $gains<T>,
                ) -> Option<&mut Option<<Self as $crate::kind::Kernels>::Gains<T>>> {
                    match gains {
                        $gains::$kind(gains) => Some(gains),
                        #[allow(unreachable_patterns, reason = "of one kind")]
                        _ => None,
                    }
                }

                fn device_in_enum(device: &$prepared<T>) -> Option<&$crate::set::Device<Self>> {
                    match device {
                        $prepared::$kind(device) => Some(device),
                        #[allow(unreachable_patterns, reason = "of one kind")]
                        _ => None,
                    }
                }

                fn device_in_enum_mut(
                    device: &mut $prepared<T>,
                ) -> Option<&mut $crate::set::Device<Self>> {
                    match device {
                        $prepared::$kind(device) => Some(device),
                        #[allow(unreachable_patterns, reason = "of one kind")]
                        _ => None,
                    }
                }

                fn gains_of_enum(
                    gains: Option<<Self as $crate::kind::Kernels>::Gains<T>>,
                ) -> $gains<T> {
                    $gains::$kind(gains)
                }
            }
        )*
    };
}
