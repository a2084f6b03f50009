//! [`DeviceChain`]: changes of the joints of each device over a step, by few variables.
//!
//! Joints of different devices depend on each other only through the hub. So what a joint changes by is a sum: of terms by
//! the coordinates, rates and drives of its own device before the step, by the angular velocity of the hub before the step,
//! and by the hub's six accelerations at each stage so far. A device takes as many operations whatever the number of others.

#![expect(clippy::inline_always, reason = "instructions are reached only in what is inlined")]

use alloc::vec::Vec;

use crate::derivatives::loads::by_loads::ByLoads;
use crate::derivatives::loads::kernel_loads::{COORDINATE, DRIVE, RATE};
use crate::derivatives::loads::load_columns::JointColumns;
use crate::derivatives::loads::side_by_side::add_product;
use crate::derivatives::step::hub_accelerations::{Columns, EIGHT, HubSums, OF_HUB, TERMS};
use crate::model::joint_array::MAX_JOINTS;

/// Terms that are computed side by side.
type Eight = [f64; EIGHT];

/// Of a row of terms: those by the angular velocity, after which those by the variables of the device are.
const BY_OMEGA: usize = 3;
/// Eights of the terms by the hub's accelerations, which are the last.
const BY_HUB: usize = TERMS / EIGHT;

/// Coordinates and rates of a device.
const STATES: usize = MAX_JOINTS * 2;
/// The hub's accelerations and those of the joints of a device.
const ACCELERATIONS: usize = OF_HUB + MAX_JOINTS;

/// The terms of all joints. Device by device, and eight terms after eight of each: those of its coordinates, then of its rates.
#[derive(Debug, Default)]
pub(crate) struct DeviceChain {
    /// Of the changes at the stage.
    now: Vec<Eight>,
    /// Of those after the stages so far.
    sum: Vec<Eight>,
    /// Of the accelerations of hub and joints by the changes of one device: row by row.
    found: Vec<Eight>,
}

/// A stage: its number, the weight of its slopes, the offset to the next stage and from the start to this one, s.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stage {
    pub(crate) number: usize,
    pub(crate) weight: f64,
    pub(crate) offset: f64,
    pub(crate) before: f64,
}

/// What a state of a joint changes by.
pub(crate) struct StateTerms<'a> {
    /// Its number: coordinates of all joints, then rates.
    pub(crate) state: usize,
    /// By the hub's angular velocity before the step, then by coordinates, rates and drives of its device.
    pub(crate) others: &'a [f64],
    /// By the hub's accelerations at all stages.
    pub(crate) by_hub: &'a [f64],
    /// The first joint of its device, and the number of them.
    pub(crate) first: usize,
    pub(crate) count: usize,
}

impl StateTerms<'_> {
    /// By the hub's angular velocity before the step.
    #[inline(always)]
    pub(crate) fn by_omega(&self) -> &[f64] {
        self.others.get(..BY_OMEGA).unwrap_or_default()
    }

    /// By coordinates, rates and drives of its device.
    #[inline(always)]
    pub(crate) fn by_own(&self) -> impl Iterator<Item = &[f64]> {
        let own = self.others.get(BY_OMEGA..).unwrap_or_default();
        own.chunks_exact(self.count.max(1)).take(3)
    }
}

impl DeviceChain {
    /// Begins a step: joints change by themselves.
    pub(crate) fn begin(&mut self, joints: &[JointColumns<f64>]) {
        let all = devices(joints).map(|own| size(own.len())).sum();
        self.now.clear();
        self.now.resize(all, [0.0; EIGHT]);
        let mut rest = self.now.as_mut_slice();
        for own in devices(joints) {
            let Some((terms, others)) = rest.split_at_mut_checked(size(own.len())) else { break };
            add_units(terms, own.len());
            rest = others;
        }
        self.sum.clone_from(&self.now);
    }

    /// Goes through a stage. Adds to the columns of the hub's accelerations what those by the variables of the devices change
    /// them by, and to `sums` the terms by accelerations at the stages before and by the angular velocity.
    #[inline(always)]
    pub(crate) fn through(
        &mut self,
        loads: &ByLoads<'_, f64>,
        at: Stage,
        columns: &mut Columns<'_>,
        sums: &mut HubSums,
    ) {
        let Self { now, sum, found } = self;
        let (mut now, mut sum) = (now.as_mut_slice(), sum.as_mut_slice());
        for own in devices(loads.joints) {
            let size = size(own.len());
            let (Some((of_now, others)), Some((of_sum, other_sums))) =
                (now.split_at_mut_checked(size), sum.split_at_mut_checked(size))
            else {
                return;
            };
            (now, sum) = (others, other_sums);
            let eights = eights(own.len());
            found.clear();
            found.resize(own.len().saturating_add(OF_HUB).saturating_mul(eights), [0.0; EIGHT]);
            let device = Device { at, own, eights };
            device.accelerate(of_now, found);
            let (hub, joints) = found.split_at_mut(eights.saturating_mul(OF_HUB));
            device.add_to_hub(hub, columns, sums);
            device.add_hub(loads, joints);
            device.follow([of_now, of_sum], joints);
        }
    }

    /// Shows of each state of a joint what it changes by after the step.
    #[inline(always)]
    pub(crate) fn show(&self, joints: &[JointColumns<f64>], mut show: impl FnMut(&StateTerms<'_>)) {
        let mut rest = self.sum.as_slice();
        for own in devices(joints) {
            let (count, Some(of)) = (own.len(), own.first()) else { return };
            let Some((terms, others)) = rest.split_at_checked(size(count)) else { return };
            rest = others;
            let states = count.saturating_mul(2);
            let mut row = [[0.0; EIGHT]; MAX_EIGHTS];
            for place in 0..states {
                let eights = terms.iter().skip(place).step_by(states.max(1));
                row.iter_mut().zip(eights).for_each(|(to, from)| *to = *from);
                let of_rates = if place < count { 0 } else { joints.len().wrapping_sub(count) };
                let state = of.first.wrapping_add(place).wrapping_add(of_rates);
                let by_hub = eights_of_others(count).saturating_mul(EIGHT);
                let (others, by_hub) =
                    row.as_flattened().split_at_checked(by_hub).unwrap_or_default();
                let by_hub = by_hub.get(..TERMS).unwrap_or_default();
                show(&StateTerms { state, others, by_hub, first: of.first, count });
            }
        }
    }
}

/// A device at a stage; `eights` of terms are of each row.
#[derive(Clone, Copy)]
struct Device<'a> {
    at: Stage,
    own: &'a [JointColumns<f64>],
    eights: usize,
}

impl Device<'_> {
    /// Eights of a row that terms by the accelerations at so many stages reach.
    #[inline(always)]
    fn reach(self, stages: usize) -> usize {
        let filled = stages.saturating_mul(OF_HUB).div_ceil(EIGHT);
        self.eights.saturating_sub(BY_HUB).saturating_add(filled)
    }

    /// What the accelerations of hub and joints change by with those of the device.
    #[inline(always)]
    fn accelerate(self, now: &[Eight], found: &mut [Eight]) {
        let Self { at, own, eights } = self;
        let count = own.len();
        let mut by = [[0.0; STATES]; ACCELERATIONS];
        let (of_hub, of_joints) = by.split_at_mut(OF_HUB);
        for (joint, of) in own.iter().enumerate() {
            let rate = joint.wrapping_add(count);
            for (by, row) in of_hub.iter_mut().zip(&of.hub) {
                set(by, joint, row[COORDINATE]);
                set(by, rate, row[RATE]);
            }
            for (by, row) in of_joints.iter_mut().zip(&of.less) {
                set(by, joint, -row[COORDINATE]);
                set(by, rate, -row[RATE]);
            }
        }
        let states = count.saturating_mul(2);
        let groups = now.chunks_exact(states.max(1)).take(self.reach(at.number));
        for (place, terms) in groups.enumerate() {
            let to = found.iter_mut().skip(place).step_by(eights.max(1));
            for (to, by) in to.zip(&by) {
                let mut sum = [0.0; EIGHT];
                by.iter().zip(terms).for_each(|(by, terms)| add_product(&mut sum, *by, terms));
                *to = sum;
            }
        }
    }

    /// Adds what the hub's accelerations change by to the columns of the variables of the device, and to the terms.
    #[inline(always)]
    fn add_to_hub(self, found: &mut [Eight], columns: &mut Columns<'_>, sums: &mut HubSums) {
        let Self { own, eights, .. } = self;
        let (count, Some(first)) = (own.len(), own.first()) else { return };
        let drives = count.saturating_mul(2).saturating_add(BY_OMEGA);
        let lines = found.chunks_exact_mut(eights.max(1)).zip(sums).enumerate();
        for (row, (line, sums)) in lines {
            let line = line.as_flattened_mut();
            let to = line.get_mut(drives..).unwrap_or_default();
            for (to, of) in to.iter_mut().zip(own) {
                *to += of.hub.get(row).map_or(0.0, |row| row[DRIVE]);
            }
            let by_own = line.get(BY_OMEGA..drives.saturating_add(count)).unwrap_or_default();
            columns.add(row, first.first, by_own);
            let (omega, by_hub) = sums.split_at_mut(EIGHT);
            omega.iter_mut().zip(&*line).take(BY_OMEGA).for_each(|(to, of)| *to += *of);
            let place = eights.saturating_sub(BY_HUB).saturating_mul(EIGHT);
            let terms = line.get(place..).unwrap_or_default();
            by_hub.iter_mut().zip(terms).for_each(|(to, of)| *to += *of);
        }
    }

    /// Adds what the accelerations of the joints change by with those of the hub, its angular velocity, and the drives.
    #[inline(always)]
    fn add_hub(self, loads: &ByLoads<'_, f64>, found: &mut [Eight]) {
        let Self { at, own, eights } = self;
        let (count, Some(of)) = (own.len(), own.first()) else { return };
        let drives = count.saturating_mul(2).saturating_add(BY_OMEGA);
        let place = eights.saturating_sub(BY_HUB).saturating_mul(EIGHT);
        for (line, slopes) in found.chunks_exact_mut(eights.max(1)).enumerate() {
            let slopes = slopes.as_flattened_mut();
            let to = slopes.get_mut(drives..).unwrap_or_default();
            for (to, of) in to.iter_mut().zip(own) {
                *to -= of.less.get(line).map_or(0.0, |line| line[DRIVE]);
            }
            let joint = of.first.wrapping_add(line);
            let ([x, y, z], gains) = (loads.gains.by_omega(joint), loads.gains.of_joint(joint));
            slopes.iter_mut().zip([x, y, z]).for_each(|(to, less)| *to -= less);
            let by_hub = slopes.get_mut(place..).unwrap_or_default();
            let by_stages = by_hub.as_chunks_mut::<OF_HUB>().0;
            if let Some(by_stage) = by_stages.get_mut(at.number) {
                by_stage.iter_mut().zip(gains).for_each(|(to, gain)| *to += gain);
            }
            // The angular velocity at the stage is that before the step and what came of the stage before.
            if let Some([.., a, b, c]) = by_stages.get_mut(at.number.wrapping_sub(1)) {
                (*a, *b, *c) = (*a - at.before * x, *b - at.before * y, *c - at.before * z);
            }
        }
    }

    /// Adds the slopes to the sum, and sets what is now to the start, where states change by themselves, and the offset's
    /// slopes.
    #[inline(always)]
    fn follow(self, [now, sum]: [&mut [Eight]; 2], slopes: &[Eight]) {
        let Self { at, own, eights } = self;
        let count = own.len();
        let states = count.saturating_mul(2).max(1);
        let groups = now.chunks_exact_mut(states).zip(sum.chunks_exact_mut(states));
        let reach = self.reach(at.number.saturating_add(1));
        for (place, (now, sum)) in groups.enumerate().take(reach) {
            let (coordinates, rates) = now.split_at_mut(count.min(now.len()));
            let (of_coordinates, of_rates) = sum.split_at_mut(count.min(sum.len()));
            for ((now, sum), rate) in coordinates.iter_mut().zip(of_coordinates).zip(&*rates) {
                add_product(sum, at.weight, rate);
                *now = rate.map(|slope| at.offset * slope);
            }
            let slopes = slopes.iter().skip(place).step_by(eights.max(1));
            for ((now, sum), slope) in rates.iter_mut().zip(of_rates).zip(slopes) {
                add_product(sum, at.weight, slope);
                *now = slope.map(|slope| at.offset * slope);
            }
        }
        add_units(now, count);
    }
}

/// Sets a number.
#[inline(always)]
fn set(of: &mut [f64], place: usize, number: f64) {
    if let Some(to) = of.get_mut(place) {
        *to = number;
    }
}

/// Adds of each state of a device one, by itself.
#[inline(always)]
fn add_units(terms: &mut [Eight], count: usize) {
    let states = count.saturating_mul(2);
    for state in 0..states {
        let term = state.wrapping_add(BY_OMEGA);
        let eight = (term / EIGHT).wrapping_mul(states).wrapping_add(state);
        if let Some(of) = terms.get_mut(eight) {
            of[term % EIGHT] += 1.0;
        }
    }
}

/// Eights of the terms of a device of so many joints that are not by the hub's accelerations.
#[inline(always)]
const fn eights_of_others(count: usize) -> usize {
    count.saturating_mul(3).saturating_add(BY_OMEGA).div_ceil(EIGHT)
}

/// Eights of a row of a device of so many joints.
#[inline(always)]
const fn eights(count: usize) -> usize {
    eights_of_others(count).saturating_add(BY_HUB)
}

/// Those of the longest row.
const MAX_EIGHTS: usize = eights(MAX_JOINTS);

/// Eights of all rows of a device.
#[inline(always)]
const fn size(count: usize) -> usize {
    count.saturating_mul(2).saturating_mul(eights(count))
}

/// The joints of each device.
#[inline(always)]
fn devices(joints: &[JointColumns<f64>]) -> impl Iterator<Item = &[JointColumns<f64>]> {
    let mut rest = joints;
    core::iter::from_fn(move || {
        let (own, others) = rest.split_at_checked(rest.first()?.count.max(1))?;
        rest = others;
        Some(own)
    })
}
