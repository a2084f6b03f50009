//! [`segments`]: where a number over a grid is zero, as straight lines.
//!
//! A contour is a straight line within each square of neighbouring middles, by linear interpolation of the number.

/// A straight line from one place to another.
pub(super) type Segment = [[f64; 2]; 2];

/// Where a quantity is zero, by its values over a grid, the first index to the right; squares with a value that is not finite
/// are left out. `place` is where a point of the grid is.
pub(super) fn segments(
    grid: &[Vec<f64>],
    place: &dyn Fn(usize, usize) -> [f64; 2],
) -> Vec<Segment> {
    let mut segments = Vec::new();
    for i in 1..grid.len() {
        for j in 1..grid[i].len() {
            let corners = [(i - 1, j - 1), (i, j - 1), (i, j), (i - 1, j)];
            let values = corners.map(|(i, j)| grid[i][j]);
            if values.iter().all(|value| value.is_finite()) {
                segments.extend(square(&values, &corners.map(|(i, j)| place(i, j))));
            }
        }
    }
    segments
}

/// Where a quantity is zero within a square, by its values at the corners in turn: straight lines between its sides. Of a
/// saddle the mean of the corners decides.
fn square(values: &[f64; 4], places: &[[f64; 2]; 4]) -> Vec<Segment> {
    let mut crossed: Vec<[f64; 2]> = Vec::new();
    for side in 0..4 {
        let next = (side + 1) % 4;
        let (a, b) = (values[side], values[next]);
        if (a > 0.0) == (b > 0.0) {
            continue;
        }
        let share = a / (a - b);
        let between = |k: usize| places[side][k] + share * (places[next][k] - places[side][k]);
        crossed.push([between(0), between(1)]);
    }
    match crossed[..] {
        [from, to] => vec![[from, to]],
        [a, b, c, d] => {
            let middle: f64 = values.iter().sum();
            if (middle > 0.0) == (values[0] > 0.0) {
                vec![[a, b], [c, d]]
            } else {
                vec![[d, a], [b, c]]
            }
        }
        _ => Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SQUARE: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];

    #[test]
    fn a_contour_of_a_plane_is_where_the_plane_is_zero() {
        // x - 0.25.
        let found = square(&[-0.25, 0.75, 0.75, -0.25], &SQUARE);
        assert_eq!(found, [[[0.25, 0.0], [0.25, 1.0]]]);
        assert!(square(&[1.0, 2.0, 3.0, 4.0], &SQUARE).is_empty());
        // A saddle: the corner 0 is apart where the middle is below zero.
        let apart = square(&[1.0, -2.0, 1.0, -2.0], &SQUARE);
        assert!(
            apart
                .iter()
                .all(|[from, to]| (from[0] + from[1] - 1.0).abs() + (to[0] + to[1] - 1.0).abs()
                    > 0.5)
        );
        assert_eq!(apart.len(), 2);
    }
}
