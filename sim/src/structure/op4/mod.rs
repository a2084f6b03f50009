//! Nastran's op4 (`OUTPUT4`) files: matrices by name, ASCII or binary of either byte order with integers
//! of 32 or 64 bits; columns dense, sparse, or sparse with wide headers (BIGMAT); real or complex, single
//! or double.
//!
//! Values are kept in runs as the file has them, so a sparse matrix of a large model takes no more memory
//! than its file. A matrix becomes dense on request, by rows ([`Matrix::rows`]). [`write()`] writes them.

mod ascii;
mod binary;
mod of_structure;
mod write;

use std::collections::BTreeMap;
use std::fmt::Write as _;

use nalgebra::DMatrix;

use super::{Fault, FileLocation, StructureError};

pub use of_structure::of_structure;
pub use write::write;

/// Most elements of a dense matrix: 160 MB.
pub const MOST_ELEMENTS: usize = 20_000_000;
/// From so many rows on, a sparse matrix has wide headers without saying so.
const ROWS_OF_BIGMAT: usize = 65_536;
/// Rows and columns that a header may state.
const MOST_ROWS: i64 = 2_147_483_647;

/// A matrix of an op4 file.
#[derive(Clone, Debug, PartialEq)]
pub struct Matrix {
    /// Its name, upper case.
    pub name: String,
    /// Nastran's form: 1 square, 2 rectangular, 6 symmetric.
    pub form: i64,
    /// Whether its elements are complex.
    pub complex: bool,
    /// Rows.
    pub rows: usize,
    /// Columns.
    pub columns: usize,
    /// The elements that are stored, in the order of the file. Others are zero.
    pub runs: Vec<Run>,
}

/// Consecutive elements of a column.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// Column, from 0.
    pub column: usize,
    /// Row of the first element, from 0.
    pub row: usize,
    /// Real elements; of a complex matrix real and imaginary parts in turn.
    pub values: Vec<f64>,
}

/// What a header says.
#[derive(Clone, Debug)]
struct Header {
    matrix: Matrix,
    /// Whether rows were written as a negative number.
    wide: bool,
    /// Whether values are single precision.
    single: bool,
}

/// How the columns of a matrix are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Layout {
    /// One run from the first to the last element that is not zero.
    Dense,
    /// Runs, each with its length and row.
    Wide,
    /// Runs, each with its length and row in one integer.
    Packed,
}

/// Whether bytes begin as an op4 file does.
#[must_use]
pub fn is_op4(bytes: &[u8]) -> bool {
    binary::is_binary(bytes) || ascii::is_ascii(bytes)
}

/// Every matrix of a file.
///
/// # Errors
/// The place in the file, what is wrong there, and the bound.
pub fn read(bytes: &[u8]) -> Result<Vec<Matrix>, StructureError> {
    if binary::is_binary(bytes) { binary::read(bytes) } else { ascii::read(bytes) }
}

/// The matrix of a name, in any case.
///
/// # Errors
/// [`Fault::Missing`], with the names that there are.
pub fn find<'a>(matrices: &'a [Matrix], name: &str) -> Result<&'a Matrix, Fault> {
    matrices.iter().find(|matrix| matrix.name.eq_ignore_ascii_case(name)).ok_or_else(|| {
        let present = matrices.iter().map(|matrix| matrix.name.clone()).collect();
        Fault::Missing { what: name.to_owned(), present }
    })
}

impl Header {
    /// From the integers of a header: columns, rows, form, type.
    fn new([columns, rows, form, kind]: [i64; 4], name: &str) -> Result<Self, Fault> {
        let range = |what, found, range: [i64; 2]| {
            if (range[0]..=range[1]).contains(&found) {
                Ok(found)
            } else {
                Err(Fault::Integer { what, found, range })
            }
        };
        range("type", kind, [1, 4])?;
        range("number of columns", columns, [0, MOST_ROWS])?;
        range("number of rows", rows, [-MOST_ROWS, MOST_ROWS])?;
        let size = |value: i64| usize::try_from(value.unsigned_abs()).unwrap_or(usize::MAX);
        let matrix = Matrix {
            // A name in words of 64 bits has blanks within.
            name: name.replace([' ', '\0'], "").to_ascii_uppercase(),
            form,
            complex: kind > 2,
            rows: size(rows),
            columns: size(columns),
            runs: Vec::new(),
        };
        Ok(Self { matrix, wide: rows < 0, single: kind % 2 == 1 })
    }

    /// The layout, from the row that the first column's header has.
    fn layout(&self, row: i64) -> Layout {
        match (row > 0, self.wide || self.matrix.rows >= ROWS_OF_BIGMAT) {
            (true, _) => Layout::Dense,
            (false, true) => Layout::Wide,
            (false, false) => Layout::Packed,
        }
    }

    /// A column by its number in the file; none behind the last one, where the matrix ends.
    fn column(&self, number: i64) -> Result<Option<usize>, Fault> {
        let columns = i64::try_from(self.matrix.columns).unwrap_or(i64::MAX);
        if number > columns {
            return Ok(None);
        }
        match usize::try_from(number).ok().and_then(|number| number.checked_sub(1)) {
            Some(column) => Ok(Some(column)),
            None => Err(Fault::Integer { what: "column", found: number, range: [1, columns] }),
        }
    }

    /// Row, from 0, and count of numbers of a run that fits into the matrix.
    fn run(&self, row: i64, numbers: i64) -> Result<(usize, usize), Fault> {
        let rows = i64::try_from(self.matrix.rows).unwrap_or(i64::MAX);
        if !(1..=rows).contains(&row) {
            return Err(Fault::Integer { what: "row", found: row, range: [1, rows] });
        }
        let parts = if self.matrix.complex { 2 } else { 1 };
        let most = parts * (rows - row + 1);
        if !(0..=most).contains(&numbers) || numbers % parts != 0 {
            let what = "count of numbers of a column";
            return Err(Fault::Integer { what, found: numbers, range: [0, most] });
        }
        let size = |value: i64| usize::try_from(value).unwrap_or(0);
        Ok((size(row) - 1, size(numbers)))
    }
}

/// Length, words, and row of a run from its packed integer.
fn unpacked(packed: i64) -> (i64, i64) {
    let length = packed >> 16;
    (length, packed - (length << 16))
}

impl Matrix {
    /// Some rows, from 0, as a dense real matrix; in the order of `rows`, zeros for none.
    ///
    /// # Errors
    /// [`Fault::Complex`]; [`Fault::Number`] for a row beyond the matrix or too many elements.
    pub fn rows(&self, rows: &[Option<usize>]) -> Result<DMatrix<f64>, StructureError> {
        let member = || FileLocation::Member(self.name.clone());
        if self.complex {
            return Err(Fault::Complex.at(member()));
        }
        if let Some(row) = rows.iter().flatten().find(|row| **row >= self.rows) {
            let (what, found) = (String::from("as a row"), row + 1);
            return Err(Fault::Number { what, found, range: [1, self.rows] }.at(member()));
        }
        self.bounded(rows.len())?;
        let mut places: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for (to, from) in rows.iter().enumerate() {
            if let Some(from) = from {
                places.entry(*from).or_default().push(to);
            }
        }
        let mut dense = DMatrix::zeros(rows.len(), self.columns);
        for (row, column, value) in self.elements() {
            for to in places.get(&row).into_iter().flatten() {
                if let Some(element) = dense.get_mut((*to, column)) {
                    *element = value;
                }
            }
        }
        Ok(dense)
    }

    /// All rows.
    ///
    /// # Errors
    /// As [`rows`](Self::rows).
    pub fn dense(&self) -> Result<DMatrix<f64>, StructureError> {
        if self.complex {
            return Err(Fault::Complex.at(FileLocation::Member(self.name.clone())));
        }
        self.bounded(self.rows)?;
        let mut dense = DMatrix::zeros(self.rows, self.columns);
        for (row, column, value) in self.elements() {
            if let Some(element) = dense.get_mut((row, column)) {
                *element = value;
            }
        }
        Ok(dense)
    }

    /// Row, column and value of what is stored, of a real matrix.
    fn elements(&self) -> impl Iterator<Item = (usize, usize, f64)> {
        self.runs.iter().flat_map(|run| {
            (run.row..).zip(&run.values).map(|(row, value)| (row, run.column, *value))
        })
    }

    /// Whether so many rows are few enough to be dense.
    fn bounded(&self, rows: usize) -> Result<(), StructureError> {
        let found = rows.saturating_mul(self.columns.max(1));
        if found <= MOST_ELEMENTS {
            return Ok(());
        }
        let what = String::from("elements of a dense matrix");
        let fault = Fault::Number { what, found, range: [0, MOST_ELEMENTS] };
        Err(fault.at(FileLocation::Member(self.name.clone())))
    }

    /// The elements of a vector, or of the diagonal of a square matrix.
    ///
    /// # Errors
    /// As [`rows`](Self::rows); [`Fault::Shape`] of another matrix.
    pub fn vector(&self) -> Result<Vec<f64>, StructureError> {
        let dense = self.dense()?;
        if self.rows == 1 || self.columns == 1 {
            return Ok(dense.iter().copied().collect());
        }
        if self.rows == self.columns {
            return Ok(dense.diagonal().iter().copied().collect());
        }
        let fault = Fault::Shape {
            what: "a vector, or a matrix with it on its diagonal,".into(),
            found: vec![self.rows, self.columns],
            wanted: vec![self.rows, 1],
        };
        Err(fault.at(FileLocation::Member(self.name.clone())))
    }

    /// The line of this matrix in a list.
    #[must_use]
    pub fn summary(&self) -> String {
        let mut text = format!("{} {} x {}", self.name, self.rows, self.columns);
        let stored: usize = self.runs.iter().map(|run| run.values.len()).sum();
        let kind = if self.complex { "complex" } else { "real" };
        let _ = write!(text, ", {kind}, form {}, {stored} numbers stored", self.form);
        text
    }
}
