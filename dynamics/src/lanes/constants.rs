//! Constants of the spacecraft of a batch, side by side in lanes.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use std::sync::Arc;
use std::vec::Vec;

use core::convert::Infallible;
use core::fmt;

use super::laned_set::LanedSet;
use crate::equations::device::Device;
use crate::equations::hub::HubConstants;
use crate::equations::side_by_side::blocks::{DeviceBlocks, write};
use crate::model::kind::Kind;
use crate::model::passive::Passive;
use crate::numbers::laned::{Block, WIDEST};
use crate::sets::bundle::Unique;
use crate::sets::devices::{AreLumped, Passives, Visit};
use crate::sets::enumeration::{DeviceEnum, Variant};
use crate::sets::per_device::PerDevice;
use crate::solve::spacecraft::Spacecraft;

/// The constants of the devices of as many spacecraft of one shape as there are lanes.
#[derive(Clone, Copy, Debug)]
pub struct EachConstants;

impl PerDevice<f64> for EachConstants {
    type Of<K: Kind<Scalar = f64>> = Option<Arc<DeviceBlocks<K>>>;
    type OfEnum<E: DeviceEnum<Scalar = f64>> = ();

    fn initial<K: Kind<Scalar = f64>>(&self) -> Self::Of<K> {
        None
    }

    fn initial_of_enum<K: Variant<E>, E: DeviceEnum<Scalar = f64>>(&self) {}

    fn get<K: Variant<E>, E: DeviceEnum<Scalar = f64>>((): &()) -> Option<Self::Of<K>> {
        None
    }

    fn put<K: Variant<E>, E: DeviceEnum<Scalar = f64>>(_: &Self::Of<K>, (): &mut ()) {}

    fn count<E: DeviceEnum<Scalar = f64>>((): &()) -> Option<usize> {
        None
    }
}

/// The constants of as many spacecraft of one shape as there are lanes.
pub(super) struct CraftBlocks<D: LanedSet> {
    /// The hub.
    pub(super) hub: HubConstants<Block>,
    /// The hub with the constant shares of the devices.
    pub(super) body: HubConstants<Block>,
    pub(super) devices: D::Per<EachConstants>,
    /// Whether a joint of one of them has a spring, a damper or dry friction.
    pub(super) passive: bool,
    /// What one of them has of its own.
    pub(super) own: OwnLoads,
}

/// What a spacecraft has of its own that is added before the elimination.
#[derive(Clone, Copy, Debug)]
pub(super) struct OwnLoads {
    /// Whether a joint has dry friction.
    pub(super) dry: bool,
    /// Whether an imbalance is lumped.
    pub(super) lumped: bool,
}

impl OwnLoads {
    /// Those of a spacecraft.
    pub(super) fn of<D: LanedSet>(craft: &Spacecraft<D>) -> Self {
        let dry = |passive: Passive| passive.coulomb != 0.0;
        Self {
            dry: craft.passive && D::list::<Passives>(&craft.devices).any(dry),
            lumped: D::list::<AreLumped>(&craft.devices).any(|lumped| lumped),
        }
    }

    /// Whether there is any.
    #[inline(always)]
    pub(super) fn any(self) -> bool {
        self.dry || self.lumped
    }

    /// Those of both.
    fn and(self, other: Self) -> Self {
        Self { dry: self.dry || other.dry, lumped: self.lumped || other.lumped }
    }
}

impl<D: LanedSet> fmt::Debug for CraftBlocks<D> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { body, passive, .. } = self;
        let mut shown = f.debug_struct("CraftBlocks");
        shown.field("body", body).field("passive", passive).finish_non_exhaustive()
    }
}

impl<D: LanedSet> CraftBlocks<D> {
    /// These spacecraft side by side; lanes without one repeat the last. None without one, and where
    /// one has another number of devices than `shape`, for which the lanes are laid out.
    pub(super) fn new(crafts: &[Spacecraft<D>], shape: &Spacecraft<D>) -> Option<Self> {
        let last = crafts.last()?;
        if !crafts.iter().all(|craft| D::is_alike(&shape.devices, &craft.devices)) {
            return None;
        }
        let in_lane = |lane| crafts.get(lane).unwrap_or(last);
        let mut devices = D::new_data(&last.devices, &EachConstants);
        let [mut hub, mut body] = [&last.hub, &last.body].map(|of| of.map(|_| Block::ZERO));
        let mut own = OwnLoads::of(last);
        let mut put = PutConstants { lane: 0, device: 0, numbers: Vec::new() };
        for lane in 0..WIDEST {
            let put_number = |mut block: Block, number| {
                block.put(lane, number);
                block
            };
            hub = hub.zip(&in_lane(lane).hub, put_number);
            body = body.zip(&in_lane(lane).body, put_number);
            own = own.and(OwnLoads::of(in_lane(lane)));
            put.lane = lane;
            put.device = 0;
            let Ok(()) = D::visit::<Unique<EachConstants>, _>(
                &in_lane(lane).devices,
                &mut devices,
                &mut put,
            );
        }
        let passive = crafts.iter().any(|craft| craft.passive);
        Some(Self { hub, body, devices, passive, own })
    }
}

/// Reads the numbers of the devices of one spacecraft after another, and puts them side by side at the last.
struct PutConstants {
    lane: usize,
    /// How many devices of the spacecraft were seen.
    device: usize,
    /// Of each device, lane by lane.
    numbers: Vec<Vec<f64>>,
}

impl Visit<f64, Unique<EachConstants>> for PutConstants {
    type Error = Infallible;

    fn visit<K: Kind<Scalar = f64>>(
        &mut self,
        device: &Device<K>,
        blocks: &mut Option<Arc<DeviceBlocks<K>>>,
    ) -> Result<(), Infallible> {
        if self.device == self.numbers.len() {
            self.numbers.push(Vec::new());
        }
        if let Some(numbers) = self.numbers.get_mut(self.device) {
            write(device, numbers);
            if self.lane + 1 == WIDEST {
                *blocks = Some(Arc::new(DeviceBlocks::new(device, numbers)));
            }
        }
        self.device += 1;
        Ok(())
    }
}
