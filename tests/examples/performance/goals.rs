//! The project's goals for speed: goal, measured, met or by how much missed.

use serde::Serialize;

use crate::contender::Contender;
use crate::machine::Machine;
use crate::named;
use crate::race::Time;

/// The largest number of operations allowed for a hub and for each device, as the suite
/// `operations` asserts: the work of which a batch's share of the issue floor is stated.
const BUDGET: [f64; 2] = [281.0, 1007.0];

/// Words in the names of the peers that goals are stated for.
const DEFAULT: &str = "default build";
const BEST: &str = "best build";
const CASADI: &str = "casadi";

/// One state with four devices, how many times faster than each of these.
const ONE_STATE: [(&str, f64); 3] = [(DEFAULT, 8.0), (BEST, 5.5), (CASADI, 3.4)];

/// Lanes across so many devices, how many times faster than Pinocchio's best build.
const ACROSS: [(usize, f64); 3] = [(4, 14.0), (16, 25.0), (64, 30.0)];

/// A batch, per state with four devices: times faster than Pinocchio's best build, and of the
/// issue floor.
pub(crate) const BATCH: (f64, f64) = (35.0, 0.65);

/// Over these numbers of devices, the largest cost per device is at most so many times the least.
/// Linear is 1; the hub and noise take some per cent, and one count that falls out shows.
const LINEAR: ([usize; 5], f64) = ([16, 32, 64, 128, 256], 1.15);

/// One row.
#[derive(Debug, Serialize)]
pub(crate) struct Goal {
    what: String,
    target: String,
    measured: String,
    verdict: String,
}

impl Goal {
    /// A goal to be reached from below.
    fn at_least(what: String, goal: f64, measured: Option<f64>, unit: &str) -> Self {
        let judged = |measured: f64| {
            let short = 100.0 * (1.0 - measured / goal);
            if short > 0.0 { format!("missed by {short:.0} %") } else { "met".to_owned() }
        };
        let verdict = measured.map(judged);
        let written = |value: f64| format!("{value:.1}{unit}");
        Self {
            what,
            target: written(goal),
            measured: measured.map_or_else(|| "-".to_owned(), written),
            verdict: verdict.unwrap_or_else(|| "not measured".to_owned()),
        }
    }
}

/// Time of a state of four devices with the allowed operations at the issue floor of a batch, ns.
pub(crate) fn batch_floor(contenders: &[Contender], machine: &Machine) -> Option<f64> {
    let batch = contenders.iter().find(|contender| contender.serves("batch"))?;
    let budget = BUDGET[0] + 4.0 * BUDGET[1];
    Some(budget / machine.per_ns(&batch.service.as_ref()?.floor)?)
}

/// The goal of a batch for such a state, from the time of Pinocchio's best build, ns.
pub(crate) fn best_batch(contenders: &[Contender], times: &[Time]) -> Option<f64> {
    Some(time(times, named(contenders, BEST), 4)? / BATCH.0)
}

/// The time of a contender.
fn time(times: &[Time], contender: Option<&Contender>, count: usize) -> Option<f64> {
    let name = &contender?.name;
    Some(times.iter().find(|time| time.name == *name && time.count == count)?.ns)
}

/// All goals.
pub(crate) fn goals(contenders: &[Contender], times: &[Time], machine: &Machine) -> Vec<Goal> {
    let time = |contender, count| time(times, contender, count);
    let service = |name: &str| contenders.iter().find(|contender| contender.serves(name));
    let ratio = |peer: &str, name: &str, count: usize| {
        Some(time(named(contenders, peer), count)? / time(service(name), count)?)
    };
    let mut rows = Vec::new();
    for (name, rounded) in [("one", ""), ("fused", ", fused")] {
        for (peer, goal) in ONE_STATE {
            let what = format!("one state{rounded}, N = 4, against {peer}");
            rows.push(Goal::at_least(what, goal, ratio(peer, name, 4), " times"));
        }
    }
    for (count, goal) in ACROSS {
        let what = format!("lanes across devices, N = {count}, against Pinocchio's {BEST}");
        let found = ratio(BEST, "across", count);
        rows.push(Goal::at_least(what, goal, found, " times"));
    }
    let (goal, share) = BATCH;
    let what = format!("batch, per state, N = 4, against Pinocchio's {BEST}");
    rows.push(Goal::at_least(what, goal, ratio(BEST, "batch", 4), " times"));
    let reached = batch_floor(contenders, machine)
        .and_then(|floor| Some(100.0 * floor / time(service("batch"), 4)?));
    let what = "batch, N = 4, of the issue floor at the allowed operations".to_owned();
    rows.push(Goal::at_least(what, 100.0 * share, reached, " %"));
    rows.push(linear(|count| time(service("one"), count)));
    rows
}

/// The largest cost per device against the least.
#[expect(clippy::cast_precision_loss, reason = "devices are few")]
fn linear(time: impl Fn(usize) -> Option<f64>) -> Goal {
    let (counts, most) = LINEAR;
    let costs: Option<Vec<_>> = counts.iter().map(|n| Some(time(*n)? / *n as f64)).collect();
    let ratio = costs.map(|costs| {
        let largest = costs.iter().copied().fold(0.0, f64::max);
        largest / costs.into_iter().fold(f64::INFINITY, f64::min)
    });
    let judged = |ratio: f64| {
        let over = 100.0 * (ratio / most - 1.0);
        if over > 0.0 { format!("missed by {over:.0} %") } else { "met".to_owned() }
    };
    Goal {
        what: "one state, cost per device for N = 16 to 256, largest to least".to_owned(),
        target: format!("at most {most}"),
        measured: ratio.map_or_else(|| "-".to_owned(), |ratio| format!("{ratio:.2}")),
        verdict: ratio.map_or_else(|| "not measured".to_owned(), judged),
    }
}

impl std::fmt::Display for Goal {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { what, target, measured, verdict } = self;
        write!(f, "{what:62} goal {target:>14}  measured {measured:>12}  {verdict}")
    }
}
