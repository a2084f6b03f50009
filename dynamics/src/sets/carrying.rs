//! [`Carrying`]: devices on a carrier that moves, a platform or a panel, as a set of devices.
//!
//! In every order the carrier comes first, as the device nearest to the base, then what it
//! carries. An operation that needs the motion of a device's base enters the carrier's frame in
//! [`Visit::visit_carrying`]; all others visit the members in order.

use crate::equations::joint_inputs::JointInputs;
use crate::generated::hinged_panel::device::HingedPanel;
use crate::generated::hub::ConstantShare;
use crate::isolation::carrier::Carrier;
use crate::isolation::carrier_elimination::CarrierConstants;
use crate::isolation::panel::CarryingPanel;
use crate::isolation::parameters::Platform;
use crate::isolation::records::Data;
use crate::model::kind::JointInfo;
use crate::numbers::real::Scalar;
use crate::sets::bundle::{Bundle, Part};
use crate::sets::devices::{ConstantShares, DeviceSet, FixedSet, List, SetInputs, Visit};
use crate::sets::per_device::PerDevice;
use crate::validation::parameter_error::ParameterError;

/// Devices on a carrier, which is an isolated platform or a hinged panel.
///
/// A set of devices like any other, by itself, in arrays and in tuples; it counts as the device that
/// carries followed by the carried ones. Origins and mounts of the carried devices are from P, the origin
/// of the carrier, and in its axes where those of other devices are from B and in B. Its data are
/// [`Data`](crate::platform::Data): `state.devices.carrier.x`, `state.devices.carried.0[1].spin`.
///
/// What is carried is any set, so that sets nest: a row of three panels is
/// `OnPanel<OnPanel<HingedPanel>>`, an isolator on an isolator `Isolated<Isolated<[ReactionWheel; 4]>>`.
/// In lists it is a member of its own: `(Vec<BuiltIn>, Vec<Isolated<Vec<BuiltIn>>>)` is a set of
/// devices on the hub and of platforms, as many as there are at run time. A
/// [`BuiltIn`](crate::BuiltIn) is never one. Unsupported in lanes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Carrying<C: Carrier, D> {
    /// What carries, with springs and dampers of single joints.
    pub carrier: C,
    /// Springs and dampers that couple its joints; `()` of a panel.
    pub suspension: C::Suspension,
    /// The devices on it.
    pub carried: D,
}

/// Devices on an isolated platform: `Isolated<([ReactionWheel; 4], Sgcmg)>`.
pub type Isolated<D> = Carrying<Platform<<D as DeviceSet>::Scalar>, D>;

/// Devices on a hinged panel: `OnPanel<HingedPanel>`, a row of two panels.
pub type OnPanel<D> = Carrying<CarryingPanel<<D as DeviceSet>::Scalar>, D>;

impl<D: DeviceSet> OnPanel<D> {
    /// Devices on a panel: origins and mounts of theirs are from the origin of the panel, in its axes.
    #[must_use]
    pub const fn on_panel(panel: HingedPanel<D::Scalar>, carried: D) -> Self {
        Self { carrier: CarryingPanel(panel), suspension: (), carried }
    }
}

/// [`Carrying`], precomputed.
#[derive(Clone, Debug)]
pub struct PreparedCarrying<C: Carrier, D: DeviceSet> {
    pub(crate) carrier: CarrierConstants<C>,
    pub(crate) carried: D::Prepared,
}

/// The carrier's part of data.
#[derive(Clone, Copy, Debug)]
struct OfCarrier;

/// The carried devices' part of data.
#[derive(Clone, Copy, Debug)]
struct OfCarried;

impl<T: Scalar, C: Carrier<Scalar = T>, D: DeviceSet<Scalar = T>> Part<Carrying<C, D>>
    for OfCarrier
{
    type Of = C;

    fn of<F: PerDevice<T>>(self, whole: &Data<F::Of<C>, D::Per<F>>) -> Option<&F::Of<C>> {
        Some(&whole.carrier)
    }

    fn of_mut<F: PerDevice<T>>(
        self,
        whole: &mut Data<F::Of<C>, D::Per<F>>,
    ) -> Option<&mut F::Of<C>> {
        Some(&mut whole.carrier)
    }
}

impl<T: Scalar, C: Carrier<Scalar = T>, D: DeviceSet<Scalar = T>> Part<Carrying<C, D>>
    for OfCarried
{
    type Of = D;

    fn of<F: PerDevice<T>>(self, whole: &Data<F::Of<C>, D::Per<F>>) -> Option<&D::Per<F>> {
        Some(&whole.carried)
    }

    fn of_mut<F: PerDevice<T>>(
        self,
        whole: &mut Data<F::Of<C>, D::Per<F>>,
    ) -> Option<&mut D::Per<F>> {
        Some(&mut whole.carried)
    }
}

impl<T: Scalar, C: Carrier<Scalar = T>, D: DeviceSet<Scalar = T>> PreparedCarrying<C, D> {
    /// Shows a visitor the carrier and then the carried devices.
    pub(crate) fn visit_members<B: Bundle<T>, V: Visit<T, B>>(
        &self,
        mut data: B::Of<'_, Carrying<C, D>>,
        visitor: &mut V,
    ) -> Result<(), V::Error> {
        if let Some(data) = B::part::<Carrying<C, D>, OfCarrier>(&mut data, OfCarrier) {
            visitor.visit(&self.carrier.device, data)?;
        }
        if let Some(data) = B::part::<Carrying<C, D>, OfCarried>(&mut data, OfCarried) {
            D::visit::<B, V>(&self.carried, data, visitor)?;
        }
        Ok(())
    }
}

impl<T: Scalar, C: Carrier<Scalar = T>, D: DeviceSet<Scalar = T>> DeviceSet for Carrying<C, D> {
    type Scalar = T;
    type Prepared = PreparedCarrying<C, D>;
    type Per<F: PerDevice<T>> = Data<F::Of<C>, D::Per<F>>;

    fn check(&self, device: &mut usize) -> Result<(), ParameterError<T>> {
        let own = *device;
        self.carrier.check(device)?;
        C::check_suspension(own, &self.suspension)?;
        self.carried.check(device)
    }

    fn prepare(&self) -> PreparedCarrying<C, D> {
        let (device, carried) = (self.carrier.prepare(), self.carried.prepare());
        let shares = || D::list::<ConstantShares>(&carried);
        let carried_mass =
            shares().fold(crate::numbers::real::zero(), |mass, share| mass + share.constant_m);
        let body = C::base(&device.constants).body.with_constant_shares(shares());
        let carrier = CarrierConstants { device, suspension: self.suspension, body, carried_mass };
        PreparedCarrying { carrier, carried }
    }

    fn new_data<F: PerDevice<T>>(devices: &PreparedCarrying<C, D>, family: &F) -> Self::Per<F> {
        let carrier = family.initial::<C>();
        Data { carrier, carried: D::new_data(&devices.carried, family) }
    }

    fn list<L: List<T>>(devices: &PreparedCarrying<C, D>) -> impl Iterator<Item = L::Item> {
        L::of_carrier(&devices.carrier).chain(D::list::<L>(&devices.carried).map(L::on_carrier))
    }

    fn visit<B: Bundle<T>, V: Visit<T, B>>(
        devices: &PreparedCarrying<C, D>,
        data: B::Of<'_, Self>,
        visitor: &mut V,
    ) -> Result<(), V::Error> {
        visitor.visit_carrying(devices, data)
    }

    fn count<F: PerDevice<T>>(_: &Self::Per<F>) -> Option<usize> {
        None
    }
}

impl<T: Scalar, C: Carrier<Scalar = T>, D: FixedSet<Scalar = T>> FixedSet for Carrying<C, D> {
    fn new_fixed<F: PerDevice<T>>(family: &F) -> Self::Per<F> {
        let carrier = family.initial::<C>();
        Data { carrier, carried: D::new_fixed(family) }
    }

    fn joint_infos() -> impl Iterator<Item = &'static JointInfo> {
        C::JOINTS.iter().chain(D::joint_infos())
    }
}

/// Inputs of a set taken apart: of the carrier, and of what it carries.
pub(crate) fn parts<'a, T: Scalar, C: Carrier<Scalar = T>, D: DeviceSet<Scalar = T>>(
    of: SetInputs<'a, Carrying<C, D>>,
) -> (SetInputs<'a, C>, SetInputs<'a, D>) {
    let JointInputs { motors, modes, bodies } = of;
    let carrier = JointInputs {
        motors: &motors.carrier,
        modes: &modes.carrier,
        bodies: bodies.map(|bodies| &bodies.carrier),
    };
    let carried = JointInputs {
        motors: &motors.carried,
        modes: &modes.carried,
        bodies: bodies.map(|bodies| &bodies.carried),
    };
    (carrier, carried)
}

/// Of what moves with a carrier, only the mass is a constant share of the base.
pub(crate) fn only_mass<T: Scalar>(share: ConstantShare<T>) -> ConstantShare<T> {
    ConstantShare::of_mass(share.constant_m)
}
