//! `montecarlo`: runs of a scenario whose keys are drawn from distributions: percentiles, probabilities, sensitivities.

use std::fmt::Write as _;
use std::path::PathBuf;

use clap::Args;

use super::{
    CampaignOptions, Prepared, ResultColumn, failures, not_evaluated, shown, values_of,
    without_number,
};
use crate::campaign::{
    Derivative, Estimate, Finished, Plan, SAMPLES_MAX, central_differences, derivatives, digits,
    draw, exact_derivatives, percentile, probability_between, regression, spearman, tangents,
};
use crate::command::error::CommandError;
use crate::command::exit::Exit;
use crate::command::progress::progress_bar;
use crate::command::table::{aligned, six};
use crate::command::terminal::print;
use crate::file::variations_from_toml;
use crate::names::file_names;
use crate::pointing::RequirementState;
use crate::report::montecarlo::distribution;
use crate::spectra::float;
use crate::variation::Variation;

pub(in crate::command) const HELP: &str = "\
Examples:
  precess montecarlo bus.toml --plan scenarios/plans/wheel-imbalance.toml --samples 300 --seed 1
      percentiles of statistics, probabilities of meeting requirements, rank correlations
  precess montecarlo bus.toml --plan plan.toml --samples 300 --latin-hypercube --sensitivities
      one sample in each equally probable part of every key; and derivatives about the middle of the plan

More samples keep the earlier ones (not of a Latin hypercube): raise --samples, add --force, and only the new
ones are run. A sample that failed violates every requirement.";

/// Percentiles that are estimated.
const PERCENTILES: [f64; 4] = [0.05, 0.5, 0.95, 0.99];
/// Probability with which intervals contain the true value.
const LEVEL: f64 = 0.95;

/// The options of `montecarlo`.
#[derive(Debug, Args)]
pub(in crate::command) struct MonteCarlo {
    #[command(flatten)]
    options: CampaignOptions,
    /// The plan: TOML with the keys and their distributions.
    #[arg(long, value_name = "PLAN")]
    plan: PathBuf,
    /// Samples.
    #[arg(long, value_name = "N", value_parser = samples)]
    samples: usize,
    /// Which samples are drawn.
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// One sample in each of N equally probable parts of every key.
    #[arg(long)]
    latin_hypercube: bool,
    /// Derivatives of every number by every key about the middle of each distribution: exact ones by a run over dual numbers,
    /// where the scenario can be run so, else central differences.
    #[arg(long)]
    sensitivities: bool,
}

fn samples(text: &str) -> Result<usize, String> {
    let count = text.parse().ok().filter(|count| (1..=SAMPLES_MAX).contains(count));
    count.ok_or_else(|| format!("`{text}` is not within 1 to {SAMPLES_MAX}"))
}

impl MonteCarlo {
    pub(in crate::command) fn execute(&self) -> Result<Exit, CommandError> {
        let other = |error: &dyn std::fmt::Display| CommandError::Other(error.to_string());
        let variations = variations_from_toml(&self.plan).map_err(CommandError::Scenario)?;
        let plan = draw(&variations, self.samples, self.seed, self.latin_hypercube)
            .map_err(|error| other(&error))?;
        let prepared = self.options.prepare()?;
        let stem = format!("{}-montecarlo", prepared.scenario.name);
        let beside = format!("{stem}-sensitivities");
        let mut names = vec![format!("{stem}.csv"), format!("{stem}.npz")];
        for part in ["percentiles", "correlations"] {
            names.push(format!("{stem}-{part}.csv"));
        }
        let pictures = file_names(shown(&prepared).map(|(name, ..)| name)).into_iter();
        let pictures: Vec<_> = pictures.map(|name| format!("{stem}-{name}.svg")).collect();
        names.extend(pictures.iter().cloned());
        if self.sensitivities {
            names.push(format!("{beside}.csv"));
        }
        let mut outputs = self.options.reserve(&stem, &names)?;
        let Some(finished) = self.options.run(&prepared, &plan, &stem)? else {
            return Ok(Exit::Violated);
        };
        let mut texts = Vec::new();
        for ((name, field, (unit, size), limit), file) in shown(&prepared).zip(pictures) {
            let sorted = sorted(&finished, field);
            let picture = distribution(&name, (&unit, size), &sorted, limit);
            texts.push((file, picture.map_err(|error| other(&error))?));
        }
        texts.push((format!("{stem}-percentiles.csv"), percentiles_csv(&prepared, &finished)));
        let correlations = correlations(&prepared, &plan, &finished);
        texts.push((format!("{stem}-correlations.csv"), correlations_csv(&correlations)));
        let mut found = Vec::new();
        if self.sensitivities {
            let Some(all) = self.derivatives(&prepared, &variations, &beside)? else {
                return Ok(Exit::Violated);
            };
            found = all;
            let planes = planes(&prepared, &plan, &finished);
            texts.push((format!("{beside}.csv"), derivatives_csv(&found, &planes)));
        }
        let count = texts.len() + 1;
        self.options.write(&prepared, &plan, &finished, (&stem, texts), &mut outputs)?;
        let (text, exit) = summary(&prepared, &plan, &finished, &correlations, &found);
        print(&text)?;
        let folder = self.options.out().display();
        print(&format!("files: {folder}/{stem}.csv and {count} more\n"))?;
        Ok(exit)
    }
}

/// Derivatives of each number, ranked.
type RankedDerivatives = Vec<(String, Vec<Derivative>)>;

impl MonteCarlo {
    /// Exact derivatives, and central differences of numbers that have none; none where Ctrl-C ended the runs of these.
    fn derivatives(
        &self,
        prepared: &Prepared,
        variations: &[Variation],
        beside: &str,
    ) -> Result<Option<RankedDerivatives>, CommandError> {
        let steps = central_differences(variations);
        if steps.samples.is_empty() {
            let message = "no key of the plan has a derivative; vary one continuously";
            return Err(CommandError::Other(message.to_owned()));
        }
        let bar = progress_bar(1, "exact derivatives");
        let exact =
            tangents(&prepared.template, &prepared.overrides, variations, &prepared.selection);
        bar.finish_and_clear();
        let slopes = match exact {
            Ok(found) => found.slopes,
            Err(reason) => {
                print(&format!("derivatives are central differences: {reason}\n"))?;
                Vec::new()
            }
        };
        let slope = |number: usize| slopes.get(number).and_then(Option::as_ref);
        let names: Vec<ResultColumn> = shown(prepared).collect();
        let mut differences = None;
        if (0..names.len()).any(|number| slope(number).is_none()) {
            let Some(finished) = self.options.run(prepared, &steps, beside)? else {
                return Ok(None);
            };
            differences = Some(finished);
        }
        let ranked = names.into_iter().enumerate().map(|(number, (name, field, ..))| {
            let of = match (slope(number), &differences) {
                (Some(slopes), _) => exact_derivatives(variations, slopes),
                (None, Some(finished)) => {
                    derivatives(variations, &steps, &values_of(finished, field))
                }
                (None, None) => Vec::new(),
            };
            (name, of)
        });
        Ok(Some(ranked.collect()))
    }
}

/// Of each number the slopes of a plane through the sample by key, with their standard errors.
type Planes = Vec<Option<Vec<(String, [f64; 2])>>>;

fn planes(prepared: &Prepared, plan: &Plan, finished: &Finished) -> Planes {
    let of = |(_, field, ..): ResultColumn| {
        let numbers = values_of(finished, field);
        let rows: Vec<(&[f64], f64)> = plan
            .samples
            .iter()
            .zip(&numbers)
            .filter_map(|(sample, number)| Some((sample.values.as_slice(), (*number)?)))
            .collect();
        let keys: Vec<Vec<f64>> = (0..plan.labels.len())
            .map(|key| rows.iter().filter_map(|(values, _)| values.get(key).copied()).collect())
            .collect();
        let numbers: Vec<f64> = rows.iter().map(|(_, number)| *number).collect();
        Some(plan.labels.iter().cloned().zip(regression(&keys, &numbers)?).collect())
    };
    shown(prepared).map(of).collect()
}

/// The numbers of a field, rising.
fn sorted(finished: &Finished, field: usize) -> Vec<f64> {
    let mut values: Vec<f64> = values_of(finished, field).into_iter().flatten().collect();
    values.sort_by(f64::total_cmp);
    values
}

/// How many samples meet a limit.
struct ComplianceCount {
    /// Samples that meet it.
    met: usize,
    /// Samples that were run and do not have the number, which neither meet it nor do not.
    not_evaluated: usize,
    /// The probability of meeting it. A sample that failed does not meet it. Where some are not evaluated there is no value,
    /// and the interval is from that with none of them meeting it to that with all of them.
    probability: Estimate,
}

fn meets(finished: &Finished, field: usize, limit: f64) -> Option<ComplianceCount> {
    let values = values_of(finished, field);
    let met = values.iter().filter(|value| value.is_some_and(|value| value <= limit)).count();
    let not_evaluated = without_number(finished, field).len();
    let probability = probability_between([met, met + not_evaluated], values.len(), LEVEL)?;
    Some(ComplianceCount { met, not_evaluated, probability })
}

/// Rank correlations of each number with each key.
type Correlations = Vec<(String, Vec<(String, Option<f64>)>)>;

fn correlations(prepared: &Prepared, plan: &Plan, finished: &Finished) -> Correlations {
    let of = |(name, field, ..): ResultColumn| {
        let numbers = values_of(finished, field);
        let by = plan.labels.iter().enumerate().map(|(key, label)| {
            let pairs = plan.samples.iter().zip(&numbers);
            let pairs =
                pairs.filter_map(|(sample, number)| Some((*sample.values.get(key)?, (*number)?)));
            let (x, y): (Vec<f64>, Vec<f64>) = pairs.unzip();
            (label.clone(), spearman(&x, &y))
        });
        (name, by.collect())
    };
    shown(prepared).map(of).collect()
}

fn cell(value: f64) -> String {
    if value.is_finite() { digits(value) } else { String::new() }
}

/// In SI; an end that the sample is too small for is empty.
fn percentiles_csv(prepared: &Prepared, finished: &Finished) -> String {
    let mut text = String::from("number,percentile,value_si,lower_si,upper_si\n");
    for (name, field, _, limit) in shown(prepared) {
        let sorted = sorted(finished, field);
        for share in PERCENTILES {
            let Some(found) = percentile(&sorted, share, LEVEL) else { continue };
            let [lower, upper] = found.interval.map(cell);
            let _ = writeln!(
                text,
                "{},{},{},{lower},{upper}",
                quoted(&name),
                100.0 * share,
                cell(found.value)
            );
        }
        let found = limit.and_then(|limit| meets(finished, field, limit));
        if let Some(ComplianceCount { probability: found, .. }) = found {
            let [lower, upper] = found.interval.map(cell);
            let _ = writeln!(
                text,
                "{},probability of meeting,{},{lower},{upper}",
                quoted(&name),
                cell(found.value)
            );
        }
    }
    text
}

fn correlations_csv(of: &Correlations) -> String {
    let mut text = String::from("number,key,rank_correlation\n");
    for (name, by) in of {
        for (key, value) in by {
            let value = value.map_or_else(String::new, cell);
            let _ = writeln!(text, "{},{},{value}", quoted(name), quoted(key));
        }
    }
    text
}

fn derivatives_csv(of: &[(String, Vec<Derivative>)], planes: &Planes) -> String {
    let mut text = String::from(
        "number,key,derivative_si_by_key_unit,times_deviation_si,method,sample_slope,sample_slope_error\n",
    );
    for ((name, by), plane) in of.iter().zip(planes) {
        for one in by {
            let (slope, size) = (cell(one.slope), cell(one.size()));
            let method = if one.exact { "exact" } else { "difference" };
            let known = plane.iter().flatten().find(|(label, _)| *label == one.label);
            let [sample, error] = known.map_or([f64::NAN; 2], |(_, found)| *found).map(cell);
            let _ = writeln!(
                text,
                "{},{},{slope},{size},{method},{sample},{error}",
                quoted(name),
                quoted(&one.label)
            );
        }
    }
    text
}

fn quoted(text: &str) -> String {
    if text.contains([',', '"']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}

/// For the terminal; and what became of the requirements.
fn summary(
    prepared: &Prepared,
    plan: &Plan,
    finished: &Finished,
    correlations: &Correlations,
    found: &[(String, Vec<Derivative>)],
) -> (String, Exit) {
    let mut text = format!("{}: {} samples\n", prepared.scenario.name, plan.samples.len());
    let mut rows = vec![
        ["", "median", "95 %", "its interval", "limit", "met by", "probability"]
            .map(str::to_owned)
            .to_vec(),
    ];
    let mut exit = Exit::Success;
    for (name, field, (unit, size), limit) in shown(prepared) {
        let sorted = sorted(finished, field);
        let at = |share| percentile(&sorted, share, LEVEL);
        let value = |value: f64| {
            if value.is_finite() { six(value / size) } else { "none".to_owned() }
        };
        let shown = |of: Option<Estimate>| {
            of.map_or_else(|| "none".to_owned(), |of| format!("{} {unit}", value(of.value)))
        };
        let high = at(0.95);
        let mut row = vec![name, shown(at(0.5)), shown(high)];
        row.push(high.map_or_else(String::new, |of| {
            format!("{} to {}", value(of.interval[0]), value(of.interval[1]))
        }));
        if let Some((limit, found)) =
            limit.and_then(|limit| Some((limit, meets(finished, field, limit)?)))
        {
            let state = RequirementState::from_numbers(&values_of(finished, field), limit);
            exit = exit.max(Exit::of_states([&state]));
            let of_all = format!("{} of {}", found.met, plan.samples.len());
            row.push(format!("{} {unit}", six(limit / size)));
            row.push(match found.not_evaluated {
                0 => of_all,
                some => format!("{of_all}, {some} not evaluated"),
            });
            let [lower, upper] = found.probability.interval;
            row.push(format!("{lower:.4} to {upper:.4}"));
        }
        rows.push(row);
    }
    text.push_str(&aligned(&rows));
    let _ = writeln!(text, "intervals contain the true value with at least {LEVEL}");
    for (name, by) in correlations {
        let mut by: Vec<_> = by.iter().filter_map(|(key, value)| Some((key, (*value)?))).collect();
        by.sort_by(|a, b| b.1.abs().total_cmp(&a.1.abs()));
        if let Some((key, value)) = by.first() {
            let _ = writeln!(text, "{name}: largest rank correlation {value:.3}, with {key}");
        }
    }
    for (name, by) in found {
        if let Some(one) = by.first() {
            let _ = writeln!(
                text,
                "{name}: largest derivative times deviation {}, by {}, {}",
                six(one.size()),
                one.label,
                if one.exact { "exact" } else { "a central difference" }
            );
        }
    }
    text.push_str(&not_evaluated(prepared, plan, finished));
    let failures = failures(plan, finished);
    if !failures.is_empty() {
        exit = exit.max(Exit::Violated);
    }
    text.push_str(&failures);
    if finished.resumed > 0 {
        let _ = writeln!(text, "{} samples were in the journal", digits(float(finished.resumed)));
    }
    (text, exit)
}
