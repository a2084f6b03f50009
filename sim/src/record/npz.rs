//! [`Npz`]: samples as an archive of `NumPy`'s.
//!
//! `numpy.load` shows the arrays `samples` (a row a sample, a column a column), `columns`, `units`,
//! `frames` (names in the order of the columns), and the texts `name`, `version`, `scenario`,
//! `sha256` and `end`. How many samples there are is only known at the end, and comes first in the
//! array; so rows are kept in `NAME.samples.partial` and copied into the archive in bounded memory.
//! A program that is killed leaves that file: rows of little-endian doubles, the columns in order.

use std::io::{self, Read, Seek, Write};
use std::path::{Path, PathBuf};

use npyz::{DType, TypeStr, WriteOptions, WriterBuilder};
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

use super::partial::{Partial, Reservation, begin};
use super::{Header, Outcome, RecordError, Recorder};

/// Writes an NPZ file.
pub struct Npz {
    path: PathBuf,
    reserved: Option<Reservation>,
    header: Option<Header>,
    spool: Option<Partial>,
    rows: u64,
    line: Vec<u8>,
}

impl Npz {
    /// A file to be written; nothing is until the run begins.
    #[must_use]
    pub fn new(path: &Path) -> Self {
        let (path, line) = (path.to_owned(), Vec::new());
        Self { path, reserved: None, header: None, spool: None, rows: 0, line }
    }

    /// A file whose name is reserved.
    #[must_use]
    pub fn reserved(reservation: Reservation) -> Self {
        let empty = Self::new(reservation.path());
        Self { reserved: Some(reservation), ..empty }
    }

    /// The path of the rows in progress, without `.partial`.
    fn spool_path(&self) -> PathBuf {
        let mut name = self.path.as_os_str().to_owned();
        name.push(".samples");
        PathBuf::from(name)
    }
}

impl Recorder for Npz {
    fn begin(&mut self, header: &Header) -> Result<(), RecordError> {
        // Two programs that write one archive have one spool: without a reservation its lock keeps them apart.
        let path = self.spool_path();
        self.spool = Some(Partial::create(&path).map_err(RecordError::io(&path))?);
        self.header = Some(header.clone());
        self.rows = 0;
        Ok(())
    }

    fn sample(&mut self, row: &[f64]) -> Result<(), RecordError> {
        let (Some(spool), Some(header)) = (&mut self.spool, &self.header) else { return Ok(()) };
        if row.len() != header.columns.len() {
            return Err(RecordError::Row { expected: header.columns.len(), found: row.len() });
        }
        self.line.clear();
        for number in row {
            self.line.extend_from_slice(&number.to_le_bytes());
        }
        let written = spool.write_all(&self.line).and_then(|()| spool.flush_at_times());
        self.rows += 1;
        written.map_err(RecordError::io(&self.path))
    }

    fn finish(&mut self, outcome: &Outcome) -> Result<(), RecordError> {
        let (Some(mut spool), Some(header)) = (self.spool.take(), self.header.take()) else {
            return Ok(());
        };
        let file = begin(self.reserved.take(), &self.path);
        let assembled =
            file.and_then(|file| assemble(file, &mut spool, self.rows, &header, outcome));
        assembled.and_then(|()| spool.discard()).map_err(RecordError::io(&self.path))
    }
}

/// Makes the archive from the rows.
fn assemble(
    mut file: Partial,
    spool: &mut Partial,
    rows: u64,
    header: &Header,
    outcome: &Outcome,
) -> io::Result<()> {
    let mut archive = ZipWriter::new(&mut file);
    let columns = &header.columns;
    let names: Vec<&str> = columns.iter().map(|column| column.name.as_str()).collect();
    let units: Vec<&str> = columns.iter().map(|column| column.unit).collect();
    let frames: Vec<&str> =
        columns.iter().map(|column| column.frame.as_deref().unwrap_or_default()).collect();
    for (name, values) in [("columns", names), ("units", units), ("frames", frames)] {
        strings(&mut archive, name, &[values.len() as u64], &values)?;
    }
    let end = outcome.end.to_string();
    let sha256 = header.sha256.as_deref().unwrap_or_default();
    for (name, text) in [
        ("name", header.name.as_str()),
        ("version", header.version),
        ("scenario", &header.scenario),
        ("sha256", sha256),
        ("end", &end),
    ] {
        strings(&mut archive, name, &[], &[text])?;
    }
    let shape = [rows, columns.len() as u64];
    archive.start_file("samples.npy", options())?;
    let array = WriteOptions::<f64>::new().dtype(plain("<f8")?).shape(&shape);
    let to = array.writer(&mut archive).write_header_only()?;
    // No more than the rows counted, whatever else the file has.
    let bytes = rows * columns.len() as u64 * 8;
    io::copy(&mut spool.rewind()?.take(bytes), to)?;
    archive.finish()?;
    file.finish()
}

/// Members beyond 4 GB; not compressed, as `numpy.savez` has it; no time of day, so that the same run
/// makes the same file.
fn options() -> SimpleFileOptions {
    let options = SimpleFileOptions::default().compression_method(zip::CompressionMethod::Stored);
    options.large_file(true)
}

/// Writes an array of text: UTF-32, each as wide as the widest.
fn strings<W: Write + Seek>(
    archive: &mut ZipWriter<W>,
    name: &str,
    shape: &[u64],
    values: &[&str],
) -> io::Result<()> {
    let width = values.iter().map(|value| value.chars().count()).max().unwrap_or(0).max(1);
    archive.start_file(format!("{name}.npy"), options())?;
    let array = WriteOptions::<str>::new().dtype(plain(&format!("<U{width}"))?).shape(shape);
    let to = array.writer(&mut *archive).write_header_only()?;
    for value in values {
        let padding = std::iter::repeat('\0');
        for letter in value.chars().chain(padding).take(width) {
            to.write_all(&u32::from(letter).to_le_bytes())?;
        }
    }
    Ok(())
}

fn plain(text: &str) -> io::Result<DType> {
    let parsed = text.parse::<TypeStr>();
    parsed.map(DType::Plain).map_err(|error| io::Error::other(error.to_string()))
}
