//! Constants of several devices or spacecraft, side by side in lanes.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use std::sync::Arc;
use std::vec::Vec;

use core::convert::Infallible;
use core::fmt;

use super::laned_set::LanedSet;
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

/// Writes the numbers of a device, in the order in which [`DeviceBlocks::new`] reads them.
///
/// Blocks are made from these lists: writing each constant into its lane separately took 300 bytes of
/// code, for hundreds of constants.
fn write<K: Kind<Scalar = f64>>(device: &Device<K>, numbers: &mut Vec<f64>) {
    let mut write = |number| push(numbers, number);
    K::zip_constants(&device.constants, &device.constants, |number, _| write(number));
    K::zip_per_joint(&device.passive, &device.passive, |passive, _| passive.map(&mut write));
    K::zip_per_joint(&device.bound, &device.bound, |number, _| write(number));
    write(flag(!device.free));
    write(flag(device.is_dry()));
    device.mount.iter().flatten().for_each(|number| write(*number));
    write(flag(device.lumped.is_some()));
    device.lumped.unwrap_or(NO_LUMPED).map(write);
}

const NO_LUMPED: Lumped<f64> = Lumped { u_s: 0.0, j_12: 0.0, j_13: 0.0 };

#[inline(never)]
fn push(numbers: &mut Vec<f64>, number: f64) {
    numbers.push(number);
}

/// One where something holds, else zero.
fn flag(holds: bool) -> f64 {
    if holds { 1.0 } else { 0.0 }
}

/// Numbers of as many devices as there are lanes, one device after the other, read as blocks.
struct Blocks<'a> {
    numbers: &'a [f64],
    read: usize,
}

impl Blocks<'_> {
    /// The next number of each device.
    #[inline(never)]
    fn next(&mut self) -> Block {
        let of_one = self.numbers.len() / WIDEST;
        let at = |lane| self.numbers.get(lane * of_one + self.read).copied().unwrap_or(f64::NAN);
        let block = Block(core::array::from_fn(at));
        self.read += 1;
        block
    }

    /// The next number of each device, a flag: as a block, and whether it is set in any lane.
    fn next_flag(&mut self) -> (Block, bool) {
        let block = self.next();
        (block, block != Block::ZERO)
    }
}

impl<K: Kind<Scalar = f64>> DeviceBlocks<K> {
    /// The devices whose [numbers](write) these are, as many as the widest lanes have. `shape` is one of them.
    fn new(shape: &Device<K>, numbers: &[f64]) -> Self {
        let mut blocks = Blocks { numbers, read: 0 };
        let constants = K::zip_constants(&shape.constants, &shape.constants, |_, _| blocks.next());
        let passive =
            K::zip_per_joint(&shape.passive, &shape.passive, |of, _| of.map(|_| blocks.next()));
        let bound = K::zip_per_joint(&shape.bound, &shape.bound, |_, _| blocks.next());
        let (sprung, any_sprung) = blocks.next_flag();
        let (_, dry) = blocks.next_flag();
        let mount = map(shape.mount, |column| map(column, |_| blocks.next()));
        let (has, any_lumped) = blocks.next_flag();
        let lumped = (NO_LUMPED.map(|_| blocks.next()), has);
        debug_assert_eq!(blocks.read, numbers.len() / WIDEST);
        let lumped = any_lumped.then_some(lumped);
        Self { constants, passive, bound, sprung, free: !any_sprung, dry, mount, lumped }
    }

    /// These devices side by side, at most as many as the widest lanes have; lanes without one
    /// repeat the last. None without a device.
    pub(super) fn of(devices: &[Device<K>]) -> Option<Self> {
        let last = devices.last()?;
        let mut numbers = Vec::new();
        for lane in 0..WIDEST {
            write(devices.get(lane).unwrap_or(last), &mut numbers);
        }
        Some(Self::new(last, &numbers))
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
