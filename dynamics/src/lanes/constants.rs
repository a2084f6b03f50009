//! Constants of several devices or spacecraft, side by side in lanes.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use std::sync::Arc;

use core::convert::Infallible;
use core::fmt;

use super::slot::LanedSet;
use crate::equations::device::Device;
use crate::equations::hub::HubConstants;
use crate::model::kernels::Kernels;
use crate::model::kind::{Kind, Lumped};
use crate::model::passive::Passive;
use crate::numbers::laned::{Block, Number, WIDEST};
use crate::numbers::vec3::{Columns, map};
use crate::sets::bundle::Unique;
use crate::sets::devices::{AreLumped, Passives, Visit};
use crate::sets::enumeration::{DeviceEnum, Variant};
use crate::sets::per_device::PerDevice;
use crate::solve::spacecraft::Spacecraft;

/// Constants of a device of one kind in each lane.
#[derive(Clone, Debug)]
pub struct DeviceBlocks<K: Kernels> {
    pub(super) constants: K::Constants<Block>,
    pub(super) passive: K::PerJoint<Passive<Block>>,
    /// What the pivots are checked against.
    pub(super) bound: K::PerJoint<Block>,
    /// One in the lanes whose device has springs or friction.
    pub(super) sprung: Block,
    /// Whether there is no such lane.
    pub(super) free: bool,
    /// Whether a joint in any lane has dry friction.
    pub(super) dry: bool,
    mount: Columns<Block>,
    /// The lumped model of an imbalance; one in the lanes whose device has it.
    lumped: Option<(Lumped<Block>, Block)>,
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

/// What the loads of a device need of it besides.
pub(super) struct LoadConstants<T: Number> {
    /// Whether a joint has dry friction.
    pub(super) dry: bool,
    pub(super) mount: Columns<T>,
    /// The lumped model of an imbalance, and where the device has it.
    pub(super) lumped: Option<(Lumped<T>, T::Holds)>,
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
            dry: device.is_dry(),
            mount: map(device.mount, |column| map(column, block)),
            lumped: device.lumped.map(|lumped| (lumped.map(block), block(1.0))),
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
        self.dry |= device.is_dry();
        for (blocks, column) in self.mount.iter_mut().zip(device.mount) {
            blocks.iter_mut().zip(column).for_each(|(block, number)| block.put(lane, number));
        }
        let none = (Lumped { u_s: Block::ZERO, j_12: Block::ZERO, j_13: Block::ZERO }, Block::ZERO);
        if device.lumped.is_some() || self.lumped.is_some() {
            let (blocks, has) = self.lumped.get_or_insert(none);
            has.put(lane, if device.lumped.is_some() { 1.0 } else { 0.0 });
            if let Some(lumped) = device.lumped {
                blocks.u_s.put(lane, lumped.u_s);
                blocks.j_12.put(lane, lumped.j_12);
                blocks.j_13.put(lane, lumped.j_13);
            }
        }
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

    /// What loads need, as numbers in lanes.
    #[inline(always)]
    pub(super) fn loads_in_lanes<T: Number>(&self, like: T) -> LoadConstants<T> {
        let [x, y, z] = &self.mount;
        let column = |[a, b, c]: &[Block; 3]| [like.load(a), like.load(b), like.load(c)];
        let lumped = |(Lumped { u_s, j_12, j_13 }, has): &(Lumped<Block>, Block)| {
            let (u_s, j_12, j_13) = (like.load(u_s), like.load(j_12), like.load(j_13));
            (Lumped { u_s, j_12, j_13 }, like.load(has).above(like.like(0.0)))
        };
        LoadConstants {
            dry: self.dry,
            mount: [column(x), column(y), column(z)],
            lumped: self.lumped.as_ref().map(lumped),
        }
    }
}

/// What the loads of one device need, in every lane.
#[inline(always)]
pub(super) fn loads_in_lanes<K: Kind<Scalar = f64>, T: Number>(
    device: &Device<K>,
    like: T,
) -> LoadConstants<T> {
    let splat = |number| like.like(number);
    LoadConstants {
        dry: device.is_dry(),
        mount: map(device.mount, |column| map(column, splat)),
        lumped: device.lumped.map(|lumped| (lumped.map(splat), like.same(like))),
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
    /// These spacecraft side by side; lanes without one repeat the last. None without one.
    pub(super) fn of(crafts: &[Spacecraft<D>]) -> Option<Self> {
        let last = crafts.last()?;
        let in_lane = |lane| crafts.get(lane).unwrap_or(last);
        let mut devices = D::new_data(&last.devices, &EachConstants);
        let [mut hub, mut body] = [&last.hub, &last.body].map(|of| of.map(|_| Block::ZERO));
        let mut own = OwnLoads::of(last);
        for lane in 0..WIDEST {
            let put = |mut block: Block, number| {
                block.put(lane, number);
                block
            };
            hub = hub.zip(&in_lane(lane).hub, put);
            body = body.zip(&in_lane(lane).body, put);
            own = own.and(OwnLoads::of(in_lane(lane)));
            let data = &mut devices;
            let mut put = PutConstants { lane };
            let Ok(()) =
                D::visit::<Unique<EachConstants>, _>(&in_lane(lane).devices, data, &mut put);
        }
        let passive = crafts.iter().any(|craft| craft.passive);
        Some(Self { hub, body, devices, passive, own })
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
