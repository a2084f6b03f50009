//! What an evaluation does with each device: it eliminates the joints, and finds their
//! accelerations once the hub's are known.

#![expect(clippy::inline_always, reason = "instructions are reached only in what is inlined")]

use core::convert::Infallible;

use crate::equations::arithmetic::Arithmetic;
use crate::equations::assembly::Assembly;
use crate::equations::device::Device;
use crate::equations::eliminate::DeviceElimination;
use crate::equations::error::SolveError;
use crate::equations::joint_inputs::Environment;
#[cfg(feature = "lanes")]
use crate::equations::side_by_side::gains::GroupGains;
use crate::equations::system::Solution;
use crate::generated::hub::BodyAcceleration;
use crate::isolation::carrier::Carrier;
use crate::isolation::carrier_elimination::CarrierElimination;
use crate::model::kind::Kind;
use crate::numbers::each::Each;
use crate::numbers::real::Scalar;
use crate::sets::bundle::{Bundle, Given, Shared, Unique};
#[cfg(feature = "lanes")]
use crate::sets::bundle::{MemberIndex, Part};
use crate::sets::carrying::{Carrying, PreparedCarrying, parts};
use crate::sets::counts::compare_counts;
#[cfg(feature = "lanes")]
use crate::sets::devices::Devices;
use crate::sets::devices::{DeviceSet, Visit};
#[cfg(feature = "lanes")]
use crate::sets::enumeration::DeviceEnum;
use crate::sets::per_device as data;
#[cfg(feature = "lanes")]
use crate::solve::{row_substitution, rows};

/// State and inputs of the joints, and the gains that come of them.
pub(crate) type Eliminated = (Shared<data::Joints>, Given, Unique<data::Gains>);

/// How the joints of one device are eliminated.
pub(crate) trait Eliminate<T: Scalar>: Copy {
    /// Whether devices of one kind in a row may be eliminated side by side.
    #[cfg(feature = "lanes")]
    const ROWS: bool = false;
    /// Eliminates them, adds what is left to the hub's system.
    fn eliminate<K: Kind<Scalar = T>>(
        self,
        of: DeviceElimination<'_, K>,
    ) -> Result<(), SolveError<T>>;
}

impl<T: Scalar> Eliminate<T> for Arithmetic {
    #[cfg(feature = "lanes")]
    const ROWS: bool = T::IS_F64;

    #[inline(always)]
    fn eliminate<K: Kind<Scalar = T>>(
        self,
        of: DeviceElimination<'_, K>,
    ) -> Result<(), SolveError<T>> {
        Self::eliminate(self, of)
    }
}

/// Eliminates every joint, adds what is left to the hub's system.
pub(crate) struct Elimination<'a, T, E> {
    pub(crate) environment: &'a Environment<T>,
    pub(crate) assembly: &'a mut Assembly<T>,
    /// The number of the device.
    pub(crate) device: usize,
    pub(crate) by: E,
    /// The gains of devices eliminated side by side; without, all are eliminated one after another.
    #[cfg(feature = "lanes")]
    pub(crate) groups: Option<&'a mut GroupGains>,
}

impl<'a, T, E> Elimination<'a, T, E> {
    /// One after another, from a device on.
    pub(crate) fn new(
        environment: &'a Environment<T>,
        assembly: &'a mut Assembly<T>,
        device: usize,
        by: E,
    ) -> Self {
        Self {
            environment,
            assembly,
            device,
            by,
            #[cfg(feature = "lanes")]
            groups: None,
        }
    }
}

impl<T: Scalar, E: Eliminate<T>> Visit<T, Eliminated> for Elimination<'_, T, E> {
    type Error = SolveError<T>;

    #[inline(always)]
    fn visit<K: Kind<Scalar = T>>(
        &mut self,
        device: &Device<K>,
        (joints, given, gains): <Eliminated as Bundle<T>>::Of<'_, K>,
    ) -> Result<(), SolveError<T>> {
        let Self { environment, assembly, device: index, by, .. } = self;
        let index = core::mem::replace(index, index.wrapping_add(1));
        let of = DeviceElimination { device, index, joints, given, environment, assembly, gains };
        by.eliminate(of)
    }

    #[cfg(feature = "lanes")]
    const ROWS: bool = E::ROWS;

    #[cfg(feature = "lanes")]
    #[inline(always)]
    fn visit_row<K: Kind<Scalar = T>, W: DeviceSet<Scalar = T>>(
        &mut self,
        devices: &[Device<K>],
        data: &mut <Eliminated as Bundle<T>>::Of<'_, W>,
        first: usize,
    ) -> Result<usize, SolveError<T>>
    where
        MemberIndex: Part<W, Of = K>,
    {
        rows::visit(self, devices, data, first)
    }

    #[cfg(feature = "lanes")]
    #[inline(always)]
    fn visit_row_of_enum<N: DeviceEnum<Scalar = T> + Devices, W: DeviceSet<Scalar = T>>(
        &mut self,
        devices: &[N::Prepared],
        data: &mut <Eliminated as Bundle<T>>::Of<'_, W>,
        first: usize,
    ) -> Result<usize, SolveError<T>>
    where
        MemberIndex: Part<W, Of = N>,
    {
        rows::visit_enum::<T, E, N, W>(self, devices, data, first)
    }

    /// Here, not by a visit of its own: that would convert the data of a list once more.
    #[inline(always)]
    fn compare(&mut self, expected: usize, found: usize) -> Result<(), SolveError<T>> {
        compare_counts(expected, found)
    }

    fn visit_carrying<C: Carrier<Scalar = T>, D: DeviceSet<Scalar = T>>(
        &mut self,
        carrying: &PreparedCarrying<C, D>,
        (joints, given, gains): <Eliminated as Bundle<T>>::Of<'_, Carrying<C, D>>,
    ) -> Result<(), SolveError<T>> {
        let index = self.device;
        let mut eliminating =
            CarrierElimination::start(&carrying.carrier, index, &joints.carrier, self.environment);
        let mut outboard = Elimination {
            environment: &eliminating.environment,
            assembly: &mut eliminating.assembly,
            device: index.wrapping_add(1),
            by: self.by,
            #[cfg(feature = "lanes")]
            groups: self.groups.as_deref_mut(),
        };
        let (of_carrier, of_carried) = parts::<T, C, D>(given);
        let data = (&joints.carried, of_carried, &mut gains.carried);
        D::visit::<Eliminated, _>(&carrying.carried, data, &mut outboard)?;
        self.device = outboard.device;
        gains.carrier = Some(eliminating.finish(of_carrier, self.assembly)?);
        Ok(())
    }
}

/// The gains, and the accelerations that come of them.
pub(crate) type Substituted = (Shared<data::Gains>, Unique<data::Accelerations>);

/// The joints' accelerations once the hub's are known.
pub(crate) struct BackSubstitution<'a, T> {
    pub(crate) hub: BodyAcceleration<T>,
    /// Whether all so far are finite.
    pub(crate) finite: bool,
    /// The gains of devices eliminated side by side.
    pub(crate) groups: Option<&'a mut Groups>,
}

/// The gains of devices eliminated side by side: there are none without lanes.
#[cfg(not(feature = "lanes"))]
pub(crate) type Groups = Infallible;
#[cfg(feature = "lanes")]
pub(crate) type Groups = GroupGains;

impl<T: Copy> BackSubstitution<'_, T> {
    /// On a base with these accelerations, of devices that were eliminated one after another.
    pub(crate) fn on(base: &Solution<T>) -> Self {
        Self { hub: base.expressed_in_b(), finite: true, groups: None }
    }
}

impl<T: Scalar> Visit<T, Substituted> for BackSubstitution<'_, T> {
    type Error = Infallible;

    #[inline(always)]
    fn visit<K: Kind<Scalar = T>>(
        &mut self,
        _: &Device<K>,
        (gains, out): <Substituted as Bundle<T>>::Of<'_, K>,
    ) -> Result<(), Infallible> {
        if let Some(gains) = gains {
            *out = K::back_substitute(gains, &self.hub);
            self.finite &= out.values().all(Scalar::is_finite);
        } else {
            // A device that was not eliminated has its gains in a group, or none.
            self.finite &= self.groups.is_some();
        }
        Ok(())
    }

    fn visit_carrying<C: Carrier<Scalar = T>, D: DeviceSet<Scalar = T>>(
        &mut self,
        carrying: &PreparedCarrying<C, D>,
        (gains, out): <Substituted as Bundle<T>>::Of<'_, Carrying<C, D>>,
    ) -> Result<(), Infallible> {
        let Some(of_carrier) = &gains.carrier else {
            self.finite = false;
            return Ok(());
        };
        let (joints, [r_b_n_ddot, omega_dot]) = C::outward(of_carrier, &self.hub);
        self.finite &= joints.values().all(Scalar::is_finite);
        out.carrier = joints;
        let base = Solution { r_b_n_ddot, omega_dot };
        let (groups, carried) = (self.groups.as_deref_mut(), &carrying.carried);
        let out = &mut out.carried;
        self.finite &= substitute::<D>(carried, &gains.carried, &base, out, groups);
        Ok(())
    }

    #[cfg(feature = "lanes")]
    const ROWS: bool = T::IS_F64;

    #[cfg(feature = "lanes")]
    #[inline(always)]
    fn visit_row<K: Kind<Scalar = T>, W: DeviceSet<Scalar = T>>(
        &mut self,
        devices: &[Device<K>],
        data: &mut <Substituted as Bundle<T>>::Of<'_, W>,
        first: usize,
    ) -> Result<usize, Infallible>
    where
        MemberIndex: Part<W, Of = K>,
    {
        row_substitution::visit(self, devices, data, first)
    }

    #[cfg(feature = "lanes")]
    #[inline(always)]
    fn visit_row_of_enum<N: DeviceEnum<Scalar = T> + Devices, W: DeviceSet<Scalar = T>>(
        &mut self,
        devices: &[N::Prepared],
        data: &mut <Substituted as Bundle<T>>::Of<'_, W>,
        first: usize,
    ) -> Result<usize, Infallible>
    where
        MemberIndex: Part<W, Of = N>,
    {
        row_substitution::visit_enum::<T, N, W>(self, devices, data, first)
    }
}

/// Writes the accelerations of every device's joints; whether all are finite.
#[inline(always)]
pub(crate) fn back_substitute<D: DeviceSet>(
    devices: &D::Prepared,
    gains: &D::Per<data::Gains>,
    hub: &Solution<D::Scalar>,
    out: &mut D::Per<data::Accelerations>,
) -> bool {
    substitute::<D>(devices, gains, hub, out, None)
}

/// The same where devices were eliminated side by side.
#[inline(always)]
pub(crate) fn substitute<D: DeviceSet>(
    devices: &D::Prepared,
    gains: &D::Per<data::Gains>,
    hub: &Solution<D::Scalar>,
    out: &mut D::Per<data::Accelerations>,
    groups: Option<&mut Groups>,
) -> bool {
    let mut substitution = BackSubstitution { groups, ..BackSubstitution::on(hub) };
    let Ok(()) = D::visit::<Substituted, _>(devices, (gains, out), &mut substitution);
    substitution.finite
}
