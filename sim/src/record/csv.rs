//! [`Csv`]: samples as comma-separated text, one row a sample.
//!
//! The file begins with lines that start with `#`: the scenario's name and SHA-256, a line for each
//! column with its unit, frame and meaning, the text of the scenario. Then a row with the names of
//! the columns, then the samples. A number has the fewest digits that read back the same; `NaN`,
//! `inf` and `-inf` are written so.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use super::partial::Partial;
use super::{Header, RecordError, Recorder};
use crate::engine::Outcome;

/// Writes a CSV file.
pub struct Csv {
    path: PathBuf,
    file: Option<Partial>,
    columns: usize,
    /// The text of one row.
    line: Vec<u8>,
}

impl Csv {
    /// A file to be written; nothing is until the run begins.
    #[must_use]
    pub fn new(path: &Path) -> Self {
        Self { path: path.to_owned(), file: None, columns: 0, line: Vec::new() }
    }

    fn write(&mut self) -> Result<(), RecordError> {
        let Some(file) = &mut self.file else { return Ok(()) };
        let written = file.write_all(&self.line).and_then(|()| file.flush_at_times());
        written.map_err(RecordError::io(&self.path))
    }
}

impl Recorder for Csv {
    fn begin(&mut self, header: &Header) -> Result<(), RecordError> {
        self.file = Some(Partial::create(&self.path).map_err(RecordError::io(&self.path))?);
        self.columns = header.columns.len();
        self.line.clear();
        head(header, &mut self.line).map_err(RecordError::io(&self.path))?;
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
        self.write()
    }

    fn finish(&mut self, _: &Outcome) -> Result<(), RecordError> {
        let Some(file) = self.file.take() else { return Ok(()) };
        file.finish().map_err(RecordError::io(&self.path))
    }
}

/// The lines before the samples.
fn head(header: &Header, to: &mut Vec<u8>) -> io::Result<()> {
    writeln!(to, "# precess {}", header.version)?;
    writeln!(to, "# name: {}", header.name)?;
    writeln!(to, "# title: {}", one_line(&header.title))?;
    if let Some(sha256) = &header.sha256 {
        writeln!(to, "# sha256 of the scenario: {sha256}")?;
    }
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
    writeln!(to, "{}", names.join(","))
}

fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
