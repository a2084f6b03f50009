//! Telemetry of a spacecraft: readings of gyro, star tracker, tachometers, encoders and motors, each at its own times, from
//! a table (CSV, NPZ, Parquet).
//!
//! ```text
//! file --table--> rows of cells --screen--> readings, exclusions with counts
//! ```
//!
//! A row has one time; a sensor that reads nothing at it has empty cells (in NPZ and Parquet NaN or null). Nothing is left
//! out silently: what is no reading is an [`Exclusion`] with its reason and count, what makes the file unreadable a
//! [`TelemetryError`]. [`Telemetry::read`] keeps all readings, [`TelemetryRows`] gives them one by one, in the order of time, and
//! keeps a few (of CSV; the others are read whole).
//!
//! | file | what |
//! |---|---|
//! | `layout` | [`TelemetryLayout`]: which columns are which sensor, from a scenario |
//! | `cells` | rows of cells of each format |
//! | `screen` | readings and exclusions of rows |
//! | `error` | [`TelemetryError`], [`TelemetryFault`] |

mod cells;
mod error;
mod layout;
#[cfg(feature = "parquet")]
mod parquet;
mod screen;
#[cfg(test)]
mod tests;

use std::path::Path;

pub use error::{TelemetryError, TelemetryFault};
pub(crate) use layout::controller_of;
pub use layout::{LayoutError, Sensor, SensorColumns, TelemetryLayout};
pub use screen::{Exclusion, Reading, Reason};

use cells::Cells;
use screen::Screen;

/// An interval between readings above this multiple of their median interval is a gap.
const GAP: f64 = 1.5;

/// The readings of one sensor.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Which.
    pub sensor: Sensor,
    /// Its name in messages: `gyro`, `tachometer of rw_1.spin`.
    pub name: String,
    /// Times, s, rising.
    pub times: Vec<f64>,
    /// SI units: of a gyro three rates, rad/s, of a star tracker Euler parameters, scalar first, of a joint one number; the others are
    /// zero.
    pub values: Vec<[f64; 4]>,
}

impl Series {
    /// The median interval between readings, s; none of fewer than two.
    #[must_use]
    pub fn interval(&self) -> Option<f64> {
        let mut steps: Vec<f64> = self.times.windows(2).map(|pair| pair[1] - pair[0]).collect();
        steps.sort_by(f64::total_cmp);
        steps.get(steps.len() / 2).copied()
    }

    /// From when to when it has no readings, s: intervals of more than one and a half times the median.
    #[must_use]
    pub fn gaps(&self) -> Vec<[f64; 2]> {
        let longest = self.interval().map_or(f64::INFINITY, |interval| GAP * interval);
        let pairs = self.times.windows(2).map(|pair| [pair[0], pair[1]]);
        pairs.filter(|[from, to]| to - from > longest).collect()
    }
}

/// Everything that a file has.
#[derive(Clone, Debug, PartialEq)]
pub struct Telemetry {
    /// The sensors that the file has columns of, in the order of the layout.
    pub series: Vec<Series>,
    /// What is left out, with its reason and count.
    pub exclusions: Vec<Exclusion>,
}

impl Telemetry {
    /// Reads a file. The sensors of the layout that it has no columns of are missing.
    ///
    /// # Errors
    ///
    /// What makes the file unreadable as telemetry, with the remedy.
    pub fn read(path: &Path, layout: &TelemetryLayout) -> Result<Self, TelemetryError> {
        Self::of_rows(TelemetryRows::open(path, layout)?, path)
    }

    /// Of columns in memory, each with its name; NaN where a sensor has no reading. Messages call them `name`.
    ///
    /// # Errors
    ///
    /// As [`Self::read`].
    pub fn of_columns(
        name: &str,
        columns: Vec<(String, Vec<f64>)>,
        layout: &TelemetryLayout,
    ) -> Result<Self, TelemetryError> {
        Self::of_rows(TelemetryRows::of_columns(name, columns, layout)?, Path::new(name))
    }

    fn of_rows(mut rows: TelemetryRows, path: &Path) -> Result<Self, TelemetryError> {
        let present = rows.sensors().to_vec();
        let empty = |of: &SensorColumns| Series {
            sensor: of.sensor,
            name: of.name.clone(),
            times: Vec::new(),
            values: Vec::new(),
        };
        let mut series: Vec<Series> = present.iter().map(empty).collect();
        while let Some(reading) = rows.next_reading()? {
            if let Some(of) = series.get_mut(reading.index) {
                of.times.push(reading.time);
                of.values.push(reading.value);
            }
        }
        let telemetry = Self { series, exclusions: rows.exclusions().to_vec() };
        let failed = |fault| TelemetryError { file: path.to_owned(), fault };
        for (series, columns) in telemetry.series.iter().zip(&present) {
            check_times(series, columns).map_err(failed)?;
        }
        Ok(telemetry)
    }

    /// The readings of a sensor; none where the file has no columns of it, or no reading in them.
    #[must_use]
    pub fn of(&self, sensor: Sensor) -> Option<&Series> {
        self.series.iter().find(|of| of.sensor == sensor && !of.times.is_empty())
    }
}

/// Of readings that come at a stated rate, at most: that the unit of the times is seconds.
fn check_times(series: &Series, columns: &SensorColumns) -> Result<(), TelemetryFault> {
    let (Some(interval), Some(period)) = (series.interval(), columns.period) else { return Ok(()) };
    let unit = [(1e3, "ms"), (1e6, "us"), (1e9, "ns"), (1.0 / 60.0, "min")];
    let near = |factor: f64| (0.9..=1.1).contains(&(interval / period / factor));
    match unit.into_iter().find(|(factor, _)| near(*factor)) {
        Some((_, unit)) => {
            Err(TelemetryFault::TimeUnit { sensor: series.name.clone(), interval, period, unit })
        }
        None => Ok(()),
    }
}

/// Readings one by one, in the order of their times.
pub struct TelemetryRows {
    cells: Cells,
    screen: Screen,
    ended: bool,
}

impl TelemetryRows {
    /// Opens a file.
    ///
    /// # Errors
    ///
    /// A file that cannot be read, no column of the time or of any sensor, and some but not all columns of a sensor.
    pub fn open(path: &Path, layout: &TelemetryLayout) -> Result<Self, TelemetryError> {
        Self::of(Cells::open(path, layout)?, path, layout)
    }

    /// Of columns in memory, each with its name; NaN where a sensor has no reading. Messages call them `name`.
    ///
    /// # Errors
    ///
    /// As [`Self::open`].
    pub fn of_columns(
        name: &str,
        columns: Vec<(String, Vec<f64>)>,
        layout: &TelemetryLayout,
    ) -> Result<Self, TelemetryError> {
        let path = Path::new(name);
        Self::of(Cells::of_columns(path, columns, layout)?, path, layout)
    }

    fn of(cells: Cells, path: &Path, layout: &TelemetryLayout) -> Result<Self, TelemetryError> {
        let present = cells.present(layout)?;
        Ok(Self { screen: Screen::new(path, present, layout.time_size), cells, ended: false })
    }

    /// The sensors that the file has columns of: a [`Reading::index`] counts them.
    #[must_use]
    pub fn sensors(&self) -> &[SensorColumns] {
        self.screen.sensors()
    }

    /// The next reading; none at the end.
    ///
    /// # Errors
    ///
    /// A cell that is no number, times that fall, readings faster than the sensor's rate.
    pub fn next_reading(&mut self) -> Result<Option<Reading>, TelemetryError> {
        loop {
            if let Some(reading) = self.screen.next() {
                return Ok(Some(reading));
            }
            if self.ended {
                return Ok(None);
            }
            if let Some(row) = self.cells.next_row()? {
                self.screen.put(row)?;
            } else {
                self.screen.end();
                self.ended = true;
            }
        }
    }

    /// What has been left out until now.
    #[must_use]
    pub fn exclusions(&self) -> &[Exclusion] {
        self.screen.exclusions()
    }
}
