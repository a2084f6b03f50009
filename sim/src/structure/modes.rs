//! Mass-normalised modes: from modal mass, stiffness and damping that files have, and from the mass and
//! stiffness matrix of a reduced model (Craig and Bampton's, Guyan's).

use nalgebra::{Cholesky, DMatrix, Matrix3, Matrix3xX, Matrix6xX, SymmetricEigen, Vector3};

use super::{Fault, Mode, RigidMass};

/// Damping beside the diagonal, of the geometric mean of the two diagonal elements, that is left out: the
/// rounding of a file with six digits.
pub const DAMPING_COUPLING_MAX: f64 = 1e-6;

/// Modal mass, stiffness and damping, and momentum integrals, of shapes of any norm.
#[derive(Clone, Debug, PartialEq)]
pub struct Modal {
    /// Modal mass.
    pub mass: DMatrix<f64>,
    /// Modal stiffness.
    pub stiffness: DMatrix<f64>,
    /// Modal damping.
    pub damping: DMatrix<f64>,
    /// Linear momentum integrals.
    pub linear: Matrix3xX<f64>,
    /// Angular momentum integrals.
    pub angular: Matrix3xX<f64>,
}

/// Eigenvalues, rad²/s², in rising order, and mass-normalised eigenvectors of `K v = lambda M v`.
#[derive(Clone, Debug, PartialEq)]
pub struct Eigen {
    /// Eigenvalues.
    pub values: Vec<f64>,
    /// Eigenvectors, a column each.
    pub vectors: DMatrix<f64>,
}

/// Solves `K v = lambda M v` for symmetric `K` and `M`, of which the lower triangles are read.
///
/// # Errors
/// [`Fault::Indefinite`] where `M` is not positive definite.
pub fn eigen(mass: &DMatrix<f64>, stiffness: &DMatrix<f64>) -> Result<Eigen, Fault> {
    let size = mass.nrows();
    let failure = || Fault::Indefinite { what: "the mass matrix", size };
    // M = L L^T;  L^-1 K L^-T w = lambda w;  v = L^-T w
    let lower = Cholesky::new(mass.clone()).ok_or_else(failure)?.unpack();
    let half = lower.solve_lower_triangular(stiffness).ok_or_else(failure)?;
    let whole = lower.solve_lower_triangular(&half.transpose()).ok_or_else(failure)?;
    let whole = 0.5 * (&whole + whole.transpose());
    if whole.iter().any(|value| !value.is_finite()) {
        return Err(failure());
    }
    let solved = SymmetricEigen::new(whole);
    let vectors = lower.tr_solve_lower_triangular(&solved.eigenvectors).ok_or_else(failure)?;
    let mut order: Vec<usize> = (0..size).collect();
    let values = &solved.eigenvalues;
    order.sort_by(|a, b| values[*a].total_cmp(&values[*b]));
    let vectors = DMatrix::from_fn(size, size, |row, column| vectors[(row, order[column])]);
    Ok(Eigen { values: order.iter().map(|k| values[*k]).collect(), vectors })
}

/// Modes, and shapes made mass-normalised.
///
/// A diagonal mass and stiffness keep the order of the modes. Otherwise the modes are those of the
/// eigenvalue problem, in rising frequency.
///
/// # Errors
/// [`Fault::Range`] where a modal mass or stiffness is not above zero; [`Fault::CoupledDamping`];
/// [`Fault::Indefinite`].
pub fn normalised(
    modal: &Modal,
    shapes: &DMatrix<f64>,
) -> Result<(Vec<Mode>, DMatrix<f64>), Fault> {
    let modes = modal.mass.nrows();
    for (what, matrix) in [("mass", &modal.mass), ("stiffness", &modal.stiffness)] {
        for (index, value) in matrix.diagonal().iter().enumerate() {
            super::within(
                format!("modal {what} of mode {}", index + 1),
                *value,
                [f64::MIN_POSITIVE, f64::MAX],
            )?;
        }
        super::symmetric(if what == "mass" { "modal mass" } else { "modal stiffness" }, matrix)?;
    }
    let is_diagonal = |m: &DMatrix<f64>| {
        (0..modes).all(|column| (0..modes).all(|row| row == column || m[(row, column)] == 0.0))
    };
    // New coordinates eta of the old ones: old = turn * new, so that turn^T M turn = 1.
    let turn = if is_diagonal(&modal.mass) && is_diagonal(&modal.stiffness) {
        DMatrix::from_diagonal(&modal.mass.diagonal().map(|mass| 1.0 / mass.sqrt()))
    } else {
        eigen(&modal.mass, &modal.stiffness)?.vectors
    };
    let stiffness = (turn.transpose() * &modal.stiffness * &turn).diagonal();
    let damping = turn.transpose() * &modal.damping * &turn;
    coupling(&damping)?;
    let (linear, angular) = (&modal.linear * &turn, &modal.angular * &turn);
    let found = (0..modes).map(|k| {
        let frequency = stiffness[k].max(0.0).sqrt();
        Mode {
            frequency,
            damping: damping[(k, k)] / (2.0 * frequency),
            linear: linear.column(k).into_owned(),
            angular: angular.column(k).into_owned(),
        }
    });
    Ok((found.collect(), shapes * turn))
}

/// Whether damping is diagonal but for rounding.
fn coupling(damping: &DMatrix<f64>) -> Result<(), Fault> {
    for column in 0..damping.ncols() {
        for row in 0..damping.nrows() {
            let own = (damping[(row, row)] * damping[(column, column)]).abs().sqrt();
            let size = damping[(row, column)].abs();
            if row != column && size > DAMPING_COUPLING_MAX * own {
                let (modes, bound) = ([row + 1, column + 1], DAMPING_COUPLING_MAX);
                return Err(Fault::CoupledDamping { modes, ratio: size / own, bound });
            }
        }
    }
    Ok(())
}

/// Modes with angular frequencies, damping ratios and momentum integrals, linear above angular.
#[must_use]
pub fn of_columns(frequencies: &[f64], damping: &[f64], momenta: &Matrix6xX<f64>) -> Vec<Mode> {
    let each = frequencies.iter().zip(damping).zip(momenta.column_iter());
    each.map(|((frequency, damping), column)| Mode {
        frequency: *frequency,
        damping: *damping,
        linear: Vector3::new(column[0], column[1], column[2]),
        angular: Vector3::new(column[3], column[4], column[5]),
    })
    .collect()
}

/// Rigid-body modes may miss the motion of a rigid body with the stated positions by this, of their largest
/// element: six digits of a file, and positions in millimetres of metres.
pub const RIGID_MAX: f64 = 1e-3;

/// The rigid mass matrix about B by six mass-normalised rigid-body modes, which are some motion `T C` of the
/// nodes as of a rigid body: `M_rr = C^-T C^-1`.
///
/// `modes` has the rows of the nodes that the file has, and `rigid` the same rows of
/// [`Structure::rigid_shapes`](super::Structure::rigid_shapes).
///
/// # Errors
/// [`Fault::NotFinite`]; [`Fault::NotRigid`] where the modes are no motion of a rigid body with these positions;
/// [`Fault::Undetermined`] where the nodes do not determine it.
pub fn mass_by_rigid_modes(modes: &DMatrix<f64>, rigid: &DMatrix<f64>) -> Result<RigidMass, Fault> {
    // The decomposition below ends only for finite numbers.
    super::finite(modes.iter().chain(rigid.iter()), || "rigid-body modes".into())?;
    let nodes = rigid.nrows();
    let undetermined = || Fault::Undetermined { rows: nodes };
    // The normal equations of T C = V, with columns of length one.
    let lengths: Vec<f64> = rigid.column_iter().map(|column| column.norm()).collect();
    if lengths.contains(&0.0) {
        return Err(undetermined());
    }
    let unit = DMatrix::from_fn(nodes, 6, |row, column| rigid[(row, column)] / lengths[column]);
    let svd = unit.clone().svd(true, true);
    let solved = svd.solve(modes, 1e-9).map_err(|_| undetermined())?;
    if svd.rank(1e-9) < 6 {
        return Err(undetermined());
    }
    let missed = (&unit * &solved - modes).amax() / modes.amax();
    if missed.is_nan() || missed > RIGID_MAX {
        return Err(Fault::NotRigid { missed, bound: RIGID_MAX });
    }
    let c = DMatrix::from_fn(6, 6, |row, column| solved[(row, column)] / lengths[row]);
    let inverse = c.try_inverse().ok_or_else(undetermined)?;
    let m = inverse.transpose() * inverse;
    let cross = |row: usize, column: usize| 0.5 * (m[(3 + row, column)] - m[(3 + column, row)]);
    let inertia =
        Matrix3::from_fn(|row, column| 0.5 * (m[(3 + row, 3 + column)] + m[(3 + column, 3 + row)]));
    Ok(RigidMass {
        mass: (m[(0, 0)] + m[(1, 1)] + m[(2, 2)]) / 3.0,
        first_moment: Vector3::new(cross(2, 1), cross(0, 2), cross(1, 0)),
        inertia,
    })
}
