//! Accelerance: the acceleration of nodes by forces on nodes, over frequency.
//!
//! With `a = (acceleration, angular acceleration)` of a node and `f = (force, moment)` on it, all as
//! `Re(.. exp(i w t))` and expressed in B, the equations of [`structure`](super) give
//!
//! ```text
//! A = R S^-1 R^T + Phi G Phi^T - w^2 X        S = M_rr - L G L^T      R = T - Phi G L^T
//! G = diag g_k      g_k = -w^2 / (w_k^2 - w^2 + 2 i zeta_k w_k w)     X: residual flexibility
//! ```
//!
//! For the modes of a free structure `L` is zero: `A = T M_rr^-1 T^T + Phi G Phi^T - w^2 X`, the rigid body
//! and the modal sum. With the base held, the first term is left out. Units: m/s²/N, rad/s²/N,
//! m/s²/(N m), rad/s²/(N m).

use nalgebra::{Complex, DMatrix, DVector, Matrix6};

use super::{COORDINATES, Fault, Structure};

/// A complex matrix.
pub type ComplexMatrix = DMatrix<Complex<f64>>;

/// How the floating frame is held.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Base {
    /// Free: a rigid motion follows forces.
    #[default]
    Free,
    /// Held: B does not move.
    Fixed,
}

/// The accelerance of some nodes by forces on some nodes.
#[derive(Clone, Debug)]
pub struct Accelerance {
    /// Rigid mass matrix; none where the base is held.
    mass: Option<Matrix6<f64>>,
    /// Angular frequency and damping ratio of each mode.
    modes: Vec<[f64; 2]>,
    /// Momentum integrals.
    momenta: ComplexMatrix,
    /// Rigid-body motion and shapes at the nodes that move.
    to: Rows,
    /// The same at the nodes with forces.
    from: Rows,
    /// Residual flexibility between them.
    residual: Option<ComplexMatrix>,
}

/// Rows of some nodes.
#[derive(Clone, Debug)]
struct Rows {
    rigid: ComplexMatrix,
    shapes: ComplexMatrix,
}

impl Accelerance {
    /// Of nodes `to` by forces on nodes `from`, by their numbers.
    ///
    /// # Errors
    /// [`Fault::NoMass`] of a free structure without mass; [`Fault::Number`] for no node of a number.
    pub fn new(
        structure: &Structure,
        base: Base,
        to: &[usize],
        from: &[usize],
    ) -> Result<Self, Fault> {
        let count = structure.nodes.len();
        if let Some(node) = to.iter().chain(from).find(|node| **node >= count) {
            let what = String::from("as number of a node");
            return Err(Fault::Number { what, found: *node, range: [0, count.saturating_sub(1)] });
        }
        let mass = match base {
            Base::Fixed => None,
            Base::Free => Some(structure.mass.as_ref().ok_or(Fault::NoMass)?.matrix()),
        };
        let rigid = structure.rigid_shapes();
        let numbers = |nodes: &[usize]| -> Vec<usize> {
            nodes.iter().flat_map(|n| COORDINATES * n..COORDINATES * (n + 1)).collect()
        };
        let rows = |numbers: &[usize]| Rows {
            rigid: complex(&rigid.select_rows(numbers)),
            shapes: complex(&structure.shapes.select_rows(numbers)),
        };
        let [to, from] = [numbers(to), numbers(from)];
        let residual = structure.residual.as_ref();
        let residual = residual.map(|all| complex(&all.select_rows(&to).select_columns(&from)));
        let momenta = structure.momenta();
        Ok(Self {
            mass,
            modes: structure.modes.iter().map(|mode| [mode.frequency, mode.damping]).collect(),
            momenta: complex(&DMatrix::from_column_slice(6, momenta.ncols(), momenta.as_slice())),
            to: rows(&to),
            from: rows(&from),
            residual,
        })
    }

    /// At an angular frequency, rad/s: six rows for each node that moves, six columns for each with a force.
    ///
    /// # Errors
    /// [`Fault::Unbounded`] at the frequency of a mode without damping; [`Fault::Range`] for a frequency that
    /// is negative or not finite.
    pub fn at(&self, frequency: f64) -> Result<ComplexMatrix, Fault> {
        super::within("angular frequency, rad/s,".into(), frequency, [0.0, 1e12])?;
        let square = frequency * frequency;
        let gains = DVector::from_iterator(
            self.modes.len(),
            self.modes.iter().map(|[natural, ratio]| {
                let stiff = natural * natural - square;
                Complex::new(-square, 0.0) / Complex::new(stiff, 2.0 * ratio * natural * frequency)
            }),
        );
        let weighted = |shapes: &ComplexMatrix| {
            let mut weighted = shapes.clone();
            for (mut column, gain) in weighted.column_iter_mut().zip(gains.iter()) {
                column *= *gain;
            }
            weighted
        };
        let moved = weighted(&self.to.shapes);
        let mut sum = &moved * self.from.shapes.transpose();
        if let Some(mass) = &self.mass {
            let unbounded = || Fault::Unbounded { frequency };
            let mass = complex(&DMatrix::from_column_slice(6, 6, mass.as_slice()));
            let left = mass - weighted(&self.momenta) * self.momenta.transpose();
            let momenta = self.momenta.transpose();
            let to = &self.to.rigid - moved * &momenta;
            let from = &self.from.rigid - weighted(&self.from.shapes) * momenta;
            sum += to * left.lu().solve(&from.transpose()).ok_or_else(unbounded)?;
        }
        if let Some(residual) = &self.residual {
            sum -= residual * Complex::new(square, 0.0);
        }
        if sum.iter().all(|value| value.re.is_finite() && value.im.is_finite()) {
            Ok(sum)
        } else {
            Err(Fault::Unbounded { frequency })
        }
    }
}

/// A real matrix as a complex one.
#[must_use]
pub fn complex(matrix: &DMatrix<f64>) -> ComplexMatrix {
    matrix.map(|value| Complex::new(value, 0.0))
}
