//! What an evaluation does with each device on a structure that bends: as on a rigid hub, with the
//! frame K of its mount for B.

use core::convert::Infallible;

use crate::equations::arithmetic::Arithmetic;
use crate::equations::assembly::Assembly;
use crate::equations::device::Device;
use crate::equations::eliminate::DeviceElimination;
use crate::equations::error::SolveError;
use crate::equations::hub::HubConstants;
use crate::equations::joint_inputs::Environment;
use crate::equations::system::Solution;
use crate::flexible::modes_error::ModesError;
use crate::flexible::mount::MountMotion;
use crate::flexible::on_mount::OnMount;
use crate::isolation::set::{Isolated, PreparedIsolated};
use crate::model::kind::Kind;
use crate::numbers::real::Scalar;
use crate::sets::bundle::{Bundle, Given, Shared, Unique};
use crate::sets::devices::{DeviceSet, Visit};
use crate::sets::per_device as data;

/// A mount during an evaluation.
#[derive(Clone, Debug)]
pub(crate) struct MountStage<T> {
    pub(crate) motion: MountMotion<T>,
    pub(crate) environment: Environment<T>,
    /// The six equations of K, of the devices on this mount.
    pub(crate) assembly: Assembly<T>,
}

/// Adds the constant share of each device to the body of its mount.
pub(crate) struct Standing<'a, T> {
    pub(crate) bodies: &'a mut [HubConstants<T>],
    pub(crate) device: usize,
}

impl<T: Scalar> Visit<T, Shared<OnMount>> for Standing<'_, T> {
    type Error = ModesError<T>;

    fn visit<K: Kind<Scalar = T>>(
        &mut self,
        device: &Device<K>,
        mount: &usize,
    ) -> Result<(), ModesError<T>> {
        let number = self.device;
        self.device = self.device.wrapping_add(1);
        let mounts = self.bodies.len();
        let Some(body) = self.bodies.get_mut(*mount) else {
            return Err(ModesError::NoMount { device: number, mount: *mount, mounts });
        };
        let share = K::constant_share(&device.constants);
        *body = body.with_constant_shares(core::iter::once(share));
        Ok(())
    }

    // Other visitors never meet a platform: there is no spacecraft that has one.
    fn visit_isolated<D: DeviceSet<Scalar = T>>(
        &mut self,
        _: &PreparedIsolated<D>,
        _: &<Isolated<D> as DeviceSet>::Per<OnMount>,
    ) -> Result<(), ModesError<T>> {
        Err(ModesError::Isolated { device: self.device })
    }

    fn compare(&mut self, expected: usize, found: usize) -> Result<(), ModesError<T>> {
        if expected == found { Ok(()) } else { Err(ModesError::DeviceCount { expected, found }) }
    }
}

/// State and inputs of the joints, the gains that come of them, and the mount.
pub(crate) type Eliminated = (Shared<data::Joints>, Given, Unique<data::Gains>, Shared<OnMount>);

/// Eliminates every joint into the equations of its mount.
pub(crate) struct MountElimination<'a, T> {
    pub(crate) mounts: &'a mut [MountStage<T>],
    pub(crate) device: usize,
    pub(crate) arithmetic: Arithmetic,
}

impl<T: Scalar> Visit<T, Eliminated> for MountElimination<'_, T> {
    type Error = SolveError<T>;

    fn visit<K: Kind<Scalar = T>>(
        &mut self,
        device: &Device<K>,
        (joints, given, gains, mount): <Eliminated as Bundle<T>>::Of<'_, K>,
    ) -> Result<(), SolveError<T>> {
        let index = self.device;
        self.device = self.device.wrapping_add(1);
        let Some(MountStage { environment, assembly, .. }) = self.mounts.get_mut(*mount) else {
            return Ok(());
        };
        self.arithmetic.eliminate(DeviceElimination {
            device,
            index,
            joints,
            given,
            environment,
            assembly,
            gains,
        })
    }
}

/// The gains, the accelerations that come of them, and the mount.
pub(crate) type Substituted = (Shared<data::Gains>, Unique<data::Accelerations>, Shared<OnMount>);

/// The joints' accelerations once those of the mounts are known.
pub(crate) struct MountBackSubstitution<'a, T>(pub(crate) &'a [Solution<T>]);

impl<T: Scalar> Visit<T, Substituted> for MountBackSubstitution<'_, T> {
    type Error = Infallible;

    fn visit<K: Kind<Scalar = T>>(
        &mut self,
        _: &Device<K>,
        (gains, out, mount): <Substituted as Bundle<T>>::Of<'_, K>,
    ) -> Result<(), Infallible> {
        if let (Some(gains), Some(mount)) = (gains, self.0.get(*mount)) {
            *out = K::back_substitute(gains, &mount.expressed_in_b());
        }
        Ok(())
    }
}
