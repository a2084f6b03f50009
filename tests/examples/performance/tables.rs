//! The tables of times: services and peers, steps, batches, baked kernels.

use serde::Serialize;

use crate::contender::Contender;
use crate::goals::Measured;
use crate::plan::Plan;
use crate::race::{Ratio, Time};
use crate::subject::{IMAGING, Subject};
use crate::verdict::WAITED;

/// A table of times.
#[derive(Serialize)]
pub(crate) struct Table {
    /// Headings of the columns of times.
    pub(crate) heading: Vec<String>,
    pub(crate) rows: Vec<TableRow>,
}

/// A row of it.
#[derive(Serialize)]
pub(crate) struct TableRow {
    pub(crate) name: String,
    pub(crate) cells: Vec<String>,
    agrees: String,
}

/// What the tables are made of.
pub(crate) struct Tables<'a> {
    pub(crate) measured: &'a Measured<'a>,
    pub(crate) plan: &'a Plan,
    /// Of each contender, how far it lies from the reference.
    pub(crate) worst: &'a [(String, f64)],
}

impl Tables<'_> {
    /// One state: services and peers.
    pub(crate) fn services(&self) -> Table {
        self.table(&[Subject::Evaluation], self.counts())
    }

    /// RK4 steps of one state.
    pub(crate) fn steps(&self) -> Table {
        self.table(&[Subject::Step], self.plan.step_cases())
    }

    /// Many states: evaluations, and RK4 steps.
    pub(crate) fn batches(&self) -> Table {
        self.table(&[Subject::Batch, Subject::BatchStep], self.counts())
    }

    /// The imaging satellite.
    pub(crate) fn baked(&self) -> Table {
        self.table(&[Subject::Baked], vec![(IMAGING.to_owned(), "ns".to_owned())])
    }

    fn counts(&self) -> Vec<(String, String)> {
        self.plan.counts.iter().map(|n| (n.to_string(), format!("N = {n}"))).collect()
    }

    /// Columns are cases with their titles; columns without a time are left out.
    fn table(&self, subjects: &[Subject], columns: Vec<(String, String)>) -> Table {
        let Measured { contenders, times } = self.measured;
        let rows = || contenders.iter().filter(|who| subjects.contains(&who.subject));
        let timed = |case: &str| rows().any(|who| times.of_contender(who, case).is_some());
        let columns: Vec<_> = columns.into_iter().filter(|(case, _)| timed(case)).collect();
        let row = |who: &Contender| TableRow {
            name: who.name.clone(),
            cells: columns.iter().map(|(case, _)| self.cell(who, case)).collect(),
            agrees: self.agrees(who),
        };
        Table {
            rows: rows().map(row).collect(),
            heading: columns.iter().map(|(_, title)| title.clone()).collect(),
        }
    }

    /// Time, how many times that of the unit of its subject, spread; marked where its core was shared.
    fn cell(&self, who: &Contender, case: &str) -> String {
        let Measured { contenders, times } = self.measured;
        let Some(time) = times.of_contender(who, case) else { return "-".to_owned() };
        let unit = who.subject.unit();
        let unit = contenders.iter().find(|other| other.serves(unit));
        let ratio = unit.and_then(|unit| times.ratio((who, case), (unit, case)));
        let ratio = ratio.map_or_else(|| "-".to_owned(), |Ratio { value, .. }| of_unit(value));
        let waited = if time.waited < WAITED { "" } else { " †" };
        format!("{} ({ratio}, {:.0} %){waited}", digits(time.ns()), 100.0 * time.spread())
    }

    fn agrees(&self, who: &Contender) -> String {
        let own = self.worst.iter().find(|(name, _)| *name == who.name);
        own.map_or_else(|| "-".to_owned(), |(_, worst)| of_reference(*worst))
    }

    /// A line for each service of its share of the issue floor.
    pub(crate) fn reached(&self) -> Vec<Reached> {
        let services =
            self.measured.contenders.iter().filter_map(|c| Some((c, c.service.as_ref()?)));
        let reached = services.filter_map(|(contender, service)| {
            let floor = service.floor.clone()?;
            let cell = |count: &usize| {
                let share = self.measured.share(&service.name, *count);
                share
                    .map_or_else(|| "-".to_owned(), |share| format!("{:.0} %", 100.0 * share.value))
            };
            let cells = self.plan.counts.iter().map(cell).collect();
            Some(Reached { name: contender.name.clone(), floor, cells })
        });
        reached.collect()
    }

    /// Nanoseconds of a service with so many devices.
    pub(crate) fn ns(&self, service: &str, count: usize) -> Option<f64> {
        let service = self.measured.service(service)?;
        self.measured.times.of_contender(service, &count.to_string()).map(Time::ns)
    }
}

/// Which share of the issue floor a service reaches.
#[derive(Serialize)]
pub(crate) struct Reached {
    name: String,
    floor: String,
    cells: Vec<String>,
}

/// A deviation; of the one that is compared with, there is none.
pub(crate) fn of_reference(worst: f64) -> String {
    if worst == 0.0 { "reference, or equal".to_owned() } else { format!("{worst:.0e}") }
}

/// A ratio to three digits or to the whole.
pub(crate) fn of_unit(ratio: f64) -> String {
    if ratio < 10.0 { format!("{ratio:.2}") } else { format!("{ratio:.1}") }
}

/// A time to three digits or to the nanosecond.
pub(crate) fn digits(ns: f64) -> String {
    if ns < 100.0 { format!("{ns:.1}") } else { format!("{ns:.0}") }
}
