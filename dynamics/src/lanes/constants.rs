//! Constants of several devices or spacecraft, side by side in lanes.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use std::sync::Arc;

use core::convert::Infallible;
use core::fmt;

use super::number::{Block, Number, WIDEST};
use super::slot::LanedSet;
use crate::equations::device::Device;
use crate::equations::hub::HubConstants;
use crate::model::kernels::Kernels;
use crate::model::kind::Kind;
use crate::model::passive::Passive;
use crate::sets::bundle::Unique;
use crate::sets::devices::Visit;
use crate::sets::enumeration::{DeviceEnum, Variant};
use crate::sets::per_device::PerDevice;
use crate::solve::spacecraft::Spacecraft;

/// Constants of a device of one kind in each lane.
#[derive(Clone, Debug)]
pub(super) struct DeviceBlocks<K: Kernels> {
    pub(super) constants: K::Constants<Block>,
    pub(super) passive: K::PerJoint<Passive<Block>>,
    /// What the pivots are checked against.
    pub(super) bound: K::PerJoint<Block>,
    /// One in the lanes whose device has springs or friction.
    pub(super) sprung: Block,
    /// Whether there is no such lane.
    pub(super) free: bool,
}

/// Constants of a device as numbers in lanes.
pub(super) struct DeviceConstants<K: Kernels, T: Number> {
    pub(super) constants: K::Constants<T>,
    /// None where no joint has a spring or friction.
    pub(super) passive: Option<K::PerJoint<Passive<T>>>,
    pub(super) bound: K::PerJoint<T>,
    /// Where the device has springs or friction.
    pub(super) sprung: T::Holds,
}

impl<K: Kind<Scalar = f64>> DeviceBlocks<K> {
    /// One device in every lane.
    fn filled(device: &Device<K>) -> Self {
        let block = |number| Block([number; WIDEST]);
        Self {
            constants: K::zip_constants(&device.constants, &device.constants, |n, _| block(n)),
            passive: K::zip_per_joint(&device.passive, &device.passive, |p, _| p.map(block)),
            bound: K::zip_per_joint(&device.bound, &device.bound, |number, _| block(number)),
            sprung: block(if device.free { 0.0 } else { 1.0 }),
            free: device.free,
        }
    }

    /// Puts a device into one lane.
    fn put(&mut self, lane: usize, device: &Device<K>) {
        let put = |mut block: Block, number| {
            block.put(lane, number);
            block
        };
        self.constants = K::zip_constants(&self.constants, &device.constants, put);
        self.bound = K::zip_per_joint(&self.bound, &device.bound, put);
        self.passive = K::zip_per_joint(&self.passive, &device.passive, |blocks, passive| {
            let [a, b, c, d, e] = passive.named().map(|(_, number)| number);
            Passive {
                stiffness: put(blocks.stiffness, a),
                rest: put(blocks.rest, b),
                viscous: put(blocks.viscous, c),
                coulomb: put(blocks.coulomb, d),
                coulomb_rate: put(blocks.coulomb_rate, e),
            }
        });
        self.sprung.put(lane, if device.free { 0.0 } else { 1.0 });
        self.free &= device.free;
    }

    /// These devices side by side, at most as many as the widest lanes have; lanes without one
    /// repeat the last. None without a device.
    pub(super) fn of(devices: &[Device<K>]) -> Option<Self> {
        let mut blocks = Self::filled(devices.last()?);
        for (lane, device) in devices.iter().enumerate() {
            blocks.put(lane, device);
        }
        Some(blocks)
    }

    /// As numbers in lanes.
    #[inline(always)]
    pub(super) fn in_lanes<T: Number>(&self, like: T) -> DeviceConstants<K, T> {
        let load = |block: Block| like.load(&block);
        DeviceConstants {
            constants: K::zip_constants(&self.constants, &self.constants, |block, _| load(block)),
            passive: (!self.free).then(|| {
                K::zip_per_joint(&self.passive, &self.passive, |passive, _| passive.map(load))
            }),
            bound: K::zip_per_joint(&self.bound, &self.bound, |block, _| load(block)),
            sprung: load(self.sprung).above(like.like(0.0)),
        }
    }
}

/// One device's constants in every lane.
#[inline(always)]
pub(super) fn same_in_lanes<K: Kind<Scalar = f64>, T: Number>(
    device: &Device<K>,
    like: T,
) -> DeviceConstants<K, T> {
    let splat = |number| like.like(number);
    DeviceConstants {
        constants: K::zip_constants(&device.constants, &device.constants, |n, _| splat(n)),
        passive: (!device.free)
            .then(|| K::zip_per_joint(&device.passive, &device.passive, |p, _| p.map(splat))),
        bound: K::zip_per_joint(&device.bound, &device.bound, |number, _| splat(number)),
        sprung: like.same(like),
    }
}

/// The constants of the devices of as many spacecraft of one shape as there are lanes.
#[derive(Clone, Copy, Debug)]
pub(super) struct EachConstants;

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
    pub(super) body: HubConstants<Block>,
    pub(super) devices: D::Per<EachConstants>,
    /// Whether a joint of one of them has a spring, a damper or dry friction.
    pub(super) passive: bool,
}

impl<D: LanedSet> fmt::Debug for CraftBlocks<D> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { body, passive, .. } = self;
        let mut shown = f.debug_struct("CraftBlocks");
        shown.field("body", body).field("passive", passive).finish_non_exhaustive()
    }
}

impl<D: LanedSet> CraftBlocks<D> {
    /// These spacecraft side by side; lanes without one repeat the last. None without one.
    pub(super) fn of(crafts: &[Spacecraft<D>]) -> Option<Self> {
        let last = crafts.last()?;
        let in_lane = |lane| crafts.get(lane).unwrap_or(last);
        let mut devices = D::new_data(&last.devices, &EachConstants);
        let mut body = last.body.map(|_| Block::ZERO);
        for lane in 0..WIDEST {
            body = body.zip(&in_lane(lane).body, |mut block, number| {
                block.put(lane, number);
                block
            });
            let data = &mut devices;
            let mut put = PutConstants { lane };
            let Ok(()) =
                D::visit::<Unique<EachConstants>, _>(&in_lane(lane).devices, data, &mut put);
        }
        let passive = crafts.iter().any(|craft| craft.passive);
        Some(Self { body, devices, passive })
    }
}

/// Puts the devices of a spacecraft into one lane.
struct PutConstants {
    lane: usize,
}

impl Visit<f64, Unique<EachConstants>> for PutConstants {
    type Error = Infallible;

    fn visit<K: Kind<Scalar = f64>>(
        &mut self,
        device: &Device<K>,
        blocks: &mut Option<Arc<DeviceBlocks<K>>>,
    ) -> Result<(), Infallible> {
        let blocks = blocks.get_or_insert_with(|| Arc::new(DeviceBlocks::filled(device)));
        Arc::make_mut(blocks).put(self.lane, device);
        Ok(())
    }
}
