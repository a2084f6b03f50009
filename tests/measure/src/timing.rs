//! Time per evaluation or step, in turns: a turn is short, and its time the median of its batches.

use std::io::{Write as _, stdin, stdout};
use std::time::{Duration, Instant};

use serde_json::{Value, json};

use crate::service::{Rejected, Service};

/// Turns of [`time`].
const REPEATS: usize = 21;
/// Time of a turn: short, so that a slow drift of the machine is shared by those who take turns.
const TURN: Duration = Duration::from_millis(50);
/// Time of a batch, s: long for the clock, short for the scheduler.
const BATCH: f64 = 2e-4;

/// Times a service in turns, one after another, in ns.
pub(crate) fn time(service: &mut dyn Service) -> Result<Value, Rejected> {
    let mut turns = Turns::start(service)?;
    let ns: Result<Vec<_>, _> = (0..REPEATS).map(|_| turns.next()).collect();
    Ok(json!({ "ns": ns? }))
}

/// Times a service for a turn after each line of the input, and prints its time.
pub(crate) fn turns(service: &mut dyn Service) -> Result<(), Rejected> {
    let mut turns = Turns::start(service)?;
    each_line(|| turns.next())
}

/// Prints the time that a turn gives, after each line of the input; first that it is ready.
pub(crate) fn each_line(mut turn: impl FnMut() -> Result<f64, Rejected>) -> Result<(), Rejected> {
    let mut out = stdout().lock();
    writeln!(out, "{}", json!({ "ready": true }))?;
    out.flush()?;
    for line in stdin().lines() {
        line?;
        writeln!(out, "{}", json!({ "ns": turn()? }))?;
        out.flush()?;
    }
    Ok(())
}

/// A service that is warm.
struct Turns<'a> {
    service: &'a mut dyn Service,
    /// Calls in a batch.
    calls: u32,
}

impl<'a> Turns<'a> {
    /// Finds as many calls as fill a batch, which also warms up.
    fn start(service: &'a mut dyn Service) -> Result<Self, Rejected> {
        let mut turns = Self { service, calls: 1 };
        while turns.batch()? < BATCH {
            turns.calls = turns.calls.saturating_mul(2);
        }
        Ok(turns)
    }

    /// Seconds of a batch.
    fn batch(&mut self) -> Result<f64, Rejected> {
        let start = Instant::now();
        self.service.run(self.calls)?;
        Ok(start.elapsed().as_secs_f64())
    }

    /// The median of a turn's batches, in ns per evaluation or step.
    fn next(&mut self) -> Result<f64, Rejected> {
        let units = f64::from(self.calls) * f64::from(self.service.units());
        median_of_turn(|| Ok(1e9 * self.batch()? / units))
    }
}

/// The median of as many batches as a turn has time for.
pub(crate) fn median_of_turn(
    mut batch: impl FnMut() -> Result<f64, Rejected>,
) -> Result<f64, Rejected> {
    let (start, mut batches) = (Instant::now(), Vec::new());
    while batches.is_empty() || start.elapsed() < TURN {
        batches.push(batch()?);
    }
    Ok(median(&mut batches))
}

/// The middle one of several values.
pub(crate) fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}
