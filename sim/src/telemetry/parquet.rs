//! Columns of numbers of a Parquet file; an empty cell is NaN.

use std::path::Path;

use parquet::column::reader::ColumnReader;
use parquet::file::reader::{FileReader as _, SerializedFileReader};

use super::error::TelemetryFault;
use crate::opened::open;
use crate::tables::TableFault;

/// Names and numbers of all columns of doubles, floats and integers, which may be null.
pub(super) fn columns(path: &Path) -> Result<(Vec<String>, Vec<Vec<f64>>), TelemetryFault> {
    let failed = |reason: &dyn std::fmt::Display| {
        TelemetryFault::Table(TableFault::Read(reason.to_string()))
    };
    let file = open(path).map_err(|error| failed(&error))?;
    let reader = SerializedFileReader::new(file).map_err(|error| failed(&error))?;
    let schema = reader.metadata().file_metadata().schema_descr_ptr();
    let flat = |column: usize| schema.column(column).max_rep_level() == 0;
    let kept: Vec<usize> = (0..schema.num_columns()).filter(|column| flat(*column)).collect();
    let names = kept.iter().map(|column| schema.column(*column).path().string()).collect();
    let mut numbers = vec![Vec::new(); kept.len()];
    for group in 0..reader.num_row_groups() {
        let group = reader.get_row_group(group).map_err(|error| failed(&error))?;
        let rows = usize::try_from(group.metadata().num_rows()).unwrap_or_default();
        for (place, to) in kept.iter().zip(&mut numbers) {
            let levels = schema.column(*place).max_def_level();
            let column = group.get_column_reader(*place).map_err(|error| failed(&error))?;
            read(column, rows, levels, to).map_err(|error| failed(&error))?;
        }
    }
    Ok((names, numbers))
}

/// A column of a row group; one of another type has no number.
fn read(
    column: ColumnReader,
    rows: usize,
    levels: i16,
    to: &mut Vec<f64>,
) -> Result<(), parquet::errors::ParquetError> {
    macro_rules! numbers {
        ($reader:expr, $number:expr) => {{
            let (mut reader, mut defined, mut values) = ($reader, Vec::new(), Vec::new());
            let mut read = 0;
            while read < rows {
                let (more, ..) =
                    reader.read_records(rows - read, Some(&mut defined), None, &mut values)?;
                if more == 0 {
                    break;
                }
                read += more;
            }
            let mut values = values.into_iter().map($number);
            if defined.is_empty() {
                to.extend(values);
            } else {
                let cell = |level: &i16| {
                    let value = if *level == levels { values.next() } else { None };
                    value.unwrap_or(f64::NAN)
                };
                to.extend(defined.iter().map(cell));
            }
        }};
    }
    match column {
        ColumnReader::DoubleColumnReader(reader) => numbers!(reader, |value: f64| value),
        ColumnReader::FloatColumnReader(reader) => numbers!(reader, |value: f32| f64::from(value)),
        ColumnReader::Int32ColumnReader(reader) => numbers!(reader, |value: i32| f64::from(value)),
        #[expect(clippy::cast_precision_loss, reason = "integers of a file of numbers")]
        ColumnReader::Int64ColumnReader(reader) => numbers!(reader, |value: i64| value as f64),
        _ => to.extend(std::iter::repeat_n(f64::NAN, rows)),
    }
    Ok(())
}
