//! [`Devices`]: what a hub carries. One device, an array, a tuple, a list: each is a set, and sets
//! nest.
//!
//! A set knows no operation. It has data of any family in its shape ([`PerDevice`]), and shows its
//! members in order to a visitor ([`Visit`]), which is what an operation is: written once, for any
//! kind. Devices known when the program is compiled cost the same wherever they are in the set: every call
//! is direct.

#![expect(clippy::inline_always, reason = "part of a visit, which is inlined into its operation")]

use core::fmt::Debug;

use crate::equations::device::Device;
use crate::equations::joint_inputs::JointInputs;
use crate::generated::hub::ConstantShare;
use crate::isolation::carrier::Carrier;
use crate::isolation::carrier_elimination::CarrierConstants;
use crate::model::kind::{JointInfo, Kind};
use crate::model::mode::Mode;
use crate::model::passive::Passive;
use crate::model::wrench::Wrench;
use crate::numbers::each::{Each, JointStates, Value};
use crate::numbers::real::Scalar;
use crate::sets::bundle::{Bundle, MemberIndex, Part};
use crate::sets::carrying::{Carrying, PreparedCarrying, only_mass};
use crate::sets::enumeration::{DeviceEnum, Visited};
use crate::sets::per_device::{Accelerations, Joints, Loads, Motors, OnMount, PerDevice, PerJoint};
use crate::validation::parameter_error::ParameterError;

/// A set of devices, by their parameters.
///
/// Implemented for every [`Kind`], for [`BuiltIn`](crate::BuiltIn), and for arrays, tuples (up to
/// eight members), options and, with the feature `alloc`, vectors of sets. Devices count from 0
/// through the whole set, in order.
pub trait DeviceSet: Clone + Debug + PartialEq + 'static {
    /// The number type.
    type Scalar: Scalar;
    /// The devices, checked and precomputed.
    type Prepared: Clone + Debug;
    /// Data of a family, in the shape of the set.
    type Per<F: PerDevice<Self::Scalar>>;

    /// Checks the parameters; `device` counts.
    ///
    /// # Errors
    /// The first [`ParameterError`].
    fn check(&self, device: &mut usize) -> Result<(), ParameterError<Self::Scalar>>;
    /// The devices, precomputed: what depends only on parameters, computed.
    fn prepare(&self) -> Self::Prepared;
    /// The same for a single evaluation, in which groups of members in a row cost more than they save.
    fn prepare_alone(&self) -> Self::Prepared {
        self.prepare()
    }
    /// New data of a family for these devices.
    fn new_data<F: PerDevice<Self::Scalar>>(devices: &Self::Prepared, family: &F) -> Self::Per<F>;
    /// What each device lists, in order.
    fn list<L: List<Self::Scalar>>(devices: &Self::Prepared) -> impl Iterator<Item = L::Item>;
    /// Shows each device in order, with its part of some data.
    ///
    /// # Errors
    /// The visitor's first.
    fn visit<B: Bundle<Self::Scalar>, V: Visit<Self::Scalar, B>>(
        devices: &Self::Prepared,
        data: B::Of<'_, Self>,
        visitor: &mut V,
    ) -> Result<(), V::Error>;
    /// The number of members that data are of, where that is known only at run time.
    fn count<F: PerDevice<Self::Scalar>>(data: &Self::Per<F>) -> Option<usize>;
    /// Groups members in a row that are evaluated side by side: devices of one kind, with the feature
    /// `lanes`.
    fn set_groups(_: &mut [Self::Prepared]) {}
    /// Shows members in a row of the set `W`, with their parts of its data: the first of `devices`,
    /// whose number is `first`, or several from it on. Returns how many.
    ///
    /// # Errors
    /// The visitor's first.
    #[inline(always)]
    fn visit_row<W, B, V>(
        devices: &[Self::Prepared],
        data: &mut B::Of<'_, W>,
        first: usize,
        visitor: &mut V,
    ) -> Result<usize, V::Error>
    where
        W: DeviceSet<Scalar = Self::Scalar>,
        B: Bundle<Self::Scalar>,
        V: Visit<Self::Scalar, B>,
        MemberIndex: Part<W, Of = Self>,
    {
        if let (Some(device), Some(data)) =
            (devices.first(), B::part::<W, MemberIndex>(data, MemberIndex(first)))
        {
            Self::visit::<B, V>(device, data, visitor)?;
        }
        Ok(1)
    }
}

/// What is done with each device of a set and its part of some data.
pub trait Visit<T: Scalar, B: Bundle<T>> {
    /// Why it ends early.
    type Error;
    /// Does it with one device.
    ///
    /// # Errors
    /// Ends the visit.
    fn visit<K: Kind<Scalar = T>>(
        &mut self,
        device: &Device<K>,
        data: B::Of<'_, K>,
    ) -> Result<(), Self::Error>;
    /// Does it with a device of an enumeration. Here by the structures of its kind; an operation that
    /// is the same for every kind need not convert the data to them.
    ///
    /// # Errors
    /// Ends the visit.
    fn visit_enum<E: DeviceEnum<Scalar = T> + Devices>(
        &mut self,
        device: &E::Prepared,
        data: B::Of<'_, E>,
    ) -> Result<(), Self::Error>
    where
        Self: Sized,
    {
        E::with(device, Visited::<E, B, Self> { data, visitor: self })
    }
    /// Does it with a carrier and the devices that it carries. Here one after another, as with
    /// devices on the hub: right of what does not depend on the motion of a device's base.
    ///
    /// # Errors
    /// Ends the visit.
    fn visit_carrying<C: Carrier<Scalar = T>, D: DeviceSet<Scalar = T>>(
        &mut self,
        carrying: &PreparedCarrying<C, D>,
        data: B::Of<'_, Carrying<C, D>>,
    ) -> Result<(), Self::Error>
    where
        Self: Sized,
    {
        carrying.visit_members::<B, Self>(data, self)
    }
    /// Whether members in a row are shown by [`Self::visit_row`].
    const ROWS: bool = false;
    /// Does it with devices of one kind in a row of the set `W`: the first of them, whose number is
    /// `first`, or several from it on. Returns how many.
    ///
    /// # Errors
    /// Ends the visit.
    fn visit_row<K: Kind<Scalar = T>, W: DeviceSet<Scalar = T>>(
        &mut self,
        devices: &[Device<K>],
        data: &mut B::Of<'_, W>,
        first: usize,
    ) -> Result<usize, Self::Error>
    where
        MemberIndex: Part<W, Of = K>,
    {
        if let (Some(device), Some(data)) =
            (devices.first(), B::part::<W, MemberIndex>(data, MemberIndex(first)))
        {
            self.visit(device, data)?;
        }
        Ok(1)
    }
    /// The same with devices of an enumeration.
    ///
    /// # Errors
    /// Ends the visit.
    fn visit_row_of_enum<E: DeviceEnum<Scalar = T> + Devices, W: DeviceSet<Scalar = T>>(
        &mut self,
        devices: &[E::Prepared],
        data: &mut B::Of<'_, W>,
        first: usize,
    ) -> Result<usize, Self::Error>
    where
        Self: Sized,
        MemberIndex: Part<W, Of = E>,
    {
        if let (Some(device), Some(data)) =
            (devices.first(), B::part::<W, MemberIndex>(data, MemberIndex(first)))
        {
            self.visit_enum::<E>(device, data)?;
        }
        Ok(1)
    }
    /// Called with the number of members of the set and that of a part of the data; accepts any here.
    ///
    /// # Errors
    /// Ends the visit.
    fn compare(&mut self, _expected: usize, _found: usize) -> Result<(), Self::Error> {
        Ok(())
    }
}

/// What can be listed of every device.
pub trait List<T: Scalar> {
    /// One entry: of a device, or of a joint.
    type Item;
    /// The entries of one device.
    fn of<K: Kind<Scalar = T>>(device: &Device<K>) -> impl Iterator<Item = Self::Item>;
    /// The entries of a carrier, without what it carries.
    fn of_carrier<C: Carrier<Scalar = T>>(
        carrier: &CarrierConstants<C>,
    ) -> impl Iterator<Item = Self::Item> {
        Self::of(&carrier.device)
    }
    /// What the entry of a device is for the base of the carrier of it.
    #[must_use]
    fn on_carrier(item: Self::Item) -> Self::Item {
        item
    }
}

/// [`DeviceSet`], with what its data of the families used everywhere can do.
///
/// Implemented for every [`DeviceSet`].
pub trait Devices:
    DeviceSet<
        Per<Joints>: JointStates<<Self as DeviceSet>::Scalar>,
        Per<Motors>: Each<<Self as DeviceSet>::Scalar>,
        Per<Accelerations>: Each<<Self as DeviceSet>::Scalar>,
        Per<PerJoint<Mode<<Self as DeviceSet>::Scalar>>>: Each<Mode<<Self as DeviceSet>::Scalar>>,
        Per<PerJoint<Wrench<<Self as DeviceSet>::Scalar>>>: Each<
            Wrench<<Self as DeviceSet>::Scalar>,
        >,
        Per<PerJoint<[<Self as DeviceSet>::Scalar; 2]>>: Each<[<Self as DeviceSet>::Scalar; 2]>,
        Per<Loads>: Clone + Debug + PartialEq,
        Per<OnMount>: Clone + Debug,
    >
{
}

impl<D> Devices for D where
    D: DeviceSet<
            Per<Joints>: JointStates<<D as DeviceSet>::Scalar>,
            Per<Motors>: Each<<D as DeviceSet>::Scalar>,
            Per<Accelerations>: Each<<D as DeviceSet>::Scalar>,
            Per<PerJoint<Mode<<D as DeviceSet>::Scalar>>>: Each<Mode<<D as DeviceSet>::Scalar>>,
            Per<PerJoint<Wrench<<D as DeviceSet>::Scalar>>>: Each<Wrench<<D as DeviceSet>::Scalar>>,
            Per<PerJoint<[<D as DeviceSet>::Scalar; 2]>>: Each<[<D as DeviceSet>::Scalar; 2]>,
            Per<Loads>: Clone + Debug + PartialEq,
            Per<OnMount>: Clone + Debug,
        >
{
}

/// A set whose number and kinds of devices are known at compile time: one device, an array, a
/// tuple.
pub trait FixedSet: Devices {
    /// New data of a family.
    fn new_fixed<F: PerDevice<Self::Scalar>>(family: &F) -> Self::Per<F>;
    /// The joints in order.
    fn joint_infos() -> impl Iterator<Item = &'static JointInfo>;
    /// All coordinates and rates zero.
    #[must_use]
    fn at_rest() -> Self::Per<Joints> {
        Self::new_fixed(&Joints)
    }
    /// All motors off.
    #[must_use]
    fn motors_off() -> Self::Per<Motors> {
        Self::new_fixed(&Motors)
    }
    /// One value at every joint.
    fn all<V: Value>(value: V) -> Self::Per<PerJoint<V>> {
        Self::new_fixed(&PerJoint(value))
    }
    /// The modes that the kinds have by themselves.
    fn modes() -> Self::Per<PerJoint<Mode<Self::Scalar>>> {
        let mut modes = Self::all(Mode::Driven);
        set_own_modes(&mut modes, Self::joint_infos());
        modes
    }
}

/// What is given of the joints of a set.
pub(crate) type SetInputs<'a, D> = JointInputs<
    'a,
    <D as DeviceSet>::Per<Motors>,
    <D as DeviceSet>::Per<PerJoint<Mode<<D as DeviceSet>::Scalar>>>,
    <D as DeviceSet>::Per<PerJoint<Wrench<<D as DeviceSet>::Scalar>>>,
>;

/// The constant share of the hub, of each device.
pub(crate) struct ConstantShares;

/// The joints.
pub(crate) struct JointInfos;

/// By how much the inertia of each body breaks the triangle inequality, kg m².
pub(crate) struct TriangleExcesses;

/// Spring, damper and friction of each joint.
pub(crate) struct Passives;

/// Whether the imbalance of each device is lumped.
#[cfg(feature = "lanes")]
pub(crate) struct AreLumped;

impl<T: Scalar> List<T> for ConstantShares {
    type Item = ConstantShare<T>;

    fn of<K: Kind<Scalar = T>>(device: &Device<K>) -> impl Iterator<Item = ConstantShare<T>> {
        core::iter::once(K::constant_share(&device.constants))
    }

    fn on_carrier(share: ConstantShare<T>) -> ConstantShare<T> {
        only_mass(share)
    }
}

impl<T: Scalar> List<T> for JointInfos {
    type Item = &'static JointInfo;

    fn of<K: Kind<Scalar = T>>(_: &Device<K>) -> impl Iterator<Item = &'static JointInfo> {
        K::JOINTS.iter()
    }
}

impl<T: Scalar> List<T> for TriangleExcesses {
    type Item = T;

    fn of<K: Kind<Scalar = T>>(device: &Device<K>) -> impl Iterator<Item = T> {
        device.excess.values()
    }
}

impl<T: Scalar> List<T> for Passives {
    type Item = Passive<T>;

    fn of<K: Kind<Scalar = T>>(device: &Device<K>) -> impl Iterator<Item = Passive<T>> {
        device.passive.values()
    }

    /// With the diagonals that bound its suspension.
    fn of_carrier<C: Carrier<Scalar = T>>(
        carrier: &CarrierConstants<C>,
    ) -> impl Iterator<Item = Passive<T>> {
        let [damping, stiffness] = C::diagonals(&carrier.suspension, None);
        let joints = carrier.device.passive.values().zip(damping.into_iter().zip(stiffness));
        joints.map(|(passive, (c, k))| Passive {
            viscous: passive.viscous + c,
            stiffness: passive.stiffness + k,
            ..passive
        })
    }
}

#[cfg(feature = "lanes")]
impl<T: Scalar> List<T> for AreLumped {
    type Item = bool;

    fn of<K: Kind<Scalar = T>>(device: &Device<K>) -> impl Iterator<Item = bool> {
        core::iter::once(device.lumped.is_some())
    }
}

/// Tells a visitor of how many members the data are.
#[inline(always)]
pub(crate) fn compare<W: DeviceSet, B: Bundle<W::Scalar>, V: Visit<W::Scalar, B>>(
    expected: usize,
    data: &B::Of<'_, W>,
    visitor: &mut V,
) -> Result<(), V::Error> {
    let mut compared = Ok(());
    B::counts::<W>(data, &mut |found| {
        if compared.is_ok() {
            compared = visitor.compare(expected, found);
        }
    });
    compared
}

/// Writes the modes that the kinds give their joints: a result would be moved.
pub(crate) fn set_own_modes<'a, T: Scalar>(
    modes: &mut impl Each<Mode<T>>,
    infos: impl Iterator<Item = &'a JointInfo>,
) {
    for (mode, info) in modes.values_mut().zip(infos) {
        *mode = info.own_mode();
    }
}
