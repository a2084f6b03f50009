//! What campaigns have in common: options, the scenario, the journal, threads, a progress bar.

mod advised;
mod backend;
pub(super) mod montecarlo;
pub(super) mod sweep;

use std::cell::OnceCell;
use std::fmt::Write as _;
use std::path::PathBuf;
use std::sync::Mutex;

use clap::Args;

use self::advised::advised;
use super::error::CommandError;
use super::exit::Exit;
use super::options::{Set, Threads};
use super::outputs::Outputs;
use super::plot::time;
use super::progress::{interrupted, progress_bar, watch_interrupts};
use super::table::six;
use super::terminal::note;
use crate::campaign::{
    CampaignError, Execution, Field, Finished, Journal, Plan, Selection, digits, execute, table,
};
use crate::engine::Gpu;
use crate::file::{Override, PlanPlaces, Template};
use crate::pointing::RequirementState;
use crate::record::no_data::no_data;
use crate::record::{Columns, Header};
use crate::report::campaign::CampaignTable;
use crate::scenario::Scenario;
use crate::spectra::float;

/// Samples that are read in search of one that can be.
const TRIED: usize = 16;

/// The options of every campaign.
#[derive(Debug, Args)]
pub(super) struct CampaignOptions {
    /// The scenario file.
    #[arg(value_name = "SCENARIO")]
    file: PathBuf,
    #[command(flatten)]
    overrides: Set,
    /// A column, or a vector such as omega, of which RMS, peak and lines are computed; may be repeated. Omega without it.
    #[arg(long, value_name = "NAME")]
    column: Vec<String>,
    /// The strongest lines of each column, to 64; 0 computes no spectra.
    #[arg(long, value_name = "N", default_value_t = 6, value_parser = clap::value_parser!(u8).range(0..=64))]
    lines: u8,
    /// RMS, peak and lines are of the time from this on, with its unit.
    #[arg(long, value_name = "TIME", value_parser = time)]
    from: Option<f64>,
    /// Folder for the results; made if it is missing.
    #[arg(long, value_name = "FOLDER", default_value = "precess-out")]
    out: PathBuf,
    /// Replace results that are there, and discard the journal of another campaign.
    #[arg(long)]
    force: bool,
    /// Write no page.
    #[arg(long)]
    no_report: bool,
    #[command(flatten)]
    threads: Threads,
}

/// A scenario and what is recorded of it.
pub(super) struct Prepared {
    pub(super) template: Template,
    pub(super) overrides: Vec<Override>,
    /// The scenario without a sample's overrides.
    pub(super) scenario: Scenario,
    pub(super) selection: Selection,
    pub(super) fields: Vec<Field>,
    /// Where the steps are made, if not by the processor.
    pub(super) gpu: Option<Gpu>,
    advised: OnceCell<Vec<String>>,
}

impl Prepared {
    /// What the samples of the plan that was run first would be warned of as runs of their own.
    fn advised(&self, plan: &Plan) -> &[String] {
        self.advised.get_or_init(|| advised(self, plan))
    }

    /// What every run of the campaign has, for a page.
    pub(super) fn facts(&self) -> Vec<(&'static str, String)> {
        let duration = format!("{}\u{a0}s", six(self.scenario.settings.duration));
        let mut facts = vec![("Duration of a run", duration)];
        facts.extend(self.overrides.iter().map(|set| ("Override", set.clone())));
        facts
    }
}

impl CampaignOptions {
    /// Reads the scenario.
    pub(super) fn prepare(&self) -> Result<Prepared, CommandError> {
        let template = Template::from_file(&self.file).map_err(CommandError::Scenario)?;
        let overrides = self.overrides.overrides();
        let (mut scenario, reports) =
            template.scenario(&overrides).map_err(CommandError::Scenario)?;
        for warning in &reports.all {
            note(&format!("warning: {}", warning.message));
        }
        let columns =
            if self.column.is_empty() { vec!["omega".to_owned()] } else { self.column.clone() };
        scenario.output.columns.clone_from(&columns);
        let selection =
            Selection { columns, lines: usize::from(self.lines), from: self.from.unwrap_or(0.0) };
        let header = Header::new(&scenario, &Columns::from_scenario(&scenario)?);
        for name in &selection.columns {
            header.quantity(name)?;
        }
        if selection.from >= scenario.settings.duration {
            let message = format!(
                "--from {} s is not within the run of {} s; choose an earlier time",
                selection.from, scenario.settings.duration
            );
            return Err(CommandError::Other(message));
        }
        let fields = selection.fields(&header, &scenario.requirements);
        let advised = OnceCell::new();
        Ok(Prepared { template, overrides, scenario, selection, fields, gpu: None, advised })
    }

    /// Reserves the results, and rejects those that are there. Beside a journal it is the table that counts: it is written
    /// last, so without it the other files are of a campaign that was ended while it wrote them.
    pub(super) fn reserve(&self, stem: &str, names: &[String]) -> Result<Outputs, CommandError> {
        let table = [format!("{stem}.csv")];
        let mut outputs = Outputs::reserve(&self.out, &table, self.force)?;
        if self.out.join(format!("{stem}.journal")).is_file() {
            outputs.replace();
        }
        outputs.add(names)?;
        // Once, though a campaign may have two sets of runs: a second handler would count a SIGTERM twice.
        watch_interrupts();
        Ok(outputs)
    }

    /// The files of every campaign's result.
    fn names(&self, stem: &str) -> Vec<String> {
        let page = (!self.no_report).then_some("html");
        ["csv", "npz"].into_iter().chain(page).map(|ending| format!("{stem}.{ending}")).collect()
    }

    /// Where the result is, with so many texts beside both tables: for the terminal.
    fn files(&self, stem: &str, texts: usize) -> String {
        let first = if self.no_report { "csv" } else { "html" };
        format!("files: {}/{stem}.{first} and {} more\n", self.out.display(), texts + 1)
    }

    /// Runs a plan, with its journal `STEM.journal`; none where Ctrl-C ended it.
    pub(super) fn run(
        &self,
        prepared: &Prepared,
        (plan, places): (&Plan, Option<&PlanPlaces>),
        stem: &str,
    ) -> Result<Option<Finished>, CommandError> {
        let other = |error: CampaignError| CommandError::Other(error.to_string());
        readable(prepared, plan, places)?;
        // Of the campaign's own plan: that of derivatives is about one sample.
        if prepared.advised.get().is_none() {
            for warning in prepared.advised(plan) {
                note(&format!("warning: {warning}"));
            }
        }
        let path = self.out.join(format!("{stem}.journal"));
        let digest = plan.digest(&prepared.scenario, &prepared.selection);
        let opened =
            Journal::open(&path, &digest, prepared.fields.len(), self.force).map_err(other)?;
        let threads = self.threads.count();
        let bar = Mutex::new(progress_bar(plan.samples.len(), "samples"));
        let show = |done: usize| {
            if let Ok(bar) = bar.lock() {
                bar.set_position(u64::try_from(done).unwrap_or(u64::MAX));
            }
        };
        let execution = Execution {
            template: &prepared.template,
            overrides: &prepared.overrides,
            plan,
            selection: &prepared.selection,
            fields: prepared.fields.len(),
            threads,
            gpu: prepared.gpu.as_ref(),
        };
        let finished = execute(&execution, opened, &show, &interrupted);
        let finished = finished.map_err(|error| other(error).leaving(vec![path.clone()]))?;
        if let Ok(bar) = bar.lock() {
            bar.finish_and_clear();
        }
        if !finished.is_complete() {
            let done = finished.rows.iter().flatten().count();
            note(&format!(
                "{done} of {} samples are complete, in {}; the same command continues with the others",
                plan.samples.len(),
                path.display()
            ));
            return Ok(None);
        }
        Ok(Some(finished))
    }

    /// Writes some texts by their names, then the tables `STEM.npz` and `STEM.csv`.
    pub(super) fn write(
        &self,
        prepared: &Prepared,
        plan: &Plan,
        finished: &Finished,
        (stem, texts): (&str, Vec<(String, String)>),
        outputs: &mut Outputs,
    ) -> Result<(), CommandError> {
        let head = format!(
            "precess {} {stem}\nscenario: {}, {}\nresults are in SI units, keys in their own",
            env!("CARGO_PKG_VERSION"),
            prepared.scenario.name,
            prepared.scenario.title,
        );
        let mut files: Vec<_> =
            texts.into_iter().map(|(name, text)| (name, text.into_bytes())).collect();
        let path = self.out.join(format!("{stem}.npz"));
        let archive = table::npz(&head, plan, &prepared.fields, finished)
            .map_err(|source| CommandError::Io { path: path.clone(), source })?;
        files.push((format!("{stem}.npz"), archive));
        let text = table::csv(&head, plan, &prepared.fields, finished);
        files.push((format!("{stem}.csv"), text));
        let journal = self.out.join(format!("{stem}.journal"));
        outputs.write(&files).map(drop).map_err(|error| error.leaving(vec![journal]))
    }
}

/// Reads the first samples until one can be: a key that there is not is an error of all of them.
fn readable(
    prepared: &Prepared,
    plan: &Plan,
    places: Option<&PlanPlaces>,
) -> Result<(), CommandError> {
    let mut first = None;
    let last = plan.samples.iter().enumerate().next_back();
    for (number, sample) in plan.samples.iter().enumerate().take(TRIED).chain(last) {
        let overrides = [&prepared.overrides[..], &sample.overrides].concat();
        match prepared.template.scenario(&overrides) {
            Ok(_) => return Ok(()),
            Err(errors) => {
                let of_sample = (number, &sample.overrides[..]);
                first.get_or_insert_with(|| {
                    prepared.template.sample_errors(errors, of_sample, places)
                });
            }
        }
    }
    first.map_or(Ok(()), |errors| Err(CommandError::Scenario(errors)))
}

/// The numbers of a field over the samples; none of a sample that failed or does not have it.
pub(super) fn values_of(finished: &Finished, field: usize) -> Vec<Option<f64>> {
    let value = |row: &crate::campaign::SampleResult| {
        let numbers = row.result.as_ref().ok()?;
        numbers.get(field).copied().filter(|value| !value.is_nan())
    };
    finished.rows.iter().map(|row| row.as_ref().and_then(value)).collect()
}

/// Samples that were run and do not have a number of a field; those that failed are not among them.
pub(super) fn without_number(finished: &Finished, field: usize) -> Vec<usize> {
    let rows = finished.rows.iter().flatten();
    let has_none = |row: &&crate::campaign::SampleResult| {
        let numbers = row.result.as_ref().ok();
        numbers.is_some_and(|numbers| numbers.get(field).is_none_or(|value| value.is_nan()))
    };
    rows.filter(has_none).map(|row| row.sample).collect()
}

/// Of each requirement that samples have no number for, a sentence with the reason of the first of them.
pub(super) fn not_evaluated(prepared: &Prepared, plan: &Plan, finished: &Finished) -> String {
    let mut text = String::new();
    for (index, of) in prepared.scenario.requirements.iter().enumerate() {
        let samples = without_number(finished, index);
        let Some(first) = samples.first() else { continue };
        let overrides = plan.samples.get(*first).map_or(&[][..], |sample| &sample.overrides);
        let overrides = [&prepared.overrides[..], overrides].concat();
        let read = prepared.template.scenario(&overrides).ok();
        let before_the_run = read.and_then(|(scenario, _)| {
            let requirement = scenario.requirements.get(index)?;
            no_data(requirement, scenario.output.rate, scenario.settings.duration)
        });
        let reason = before_the_run.map_or_else(
            || "its run ended before the end of the window".to_owned(),
            |reason| reason.to_string(),
        );
        let _ = writeln!(
            text,
            "requirement {} is not evaluated by {} of {} samples; of sample {first}: {reason}",
            of.name,
            samples.len(),
            plan.samples.len()
        );
    }
    text
}

/// A sentence about the samples that failed; empty if none did.
pub(super) fn failures(plan: &Plan, finished: &Finished) -> String {
    let mut failed = finished
        .rows
        .iter()
        .flatten()
        .filter_map(|row| row.result.as_ref().err().map(|error| (row.sample, error)));
    let Some((sample, error)) = failed.next() else { return String::new() };
    format!(
        "{} of {} samples failed; the first is sample {sample}, {}: {error}\n",
        1 + failed.count(),
        plan.samples.len(),
        plan.shown(sample)
    )
}

/// What became of the requirements, and the table of them and of the columns.
pub(super) struct Results {
    pub(super) states: Vec<(String, RequirementState)>,
    pub(super) table: CampaignTable,
}

/// What a terminal shows last: requirements that are not evaluated, samples that failed or were in the journal; and how the
/// command ends.
pub(super) fn ending(
    (prepared, plan, finished): (&Prepared, &Plan, &Finished),
    results: &Results,
) -> (String, Exit) {
    let mut exit = Exit::of_states(results.states.iter().map(|(_, state)| state));
    let mut text = not_evaluated(prepared, plan, finished);
    let failures = failures(plan, finished);
    if !failures.is_empty() {
        exit = exit.max(Exit::Violated);
    }
    text.push_str(&failures);
    if finished.resumed > 0 {
        let count = digits(float(finished.resumed));
        let _ = writeln!(text, "{count} samples were in the journal");
    }
    (text, exit)
}

/// What a page says beside the numbers: what samples would be warned of as runs, requirements that are not evaluated, samples that failed.
pub(super) fn warnings(prepared: &Prepared, plan: &Plan, finished: &Finished) -> Vec<String> {
    let text = not_evaluated(prepared, plan, finished) + &failures(plan, finished);
    prepared.advised(plan).iter().cloned().chain(text.lines().map(str::to_owned)).collect()
}

/// Name, place in a row, unit with its size, limit.
pub(super) type ResultColumn = (String, usize, (String, f64), Option<f64>);

/// What pictures and summary show: requirements, then RMS and peak of columns.
pub(super) fn shown(prepared: &Prepared) -> impl Iterator<Item = ResultColumn> {
    let requirements = &prepared.scenario.requirements;
    let count = requirements.len();
    let of_requirements = requirements.iter().enumerate().map(|(index, of)| {
        (format!("requirement {}", of.name), index, of.unit.clone(), Some(of.limit))
    });
    let fields = prepared.selection.columns.iter().enumerate().flat_map(move |(column, _)| {
        let rms = prepared.selection.rms_of(column, count);
        [rms, rms + 1]
    });
    let of_columns = fields.filter_map(|index| {
        let field = prepared.fields.get(index)?;
        Some((field.name.clone(), index, (field.unit.clone(), 1.0), None))
    });
    of_requirements.chain(of_columns)
}
