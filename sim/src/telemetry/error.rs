//! [`TelemetryError`]: why a file is not read as telemetry.

use std::fmt;
use std::path::PathBuf;

use crate::tables::TableFault;
use crate::units::Plain;

/// A file that is not read as telemetry.
#[derive(Debug)]
pub struct TelemetryError {
    /// The file.
    pub file: PathBuf,
    /// What is wrong.
    pub fault: TelemetryFault,
}

/// What is wrong with a file of telemetry.
#[derive(Debug)]
pub enum TelemetryFault {
    /// The table of its numbers.
    Table(TableFault),
    /// No column of any sensor.
    NoSensor {
        /// Columns that it could have.
        wanted: Vec<String>,
        /// Those that it has.
        present: Vec<String>,
    },
    /// Some, but not all columns of a sensor.
    Partial {
        /// The sensor.
        sensor: String,
        /// A column that is missing.
        missing: String,
    },
    /// A row without a time.
    NoTime {
        /// The row, from 1.
        row: u64,
    },
    /// A time before that of the row before.
    Falls {
        /// The row, from 1.
        row: u64,
        /// The time there and that before, s.
        times: [f64; 2],
    },
    /// Readings nearer to each other than the sensor's rate allows.
    TooFast {
        /// The sensor.
        sensor: String,
        /// When, s.
        time: f64,
        /// The interval, s.
        interval: f64,
        /// The shortest, s.
        period: f64,
    },
    /// Times that are in another unit.
    TimeUnit {
        /// The sensor.
        sensor: String,
        /// The median interval of its readings, in the numbers of the file.
        interval: f64,
        /// The sensor's period, s.
        period: f64,
        /// The unit in which they agree.
        unit: &'static str,
    },
    /// A format that this program was built without.
    NoParquet,
}

impl fmt::Display for TelemetryError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.file.display(), self.fault)
    }
}

impl fmt::Display for TelemetryFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Table(fault) => fault.fmt(f),
            Self::NoSensor { wanted, present } => write!(
                f,
                "no column is of a sensor; there are {}, and {} would be",
                present.join(", "),
                wanted.join(", ")
            ),
            Self::Partial { sensor, missing } => write!(
                f,
                "of the {sensor} the column `{missing}` is missing; write all of its columns or none"
            ),
            Self::NoTime { row } => {
                write!(f, "row {row} has no time; write a number of seconds, or remove the row")
            }
            Self::Falls { row, times: [time, before] } => write!(
                f,
                "the time of row {row}, {} s, is before that of the row before, {} s; sort the rows",
                Plain(*time),
                Plain(*before)
            ),
            Self::TooFast { sensor, time, interval, period } => write!(
                f,
                "two readings of the {sensor} are {} s apart at {} s, and the scenario states {} s; correct the rate of its \
                 controller, or the unit of the times",
                Plain(*interval),
                Plain(*time),
                Plain(*period)
            ),
            Self::TimeUnit { sensor, interval, period, unit } => write!(
                f,
                "readings of the {sensor} are {} apart, and the scenario states {} s: the times are in {unit}; state \
                 `time_unit = \"{unit}\"`",
                Plain(*interval),
                Plain(*period)
            ),
            Self::NoParquet => f.write_str(
                "this program is built without Parquet; build it with `--features parquet`, or write CSV or NPZ",
            ),
        }
    }
}

impl std::error::Error for TelemetryError {}
