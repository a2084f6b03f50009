//! [`Isolated`]: devices on a platform that moves, as a set of devices.
//!
//! In every order the platform comes first, as the device nearest to the base, then what it
//! carries. An operation that needs the motion of a device's base enters the platform's frame in
//! [`Visit::visit_isolated`]; all others visit the members in order.

use crate::equations::joint_inputs::JointInputs;
use crate::generated::hub::ConstantShare;
use crate::isolation::checks::check_suspension;
use crate::isolation::parameters::Platform;
use crate::isolation::platform_elimination::PlatformConstants;
use crate::isolation::records::Data;
use crate::isolation::suspension::Suspension;
use crate::model::kind::{JointInfo, Kind};
use crate::numbers::real::Scalar;
use crate::sets::bundle::{Bundle, Part};
use crate::sets::devices::{ConstantShares, DeviceSet, FixedSet, List, SetInputs, Visit};
use crate::sets::per_device::PerDevice;
use crate::validation::parameter_error::ParameterError;

/// Devices on an isolated platform: `Isolated<([ReactionWheel; 4], Sgcmg)>`.
///
/// A set of devices like any other, by itself, in arrays and in tuples; it counts as the device
/// `platform` followed by the carried ones. Origins and mounts of the carried devices are from P
/// and in the platform's axes where those of other devices are from B and in B. Its data are
/// [`Data`](crate::platform::Data): `state.devices.platform.x`, `state.devices.carried.0[1].spin`.
///
/// In lists it is a member of its own: `(Vec<BuiltIn>, Vec<Isolated<Vec<BuiltIn>>>)` is a set of
/// devices on the hub and of platforms, as many as there are at run time. A
/// [`BuiltIn`](crate::BuiltIn) is never one. Unsupported in lanes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Isolated<D: DeviceSet> {
    /// The platform, with springs and dampers of single joints.
    pub platform: Platform<D::Scalar>,
    /// Springs and dampers that couple its joints.
    pub suspension: Suspension<D::Scalar>,
    /// The devices on it.
    pub carried: D,
}

/// [`Isolated`], precomputed.
#[derive(Clone, Debug)]
pub struct PreparedIsolated<D: DeviceSet> {
    pub(crate) carrier: PlatformConstants<D::Scalar>,
    pub(crate) carried: D::Prepared,
}

/// The platform's part of data.
#[derive(Clone, Copy, Debug)]
struct OfPlatform;

/// The carried devices' part of data.
#[derive(Clone, Copy, Debug)]
struct OfCarried;

impl<D: DeviceSet> Part<Isolated<D>> for OfPlatform {
    type Of = Platform<D::Scalar>;

    fn of<F: PerDevice<D::Scalar>>(
        self,
        whole: &Data<F::Of<Platform<D::Scalar>>, D::Per<F>>,
    ) -> Option<&F::Of<Platform<D::Scalar>>> {
        Some(&whole.platform)
    }

    fn of_mut<F: PerDevice<D::Scalar>>(
        self,
        whole: &mut Data<F::Of<Platform<D::Scalar>>, D::Per<F>>,
    ) -> Option<&mut F::Of<Platform<D::Scalar>>> {
        Some(&mut whole.platform)
    }
}

impl<D: DeviceSet> Part<Isolated<D>> for OfCarried {
    type Of = D;

    fn of<F: PerDevice<D::Scalar>>(
        self,
        whole: &Data<F::Of<Platform<D::Scalar>>, D::Per<F>>,
    ) -> Option<&D::Per<F>> {
        Some(&whole.carried)
    }

    fn of_mut<F: PerDevice<D::Scalar>>(
        self,
        whole: &mut Data<F::Of<Platform<D::Scalar>>, D::Per<F>>,
    ) -> Option<&mut D::Per<F>> {
        Some(&mut whole.carried)
    }
}

impl<D: DeviceSet> PreparedIsolated<D> {
    /// Shows a visitor the platform and then the carried devices.
    pub(crate) fn visit_members<B: Bundle<D::Scalar>, V: Visit<D::Scalar, B>>(
        &self,
        mut data: B::Of<'_, Isolated<D>>,
        visitor: &mut V,
    ) -> Result<(), V::Error> {
        if let Some(data) = B::part::<Isolated<D>, OfPlatform>(&mut data, OfPlatform) {
            visitor.visit(&self.carrier.device, data)?;
        }
        if let Some(data) = B::part::<Isolated<D>, OfCarried>(&mut data, OfCarried) {
            D::visit::<B, V>(&self.carried, data, visitor)?;
        }
        Ok(())
    }
}

impl<D: DeviceSet> DeviceSet for Isolated<D> {
    type Scalar = D::Scalar;
    type Prepared = PreparedIsolated<D>;
    type Per<F: PerDevice<D::Scalar>> = Data<F::Of<Platform<D::Scalar>>, D::Per<F>>;

    fn check(&self, device: &mut usize) -> Result<(), ParameterError<D::Scalar>> {
        let own = *device;
        self.platform.check(device)?;
        check_suspension(own, &self.suspension)?;
        self.carried.check(device)
    }

    fn prepare(&self) -> PreparedIsolated<D> {
        let (device, carried) = (self.platform.prepare(), self.carried.prepare());
        let shares = || D::list::<ConstantShares>(&carried);
        let carried_mass =
            shares().fold(crate::numbers::real::zero(), |mass, share| mass + share.constant_m);
        let body = device.constants.body.with_constant_shares(shares());
        let carrier = PlatformConstants { device, suspension: self.suspension, body, carried_mass };
        PreparedIsolated { carrier, carried }
    }

    fn new_data<F: PerDevice<D::Scalar>>(
        devices: &PreparedIsolated<D>,
        family: &F,
    ) -> Self::Per<F> {
        let platform = family.initial::<Platform<D::Scalar>>();
        Data { platform, carried: D::new_data(&devices.carried, family) }
    }

    fn list<L: List<D::Scalar>>(devices: &PreparedIsolated<D>) -> impl Iterator<Item = L::Item> {
        L::of_platform(&devices.carrier).chain(D::list::<L>(&devices.carried).map(L::on_platform))
    }

    fn visit<B: Bundle<D::Scalar>, V: Visit<D::Scalar, B>>(
        devices: &PreparedIsolated<D>,
        data: B::Of<'_, Self>,
        visitor: &mut V,
    ) -> Result<(), V::Error> {
        visitor.visit_isolated(devices, data)
    }

    fn count<F: PerDevice<D::Scalar>>(_: &Self::Per<F>) -> Option<usize> {
        None
    }
}

impl<D: FixedSet> FixedSet for Isolated<D> {
    fn new_fixed<F: PerDevice<D::Scalar>>(family: &F) -> Self::Per<F> {
        let platform = family.initial::<Platform<D::Scalar>>();
        Data { platform, carried: D::new_fixed(family) }
    }

    fn joint_infos() -> impl Iterator<Item = &'static JointInfo> {
        Platform::<D::Scalar>::JOINTS.iter().chain(D::joint_infos())
    }
}

/// Inputs of the platform, and those of what it carries.
pub(crate) type InputParts<'a, D> =
    (SetInputs<'a, Platform<<D as DeviceSet>::Scalar>>, SetInputs<'a, D>);

/// Inputs of a set taken apart.
pub(crate) fn parts<'a, D: DeviceSet>(of: SetInputs<'a, Isolated<D>>) -> InputParts<'a, D> {
    let JointInputs { motors, modes, bodies } = of;
    let platform = JointInputs {
        motors: &motors.platform,
        modes: &modes.platform,
        bodies: bodies.map(|bodies| &bodies.platform),
    };
    let carried = JointInputs {
        motors: &motors.carried,
        modes: &modes.carried,
        bodies: bodies.map(|bodies| &bodies.carried),
    };
    (platform, carried)
}

/// Of what moves with a platform, only the mass is a constant share of the base.
pub(crate) fn only_mass<T: Scalar>(share: ConstantShare<T>) -> ConstantShare<T> {
    ConstantShare::of_mass(share.constant_m)
}
