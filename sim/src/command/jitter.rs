//! `jitter`: a budget into a verdict: lines of rotors over the speed through the structure to the lines of sight, against
//! their limits, with a report.

use std::fmt::Write as _;
use std::path::PathBuf;
use std::sync::Mutex;

use clap::Args;

use super::error::CommandError;
use super::exit::Exit;
use super::options::{Threads, as_toml};
use super::outputs::Outputs;
use super::progress::{end_by_interrupts, end_if_interrupted, progress_bar, uninterrupted};
use super::table::{aligned, six};
use super::terminal::{note, print};
use crate::file::{Override, budget_from_toml, budget_overrides, check_budget_names, from_file};
use crate::jitter::budget::{Assessed, Budget};
use crate::jitter::campbell::{Branch, Crossing, oscillations};
use crate::jitter::coupled::{Compared, compare};
use crate::jitter::model::Contributor;
use crate::jitter::prepared::{PrepareError, Prepared};
use crate::jitter::sensitivity::{Sensitivity, sensitivities};
use crate::jitter::sweep::{Sweep, parts, sweep};
use crate::names::column_heads;
use crate::pointing::RequirementState;
use crate::report::jitter::{
    AGREEMENT, JitterReport, disagreements, intervals, metric, rpm, worst_speed,
};
use crate::scenario::Scenario;

pub(super) const HELP: &str = "\
Examples:
  precess jitter scenarios/budgets/imaging-satellite-jitter.toml
      verdict, margins and a report into the folder precess-out
  precess jitter budget.toml --set budget.phases=worst --set hub.mass='900 kg'
      keys of the budget have the prefix budget., others are of the scenario
  precess jitter budget.toml --compare '3000 rpm' --compare '4200 rpm'
      beside it, runs of the coupled equations at two speeds";

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
    assessed: Vec<Assessed>,
    campbell_speeds: Vec<f64>,
    branches: Vec<Branch>,
    crossings: Vec<Crossing>,
    compared: Vec<(Compared, bool)>,
    has_imbalance: bool,
    /// Of each requirement.
    sensitivities: Vec<Vec<Sensitivity>>,
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
        warnings.extend(self.compared_outside(&budget));
        if !prepared.has_imbalance && !self.compare.is_empty() {
            warnings.push(format!("--compare: {NOT_COMPARED}"));
        }
        for warning in &warnings {
            note(&format!("warning: {warning}"));
        }
        let found = self.find(&scenario, &budget, prepared)?;
        for text in disagreements(&found.compared) {
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
            assessed: &found.assessed,
            campbell_speeds: &found.campbell_speeds,
            branches: &found.branches,
            crossings: &found.crossings,
            compared: &found.compared,
            has_imbalance: found.has_imbalance,
            sensitivities: &found.sensitivities,
            warnings: &warnings,
        };
        let other = |error: &dyn std::fmt::Display| CommandError::Other(error.to_string());
        let mut files = vec![
            (format!("{stem}.html"), report.html().map_err(|error| other(&error))?),
            (format!("{stem}-lines.csv"), lines_csv(&found.sweep)),
            (format!("{stem}-requirements.csv"), requirements_csv(&found)),
        ];
        for (name, svg) in report.figures().map_err(|error| other(&error))? {
            files.push((format!("{stem}-{name}.svg"), svg));
        }
        uninterrupted(|| Outputs::reserve(&self.out, &[], self.force)?.write(&files))?;
        print(&summary(&budget, &found))?;
        let folder = self.out.display();
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
        let found = sweep(&model, &speeds, threads, &show).map_err(|error| other(&error))?;
        if let Ok(bar) = bar.lock() {
            bar.finish_and_clear();
        }
        let assessed = budget.assess(&found).map_err(|error| other(&error))?;
        // The runs are without sources: without imbalance nothing moves in them.
        let mut at: Vec<f64> = if has_imbalance { self.compare.clone() } else { Vec::new() };
        if at.is_empty() && !self.no_compare && has_imbalance {
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
            .map(|of| {
                let speed = found.speeds.get(of.worst).copied().unwrap_or(0.0);
                sensitivities(&model, budget, of, speed, &names)
            })
            .collect();
        Ok(JitterResults {
            sensitivities: ranked.map_err(|error| other(&error))?,
            sweep: found,
            assessed,
            campbell_speeds,
            branches,
            crossings,
            compared,
            has_imbalance,
        })
    }
}

/// For the terminal: verdicts, worst speeds, agreement.
fn summary(budget: &Budget, found: &JitterResults) -> String {
    let mut rows = vec![
        ["requirement", "state", "worst", "limit", "margin dB", "at", "keep out of"]
            .map(str::to_owned)
            .to_vec(),
    ];
    for of in &found.assessed {
        let (unit, size) = &of.limit.unit;
        rows.push(vec![
            format!("{} ({})", of.limit.name, metric(&of.limit.metric)),
            match of.violated_by() {
                Some(by) => format!("{}, but {}", of.state().word(), by.excess()),
                None => of.state().word().to_owned(),
            },
        ]);
        let Some(row) = rows.last_mut() else { continue };
        if of.no_data.is_some() {
            row.extend([String::new(), format!("{} {unit}", six(of.limit.limit / size))]);
            row.extend(["", "", ""].map(str::to_owned));
            continue;
        }
        row.extend([
            format!("{} {unit}", six(of.margin.value / size)),
            format!("{} {unit}", six(of.limit.limit / size)),
            format!("{:.1}", of.margin.decibels()),
            worst_speed(&found.sweep.speeds, of.worst, of.is_flat()),
            intervals(&of.keep_out),
        ]);
    }
    let mut text = format!("{}\n", budget.title);
    if found.assessed.is_empty() {
        text.push_str("no requirements\n");
    } else {
        text.push_str(&aligned(&rows));
    }
    for of in &found.assessed {
        if let Some(reason) = &of.no_data {
            let _ = writeln!(text, "{}: not evaluated: {reason}", of.limit.name);
        }
    }
    for of in found.assessed.iter().filter(|of| of.no_data.is_none()) {
        let (unit, size) = &of.limit.unit;
        for other in of.by_phases.iter().skip(1) {
            let _ = writeln!(
                text,
                "{}: {} with {}, {} {unit}, margin {:.1} dB",
                of.limit.name,
                of.state_of(&other.margin).word(),
                other.phases.words(),
                six(other.margin.value / size),
                other.margin.decibels()
            );
        }
    }
    for of in &found.assessed {
        if let Some((index, share)) = of.shares.first()
            && let Some(contributor) = found.sweep.contributors.get(*index)
        {
            let _ = writeln!(
                text,
                "{}: largest contributor {} ({}, order {}), {:.0} % of the mean square",
                of.limit.name,
                contributor.rotor,
                contributor.cause,
                contributor.order,
                100.0 * share
            );
        }
    }
    for of in found.assessed.iter().filter(|of| of.noise > 0.0) {
        let _ = writeln!(
            text,
            "{}: broadband noise, {:.0} % of the mean square",
            of.limit.name,
            100.0 * of.noise
        );
    }
    for (of, resonant) in &found.compared {
        let bound = if *resonant { AGREEMENT[1] } else { AGREEMENT[0] };
        let difference = of.difference();
        let _ = writeln!(
            text,
            "coupled run at {}: amplitudes differ by {} % of the magnitudes of their tones at most, {} {} % {}",
            rpm(of.speed),
            six(100.0 * difference),
            if difference <= bound { "within" } else { "above" },
            100.0 * bound,
            if *resonant { "at resonance" } else { "off resonance" }
        );
    }
    if !found.has_imbalance {
        let _ = writeln!(text, "no coupled run: {NOT_COMPARED}");
    }
    text
}

/// A row for each speed and tone: amplitude and phase of each output.
fn lines_csv(sweep: &Sweep) -> String {
    let mut text = String::from("speed_rad_per_s,rotor,cause,order,frequency_hz");
    for name in column_heads(&sweep.outputs) {
        let _ = write!(text, ",{name}_re,{name}_im");
    }
    text.push('\n');
    let mut digits = zmij::Buffer::new();
    for (speed, lines) in sweep.speeds.iter().zip(&sweep.lines) {
        for line in lines {
            let Some(of) = sweep.contributors.get(line.contributor) else { continue };
            text.push_str(digits.format(*speed));
            let _ = write!(text, ",{},{}", of.rotor, of.cause.replace(',', " "));
            for value in [of.order, line.frequency / std::f64::consts::TAU] {
                text.push(',');
                text.push_str(digits.format(value));
            }
            for part in line.values.iter().flat_map(|value| [value.re, value.im]) {
                text.push(',');
                text.push_str(digits.format(part));
            }
            text.push('\n');
        }
    }
    text
}

/// A row for each speed: the metric of each requirement, SI.
fn requirements_csv(found: &JitterResults) -> String {
    let mut text = String::from("speed_rad_per_s");
    for name in column_heads(found.assessed.iter().map(|of| &of.limit.name)) {
        let _ = write!(text, ",{name}");
    }
    text.push('\n');
    let mut digits = zmij::Buffer::new();
    for (index, speed) in found.sweep.speeds.iter().enumerate() {
        text.push_str(digits.format(*speed));
        for of in &found.assessed {
            text.push(',');
            text.push_str(digits.format(of.values.get(index).copied().unwrap_or(f64::NAN)));
        }
        text.push('\n');
    }
    text
}
