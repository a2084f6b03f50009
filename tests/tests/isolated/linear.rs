//! One dense symmetric system, by elimination.

/// The solution of a symmetric system, its rows and columns scaled to a diagonal of ones, by
/// elimination with the largest pivot, and refined twice.
pub(crate) fn solved(m: &[Vec<f64>], right: &[f64]) -> Vec<f64> {
    let size = right.len();
    let scale: Vec<f64> = (0..size).map(|i| m[i][i].abs().sqrt().recip()).collect();
    let scaled = |i: usize, j: usize| m[i][j] * scale[i] * scale[j];
    let right: Vec<f64> = right.iter().zip(&scale).map(|(value, scale)| value * scale).collect();
    let eliminate = |mut right: Vec<f64>| {
        let mut rows: Vec<Vec<f64>> =
            (0..size).map(|i| (0..size).map(|j| scaled(i, j)).collect()).collect();
        for pivot in 0..size {
            let best = (pivot..size)
                .max_by(|&a, &b| rows[a][pivot].abs().total_cmp(&rows[b][pivot].abs()));
            let best = best.expect("a row");
            rows.swap(pivot, best);
            right.swap(pivot, best);
            for row in pivot + 1..size {
                let factor = rows[row][pivot] / rows[pivot][pivot];
                let of_pivot = rows[pivot].clone();
                for (entry, of_pivot) in rows[row].iter_mut().zip(of_pivot).skip(pivot) {
                    *entry -= factor * of_pivot;
                }
                right[row] -= factor * right[pivot];
            }
        }
        for row in (0..size).rev() {
            let known: f64 = (row + 1..size).map(|column| rows[row][column] * right[column]).sum();
            right[row] = (right[row] - known) / rows[row][row];
        }
        right
    };
    let mut found = eliminate(right.clone());
    for _ in 0..2 {
        let residual =
            (0..size).map(|i| right[i] - (0..size).map(|j| scaled(i, j) * found[j]).sum::<f64>());
        let correction = eliminate(residual.collect());
        found.iter_mut().zip(correction).for_each(|(found, correction)| *found += correction);
    }
    found.iter().zip(&scale).map(|(value, scale)| value * scale).collect()
}
