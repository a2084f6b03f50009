//! [`Parquet`]: samples as Apache Parquet, a column of doubles for each column.
//!
//! Rows are kept until a row group is full, 16 MB at most, and then written compressed. The names,
//! units and frames of the columns, the scenario's text and the end of the run are metadata of the
//! file. A program that is killed leaves a partial file without the footer that readers need.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use parquet::basic::{Compression, Repetition, Type as Physical};
use parquet::data_type::DoubleType;
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::Type;

use super::partial::{Partial, Reservation, begin};
use super::{Header, Outcome, RecordError, Recorder};

/// What is kept of a row group.
const GROUP_BYTES: usize = 16 << 20;
/// More rows than this make no file smaller.
const GROUP_ROWS: usize = 1 << 17;

/// Writes a Parquet file.
pub struct Parquet {
    path: PathBuf,
    reserved: Option<Reservation>,
    writer: Option<SerializedFileWriter<Partial>>,
    /// The rows of the group, column by column.
    columns: Vec<Vec<f64>>,
    group: usize,
}

impl Parquet {
    /// A file to be written; nothing is until the run begins.
    #[must_use]
    pub fn new(path: &Path) -> Self {
        let (path, columns) = (path.to_owned(), Vec::new());
        Self { path, reserved: None, writer: None, columns, group: GROUP_ROWS }
    }

    /// A file whose name is reserved.
    #[must_use]
    pub fn reserved(reservation: Reservation) -> Self {
        let empty = Self::new(reservation.path());
        Self { reserved: Some(reservation), ..empty }
    }

    fn failure(&self) -> impl FnOnce(ParquetError) -> RecordError + use<> {
        let path = self.path.clone();
        |error| RecordError::Format { path, reason: error.to_string() }
    }

    fn write_group(&mut self) -> Result<(), RecordError> {
        let failure = self.failure();
        let Some(writer) = &mut self.writer else { return Ok(()) };
        if self.columns.first().is_none_or(Vec::is_empty) {
            return Ok(());
        }
        let columns = &mut self.columns;
        let mut write = || -> Result<(), ParquetError> {
            let mut group = writer.next_row_group()?;
            for column in columns.iter_mut() {
                if let Some(mut to) = group.next_column()? {
                    to.typed::<DoubleType>().write_batch(column, None, None)?;
                    to.close()?;
                }
                column.clear();
            }
            group.close().map(drop)
        };
        write().map_err(failure)
    }
}

impl Recorder for Parquet {
    fn begin(&mut self, header: &Header) -> Result<(), RecordError> {
        let file = begin(self.reserved.take(), &self.path);
        let file = file.map_err(RecordError::io(&self.path))?;
        let count = header.columns.len();
        self.group = (GROUP_BYTES / (8 * count.max(1))).clamp(1, GROUP_ROWS);
        self.columns = vec![Vec::new(); count];
        let begin = || -> Result<_, ParquetError> {
            let fields = header.columns.iter().map(|column| {
                let field = Type::primitive_type_builder(&column.name, Physical::DOUBLE);
                field.with_repetition(Repetition::REQUIRED).build().map(Arc::new)
            });
            let fields = fields.collect::<Result<Vec<_>, _>>()?;
            let schema = Type::group_type_builder("samples").with_fields(fields).build()?;
            let properties = WriterProperties::builder()
                .set_compression(Compression::SNAPPY)
                .set_dictionary_enabled(false)
                .set_key_value_metadata(Some(metadata(header)))
                .build();
            SerializedFileWriter::new(file, Arc::new(schema), Arc::new(properties))
        };
        self.writer = Some(begin().map_err(self.failure())?);
        Ok(())
    }

    fn sample(&mut self, row: &[f64]) -> Result<(), RecordError> {
        if row.len() != self.columns.len() {
            return Err(RecordError::Row { expected: self.columns.len(), found: row.len() });
        }
        for (column, number) in self.columns.iter_mut().zip(row) {
            column.push(*number);
        }
        if self.columns.first().is_some_and(|column| column.len() >= self.group) {
            self.write_group()?;
        }
        Ok(())
    }

    fn finish(&mut self, outcome: &Outcome) -> Result<(), RecordError> {
        self.write_group()?;
        let failure = self.failure();
        let Some(mut writer) = self.writer.take() else { return Ok(()) };
        writer.append_key_value_metadata(pair("end", outcome.end.to_string()));
        let file = writer.into_inner().map_err(failure)?;
        file.finish().map_err(RecordError::io(&self.path))
    }
}

fn pair(key: &str, value: String) -> KeyValue {
    KeyValue::new(format!("precess.{key}"), value)
}

fn metadata(header: &Header) -> Vec<KeyValue> {
    let mut pairs = vec![
        pair("version", header.version.to_owned()),
        pair("name", header.name.clone()),
        pair("scenario", header.scenario.clone()),
        pair("sha256", header.sha256.clone().unwrap_or_default()),
    ];
    for column in &header.columns {
        pairs.push(pair(&format!("unit.{}", column.name), column.unit.to_owned()));
        if let Some(frame) = &column.frame {
            pairs.push(pair(&format!("frame.{}", column.name), frame.clone()));
        }
    }
    pairs
}
