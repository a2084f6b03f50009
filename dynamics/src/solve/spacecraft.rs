//! [`Spacecraft`]: a hub or flexible structure and its devices, checked and prepared once, and warnings.

use crate::equations::arithmetic::Arithmetic;
use crate::equations::hub::HubConstants;
use crate::model::parameters::Hub;
use crate::numbers::real::{Scalar, zero};
use crate::sets::devices::{ConstantShares, Devices, JointInfos, Passives, TriangleExcesses};
use crate::solve::structure::{Rigid, StructureData, StructureEquations};
use crate::validation::check::check_hub;
use crate::validation::parameter_error::{ParameterError, Part, Warning};

/// A hub with devices, prepared for evaluation: a [`Rigid`] hub, or a
/// [`Flexible`](crate::Flexible) structure. Never changes; `[Dgvscmg; 0]` is a hub without devices.
#[derive(Clone, Debug)]
pub struct Spacecraft<D: Devices, S: StructureData = Rigid> {
    pub(crate) hub: HubConstants<D::Scalar>,
    /// The hub with the constant shares of its devices.
    pub(crate) body: HubConstants<D::Scalar>,
    /// The constant shares of the devices by themselves.
    pub(crate) shares: HubConstants<D::Scalar>,
    pub(crate) devices: D::Prepared,
    /// Whether a joint has a spring, a damper or dry friction.
    pub(crate) passive: bool,
    pub(crate) hub_excess: D::Scalar,
    pub(crate) arithmetic: Arithmetic,
    /// What the structure has beside the hub.
    pub(crate) structure: S::Constants<D>,
}

impl<D: Devices> Spacecraft<D> {
    /// Checks the parameters and computes everything that depends only on them.
    ///
    /// # Errors
    ///
    /// [`ParameterError`] names the body, the value and the bound: a number that is not finite, a
    /// mass of hub or outermost body that is not above zero, a negative mass of a gimbal, an
    /// inertia that is not symmetric or has a negative principal moment, a mount that is not a
    /// right-handed rotation, a negative stiffness or friction; or a total mass or principal
    /// moment that is not finite. Deviations up to 4096 epsilons of the largest element
    /// count as rounding.
    pub fn new(hub: &Hub<D::Scalar>, devices: &D) -> Result<Self, ParameterError<D::Scalar>> {
        Self::checked_and_prepared(hub, devices, D::prepare)
    }

    /// [`Self::new`] for a single evaluation.
    pub(crate) fn alone(
        hub: &Hub<D::Scalar>,
        devices: &D,
    ) -> Result<Self, ParameterError<D::Scalar>> {
        Self::checked_and_prepared(hub, devices, D::prepare_alone)
    }

    fn checked_and_prepared(
        hub: &Hub<D::Scalar>,
        devices: &D,
        prepare: impl FnOnce(&D) -> D::Prepared,
    ) -> Result<Self, ParameterError<D::Scalar>> {
        let hub_excess = check_hub(hub)?;
        devices.check(&mut 0)?;
        let prepared = Self::of_prepared(hub, prepare(devices), hub_excess);
        if !prepared.mass().is_finite() {
            return Err(ParameterError::TotalMass { value: prepared.mass() });
        }
        Ok(prepared)
    }

    /// What depends only on parameters, computed; they have been checked.
    pub(crate) fn prepared(hub: &Hub<D::Scalar>, devices: &D, hub_excess: D::Scalar) -> Self {
        Self::of_prepared(hub, devices.prepare(), hub_excess)
    }

    fn of_prepared(hub: &Hub<D::Scalar>, devices: D::Prepared, hub_excess: D::Scalar) -> Self {
        let hub = HubConstants::new(hub);
        let constant = || D::list::<ConstantShares>(&devices);
        let body = hub.with_constant_shares(constant());
        let shares = HubConstants::nothing().with_constant_shares(constant());
        let passive = D::list::<Passives>(&devices).any(|joint| !joint.is_none());
        let arithmetic = Arithmetic::detected();
        Self { hub, body, shares, devices, passive, hub_excess, arithmetic, structure: () }
    }
}

impl<D: Devices, S: StructureEquations> Spacecraft<D, S> {
    /// The same hub and devices with another structure.
    pub(crate) fn with_structure<R: StructureEquations>(
        self,
        structure: R::Constants<D>,
    ) -> Spacecraft<D, R> {
        let Self { hub, body, shares, devices, passive, hub_excess, arithmetic, .. } = self;
        Spacecraft { hub, body, shares, devices, passive, hub_excess, arithmetic, structure }
    }

    /// Unusual parameters that are accepted; see [`Warning`].
    #[must_use = "warnings do nothing unless they are read"]
    pub fn warnings(&self) -> impl Iterator<Item = Warning<D::Scalar>> + '_ {
        let numbered = self.joints().map(|(device, info)| Part::Body { device, body: info.body });
        let bodies = numbered.zip(D::list::<TriangleExcesses>(&self.devices));
        core::iter::once((Part::Hub, self.hub_excess))
            .chain(bodies)
            .filter(|&(_, excess)| excess > zero())
            .map(|(part, excess)| Warning::Triangle { part, excess })
    }

    /// `m_sc`, mass of hub and devices, kg.
    #[must_use]
    pub fn mass(&self) -> D::Scalar {
        S::mass(self)
    }

    /// The joints in order, each with the number of its device.
    pub fn joints(
        &self,
    ) -> impl Iterator<Item = (usize, &'static crate::model::kind::JointInfo)> + '_ {
        D::list::<JointInfos>(&self.devices).scan(0_usize, |next, info| {
            if info.index == 0 {
                *next = next.wrapping_add(1);
            }
            Some((next.wrapping_sub(1), info))
        })
    }
}
