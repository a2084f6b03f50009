//! [`Report`]: one HTML page about a run that holds everything it shows; its figures as SVG; a
//! summary for the terminal.
//!
//! ```text
//! samples -> Report (buckets, extremes, verdicts, replay frames)
//!         -> charts -> SVG figures, data block
//!         -> sections -> page (sim/report/shell.html)
//! ```
//!
//! Invariants: memory does not grow with the length of the run; equal samples and an equal outcome
//! give equal bytes; no date and no path of a file is written but those in the scenario's own text.
//! The contract with the page's script is sim/report/DATA.md.

mod blocks;
pub(crate) mod campaign;
mod curve_data;
mod data;
mod draw;
mod error;
pub(crate) mod fit;
mod health;
pub(crate) mod identify;
pub(crate) mod jitter;
pub(crate) mod margins;
pub(crate) mod montecarlo;
mod number;
mod page;
mod run;
pub(crate) mod sweep;
#[cfg(test)]
mod tests;
mod unit;
pub(crate) mod watch;

pub use draw::cells;
pub(crate) use draw::picture::Picture;
pub(crate) use draw::{mode_shapes, response, spectrum};
pub use error::{DrawError, ReportError};
pub(crate) use health::rate_curves;

use run::chart::{Chart, ScaledChart, drawn};
use run::extremes::{Extremes, Magnitude};
use run::limits::{limits, stated_unit};
use run::replay::Collector;
use run::settling::Settling;
use run::{grouping, summary};

use crate::pointing::RequirementState;
use crate::record::columns::Quantity;
use crate::record::{Decimate, Header, Outcome, RecordError, Recorder, Statistics, Verdict};
use crate::scenario::Scenario;

/// Bytes of a page for the histories in its data block; with script, replay and figures a page of
/// four double-gimbal devices is below 1.5 MB.
const HISTORY_BYTES: usize = 436_000;
/// Bytes of a bucket of one curve: three single-precision numbers, four characters for three bytes.
const BUCKET_BYTES: usize = 16;
/// Fewest and most buckets.
const BUCKETS: [usize; 2] = [120, 1600];

/// Collects what the page of one run shows.
pub struct Report {
    scenario: Scenario,
    warnings: Vec<String>,
    statistics: Statistics,
    collected: Option<Collected>,
}

/// What is known once the columns are.
struct Collected {
    header: Header,
    charts: Vec<Chart>,
    ledger: Option<Ledger>,
    history: Decimate,
    /// A sample and, last, energy less work.
    row: Vec<f64>,
    first: Vec<f64>,
    /// Of each column.
    extremes: Vec<Extremes>,
    /// Of the hub's angular velocity.
    omega: Option<Magnitude>,
    /// Of each controller.
    settling: Vec<Settling>,
    replay: Option<Collector>,
}

/// The columns of the energy ledger.
#[derive(Clone, Copy, Debug)]
struct Ledger {
    energy: usize,
    work: usize,
    lost: Option<usize>,
}

impl Report {
    /// The report of a scenario's run; `warnings` are shown as they are.
    #[must_use]
    pub fn new(scenario: &Scenario, warnings: &[String]) -> Self {
        Self {
            scenario: scenario.clone(),
            warnings: warnings.to_vec(),
            statistics: Statistics::new(&scenario.requirements),
            collected: None,
        }
    }

    /// Adds a warning that only the run could give.
    pub fn warn(&mut self, warning: String) {
        self.warnings.push(warning);
    }

    /// The page as one HTML file.
    ///
    /// # Errors
    ///
    /// [`ReportError`] if a figure or the template fails, which is a fault of the program.
    pub fn html(&self, outcome: &Outcome) -> Result<String, ReportError> {
        page::page(self, outcome)
    }

    /// The figures in the order of the page: a name for a file, and the text of the SVG file.
    ///
    /// # Errors
    ///
    /// [`ReportError`] if a figure cannot be drawn, which is a fault of the program.
    pub fn figures(&self) -> Result<Vec<(String, String)>, ReportError> {
        let file = |drawn: &ScaledChart| Ok((drawn.slug.clone(), drawn.figure().file()?));
        self.drawn().iter().map(file).collect()
    }

    /// A summary of at most ten lines for the terminal; `files` are listed as they are.
    #[must_use]
    pub fn summary(&self, outcome: &Outcome, files: &[String]) -> String {
        summary::terminal(self, outcome, files)
    }

    /// One verdict for each requirement of the scenario in order, once the run has ended.
    #[must_use]
    pub fn verdicts(&self) -> &[Verdict] {
        self.statistics.verdicts()
    }

    /// The charts with their values; those that are zero throughout included.
    fn drawn(&self) -> Vec<ScaledChart> {
        let Some(collected) = &self.collected else { return Vec::new() };
        let buckets = collected.history.buckets();
        let [first, last] = [&collected.first, &collected.row];
        let stated = (self.scenario.requirements.as_slice(), &collected.header);
        let scaled = |chart| {
            let mut drawn = drawn(chart, buckets, [first, last], stated_unit(chart, stated));
            drawn.limits = limits((chart, &drawn), stated, first);
            drawn
        };
        collected.charts.iter().map(scaled).filter(|drawn| !drawn.is_zero()).collect()
    }

    /// Titles of the charts whose curves are zero throughout, which are not drawn.
    fn zero_charts(&self) -> Vec<String> {
        let Some(collected) = &self.collected else { return Vec::new() };
        let buckets = collected.history.buckets();
        let [first, last] = [&collected.first, &collected.row];
        let drawn = |chart| drawn(chart, buckets, [first, last], None);
        let charts = collected.charts.iter().map(drawn);
        charts.filter(ScaledChart::is_zero).map(|drawn| drawn.title).collect()
    }
}

/// The state of a row of a table: one that is not evaluated has no colour.
fn row_state(state: &RequirementState) -> &'static str {
    if state.reason().is_some() { "" } else { state.word() }
}

impl Recorder for Report {
    fn begin(&mut self, header: &Header) -> Result<(), RecordError> {
        self.statistics.begin(header)?;
        self.collected = Some(Collected::new(header, &self.scenario));
        Ok(())
    }

    fn sample(&mut self, row: &[f64]) -> Result<(), RecordError> {
        self.statistics.sample(row)?;
        match &mut self.collected {
            Some(collected) => collected.sample(row),
            None => Ok(()),
        }
    }

    fn finish(&mut self, outcome: &Outcome) -> Result<(), RecordError> {
        self.statistics.finish(outcome)?;
        if let Some(collected) = &mut self.collected {
            collected.history.finish(outcome)?;
        }
        Ok(())
    }
}

impl Collected {
    fn new(header: &Header, scenario: &Scenario) -> Self {
        let index = |quantity: Quantity| {
            header.columns.iter().position(|column| column.quantity == quantity)
        };
        let ledger = match (index(Quantity::Energy), index(Quantity::Work)) {
            (Some(energy), Some(work)) => {
                Some(Ledger { energy, work, lost: index(Quantity::Lost) })
            }
            _ => None,
        };
        let charts = grouping::charts(header, scenario, ledger.is_some());
        let curves: usize = charts.iter().map(|chart| chart.curves.len()).sum();
        let [fewest, most] = BUCKETS;
        let buckets = HISTORY_BYTES / (BUCKET_BYTES * curves.max(1));
        let omega: Option<Vec<usize>> = (0..3).map(|axis| index(Quantity::Omega(axis))).collect();
        Self {
            history: Decimate::new(buckets.clamp(fewest, most)),
            charts,
            ledger,
            row: Vec::new(),
            first: Vec::new(),
            extremes: vec![Extremes::default(); header.columns.len()],
            omega: omega.map(Magnitude::new),
            settling: Settling::all(header, scenario),
            replay: Collector::new(header, scenario),
            header: header.clone(),
        }
    }

    fn sample(&mut self, row: &[f64]) -> Result<(), RecordError> {
        let expected = self.header.columns.len();
        if row.len() != expected {
            return Err(RecordError::Row { expected, found: row.len() });
        }
        let time = row.first().copied().unwrap_or_default();
        self.row.clear();
        self.row.extend_from_slice(row);
        if let Some(Ledger { energy, work, lost }) = self.ledger {
            let lost = lost.map_or(0.0, |lost| row[lost]);
            self.row.push(row[energy] + lost - row[work]);
        }
        if self.first.is_empty() {
            self.first.clone_from(&self.row);
        }
        self.extremes.iter_mut().zip(row).for_each(|(extremes, value)| extremes.add(time, *value));
        if let Some(omega) = &mut self.omega {
            omega.add(time, row);
        }
        self.settling.iter_mut().for_each(|of| of.add(time, row));
        if let Some(replay) = &mut self.replay {
            replay.add(row);
        }
        self.history.sample(&self.row)
    }
}
