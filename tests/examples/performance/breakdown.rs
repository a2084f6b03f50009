//! What one state's time is made of, and what limits the services.

use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::machine::Machine;
use crate::plan::Plan;
use crate::program::Program;
use crate::race::median;
use crate::subject::Subject;
use crate::tables::{Tables, digits};

/// The service whose time is taken apart.
const WHOLE: &str = "dispatched";

/// What an evaluation of one state is made of.
#[derive(Deserialize)]
pub(crate) struct Parts {
    #[serde(skip)]
    count: usize,
    operations: u32,
    chain_ns: f64,
    sin_cos: u32,
    sin_cos_ns: Vec<f64>,
    hub_ns: Vec<f64>,
}

/// Where the time of one state goes.
#[derive(Serialize)]
pub(crate) struct Share {
    count: usize,
    ns: String,
    operations: u32,
    floor: String,
    chain: String,
    sines: String,
    hub: String,
    rest: String,
}

/// What limits the services, ns.
#[derive(Serialize)]
pub(crate) struct Limits {
    /// The chain of an evaluation with one device, and the evaluation.
    chain: Option<String>,
    one: Option<String>,
    /// Each further device.
    device: Option<String>,
    /// The operations at the issue floor, the goal of a batch, and its share of the floor.
    floor: Option<String>,
    times: f64,
    target: Option<String>,
    share: Option<String>,
}

/// Measures the parts of the plan's evaluations.
pub(crate) fn parts(measure: &Program, plan: &Plan, folder: &Path) -> Result<Vec<Parts>, String> {
    let query = |count: &usize| {
        let file = Subject::Evaluation.file(folder, &count.to_string()).display().to_string();
        Ok(Parts { count: *count, ..measure.query(&["parts".to_owned(), file])? })
    };
    plan.counts.iter().map(query).collect()
}

/// Each number of devices.
pub(crate) fn shares(parts: &[Parts], tables: &Tables<'_>, machine: &Machine) -> Vec<Share> {
    let share = |parts: &Parts| {
        let (ns, per_ns) = (tables.ns(WHOLE, parts.count)?, machine.per_ns("f64")?);
        let (floor, sines) = (f64::from(parts.operations) / per_ns, median(&parts.sin_cos_ns));
        let with_share = |part: f64| format!("{} ({:.0} %)", digits(part), 100.0 * part / ns);
        Some(Share {
            count: parts.count,
            ns: digits(ns),
            operations: parts.operations,
            floor: with_share(floor),
            chain: with_share(parts.chain_ns),
            sines: format!("{} × {}", with_share(sines), parts.sin_cos),
            hub: with_share(median(&parts.hub_ns)),
            rest: with_share(ns - floor - sines),
        })
    };
    parts.iter().filter_map(share).collect()
}

/// What was not measured is left out, and the sentence about it with it.
pub(crate) fn limits(parts: &[Parts], tables: &Tables<'_>) -> Limits {
    let chain = parts.iter().find(|parts| parts.count == 1).map(|parts| parts.chain_ns);
    let one = |count| tables.ns(WHOLE, count);
    let device = one(16).zip(one(4)).map(|(more, few)| (more - few) / 12.0);
    let (floor, target, times) = tables.measured.batch_limits();
    let share = floor.zip(target).map(|(floor, target)| 100.0 * floor / target);
    Limits {
        chain: chain.map(digits),
        one: one(1).map(digits),
        device: device.map(digits),
        floor: floor.map(digits),
        times,
        target: target.map(digits),
        share: share.map(|share| format!("{share:.0} %")),
    }
}
