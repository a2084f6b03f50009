//! [`Resolvent`]: `C (z 1 - A)^-1 B` at many z, `A` balanced and reduced to Hessenberg form once.
//!
//! With `A = Q H Q^T` a z takes the elimination of one row by the one above it, `n² / 2` products, and as many for each column
//! of `B`: Golub, Van Loan, *Matrix Computations*, 4th edition, 7.4. Eigenvalues of `A` within rounding of each other move by more than
//! rounding, so that near these the response is less exact than a solution with `A` itself.

use alloc::vec::Vec;

use nalgebra::{Complex, DMatrix, Hessenberg};

use crate::linear::held::balanced;

/// What is reduced.
#[derive(Clone, Debug)]
pub(super) struct Resolvent {
    /// Transpose of the Hessenberg form: its rows one after another.
    rows: DMatrix<f64>,
    /// Transposes of `Q^T B`, for each of some `B`.
    inputs: Vec<DMatrix<f64>>,
    /// `C Q`.
    outputs: DMatrix<Complex<f64>>,
}

impl Resolvent {
    /// Of a square matrix, of several `B` with as many rows, and of `C` with as many columns.
    pub(super) fn new(a: &DMatrix<f64>, inputs: &[&DMatrix<f64>], outputs: &DMatrix<f64>) -> Self {
        let (balanced, scale) = balanced(a);
        let (q, h) = if balanced.nrows() > 2 {
            Hessenberg::new(balanced).unpack()
        } else {
            (DMatrix::identity(a.nrows(), a.nrows()), balanced)
        };
        let mut to = q.transpose();
        let mut from = q;
        for (k, factor) in scale.iter().enumerate() {
            from.row_mut(k).scale_mut(*factor);
            to.column_mut(k).scale_mut(factor.recip());
        }
        Self {
            rows: h.transpose(),
            inputs: inputs.iter().map(|b| (&to * *b).transpose()).collect(),
            outputs: (outputs * from).map(|element| Complex::new(element, 0.0)),
        }
    }

    /// `C (z 1 - A)^-1 (B_0 s_0 + B_1 s_1 + ..)`; none where a pivot is zero.
    pub(super) fn at(
        &self,
        z: Complex<f64>,
        scales: &[Complex<f64>],
    ) -> Option<DMatrix<Complex<f64>>> {
        let n = self.rows.nrows();
        let inputs = self.inputs.first().map_or(0, DMatrix::nrows);
        // Columns are rows of the equations.
        let mut rows = self.rows.map(|element| Complex::new(-element, 0.0));
        let mut right = DMatrix::from_element(inputs, n, Complex::new(0.0, 0.0));
        for (of, scale) in self.inputs.iter().zip(scales) {
            right.zip_apply(of, |to, element| *to += *scale * element);
        }
        for k in 0..n {
            rows[(k, k)] += z;
        }
        for k in 1..n {
            let above = k.saturating_sub(1);
            if rows[(above, k)].norm_sqr() > rows[(above, above)].norm_sqr() {
                rows.swap_columns(above, k);
                right.swap_columns(above, k);
            }
            let factor = rows[(above, k)] * inverse(rows[(above, above)])?;
            eliminate(&mut rows, (above, k), k, factor);
            eliminate(&mut right, (above, k), 0, factor);
        }
        for k in (0..n).rev() {
            let pivot = inverse(rows[(k, k)])?;
            right.column_mut(k).iter_mut().for_each(|element| *element *= pivot);
            for above in 0..k {
                let factor = rows[(k, above)];
                eliminate(&mut right, (k, above), 0, factor);
            }
        }
        Some(&self.outputs * right.transpose())
    }
}

fn inverse(of: Complex<f64>) -> Option<Complex<f64>> {
    (of.norm_sqr() > 0.0).then(|| of.inv())
}

/// Subtracts a multiple of one column from another one, from a row on.
fn eliminate(
    of: &mut DMatrix<Complex<f64>>,
    (from, to): (usize, usize),
    first: usize,
    factor: Complex<f64>,
) {
    let size = of.nrows();
    let (from, to) = (from.saturating_mul(size), to.saturating_mul(size));
    let all = of.as_mut_slice();
    let (low, high) = all.split_at_mut(from.max(to));
    let (source, target) = if from < to {
        (low.get(from..), high.get_mut(..))
    } else {
        (high.get(..), low.get_mut(to..))
    };
    let (Some(source), Some(target)) = (source, target) else { return };
    let pairs = target.iter_mut().zip(source).take(size).skip(first);
    pairs.for_each(|(target, source)| *target -= factor * source);
}
