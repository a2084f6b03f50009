//! Tables of numbers in files: columns by the names of a CSV file's first line, or of an NPZ file's arrays. Every
//! command and scenario reads tables through this.
//!
//! Of the dialects of CSV these are read: commas, semicolons or tabs between columns, as the heading has them; a mark of
//! UTF-8 at the start; lines with `#` or `%` are comments. These are named in the error: spaces between columns,
//! decimal commas, a row of units below the heading, a heading in a comment, UTF-16.

use std::fmt;
use std::io::{self, Cursor, Read};
use std::path::Path;

use crate::opened::open;
use crate::record::extent::check_rows;
use crate::structure::{Fault, FileLocation, npz};

/// Bytes of a file that show its dialect.
const HEAD: u64 = 1 << 16;
/// Marks of UTF-8 and of the two kinds of UTF-16.
const UTF_8: [u8; 3] = [0xef, 0xbb, 0xbf];
const UTF_16: [[u8; 2]; 2] = [[0xff, 0xfe], [0xfe, 0xff]];
/// Bytes between columns, the first of as many before others.
const DELIMITERS: [u8; 3] = [b',', b';', b'\t'];

/// A CSV file with its dialect known.
pub(crate) type CsvReader = csv::Reader<Box<dyn Read + Send>>;

/// What is read of a table at most.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Limits {
    pub(crate) rows: usize,
    pub(crate) bytes: u64,
}

/// What is wrong with a table.
#[derive(Debug)]
pub enum TableFault {
    /// The operating system's reason, or that of the format.
    Read(String),
    /// A column that is missing.
    Column {
        /// Its name.
        name: String,
        /// Those that there are.
        present: Vec<String>,
    },
    /// A cell that is no finite number.
    Cell {
        /// The line, from 1.
        line: u64,
        /// The column.
        name: String,
        /// The text.
        found: String,
        /// What the dialect may be, with the remedy; empty where nothing is known of it.
        remark: &'static str,
    },
    /// A dialect that is not read, with its remedy.
    Dialect(&'static str),
    /// Too many rows.
    Rows {
        /// The bound.
        bound: usize,
    },
    /// Too many bytes.
    Bytes {
        /// The bound.
        bound: u64,
    },
    /// Columns of different lengths.
    Lengths {
        /// The shortest.
        least: usize,
        /// The longest.
        most: usize,
    },
}

impl fmt::Display for TableFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Read(reason) => f.write_str(reason),
            Self::Column { name, present } => {
                write!(f, "no column `{name}`; there are {}", present.join(", "))
            }
            Self::Cell { line, name, found, remark } => {
                write!(f, "line {line}: `{found}` of {name} is no finite number{remark}")
            }
            Self::Dialect(text) => f.write_str(text),
            Self::Rows { bound } => write!(f, "more than {bound} rows"),
            Self::Bytes { bound } => write!(f, "more than {bound} bytes"),
            Self::Lengths { least, most } => {
                write!(f, "columns of {least} to {most} numbers; make them equal")
            }
        }
    }
}

impl std::error::Error for TableFault {}

/// The columns of some names, in their order and equally long: of an archive where the file's name ends in `.npz`.
///
/// A name may be missing in the file where the pair says no: its column is empty.
pub(crate) fn columns(
    path: &Path,
    names: &[(&str, bool)],
    limits: Limits,
) -> Result<Vec<Vec<f64>>, TableFault> {
    let is_npz = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("npz"));
    let columns = if is_npz { of_npz(path, names, limits)? } else { of_csv(path, names, limits)? };
    let there =
        columns.iter().zip(names).filter(|(column, (_, needed))| *needed || !column.is_empty());
    let lengths = || there.clone().map(|(column, _)| column.len());
    match (lengths().min(), lengths().max()) {
        (Some(least), Some(most)) if least < most => Err(TableFault::Lengths { least, most }),
        _ => Ok(columns),
    }
}

fn of_npz(
    path: &Path,
    names: &[(&str, bool)],
    limits: Limits,
) -> Result<Vec<Vec<f64>>, TableFault> {
    let mut bytes = Vec::new();
    let file = open(path).map_err(|error| reason(&error))?;
    let read = file.take(limits.bytes.saturating_add(1)).read_to_end(&mut bytes);
    if u64::try_from(read.map_err(|error| reason(&error))?).unwrap_or(u64::MAX) > limits.bytes {
        return Err(TableFault::Bytes { bound: limits.bytes });
    }
    let columns = npz::named_columns(&bytes, names).map_err(|error| match error.fault {
        Fault::Missing { what, present } => TableFault::Column { name: what, present },
        fault if error.place == FileLocation::File => reason(&fault),
        fault => TableFault::Read(format!("{}{fault}", error.place)),
    })?;
    if columns.iter().any(|column| column.len() > limits.rows) {
        return Err(TableFault::Rows { bound: limits.rows });
    }
    Ok(columns)
}

fn of_csv(
    path: &Path,
    names: &[(&str, bool)],
    limits: Limits,
) -> Result<Vec<Vec<f64>>, TableFault> {
    let too_long = || TableFault::Bytes { bound: limits.bytes };
    let mut reader = reader(path, limits.bytes)?;
    let head = reader.headers().map_err(|error| reason(&error))?.clone();
    if reader.position().byte() >= limits.bytes {
        return Err(too_long());
    }
    let place = |(name, needed): &(&str, bool)| {
        let place = head.iter().position(|column| column == *name);
        if place.is_none() && *needed { Err(missing(name, &head)) } else { Ok(place) }
    };
    let places = names.iter().map(place).collect::<Result<Vec<_>, _>>()?;
    let mut columns = vec![Vec::new(); names.len()];
    let mut row = csv::StringRecord::new();
    let mut rows = 0;
    let cut = |reader: &CsvReader| reader.position().byte() >= limits.bytes;
    loop {
        let more = reader.read_record(&mut row);
        // What is cut at the bound may be read as another fault.
        if cut(&reader) {
            return Err(too_long());
        }
        if !more.map_err(|error| reason(&error))? {
            check_rows(path, rows).map_err(TableFault::Read)?;
            return Ok(columns);
        }
        for ((column, place), (name, _)) in columns.iter_mut().zip(&places).zip(names) {
            let Some(place) = place else { continue };
            let text = row.get(*place).unwrap_or_default();
            let number = text.parse::<f64>().ok().filter(|number| number.is_finite());
            column.push(number.ok_or_else(|| TableFault::Cell {
                line: row.position().map_or(0, csv::Position::line),
                name: (*name).to_owned(),
                found: text.to_owned(),
                remark: remark(text, &row, rows == 0),
            })?);
        }
        rows += 1;
        if rows > limits.rows {
            return Err(TableFault::Rows { bound: limits.rows });
        }
    }
}

/// A CSV file of no more than so many bytes, which reads its dialect.
///
/// # Errors
/// The operating system's reason, or a dialect that is not read.
pub(crate) fn reader(path: &Path, bytes: u64) -> Result<CsvReader, TableFault> {
    let mut file = open(path).map_err(|error| reason(&error))?;
    let mut head = Vec::new();
    let read = (&mut file).take(HEAD.min(bytes)).read_to_end(&mut head);
    let read = u64::try_from(read.map_err(|error| reason(&error))?).unwrap_or(u64::MAX);
    if UTF_16.iter().any(|mark| head.starts_with(mark)) {
        return Err(TableFault::Dialect("the text is UTF-16; save it as UTF-8"));
    }
    if head.starts_with(&UTF_8) {
        head.drain(..UTF_8.len());
    }
    let delimiter = delimiter(&head)?;
    let rest = file.take(bytes.saturating_sub(read));
    let all: Box<dyn Read + Send> = Box::new(Comments::new(Cursor::new(head).chain(rest)));
    Ok(csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .delimiter(delimiter)
        .trim(csv::Trim::All)
        .from_reader(all))
}

/// What a cell that is no number tells of the dialect, to follow a message: of a text in its row, the first row or not.
pub(crate) fn remark(text: &str, row: &csv::StringRecord, first: bool) -> &'static str {
    let number = |text: &str| text.parse::<f64>().is_ok();
    if text.contains(',') && number(&text.replacen(',', ".", 1)) {
        "; it has a decimal comma: write decimal points"
    } else if first && !text.is_empty() && !row.iter().any(number) {
        "; the line is a row of units or of text: make it a comment with `#`, and state units by their keys"
    } else {
        ""
    }
}

fn reason(error: &dyn fmt::Display) -> TableFault {
    TableFault::Read(error.to_string())
}

/// A column that is missing, or the heading.
fn missing(name: &str, head: &csv::StringRecord) -> TableFault {
    if !head.is_empty() && head.iter().all(|cell| cell.parse::<f64>().is_ok()) {
        return TableFault::Dialect(
            "the first line has numbers, where the names of the columns should be; write them there, and not as a comment",
        );
    }
    let present = head.iter().map(str::to_owned).collect();
    TableFault::Column { name: name.to_owned(), present }
}

/// The byte between columns: of commas, semicolons and tabs that which the heading has most of.
fn delimiter(head: &[u8]) -> Result<u8, TableFault> {
    let comment = |line: &&[u8]| line.starts_with(b"#") || line.starts_with(b"%");
    let mut lines = head.split(|byte| *byte == b'\n' || *byte == b'\r');
    let mut next = || lines.find(|line| !line.is_empty() && !comment(line)).unwrap_or_default();
    let (heading, row) = (next(), next());
    let outside = |line: &[u8], delimiter: u8| {
        let mut quoted = false;
        let is = |byte: &&u8| {
            quoted ^= **byte == b'"';
            **byte == delimiter && !quoted
        };
        line.iter().filter(is).count()
    };
    let mut best = (0, DELIMITERS[0]);
    for delimiter in DELIMITERS {
        let count = outside(heading, delimiter);
        if count > best.0 {
            best = (count, delimiter);
        }
    }
    let words = |line: &[u8]| {
        let text = String::from_utf8_lossy(line);
        let numbers = text.split_whitespace().filter(|word| word.parse::<f64>().is_ok()).count();
        (text.split_whitespace().count(), numbers)
    };
    let ((names, _), (cells, numbers)) = (words(heading), words(row));
    if best.0 == 0 && names > 1 && cells == names && numbers == cells {
        let text = "the columns are separated by spaces; write commas, semicolons or tabs";
        return Err(TableFault::Dialect(text));
    }
    Ok(best.1)
}

/// A text whose lines that begin with `%` begin with `#`.
struct Comments<R> {
    inner: R,
    at_start: bool,
}

impl<R> Comments<R> {
    const fn new(inner: R) -> Self {
        Self { inner, at_start: true }
    }
}

impl<R: Read> Read for Comments<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.inner.read(buffer)?;
        for byte in buffer.iter_mut().take(count) {
            if self.at_start && *byte == b'%' {
                *byte = b'#';
            }
            self.at_start = *byte == b'\n' || *byte == b'\r';
        }
        Ok(count)
    }
}

#[cfg(test)]
mod tests;
