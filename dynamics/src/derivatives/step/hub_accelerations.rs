//! [`StageAccelerations`]: changes of the hub's accelerations at each stage of a step, in rows of all columns; and the joints'
//! rows of the derivatives of the step, which are sums of multiples of them.

#![expect(clippy::inline_always, reason = "instructions are reached only in what is inlined")]

use alloc::vec::Vec;

use nalgebra::DMatrix;

use crate::derivatives::linearization::columns_of;
use crate::derivatives::loads::by_loads::{ByLoads, Change};
use crate::derivatives::loads::load_columns::JointColumns;
use crate::derivatives::loads::row_product::COLUMNS;
use crate::derivatives::loads::side_by_side::add_product;
use crate::derivatives::slopes;
use crate::derivatives::step::device_chain::{DeviceChain, Stage, StateTerms};
use crate::derivatives::variable::{Axis, Variable};

/// Accelerations of the hub.
pub(crate) const OF_HUB: usize = 6;
/// Those at all stages.
pub(crate) const TERMS: usize = OF_HUB * 4;

/// How many terms are computed side by side.
pub(crate) const EIGHT: usize = 8;

/// Of each of the hub's accelerations, terms by its angular velocity before the step, filled up, then by its accelerations at
/// the stages before.
pub(crate) type HubSums = [[f64; EIGHT + TERMS]; OF_HUB];

/// The column by the first component of the angular velocity.
const OMEGA: usize = 9;

/// How many states of joints are computed side by side.
const STATES: usize = COLUMNS;

/// The rows, stage by stage. Kept from one step to the next, they are allocated once.
#[derive(Debug, Default)]
pub(crate) struct StageAccelerations {
    /// Numbers of a row: its columns, filled up with zeros.
    width: usize,
    joints: usize,
    rows: Vec<f64>,
    /// Those of the hub at a stage in a field.
    in_field: Vec<f64>,
    /// Of some states of joints side by side, their terms.
    terms: Vec<[[f64; STATES]; TERMS]>,
}

/// The hub's accelerations at a stage, to be written.
pub(crate) struct Columns<'a> {
    rows: &'a mut [f64],
    width: usize,
    joints: usize,
}

impl Columns<'_> {
    /// Adds to a row what the coordinates, rates and drives of a device change it by.
    #[inline(always)]
    pub(crate) fn add(&mut self, row: usize, first: usize, own: &[f64]) {
        let Self { rows, width, joints } = self;
        let Some(row) = rows.get_mut(row.wrapping_mul(*width)..) else { return };
        let count = own.len() / 3;
        let places = of_joint(*joints, first);
        for (place, own) in places.into_iter().zip(own.chunks_exact(count.max(1))) {
            let to = row.get_mut(place..).unwrap_or_default();
            to.iter_mut().zip(own).for_each(|(to, own)| *to += *own);
        }
    }

    /// Adds to an element.
    #[inline(always)]
    fn put(&mut self, row: usize, column: usize, number: f64) {
        let place = row.wrapping_mul(self.width).wrapping_add(column);
        if let Some(to) = self.rows.get_mut(place) {
            *to += number;
        }
    }
}

/// The columns by coordinate, rate and drive of a joint, where there are so many.
#[inline(always)]
fn of_joint(joints: usize, joint: usize) -> [usize; 3] {
    let coordinate = joint.wrapping_add(slopes::OF_HUB);
    let rate = coordinate.wrapping_add(joints);
    [coordinate, rate, rate.wrapping_add(joints).wrapping_add(OF_HUB)]
}

impl StageAccelerations {
    /// Begins a step, of rows of this width.
    pub(crate) fn begin(&mut self, width: usize, joints: usize) {
        (self.width, self.joints) = (width, joints);
        self.rows.clear();
        self.rows.resize(width.saturating_mul(TERMS), 0.0);
    }

    /// Writes those at a stage, and takes the devices through it. `rotation` has the changes of the attitude.
    #[inline(always)]
    pub(crate) fn through(
        &mut self,
        (loads, devices): (&ByLoads<'_, f64>, &mut DeviceChain),
        at: Stage,
        rotation: &[f64],
    ) {
        let (width, joints) = (self.width, self.joints);
        let before = width.saturating_mul(OF_HUB).saturating_mul(at.number);
        let Some((before, rows)) = self.rows.split_at_mut_checked(before) else { return };
        let Some(rows) = rows.get_mut(..width.saturating_mul(OF_HUB)) else { return };
        let mut columns = Columns { rows, width, joints };
        let mut sums: HubSums = [[0.0; EIGHT + TERMS]; OF_HUB];
        devices.through(loads, at, &mut columns, &mut sums);
        for (row, (terms, by_omega)) in sums.iter_mut().zip(&loads.by_omega).enumerate() {
            terms.iter_mut().zip(by_omega).take(3).for_each(|(to, by)| *to += *by);
            let by_stages = terms.get_mut(EIGHT..).unwrap_or_default();
            let by_stages = by_stages.as_chunks_mut::<OF_HUB>().0;
            // The angular velocity at the stage is that before the step and what came of the stage before.
            if let Some([.., a, b, c]) = by_stages.get_mut(at.number.wrapping_sub(1)) {
                let [x, y, z, _] = by_omega;
                (*a, *b, *c) = (*a + at.before * x, *b + at.before * y, *c + at.before * z);
            }
            for (axis, by) in terms.iter().take(3).enumerate() {
                columns.put(row, OMEGA.wrapping_add(axis), *by);
            }
        }
        let inputs = joints.wrapping_mul(2).wrapping_add(slopes::OF_HUB);
        for (input, by) in loads.by_hub().iter().enumerate() {
            let column = inputs.wrapping_add(input);
            by.iter().enumerate().for_each(|(row, by)| columns.put(row, column, *by));
        }
        for (axis, turned) in Axis::ALL.into_iter().zip(rotation.chunks_exact(width.max(1))) {
            let Some(Change { base, .. }) = loads.change(Variable::Attitude(axis)) else {
                continue;
            };
            add_multiples(&base, turned, columns.rows);
        }
        add_terms(&sums, (before, columns.rows), width);
    }

    /// Those of the hub at a stage, with what a uniform field adds where the attitude changes.
    #[inline(always)]
    pub(crate) fn of_hub(
        &mut self,
        loads: &ByLoads<'_, f64>,
        stage: usize,
        rotation: &[f64],
    ) -> &[f64] {
        let Self { width, rows, in_field, .. } = self;
        let count = width.saturating_mul(OF_HUB);
        let rows = rows.get(count.saturating_mul(stage)..).and_then(|rows| rows.get(..count));
        let rows = rows.unwrap_or_default();
        if !loads.in_field() {
            return rows;
        }
        in_field.clear();
        in_field.extend_from_slice(rows);
        for (axis, turned) in Axis::ALL.into_iter().zip(rotation.chunks_exact((*width).max(1))) {
            let Some(Change { field: Some(field), .. }) = loads.change(Variable::Attitude(axis))
            else {
                continue;
            };
            add_multiples(&field, turned, in_field);
        }
        in_field
    }

    /// Writes the joints' rows of the derivatives of the step, by states and by inputs.
    #[inline(always)]
    pub(crate) fn finish(
        &mut self,
        joints: &[JointColumns<f64>],
        devices: &DeviceChain,
        [a, b]: [&mut DMatrix<f64>; 2],
    ) {
        let states = self.joints.saturating_mul(2);
        self.terms.clear();
        self.terms.resize(states.div_ceil(STATES), [[0.0; STATES]; TERMS]);
        let terms = &mut self.terms;
        devices.show(joints, |StateTerms { state, by_hub, .. }| {
            let Some(terms) = terms.get_mut(state / STATES) else { return };
            for (terms, by) in terms.iter_mut().zip(*by_hub) {
                terms[state % STATES] = *by;
            }
        });
        let mut first = 0_usize;
        for matrix in [&mut *a, &mut *b] {
            for (number, column) in (first..).zip(columns_of(matrix)) {
                if let Some(to) = column.get_mut(slopes::OF_HUB..) {
                    self.write_column(number, to);
                }
            }
            first = first.saturating_add(matrix.ncols());
        }
        let states = a.ncols();
        devices.show(joints, |of| {
            let row = of.state.wrapping_add(slopes::OF_HUB);
            let add = |matrix: &mut DMatrix<f64>, first: usize, by: &[f64]| {
                for (column, by) in (first..).zip(by) {
                    if let Some(to) = matrix.get_mut((row, column)) {
                        *to += *by;
                    }
                }
            };
            let [coordinate, rate, drive] = of_joint(self.joints, of.first);
            add(&mut *a, OMEGA, of.by_omega());
            let mut by_own = of.by_own();
            add(&mut *a, coordinate, by_own.next().unwrap_or_default());
            add(&mut *a, rate, by_own.next().unwrap_or_default());
            add(&mut *b, drive.wrapping_sub(states), by_own.next().unwrap_or_default());
        });
    }

    /// Writes what the joints change by in a column, by the hub's accelerations.
    #[inline(always)]
    fn write_column(&self, number: usize, to: &mut [f64]) {
        let mut by = [0.0; TERMS];
        let rows = self.rows.chunks_exact(self.width.max(1));
        for (by, row) in by.iter_mut().zip(rows) {
            *by = row.get(number).copied().unwrap_or_default();
        }
        if by.iter().all(|by| *by == 0.0) {
            to.fill(0.0);
            return;
        }
        let (whole, last) = to.as_chunks_mut::<STATES>();
        // Coordinates do not change by the accelerations at the last stage.
        let (earlier, _) = by.split_at(TERMS - OF_HUB);
        let coordinates = self.joints / STATES;
        for (number, (to, terms)) in whole.iter_mut().zip(&self.terms).enumerate() {
            *to = summed(if number < coordinates { earlier } else { &by }, terms);
        }
        if let (Some(terms), false) = (self.terms.last(), last.is_empty()) {
            last.iter_mut().zip(summed(&by, terms)).for_each(|(to, sum)| *to = sum);
        }
    }
}

/// The sum of terms in a column.
#[inline(always)]
fn summed(by: &[f64], terms: &[[f64; STATES]; TERMS]) -> [f64; STATES] {
    let mut sum = [0.0; STATES];
    for (by, terms) in by.iter().zip(terms) {
        add_product(&mut sum, *by, terms);
    }
    sum
}

/// Adds multiples of a row to some rows.
#[inline(always)]
fn add_multiples(by: &[f64], row: &[f64], to: &mut [f64]) {
    for (by, to) in by.iter().zip(to.chunks_exact_mut(row.len().max(1))) {
        to.iter_mut().zip(row).for_each(|(to, from)| *to += *by * *from);
    }
}

/// Adds the terms by the accelerations at the stages before.
#[inline(always)]
fn add_terms(sums: &HubSums, (before, rows): (&[f64], &mut [f64]), width: usize) {
    let mut changes = [[0.0; COLUMNS]; TERMS];
    let count = before.len().checked_div(width).unwrap_or_default().min(TERMS);
    if count == 0 {
        return;
    }
    for first in (0..width).step_by(COLUMNS) {
        let mut place = first;
        for changes in changes.iter_mut().take(count) {
            let some = before.get(place..).and_then(|row| row.first_chunk());
            *changes = some.copied().unwrap_or_default();
            place = place.wrapping_add(width);
        }
        let changes = changes.get(..count).unwrap_or_default();
        let mut place = first;
        for sums in sums {
            let (_, terms) = sums.split_at(EIGHT);
            let mut found = [0.0; COLUMNS];
            for (by, changes) in terms.iter().zip(changes) {
                add_product(&mut found, *by, changes);
            }
            let to = rows.get_mut(place..).and_then(|row| row.first_chunk_mut::<COLUMNS>());
            if let Some(to) = to {
                add_product(to, 1.0, &found);
            }
            place = place.wrapping_add(width);
        }
    }
}
