//! Variations that are correlated: a Gaussian copula, the factor of whose matrix is Cholesky's.
//!
//! ```text
//! x_k = F_k^-1(Phi(z_k))      z = L n, n independent standard Gaussian, R = L L^T
//! ```
//!
//! `R` has the stated coefficients, zero where none is stated: the correlations of the normal scores `z`. Between two Gaussian
//! values that is their correlation, between lognormal ones that of their logarithms; the rank correlation is
//! `6 / pi asin(R_ij / 2)` for any continuous distributions (Kruskal, J. Am. Stat. Assoc. 53(284), 1958). The distributions of the
//! single values are as stated.

use nalgebra::{DMatrix, DVector};

use super::CampaignError;
use crate::variation::{Correlation, Distribution, Variation, normal_score};

/// A pivot that is not above this is no pivot: numbers are stated with some digits, and a smaller one has no meaning.
const PIVOT_MIN: f64 = 1e-9;

/// Some variations that are correlated, and the factor of their matrix.
#[derive(Clone, Debug)]
pub(super) struct Copula {
    /// Their places among all variations, rising.
    places: Vec<usize>,
    /// Cholesky's factor, a lower triangle.
    factor: DMatrix<f64>,
}

impl Copula {
    /// That of some variations; empty where none is correlated.
    ///
    /// # Errors
    /// A coefficient that is not between -1 and 1, a pair that is not of two variations or is there twice, a phase, a matrix
    /// that is not positive definite.
    pub(super) fn from_variations(variations: &[Variation]) -> Result<Self, CampaignError> {
        let mut pairs: Vec<(usize, usize, f64)> = Vec::new();
        for (place, of) in variations.iter().enumerate() {
            for Correlation { key, coefficient } in &of.correlations {
                let keys = [of.key.clone(), key.clone()];
                let wrong = |reason| CampaignError::Correlation { keys: keys.clone(), reason };
                let other = variations.iter().position(|other| other.key == *key);
                let Some(other) = other.filter(|other| *other != place) else {
                    return Err(wrong("a pair is of two keys of the plan; name those"));
                };
                let bounded = coefficient.abs() < 1.0;
                if !bounded {
                    let reason = "a coefficient is above -1 and below 1; of values that go together vary \
                                  `KEY1+KEY2`";
                    return Err(wrong(reason));
                }
                if [place, other].iter().any(|at| {
                    variations.get(*at).is_some_and(|of| of.distribution == Distribution::Phase)
                }) {
                    let reason =
                        "phases have no lowest value; write a uniform or normal distribution";
                    return Err(wrong(reason));
                }
                let (low, high) = (place.min(other), place.max(other));
                if pairs.iter().any(|(a, b, _)| (*a, *b) == (low, high)) {
                    return Err(wrong("two correlations are of these keys; remove one"));
                }
                pairs.push((low, high, *coefficient));
            }
        }
        let mut places: Vec<usize> = pairs.iter().flat_map(|(a, b, _)| [*a, *b]).collect();
        places.sort_unstable();
        places.dedup();
        let mut matrix = DMatrix::identity(places.len(), places.len());
        for (a, b, coefficient) in pairs {
            if let (Ok(a), Ok(b)) = (places.binary_search(&a), places.binary_search(&b)) {
                (matrix[(a, b)], matrix[(b, a)]) = (coefficient, coefficient);
            }
        }
        let factor = factor(&matrix).map_err(|found| {
            let key = |at: usize| {
                let of = places.get(at).and_then(|place| variations.get(*place));
                of.map(|of| of.key.clone()).unwrap_or_default()
            };
            let keys = found.pair.map(key);
            CampaignError::Indefinite { keys, within: found.within, pivot: found.pivot }
        })?;
        Ok(Self { places, factor })
    }

    pub(super) fn places(&self) -> &[usize] {
        &self.places
    }

    /// Normal scores of a sample's independent probabilities, one of every variation; a score for each of the places.
    pub(super) fn scores_at(&self, probabilities: &[f64]) -> Vec<f64> {
        let score = |place: &usize| normal_score(probabilities.get(*place).copied().unwrap_or(0.5));
        let independent: Vec<f64> = self.places.iter().map(score).collect();
        let row = |row: usize| {
            let before = independent.iter().take(row + 1).enumerate();
            before.map(|(column, score)| self.factor[(row, column)] * score).sum()
        };
        (0..independent.len()).map(row).collect()
    }
}

/// Why a matrix has no factor.
struct Indefinite {
    /// Row and column of a coefficient that is too large for the ones before it.
    pair: [usize; 2],
    /// Where it may be; none where no value of it will do.
    within: Option<[f64; 2]>,
    /// The pivot of its row.
    pivot: f64,
}

/// Cholesky's factor, row by row.
fn factor(matrix: &DMatrix<f64>) -> Result<DMatrix<f64>, Indefinite> {
    let count = matrix.nrows();
    let mut factor = DMatrix::<f64>::zeros(count, count);
    for row in 0..count {
        for column in 0..row {
            let known: f64 = (0..column).map(|k| factor[(row, k)] * factor[(column, k)]).sum();
            factor[(row, column)] = (matrix[(row, column)] - known) / factor[(column, column)];
        }
        let pivot = 1.0 - (0..row).map(|k| factor[(row, k)].powi(2)).sum::<f64>();
        if pivot <= PIVOT_MIN || pivot.is_nan() {
            return Err(indefinite(matrix, row, pivot));
        }
        factor[(row, row)] = pivot.sqrt();
    }
    Ok(factor)
}

/// Which coefficient of a row is to be changed: the largest of those whose change by itself gives a factor, else the largest. The
/// pivot is a quadratic function of each, `1 - r^T A^-1 r` with the matrix A of the rows before.
fn indefinite(matrix: &DMatrix<f64>, row: usize, pivot: f64) -> Indefinite {
    let before = matrix.view((0, 0), (row, row)).into_owned();
    let inverse = before.cholesky().map(|of| of.inverse());
    let values = DVector::from_fn(row, |k, _| matrix[(row, k)]);
    let within = |column: usize| {
        let inverse = inverse.as_ref()?;
        let mut rest = values.clone();
        rest[column] = 0.0;
        let (a, b) = (inverse[(column, column)], (inverse.row(column) * &rest)[0]);
        let c = rest.dot(&(inverse * &rest)) - 1.0 + PIVOT_MIN;
        let root = (b * b - a * c).sqrt();
        root.is_finite().then(|| [(-b - root) / a, (-b + root) / a])
    };
    let mut columns: Vec<usize> = (0..row).filter(|column| values[*column] != 0.0).collect();
    columns.sort_by(|a, b| values[*b].abs().total_cmp(&values[*a].abs()));
    let mended = columns.iter().find_map(|column| Some((*column, within(*column)?)));
    let column = mended.map_or(columns.first().copied().unwrap_or(0), |(column, _)| column);
    Indefinite { pair: [column, row], within: mended.map(|(_, ends)| ends), pivot }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rounding of a normal score by its probability.
    const ROUNDING: f64 = 1e-9;

    /// Uniform variations `a`, `b`, `c`; correlations as pairs of them.
    fn three(pairs: &[(&str, &str, f64)]) -> Vec<Variation> {
        let variation = |name: &str| Variation {
            key: name.to_owned(),
            unit: String::new(),
            distribution: Distribution::Uniform([0.0, 1.0]),
            correlations: pairs
                .iter()
                .filter(|(_, second, _)| *second == name)
                .map(|(first, _, coefficient)| Correlation {
                    key: (*first).to_owned(),
                    coefficient: *coefficient,
                })
                .collect(),
        };
        ["a", "b", "c"].map(variation).to_vec()
    }

    /// By hand: L = [1, 0, 0; 0.6, 0.8, 0; 0.2, (0.3 - 0.6 0.2) / 0.8 = 0.225, sqrt(1 - 0.04 - 0.050625)].
    #[test]
    fn scores_are_those_of_the_factor_by_hand() {
        let of = three(&[("a", "b", 0.6), ("c", "a", 0.2), ("b", "c", 0.3)]);
        let copula = Copula::from_variations(&of).expect("a copula");
        // Phi(1), Phi(-2), Phi(0.5).
        let independent = [0.841_344_746_068_543, 0.022_750_131_948_179, 0.691_462_461_274_013];
        let found = copula.scores_at(&independent);
        let known = [1.0, 0.6 - 1.6, 0.2 - 0.45 + 0.5 * 0.909_375_f64.sqrt()];
        for (found, known) in found.iter().zip(known) {
            assert!((found - known).abs() < ROUNDING, "{found} {known}");
        }
    }

    #[test]
    fn those_that_are_not_correlated_have_no_place() {
        let copula = Copula::from_variations(&three(&[("a", "c", -0.5)])).expect("a copula");
        assert_eq!(copula.places(), [0, 2]);
        assert!(Copula::from_variations(&three(&[])).expect("an empty one").places().is_empty());
    }

    /// With 0.9 and 0.9 of a with b and c, that of b with c is above 0.81 - 0.19 and below 0.81 + 0.19.
    #[test]
    fn what_is_not_positive_definite_is_refused_with_the_pair_and_its_bounds() {
        let of = three(&[("a", "b", 0.9), ("a", "c", 0.9), ("b", "c", -0.95)]);
        let error = Copula::from_variations(&of).expect_err("indefinite");
        let CampaignError::Indefinite { keys, within: Some([low, high]), pivot } = &error else {
            panic!("{error}");
        };
        assert_eq!(*keys, ["b", "c"]);
        assert!((low - 0.62).abs() < 1e-6 && (high - 1.0).abs() < 1e-6 && *pivot < 0.0, "{error}");
        assert!(error.to_string().contains("`b` and `c`"), "{error}");
        // Within the bounds there is a factor.
        assert!(
            Copula::from_variations(&three(&[("a", "b", 0.9), ("a", "c", 0.9), ("b", "c", 0.63)]))
                .is_ok()
        );
        // Singular: c is a and b together.
        let root = 0.5_f64.sqrt();
        let error = Copula::from_variations(&three(&[("a", "c", root), ("b", "c", root)]))
            .expect_err("singular");
        assert!(error.to_string().contains("`c`"), "{error}");
    }

    #[test]
    fn pairs_that_are_none_are_refused_with_the_remedy() {
        let mut phase = three(&[("a", "b", 0.5)]);
        phase[1].distribution = Distribution::Phase;
        for (of, part) in [
            (three(&[("a", "b", 1.0)]), "KEY1+KEY2"),
            (three(&[("a", "b", f64::NAN)]), "above -1"),
            (three(&[("b", "b", 0.5)]), "two keys of the plan"),
            (three(&[("d", "b", 0.5)]), "two keys of the plan"),
            (three(&[("a", "b", 0.5), ("b", "a", 0.5)]), "remove one"),
            (phase, "phases"),
        ] {
            let error = Copula::from_variations(&of).expect_err(part).to_string();
            assert!(error.contains(part), "{error}");
        }
    }
}
