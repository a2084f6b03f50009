//! What a structure has, and what its numbers say of each other: modal norms, momenta, effective masses.

use nalgebra::{Cholesky, DMatrix, Matrix6, SymmetricEigen, Vector6};

use super::{RigidMass, Structure};

/// A momentum integral below this share of the largest possible is zero: files have six digits.
pub const FREE_MAX: f64 = 1e-5;
/// Modal masses and sums of masses agree to this, relative to one and to the mass: files have six digits.
pub const MASS_MAX: f64 = 1e-5;

/// What was compared, and how it came out.
#[derive(Clone, Debug, PartialEq)]
pub struct Check {
    /// What is claimed.
    pub claim: &'static str,
    /// The largest difference, relative to what `unit` says; none where the numbers that it takes are missing.
    pub found: Option<f64>,
    /// The bound.
    pub bound: f64,
    /// What the difference is relative to, or what is missing.
    pub note: &'static str,
}

impl Check {
    /// Whether it holds; none where it could not be made.
    #[must_use]
    pub fn holds(&self) -> Option<bool> {
        self.found.map(|found| found <= self.bound)
    }
}

impl Structure {
    /// Effective masses of each mode: squares of its momentum integrals, kg and, about B, kg m².
    #[must_use]
    pub fn effective_masses(&self) -> Vec<Vector6<f64>> {
        let momenta = self.momenta();
        momenta.column_iter().map(|column| column.component_mul(&column)).collect()
    }

    /// For each mode the share of the rigid motion in it, from 0 to 1: `sqrt(L_k^T M_rr^-1 L_k)`. None without
    /// mass, or with a mass matrix that is not positive definite.
    #[must_use]
    pub fn rigid_shares(&self) -> Option<Vec<f64>> {
        let lower = Cholesky::new(self.mass.as_ref()?.matrix())?.unpack();
        let momenta = self.momenta();
        let share = |column: Vector6<f64>| {
            lower.solve_lower_triangular(&column).map_or(f64::NAN, |solved| solved.norm())
        };
        Some(momenta.column_iter().map(|column| share(column.into_owned())).collect())
    }

    /// Whether no mode carries momentum, as of a free structure; judged by the mass where it is known.
    #[must_use]
    pub fn is_free(&self) -> bool {
        match self.rigid_shares() {
            Some(shares) => shares.iter().all(|share| *share <= FREE_MAX),
            None => self.momenta().iter().all(|value| *value == 0.0),
        }
    }

    /// Rigid-body mass properties and momentum integrals, a column for each mode, by the mass matrix of
    /// the nodes, if there is one.
    #[must_use]
    pub fn by_mass_matrix(&self) -> Option<(Matrix6<f64>, DMatrix<f64>)> {
        let mass = self.mass_matrix.as_ref()?;
        let weighted = self.rigid_shapes().transpose() * mass;
        let rigid = &weighted * self.rigid_shapes();
        Some((rigid.fixed_view::<6, 6>(0, 0).into_owned(), weighted * &self.shapes))
    }

    /// Every check.
    #[must_use]
    pub fn checks(&self) -> Vec<Check> {
        let no_matrix = "no mass matrix of the nodes in the file";
        let no_mass = "no mass in the file";
        let by_matrix = self.by_mass_matrix();
        let norms = self.mass_matrix.as_ref().map(|mass| {
            let modal = self.shapes.transpose() * mass * &self.shapes;
            (modal - DMatrix::identity(self.modes.len(), self.modes.len())).amax()
        });
        let rigid = by_matrix.as_ref().zip(self.mass.as_ref());
        let rigid_differs = rigid.map(|((rigid, _), mass)| scaled(&(rigid - mass.matrix()), mass));
        let momenta_differ =
            by_matrix.as_ref().zip(self.mass.as_ref()).map(|((_, momenta), mass)| {
                let difference = momenta - self.momenta();
                let unit = units(mass);
                let each = difference.column_iter();
                each.map(|column| column.component_div(&unit).amax()).fold(0.0, f64::max)
            });
        let shares = self.rigid_shares();
        let largest = shares.map(|shares| shares.into_iter().fold(0.0, f64::max));
        // The mass that stays with the rigid motion when every mode follows: it must not be negative.
        let left = self.mass.as_ref().and_then(|mass| {
            let lower = Cholesky::new(mass.matrix())?.unpack();
            let scaled = lower.solve_lower_triangular(&self.momenta())?;
            let left = Matrix6::identity() - &scaled * scaled.transpose();
            // The eigenvalues of what is not finite are not looked for.
            if left.iter().any(|value| !value.is_finite()) {
                return Some(f64::INFINITY);
            }
            Some(-SymmetricEigen::new(left).eigenvalues.min())
        });
        let check = |claim, found: Option<f64>, bound, is: &'static str, missing: &'static str| {
            Check { claim, found, bound, note: if found.is_some() { is } else { missing } }
        };
        vec![
            check(
                "shapes are mass-normalised and orthogonal",
                norms,
                MASS_MAX,
                "of a modal mass of 1",
                no_matrix,
            ),
            check(
                "mass, first moment and inertia are those of the mass matrix",
                rigid_differs,
                MASS_MAX,
                "of the mass",
                if by_matrix.is_none() { no_matrix } else { no_mass },
            ),
            check(
                "momentum integrals are those of the shapes",
                momenta_differ,
                MASS_MAX,
                "of the square root of the mass",
                if by_matrix.is_none() { no_matrix } else { no_mass },
            ),
            check(
                "modes carry no momentum (free structure)",
                largest,
                FREE_MAX,
                "of the largest possible",
                no_mass,
            ),
            check(
                "effective masses do not exceed the mass",
                left,
                MASS_MAX,
                "of the mass",
                no_mass,
            ),
        ]
    }
}

/// The square root of the mass, three times, and of the mean inertia: the scales of momentum integrals.
fn units(mass: &RigidMass) -> Vector6<f64> {
    let [linear, angular] = [mass.mass.sqrt(), (mass.inertia.trace() / 3.0).sqrt()];
    Vector6::new(linear, linear, linear, angular, angular, angular)
}

/// The largest element of a difference of mass matrices, by the scales of its rows and columns.
fn scaled(difference: &Matrix6<f64>, mass: &RigidMass) -> f64 {
    let unit = units(mass);
    difference.component_div(&(unit * unit.transpose())).amax()
}
