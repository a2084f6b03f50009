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

use nalgebra::{Complex, DMatrix, Matrix6};

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
    /// Shapes at the nodes that move, and below them momentum integrals.
    to: DMatrix<f64>,
    /// The same of the nodes with forces.
    from: DMatrix<f64>,
    /// Rigid-body motion of the nodes that move, and of those with forces.
    rigid: [ComplexMatrix; 2],
    /// The rigid body, where no mode has momentum: it does not depend on the frequency.
    decoupled: Option<DMatrix<f64>>,
    /// Residual flexibility between them.
    residual: Option<DMatrix<f64>>,
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
        let [to, from] = [numbers(to), numbers(from)];
        let momenta = structure.momenta();
        let rows = |numbers: &[usize]| {
            let shapes = structure.shapes.select_rows(numbers);
            let mut rows = DMatrix::zeros(numbers.len() + COORDINATES, shapes.ncols());
            rows.rows_mut(0, numbers.len()).copy_from(&shapes);
            rows.rows_mut(numbers.len(), COORDINATES).copy_from(&momenta);
            rows
        };
        let residual = structure.residual.as_ref();
        let residual = residual.map(|all| all.select_rows(&to).select_columns(&from));
        let [of_to, of_from] = [&to, &from].map(|numbers| rigid.select_rows(numbers));
        let decoupled = match &mass {
            Some(mass) if momenta.iter().all(|value| *value == 0.0) => {
                let inverse = mass.try_inverse().ok_or(Fault::NoMass)?;
                let inverse = DMatrix::from_column_slice(6, 6, inverse.as_slice());
                Some(&of_to * inverse * of_from.transpose())
            }
            _ => None,
        };
        Ok(Self {
            mass,
            modes: structure.modes.iter().map(|mode| [mode.frequency, mode.damping]).collect(),
            to: rows(&to),
            from: rows(&from),
            rigid: [complex(&of_to), complex(&of_from)],
            decoupled,
            residual,
        })
    }

    /// Of combinations of the coordinates that move: a row for each.
    pub(crate) fn combined(&self, rows: &DMatrix<f64>) -> Self {
        let old = self.to.nrows() - COORDINATES;
        let mut to = DMatrix::zeros(rows.nrows() + COORDINATES, self.to.ncols());
        to.rows_mut(0, rows.nrows()).copy_from(&(rows * self.to.rows(0, old)));
        to.rows_mut(rows.nrows(), COORDINATES).copy_from(&self.to.rows(old, COORDINATES));
        let [moved, forced] = &self.rigid;
        Self {
            mass: self.mass,
            modes: self.modes.clone(),
            to,
            from: self.from.clone(),
            rigid: [complex(rows) * moved, forced.clone()],
            decoupled: self.decoupled.as_ref().map(|of| rows * of),
            residual: self.residual.as_ref().map(|of| rows * of),
        }
    }

    /// Another angular frequency, rad/s, and damping ratio of a mode.
    pub(crate) fn set_mode(&mut self, mode: usize, values: [f64; 2]) {
        if let Some(of) = self.modes.get_mut(mode) {
            *of = values;
        }
    }

    /// Accelerations of the floating frame, six, and modal coordinates of a free structure for forces on the nodes with
    /// forces, at an angular frequency, rad/s: a column for each column of forces.
    ///
    /// # Errors
    /// As [`Self::at`]; [`Fault::NoMass`] where the base is held.
    pub fn motion(
        &self,
        frequency: f64,
        forces: &ComplexMatrix,
    ) -> Result<[ComplexMatrix; 2], Fault> {
        let unbounded = || Fault::Unbounded { frequency };
        let mass = self.mass.as_ref().ok_or(Fault::NoMass)?;
        let rows = self.from.nrows() - COORDINATES;
        let shapes = complex(&self.from.rows(0, rows).into_owned());
        let momenta = complex(&self.from.rows(rows, COORDINATES).into_owned());
        let stiff = self.modes.iter().map(|[natural, ratio]| {
            let square = natural * natural - frequency * frequency;
            Complex::new(square, 2.0 * ratio * natural * frequency)
        });
        let stiff: Vec<_> = stiff.collect();
        let [_, of_from] = &self.rigid;
        let of_modes = shapes.transpose() * forces;
        // eta = (Phi^T f - L^T a) / k, and M_rr a + L eta'' = T^T f with eta'' = -w^2 eta.
        let divided = |mut by_mode: ComplexMatrix| {
            for (mut row, stiff) in by_mode.row_iter_mut().zip(&stiff) {
                row.iter_mut().for_each(|value| *value /= *stiff);
            }
            by_mode
        };
        let square = Complex::new(frequency * frequency, 0.0);
        let mass = complex(&DMatrix::from_column_slice(6, 6, mass.as_slice()));
        let left = mass + &momenta * divided(momenta.transpose()) * square;
        let right = of_from.transpose() * forces + &momenta * divided(of_modes.clone()) * square;
        let frame = left.lu().solve(&right).ok_or_else(unbounded)?;
        let modal = divided(of_modes - momenta.transpose() * &frame);
        Ok([frame, modal])
    }

    /// At an angular frequency, rad/s: six rows for each node that moves, six columns for each with a force.
    ///
    /// # Errors
    /// [`Fault::Unbounded`] at the frequency of a mode without damping; [`Fault::Range`] for a frequency that
    /// is negative or not finite.
    pub fn at(&self, frequency: f64) -> Result<ComplexMatrix, Fault> {
        super::within("angular frequency, rad/s,".into(), frequency, [0.0, 1e12])?;
        let square = frequency * frequency;
        let gains = self.modes.iter().map(|[natural, ratio]| {
            let stiff = natural * natural - square;
            Complex::new(-square, 0.0) / Complex::new(stiff, 2.0 * ratio * natural * frequency)
        });
        let [to, from] = [&self.to, &self.from].map(|rows| rows.nrows() - COORDINATES);
        // Modes without momentum need no momentum integrals.
        let more = if self.decoupled.is_some() { 0 } else { COORDINATES };
        // Products of real matrices: the shapes times the real and the imaginary parts of the gains.
        let mut real = self.to.rows(0, to + more).into_owned();
        let mut imaginary = real.clone();
        for (mode, gain) in gains.enumerate() {
            real.column_mut(mode).scale_mut(gain.re);
            imaginary.column_mut(mode).scale_mut(gain.im);
        }
        let shapes = self.from.rows(0, from + more).transpose();
        let modal = (real * &shapes).zip_map(&(imaginary * shapes), Complex::new);
        let mut sum = modal.view((0, 0), (to, from)).into_owned();
        if let Some(rigid) = &self.decoupled {
            sum.zip_apply(rigid, |value, rigid| *value += rigid);
        } else if let Some(mass) = &self.mass {
            let unbounded = || Fault::Unbounded { frequency };
            let [of_to, of_from] = &self.rigid;
            let size = (COORDINATES, COORDINATES);
            let mass = complex(&DMatrix::from_column_slice(6, 6, mass.as_slice()));
            let left = mass - modal.view((to, from), size);
            let moved = of_to - modal.view((0, from), (to, COORDINATES));
            let forced = of_from.transpose() - modal.view((to, 0), (COORDINATES, from));
            sum += moved * left.lu().solve(&forced).ok_or_else(unbounded)?;
        }
        if let Some(residual) = &self.residual {
            sum.zip_apply(residual, |value, residual| *value -= residual * square);
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
