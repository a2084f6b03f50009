//! The page: `docs/performance.md` with its drawing, and the table on the terminal.

use std::error::Error;
use std::path::Path;

use serde::{Deserialize, Serialize};
use tera::{Context, Tera};

use crate::chart::chart;
use crate::contender::{Contender, Missing};
use crate::goals::{BATCH, Goal, batch_floor, best_batch, goals};
use crate::machine::Machine;
use crate::program::Program;
use crate::race::{Plan, Time, file};

/// What the page is made of.
pub(crate) struct Page {
    pub(crate) machine: Machine,
    pub(crate) contenders: Vec<Contender>,
    pub(crate) missing: Vec<Missing>,
    /// Of each contender, how far it lies from the reference.
    pub(crate) worst: Vec<(String, f64)>,
    pub(crate) times: Vec<Time>,
    pub(crate) parts: Vec<Parts>,
}

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

/// A row of the table of times.
#[derive(Serialize)]
struct Row {
    name: String,
    note: String,
    agrees: String,
    cells: Vec<String>,
}

/// Where the time of one state goes.
#[derive(Serialize)]
struct Share {
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
struct Limits {
    /// The chain of an evaluation with one device, and the evaluation.
    chain: Option<String>,
    one: Option<String>,
    /// Each further device.
    device: Option<String>,
    /// The allowed operations at the issue floor, the goal of a batch, and its share of the floor.
    budget: Option<String>,
    times: f64,
    target: Option<String>,
    share: Option<String>,
}

/// Which share of the issue floor a service reaches.
#[derive(Serialize)]
struct Reached {
    name: String,
    floor: String,
    cells: Vec<String>,
}

/// Measures the parts of the plan's evaluations.
pub(crate) fn parts(measure: &Program, plan: &Plan, folder: &Path) -> Result<Vec<Parts>, String> {
    let query = |count: &usize| {
        let file = file(folder, *count).display().to_string();
        Ok(Parts { count: *count, ..measure.query(&["parts", &file])? })
    };
    plan.counts.iter().map(query).collect()
}

impl Page {
    /// The table, on the terminal.
    pub(crate) fn show(&self) {
        let counts = self.counts();
        let heading = counts.iter().map(|count| format!("N = {count}")).collect();
        let line = |name: &str, cells: Vec<String>| {
            print!("{name:48}");
            for cell in cells {
                print!("{cell:>24}");
            }
            println!();
        };
        println!();
        line("ns per evaluation (times one state, spread)", heading);
        for Row { name, cells, .. } in self.rows() {
            line(&name, cells);
        }
        println!();
        for goal in self.goals() {
            println!("{goal}");
        }
    }

    /// The files, by name.
    pub(crate) fn files(&self) -> Result<Vec<(&'static str, String)>, Box<dyn Error>> {
        let mut context = Context::new();
        context.insert("machine", &self.machine);
        context.insert("counts", &self.counts());
        context.insert("rows", &self.rows());
        context.insert("missing", &self.missing);
        context.insert("goals", &self.goals());
        context.insert("shares", &self.shares());
        context.insert("reached", &self.reached());
        context.insert("limits", &self.limits());
        let mut tera = Tera::default();
        tera.autoescape_on(Vec::<&str>::new());
        tera.add_raw_template("page", include_str!("performance.md.tera"))?;
        let text = tera.render("page", &context)?;
        Ok(vec![
            ("performance.md", text),
            ("performance.svg", chart(&self.contenders, &self.times)?),
        ])
    }

    fn goals(&self) -> Vec<Goal> {
        goals(&self.contenders, &self.times, &self.machine)
    }

    /// The numbers of devices at which everyone was timed.
    fn counts(&self) -> Vec<usize> {
        self.parts.iter().map(|parts| parts.count).collect()
    }

    fn time(&self, name: &str, count: usize) -> Option<&Time> {
        self.times.iter().find(|time| time.name == name && time.count == count)
    }

    /// What the ratios are taken to: one state, scalar.
    fn one(&self, count: usize) -> Option<f64> {
        let one = self.contenders.iter().find(|contender| contender.serves("one"))?;
        Some(self.time(&one.name, count)?.ns)
    }

    fn rows(&self) -> Vec<Row> {
        let row = |contender: &Contender| {
            let cell = |count: usize| {
                let Some(time) = self.time(&contender.name, count) else { return "-".to_owned() };
                let spread = 100.0 * time.spread();
                let ratio = self.one(count).map_or(f64::NAN, |one| time.ns / one);
                format!("{} ({ratio:.2}, {spread:.0} %)", digits(time.ns))
            };
            let own = self.worst.iter().find(|(name, _)| *name == contender.name);
            Row {
                name: contender.name.clone(),
                note: contender.note.clone(),
                agrees: own.map_or_else(|| "-".to_owned(), |(_, worst)| of_reference(*worst)),
                cells: self.counts().into_iter().map(cell).collect(),
            }
        };
        self.contenders.iter().map(row).collect()
    }

    fn shares(&self) -> Vec<Share> {
        let share = |parts: &Parts| {
            let (ns, per_ns) = (self.one(parts.count)?, self.machine.per_ns("f64")?);
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
        self.parts.iter().filter_map(share).collect()
    }

    /// What was not measured is left out, and the sentence about it with it.
    fn limits(&self) -> Limits {
        let chain = self.parts.iter().find(|parts| parts.count == 1).map(|parts| parts.chain_ns);
        let device = self.one(16).zip(self.one(4)).map(|(more, few)| (more - few) / 12.0);
        let budget = batch_floor(&self.contenders, &self.machine);
        let target = best_batch(&self.contenders, &self.times);
        let share = budget.zip(target).map(|(floor, target)| 100.0 * floor / target);
        Limits {
            chain: chain.map(digits),
            one: self.one(1).map(digits),
            device: device.map(digits),
            budget: budget.map(digits),
            times: BATCH.0,
            target: target.map(digits),
            share: share.map(|share| format!("{share:.0} %")),
        }
    }

    fn reached(&self) -> Vec<Reached> {
        let services = self.contenders.iter().filter_map(|c| Some((c, c.service.as_ref()?)));
        let reached = services.map(|(contender, service)| {
            let cell = |parts: &Parts| {
                let ns = self.time(&contender.name, parts.count)?.ns;
                let floor = f64::from(parts.operations) / self.machine.per_ns(&service.floor)?;
                Some(format!("{:.0} %", 100.0 * floor / ns))
            };
            let cell = |parts| cell(parts).unwrap_or_else(|| "-".to_owned());
            Reached {
                name: contender.name.clone(),
                floor: service.floor.clone(),
                cells: self.parts.iter().map(cell).collect(),
            }
        });
        reached.collect()
    }
}

/// A deviation; of the one that is compared with, there is none.
fn of_reference(worst: f64) -> String {
    if worst == 0.0 { "reference".to_owned() } else { format!("{worst:.0e}") }
}

/// The middle one.
fn median(values: &[f64]) -> f64 {
    let mut values = values.to_vec();
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

/// A time to three digits or to the nanosecond.
fn digits(ns: f64) -> String {
    if ns < 100.0 { format!("{ns:.1}") } else { format!("{ns:.0}") }
}
