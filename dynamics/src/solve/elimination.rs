//! What an evaluation does with each device: it eliminates the joints, and finds their
//! accelerations once the hub's are known.

#![expect(
    clippy::inline_always,
    reason = "fused numbers reach their instruction only where inlined"
)]

use core::convert::Infallible;
use core::marker::PhantomData;

use crate::equations::arithmetic::{EliminationOutputs, Rounding};
use crate::equations::assembly::Assembly;
use crate::equations::device::Device;
use crate::equations::error::SolveError;
use crate::equations::joint_inputs::Environment;
use crate::equations::system::Solution;
use crate::generated::hub::BodyAcceleration;
use crate::model::kind::Kind;
use crate::numbers::real::Scalar;
use crate::sets::bundle::{Bundle, Given, Shared, Unique};
use crate::sets::devices::{DeviceSet, Visit};
use crate::sets::per_device as data;

/// State and inputs of the joints, and the gains that come of them.
pub(crate) type Eliminated = (Shared<data::Joints>, Given, Unique<data::Gains>);

/// Eliminates every joint, adds what is left to the hub's system.
pub(crate) struct Elimination<'a, T, W> {
    pub(crate) environment: &'a Environment<T>,
    pub(crate) assembly: &'a mut Assembly<T>,
    /// The number of the device.
    pub(crate) device: usize,
    pub(crate) rounding: PhantomData<W>,
}

impl<T: Scalar, W: Rounding> Visit<T, Eliminated> for Elimination<'_, T, W> {
    type Error = SolveError<T>;

    #[inline(always)]
    fn visit<K: Kind<Scalar = T>>(
        &mut self,
        device: &Device<K>,
        (joints, given, gains): <Eliminated as Bundle<T>>::Of<'_, K>,
    ) -> Result<(), SolveError<T>> {
        let Self { environment, assembly, device: index, .. } = self;
        let outputs = EliminationOutputs { assembly, gains };
        W::eliminate_device(device, joints, given, environment, outputs, *index)?;
        *index = index.wrapping_add(1);
        Ok(())
    }
}

/// The gains, and the accelerations that come of them.
type Substituted = (Shared<data::Gains>, Unique<data::Accelerations>);

/// The joints' accelerations once the hub's are known.
struct BackSubstitution<T>(BodyAcceleration<T>);

impl<T: Scalar> Visit<T, Substituted> for BackSubstitution<T> {
    type Error = Infallible;

    #[inline(always)]
    fn visit<K: Kind<Scalar = T>>(
        &mut self,
        _: &Device<K>,
        (gains, out): <Substituted as Bundle<T>>::Of<'_, K>,
    ) -> Result<(), Infallible> {
        if let Some(gains) = gains {
            *out = K::back_substitute(gains, &self.0);
        }
        Ok(())
    }
}

/// The accelerations of every device's joints.
#[inline(always)]
pub(crate) fn back_substitute<D: DeviceSet>(
    devices: &D::Prepared,
    gains: &D::Per<data::Gains>,
    hub: &Solution<D::Scalar>,
    out: &mut D::Per<data::Accelerations>,
) {
    let mut substitution = BackSubstitution(hub.expressed_in_b());
    let Ok(()) = D::visit::<Substituted, _>(devices, (gains, out), &mut substitution);
}
