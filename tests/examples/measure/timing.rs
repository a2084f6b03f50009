//! Time per evaluation: the median of many batches, three times over.

use std::time::Instant;

use serde_json::{Value, json};

use crate::service::{Rejected, Service};

/// How often the median is taken.
const REPEATS: usize = 3;
/// Batches in a repeat.
const BATCHES: usize = 301;
/// Time of a batch, s: long for the clock, short for the scheduler.
const BATCH: f64 = 1e-3;

/// Times a service: each repeat's median, and the extremes over all batches, in ns per evaluation.
pub(crate) fn time(service: &mut dyn Service) -> Result<Value, Rejected> {
    let seconds = |service: &mut dyn Service, calls| {
        let start = Instant::now();
        service.run(calls)?;
        Ok::<_, Rejected>(start.elapsed().as_secs_f64())
    };
    // As many calls as fill a batch; which also warms up.
    let mut calls = 1_u32;
    while seconds(service, calls)? < BATCH {
        calls = calls.saturating_mul(2);
    }
    let evaluations = f64::from(calls) * f64::from(service.evaluations());
    let (mut medians, mut all) = (Vec::new(), Vec::new());
    for _ in 0..REPEATS {
        let mut batches = Vec::with_capacity(BATCHES);
        for _ in 0..BATCHES {
            batches.push(1e9 * seconds(service, calls)? / evaluations);
        }
        medians.push(median(&mut batches));
        all.append(&mut batches);
    }
    all.sort_by(f64::total_cmp);
    Ok(json!({ "ns": medians, "spread": [all.first(), all.last()] }))
}

/// The middle one of an odd number of values.
pub(crate) fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}
