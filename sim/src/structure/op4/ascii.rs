//! The ASCII form of op4: numbers in columns of fixed width, without spaces between them.
//!
//! ```text
//! columns rows form type NAME    1P,3E23.16          integers in 8 letters each, or in 16 with |I16
//! column  first-row  words                           dense: then the numbers
//! column  0          words                           sparse: then each run's header and its numbers
//! ```
//!
//! A column behind the last one ends the matrix; one number follows it.

use super::super::{Fault, FileLocation, StructureError};
use super::{Header, Layout, Matrix, Run, unpacked};

/// Numbers in a line, and letters of a number, at most.
const WIDEST: usize = 100;

/// The lines of a file with their numbers.
struct Lines<'a> {
    rest: &'a [u8],
    number: usize,
}

impl<'a> Lines<'a> {
    fn next(&mut self, wanted: &str) -> Result<&'a str, StructureError> {
        self.number += 1;
        if self.rest.is_empty() {
            return Err(self.fault(Fault::Ended { wanted: wanted.to_owned() }));
        }
        let end = self.rest.iter().position(|byte| *byte == b'\n');
        let (line, rest) = self.rest.split_at(end.unwrap_or(self.rest.len()));
        self.rest = rest.get(1..).unwrap_or_default();
        let line = line.strip_suffix(b"\r").unwrap_or(line);
        match std::str::from_utf8(line) {
            Ok(text) if text.is_ascii() => Ok(text),
            _ => {
                let found = String::from_utf8_lossy(line).chars().take(40).collect();
                Err(self.fault(Fault::NotNumber { wanted: "ASCII text".into(), found }))
            }
        }
    }

    fn fault(&self, fault: Fault) -> StructureError {
        fault.at(FileLocation::Line(self.number))
    }

    /// The integer of some letters of a line.
    fn integer(&self, line: &str, at: [usize; 2], wanted: &str) -> Result<i64, StructureError> {
        let field = line.get(at[0]..at[1].min(line.len())).unwrap_or_default().trim();
        field.parse().map_err(|_| {
            self.fault(Fault::NotNumber { wanted: wanted.to_owned(), found: field.to_owned() })
        })
    }
}

/// Whether the first line is a header.
pub(super) fn is_ascii(bytes: &[u8]) -> bool {
    let mut lines = Lines { rest: bytes, number: 0 };
    lines.next("").is_ok_and(|line| header(&lines, line).is_ok())
}

/// How numbers are written.
#[derive(Clone, Copy)]
struct Numbers {
    /// In a line.
    in_line: usize,
    /// Letters of each.
    width: usize,
}

pub(super) fn read(bytes: &[u8]) -> Result<Vec<Matrix>, StructureError> {
    let mut lines = Lines { rest: bytes, number: 0 };
    let mut matrices = Vec::new();
    while !lines.rest.is_empty() {
        let line = lines.next("the header of a matrix")?;
        if line.trim().is_empty() {
            break;
        }
        let (header, numbers) = header(&lines, line)?;
        matrices.push(matrix(&mut lines, header, numbers)?);
    }
    Ok(matrices)
}

fn header(lines: &Lines<'_>, line: &str) -> Result<(Header, Numbers), StructureError> {
    let line = line.trim_end();
    let (line, width) = line.strip_suffix("|I16").map_or((line, 8), |line| (line, 2 * 8));
    let at = |from: usize, to: usize| [2 * width + from, 2 * width + to];
    let integers = [
        lines.integer(line, [0, width], "the number of columns of a matrix")?,
        lines.integer(line, [width, 2 * width], "the number of rows of a matrix")?,
        lines.integer(line, at(0, 8), "the form of a matrix")?,
        lines.integer(line, at(8, 16), "the type of a matrix")?,
    ];
    let start = 2 * width + 16;
    let name = line.get(start..line.len().min(start + 8)).unwrap_or_default();
    let header = Header::new(integers, name).map_err(|fault| lines.fault(fault))?;
    let format = line.get(start + 8..).unwrap_or_default().trim().to_ascii_uppercase();
    let format = format.strip_prefix("1P,").unwrap_or(&format);
    if format.is_empty() {
        return Ok((header, Numbers { in_line: 5, width: 16 }));
    }
    let found = format.split_once(['E', 'D']).and_then(|(count, rest)| {
        let width = rest.split('.').next().unwrap_or_default();
        Some(Numbers { in_line: count.parse().ok()?, width: width.parse().ok()? })
    });
    let fits = |n: &Numbers| (1..=WIDEST).contains(&n.in_line) && (1..=WIDEST).contains(&n.width);
    match found.filter(fits) {
        Some(numbers) => Ok((header, numbers)),
        None => Err(lines.fault(Fault::NotNumber {
            wanted: "a format of numbers, such as 1P,3E23.16,".into(),
            found: format.to_owned(),
        })),
    }
}

fn matrix(
    lines: &mut Lines<'_>,
    mut header: Header,
    numbers: Numbers,
) -> Result<Matrix, StructureError> {
    let words_of_number = if header.single { 1 } else { 2 };
    let mut layout = None;
    loop {
        let line = lines.next("the header of a column")?;
        let number = lines.integer(line, [0, 8], "the number of a column")?;
        let row = lines.integer(line, [8, 16], "the first row of a column")?;
        let Some(column) = header.column(number).map_err(|fault| lines.fault(fault))? else {
            lines.next("the number that ends a matrix")?;
            return Ok(header.matrix);
        };
        let layout = *layout.get_or_insert_with(|| header.layout(row));
        let mut words = lines.integer(line, [16, 24], "the count of words of a column")?;
        if layout == Layout::Dense {
            let (row, count) = header.run(row, words).map_err(|fault| lines.fault(fault))?;
            let values = block(lines, count, numbers)?;
            header.matrix.runs.push(Run { column, row, values });
            continue;
        }
        while words > 0 {
            let line = lines.next("the header of a run")?;
            let (length, row, own) = if layout == Layout::Wide {
                let length = lines.integer(line, [0, 8], "the length of a run")?;
                (length, lines.integer(line, [8, 16], "the first row of a run")?, 1)
            } else {
                let whole = [0, line.len()];
                let (length, row) =
                    unpacked(lines.integer(line, whole, "the length and row of a run")?);
                (length, row, 0)
            };
            if length < 1 || length + own > words {
                let what = "length, in words, of a run";
                let fault = Fault::Integer { what, found: length, range: [1, words - own] };
                return Err(lines.fault(fault));
            }
            words -= length + own;
            let count = (length - 1) / words_of_number;
            let (row, count) = header.run(row, count).map_err(|fault| lines.fault(fault))?;
            let values = block(lines, count, numbers)?;
            header.matrix.runs.push(Run { column, row, values });
        }
    }
}

/// Numbers over as many lines as they take.
fn block(lines: &mut Lines<'_>, count: usize, n: Numbers) -> Result<Vec<f64>, StructureError> {
    // Not more than the file can have: a number takes a letter.
    let mut values = Vec::with_capacity(count.min(lines.rest.len()));
    while values.len() < count {
        let line = lines.next("the numbers of a column")?;
        for k in 0..n.in_line.min(count - values.len()) {
            let end = ((k + 1) * n.width).min(line.len());
            let field = line.get(k * n.width..end).unwrap_or_default().trim();
            let Some(value) = real(field) else {
                let wanted = "a finite number".to_owned();
                return Err(lines.fault(Fault::NotNumber { wanted, found: field.to_owned() }));
            };
            values.push(value);
        }
    }
    Ok(values)
}

/// A number of Fortran: `1.5E+03`, `1.5D+03`, and `1.5-103`, which leaves the letter out.
fn real(field: &str) -> Option<f64> {
    let field = field.replace(['D', 'd'], "E");
    let parsed = field.parse().ok().or_else(|| {
        let at = field.rfind(['+', '-']).filter(|at| *at > 0)?;
        let (mantissa, exponent) = field.split_at(at);
        format!("{mantissa}E{exponent}").parse().ok()
    });
    parsed.filter(|value: &f64| value.is_finite())
}
