//! Writing op4: binary, little-endian, integers of 32 bits, double precision. Columns are dense where each is one
//! run, otherwise sparse with wide headers (BIGMAT). What is written is read back with the same bits.

use nalgebra::DMatrix;

use super::super::{Fault, FileLocation, StructureError};
use super::{Matrix, Run};

/// Words of 32 bits of a number.
const WORDS: usize = 2;
/// Letters of a name, at most.
const LETTERS: usize = 8;
/// What pyYeti and Nastran write behind the last column.
const END: f64 = std::f64::consts::SQRT_2;

/// Forms of matrices.
const SQUARE: i64 = 1;
const RECTANGULAR: i64 = 2;
const SYMMETRIC: i64 = 6;

impl Matrix {
    /// A dense matrix: one run of each column, from its first to its last element that is not zero.
    #[must_use]
    pub fn of_dense(name: &str, dense: &DMatrix<f64>) -> Self {
        let form = match dense.is_square() {
            true if *dense == dense.transpose() => SYMMETRIC,
            true => SQUARE,
            false => RECTANGULAR,
        };
        let runs = dense.column_iter().enumerate().filter_map(|(column, values)| {
            let counts = |value: &f64| value.to_bits() != 0;
            let first = values.iter().position(counts)?;
            let last = values.iter().rposition(counts)?;
            let values = values.iter().skip(first).take(last + 1 - first).copied().collect();
            Some(Run { column, row: first, values })
        });
        Self {
            name: name.to_ascii_uppercase(),
            form,
            complex: false,
            rows: dense.nrows(),
            columns: dense.ncols(),
            runs: runs.collect(),
        }
    }
}

/// The file of some matrices.
///
/// # Errors
/// [`Fault::Type`] of a name that is not 1 to 8 ASCII letters and digits; [`Fault::Number`] for what does not
/// fit into the matrix or the format; [`Fault::NotFinite`].
pub fn write(matrices: &[Matrix]) -> Result<Vec<u8>, StructureError> {
    let mut file = Vec::new();
    for matrix in matrices {
        one(matrix, &mut file)
            .map_err(|fault| fault.at(FileLocation::Member(matrix.name.clone())))?;
    }
    Ok(file)
}

fn one(matrix: &Matrix, file: &mut Vec<u8>) -> Result<(), Fault> {
    let Matrix { name, form, complex, rows, columns, .. } = matrix;
    if name.is_empty() || name.len() > LETTERS || !name.bytes().all(|b| b.is_ascii_alphanumeric()) {
        let wanted = "a name of 1 to 8 ASCII letters and digits";
        return Err(Fault::Type { found: name.clone(), wanted });
    }
    let mut runs: Vec<_> = matrix.runs.iter().filter(|run| !run.values.is_empty()).collect();
    runs.sort_by_key(|run| (run.column, run.row));
    for run in &runs {
        check(matrix, run)?;
    }
    let by_column: Vec<_> = runs.chunk_by(|a, b| a.column == b.column).collect();
    let sparse = by_column.iter().any(|runs| runs.len() > 1);
    let form = i32::try_from(*form).unwrap_or_default();
    let rows = integer("rows of a matrix", *rows)?;
    let columns = integer("columns of a matrix", *columns)?;
    let kind = if *complex { 4 } else { 2 };
    let mut header = integers(&[columns, if sparse { -rows } else { rows }, form, kind]);
    header.extend(format!("{name:LETTERS$}").into_bytes());
    record(file, &header)?;
    for runs in by_column {
        let Some(first) = runs.first() else { continue };
        let column = integer("column", first.column + 1)?;
        let count = runs.iter().map(|run| WORDS * run.values.len());
        let mut content = if sparse {
            integers(&[column, 0, integer("words of a column", count.map(|n| n + 2).sum())?])
        } else {
            let row = integer("row", first.row + 1)?;
            integers(&[column, row, integer("words of a column", count.sum())?])
        };
        for run in runs {
            if sparse {
                let length = integer("words of a run", WORDS * run.values.len() + 1)?;
                content.extend(integers(&[length, integer("row", run.row + 1)?]));
            }
            content.extend(run.values.iter().flat_map(|value| value.to_le_bytes()));
        }
        record(file, &content)?;
    }
    let mut end = integers(&[columns.saturating_add(1), 1, 2]);
    end.extend(END.to_le_bytes());
    record(file, &end)
}

/// Whether a run fits into its matrix, and can be read.
fn check(matrix: &Matrix, run: &Run) -> Result<(), Fault> {
    let parts = if matrix.complex { 2 } else { 1 };
    if run.column >= matrix.columns {
        let what = String::from("as a column of a run");
        return Err(Fault::Number { what, found: run.column, range: [0, matrix.columns] });
    }
    let end = run.row.saturating_add(run.values.len().div_ceil(parts));
    if end > matrix.rows || !run.values.len().is_multiple_of(parts) {
        let what = String::from("as the last row of a run");
        return Err(Fault::Number { what, found: end, range: [1, matrix.rows] });
    }
    super::super::finite(run.values.iter(), || "a column".into())
}

fn integer(what: &str, value: usize) -> Result<i32, Fault> {
    let highest = usize::try_from(i32::MAX).unwrap_or(usize::MAX);
    let fault = || Fault::Number { what: what.into(), found: value, range: [0, highest] };
    i32::try_from(value).map_err(|_| fault())
}

fn integers(values: &[i32]) -> Vec<u8> {
    values.iter().flat_map(|value| value.to_le_bytes()).collect()
}

/// A record of Fortran, between two markers of its length.
fn record(file: &mut Vec<u8>, content: &[u8]) -> Result<(), Fault> {
    let marker = integer("bytes of a record", content.len())?.to_le_bytes();
    file.extend(marker);
    file.extend(content);
    file.extend(marker);
    Ok(())
}
