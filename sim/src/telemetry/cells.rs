//! [`Cells`]: rows of a file of telemetry, in which cells may be empty: CSV row by row, NPZ and Parquet at once, as columns in
//! memory.

use std::io::Read as _;
use std::path::{Path, PathBuf};

use super::error::{TelemetryError, TelemetryFault};
use super::layout::{SensorColumns, TelemetryLayout};
use crate::opened::open;
use crate::record::extent::check_rows;
use crate::structure::{MOST_BYTES, npz};
use crate::tables::{CsvReader, TableFault, reader, remark};

/// What is read of a CSV file: an hour at 100 Hz with forty columns has 0.3 GB.
const MOST_CSV_BYTES: u64 = 64 << 30;

/// A row: its time and the cells of the sensors that are there, in their order; none of an empty one.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Row {
    /// From 1.
    pub(super) number: u64,
    pub(super) time: Option<f64>,
    pub(super) cells: Vec<Option<f64>>,
}

pub(super) struct Cells {
    path: PathBuf,
    /// All names of the file.
    names: Vec<String>,
    /// The columns of time and sensors, and their names.
    places: Vec<(usize, String)>,
    rows: Rows,
    row: Row,
}

enum Rows {
    Csv(Box<CsvReader>, csv::StringRecord),
    /// By column, as `places` says; empty cells are NaN.
    Kept(Vec<Vec<f64>>),
}

impl Cells {
    pub(super) fn open(path: &Path, layout: &TelemetryLayout) -> Result<Self, TelemetryError> {
        let failed = |fault| TelemetryError { file: path.to_owned(), fault };
        let ends = |name: &str| path.extension().is_some_and(|of| of.eq_ignore_ascii_case(name));
        let (names, rows) = if ends("npz") {
            let (names, columns) = of_npz(path).map_err(failed)?;
            (names, Rows::Kept(columns))
        } else if ends("parquet") {
            let (names, columns) = of_parquet(path).map_err(failed)?;
            (names, Rows::Kept(columns))
        } else {
            let table = |fault| failed(TelemetryFault::Table(fault));
            let mut reader = reader(path, MOST_CSV_BYTES).map_err(table)?;
            let head = reader.headers().map_err(|of| table(TableFault::Read(of.to_string())))?;
            let names = head.iter().map(str::to_owned).collect();
            (names, Rows::Csv(Box::new(reader), csv::StringRecord::new()))
        };
        Self::of(path, (names, rows), layout)
    }

    /// Of columns in memory, which messages call so.
    pub(super) fn of_columns(
        path: &Path,
        columns: Vec<(String, Vec<f64>)>,
        layout: &TelemetryLayout,
    ) -> Result<Self, TelemetryError> {
        let (names, columns) = columns.into_iter().unzip();
        Self::of(path, (names, Rows::Kept(columns)), layout)
    }

    /// Those that a layout has.
    fn of(
        path: &Path,
        (names, mut rows): (Vec<String>, Rows),
        layout: &TelemetryLayout,
    ) -> Result<Self, TelemetryError> {
        let failed = |fault| TelemetryError { file: path.to_owned(), fault };
        let place = |name: &String| names.iter().position(|of| of == name);
        let Some(time) = place(&layout.time) else {
            let name = layout.time.clone();
            return Err(failed(TelemetryFault::Table(TableFault::Column { name, present: names })));
        };
        let wanted = layout.sensors.iter().flat_map(|of| &of.columns);
        let own = wanted.filter_map(|name| Some((place(name)?, name.clone())));
        let places: Vec<_> = [(time, layout.time.clone())].into_iter().chain(own).collect();
        if let Rows::Kept(columns) = &mut rows {
            let own: Vec<Vec<f64>> =
                places.iter().map(|(place, _)| columns[*place].clone()).collect();
            *columns = own;
        }
        let cells = Self { path: path.to_owned(), names, places, rows, row: Row::default() };
        if let Rows::Kept(columns) = &cells.rows {
            let lengths = || columns.iter().map(Vec::len);
            if let (Some(least), Some(most)) = (lengths().min(), lengths().max())
                && least < most
            {
                return Err(failed(TelemetryFault::Table(TableFault::Lengths { least, most })));
            }
        }
        Ok(cells)
    }

    /// The sensors of a layout that the file has.
    pub(super) fn present(
        &self,
        layout: &TelemetryLayout,
    ) -> Result<Vec<SensorColumns>, TelemetryError> {
        let failed = |fault| TelemetryError { file: self.path.clone(), fault };
        let has = |name: &&String| self.names.contains(name);
        let mut present = Vec::new();
        for of in &layout.sensors {
            match of.columns.iter().find(|name| !has(name)) {
                None => present.push(of.clone()),
                Some(missing) if of.columns.iter().any(|name| has(&name)) => {
                    let (sensor, missing) = (of.name.clone(), missing.clone());
                    return Err(failed(TelemetryFault::Partial { sensor, missing }));
                }
                Some(_) => {}
            }
        }
        if present.is_empty() {
            let wanted = layout.sensors.iter().flat_map(|of| of.columns.clone()).collect();
            let present = self.names.clone();
            return Err(failed(TelemetryFault::NoSensor { wanted, present }));
        }
        Ok(present)
    }

    /// The next row; none at the end.
    ///
    /// # Errors
    /// A cell that is no number.
    pub(super) fn next_row(&mut self) -> Result<Option<&Row>, TelemetryError> {
        let failed = |fault| {
            let file = self.path.clone();
            TelemetryError { file, fault: TelemetryFault::Table(fault) }
        };
        let row = &mut self.row;
        row.cells.clear();
        row.time = None;
        match &mut self.rows {
            Rows::Csv(reader, record) => {
                let more = reader.read_record(record);
                if !more.map_err(|error| failed(TableFault::Read(error.to_string())))? {
                    let rows = usize::try_from(row.number).unwrap_or(usize::MAX);
                    check_rows(&self.path, rows)
                        .map_err(|reason| failed(TableFault::Read(reason)))?;
                    return Ok(None);
                }
                for (index, (place, name)) in self.places.iter().enumerate() {
                    let text = record.get(*place).unwrap_or_default();
                    let cell = if text.is_empty() {
                        None
                    } else {
                        let number = text.parse::<f64>();
                        Some(number.map_err(|_| {
                            failed(TableFault::Cell {
                                line: record.position().map_or(0, csv::Position::line),
                                name: name.clone(),
                                found: text.to_owned(),
                                remark: remark(text, record, row.number == 0),
                            })
                        })?)
                    };
                    if index == 0 { row.time = cell } else { row.cells.push(cell) }
                }
            }
            Rows::Kept(columns) => {
                let index = usize::try_from(row.number).unwrap_or(usize::MAX);
                let mut cells =
                    columns.iter().map(|of| of.get(index).copied().filter(|cell| !cell.is_nan()));
                if columns.first().is_none_or(|times| index >= times.len()) {
                    return Ok(None);
                }
                row.time = cells.next().flatten();
                row.cells.extend(cells);
            }
        }
        row.number += 1;
        Ok(Some(&self.row))
    }
}

/// Names and columns of an archive; arrays of other dimensions or types than columns of numbers are left out.
fn of_npz(path: &Path) -> Result<(Vec<String>, Vec<Vec<f64>>), TelemetryFault> {
    let failed = |reason: String| TelemetryFault::Table(TableFault::Read(reason));
    let bound = MOST_BYTES as u64;
    let mut bytes = Vec::new();
    let file = open(path).map_err(|error| failed(error.to_string()))?;
    let read = file.take(bound.saturating_add(1)).read_to_end(&mut bytes);
    if u64::try_from(read.map_err(|error| failed(error.to_string()))?).unwrap_or(u64::MAX) > bound {
        return Err(TelemetryFault::Table(TableFault::Bytes { bound }));
    }
    let all = npz::all_columns(&bytes).map_err(|error| failed(error.to_string()))?;
    Ok(all.into_iter().unzip())
}

#[cfg(feature = "parquet")]
fn of_parquet(path: &Path) -> Result<(Vec<String>, Vec<Vec<f64>>), TelemetryFault> {
    super::parquet::columns(path)
}

#[cfg(not(feature = "parquet"))]
fn of_parquet(_: &Path) -> Result<(Vec<String>, Vec<Vec<f64>>), TelemetryFault> {
    Err(TelemetryFault::NoParquet)
}
