//! [`Screen`]: rows of cells in, readings in the order of time out; what is no reading is counted with its reason.
//!
//! A gyro or star tracker with noise and no quantum never reads the same twice: two readings, a period apart, of which a
//! component has the same bits, are of a sensor that is saturated or stuck, and both are left out. So its reading is
//! kept until the next one comes, or two and a half periods have passed, and readings after it with it. Rows nearer than that
//! which repeat a reading (a table that has more rows than the sensor has samples) are held values.

use std::collections::VecDeque;
use std::fmt;
use std::path::{Path, PathBuf};

use super::cells::Row;
use super::error::{TelemetryError, TelemetryFault};
use super::layout::{Sensor, SensorColumns};
use crate::units::Plain;

/// Rows that repeat a reading within this share of the period are held values.
const HELD: f64 = 0.99;
/// Other readings are at least this share of it apart, and clocks may jitter by the rest.
const FAST: f64 = 0.5;
/// Times nearer than this are one, s.
const NEAR: f64 = 1e-9;
/// Periods after which a reading that no other has followed is released.
const RELEASED: f64 = 2.5;
/// A sensor whose reading is this share of its range is saturated.
const FULL: f64 = 0.9999;
/// By which the norm of four Euler parameters may differ from one.
const NORM: f64 = 1e-3;

/// A reading.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reading {
    /// Its sensor, by its number among those of the file.
    pub index: usize,
    /// s.
    pub time: f64,
    /// SI units: one, three or four numbers; the others are zero.
    pub value: [f64; 4],
}

/// Why a cell or row is no reading.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reason {
    /// The time of a row is that of the row before.
    RepeatedTime,
    /// A number is NaN or infinite.
    NotFinite,
    /// Some, but not all components are there.
    Incomplete,
    /// A row between samples that repeats the last reading.
    Held,
    /// A component of two readings is equal to the last bit, where the sensor has noise: it is saturated or stuck.
    Stuck,
    /// A component is at the end of the stated range.
    Saturated,
    /// Four numbers that are no attitude: their norm is not one.
    NoAttitude,
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::RepeatedTime => "the time is that of the row before",
            Self::NotFinite => "a number is not finite",
            Self::Incomplete => "a component is missing",
            Self::Held => "held values between samples",
            Self::Stuck => "equal to its neighbour to the last bit: saturated or stuck",
            Self::Saturated => "at the end of the stated range",
            Self::NoAttitude => "the norm of the Euler parameters is not one",
        })
    }
}

/// What was left out for one reason.
#[derive(Clone, Debug, PartialEq)]
pub struct Exclusion {
    /// The sensor; none of whole rows.
    pub sensor: Option<String>,
    /// Why.
    pub reason: Reason,
    /// How many readings or rows.
    pub count: u64,
    /// When the first one was, s.
    pub first: f64,
    /// And the last one.
    pub last: f64,
}

impl fmt::Display for Exclusion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let what = self.sensor.as_deref().map_or("rows", |sensor| sensor);
        write!(f, "{what}: {} left out, {}", self.count, self.reason)?;
        write!(f, ", from {} s to {} s", Plain(self.first), Plain(self.last))
    }
}

/// A reading on its way out.
#[derive(Clone, Copy, Debug)]
struct Pending {
    reading: Reading,
    /// Whether it is certain that it is one.
    certain: bool,
    stuck: bool,
}

pub(super) struct Screen {
    path: PathBuf,
    sensors: Vec<SensorColumns>,
    time_size: f64,
    /// The time of the row before, s.
    before: Option<f64>,
    /// The last reading of each sensor, left out or not.
    last: Vec<Option<Reading>>,
    pending: VecDeque<Pending>,
    exclusions: Vec<Exclusion>,
}

impl Screen {
    pub(super) fn new(path: &Path, sensors: Vec<SensorColumns>, time_size: f64) -> Self {
        let last = vec![None; sensors.len()];
        let path = path.to_owned();
        let (pending, exclusions) = (VecDeque::new(), Vec::new());
        Self { path, sensors, time_size, before: None, last, pending, exclusions }
    }

    pub(super) fn sensors(&self) -> &[SensorColumns] {
        &self.sensors
    }

    pub(super) fn exclusions(&self) -> &[Exclusion] {
        &self.exclusions
    }

    fn fault(&self, fault: TelemetryFault) -> TelemetryError {
        TelemetryError { file: self.path.clone(), fault }
    }

    fn exclude(&mut self, sensor: Option<usize>, reason: Reason, time: f64) {
        let name = sensor.and_then(|index| self.sensors.get(index)).map(|of| of.name.clone());
        let same = |of: &&mut Exclusion| of.reason == reason && of.sensor == name;
        if let Some(of) = self.exclusions.iter_mut().find(same) {
            of.count += 1;
            of.last = of.last.max(time);
        } else {
            let (first, last) = (time, time);
            self.exclusions.push(Exclusion { sensor: name, reason, count: 1, first, last });
        }
    }

    /// A row of the file.
    ///
    /// # Errors
    /// A row without a time or with one that falls, readings that are too fast.
    pub(super) fn put(&mut self, row: &Row) -> Result<(), TelemetryError> {
        let time = row.time.filter(|time| time.is_finite()).map(|time| time * self.time_size);
        let Some(time) = time else {
            return Err(self.fault(TelemetryFault::NoTime { row: row.number }));
        };
        if let Some(before) = self.before {
            if time < before - NEAR {
                let times = [time, before];
                return Err(self.fault(TelemetryFault::Falls { row: row.number, times }));
            }
            if time <= before + NEAR {
                self.exclude(None, Reason::RepeatedTime, time);
                return Ok(());
            }
        }
        self.before = Some(time);
        let mut cells = row.cells.iter();
        for index in 0..self.sensors.len() {
            let Some((count, size)) = self.sensors.get(index).map(|of| (of.columns.len(), of.size))
            else {
                continue;
            };
            let own: Vec<Option<f64>> = cells.by_ref().take(count).copied().collect();
            if own.iter().all(Option::is_none) {
                continue;
            }
            let mut value = [0.0; 4];
            for (to, from) in value.iter_mut().zip(&own) {
                *to = size * from.unwrap_or(0.0);
            }
            if own.iter().flatten().any(|number| !number.is_finite()) {
                self.exclude(Some(index), Reason::NotFinite, time);
            } else if own.iter().any(Option::is_none) {
                self.exclude(Some(index), Reason::Incomplete, time);
            } else {
                self.reading(Reading { index, time, value })?;
            }
        }
        let released = |of: &SensorColumns| of.period.map_or(0.0, |period| RELEASED * period);
        for pending in &mut self.pending {
            let wait = self.sensors.get(pending.reading.index).map_or(0.0, released);
            pending.certain |= time - pending.reading.time > wait;
        }
        Ok(())
    }

    fn reading(&mut self, mut reading: Reading) -> Result<(), TelemetryError> {
        let Reading { index, time, value } = reading;
        let Some(of) = self.sensors.get(index).cloned() else { return Ok(()) };
        if of.sensor == Sensor::StarTracker {
            let norm = value.iter().map(|number| number * number).sum::<f64>().sqrt();
            if (norm - 1.0).abs() > NORM {
                self.exclude(Some(index), Reason::NoAttitude, time);
                return Ok(());
            }
            reading.value = value.map(|number| number / norm);
        }
        let last = self.last.get(index).copied().flatten();
        let own = of.columns.len();
        let mut stuck = false;
        if let (Some(last), Some(period)) = (last, of.period) {
            let interval = time - last.time;
            let same = |(a, b): (&f64, &f64)| a.to_bits() == b.to_bits();
            let pairs = || last.value.iter().zip(&reading.value).take(own);
            if interval < HELD * period && pairs().all(same) {
                self.exclude(Some(index), Reason::Held, time);
                return Ok(());
            }
            if interval < FAST * period {
                let (sensor, period) = (of.name, period);
                return Err(self.fault(TelemetryFault::TooFast { sensor, time, interval, period }));
            }
            stuck = of.noisy && pairs().any(same);
        }
        if let Some(place) = self.last.get_mut(index) {
            *place = Some(reading);
        }
        let waiting = self.pending.iter_mut().rev().find(|of| of.reading.index == index);
        if let Some(before) = waiting {
            before.certain = true;
            before.stuck |= stuck;
        }
        if of.range.is_some_and(|range| value.iter().any(|number| number.abs() >= FULL * range)) {
            self.exclude(Some(index), Reason::Saturated, time);
            return Ok(());
        }
        self.pending.push_back(Pending { reading, certain: !of.noisy, stuck });
        Ok(())
    }

    /// No row follows.
    pub(super) fn end(&mut self) {
        self.pending.iter_mut().for_each(|pending| pending.certain = true);
    }

    /// The first reading that is certain, and has none before it that is not.
    pub(super) fn next(&mut self) -> Option<Reading> {
        while self.pending.front().is_some_and(|pending| pending.certain) {
            let Pending { reading, stuck, .. } = self.pending.pop_front()?;
            if !stuck {
                return Some(reading);
            }
            self.exclude(Some(reading.index), Reason::Stuck, reading.time);
        }
        None
    }
}
