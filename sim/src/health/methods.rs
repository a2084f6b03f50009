//! [`examine`]: alarms of the watch and of both baselines in a record, at several rates of false alarms.

use super::alarm::{Method, MethodAlarm};
use super::case::{HealthCase, Timing};
use super::error::HealthError;
use super::recording::Record;
use super::{observer_baseline, spectrum_baseline};
use crate::watch::{Watch, WatchSettings};

/// With what a record is examined.
#[derive(Clone, Debug, PartialEq)]
pub struct Examining {
    /// Lengths.
    pub timing: Timing,
    /// False alarms an hour, of all tests of a method together; a list of bounds.
    pub false_alarms: Vec<f64>,
}

/// Alarms at each rate of false alarms, of all methods.
#[derive(Clone, Debug, PartialEq)]
pub struct Examined {
    /// In the order of [`Examining::false_alarms`].
    pub alarms: Vec<Vec<MethodAlarm>>,
}

/// Looks for changes in a record, by all methods.
///
/// # Errors
///
/// A record that cannot be watched, a state that the model cannot solve.
pub fn examine(
    case: &HealthCase,
    record: &Record,
    with: &Examining,
) -> Result<Examined, HealthError> {
    let watched = case.spacecraft.watched()?;
    let Timing { block, learn, .. } = with.timing;
    let settings = |false_alarms: f64| WatchSettings { block, learn, false_alarms };
    let mut watch = Watch::new(&watched, &record.sensors, &settings(1.0))?;
    let mut blocks = Vec::new();
    let mut readings = record.readings.iter().copied();
    while let Some(block) = watch.next_block(|| Ok(readings.next()))? {
        blocks.push(block);
    }
    let spectrum = spectrum_baseline::features(&watched, record, block);
    let observer = observer_baseline::features(&watched, record, block)?;
    let mut alarms = Vec::new();
    for rate in &with.false_alarms {
        let settings = settings(*rate);
        let mut quantities = watch.quantities_with(&settings)?;
        let mut own = Vec::new();
        for block in &blocks {
            let estimates = block.values.iter().zip(&block.details);
            for (quantity, (value, detail)) in quantities.iter_mut().zip(estimates) {
                let Some(value) = value else { continue };
                let found = quantity.take(block.times, *value, detail);
                own.extend(found.map(|alarm| MethodAlarm {
                    method: Method::Watch,
                    time: alarm.time,
                    name: alarm.name,
                    place: alarm.of,
                    change: Some([alarm.shift.change, alarm.shift.half_width]),
                }));
            }
        }
        own.extend(spectrum.alarms(Method::Spectrum, &settings));
        own.extend(observer.alarms(Method::Observer, &settings));
        alarms.push(own);
    }
    Ok(Examined { alarms })
}
