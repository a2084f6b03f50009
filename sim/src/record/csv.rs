//! [`Csv`]: samples as comma-separated text, one row a sample.
//!
//! The file begins with lines that start with `#`: the scenario's name and SHA-256, a line for each
//! column with its unit, frame and meaning, the text of the scenario. Then a row with the names of
//! the columns, then the samples. A number has the fewest digits that read back the same; `NaN`,
//! `inf` and `-inf` are written so.
//!
//! The line `# samples: 2001 (finished)` has the number of rows and how the run ended. It is written at the end over one
//! of the same length that says [not counted](NOT_ENDED): a file that was cut has fewer rows.

use std::io::{self, Seek as _, SeekFrom, Write};
use std::path::{Path, PathBuf};

use super::partial::{Partial, Reservation, begin};
use super::{Header, Outcome, RecordError, Recorder};

/// The line with the number of samples begins so.
pub const COUNT: &str = "# samples: ";
/// What it has until the run has ended.
pub const NOT_ENDED: &str = "not counted, the run has not ended";
/// Its length without the end of the line; the reason of an end that is longer is cut.
const COUNT_BYTES: usize = 120;

/// Writes a CSV file.
pub struct Csv {
    path: PathBuf,
    reserved: Option<Reservation>,
    file: Option<Partial>,
    columns: usize,
    samples: u64,
    /// Where the line with the number of samples begins, bytes.
    count_at: u64,
    /// The text of one row.
    line: Vec<u8>,
}

impl Csv {
    /// A file to be written; nothing is until the run begins.
    #[must_use]
    pub fn new(path: &Path) -> Self {
        let (path, line) = (path.to_owned(), Vec::new());
        Self { path, reserved: None, file: None, columns: 0, samples: 0, count_at: 0, line }
    }

    /// A file whose name is reserved.
    #[must_use]
    pub fn reserved(reservation: Reservation) -> Self {
        let empty = Self::new(reservation.path());
        Self { reserved: Some(reservation), ..empty }
    }

    fn write(&mut self) -> Result<(), RecordError> {
        let Some(file) = &mut self.file else { return Ok(()) };
        let written = file.write_all(&self.line).and_then(|()| file.flush_at_times());
        written.map_err(RecordError::io(&self.path))
    }
}

impl Recorder for Csv {
    fn begin(&mut self, header: &Header) -> Result<(), RecordError> {
        let file = begin(self.reserved.take(), &self.path);
        self.file = Some(file.map_err(RecordError::io(&self.path))?);
        self.columns = header.columns.len();
        self.samples = 0;
        self.line.clear();
        let count_at = head(header, &mut self.line).map_err(RecordError::io(&self.path))?;
        self.count_at = u64::try_from(count_at).unwrap_or(0);
        self.write()
    }

    fn sample(&mut self, row: &[f64]) -> Result<(), RecordError> {
        if row.len() != self.columns {
            return Err(RecordError::Row { expected: self.columns, found: row.len() });
        }
        let mut digits = zmij::Buffer::new();
        self.line.clear();
        for number in row {
            self.line.extend_from_slice(digits.format(*number).as_bytes());
            self.line.push(b',');
        }
        if let Some(last) = self.line.last_mut() {
            *last = b'\n';
        }
        self.samples += 1;
        self.write()
    }

    fn finish(&mut self, outcome: &Outcome) -> Result<(), RecordError> {
        let Some(mut file) = self.file.take() else { return Ok(()) };
        let counted =
            count_line(&format!("{} ({})", self.samples, one_line(&outcome.end.to_string())));
        let written = file.seek(SeekFrom::Start(self.count_at));
        let written = written.and_then(|_| file.write_all(&counted)).and_then(|()| file.finish());
        written.map_err(RecordError::io(&self.path))
    }
}

/// The line with the number of samples, as long before the end of a run as after it.
fn count_line(text: &str) -> Vec<u8> {
    let mut line = format!("{COUNT}{text}").into_bytes();
    line.resize(COUNT_BYTES, b' ');
    // Not within a letter of more than one byte.
    let length = line.utf8_chunks().next().map_or(0, |whole| whole.valid().len());
    line.truncate(length);
    line.resize(COUNT_BYTES, b' ');
    line.push(b'\n');
    line
}

/// Writes the lines before the samples; where the line with their number begins, bytes.
fn head(header: &Header, to: &mut Vec<u8>) -> io::Result<usize> {
    writeln!(to, "# precess {}", header.version)?;
    writeln!(to, "# name: {}", header.name)?;
    writeln!(to, "# title: {}", one_line(&header.title))?;
    if let Some(sha256) = &header.sha256 {
        writeln!(to, "# sha256 of the scenario: {sha256}")?;
    }
    let count_at = to.len();
    to.extend(count_line(NOT_ENDED));
    writeln!(to, "# columns: name [unit] (frame) meaning")?;
    for column in &header.columns {
        write!(to, "#   {} [{}]", column.name, column.unit)?;
        if let Some(frame) = &column.frame {
            write!(to, " ({frame})")?;
        }
        writeln!(to, " {}", column.meaning)?;
    }
    if !header.scenario.is_empty() {
        writeln!(to, "# scenario:")?;
        for line in header.scenario.lines() {
            writeln!(to, "#   {line}")?;
        }
    }
    let names: Vec<&str> = header.columns.iter().map(|column| column.name.as_str()).collect();
    writeln!(to, "{}", names.join(","))?;
    Ok(count_at)
}

/// A text in one line, without characters that a terminal obeys.
fn one_line(text: &str) -> String {
    let line = text.split_whitespace().collect::<Vec<_>>().join(" ");
    line.replace(char::is_control, "\u{fffd}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_line_with_the_count_has_one_length_and_is_text() {
        for text in
            [NOT_ENDED.to_owned(), "0 (finished)".to_owned(), "é".repeat(200), "aé".repeat(200)]
        {
            let line = count_line(&text);
            assert_eq!(line.len(), COUNT_BYTES + 1);
            assert!(String::from_utf8(line).is_ok_and(|line| line.ends_with('\n')), "{text}");
        }
    }
}
