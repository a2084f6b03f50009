//! Linear equations by Gaussian elimination with partial pivoting.

/// A pivot below this share of its row's largest coefficient is none: a thousand times what rounding
/// leaves where there is nothing.
const PIVOT: f64 = 1e-12;

/// One equation: coefficients and right side.
#[derive(Clone, Copy)]
pub(super) struct LinearEquation<const N: usize> {
    pub(super) coefficients: [f64; N],
    pub(super) right: f64,
}

impl<const N: usize> LinearEquation<N> {
    /// Whether every number is one.
    pub(super) fn is_finite(&self) -> bool {
        self.coefficients.iter().all(|a| a.is_finite()) && self.right.is_finite()
    }

    fn largest(&self) -> f64 {
        self.coefficients.iter().fold(0.0, |largest, a| a.abs().max(largest))
    }

    fn scaled(&self, factor: f64) -> Self {
        Self { coefficients: self.coefficients.map(|a| a * factor), right: self.right * factor }
    }

    /// Without the unknown number `k`, which `pivot` has.
    fn without(&self, k: usize, pivot: &Self) -> Self {
        let factor = self.coefficients[k] / pivot.coefficients[k];
        let mut row = *self;
        for (a, b) in row.coefficients.iter_mut().zip(pivot.coefficients) {
            *a -= factor * b;
        }
        row.right -= factor * pivot.right;
        row
    }
}

/// The unknowns of finite equations; `None` where these do not determine them.
pub(super) fn solve<const N: usize>(rows: [LinearEquation<N>; N]) -> Option<[f64; N]> {
    // Each row in the unit of its largest coefficient, so that pivots compare across units.
    let mut rows = rows.map(|row| row.scaled(row.largest().recip()));
    for k in 0..N {
        let (done, rest) = rows.split_at_mut(k + 1);
        let pivot = &mut done[k];
        for row in rest.iter_mut() {
            if row.coefficients[k].abs() > pivot.coefficients[k].abs() {
                std::mem::swap(pivot, row);
            }
        }
        // A row of zeros has no unit and becomes NaN.
        let size = pivot.coefficients[k].abs();
        if size.is_nan() || size <= PIVOT {
            return None;
        }
        for row in rest {
            *row = row.without(k, pivot);
        }
    }
    let mut unknowns = [0.0; N];
    for (k, row) in rows.iter().enumerate().rev() {
        let known = row.coefficients.iter().zip(&unknowns).skip(k + 1);
        let sum: f64 = known.map(|(a, x)| a * x).sum();
        unknowns[k] = (row.right - sum) / row.coefficients[k];
    }
    unknowns.iter().all(|x| x.is_finite()).then_some(unknowns)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows<const N: usize>(rows: [([f64; N], f64); N]) -> [LinearEquation<N>; N] {
        rows.map(|(coefficients, right)| LinearEquation { coefficients, right })
    }

    #[test]
    fn equations_in_any_order_and_unit_are_solved() {
        let x = solve(rows([
            ([0.0, 2e6, 1e6], 7e6),
            ([1e-6, 1e-6, 0.0], 3e-6),
            ([4.0, 0.0, 1.0], 7.0),
        ]));
        let x = x.unwrap();
        for (x, expected) in x.iter().zip([1.0, 2.0, 3.0]) {
            // A few roundings of numbers of order one.
            assert!((x - expected).abs() < 1e-14, "{x}");
        }
    }

    #[test]
    fn dependent_equations_have_no_solution() {
        assert_eq!(solve(rows([([1.0, 2.0], 1.0), ([0.1, 0.2], 5.0)])), None);
        assert_eq!(solve(rows([([0.0, 0.0], 0.0), ([0.1, 0.2], 5.0)])), None);
        assert_eq!(solve(rows([([f64::NAN, 1.0], 1.0), ([1.0, 0.0], 1.0)])), None);
    }
}
