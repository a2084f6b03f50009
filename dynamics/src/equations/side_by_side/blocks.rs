//! [`DeviceBlocks`]: constants of several devices of one kind, side by side in lanes.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use std::vec::Vec;

use crate::equations::device::Device;
use crate::model::kernels::Kernels;
use crate::model::kind::{Kind, Lumped};
use crate::model::passive::Passive;
use crate::numbers::laned::{Block, Number, WIDEST};
use crate::numbers::real::{Scalar, one, zero};
use crate::numbers::vec3::{Columns, map};

/// Constants of a device of one kind in each lane.
#[derive(Clone, Debug)]
pub struct DeviceBlocks<K: Kernels> {
    pub(crate) constants: K::Constants<Block>,
    pub(crate) passive: K::PerJoint<Passive<Block>>,
    /// What the pivots are checked against.
    pub(crate) bound: K::PerJoint<Block>,
    /// One in the lanes whose device has springs or friction.
    pub(crate) sprung: Block,
    /// Whether there is no such lane.
    pub(crate) free: bool,
    /// Whether a joint in any lane has dry friction.
    pub(crate) dry: bool,
    mount: Columns<Block>,
    /// The lumped model of an imbalance; one in the lanes whose device has it.
    lumped: Option<(Lumped<Block>, Block)>,
}

/// Constants of a device as numbers in lanes.
pub(crate) struct DeviceConstants<K: Kernels, T: Number> {
    pub(crate) constants: K::Constants<T>,
    /// None where no joint has a spring or friction.
    pub(crate) passive: Option<K::PerJoint<Passive<T>>>,
    pub(crate) bound: K::PerJoint<T>,
    /// Where the device has springs or friction.
    pub(crate) sprung: T::Holds,
}

/// What the loads of a device need of it besides.
pub(crate) struct LoadConstants<T: Number> {
    /// Whether a joint has dry friction.
    pub(crate) dry: bool,
    pub(crate) mount: Columns<T>,
    /// The lumped model of an imbalance, and where the device has it.
    pub(crate) lumped: Option<(Lumped<T>, T::Holds)>,
}

/// Writes the numbers of a device, in the order in which [`DeviceBlocks::new`] reads them.
///
/// Blocks are made from these lists: writing each constant into its lane separately took 300 bytes of
/// code, for hundreds of constants.
pub(crate) fn write<K: Kind>(device: &Device<K>, numbers: &mut Vec<f64>) {
    let mut write = |number: K::Scalar| push(numbers, number.to_f64());
    K::zip_constants(&device.constants, &device.constants, |number, _| write(number));
    K::zip_per_joint(&device.passive, &device.passive, |passive, _| passive.map(&mut write));
    K::zip_per_joint(&device.bound, &device.bound, |number, _| write(number));
    write(flag(!device.free));
    write(flag(device.is_dry()));
    device.mount.iter().flatten().for_each(|number| write(*number));
    write(flag(device.lumped.is_some()));
    device.lumped.unwrap_or(NO_LUMPED.map(K::Scalar::from_f64)).map(write);
}

const NO_LUMPED: Lumped<f64> = Lumped { u_s: 0.0, j_12: 0.0, j_13: 0.0 };

#[inline(never)]
fn push(numbers: &mut Vec<f64>, number: f64) {
    numbers.push(number);
}

/// One where something holds, else zero.
fn flag<T: Scalar>(holds: bool) -> T {
    if holds { one() } else { zero() }
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

impl<K: Kind> DeviceBlocks<K> {
    /// The devices whose [numbers](write) these are, as many as the widest lanes have. `shape` is one of them.
    pub(crate) fn new(shape: &Device<K>, numbers: &[f64]) -> Self {
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
    pub(crate) fn of(devices: &[&Device<K>]) -> Option<Self> {
        let last = devices.last()?;
        let mut numbers = Vec::new();
        for lane in 0..WIDEST {
            write(devices.get(lane).unwrap_or(last), &mut numbers);
        }
        Some(Self::new(last, &numbers))
    }

    /// Whether an imbalance in any lane is lumped.
    #[inline(always)]
    pub(crate) fn is_lumped(&self) -> bool {
        self.lumped.is_some()
    }

    /// As numbers in lanes.
    #[inline(always)]
    pub(crate) fn in_lanes<T: Number>(&self, like: T) -> DeviceConstants<K, T> {
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
    pub(crate) fn loads_in_lanes<T: Number>(&self, like: T) -> LoadConstants<T> {
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
pub(crate) fn loads_in_lanes<K: Kind<Scalar = f64>, T: Number>(
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
pub(crate) fn same_in_lanes<K: Kind<Scalar = f64>, T: Number>(
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
