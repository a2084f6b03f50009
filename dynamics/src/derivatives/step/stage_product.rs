//! [`Product`]: a matrix of derivatives times changes, row by row, as the stages of a step need it.
//!
//! Columns of the matrix that are zero, as by the position without a central field, are left out, and groups of changes
//! that meet only these.

#![expect(clippy::inline_always, reason = "instructions are reached only in what is inlined")]

use alloc::vec::Vec;

use nalgebra::DMatrix;

use crate::derivatives::linearization::columns_of;
use crate::derivatives::loads::row_product::COLUMNS;
use crate::derivatives::loads::side_by_side::TOGETHER;

/// Of how many rows.
const ROWS: usize = 2;

/// What is packed for products; kept from stage to stage.
#[derive(Debug, Default)]
pub(crate) struct Product {
    /// The columns of the matrix that are not zero.
    filled: Vec<usize>,
    /// Their elements, some rows after others.
    packed: Vec<[f64; ROWS]>,
    /// The changes in their rows, of some columns.
    changes: Vec<[f64; COLUMNS]>,
}

impl Product {
    /// Writes the product with rows of changes of this width, which is whole groups.
    #[inline(always)]
    pub(crate) fn write(
        &mut self,
        matrix: &DMatrix<f64>,
        (changes, width): (&[f64], usize),
        to: &mut [f64],
    ) {
        self.pack(matrix);
        // Of a matrix of zeros no row is packed.
        to.fill(0.0);
        for first in (0..width).step_by(COLUMNS) {
            self.changes.clear();
            let rows = self.filled.iter().map(|row| {
                let place = row.saturating_mul(width).saturating_add(first);
                let group = changes.get(place..).and_then(|row| row.first_chunk::<COLUMNS>());
                group.copied().unwrap_or_default()
            });
            self.changes.extend(rows);
            let meets = self.changes.iter().any(|row| row.iter().any(|change| *change != 0.0));
            let mut lines = to.chunks_mut(width);
            for packed in self.packed.chunks(self.filled.len().max(1)) {
                let sums =
                    if meets { summed(packed, &self.changes) } else { [[0.0; COLUMNS]; ROWS] };
                for (line, sums) in lines.by_ref().take(ROWS).zip(sums) {
                    let line = line.get_mut(first..).and_then(|line| line.first_chunk_mut());
                    if let Some(line) = line {
                        *line = sums;
                    }
                }
            }
        }
    }

    fn pack(&mut self, matrix: &DMatrix<f64>) {
        let rows = matrix.nrows();
        let columns = || matrix.as_slice().chunks_exact(rows.max(1));
        let filled = columns().enumerate();
        let filled = filled.filter(|(_, column)| column.iter().any(|element| *element != 0.0));
        self.filled.clear();
        self.filled.extend(filled.map(|(number, _)| number));
        self.packed.clear();
        for first in (0..rows).step_by(ROWS) {
            for number in &self.filled {
                let place = number.saturating_mul(rows).saturating_add(first);
                let of = matrix.as_slice().get(place..).unwrap_or_default();
                let mut elements = [0.0; ROWS];
                let rows = elements.iter_mut().zip(of).take(rows.saturating_sub(first));
                rows.for_each(|(to, from)| *to = *from);
                self.packed.push(elements);
            }
        }
    }
}

/// Some rows of the product with some columns.
#[inline(always)]
fn summed(packed: &[[f64; ROWS]], changes: &[[f64; COLUMNS]]) -> [[f64; COLUMNS]; ROWS] {
    let mut sums = [[0.0; COLUMNS]; ROWS];
    for (elements, changes) in packed.iter().zip(changes) {
        for (sums, element) in sums.iter_mut().zip(elements) {
            for (sum, change) in sums.iter_mut().zip(changes) {
                *sum += *element * *change;
            }
        }
    }
    sums
}

/// Adds the elements of a matrix to rows of this width, from a column on.
#[inline(always)]
pub(crate) fn add_elements(matrix: &DMatrix<f64>, first: usize, (to, width): (&mut [f64], usize)) {
    let columns = || matrix.as_slice().chunks_exact(matrix.nrows().max(1));
    let mut row = 0_usize;
    for some in to.chunks_mut(width.saturating_mul(TOGETHER).max(1)) {
        let (mut lines, mut after) = (some.chunks_exact_mut(width.max(1)), row);
        let four = [(); TOGETHER].map(|()| lines.next().and_then(|line| line.get_mut(first..)));
        match four {
            [Some(a), Some(b), Some(c), Some(d)] => {
                let lines = a.iter_mut().zip(b).zip(c).zip(d);
                for ((((a, b), c), d), column) in lines.zip(columns()) {
                    let elements = column.get(row..).and_then(|of| of.first_chunk::<TOGETHER>());
                    let Some([w, x, y, z]) = elements else { break };
                    (*a, *b, *c, *d) = (*a + w, *b + x, *c + y, *d + z);
                }
            }
            // The last rows.
            few => {
                for line in few.into_iter().flatten() {
                    for (to, column) in line.iter_mut().zip(columns()) {
                        *to += column.get(after).copied().unwrap_or_default();
                    }
                    after = after.saturating_add(1);
                }
            }
        }
        row = row.saturating_add(TOGETHER);
    }
}

/// Writes columns of rows of this width, from a column on, into those of a matrix.
#[inline(always)]
pub(crate) fn write_columns((of, width): (&[f64], usize), first: usize, matrix: &mut DMatrix<f64>) {
    let mut row = 0_usize;
    for some in of.chunks(width.saturating_mul(TOGETHER).max(1)) {
        let (mut lines, mut after) = (some.chunks_exact(width.max(1)), row);
        let four = [(); TOGETHER].map(|()| lines.next().and_then(|line| line.get(first..)));
        match four {
            [Some(a), Some(b), Some(c), Some(d)] => {
                let lines = a.iter().zip(b).zip(c).zip(d);
                for ((((a, b), c), d), column) in lines.zip(columns_of(matrix)) {
                    let to = column.get_mut(row..).and_then(|to| to.first_chunk_mut());
                    if let Some(to) = to {
                        *to = [*a, *b, *c, *d];
                    }
                }
            }
            // The last rows.
            few => {
                for line in few.into_iter().flatten() {
                    for (from, column) in line.iter().zip(columns_of(matrix)) {
                        column.iter_mut().skip(after).take(1).for_each(|to| *to = *from);
                    }
                    after = after.saturating_add(1);
                }
            }
        }
        row = row.saturating_add(TOGETHER);
    }
}
