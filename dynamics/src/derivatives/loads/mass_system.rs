//! [`MassSystem`]: what accelerations change by where the loads change, all else given: `-M⁻¹ δ(loads)`.
//!
//! The joints of each device are eliminated into the hub's six equations ([`JointElimination`]), as an evaluation does
//! it; joints and a hub whose accelerations are given have no row.

#![expect(clippy::inline_always, reason = "instructions are reached only in what is inlined")]

use alloc::vec::Vec;

use crate::derivatives::loads::load_columns::Load;
use crate::equations::hub::HubConstants;
use crate::equations::system::System;
use crate::model::joint_array::MAX_JOINTS;
use crate::numbers::real::{Scalar, one, zero};
use crate::numbers::symmetric::Symmetric;

/// Numbers of the hub: along the axes of B of the translation, then of the rotation.
pub(crate) type Six<T> = [T; 6];

/// How many joints are computed side by side.
const TOGETHER: usize = 4;

/// `M_jj⁻¹ M_jh` of all joints, some side by side: by how much less a free joint accelerates where the hub does.
#[derive(Debug)]
pub(crate) struct Gains<T> {
    groups: Vec<[[T; TOGETHER]; 6]>,
    /// How many joints of the last group there are.
    last: usize,
}

impl<T: Scalar> Gains<T> {
    pub(crate) fn new(joints: usize) -> Self {
        Self { groups: Vec::with_capacity(joints.div_ceil(TOGETHER)), last: TOGETHER }
    }

    /// Those of one more joint.
    #[inline(always)]
    pub(crate) fn push(&mut self, of: &Six<T>) {
        if self.last == TOGETHER {
            self.groups.push([[zero(); TOGETHER]; 6]);
            self.last = 0;
        }
        let last = self.last;
        for (to, gain) in self.groups.last_mut().into_iter().flatten().zip(of) {
            if let Some(to) = to.get_mut(last) {
                *to = *gain;
            }
        }
        self.last = last.saturating_add(1);
    }

    /// What the joints' accelerations are where the hub has these: of joints that nothing moves minus zero.
    #[inline(always)]
    pub(crate) fn follow(&self, base: &Six<T>, out: &mut [T]) {
        let (groups, rest) = out.as_chunks_mut::<TOGETHER>();
        let mut gains = self.groups.iter();
        for (to, gains) in groups.iter_mut().zip(&mut gains) {
            *to = followed(gains, base);
        }
        if let Some(gains) = gains.next() {
            rest.iter_mut().zip(followed(gains, base)).for_each(|(to, from)| *to = from);
        }
    }
}

#[inline(always)]
fn followed<T: Scalar>(gains: &[[T; TOGETHER]; 6], base: &Six<T>) -> [T; TOGETHER] {
    let mut sums = [-zero::<T>(); TOGETHER];
    for (gains, base) in gains.iter().zip(base) {
        for (sum, gain) in sums.iter_mut().zip(gains) {
            *sum = *sum - *gain * *base;
        }
    }
    sums
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

    /// The same for a unit of the right side.
    #[inline(always)]
    pub(crate) fn hub_by_unit(&self, place: usize) -> Six<T> {
        let column = self.inverse.as_ref().and_then(|inverse| inverse.get(place));
        column.copied().unwrap_or([zero(); 6])
    }
}

/// What a [`Load`] of a device is with its joints eliminated.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reduced<T> {
    /// What is left for the hub's equations, on their right side.
    pub(crate) hub: Six<T>,
    /// By how much less its joints accelerate on a hub whose accelerations do not change.
    pub(crate) joints: [T; MAX_JOINTS],
}

impl<T: Scalar> Reduced<T> {
    pub(crate) fn none() -> Self {
        Self { hub: [zero(); 6], joints: [zero(); MAX_JOINTS] }
    }
}

/// The joints of one device, eliminated.
#[derive(Clone, Copy, Debug)]
pub(crate) struct JointElimination<T> {
    pub(crate) count: usize,
    /// Of the joints' mass matrix; of a joint that is not free zero.
    inverse: [[T; MAX_JOINTS]; MAX_JOINTS],
    /// Of each free joint, the loads of the hub by its acceleration.
    coupling: [Six<T>; MAX_JOINTS],
    /// `M_jj⁻¹ M_jh`.
    pub(crate) gains: [Six<T>; MAX_JOINTS],
}

impl<T: Scalar> JointElimination<T> {
    /// With the loads by the joints' accelerations.
    #[inline(always)]
    #[expect(clippy::needless_range_loop, reason = "rows and columns as the formula has them")]
    pub(crate) fn new(
        accelerations: &[Load<T>; MAX_JOINTS],
        free: [bool; MAX_JOINTS],
        count: usize,
    ) -> Self {
        let mut factors = [[zero(); MAX_JOINTS]; MAX_JOINTS];
        let mut coupling = [[zero(); 6]; MAX_JOINTS];
        for row in 0..count {
            for column in 0..=row {
                factors[row][column] = match (free[row] && free[column], row == column) {
                    (true, _) => accelerations[column].joints[row],
                    (false, true) => one(),
                    (false, false) => zero(),
                };
            }
            if free[row] {
                coupling[row] = accelerations[row].hub;
            }
        }
        for row in 0..count {
            for column in 0..row {
                let mut entry = factors[row][column];
                for k in 0..column {
                    entry = entry - factors[row][k] * factors[column][k];
                }
                factors[row][column] = entry;
            }
            let mut pivot = factors[row][row];
            for k in 0..row {
                let factor = factors[row][k] * factors[k][k];
                pivot = pivot - factor * factors[row][k];
                factors[row][k] = factor;
            }
            factors[row][row] = pivot.recip();
        }
        let mut inverse = [[zero(); MAX_JOINTS]; MAX_JOINTS];
        for unit in 0..count {
            if free[unit] {
                inverse[unit] = unit_solved(&factors, unit, count);
            }
        }
        let mut gains = [[zero(); 6]; MAX_JOINTS];
        for row in 0..count {
            for k in 0..count {
                for (to, entry) in gains[row].iter_mut().zip(&coupling[k]) {
                    *to = *to + inverse[k][row] * *entry;
                }
            }
        }
        Self { count, inverse, coupling, gains }
    }

    /// Loads of the hub and of the joints, those of the joints eliminated.
    #[inline(always)]
    pub(crate) fn reduced(&self, hub: &Six<T>, joints: &[T; MAX_JOINTS]) -> Reduced<T> {
        let mut found = Reduced { hub: hub.map(|load| -load), joints: [zero(); MAX_JOINTS] };
        let columns = self.inverse.iter().zip(joints).take(self.count);
        for (column, load) in columns {
            for (to, entry) in found.joints.iter_mut().zip(column).take(self.count) {
                *to = *to + *entry * *load;
            }
        }
        for (coupling, less) in self.coupling.iter().zip(&found.joints).take(self.count) {
            for (to, entry) in found.hub.iter_mut().zip(coupling) {
                *to = *to + *entry * *less;
            }
        }
        found
    }

    /// By the motor of a free joint, which takes one from the joint's load.
    #[inline(always)]
    pub(crate) fn motor(&self, joint: usize) -> Reduced<T> {
        let (gains, column) = (self.gains.get(joint), self.inverse.get(joint));
        let mut found = Reduced::none();
        found.hub.iter_mut().zip(gains.into_iter().flatten()).for_each(|(to, of)| *to = -*of);
        let own = found.joints.iter_mut().zip(column.into_iter().flatten()).take(self.count);
        own.for_each(|(to, of)| *to = -*of);
        found
    }

    /// Subtracts what the free joints take over from the hub's matrix.
    #[inline(always)]
    pub(crate) fn reduce(&self, matrix: &mut [Six<T>; 6]) {
        for (coupling, gains) in self.coupling.iter().zip(&self.gains).take(self.count) {
            for (column, gain) in matrix.iter_mut().zip(gains) {
                for (to, entry) in column.iter_mut().zip(coupling) {
                    *to = *to - *entry * *gain;
                }
            }
        }
    }
}

/// A column of the inverse: `L D Lᵀ v` is a column of the unit matrix, with reciprocal pivots on the diagonal.
#[inline(always)]
fn unit_solved<T: Scalar>(
    factors: &[[T; MAX_JOINTS]; MAX_JOINTS],
    unit: usize,
    count: usize,
) -> [T; MAX_JOINTS] {
    let mut v = [zero::<T>(); MAX_JOINTS];
    v[unit] = one();
    for row in unit.saturating_add(1)..count {
        for k in unit..row {
            v[row] = v[row] - factors[row][k] * v[k];
        }
    }
    for row in (0..count).rev() {
        v[row] = v[row] * factors[row][row];
        for k in row.saturating_add(1)..count {
            v[row] = v[row] - factors[k][row] * v[k];
        }
    }
    v
}

/// The hub's six equations with everything that it carries, by columns.
fn whole<T: Scalar>(hub: &HubConstants<T>, mass: T, devices: &[Six<T>; 6]) -> [Six<T>; 6] {
    let System { m_vw, m_ww, .. } = hub.system([zero(); 3], [zero(); 3], [zero(); 3]);
    let mut matrix = *devices;
    for (axis, (force, moment)) in m_vw.iter().zip(m_ww.columns()).enumerate() {
        matrix[axis][axis] = matrix[axis][axis] + mass;
        let own = force.iter().chain(&moment);
        let column = matrix[axis.wrapping_add(3)].iter_mut().zip(own);
        column.for_each(|(to, from)| *to = *to + *from);
    }
    matrix
}

/// The inverse of a symmetric matrix, by columns.
fn inverse<T: Scalar>(m: &[Six<T>; 6]) -> [Six<T>; 6] {
    let [a, b, c, d, e, f] = m;
    let block = |x: &[T], y: &[T], z: &[T]| Symmetric {
        xx: x[0],
        xy: y[0],
        xz: z[0],
        yy: y[1],
        yz: z[1],
        zz: z[2],
    };
    let unit = |place: usize| [0, 1, 2].map(|own| if own == place { one() } else { zero() });
    [0, 1, 2, 3, 4, 5].map(|place| {
        let system = System {
            m_vv: block(&a[..3], &b[..3], &c[..3]),
            m_vw: [[d[0], d[1], d[2]], [e[0], e[1], e[2]], [f[0], f[1], f[2]]],
            m_ww: block(&d[3..], &e[3..], &f[3..]),
            h_v: unit(place),
            h_w: unit(place.wrapping_sub(3)),
        };
        let (found, _) = system.solved();
        let ([a, b, c], [d, e, f]) = (found.r_b_n_ddot, found.omega_dot);
        [a, b, c, d, e, f]
    })
}
