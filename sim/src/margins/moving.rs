//! What moves in an oscillation of the spacecraft by itself: a mode of the structure, joints, the hub; and whether it is a whirl.
//!
//! With the eigenvectors of a pole s, `A v = s v`, `w^T A = s w^T`, a state has the share `w_k v_k / w^T v` of it, whatever its unit
//! is (participation factor: Perez-Arriaga, Verghese, Schweppe, IEEE Trans. Power Appar. Syst. 101(9), 1982); shares of all states
//! have the sum one. Gyroscopic terms, the antisymmetric part `C_g` of the rate matrix, scaled by `1 + e` move it by
//!
//! ```text
//! ds / de = -w_v^T M^-1 C_g v_v / w^T v
//! ```
//!
//! A frequency that rises with them is that of a forward whirl, one that falls that of a backward one.

use nalgebra::{Complex, DMatrix, DVector};

use super::plant::ControlledPlant;
use crate::structure::accelerance::complex;

/// Of the largest share, what is named, too.
const NAMED: f64 = 0.4;
/// Names, at most.
const NAMES_MAX: usize = 3;
/// A pole turns with the rotors if its frequency changes by more than this share of that of all gyroscopic terms.
const WHIRL_MIN: f64 = 1e-2;
/// From the pole, relative: an equation at the pole itself has no solution.
const BESIDE: f64 = 1e-9;
/// Inverse iterations: each makes other eigenvectors smaller by [`BESIDE`].
const ITERATIONS: usize = 3;
/// Of the product of their magnitudes, the least product of both eigenvectors; of poles that are equal it may be zero.
const PRODUCT_MIN: f64 = 1e-9;

impl ControlledPlant {
    /// What moves in an oscillation of a frequency, Hz, and a damping ratio: `mode 1`, `rw.tilt_y, rw.tilt_z, forward whirl`, `nutation`; empty
    /// where poles are equal.
    #[must_use]
    pub fn moving(&self, [frequency, damping]: [f64; 2]) -> String {
        let w = std::f64::consts::TAU * frequency;
        let s = Complex::new(-damping, (1.0 - damping * damping).max(0.0).sqrt()) * w;
        let vectors = [self.a.clone(), self.a.transpose()].map(|of| eigenvector(&of, s));
        let [Some(right), Some(left)] = vectors else { return String::new() };
        let product = left.dot(&right);
        if product.norm() < PRODUCT_MIN * left.norm() * right.norm() {
            return String::new();
        }
        let first = self.kept.len();
        let share = |state: usize| left[state] * right[state] / product;
        let mut shares: Vec<(f64, &str)> = Vec::new();
        for (coordinate, name) in self.names.iter().enumerate() {
            let place = self.kept.iter().position(|at| *at == coordinate);
            let own = place.map_or(Complex::new(0.0, 0.0), share) + share(first + coordinate);
            match shares.iter_mut().find(|(_, known)| known == name) {
                Some((sum, _)) => *sum += own.norm(),
                None => shares.push((own.norm(), name)),
            }
        }
        shares.sort_by(|a, b| b.0.total_cmp(&a.0));
        let largest = shares.first().map_or(0.0, |(share, _)| *share);
        let named = shares.iter().filter(|(share, _)| *share >= NAMED * largest).take(NAMES_MAX);
        let mut names: Vec<&str> = named.map(|(_, name)| *name).collect();
        let rates = right.rows(first, self.size).into_owned();
        let turned = complex(&self.gyroscopic) * rates;
        let slope = (left.rows(first, self.size).dot(&turned) / product).im;
        if slope.abs() > WHIRL_MIN * w {
            if names == ["hub"] {
                return "nutation".to_owned();
            }
            names.push(if slope > 0.0 { "forward whirl" } else { "backward whirl" });
        }
        names.join(", ")
    }
}

/// The eigenvector of a matrix at an eigenvalue, by inverse iteration.
fn eigenvector(of: &DMatrix<f64>, s: Complex<f64>) -> Option<DVector<Complex<f64>>> {
    let mut system = complex(of);
    let n = system.nrows();
    for k in 0..n {
        system[(k, k)] -= s * (1.0 + BESIDE);
    }
    let factors = system.lu();
    // No eigenvector is at right angles to it.
    let mut vector = DVector::from_fn(n, |k, _| {
        let k = crate::spectra::float(k);
        Complex::new((1.0 + k * k).sin(), (2.0 + 3.0 * k).cos())
    });
    for _ in 0..ITERATIONS {
        vector = factors.solve(&vector)?;
        let norm = vector.norm();
        if !(norm > 0.0 && norm.is_finite()) {
            return None;
        }
        vector.unscale_mut(norm);
    }
    Some(vector)
}
