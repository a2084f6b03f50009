//! `L D Lᵀ` of a symmetric positive definite matrix of any size, by rows, without a square root.

use crate::equations::system::{SmallPivot, bound, check_pivot};
use crate::numbers::real::{Scalar, zero};

/// Right sides: one column per direction of the hub, and the one of the forces.
pub(crate) type Right<T> = [T; 7];

/// Factorises in place: of `rows` only the triangle up to the diagonal is read. Afterwards it has L
/// below its unit diagonal, `right` has `D⁻¹ L⁻¹` and `scaled` `L⁻¹` times the right sides.
///
/// A pivot that is not above 64 epsilons of its diagonal is rejected.
pub(crate) fn factorise<T: Scalar, R: AsRef<[T]> + AsMut<[T]>>(
    rows: &mut [R],
    right: &mut [Right<T>],
    scaled: &mut [Right<T>],
    reciprocals: &mut [T],
) -> Result<(), SmallPivot<T>> {
    for index in 0..rows.len() {
        let Some((done, [row, ..])) = rows.split_at_mut_checked(index) else { break };
        let row = row.as_mut();
        // Entries of L D in place of those of the matrix.
        for (column, of) in done.iter().enumerate() {
            let Some((before, [entry, ..])) = row.split_at_mut_checked(column) else { break };
            *entry = *entry - inner(before, of.as_ref());
        }
        let Some((before, [diagonal, ..])) = row.split_at_mut_checked(index) else { break };
        let mut pivot = *diagonal;
        for (entry, reciprocal) in before.iter_mut().zip(reciprocals.iter()) {
            let factor = *entry * *reciprocal;
            pivot = pivot - factor * *entry;
            *entry = factor;
        }
        check_pivot(pivot, bound(*diagonal))?;
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
    Ok(())
}

/// `L⁻ᵀ v` in place.
pub(crate) fn back_substitute<T: Scalar, R: AsRef<[T]>>(rows: &[R], v: &mut [T]) {
    for (index, row) in rows.iter().enumerate().rev() {
        let Some((before, [solved, ..])) = v.split_at_mut_checked(index) else { continue };
        for (to, factor) in before.iter_mut().zip(row.as_ref()) {
            *to = *to - *factor * *solved;
        }
    }
}

fn inner<T: Scalar>(a: &[T], b: &[T]) -> T {
    a.iter().zip(b).fold(zero(), |sum, (a, b)| sum + *a * *b)
}
