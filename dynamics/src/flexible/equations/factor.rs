//! `L D Lᵀ` of a symmetric positive definite matrix of any size, by rows, without a square root.

use crate::numbers::real::{Scalar, zero};

/// Right sides: one column per direction of the hub, and the one of the forces.
pub(crate) type Right<T> = [T; 7];

/// A square matrix, row by row.
#[derive(Debug)]
pub(crate) struct Rows<'a, T> {
    pub(crate) flat: &'a mut [T],
    /// How many numbers there are in a row.
    pub(crate) length: usize,
    /// How many rows and columns are used.
    pub(crate) count: usize,
}

/// Factorises in place: of `rows` only the triangle up to the diagonal is read. Afterwards it has L
/// below its unit diagonal, `right` has `D⁻¹ L⁻¹` and `scaled` `L⁻¹` times the right sides,
/// `reciprocals` those of the pivots. Valid only if each pivot is checked.
pub(crate) fn factorise<T: Scalar>(
    rows: &mut Rows<'_, T>,
    right: &mut [Right<T>],
    scaled: &mut [Right<T>],
    reciprocals: &mut [T],
) {
    let Rows { flat, length, count } = rows;
    for index in 0..*count {
        let start = index.saturating_mul(*length);
        let Some((done, rest)) = flat.split_at_mut_checked(start) else { break };
        let Some(row) = rest.get_mut(..*length) else { break };
        // Entries of L D in place of those of the matrix.
        for (column, of) in done.chunks_exact((*length).max(1)).enumerate() {
            let Some((before, [entry, ..])) = row.split_at_mut_checked(column) else { break };
            *entry = *entry - inner(before, of);
        }
        let Some((before, [diagonal, ..])) = row.split_at_mut_checked(index) else { break };
        let mut pivot = *diagonal;
        for (entry, reciprocal) in before.iter_mut().zip(reciprocals.iter()) {
            let factor = *entry * *reciprocal;
            pivot = pivot - factor * *entry;
            *entry = factor;
        }
        let reciprocal = pivot.recip();
        if let Some(to) = reciprocals.get_mut(index) {
            *to = reciprocal;
        }
        let Some((known, [to, ..])) = scaled.split_at_mut_checked(index) else { break };
        let Some(from) = right.get_mut(index) else { break };
        let mut sum = *from;
        for (factor, known) in before.iter().zip(known.iter()) {
            for (to, from) in sum.iter_mut().zip(known) {
                *to = *to - *factor * *from;
            }
        }
        *to = sum;
        *from = sum.map(|number| number * reciprocal);
    }
}

/// `L⁻ᵀ v` in place.
pub(crate) fn back_substitute<T: Scalar>(rows: &Rows<'_, T>, v: &mut [T]) {
    let Rows { flat, length, count } = rows;
    // The used part first: `take` from the end of an iterator has an index that can panic.
    let used = flat.get(..length.saturating_mul(*count)).unwrap_or_default();
    for (index, row) in used.chunks_exact((*length).max(1)).enumerate().rev() {
        let Some((before, [solved, ..])) = v.split_at_mut_checked(index) else { continue };
        for (to, factor) in before.iter_mut().zip(row) {
            *to = *to - *factor * *solved;
        }
    }
}

/// `a . b` as far as both go, in four sums that do not wait for each other.
pub(crate) fn inner<T: Scalar>(a: &[T], b: &[T]) -> T {
    let count = a.len().min(b.len());
    let [a, b] = [a, b].map(|of| of.get(..count).unwrap_or_default());
    let ((a, last), (b, of_last)) = (a.as_chunks::<4>(), b.as_chunks::<4>());
    let mut sums = [zero::<T>(); 4];
    for (a, b) in a.iter().zip(b) {
        for (sum, (a, b)) in sums.iter_mut().zip(a.iter().zip(b)) {
            *sum = *sum + *a * *b;
        }
    }
    let [w, x, y, z] = sums;
    let rest = last.iter().zip(of_last).fold(zero(), |sum, (a, b)| sum + *a * *b);
    ((w + x) + (y + z)) + rest
}
