//! [`score`]: what alarms say of a case: delay, name, place and size, and how many were false; [`rates`]: shares of faults that are found over
//! false alarms.

use super::alarm::{Method, MethodAlarm};
use super::case::{Timing, TrueChange};
use super::error::HealthError;

/// A fault that is found within this time counts in [`rates`], s.
const IN_TIME: f64 = 30.0;

/// What a method says of a case.
#[derive(Clone, Debug, PartialEq)]
pub struct CaseScore {
    /// The case.
    pub case: String,
    /// Alarms before the fault.
    pub false_alarms: usize,
    /// How long a method watched before the fault, s.
    pub healthy: f64,
    /// From the fault to the first alarm after it, s; none without one.
    pub delay: Option<f64>,
    /// To the first alarm that has the name of what has changed.
    pub named: Option<f64>,
    /// To the first alarm at the place of the fault.
    pub located: Option<f64>,
    /// Change in the first alarm of the right name by the true one less one, and whether its interval has the true one.
    pub size: Option<(f64, bool)>,
    /// Alarms after the fault, until the first of the right name, that have another name and place.
    pub misnamed: usize,
}

/// A point of a curve of shares found over false alarms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RatePoint {
    /// Bound, false alarms an hour.
    pub bound: f64,
    /// False alarms an hour that there were.
    pub false_alarms: f64,
    /// Share of faults with an alarm within 30 s.
    pub found: f64,
    /// Share with an alarm of the right place within 30 s.
    pub located: f64,
}

/// Whether an alarm's place is that of a fault: the device, or a joint of it.
fn is_at(place: &str, of: &str) -> bool {
    place == of || place.strip_prefix(of).is_some_and(|rest| rest.starts_with('.'))
}

/// Scores the alarms of one method in one case.
#[must_use]
pub fn score<'a>(
    truth: &TrueChange,
    alarms: impl IntoIterator<Item = &'a MethodAlarm>,
    timing: &Timing,
) -> CaseScore {
    let mut all: Vec<&MethodAlarm> = alarms.into_iter().collect();
    all.sort_by(|a, b| a.time.total_cmp(&b.time));
    let (before, after): (Vec<&MethodAlarm>, Vec<&MethodAlarm>) =
        all.into_iter().partition(|alarm| alarm.time <= truth.onset);
    let after = if truth.place.is_empty() { Vec::new() } else { after };
    let since = |alarm: &MethodAlarm| alarm.time - truth.onset;
    let right = |alarm: &&&MethodAlarm| !truth.quantity.is_empty() && alarm.name == truth.quantity;
    let named = after.iter().find(right);
    let own = after.iter().find(|alarm| is_at(&alarm.place, &truth.place));
    let size = named.and_then(|alarm| {
        let [change, half] = alarm.change.filter(|_| truth.change.is_finite())?;
        Some((change / truth.change - 1.0, (change - truth.change).abs() <= half))
    });
    let until = named.map_or(f64::INFINITY, |alarm| alarm.time);
    let misnamed = after
        .iter()
        .filter(|alarm| alarm.time <= until && !is_at(&alarm.place, &truth.place))
        .count();
    CaseScore {
        case: truth.case.clone(),
        false_alarms: before.len(),
        healthy: truth.onset - timing.learn,
        delay: after.first().map(|alarm| since(alarm)),
        named: named.map(|alarm| since(alarm)),
        located: own.map(|alarm| since(alarm)),
        size,
        misnamed,
    }
}

/// A point of scores of one method at one bound.
#[must_use]
pub fn rates(bound: f64, scores: &[CaseScore]) -> RatePoint {
    let hours = scores.iter().map(|of| of.healthy).sum::<f64>() / 3600.0;
    let alarms: usize = scores.iter().map(|of| of.false_alarms).sum();
    let faults = scores.iter().filter(|of| !of.case.ends_with("-nominal")).count();
    let within = |delay: &Option<f64>| delay.is_some_and(|delay| delay <= IN_TIME);
    let share = |of: fn(&CaseScore) -> &Option<f64>| {
        let found = scores.iter().filter(|score| within(of(score))).count();
        ratio(found, faults)
    };
    #[expect(clippy::cast_precision_loss, reason = "few")]
    let alarms = alarms as f64;
    RatePoint {
        bound,
        false_alarms: alarms / hours,
        found: share(|score| &score.delay),
        located: share(|score| &score.located),
    }
}

#[expect(clippy::cast_precision_loss, reason = "hundreds")]
fn ratio(part: usize, of: usize) -> f64 {
    part as f64 / of.max(1) as f64
}

/// Alarms of another method, CSV with the columns `case`, `time`, `place` and `quantity`, and, if it has them, `change` and `half_width`.
///
/// # Errors
///
/// A column that is missing, a cell that is no number.
pub fn alarms_from_csv(text: &str) -> Result<Vec<(String, MethodAlarm)>, HealthError> {
    let failed = |line: usize, reason: String| HealthError::Table { line, reason };
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(text.as_bytes());
    let head = reader.headers().map_err(|error| failed(1, error.to_string()))?.clone();
    let place = |name: &str| head.iter().position(|of| of.trim() == name);
    let required = |name: &str| {
        place(name).ok_or_else(|| {
            failed(1, format!("no column `{name}`; alarms have case, time, place, quantity"))
        })
    };
    let [case, time, at, quantity] =
        [required("case")?, required("time")?, required("place")?, required("quantity")?];
    let of_change = place("change").zip(place("half_width"));
    let mut alarms = Vec::new();
    for (index, record) in reader.records().enumerate() {
        let line = index + 2;
        let record = record.map_err(|error| failed(line, error.to_string()))?;
        let cell = |column: usize| record.get(column).unwrap_or_default().trim().to_owned();
        let number = |column: usize| {
            let text = cell(column);
            let value = text.parse::<f64>().ok().filter(|value| value.is_finite());
            value.ok_or_else(|| failed(line, format!("`{text}` is no finite number")))
        };
        let change = match of_change {
            Some((change, _)) if cell(change).is_empty() => None,
            Some((change, half)) => Some([number(change)?, number(half)?]),
            None => None,
        };
        let alarm = MethodAlarm {
            method: Method::Watch,
            time: number(time)?,
            name: cell(quantity),
            place: cell(at),
            change,
        };
        alarms.push((cell(case), alarm));
    }
    Ok(alarms)
}
