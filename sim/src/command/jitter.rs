//! `jitter`: a budget into a verdict: lines of rotors over the speed through the structure to the lines of sight, against
//! their limits, with a report.

mod csv;
mod summary;

use std::fmt::Write as _;
use std::path::PathBuf;
use std::sync::Mutex;

use clap::Args;

use super::error::CommandError;
use super::exit::Exit;
use super::options::{Threads, as_toml};
use super::outputs::Outputs;
use super::progress::{end_by_interrupts, end_if_interrupted, progress_bar, uninterrupted};
use super::terminal::{note, print};
use crate::file::{Override, budget_from_toml, budget_overrides, check_budget_names, from_file};
use crate::jitter::budget::{Assessed, Budget};
use crate::jitter::campbell::{Branch, Crossing, oscillations};
use crate::jitter::coupled::{Compared, compare};
use crate::jitter::model::Contributor;
use crate::jitter::noise::NoiseSweep;
use crate::jitter::own_speeds::AtOwnSpeeds;
use crate::jitter::prepared::{PrepareError, Prepared};
use crate::jitter::sensitivity::{Sensitivity, sensitivities};
use crate::jitter::sweep::{Sweep, parts, sweep};
use crate::margins::MarginsError;
use crate::margins::analysis::chosen;
use crate::margins::closed_sweep::close;
use crate::margins::notes::notes;
use crate::pointing::RequirementState;
use crate::report::jitter::{JitterReport, disagreements, rpm};
use crate::scenario::Scenario;
use crate::structure::Fault;
use csv::{keep_out_csv, lines_csv, own_speeds_csv, requirements_csv};
use summary::summary;

pub(super) const HELP: &str = "\
Examples:
  precess jitter scenarios/budgets/imaging-satellite-jitter.toml
      verdict, margins and a report into the folder precess-out
  precess jitter budget.toml --set budget.phases=worst --set hub.mass='900 kg'
      keys of the budget have the prefix budget., others are of the scenario
  precess jitter budget.toml --compare '3000 rpm' --compare '4200 rpm'
      beside it, runs of the coupled equations at two speeds
  precess jitter scenarios/budgets/aliased-wheel-jitter.toml --controller aocs
      with the loop of a controller closed, aliased lines among the others";

/// Why there is no run of the coupled equations beside a budget.
const NOT_COMPARED: &str =
    "runs of the coupled equations are without sources, and no rotor is out of balance";

/// A line this near to a natural frequency, of its damping ratio, is at resonance.
const RESONANCE: f64 = 20.0;

/// The options of `jitter`.
#[derive(Debug, Args)]
pub(super) struct Jitter {
    /// The budget file.
    #[arg(value_name = "BUDGET")]
    file: PathBuf,
    /// Replace a key of the scenario, hub.mass="900 kg", or of the budget, budget.speed.count=100; may be repeated. A
    /// value that is no TOML is taken as text.
    #[arg(long = "set", value_name = "KEY=VALUE")]
    set: Vec<String>,
    /// Folder for the results; made if it is missing.
    #[arg(long, value_name = "FOLDER", default_value = "precess-out")]
    out: PathBuf,
    /// Replace results that are there.
    #[arg(long)]
    force: bool,
    #[command(flatten)]
    threads: Threads,
    /// A speed with its unit at which the coupled equations are run beside; may be repeated. The worst speed of each
    /// requirement without this option.
    #[arg(long, value_name = "SPEED", value_parser = speed)]
    compare: Vec<f64>,
    /// Close the loop of a controller of the scenario: lines and noise through it, with their aliases, and noise of its sensors; without coupled runs and sensitivities.
    #[arg(long, value_name = "NAME", conflicts_with = "compare")]
    controller: Option<String>,
    /// Run the coupled equations at no speed.
    #[arg(long, conflicts_with = "compare")]
    no_compare: bool,
}

/// Overrides of the budget, and those of the scenario.
fn by_file(set: &[String]) -> Result<[Vec<Override>; 2], CommandError> {
    let found = budget_overrides(set);
    let found = found.map_err(|message| CommandError::Other(format!("--set {message}")))?;
    Ok(found.map(|of| of.iter().map(|text| as_toml(text)).collect()))
}

/// A speed with its unit, rad/s.
fn speed(text: &str) -> Result<f64, String> {
    use crate::units::{Measure, parse_quantity};
    let example = "write a number and a unit: \"3000 rpm\"";
    let quantity = parse_quantity(text).map_err(|error| format!("{}; {example}", error.kind))?;
    match quantity.values[..] {
        [value] if quantity.is(Measure::ANGULAR_RATE) && value > 0.0 => Ok(value),
        _ => Err(format!("`{text}` is no speed above zero; {example}")),
    }
}

/// Everything that is computed.
struct JitterResults {
    sweep: Sweep,
    /// The parts of the noise with a loop closed.
    noise: Option<[NoiseSweep; 3]>,
    assessed: Vec<Assessed>,
    /// The same with each rotor at its own speed.
    at_own_speeds: Result<Vec<AtOwnSpeeds>, Fault>,
    campbell_speeds: Vec<f64>,
    branches: Vec<Branch>,
    crossings: Vec<Crossing>,
    compared: Vec<(Compared, bool)>,
    has_imbalance: bool,
    /// Of each requirement.
    sensitivities: Vec<Vec<Sensitivity>>,
}

impl JitterResults {
    /// What is known of the rotors at their own speeds; empty where it is not.
    fn own(&self) -> &[AtOwnSpeeds] {
        self.at_own_speeds.as_deref().unwrap_or_default()
    }
}

impl Jitter {
    pub(super) fn execute(&self) -> Result<Exit, CommandError> {
        end_by_interrupts();
        let [of_budget, of_scenario] = by_file(&self.set)?;
        let (budget, path) =
            budget_from_toml(&self.file, &of_budget).map_err(CommandError::Scenario)?;
        let (scenario, reports) = from_file(&path, &of_scenario).map_err(CommandError::Scenario)?;
        check_budget_names(&self.file, &of_budget, &scenario).map_err(CommandError::Scenario)?;
        let stem = self.file.file_stem().map_or_else(String::new, |s| s.to_string_lossy().into());
        // Before the work, too; not kept, since an interrupt during the work would leave it.
        let page = [format!("{stem}.html")];
        uninterrupted(|| Outputs::reserve(&self.out, &page, self.force).map(drop))?;
        end_if_interrupted();
        let prepared = Prepared::new(&scenario, &budget).map_err(|error| match error {
            PrepareError::Rotor { .. } => CommandError::Other(error.to_string()),
            PrepareError::Model(error) => {
                CommandError::Other(format!("{}: {error}", scenario.name))
            }
        })?;
        let mut warnings: Vec<String> =
            reports.all.iter().map(|warning| warning.message.clone()).collect();
        warnings.extend(prepared.left_out.iter().cloned());
        warnings.extend(prepared.warnings_at_rest(&budget));
        warnings.extend(self.compared_outside(&budget));
        if !prepared.has_imbalance && !self.compare.is_empty() {
            warnings.push(format!("--compare: {NOT_COMPARED}"));
        }
        for warning in &warnings {
            note(&format!("warning: {warning}"));
        }
        let rotors = prepared.rotors(&budget);
        let found = self.find(&scenario, &budget, prepared, &mut warnings)?;
        let at_resonance = found.at_own_speeds.as_ref().err().map(|fault| {
            format!("nothing is known of the rotors at the speeds of the scenario: {fault}")
        });
        for text in at_resonance.into_iter().chain(disagreements(&found.compared)) {
            note(&format!("warning: {text}"));
            warnings.push(text);
        }
        let mut text = std::fs::read_to_string(&self.file)
            .map_err(|source| CommandError::Io { path: self.file.clone(), source })?;
        for set in &self.set {
            let _ = write!(text, "\n# --set {set}");
        }
        let report = JitterReport {
            scenario: &scenario,
            budget: &budget,
            text: &text,
            sweep: &found.sweep,
            rotors: &rotors,
            assessed: &found.assessed,
            at_own_speeds: found.own(),
            campbell_speeds: &found.campbell_speeds,
            branches: &found.branches,
            crossings: &found.crossings,
            compared: &found.compared,
            has_imbalance: found.has_imbalance,
            sensitivities: &found.sensitivities,
            controller: self.controller.as_deref(),
            warnings: &warnings,
        };
        let other = |error: &dyn std::fmt::Display| CommandError::Other(error.to_string());
        let mut files = vec![
            (format!("{stem}.html"), report.html().map_err(|error| other(&error))?),
            (format!("{stem}-lines.csv"), lines_csv(&found.sweep)),
            (format!("{stem}-requirements.csv"), requirements_csv(&found)),
            (format!("{stem}-scenario.csv"), own_speeds_csv(&budget, &found)),
            (format!("{stem}-keep-out.csv"), keep_out_csv(&found)),
        ];
        for (name, svg) in report.figures().map_err(|error| other(&error))? {
            files.push((format!("{stem}-{name}.svg"), svg));
        }
        uninterrupted(|| Outputs::reserve(&self.out, &[], self.force)?.write(&files))?;
        print(&summary(&budget, &found))?;
        let folder = self.out.display();
        if found.assessed.iter().any(|of| !of.keep_out.is_empty()) {
            print(&format!(
                "speeds to keep out of: {folder}/{stem}-keep-out.csv; a controller's wheels leave them by allocation.keep_out = {{ file = \"..\" }}\n"
            ))?;
        }
        print(&format!("files: {folder}/{stem}.html and {} more\n", files.len() - 1))?;
        let states: Vec<RequirementState> = found.assessed.iter().map(Assessed::state).collect();
        Ok(Exit::of_states(&states))
    }

    /// Speeds of `--compare` that are not among those of the budget.
    fn compared_outside(&self, budget: &Budget) -> Vec<String> {
        let [from, to] = budget.speeds;
        let outside = self.compare.iter().filter(|speed| !(from..=to).contains(*speed));
        let text = |speed: &f64| {
            format!(
                "{} is not within the speeds of the budget, {} to {}; it is compared, and counts in no verdict",
                rpm(*speed),
                rpm(from),
                rpm(to)
            )
        };
        outside.map(text).collect()
    }

    fn find(
        &self,
        scenario: &Scenario,
        budget: &Budget,
        prepared: Prepared,
        warnings: &mut Vec<String>,
    ) -> Result<JitterResults, CommandError> {
        let other = |error: &dyn std::fmt::Display| {
            CommandError::Other(format!("{}: {error}", scenario.name))
        };
        let Prepared { model, has_imbalance, campbell_speeds, branches, crossings, speeds, .. } =
            prepared;
        let threads = self.threads.count();
        let bar = Mutex::new(progress_bar(parts(&model, &speeds), "speeds"));
        let show = |done: usize| {
            if let Ok(bar) = bar.lock() {
                bar.set_position(u64::try_from(done).unwrap_or(u64::MAX));
            }
        };
        let mut found = sweep(&model, &speeds, threads, &show).map_err(|error| other(&error))?;
        if let Ok(bar) = bar.lock() {
            bar.finish_and_clear();
        }
        let mut noise = None;
        if let Some(name) = &self.controller {
            let (texts, parts) = closed(scenario, budget, name, &mut found)?;
            noise = Some(parts);
            for text in texts {
                note(&format!("warning: {text}"));
                warnings.push(text);
            }
        }
        let assessed = budget.assess(&found).map_err(|error| other(&error))?;
        // Rows of one speed each are open loop.
        let at_own_speeds = match &self.controller {
            None => budget.at_own_speeds(scenario),
            Some(_) => Ok(Vec::new()),
        };
        // The runs are without sources: without imbalance nothing moves in them.
        let mut at: Vec<f64> = if has_imbalance { self.compare.clone() } else { Vec::new() };
        if at.is_empty() && !self.no_compare && has_imbalance && self.controller.is_none() {
            let evaluated = assessed.iter().filter(|of| of.no_data.is_none());
            at = evaluated.filter_map(|of| found.speeds.get(of.worst).copied()).collect();
            at.sort_by(f64::total_cmp);
            at.dedup();
        }
        let mut compared = Vec::new();
        let bar = progress_bar(at.len(), "coupled runs");
        for speed in at {
            let of = compare(scenario, budget, speed).map_err(|error| other(&error))?;
            let natural = oscillations(&model, speed).map_err(|error| other(&error))?;
            let resonant = of.lines.iter().any(|(frequency, _)| {
                natural.iter().any(|natural| {
                    let apart = (frequency / natural.frequency - 1.0).abs();
                    apart < RESONANCE * natural.damping
                })
            });
            compared.push((of, resonant));
            bar.inc(1);
        }
        bar.finish_and_clear();
        let name = |of: &Contributor| format!("{} ({}, order {})", of.rotor, of.cause, of.order);
        let names: Vec<String> = found.contributors.iter().map(name).collect();
        let ranked: Result<Vec<_>, _> = assessed
            .iter()
            .filter(|_| self.controller.is_none())
            .map(|of| {
                let speed = found.speeds.get(of.worst).copied().unwrap_or(0.0);
                sensitivities(&model, budget, of, speed, &names)
            })
            .collect();
        Ok(JitterResults {
            sensitivities: ranked.map_err(|error| other(&error))?,
            sweep: found,
            noise,
            assessed,
            at_own_speeds,
            campbell_speeds,
            branches,
            crossings,
            compared,
            has_imbalance,
        })
    }
}

/// Closes the loop of a controller; what is to be said of it, and the parts of the noise.
fn closed(
    scenario: &Scenario,
    budget: &Budget,
    name: &str,
    found: &mut Sweep,
) -> Result<(Vec<String>, [NoiseSweep; 3]), CommandError> {
    let other = |error: MarginsError| CommandError::Other(format!("{}: {error}", scenario.name));
    let of = chosen(scenario, Some(name)).map_err(other)?;
    let bar = progress_bar(found.speeds.len(), "speeds of the loop");
    let show = |done: usize| bar.set_position(u64::try_from(done).unwrap_or(u64::MAX));
    let closed = close(scenario, of, budget, found, &show).map_err(other)?;
    bar.finish_and_clear();
    let mut texts: Vec<String> =
        notes(scenario, of).into_iter().map(|text| format!("loop of `{name}`: {text}")).collect();
    if let Some(first) = closed.unstable.first() {
        texts.push(format!(
            "the loop of `{name}` is not stable at {} speeds, from {} on",
            closed.unstable.len(),
            rpm(*first)
        ));
    }
    Ok((texts, closed.noise))
}
