//! [`BatchSpacecraft`]: the spacecraft of a batch, one for all states ([`SharedSpacecraft`]) or one for each
//! ([`SpacecraftPerState`]).

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use core::fmt::Debug;
use core::slice;
use std::vec::Vec;

use super::constants::{CraftBlocks, OwnLoads};
use super::evaluate::LanedCraft;
use super::laned_set::LanedSet;
use super::slot::{SlotsOf, enter_constants};
use crate::equations::side_by_side::registers::Registers;
use crate::numbers::laned::Number;
use crate::solve::spacecraft::Spacecraft;

/// The spacecraft of a batch.
pub(super) trait BatchSpacecraft<D: LanedSet>: Debug + Send + Sync {
    /// Whether each state has its own.
    const EACH: bool;

    /// All of them.
    fn all(&self) -> &[Spacecraft<D>];
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

/// One spacecraft for all states.
#[derive(Debug)]
pub(super) struct SharedSpacecraft<D: LanedSet> {
    craft: Spacecraft<D>,
    own: OwnLoads,
}

impl<D: LanedSet> SharedSpacecraft<D> {
    pub(super) fn new(craft: Spacecraft<D>) -> Self {
        Self { own: OwnLoads::of(&craft), craft }
    }
}

impl<D: LanedSet> BatchSpacecraft<D> for SharedSpacecraft<D> {
    const EACH: bool = false;

    fn all(&self) -> &[Spacecraft<D>] {
        slice::from_ref(&self.craft)
    }

    #[inline(always)]
    fn at(&self, _: usize) -> Option<&Spacecraft<D>> {
        Some(&self.craft)
    }

    #[inline(always)]
    fn blocks(&self, _: usize) -> Option<&CraftBlocks<D>> {
        None
    }

    #[inline(always)]
    fn own_loads(&self, _: usize) -> OwnLoads {
        self.own
    }
}

/// One spacecraft for each state.
#[derive(Debug)]
pub(super) struct SpacecraftPerState<D: LanedSet> {
    crafts: Vec<Spacecraft<D>>,
    /// As many spacecraft as there are lanes, side by side; none where their lists differ in length.
    groups: Vec<Option<CraftBlocks<D>>>,
}

impl<D: LanedSet> SpacecraftPerState<D> {
    pub(super) fn new(crafts: Vec<Spacecraft<D>>) -> Self {
        // The registers that every evaluation chooses.
        let groups = crafts.chunks(Registers::widest().map_or(1, Registers::width));
        let groups = groups.map(|group| CraftBlocks::new(group, crafts.first()?)).collect();
        Self { crafts, groups }
    }
}

impl<D: LanedSet> BatchSpacecraft<D> for SpacecraftPerState<D> {
    const EACH: bool = true;

    fn all(&self) -> &[Spacecraft<D>] {
        &self.crafts
    }

    #[inline(always)]
    fn at(&self, state: usize) -> Option<&Spacecraft<D>> {
        self.crafts.get(state)
    }

    #[inline(always)]
    fn blocks(&self, group: usize) -> Option<&CraftBlocks<D>> {
        self.groups.get(group)?.as_ref()
    }

    #[inline(always)]
    fn own_loads(&self, group: usize) -> OwnLoads {
        self.blocks(group).map_or(OwnLoads { dry: false, lumped: false }, |group| group.own)
    }
}

/// The spacecraft of a group of lanes; the constants of their devices are taken into the slots.
#[inline(always)]
pub(super) fn entered<'a, D: LanedSet, T: Number, C: BatchSpacecraft<D>>(
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
