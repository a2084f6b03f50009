//! A structure of the matrices of an op4 file: modes that it has, or those of a reduced model.

use nalgebra::DMatrix;

use super::super::keys::Keys;
use super::MappedNode;
use crate::structure::modes::{eigen, mass_by_rigid_modes, of_columns};
use crate::structure::op4::{self, Matrix};
use crate::structure::{Fault, MOST, RigidMass, Structure, StructureError};

/// Six lowest modes are rigid below this share of the next frequency.
const RIGID_FREQUENCY_MAX: f64 = 0.01;

/// Modes at the rows of the nodes.
struct Modes {
    /// Squares of angular frequencies.
    eigenvalues: Vec<f64>,
    /// Mass-normalised shapes.
    shapes: DMatrix<f64>,
}

/// Modes that the file has, or those of the mass and stiffness matrix that it has.
pub(super) fn of_op4(
    keys: &Keys<'_>,
    all: &[Matrix],
    nodes: &[MappedNode],
    stated: Option<&RigidMass>,
) -> Result<Structure, StructureError> {
    let rows: Vec<_> = nodes.iter().flat_map(|node| node.rows).collect();
    let named = |key: &str| keys.text(key).map(|name| op4::find(all, name)).transpose();
    let [shapes, eigenvalues, modal_mass] =
        [named("shapes")?, named("eigenvalues")?, named("modal_mass")?];
    let [mass, stiffness] = [named("mass")?, named("stiffness")?];
    let [momentum, residual] = [named("momentum")?, named("residual_flexibility")?];
    let rigid_modes = keys.count("rigid_modes", 0, 6).unwrap_or(0);
    let rigid_modes = usize::try_from(rigid_modes).unwrap_or(0);
    let is_free = keys.boolean("free").unwrap_or(false);
    let modes = match (shapes, eigenvalues, mass, stiffness) {
        (Some(shapes), Some(values), _, None) => of_shapes(shapes, values, modal_mass, &rows)?,
        (None, None, Some(mass), Some(stiffness)) => reduced(mass, stiffness, &rows)?,
        _ => {
            keys.missing("shapes", "shapes = \"PHIA\"` and `eigenvalues = \"LAMA\"`, or `mass = \"MXX\"` and `stiffness = \"KXX\"");
            return Err(Fault::Format.into());
        }
    };
    let count = modes.eigenvalues.len();
    if rigid_modes > 0 || stiffness.is_some() {
        are_rigid(&modes.eigenvalues, rigid_modes)?;
    }
    let present: Vec<usize> = (0..rows.len()).filter(|k| rows[*k].is_some()).collect();
    let mut structure = Structure {
        name: String::new(),
        nodes: nodes.iter().map(|rows| rows.node.clone()).collect(),
        modes: Vec::new(),
        shapes: modes.shapes.columns(rigid_modes, count - rigid_modes).into_owned(),
        mass: None,
        mass_matrix: None,
        residual: None,
        has_devices: None,
        initial: Vec::new(),
    };
    if rigid_modes == 6 && stated.is_none() {
        let rigid = modes.shapes.columns(0, 6).select_rows(&present);
        let motion = structure.rigid_shapes().select_rows(&present);
        structure.mass = Some(mass_by_rigid_modes(&rigid, &motion)?);
    }
    let frequencies: Vec<f64> =
        modes.eigenvalues.iter().skip(rigid_modes).map(|value| value.max(0.0).sqrt()).collect();
    let elastic = frequencies.len();
    let momenta = match momentum {
        Some(momentum) => momentum.dense()?.columns_range(..).into_owned(),
        None if rigid_modes == 6 || is_free => DMatrix::zeros(6, elastic),
        None => {
            let help = "rigid_modes = 6` for a free structure with its rigid-body modes, `free = true` without them, or `momentum = \"LMOM\"";
            keys.missing("momentum", help);
            return Err(Fault::Format.into());
        }
    };
    if momenta.shape() != (6, elastic) {
        let what = String::from("the matrix of momentum integrals");
        let found = vec![momenta.nrows(), momenta.ncols()];
        return Err(Fault::Shape { what, found, wanted: vec![6, elastic] }.into());
    }
    let momenta = momenta.fixed_rows::<6>(0).into_owned();
    structure.modes = of_columns(&frequencies, &vec![0.0; elastic], &momenta);
    if let (Some(mass), None) = (mass, stiffness) {
        structure.mass_matrix = Some(square(mass, &rows)?);
    }
    if let Some(residual) = residual {
        structure.residual = Some(square(residual, &rows)?);
    }
    Ok(structure)
}

/// Shapes of a file, made mass-normalised where it has modal masses.
fn of_shapes(
    shapes: &Matrix,
    values: &Matrix,
    modal_mass: Option<&Matrix>,
    rows: &[Option<usize>],
) -> Result<Modes, StructureError> {
    let mut shapes = shapes.rows(rows)?;
    let eigenvalues = values.vector()?;
    let modal_mass = match modal_mass {
        Some(matrix) => matrix.vector()?,
        None => vec![1.0; shapes.ncols()],
    };
    for (what, found) in [("eigenvalues", eigenvalues.len()), ("modal masses", modal_mass.len())] {
        if found != shapes.ncols() {
            let wanted = vec![shapes.ncols()];
            return Err(Fault::Shape { what: what.into(), found: vec![found], wanted }.into());
        }
    }
    for (mut column, mass) in shapes.column_iter_mut().zip(&modal_mass) {
        if mass.is_nan() || *mass <= 0.0 {
            let range = [f64::MIN_POSITIVE, f64::MAX];
            return Err(Fault::Range { what: "a modal mass".into(), value: *mass, range }.into());
        }
        column /= mass.sqrt();
    }
    Ok(Modes { eigenvalues, shapes })
}

/// Modes of a reduced model, such as Craig and Bampton's.
fn reduced(
    mass: &Matrix,
    stiffness: &Matrix,
    rows: &[Option<usize>],
) -> Result<Modes, StructureError> {
    let [m, k] = [mass.dense()?, stiffness.dense()?];
    for (what, matrix) in [("the mass matrix", &m), ("the stiffness matrix", &k)] {
        if matrix.shape() != (m.nrows(), m.nrows()) {
            let found = vec![matrix.nrows(), matrix.ncols()];
            let wanted = vec![m.nrows(), m.nrows()];
            return Err(Fault::Shape { what: what.into(), found, wanted }.into());
        }
    }
    if m.nrows() > MOST {
        let what = String::from("coordinates of a reduced model");
        return Err(Fault::Number { what, found: m.nrows(), range: [1, MOST] }.into());
    }
    let eigen = eigen(&m, &k)?;
    if let Some(row) = rows.iter().flatten().find(|row| **row >= m.nrows()) {
        let (what, found) = (String::from("as a row"), row + 1);
        return Err(Fault::Number { what, found, range: [1, m.nrows()] }.into());
    }
    let shapes = DMatrix::from_fn(rows.len(), m.nrows(), |row, column| {
        rows[row].map_or(0.0, |row| eigen.vectors[(row, column)])
    });
    Ok(Modes { eigenvalues: eigen.values, shapes })
}

/// Whether just the first modes are rigid.
fn are_rigid(eigenvalues: &[f64], stated: usize) -> Result<(), Fault> {
    let frequency = |value: Option<&f64>| value.map_or(0.0, |value| value.abs().sqrt());
    let last = stated.checked_sub(1).map_or(0.0, |last| frequency(eigenvalues.get(last)));
    let next = frequency(eigenvalues.get(stated));
    let after = frequency(eigenvalues.last());
    // Without rigid-body modes the lowest mode is no rounding of the highest.
    if last <= RIGID_FREQUENCY_MAX * next && next > 1e-7 * after {
        return Ok(());
    }
    Err(Fault::RigidModes { stated, last, next })
}

fn square(matrix: &Matrix, rows: &[Option<usize>]) -> Result<DMatrix<f64>, StructureError> {
    let found = vec![matrix.rows, matrix.columns];
    let some = matrix.rows(rows)?;
    let inside = |column: &usize| *column < matrix.columns;
    if matrix.rows != matrix.columns || !rows.iter().flatten().all(inside) {
        let wanted = vec![matrix.rows, matrix.rows];
        return Err(Fault::Shape { what: matrix.name.clone(), found, wanted }.into());
    }
    Ok(DMatrix::from_fn(rows.len(), rows.len(), |row, column| {
        rows[column].map_or(0.0, |column| some[(row, column)])
    }))
}
