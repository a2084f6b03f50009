//! [`MassSystem`]: what accelerations change by where the loads change, all else given: `-M⁻¹ δ(loads)`.
//!
//! The joints of each device are eliminated into the hub's six equations ([`JointElimination`]), as an evaluation does
//! it; joints and a hub whose accelerations are given have no row.

#![expect(clippy::inline_always, reason = "instructions are reached only in what is inlined")]

use crate::derivatives::loads::joint_elimination::inverse;
use crate::derivatives::loads::side_by_side::{Finiteness, HubGroup, Six, TOGETHER, add_product};
use crate::equations::hub::HubConstants;
use crate::numbers::real::{Scalar, zero};
use crate::numbers::vec3::Vec3;

/// Of some joints in a row.
pub(crate) type Block<T, const P: usize = TOGETHER> = [[T; P]; 9];

/// How free joints follow the hub: `-M_jj⁻¹ M_jh` by each of its accelerations; then by how much less they accelerate by
/// each component of its angular velocity. So many joints after one another side by side.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Gains<'a, T, const P: usize = TOGETHER> {
    pub(crate) blocks: &'a [Block<T, P>],
}

/// Sets those of a joint, by how much less it accelerates: by the hub's accelerations, by its angular velocity.
#[inline(always)]
pub(crate) fn set_gains<T: Scalar, const P: usize>(
    blocks: &mut [Block<T, P>],
    joint: usize,
    of: &Six<T>,
    by_omega: &Vec3<T>,
) {
    let Some(block) = blocks.get_mut(joint / P.max(1)) else { return };
    let ([a, b, c, d, e, f], [p, q, r]) = (*of, *by_omega);
    for (line, gain) in block.iter_mut().zip([-a, -b, -c, -d, -e, -f, p, q, r]) {
        if let Some(to) = line.get_mut(joint % P.max(1)) {
            *to = gain;
        }
    }
}

impl<T: Scalar, const P: usize> Gains<'_, T, P> {
    /// What the joints' accelerations are where the hub has these: of joints that nothing moves minus zero. Sees all of
    /// them: a loop with a sum is not vectorised across blocks, which would gather their numbers.
    #[inline(always)]
    pub(crate) fn follow(&self, base: &Six<T>, out: &mut [T], finite: &mut Finiteness<T>) {
        let (whole, last) = out.as_chunks_mut::<P>();
        let mut blocks = self.blocks.iter();
        for (to, block) in whole.iter_mut().zip(&mut blocks) {
            *to = followed(block, base);
            finite.see(to);
        }
        if let Some(block) = blocks.next() {
            last.iter_mut().zip(followed(block, base)).for_each(|(to, from)| *to = from);
            finite.see_each(last);
        }
    }

    /// Takes what they accelerate less by the angular velocity about an axis.
    #[inline(always)]
    pub(crate) fn subtract_by_omega(&self, axis: usize, out: &mut [T]) {
        for (to, block) in out.chunks_mut(P.max(1)).zip(self.blocks) {
            let line = block.get(axis.wrapping_add(6)).into_iter().flatten();
            to.iter_mut().zip(line).for_each(|(to, less)| *to = *to - *less);
        }
    }
}

#[cfg(feature = "alloc")]
impl<T: Scalar> Gains<'_, T> {
    /// The same as `own` changes it, twice, and zeros: three lists of as many joints.
    #[inline(always)]
    pub(crate) fn follow_twice(
        &self,
        base: &Six<T>,
        own: impl Fn([T; TOGETHER], &Block<T>) -> [T; TOGETHER],
        [out, copy, zeros]: [&mut [T]; 3],
        finite: &mut Finiteness<T>,
    ) {
        let (fours, last) = out.as_chunks_mut::<TOGETHER>();
        let (copies, last_copy) = copy.as_chunks_mut::<TOGETHER>();
        let (cleared, last_zeros) = zeros.as_chunks_mut::<TOGETHER>();
        let whole = fours.iter_mut().zip(copies).zip(cleared);
        // Of this list: a sum over lists would be kept in memory.
        let mut seen = Finiteness::of_none();
        for (((to, copy), zeros), block) in whole.zip(self.blocks) {
            let found = own(followed(block, base), block);
            (*to, *copy, *zeros) = (found, found, [zero(); TOGETHER]);
            seen.see(&found);
        }
        finite.see_all(&seen);
        if let (Some(block), false) = (self.blocks.last(), last.is_empty()) {
            let found = own(followed(block, base), block);
            finite.see(&found);
            let few = last.iter_mut().zip(last_copy).zip(last_zeros);
            for (((to, copy), cleared), found) in few.zip(found) {
                (*to, *copy, *cleared) = (found, found, zero());
            }
        }
    }

    /// The same, of one list.
    #[inline(always)]
    pub(crate) fn follow_changed(
        &self,
        base: &Six<T>,
        own: impl Fn([T; TOGETHER], &Block<T>) -> [T; TOGETHER],
        out: &mut [T],
        finite: &mut Finiteness<T>,
    ) {
        let (fours, last) = out.as_chunks_mut::<TOGETHER>();
        let mut seen = Finiteness::of_none();
        for (to, block) in fours.iter_mut().zip(self.blocks) {
            *to = own(followed(block, base), block);
            seen.see(to);
        }
        finite.see_all(&seen);
        if let (Some(block), false) = (self.blocks.last(), last.is_empty()) {
            let found = own(followed(block, base), block);
            finite.see(&found);
            last.iter_mut().zip(found).for_each(|(to, found)| *to = found);
        }
    }

    /// How a joint follows each of the hub's accelerations.
    #[inline(always)]
    pub(crate) fn of_joint(&self, joint: usize) -> Six<T> {
        let Some([a, b, c, d, e, f, ..]) = self.blocks.get(joint / TOGETHER) else {
            return [zero(); 6];
        };
        let place = joint % TOGETHER;
        [a[place], b[place], c[place], d[place], e[place], f[place]]
    }

    /// By how much less a joint accelerates by the angular velocity about each axis.
    #[inline(always)]
    pub(crate) fn by_omega(&self, joint: usize) -> Vec3<T> {
        let Some([.., x, y, z]) = self.blocks.get(joint / TOGETHER) else { return [zero(); 3] };
        let place = joint % TOGETHER;
        [x[place], y[place], z[place]]
    }
}

/// What some joints' accelerations are where the hub has these.
#[inline(always)]
fn followed<T: Scalar, const P: usize>(block: &Block<T, P>, base: &Six<T>) -> [T; P] {
    let ([a, b, c, d, e, f, ..], mut found) = (block, [zero(); P]);
    for (k, to) in found.iter_mut().enumerate() {
        let linear = a[k] * base[0] + b[k] * base[1] + c[k] * base[2];
        *to = linear + d[k] * base[3] + e[k] * base[4] + f[k] * base[5];
    }
    found
}

/// What some joints accelerate less what they do by the angular velocity about an axis.
#[cfg(feature = "alloc")]
#[inline(always)]
pub(crate) fn less<T: Scalar>(
    mut found: [T; TOGETHER],
    block: &Block<T>,
    axis: usize,
) -> [T; TOGETHER] {
    let line = block.get(axis.wrapping_add(6)).into_iter().flatten();
    found.iter_mut().zip(line).for_each(|(to, less)| *to = *to - *less);
    found
}

/// The hub's equations with the joints of all devices eliminated.
#[derive(Debug)]
pub(crate) struct MassSystem<T> {
    /// The inverse of what is left for the hub, by columns; none where its accelerations are given.
    inverse: Option<[Six<T>; 6]>,
}

impl<T: Scalar> MassSystem<T> {
    /// Of a hub whose accelerations are free or not, with the mass of the whole and what the devices add, by columns of
    /// which those numbers are read that are not below the diagonal.
    #[inline(always)]
    pub(crate) fn new(
        hub: &HubConstants<T>,
        mass: T,
        devices: &[Six<T>; 6],
        hub_is_free: bool,
    ) -> Self {
        Self { inverse: hub_is_free.then(|| inverse(&whole(hub, mass, devices))) }
    }

    /// The hub's accelerations for a right side of its equations; those that are given where it is not free.
    #[cfg(feature = "alloc")]
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
        if let Some(inverse) = &self.inverse {
            for (column, loads) in inverse.iter().zip(&*group) {
                for (to, entry) in base.iter_mut().zip(column) {
                    add_product(to, *entry, loads);
                }
            }
        }
        *group = base;
    }

    /// The same for each unit of the right side; none where they are given.
    #[inline(always)]
    pub(crate) fn hub_by_units(&self) -> Option<&[Six<T>; 6]> {
        self.inverse.as_ref()
    }
}

/// The hub's six equations with everything that it carries, by columns: above the diagonal, and it.
#[inline(always)]
fn whole<T: Scalar>(hub: &HubConstants<T>, mass: T, devices: &[Six<T>; 6]) -> [Six<T>; 6] {
    let (coupling, inertia) = (hub.coupling(), hub.i_b_b.columns());
    let mut matrix = *devices;
    for (axis, column) in matrix.iter_mut().take(3).enumerate() {
        column[axis] = column[axis] + mass;
    }
    for axis in 0..3_usize {
        let column = &mut matrix[axis.wrapping_add(3) % 6];
        for row in 0..3 {
            column[row] = column[row] + coupling[axis][row];
            column[row.wrapping_add(3)] = column[row.wrapping_add(3)] + inertia[axis][row];
        }
    }
    matrix
}
