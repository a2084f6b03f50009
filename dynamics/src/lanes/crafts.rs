//! [`Crafts`]: the spacecraft of a batch, one for all states or one for each.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use super::constants::{CraftBlocks, OwnLoads};
use super::evaluate::LanedCraft;
use super::laned_set::LanedSet;
use super::slot::{SlotsOf, enter_constants};
use crate::numbers::laned::Number;
use crate::solve::spacecraft::Spacecraft;

/// The spacecraft of a batch.
pub(super) trait Crafts<D: LanedSet>: Sync {
    /// Whether each state has its own.
    const EACH: bool;

    /// Whether the states are split over threads.
    #[cfg(feature = "threads")]
    fn are_on_threads(&self) -> bool;
    /// The number of states that they are for; none where it is any.
    fn count(&self) -> Option<usize>;
    /// That of a state.
    fn at(&self, state: usize) -> Option<&Spacecraft<D>>;
    /// Those of a group of lanes, where each state has its own; none where their lists differ in length.
    fn blocks(&self, group: usize) -> Option<&CraftBlocks<D>>;
    /// What those of a group of lanes have of their own.
    fn own_loads(&self, group: usize) -> OwnLoads;
    /// Whether lanes support those of a group of lanes.
    #[inline(always)]
    fn are_in_lanes(&self, group: usize) -> bool {
        !Self::EACH || self.blocks(group).is_some()
    }
}

/// The spacecraft of a group of lanes; the constants of their devices are taken into the slots.
#[inline(always)]
pub(super) fn entered<'a, D: LanedSet, T: Number, C: Crafts<D>>(
    crafts: &'a C,
    group: usize,
    slots: &mut SlotsOf<D, T>,
    like: T,
) -> Option<LanedCraft<'a, D, T>> {
    let craft = crafts.at(group * T::WIDTH)?;
    let devices = &craft.devices;
    if C::EACH {
        let blocks = crafts.blocks(group)?;
        enter_constants::<D, _>(devices, slots, &blocks.devices);
        let body = blocks.body.map(|block| like.load(&block));
        return Some(LanedCraft { devices, body, passive: blocks.passive });
    }
    let body = craft.body.map(|constant| like.like(constant));
    Some(LanedCraft { devices, body, passive: craft.passive })
}
