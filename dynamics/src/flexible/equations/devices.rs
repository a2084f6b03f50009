//! What an evaluation does with each device or platform on a flexible structure: as on a rigid
//! hub, with the frame K of its mount for B.

use core::convert::Infallible;

use crate::equations::assembly::Assembly;
use crate::equations::device::Device;
use crate::equations::error::SolveError;
use crate::equations::hub::HubConstants;
use crate::equations::joint_inputs::Environment;
use crate::equations::system::Solution;
use crate::flexible::equations::mount::MountMotion;
use crate::flexible::modal::modes_error::ModesError;
use crate::isolation::carrier::Carrier;
use crate::model::kind::Kind;
use crate::numbers::real::Scalar;
use crate::sets::bundle::{Bundle, Given, Shared, Unique};
use crate::sets::carrying::{Carrying, PreparedCarrying};
use crate::sets::devices::{ConstantShares, DeviceSet, Visit};
use crate::sets::per_device as data;
use crate::sets::per_device::OnMount;
use crate::solve::elimination::{BackSubstitution, Eliminate, Elimination};

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
        self.add::<K>(device, *mount)
    }

    fn visit_carrying<C: Carrier<Scalar = T>, D: DeviceSet<Scalar = T>>(
        &mut self,
        carrying: &PreparedCarrying<C, D>,
        mount: &<Carrying<C, D> as DeviceSet>::Per<OnMount>,
    ) -> Result<(), ModesError<T>> {
        self.add::<Carrying<C, D>>(carrying, mount.carrier)
    }

    fn compare(&mut self, expected: usize, found: usize) -> Result<(), ModesError<T>> {
        if expected == found { Ok(()) } else { Err(ModesError::DeviceCount { expected, found }) }
    }
}

impl<T: Scalar> Standing<'_, T> {
    /// Adds what devices that stand together on a mount share of its body.
    fn add<D: DeviceSet<Scalar = T>>(
        &mut self,
        devices: &D::Prepared,
        mount: usize,
    ) -> Result<(), ModesError<T>> {
        let (device, mounts) = (self.device, self.bodies.len());
        let Some(body) = self.bodies.get_mut(mount) else {
            return Err(ModesError::NoMount { device, mount, mounts });
        };
        *body = body.with_constant_shares(D::list::<ConstantShares>(devices));
        self.device = device.wrapping_add(D::list::<ConstantShares>(devices).count());
        Ok(())
    }
}

/// State and inputs of the joints, the gains that come of them, and the mount.
pub(crate) type Eliminated = (Shared<data::Joints>, Given, Unique<data::Gains>, Shared<OnMount>);

/// Eliminates every joint into the equations of its mount.
pub(crate) struct MountElimination<'a, T, E> {
    pub(crate) mounts: &'a mut [MountStage<T>],
    pub(crate) device: usize,
    pub(crate) by: E,
}

impl<T: Scalar, E: Eliminate<T>> Visit<T, Eliminated> for MountElimination<'_, T, E> {
    type Error = SolveError<T>;

    fn visit<K: Kind<Scalar = T>>(
        &mut self,
        device: &Device<K>,
        (joints, given, gains, mount): <Eliminated as Bundle<T>>::Of<'_, K>,
    ) -> Result<(), SolveError<T>> {
        self.on(*mount, |mount| mount.visit(device, (joints, given, gains)))
    }

    fn visit_carrying<C: Carrier<Scalar = T>, D: DeviceSet<Scalar = T>>(
        &mut self,
        carrying: &PreparedCarrying<C, D>,
        (joints, given, gains, mount): <Eliminated as Bundle<T>>::Of<'_, Carrying<C, D>>,
    ) -> Result<(), SolveError<T>> {
        self.on(mount.carrier, |mount| mount.visit_carrying(carrying, (joints, given, gains)))
    }
}

impl<T: Scalar, E: Eliminate<T>> MountElimination<'_, T, E> {
    /// Eliminates the next devices into the equations of their mount.
    fn on(
        &mut self,
        mount: usize,
        eliminate: impl FnOnce(&mut Elimination<'_, T, E>) -> Result<(), SolveError<T>>,
    ) -> Result<(), SolveError<T>> {
        let Some(MountStage { environment, assembly, .. }) = self.mounts.get_mut(mount) else {
            return Ok(());
        };
        let (device, by) = (self.device, self.by);
        let mut elimination = Elimination::new(environment, assembly, device, by);
        eliminate(&mut elimination)?;
        self.device = elimination.device;
        Ok(())
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
        device: &Device<K>,
        (gains, out, mount): <Substituted as Bundle<T>>::Of<'_, K>,
    ) -> Result<(), Infallible> {
        let Some(mount) = self.0.get(*mount) else { return Ok(()) };
        BackSubstitution::on(mount).visit(device, (gains, out))
    }

    fn visit_carrying<C: Carrier<Scalar = T>, D: DeviceSet<Scalar = T>>(
        &mut self,
        carrying: &PreparedCarrying<C, D>,
        (gains, out, mount): <Substituted as Bundle<T>>::Of<'_, Carrying<C, D>>,
    ) -> Result<(), Infallible> {
        let Some(mount) = self.0.get(mount.carrier) else { return Ok(()) };
        BackSubstitution::on(mount).visit_carrying(carrying, (gains, out))
    }
}
