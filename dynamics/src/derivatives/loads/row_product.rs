//! [`RowProduct`]: the derivatives of the accelerations by states times changes of these, without their matrix.
//!
//! The hub's accelerations come of all changes, those of the joints of the hub's and of the changes of their own device: a
//! column takes operations in proportion to the number of joints, where the matrix has its square.

#![expect(clippy::inline_always, reason = "instructions are reached only in what is inlined")]

use alloc::vec::Vec;

use crate::derivatives::loads::by_loads::{ByLoads, Change, Own};
use crate::derivatives::loads::kernel_loads::{COORDINATE, RATE};
use crate::derivatives::loads::side_by_side::{Six, add_product};
use crate::derivatives::variable::Variable;
use crate::equations::arithmetic::Arithmetic;
use crate::numbers::real::{Scalar, zero};
use crate::numbers::vec3::Vec3;

/// How many columns of changes are computed side by side.
pub(crate) const COLUMNS: usize = 8;

/// Changes of the states, and what the accelerations change by: rows of one width, which is whole groups.
pub(crate) struct ChangeRows<'a, T> {
    pub(crate) changes: &'a [T],
    pub(crate) width: usize,
    pub(crate) accelerations: &'a mut [T],
}

/// What a state changes.
#[derive(Clone, Copy, Debug)]
struct StateRow<T> {
    /// Where it is among the states.
    row: usize,
    /// The hub's accelerations, as seen from what falls with the field.
    base: Six<T>,
}

/// What is read of the derivatives; kept from stage to stage.
#[derive(Debug)]
pub(crate) struct RowProduct<T> {
    states: Vec<StateRow<T>>,
    /// The field by states.
    field: Vec<(usize, Vec3<T>)>,
    /// By how much less joints accelerate by states of their own device and by the angular velocity: the entries of the
    /// first joint, of the second, and so on.
    less: Vec<(usize, T)>,
    /// How many entries each joint has.
    counts: Vec<usize>,
    /// Where the coordinate and the rate of each joint are among the states, and the angular velocity.
    places: Vec<[Option<usize>; 2]>,
    omega: [Option<usize>; 3],
}

impl<T: Scalar> RowProduct<T> {
    pub(crate) fn new() -> Self {
        let (states, field, less) = (Vec::new(), Vec::new(), Vec::new());
        let (counts, places) = (Vec::new(), Vec::new());
        Self { states, field, less, counts, places, omega: [None; 3] }
    }

    /// Writes the product of the derivatives by these states with their changes.
    pub(crate) fn write(
        &mut self,
        loads: &ByLoads<'_, T>,
        states: &[Variable],
        rows: ChangeRows<'_, T>,
    ) {
        self.read(loads, states);
        let product = Product { of: self, loads, rows };
        match loads.by {
            #[cfg(feature = "lanes")]
            Arithmetic::Dispatched(cpu) => cpu.dispatch(product),
            Arithmetic::Portable => product.write(),
        }
    }

    /// Reads what the states change.
    fn read(&mut self, loads: &ByLoads<'_, T>, states: &[Variable]) {
        let Self { states: rows, field: fields, less, counts, places, omega } = self;
        let joints = loads.devices.joints();
        rows.clear();
        fields.clear();
        places.clear();
        places.resize(joints.len(), [None; 2]);
        *omega = [None; 3];
        for (row, variable) in states.iter().enumerate() {
            let Some(Change { base, field, own }) = loads.change(*variable) else { continue };
            rows.push(StateRow { row, base });
            if let Some(field) = field {
                fields.push((row, field));
            }
            match (own, variable) {
                (Own::All(axis), _) => omega[axis as usize % 3] = Some(row),
                (
                    Own::Device { place, .. },
                    Variable::Coordinate(joint) | Variable::Rate(joint),
                ) => {
                    let of = places.get_mut(*joint).and_then(|of| of.get_mut(place));
                    if let Some(of) = of {
                        *of = Some(row);
                    }
                }
                _ => {}
            }
        }
        less.clear();
        counts.clear();
        for (number, joint) in joints.iter().enumerate() {
            let before = less.len();
            let last = joint.first.wrapping_add(joint.count);
            let own = joints.get(joint.first..last).unwrap_or_default();
            let line = number.wrapping_sub(joint.first);
            for (of, places) in own.iter().zip(places.iter().skip(joint.first)) {
                let Some(line) = of.less.get(line) else { continue };
                let entries = places.iter().zip([line[COORDINATE], line[RATE]]);
                less.extend(entries.filter_map(|(row, entry)| row.map(|row| (row, entry))));
            }
            let by_omega = omega.iter().zip(loads.devices.gains.by_omega(number));
            less.extend(by_omega.filter_map(|(row, entry)| row.map(|row| (row, entry))));
            counts.push(less.len().wrapping_sub(before));
        }
    }
}

/// A product by the instructions of this CPU.
struct Product<'a, 'b, T> {
    of: &'a RowProduct<T>,
    loads: &'a ByLoads<'b, T>,
    rows: ChangeRows<'a, T>,
}

#[cfg(feature = "lanes")]
impl<T: Scalar> pulp::WithSimd for Product<'_, '_, T> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        self.write();
    }
}

impl<T: Scalar> Product<'_, '_, T> {
    #[inline(always)]
    fn write(self) {
        let Self { of, loads, rows: ChangeRows { changes, width, accelerations } } = self;
        for first in (0..width).step_by(COLUMNS) {
            let group = |row: usize| -> Option<&[T; COLUMNS]> {
                changes.get(row.wrapping_mul(width).wrapping_add(first)..)?.first_chunk()
            };
            let mut to = accelerations.chunks_exact_mut(width.max(1)).map_while(|line| {
                let (_, group) = line.split_at_mut_checked(first)?;
                group.first_chunk_mut::<COLUMNS>()
            });
            let mut base = [[zero::<T>(); COLUMNS]; 6];
            let mut meets = false;
            for StateRow { row, base: by } in &of.states {
                let Some(change) = group(*row) else { continue };
                meets = meets || change.iter().any(|change| !change.vanishes());
                for (sum, by) in base.iter_mut().zip(by) {
                    add_product(sum, *by, change);
                }
            }
            if !meets {
                to.for_each(|to| *to = [zero(); COLUMNS]);
                continue;
            }
            let mut hub = base;
            for (row, field) in &of.field {
                let Some(change) = group(*row) else { continue };
                for (sum, by) in hub.iter_mut().zip(field) {
                    add_product(sum, *by, change);
                }
            }
            // In this order: the row after those of the hub stays.
            hub.into_iter().zip(to.by_ref()).for_each(|(hub, to)| *to = hub);
            let mut less = of.less.as_slice();
            for ((number, to), count) in to.enumerate().zip(&of.counts) {
                let mut sum = [zero::<T>(); COLUMNS];
                for (by, base) in loads.devices.gains.of_joint(number).iter().zip(&base) {
                    add_product(&mut sum, *by, base);
                }
                let (own, others) = less.split_at_checked(*count).unwrap_or_default();
                less = others;
                for (row, entry) in own {
                    let Some(change) = group(*row) else { continue };
                    add_product(&mut sum, -*entry, change);
                }
                *to = sum;
            }
        }
    }
}
