//! [`JointElimination`]: the joints of one device eliminated into the hub's six equations.

#![expect(clippy::inline_always, reason = "instructions are reached only in what is inlined")]

use crate::derivatives::loads::kernel_loads::DRIVE;
use crate::derivatives::loads::side_by_side::{HubGroup, Six, add_product};
use crate::model::joint_array::MAX_JOINTS;
use crate::numbers::real::{Real, Scalar, one, zero};

/// What a load of a device is with its joints eliminated: what is left for the hub's equations, on their right side, and
/// by how much less its joints accelerate on a hub whose accelerations do not change.
#[cfg(feature = "alloc")]
type Reduced<T, const N: usize> = (Six<T>, [T; N]);

/// The joints of one device, eliminated.
#[derive(Clone, Copy, Debug)]
pub(crate) struct JointElimination<T, const N: usize> {
    /// Of the joints' mass matrix; of a joint that is not free zero.
    inverse: [[T; N]; N],
    /// Of each free joint, the loads of the hub by its acceleration.
    coupling: [Six<T>; N],
    /// `M_jj⁻¹ M_jh`.
    pub(crate) gains: [Six<T>; N],
}

impl<T: Real, const N: usize> JointElimination<T, N> {
    /// With the loads by the joints' accelerations, of joints and hub.
    #[inline(always)]
    pub(crate) fn new(
        zero: T,
        mass: &[[T; N]; N],
        of_hub: &[Six<T>; N],
        free: [bool; MAX_JOINTS],
    ) -> Self {
        let mut coupling = [[zero; 6]; N];
        for row in 0..N {
            if free[row] {
                coupling[row] = of_hub[row];
            }
        }
        let factors = factors(zero, mass, &free);
        let mut inverse = [[zero; N]; N];
        for unit in 0..N {
            if free[unit] {
                inverse[unit] = unit_solved(zero, &factors, unit);
            }
        }
        let mut gains = [[zero; 6]; N];
        for row in 0..N {
            for k in 0..N {
                for (to, entry) in gains[row].iter_mut().zip(&coupling[k]) {
                    *to = *to + inverse[k][row] * *entry;
                }
            }
        }
        Self { inverse, coupling, gains }
    }

    /// Some loads side by side, those of the joints eliminated; those of the hub in place.
    #[inline(always)]
    pub(crate) fn reduce_together<const M: usize, const P: usize>(
        &self,
        zero: T,
        hub: &mut HubGroup<T, P>,
        joints: &[[T; P]; M],
    ) -> [[T; P]; N] {
        let mut less = [[zero; P]; N];
        for (column, loads) in self.inverse.iter().zip(joints) {
            for (to, entry) in less.iter_mut().zip(column) {
                add_product(to, *entry, loads);
            }
        }
        for (row, of_hub) in hub.iter_mut().enumerate() {
            let mut left = *of_hub;
            for load in &mut left {
                *load = -*load;
            }
            for (coupling, less) in self.coupling.iter().zip(&less) {
                add_product(&mut left, coupling[row], less);
            }
            *of_hub = left;
        }
        less
    }

    /// By the motor of a free joint, which takes one from the joint's load.
    #[inline(always)]
    pub(crate) fn motor<const P: usize>(
        &self,
        joint: usize,
        hub: &mut HubGroup<T, P>,
        joints: &mut [[T; P]; N],
    ) {
        for (to, gain) in hub.iter_mut().zip(&self.gains[joint]) {
            to[DRIVE] = -*gain;
        }
        for (to, entry) in joints.iter_mut().zip(&self.inverse[joint]) {
            to[DRIVE] = -*entry;
        }
    }

    /// What the free joints take over of the hub's matrix, less it: by columns, what is not below the diagonal.
    #[inline(always)]
    pub(crate) fn taken_over(&self, zero: T) -> [Six<T>; 6] {
        let mut matrix = [[zero; 6]; 6];
        for (coupling, gains) in self.coupling.iter().zip(&self.gains) {
            for (number, (column, gain)) in matrix.iter_mut().zip(gains).enumerate() {
                let rows = column.iter_mut().zip(coupling).take(number.wrapping_add(1));
                for (to, entry) in rows {
                    *to = *to - *entry * *gain;
                }
            }
        }
        matrix
    }
}

#[cfg(feature = "alloc")]
impl<T: Scalar, const N: usize> JointElimination<T, N> {
    /// Among more joints, which are not free.
    pub(crate) fn padded(&self) -> JointElimination<T, MAX_JOINTS> {
        let mut found = JointElimination {
            inverse: [[zero(); MAX_JOINTS]; MAX_JOINTS],
            coupling: [[zero(); 6]; MAX_JOINTS],
            gains: [[zero(); 6]; MAX_JOINTS],
        };
        for (to, from) in found.inverse.iter_mut().zip(&self.inverse) {
            to.iter_mut().zip(from).for_each(|(to, from)| *to = *from);
        }
        found.coupling.iter_mut().zip(&self.coupling).for_each(|(to, from)| *to = *from);
        found.gains.iter_mut().zip(&self.gains).for_each(|(to, from)| *to = *from);
        found
    }

    /// Loads of the hub and of the joints, those of the joints eliminated.
    #[inline(always)]
    pub(crate) fn reduced(&self, hub: &Six<T>, joints: &[T; N]) -> Reduced<T, N> {
        let (mut left, mut less) = (*hub, [zero(); N]);
        for load in &mut left {
            *load = -*load;
        }
        for (column, load) in self.inverse.iter().zip(joints) {
            for (to, entry) in less.iter_mut().zip(column) {
                *to = *to + *entry * *load;
            }
        }
        for (coupling, less) in self.coupling.iter().zip(&less) {
            for (to, entry) in left.iter_mut().zip(coupling) {
                *to = *to + *entry * *less;
            }
        }
        (left, less)
    }
}

/// `L D Lᵀ` of a symmetric matrix, of which the elements with a first index that is not above the second are read, with
/// reciprocal pivots on the diagonal; of what is not free a unit matrix.
#[inline(always)]
#[expect(clippy::needless_range_loop, reason = "rows and columns as the formula has them")]
fn factors<T: Real, const N: usize>(zero: T, matrix: &[[T; N]; N], free: &[bool]) -> [[T; N]; N] {
    let mut factors = [[zero; N]; N];
    for row in 0..N {
        for column in 0..=row {
            factors[row][column] = match (free[row] && free[column], row == column) {
                (true, _) => matrix[column][row],
                (false, true) => zero.like(1.0),
                (false, false) => zero,
            };
        }
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
    factors
}

/// The inverse of a symmetric matrix, by columns of which those elements are read that are not below the diagonal. Its
/// columns are found side by side.
#[inline(always)]
#[expect(clippy::needless_range_loop, reason = "rows and columns as the formula has them")]
pub(crate) fn inverse<T: Scalar, const N: usize>(matrix: &[[T; N]; N]) -> [[T; N]; N] {
    let mut rows = [[zero(); N]; N];
    for row in 0..N {
        for column in 0..=row {
            rows[column][row] = matrix[row][column];
        }
    }
    let factors = factors(zero(), &rows, &[true; N]);
    let mut inverse = [[zero(); N]; N];
    for row in 0..N {
        inverse[row][row] = one();
        for k in 0..row {
            subtract_row(&mut inverse, row, k, factors[row][k]);
        }
    }
    for row in (0..N).rev() {
        for entry in &mut inverse[row] {
            *entry = *entry * factors[row][row];
        }
        for k in row.saturating_add(1)..N {
            subtract_row(&mut inverse, row, k, factors[k][row]);
        }
    }
    inverse
}

/// Subtracts a multiple of a row from another.
#[inline(always)]
fn subtract_row<T: Scalar, const N: usize>(
    rows: &mut [[T; N]; N],
    from: usize,
    row: usize,
    factor: T,
) {
    let of = rows[row];
    for (to, of) in rows[from].iter_mut().zip(of) {
        *to = *to - factor * of;
    }
}

/// A column of the inverse: `L D Lᵀ v` is a column of the unit matrix, with reciprocal pivots on the diagonal.
#[inline(always)]
fn unit_solved<T: Real, const N: usize>(zero: T, factors: &[[T; N]; N], unit: usize) -> [T; N] {
    let mut v = [zero; N];
    v[unit] = zero.like(1.0);
    for row in unit.saturating_add(1)..N {
        for k in unit..row {
            v[row] = v[row] - factors[row][k] * v[k];
        }
    }
    for row in (0..N).rev() {
        v[row] = v[row] * factors[row][row];
        for k in row.saturating_add(1)..N {
            v[row] = v[row] - factors[k][row] * v[k];
        }
    }
    v
}
