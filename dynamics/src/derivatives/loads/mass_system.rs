//! [`MassSystem`]: what accelerations change by where the loads change, all else given: `-M⁻¹ δ(loads)`.
//!
//! The joints of each device are eliminated into the hub's six equations ([`JointElimination`]), as an evaluation does
//! it; joints and a hub whose accelerations are given have no row.

#![expect(clippy::inline_always, reason = "instructions are reached only in what is inlined")]

use alloc::vec::Vec;

use crate::derivatives::loads::joint_elimination::inverse;
use crate::derivatives::loads::side_by_side::{Finiteness, HubGroup, Six, TOGETHER, add_product};
use crate::equations::hub::HubConstants;
use crate::equations::system::System;
use crate::numbers::real::{Scalar, zero};

/// Of some joints in a row.
type Block<T> = [[T; TOGETHER]; 9];

/// By how much less free joints accelerate: `M_jj⁻¹ M_jh` by each acceleration of the hub, then by each component of its
/// angular velocity. Some joints after one another side by side.
#[derive(Debug)]
pub(crate) struct Gains<T> {
    blocks: Vec<Block<T>>,
}

impl<T: Scalar> Gains<T> {
    pub(crate) const fn none() -> Self {
        Self { blocks: Vec::new() }
    }

    /// Room for so many joints.
    pub(crate) fn resize(&mut self, joints: usize) {
        self.blocks.resize(joints.div_ceil(TOGETHER), [[zero(); TOGETHER]; 9]);
    }

    /// Sets those of a joint: by the hub's accelerations, by its angular velocity.
    #[inline(always)]
    pub(crate) fn set(&mut self, joint: usize, of: &Six<T>, by_omega: &[T; TOGETHER]) {
        let Some(block) = self.blocks.get_mut(joint / TOGETHER) else { return };
        for (line, gain) in block.iter_mut().zip(of.iter().chain(by_omega)) {
            line[joint % TOGETHER] = *gain;
        }
    }

    /// What the joints' accelerations are where the hub has these: of joints that nothing moves minus zero. Sees all of
    /// them: a loop with a sum is not vectorised across blocks, which would gather their numbers.
    #[inline(always)]
    pub(crate) fn follow(&self, base: &Six<T>, out: &mut [T], finite: &mut Finiteness<T>) {
        let (fours, last) = out.as_chunks_mut::<TOGETHER>();
        let mut blocks = self.blocks.iter();
        for (to, block) in fours.iter_mut().zip(&mut blocks) {
            *to = followed(block, base);
            finite.see(to);
        }
        if let Some(block) = blocks.next() {
            last.iter_mut().zip(followed(block, base)).for_each(|(to, from)| *to = from);
            finite.see_each(last);
        }
    }

    /// The same, twice, and zeros.
    #[inline(always)]
    pub(crate) fn follow_twice(
        &self,
        base: &Six<T>,
        [out, copy, zeros]: [&mut [T]; 3],
        finite: &mut Finiteness<T>,
    ) {
        let (fours, last) = out.as_chunks_mut::<TOGETHER>();
        let (copies, last_copy) = copy.as_chunks_mut::<TOGETHER>();
        let (cleared, last_zeros) = zeros.as_chunks_mut::<TOGETHER>();
        let mut blocks = self.blocks.iter();
        for (((to, copy), zeros), block) in
            fours.iter_mut().zip(copies).zip(cleared).zip(&mut blocks)
        {
            let found = followed(block, base);
            (*to, *copy, *zeros) = (found, found, [zero(); TOGETHER]);
            finite.see(&found);
        }
        if let Some(block) = blocks.next() {
            let found = followed(block, base);
            last.iter_mut().zip(found).for_each(|(to, from)| *to = from);
            last_copy.iter_mut().zip(found).for_each(|(to, from)| *to = from);
            last_zeros.fill(zero());
            finite.see_each(last);
        }
    }

    /// Takes what they accelerate less by the angular velocity about an axis.
    #[inline(always)]
    pub(crate) fn subtract_by_omega(&self, axis: usize, out: &mut [T]) {
        for (to, block) in out.chunks_mut(TOGETHER).zip(&self.blocks) {
            let line = block.get(axis.wrapping_add(6)).into_iter().flatten();
            to.iter_mut().zip(line).for_each(|(to, less)| *to = *to - *less);
        }
    }
}

/// What some joints' accelerations are where the hub has these.
#[inline(always)]
fn followed<T: Scalar>(block: &Block<T>, base: &Six<T>) -> [T; TOGETHER] {
    let ([a, b, c, d, e, f, ..], mut found) = (block, [zero(); TOGETHER]);
    for (k, to) in found.iter_mut().enumerate() {
        let linear = -(a[k] * base[0]) - b[k] * base[1] - c[k] * base[2];
        *to = linear - d[k] * base[3] - e[k] * base[4] - f[k] * base[5];
    }
    found
}

/// The hub's equations with the joints of all devices eliminated.
#[derive(Debug)]
pub(crate) struct MassSystem<T> {
    /// The inverse of what is left for the hub, by columns; none where its accelerations are given.
    inverse: Option<[Six<T>; 6]>,
}

impl<T: Scalar> MassSystem<T> {
    /// Of a hub whose accelerations are free or not, with the mass of the whole and what the devices add.
    pub(crate) fn new(
        hub: &HubConstants<T>,
        mass: T,
        devices: &[Six<T>; 6],
        hub_is_free: bool,
    ) -> Self {
        Self { inverse: hub_is_free.then(|| inverse(&whole(hub, mass, devices))) }
    }

    /// The hub's accelerations for a right side of its equations; those that are given where it is not free.
    #[inline(always)]
    pub(crate) fn hub(&self, right: &Six<T>, given: Six<T>) -> Six<T> {
        let Some(inverse) = &self.inverse else { return given };
        let mut base = [zero(); 6];
        for (column, load) in inverse.iter().zip(right) {
            for (to, entry) in base.iter_mut().zip(column) {
                *to = *to + *entry * *load;
            }
        }
        base
    }

    /// The same in place of a group of right sides; zero where they are given.
    #[inline(always)]
    pub(crate) fn hub_of_group(&self, group: &mut HubGroup<T>) {
        let mut base = [[zero(); TOGETHER]; 6];
        for (column, loads) in self.inverse.iter().flatten().zip(&*group) {
            for (to, entry) in base.iter_mut().zip(column) {
                add_product(to, *entry, loads);
            }
        }
        *group = base;
    }

    /// The same for a unit of the right side.
    #[inline(always)]
    pub(crate) fn hub_by_unit(&self, place: usize) -> Six<T> {
        let column = self.inverse.as_ref().and_then(|inverse| inverse.get(place));
        column.copied().unwrap_or([zero(); 6])
    }
}

/// The hub's six equations with everything that it carries, by rows: above the diagonal, and it.
fn whole<T: Scalar>(hub: &HubConstants<T>, mass: T, devices: &[Six<T>; 6]) -> [Six<T>; 6] {
    let System { m_vw, m_ww, .. } = hub.system([zero(); 3], [zero(); 3], [zero(); 3]);
    let mut matrix = *devices;
    for (axis, (force, moment)) in m_vw.iter().zip(m_ww.columns()).enumerate() {
        matrix[axis][axis] = matrix[axis][axis] + mass;
        let own = force.iter().chain(&moment);
        let column = matrix[axis.wrapping_add(3)].iter_mut().zip(own);
        column.for_each(|(to, from)| *to = *to + *from);
    }
    let mut rows = matrix;
    for (row, line) in rows.iter_mut().enumerate() {
        for (to, column) in line.iter_mut().zip(&matrix) {
            *to = column[row];
        }
    }
    rows
}
