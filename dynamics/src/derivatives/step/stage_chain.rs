//! [`StageChain`]: changes of the state before a step of RK4, and of what is held, carried through its stages.
//!
//! A column is the change of the state by one variable; rows are contiguous, so that all columns are computed side by
//! side. The attitude is carried as a change of the quaternion, in which the step adds its slopes, and returned as a
//! small rotation.

#![expect(clippy::inline_always, reason = "instructions are reached only in what is inlined")]

use alloc::vec::Vec;

use nalgebra::DMatrix;

use crate::attitude::quaternion::{Quaternion, norm_squared, rate};
use crate::derivatives::loads::row_product::{COLUMNS, ChangeRows};
use crate::derivatives::loads::side_by_side::add_product;
use crate::derivatives::slopes::{OF_HUB, Slopes};
use crate::derivatives::step::stage_product::{Product, add_elements, write_columns};
use crate::equations::arithmetic::Arithmetic;
use crate::numbers::vec3::cross;

/// The numbers of a quaternion, scalar first.
pub(crate) type Numbers = [f64; 4];

/// Rows before the step, at the stage, and after the stages so far.
#[derive(Debug, Default)]
struct Rows {
    start: Vec<f64>,
    now: Vec<f64>,
    sum: Vec<f64>,
}

/// The changes so far. Kept from one step to the next, it is allocated once.
#[derive(Debug, Default)]
pub(crate) struct StageChain {
    /// How many columns are by states: the first ones.
    by_states: usize,
    /// Numbers of a row: its columns, filled up with zeros.
    width: usize,
    /// Of the states, those of the attitude at the stage only.
    states: Rows,
    /// Of the quaternion.
    turns: Rows,
    product: Product,
    /// Of the accelerations.
    accelerations: Vec<f64>,
    /// Four rows that are read at once.
    buffer: Vec<f64>,
    /// Whether the changes are those before the step, each of one state.
    first: bool,
}

/// Derivatives of the accelerations at a stage.
pub(crate) struct StageDerivatives<'a> {
    pub(crate) attitude: Quaternion,
    pub(crate) slopes: Slopes<'a, f64>,
    /// By the states; none where their product with the changes was written.
    pub(crate) by_states: Option<&'a DMatrix<f64>>,
    /// By what is held: of the last columns.
    pub(crate) by_held: &'a DMatrix<f64>,
}

impl StageChain {
    /// Begins a step: of columns by some states before it, or by none, and by what is held, where the attitude is this one;
    /// `hub` is whether it moves.
    pub(crate) fn begin_step(
        &mut self,
        [rows, by_states, by_held]: [usize; 3],
        attitude: Quaternion,
        hub: bool,
    ) {
        let width = by_states.saturating_add(by_held).next_multiple_of(COLUMNS);
        let lines = cleared(&mut self.states.start, width.saturating_mul(rows));
        for (number, line) in lines.chunks_mut(width.max(1)).take(by_states).enumerate() {
            line.iter_mut().skip(number).take(1).for_each(|to| *to = 1.0);
        }
        (self.by_states, self.first) = (by_states, true);
        self.start(width, attitude, hub);
    }

    /// Of columns that all change the state before the step, so, and what is held, where the attitude is this one.
    pub(crate) fn begin_changes(
        &mut self,
        changes: &DMatrix<f64>,
        attitude: Quaternion,
        hub: bool,
    ) {
        let width = changes.ncols().next_multiple_of(COLUMNS);
        let lines = cleared(&mut self.states.start, width.saturating_mul(changes.nrows()));
        add_elements(changes, 0, (lines, width));
        (self.by_states, self.first) = (0, false);
        self.start(width, attitude, hub);
    }

    /// Of the rows of states before the step.
    fn start(&mut self, width: usize, attitude: Quaternion, hub: bool) {
        let Self { states, turns, .. } = self;
        let of_turns = cleared(&mut turns.start, width.saturating_mul(4));
        if hub && let Some(rotation) = lines(&states.start, width, 3, 3) {
            let by_rotation = UNITS.map(|unit| rate(numbers(attitude), unit));
            combine(&by_rotation, (rotation, width), of_turns);
        }
        states.begin();
        turns.begin();
        self.accelerations.clear();
        self.width = width;
    }

    /// Numbers of a row.
    pub(crate) fn width(&self) -> usize {
        self.width
    }

    /// Goes to a stage of this attitude, with so many accelerations.
    #[inline(always)]
    pub(crate) fn begin_stage(
        &mut self,
        attitude: Quaternion,
        slopes: &Slopes<'_, f64>,
        accelerations: usize,
    ) {
        let width = self.width;
        if slopes.hub
            && let Some(rotation) = lines_mut(&mut self.states.now, width, 3, 3)
        {
            rotation.fill(0.0);
            combine(&rotations(numbers(attitude)), (&self.turns.now, width), rotation);
        }
        self.accelerations.resize(accelerations.saturating_mul(width), 0.0);
    }

    /// The changes at the stage, and what the accelerations change by with them, to be written; none at the first stage of
    /// changes that are each of one state.
    pub(crate) fn rows(&mut self) -> Option<ChangeRows<'_, f64>> {
        let Self { states, accelerations, width, .. } = self;
        (!self.first).then_some(ChangeRows { changes: &states.now, width: *width, accelerations })
    }

    /// Through a stage, whose slopes count `weight` and lead to the next stage after `offset`, both in s.
    pub(crate) fn stage(&mut self, at: &StageDerivatives<'_>, by: [f64; 2]) {
        match at.slopes.by {
            #[cfg(feature = "lanes")]
            Arithmetic::Dispatched(cpu) => cpu.dispatch(Dispatched { chain: self, at, by }),
            Arithmetic::Portable => self.through(at, by),
        }
    }

    #[inline(always)]
    fn through(&mut self, at: &StageDerivatives<'_>, by: [f64; 2]) {
        let StageDerivatives { attitude, slopes, by_states, by_held } = at;
        let (width, q) = (self.width, numbers(*attitude));
        let changes = (self.states.now.as_slice(), width);
        let accelerations = self.accelerations.as_mut_slice();
        match (by_states, core::mem::take(&mut self.first)) {
            (Some(by_states), false) => self.product.write(by_states, changes, accelerations),
            // Of columns by the states themselves.
            (Some(by_states), true) if self.by_states > 0 => {
                add_elements(by_states, 0, (accelerations, width));
            }
            _ => {}
        }
        add_elements(by_held, self.by_states, (accelerations, width));
        if slopes.hub {
            let accelerations = core::mem::take(&mut self.accelerations);
            self.hub((slopes, q), &accelerations, by);
            self.accelerations = accelerations;
        }
        self.joints(slopes, by);
    }

    /// The changes of the attitude at the stage.
    #[inline(always)]
    pub(crate) fn rotation(&self) -> &[f64] {
        lines(&self.states.now, self.width, 3, 3).unwrap_or_default()
    }

    /// The hub's rows through a stage of this attitude and these changes of the accelerations.
    #[inline(always)]
    pub(crate) fn hub(
        &mut self,
        (slopes, q): (&Slopes<'_, f64>, Numbers),
        accelerations: &[f64],
        by: [f64; 2],
    ) {
        let Self { width, states, turns, buffer, .. } = self;
        let width = *width;
        let none = || [0.0; 3];
        let Some(accelerated) = lines(accelerations, width, 0, 6) else { return };
        let (linear, angular) = accelerated.split_at(width.saturating_mul(3));
        let three = width.saturating_mul(3);
        let buffer = cleared(buffer, width.saturating_mul(4));
        // Of q' = rate(q, omega), which is linear in both.
        let by_turn = QUATERNIONS.map(|unit| rate(unit, slopes.omega));
        combine(&by_turn, (&turns.now, width), buffer);
        if let Some(omega) = lines(&states.now, width, 9, 3) {
            combine(&UNITS.map(|unit| rate(q, unit)), (omega, width), buffer);
        }
        turns.follow(0, buffer, by);
        states.follow_rates([0, three.saturating_mul(2)], three, by);
        let (moved, _) = buffer.split_at_mut(three);
        moved.fill(0.0);
        combine(&UNITS.map(|unit| slopes.in_n(unit, none())), (linear, width), moved);
        if let Some(rotation) = lines(&states.now, width, 3, 3) {
            combine(&UNITS.map(|unit| slopes.in_n(none(), unit)), (rotation, width), moved);
        }
        states.follow(three.saturating_mul(2), moved, by);
        states.follow(three.saturating_mul(3), angular, by);
    }

    /// The rows of joints and modes.
    #[inline(always)]
    fn joints(&mut self, slopes: &Slopes<'_, f64>, by: [f64; 2]) {
        let Self { width, states, accelerations, .. } = self;
        let width = *width;
        let place = |row: usize| row.saturating_mul(width);
        let coordinates = if slopes.hub { OF_HUB } else { 0 };
        let rates = coordinates.saturating_add(slopes.moving.len());
        let modes = rates.saturating_add(slopes.moving.len());
        let modal_rates = modes.saturating_add(slopes.modes);
        let moving = place(slopes.moving.len());
        states.follow_rates([place(coordinates), place(rates)], moving, by);
        for (row, joint) in (rates..).zip(slopes.moving) {
            let line = lines(accelerations, width, joint.saturating_add(6), 1).unwrap_or_default();
            states.follow(place(row), line, by);
        }
        states.follow_rates([place(modes), place(modal_rates)], place(slopes.modes), by);
        let of_modes = slopes.joints.saturating_add(6);
        let of_modes = lines(accelerations, width, of_modes, slopes.modes).unwrap_or_default();
        states.follow(place(modal_rates), of_modes, by);
    }

    /// Writes the columns by states and by what is held after the step, whose quaternion was this before it was
    /// normalised.
    #[inline(always)]
    pub(crate) fn finish(&mut self, attitude: Numbers, hub: bool, into: [&mut DMatrix<f64>; 2]) {
        let width = self.width;
        if hub && let Some(rotation) = lines_mut(&mut self.states.sum, width, 3, 3) {
            rotation.fill(0.0);
            combine(&rotations(attitude), (&self.turns.sum, width), rotation);
        }
        let mut first = 0_usize;
        for matrix in into {
            write_columns((&self.states.sum, width), first, matrix);
            first = first.saturating_add(matrix.ncols());
        }
    }
}

/// A stage by the instructions of this CPU.
#[cfg(feature = "lanes")]
struct Dispatched<'a, 'b> {
    chain: &'a mut StageChain,
    at: &'a StageDerivatives<'b>,
    by: [f64; 2],
}

#[cfg(feature = "lanes")]
impl pulp::WithSimd for Dispatched<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        self.chain.through(self.at, self.by);
    }
}

impl Rows {
    /// Goes to the start.
    fn begin(&mut self) {
        self.now.clone_from(&self.start);
        self.sum.clone_from(&self.start);
    }

    /// Adds slopes to the numbers from a place on, and sets those of the next stage.
    #[inline(always)]
    fn follow(&mut self, place: usize, slopes: &[f64], [weight, offset]: [f64; 2]) {
        let Self { start, now, sum } = self;
        let (Some(now), Some(sum), Some(start)) =
            (now.get_mut(place..), sum.get_mut(place..), start.get(place..))
        else {
            return;
        };
        followed([now, sum], [start, slopes], [weight, offset]);
    }

    /// The same with so many numbers, whose slopes are as many of the stage further on.
    #[inline(always)]
    fn follow_rates(&mut self, [place, rates]: [usize; 2], count: usize, by: [f64; 2]) {
        let Self { start, now, sum } = self;
        let (Some((before, after)), Some(sum), Some(start)) =
            (now.split_at_mut_checked(rates), sum.get_mut(place..), start.get(place..))
        else {
            return;
        };
        let now = before.get_mut(place..).unwrap_or_default();
        let slopes = after.get(..count).unwrap_or_default();
        followed([now, sum], [start, slopes], by);
    }
}

/// Adds `weight` slopes to the sum, and sets what is now to the start and `offset` slopes.
#[inline(always)]
fn followed([now, sum]: [&mut [f64]; 2], [start, slopes]: [&[f64]; 2], [weight, offset]: [f64; 2]) {
    for (((now, sum), start), slope) in now.iter_mut().zip(sum).zip(start).zip(slopes) {
        *sum += weight * *slope;
        *now = *start + offset * *slope;
    }
}

const UNITS: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
const QUATERNIONS: [Numbers; 4] =
    [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];

/// Adds a small matrix, by its columns, times rows of whole groups.
#[inline(always)]
fn combine<const FROM: usize, const TO: usize>(
    columns: &[[f64; TO]; FROM],
    (from, width): (&[f64], usize),
    to: &mut [f64],
) {
    for first in (0..width).step_by(COLUMNS) {
        let mut changes = [[0.0; COLUMNS]; FROM];
        let mut place = first;
        for changes in &mut changes {
            let some = from.get(place..).and_then(|row| row.first_chunk());
            *changes = some.copied().unwrap_or_default();
            place = place.wrapping_add(width);
        }
        let mut place = first;
        for row in 0..TO {
            let Some(to) = to.get_mut(place..).and_then(|row| row.first_chunk_mut()) else { break };
            let mut sum: [f64; COLUMNS] = *to;
            for (column, changes) in columns.iter().zip(&changes) {
                add_product(&mut sum, column.get(row).copied().unwrap_or_default(), changes);
            }
            *to = sum;
            place = place.wrapping_add(width);
        }
    }
}

/// So many zeros.
fn cleared(of: &mut Vec<f64>, count: usize) -> &mut [f64] {
    of.clear();
    of.resize(count, 0.0);
    of
}

/// Some rows.
fn lines(of: &[f64], width: usize, first: usize, count: usize) -> Option<&[f64]> {
    of.get(first.saturating_mul(width)..)?.get(..count.saturating_mul(width))
}

/// Some rows, to be changed.
fn lines_mut(of: &mut [f64], width: usize, first: usize, count: usize) -> Option<&mut [f64]> {
    of.get_mut(first.saturating_mul(width)..)?.get_mut(..count.saturating_mul(width))
}

/// The small rotation about the axes of B that a change of each number of a quaternion of any length is:
/// `2 q* dq / |q|²`, its vector.
fn rotations(q: Numbers) -> [[f64; 3]; 4] {
    let [q0, q1, q2, q3] = q;
    let scale = 2.0 / norm_squared(q);
    QUATERNIONS.map(|[b0, b1, b2, b3]| {
        let [x, y, z] = cross([q1, q2, q3], [b1, b2, b3]);
        [
            scale * (q0 * b1 - b0 * q1 - x),
            scale * (q0 * b2 - b0 * q2 - y),
            scale * (q0 * b3 - b0 * q3 - z),
        ]
    })
}

/// The numbers of a quaternion, scalar first.
pub(crate) fn numbers(Quaternion { q0, q1, q2, q3 }: Quaternion) -> Numbers {
    [q0, q1, q2, q3]
}
