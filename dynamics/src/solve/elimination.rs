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
use crate::equations::system::Solution;
use crate::generated::hub::BodyAcceleration;
use crate::isolation::carrier::Carrying;
use crate::model::kind::Kind;
use crate::numbers::each::Each;
use crate::numbers::real::Scalar;
use crate::sets::bundle::{Bundle, Given, Shared, Unique};
use crate::sets::counts::compare_counts;
use crate::sets::devices::{DeviceSet, Visit};
use crate::sets::isolated::{Isolated, PreparedIsolated, parts};
use crate::sets::per_device as data;

/// State and inputs of the joints, and the gains that come of them.
pub(crate) type Eliminated = (Shared<data::Joints>, Given, Unique<data::Gains>);

/// How the joints of one device are eliminated.
pub(crate) trait Eliminate<T: Scalar>: Copy {
    /// Eliminates them, adds what is left to the hub's system.
    fn eliminate<K: Kind<Scalar = T>>(
        self,
        of: DeviceElimination<'_, K>,
    ) -> Result<(), SolveError<T>>;
}

impl<T: Scalar> Eliminate<T> for Arithmetic {
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
}

impl<T: Scalar, E: Eliminate<T>> Visit<T, Eliminated> for Elimination<'_, T, E> {
    type Error = SolveError<T>;

    #[inline(always)]
    fn visit<K: Kind<Scalar = T>>(
        &mut self,
        device: &Device<K>,
        (joints, given, gains): <Eliminated as Bundle<T>>::Of<'_, K>,
    ) -> Result<(), SolveError<T>> {
        let Self { environment, assembly, device: index, by } = self;
        let index = core::mem::replace(index, index.wrapping_add(1));
        let of = DeviceElimination { device, index, joints, given, environment, assembly, gains };
        by.eliminate(of)
    }

    /// Here, not by a visit of its own: that would convert the data of a list once more.
    #[inline(always)]
    fn compare(&mut self, expected: usize, found: usize) -> Result<(), SolveError<T>> {
        compare_counts(expected, found)
    }

    fn visit_isolated<D: DeviceSet<Scalar = T>>(
        &mut self,
        isolated: &PreparedIsolated<D>,
        (joints, given, gains): <Eliminated as Bundle<T>>::Of<'_, Isolated<D>>,
    ) -> Result<(), SolveError<T>> {
        let index = self.device;
        let mut carrying =
            Carrying::start(&isolated.carrier, index, &joints.platform, self.environment);
        let mut outboard = Elimination {
            environment: &carrying.environment,
            assembly: &mut carrying.assembly,
            device: index.wrapping_add(1),
            by: self.by,
        };
        let (of_platform, of_carried) = parts::<D>(given);
        let data = (&joints.carried, of_carried, &mut gains.carried);
        D::visit::<Eliminated, _>(&isolated.carried, data, &mut outboard)?;
        self.device = outboard.device;
        gains.platform = Some(carrying.finish(of_platform, self.assembly)?);
        Ok(())
    }
}

/// The gains, and the accelerations that come of them.
pub(crate) type Substituted = (Shared<data::Gains>, Unique<data::Accelerations>);

/// The joints' accelerations once the hub's are known.
pub(crate) struct BackSubstitution<T> {
    hub: BodyAcceleration<T>,
    /// Whether all so far are finite.
    finite: bool,
}

impl<T: Copy> BackSubstitution<T> {
    /// On a base with these accelerations.
    pub(crate) fn on(base: &Solution<T>) -> Self {
        Self { hub: base.expressed_in_b(), finite: true }
    }
}

impl<T: Scalar> Visit<T, Substituted> for BackSubstitution<T> {
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
        }
        Ok(())
    }

    fn visit_isolated<D: DeviceSet<Scalar = T>>(
        &mut self,
        isolated: &PreparedIsolated<D>,
        (gains, out): <Substituted as Bundle<T>>::Of<'_, Isolated<D>>,
    ) -> Result<(), Infallible> {
        let Some(of_platform) = &gains.platform else { return Ok(()) };
        let (joints, [r_b_n_ddot, omega_dot]) = of_platform.outward(&self.hub);
        self.finite &= joints.values().all(Scalar::is_finite);
        out.platform = joints;
        let platform = Solution { r_b_n_ddot, omega_dot };
        self.finite &=
            back_substitute::<D>(&isolated.carried, &gains.carried, &platform, &mut out.carried);
        Ok(())
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
    let mut substitution = BackSubstitution::on(hub);
    let Ok(()) = D::visit::<Substituted, _>(devices, (gains, out), &mut substitution);
    substitution.finite
}
