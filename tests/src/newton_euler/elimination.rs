//! Gaussian elimination with partial pivoting, for a matrix of any size and no symmetry.

use precess_dynamics::Scalar;

/// Solves `matrix * x = right`; `None` where a pivot is zero or not a number.
#[must_use]
pub fn solve<T: Scalar>(mut matrix: Vec<Vec<T>>, mut right: Vec<T>) -> Option<Vec<T>> {
    let size = right.len();
    for step in 0..size {
        let pivot_row = (step..size).max_by(|&a, &b| {
            let (a, b) = (matrix[a][step].abs(), matrix[b][step].abs());
            a.partial_cmp(&b).unwrap_or(core::cmp::Ordering::Equal)
        })?;
        matrix.swap(step, pivot_row);
        right.swap(step, pivot_row);
        let pivot = matrix[step][step];
        if pivot == T::from_f64(0.0) || !pivot.is_finite() {
            return None;
        }
        for row in step + 1..size {
            let factor = matrix[row][step] * pivot.recip();
            let (above, below) = matrix.split_at_mut(row);
            for (entry, subtracted) in below[0][step..].iter_mut().zip(&above[step][step..]) {
                *entry = *entry - factor * *subtracted;
            }
            right[row] = right[row] - factor * right[step];
        }
    }
    for row in (0..size).rev() {
        let known = (row + 1..size).map(|k| matrix[row][k] * right[k]);
        let rest = known.fold(right[row], |sum, term| sum - term);
        right[row] = rest * matrix[row][row].recip();
    }
    Some(right)
}

#[cfg(test)]
mod tests {
    use super::solve;

    #[test]
    fn rows_are_exchanged_where_the_pivot_is_zero() {
        let matrix = vec![vec![0.0, 2.0, 1.0], vec![1.0, 0.0, 0.0], vec![0.0, 1.0, 1.0]];
        assert_eq!(solve(matrix, vec![7.0, 5.0, 4.0]), Some(vec![5.0, 3.0, 1.0]));
    }

    #[test]
    fn equal_rows_have_no_solution() {
        assert_eq!(solve(vec![vec![1.0, 2.0], vec![1.0, 2.0]], vec![1.0, 1.0]), None);
    }

    #[test]
    fn not_a_number_has_no_solution() {
        assert_eq!(solve(vec![vec![f64::NAN]], vec![1.0]), None);
    }
}
