//! [`RowProduct`]: the derivatives of the accelerations by states times changes of these, without their matrix.
//!
//! The hub's accelerations come of all changes, those of the joints of the hub's and of the changes of their own device: a
//! column takes operations in proportion to the number of joints, where the matrix has its square.

#![expect(clippy::inline_always, reason = "instructions are reached only in what is inlined")]

use alloc::vec::Vec;

use crate::derivatives::loads::by_loads::{ByLoads, Change, Own};
use crate::derivatives::loads::kernel_loads::{COORDINATE, RATE};
use crate::derivatives::loads::side_by_side::add_product;
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
    /// The hub's acceleration and angular acceleration, as seen from what falls with the field.
    base: [Vec3<T>; 2],
}

/// The hub's accelerations in some columns: linear, angular.
type HubColumns<T> = [[[T; COLUMNS]; 3]; 2];

/// What is read of the derivatives; kept from stage to stage.
#[derive(Debug)]
pub(crate) struct RowProduct<T> {
    /// The states that change anything.
    states: Vec<StateRow<T>>,
    /// The field, by numbers of these states.
    field: Vec<(usize, Vec3<T>)>,
    /// By how much less joints accelerate by such states, of their own device and the angular velocity: the entries of the
    /// first joint, of the second, and so on.
    less: Vec<(usize, T)>,
    /// How many entries each joint has.
    counts: Vec<usize>,
    /// Which of these states are the coordinate and the rate of each joint, and the angular velocity.
    places: Vec<[Option<usize>; 2]>,
    omega: [Option<usize>; 3],
    /// The changes of these states, in some columns.
    changes: Vec<[T; COLUMNS]>,
}

impl<T: Scalar> RowProduct<T> {
    pub(crate) fn new() -> Self {
        let (states, field, less) = (Vec::new(), Vec::new(), Vec::new());
        let (counts, places, changes) = (Vec::new(), Vec::new(), Vec::new());
        Self { states, field, less, counts, places, omega: [None; 3], changes }
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
        let Self { states: rows, field: fields, less, counts, places, omega, .. } = self;
        let joints = loads.joints;
        rows.clear();
        fields.clear();
        places.clear();
        places.resize(joints.len(), [None; 2]);
        *omega = [None; 3];
        for (row, variable) in states.iter().enumerate() {
            let Some(Change { base, field, own }) = loads.change(*variable) else { continue };
            let number = rows.len();
            let [a, b, c, d, e, f] = base;
            rows.push(StateRow { row, base: [[a, b, c], [d, e, f]] });
            if let Some(field) = field {
                fields.push((number, field));
            }
            match (own, variable) {
                (Own::All(axis), _) => omega[axis as usize % 3] = Some(number),
                (
                    Own::Device { place, .. },
                    Variable::Coordinate(joint) | Variable::Rate(joint),
                ) => {
                    let of = places.get_mut(*joint).and_then(|of| of.get_mut(place));
                    if let Some(of) = of {
                        *of = Some(number);
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
                less.extend(entries.filter_map(|(state, entry)| state.map(|state| (state, entry))));
            }
            let by_omega = omega.iter().zip(loads.gains.by_omega(number));
            less.extend(by_omega.filter_map(|(state, entry)| state.map(|state| (state, entry))));
            counts.push(less.len().wrapping_sub(before));
        }
    }
}

/// A product by the instructions of this CPU.
struct Product<'a, 'b, T> {
    of: &'a mut RowProduct<T>,
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
        let RowProduct { states, field, less, counts, changes: own, .. } = of;
        for first in (0..width).step_by(COLUMNS) {
            own.clear();
            // The changes of all columns are far from each other.
            own.extend(states.iter().map(|StateRow { row, .. }| {
                let from = row.wrapping_mul(width).wrapping_add(first);
                let some = changes.get(from..).and_then(|row| row.first_chunk());
                some.copied().unwrap_or([zero(); COLUMNS])
            }));
            let mut to = accelerations
                .chunks_exact_mut(width.max(1))
                .map_while(|line| line.get_mut(first..)?.first_chunk_mut::<COLUMNS>());
            if !own.iter().any(changes_any) {
                to.for_each(|to| *to = [zero(); COLUMNS]);
                continue;
            }
            let base: HubColumns<T> = [hub::<T, 0>(states, own), hub::<T, 1>(states, own)];
            let mut hub = base;
            for (state, field) in &*field {
                let Some(change) = own.get(*state) else { continue };
                for (sum, by) in hub[0].iter_mut().zip(field) {
                    add_product(sum, *by, change);
                }
            }
            // In this order: the row after those of the hub stays.
            hub.as_flattened().iter().zip(to.by_ref()).for_each(|(hub, to)| *to = *hub);
            let mut less = less.as_slice();
            for ((number, to), count) in to.enumerate().zip(&*counts) {
                let mut sum = [zero::<T>(); COLUMNS];
                let gains = loads.gains.of_joint(number);
                for (by, base) in gains.iter().zip(base.as_flattened()) {
                    add_product(&mut sum, *by, base);
                }
                let (entries, others) = less.split_at_checked(*count).unwrap_or_default();
                less = others;
                for (state, entry) in entries {
                    let Some(change) = own.get(*state) else { continue };
                    add_product(&mut sum, -*entry, change);
                }
                *to = sum;
            }
        }
    }
}

/// Whether anything changes in some columns.
#[inline(always)]
fn changes_any<T: Scalar>(of: &[T; COLUMNS]) -> bool {
    of.iter().fold(false, |any, change| any | !change.vanishes())
}

/// The hub's linear or angular acceleration in some columns: as many sums as there are registers for.
#[inline(always)]
fn hub<T: Scalar, const WHICH: usize>(
    states: &[StateRow<T>],
    changes: &[[T; COLUMNS]],
) -> [[T; COLUMNS]; 3] {
    let mut sums = [[zero::<T>(); COLUMNS]; 3];
    for (StateRow { base, .. }, change) in states.iter().zip(changes) {
        for (sum, by) in sums.iter_mut().zip(base.get(WHICH).into_iter().flatten()) {
            add_product(sum, *by, change);
        }
    }
    sums
}
