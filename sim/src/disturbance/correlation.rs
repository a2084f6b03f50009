//! Noise whose components are correlated: coherence and phase of pairs, and the factor of the cross-spectral matrix.
//!
//! ```text
//! S_ij = E[conj(X_i) X_j] = sqrt(S_i S_j) G_ij      G_ij = sqrt(coherence) exp(i phase), G_ii = 1
//! S_ij = sum_m conj(B_im) B_jm                      B_im = sqrt(S_i) L_im, conj(G) = L L*
//! ```
//!
//! A pair that is not listed has no coherence. `L` is Cholesky's factor of a matrix that may be singular: components
//! with a coherence of one share their noise. Densities and pairs together are any Hermitian matrix of six by six that
//! is a cross-spectral matrix; one that is not positive semidefinite is none (Bendat and Piersol, Random Data, 5.2). Between
//! frequencies `G` is a straight line, which keeps it positive.

use nalgebra::Complex;

use super::error::BroadbandError;
use super::{Broadband, COMPONENT_COUNT, COMPONENTS, Six};

/// A pivot above minus this is zero: rounding of numbers written with ten digits.
const PIVOT_MIN: f64 = 1e-9;
/// What is left of a column at a pivot of zero, and is rounding.
const REST_MAX: f64 = 1e-4;

/// Coherence of two components.
#[derive(Clone, Debug, PartialEq)]
pub struct CoherentPair {
    /// The components.
    pub components: [usize; 2],
    /// `|S_ij|^2 / (S_i S_j)`, zero to one: one number, or one for each frequency of the tables.
    pub coherence: Vec<f64>,
    /// The phase of `S_ij`, rad, above zero where the second component leads: one number, or one for each frequency.
    pub phase: Vec<f64>,
}

/// A lower triangle: row by row.
type Triangle = Six<Six<Complex<f64>>>;

fn value(list: &[f64], index: usize) -> f64 {
    list.get(index).or(list.first()).copied().unwrap_or(0.0)
}

impl CoherentPair {
    /// `G_ij` at a frequency of the tables.
    fn listed(&self, index: usize) -> Complex<f64> {
        let (sin, cos) = libm::sincos(value(&self.phase, index));
        Complex::new(cos, sin) * value(&self.coherence, index).sqrt()
    }

    /// `G_ij` at a frequency, Hz.
    fn at(&self, frequencies: &[f64], frequency: f64) -> Complex<f64> {
        let after = frequencies.partition_point(|known| *known <= frequency);
        let place = |index: usize| Some((*frequencies.get(index)?, self.listed(index)));
        match (after.checked_sub(1).and_then(place), place(after)) {
            (Some((f_0, a)), Some((f_1, b))) => a + (b - a) * ((frequency - f_0) / (f_1 - f_0)),
            (Some((_, only)), None) | (None, Some((_, only))) => only,
            (None, None) => self.listed(0),
        }
    }
}

impl Broadband {
    /// What is wrong with its pairs.
    pub(super) fn check_pairs(&self) -> Result<(), BroadbandError> {
        for (index, pair) in self.pairs.iter().enumerate() {
            let [i, j] = pair.components;
            let names = [i, j].map(|of| COMPONENTS.get(of).copied().unwrap_or("none"));
            let wrong = |reason| BroadbandError::Pair { components: names, reason };
            let acts = |of: usize| self.densities.get(of).is_some_and(|of| !of.is_empty());
            if i == j || i >= COMPONENT_COUNT || j >= COMPONENT_COUNT {
                return Err(wrong("a pair is of two components; name another one"));
            }
            let same =
                |other: &CoherentPair| other.components == [i, j] || other.components == [j, i];
            if self.pairs.iter().take(index).any(same) {
                return Err(wrong("two pairs are of the same components; remove one"));
            }
            if !(acts(i) && acts(j)) {
                return Err(wrong("a component has no density; give it one"));
            }
            for list in [&pair.coherence, &pair.phase] {
                if list.len() != 1 && (list.len() != self.frequencies.len() || list.is_empty()) {
                    return Err(wrong("give one number, or one for each of `frequencies`"));
                }
            }
            if !pair.coherence.iter().all(|value| (0.0..=1.0).contains(value)) {
                return Err(wrong("a coherence is from 0 to 1; that of amplitudes is squared"));
            }
            if !pair.phase.iter().all(|value| value.is_finite()) {
                return Err(wrong("a phase is not finite"));
            }
        }
        let first = [self.band[0]];
        let frequencies = if self.frequencies.is_empty() { &first[..] } else { &self.frequencies };
        for frequency in frequencies {
            if let Err((row, pivot)) = self.factor(*frequency) {
                let component = COMPONENTS.get(row).copied().unwrap_or_default();
                let frequency = *frequency;
                return Err(BroadbandError::Indefinite { frequency, component, pivot });
            }
        }
        Ok(())
    }

    /// Whether a component shares noise with another one.
    pub(super) fn is_correlated(&self, component: usize) -> bool {
        self.pairs.iter().any(|pair| pair.components.contains(&component))
    }

    /// `L` at a frequency, Hz; the row of a pivot that is below zero, and the pivot.
    fn factor(&self, frequency: f64) -> Result<Triangle, (usize, f64)> {
        let zero = Complex::new(0.0, 0.0);
        let mut whole = [[zero; COMPONENT_COUNT]; COMPONENT_COUNT];
        for pair in &self.pairs {
            let [i, j] = pair.components;
            // The conjugate of G.
            let value = pair.at(&self.frequencies, frequency).conj();
            (whole[i][j], whole[j][i]) = (value, value.conj());
        }
        let mut factor: Triangle = [[zero; COMPONENT_COUNT]; COMPONENT_COUNT];
        for column in 0..COMPONENT_COUNT {
            let taken: f64 = factor[column].iter().take(column).map(Complex::norm_sqr).sum();
            let pivot = 1.0 - taken;
            if pivot < -PIVOT_MIN {
                return Err((column, pivot));
            }
            let root = if pivot > PIVOT_MIN { pivot.sqrt() } else { 0.0 };
            factor[column][column] = Complex::new(root, 0.0);
            for row in column + 1..COMPONENT_COUNT {
                let known: Complex<f64> =
                    (0..column).map(|m| factor[row][m] * factor[column][m].conj()).sum();
                let rest = whole[row][column] - known;
                if root > 0.0 {
                    factor[row][column] = rest / root;
                } else if rest.norm() > REST_MAX {
                    return Err((row, -rest.norm()));
                }
            }
        }
        Ok(factor)
    }

    /// `B` at a frequency, Hz: of each of six independent noises of unit density, what it is in each component, so that the
    /// sum of `conj(B_im) B_jm` over the noises m is the cross-spectral density. Columns are the first index.
    #[must_use]
    pub fn independent(&self, frequency: f64) -> Six<Six<Complex<f64>>> {
        let zero = Complex::new(0.0, 0.0);
        let roots: Six<f64> =
            std::array::from_fn(|component| self.density(component, frequency).sqrt());
        let mut columns = [[zero; COMPONENT_COUNT]; COMPONENT_COUNT];
        // A source that was checked has a factor.
        let factor = self.factor(frequency);
        for (noise, column) in columns.iter_mut().enumerate() {
            for (component, (to, root)) in column.iter_mut().zip(roots).enumerate() {
                *to = match &factor {
                    Ok(factor) => factor[component][noise] * root,
                    Err(_) if component == noise => Complex::new(root, 0.0),
                    Err(_) => zero,
                };
            }
        }
        columns
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn noise(pairs: Vec<CoherentPair>) -> Broadband {
        Broadband {
            band: [1.0, 50.0],
            period: 4.0,
            frequencies: Vec::new(),
            densities: std::array::from_fn(|k| vec![f64::from(u8::try_from(k).unwrap_or(0)) + 1.0]),
            reference_rate: None,
            pairs,
        }
    }

    fn pair(components: [usize; 2], coherence: f64, phase: f64) -> CoherentPair {
        CoherentPair { components, coherence: vec![coherence], phase: vec![phase] }
    }

    /// The factor gives densities, coherences and phases again, to rounding; a coherence of one, too.
    #[test]
    fn the_factor_gives_the_matrix_again() {
        let pairs = vec![pair([1, 5], 1.0, 3.0), pair([2, 4], 0.5, 0.4), pair([0, 2], 0.2, -1.0)];
        let noise = noise(pairs);
        assert_eq!(noise.check(), Ok(()));
        let columns = noise.independent(7.0);
        for i in 0..COMPONENT_COUNT {
            for j in 0..COMPONENT_COUNT {
                let found: Complex<f64> =
                    columns.iter().map(|column| column[i].conj() * column[j]).sum();
                let root = (noise.density(i, 7.0) * noise.density(j, 7.0)).sqrt();
                let listed = |a: usize, b: usize| {
                    noise.pairs.iter().find(|pair| pair.components == [a, b]).map(|p| p.listed(0))
                };
                let expected = if i == j {
                    Complex::new(1.0, 0.0)
                } else {
                    let back = || listed(j, i).map(|value| value.conj());
                    listed(i, j).or_else(back).unwrap_or_default()
                };
                assert!((found / root - expected).norm() < 1e-9, "{i} {j}: {found} {expected}");
            }
        }
    }

    #[test]
    fn what_is_no_cross_spectral_matrix_is_refused() {
        // x and y, y and z move together, x and z against each other.
        let three = vec![pair([0, 1], 0.9, 0.0), pair([1, 2], 0.9, 0.0), pair([0, 2], 0.9, 3.1)];
        for (pairs, part) in [
            (three, "not positive"),
            (vec![pair([0, 0], 0.5, 0.0)], "two components"),
            (vec![pair([0, 1], 0.5, 0.0), pair([1, 0], 0.5, 0.0)], "same components"),
            (vec![pair([0, 1], 1.5, 0.0)], "from 0 to 1"),
            (vec![pair([0, 1], 0.5, f64::NAN)], "not finite"),
        ] {
            let error = noise(pairs).check().expect_err(part).to_string();
            assert!(error.contains(part), "{error}");
        }
        let mut silent = noise(vec![pair([0, 1], 0.5, 0.0)]);
        silent.densities[1].clear();
        assert!(silent.check().expect_err("no density").to_string().contains("no density"));
    }
}
