//! `montecarlo`: runs of a scenario whose keys are drawn from distributions: percentiles, probabilities, sensitivities.

mod csv;
mod tables;

use std::fmt::Write as _;
use std::path::PathBuf;

use clap::Args;

use csv::{correlations_csv, derivatives_csv, percentiles_csv};
use tables::{correlation_table, derivative_table, percentile_table, results};

use super::backend::Backend;
use super::{
    CampaignOptions, Prepared, ResultColumn, Results, ending, shown, values_of, warnings,
    without_number,
};
use crate::campaign::{
    Derivative, Estimate, Finished, Plan, SAMPLES_MAX, by_chance, central_differences, derivatives,
    draw, exact_derivatives, probability_between, regression, spearman, tangents,
};
use crate::command::error::CommandError;
use crate::command::exit::Exit;
use crate::command::progress::progress_bar;
use crate::command::table::{aligned, six};
use crate::command::terminal::print;
use crate::file::{PlanPlaces, variations_from_toml};
use crate::names::file_names;
use crate::report::campaign::CampaignPage;
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
/// A probability below this is shown as being below.
const CHANCE_MIN: f64 = 1e-4;

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
    /// Derivatives of every number by every key about the middle of each distribution: exact ones of one run of fixed steps,
    /// where the scenario can be run so, else central differences.
    #[arg(long)]
    sensitivities: bool,
    /// What makes the steps: the processor, or a GPU of NVIDIA, with the same numbers (steps of fixed length only).
    #[arg(long, value_enum, default_value_t = Backend::Cpu)]
    backend: Backend,
}

fn samples(text: &str) -> Result<usize, String> {
    let count = text.parse().ok().filter(|count| (1..=SAMPLES_MAX).contains(count));
    count.ok_or_else(|| format!("`{text}` is not within 1 to {SAMPLES_MAX}"))
}

impl MonteCarlo {
    pub(in crate::command) fn execute(&self) -> Result<Exit, CommandError> {
        let other = |error: &dyn std::fmt::Display| CommandError::Other(error.to_string());
        let variations = variations_from_toml(&self.plan).map_err(CommandError::Scenario)?;
        // As it was read: it may change while samples are run.
        let text = std::fs::read_to_string(&self.plan)
            .map_err(|source| CommandError::Io { path: self.plan.clone(), source })?;
        let plan = draw(&variations, self.samples, self.seed, self.latin_hypercube)
            .map_err(|error| other(&error))?;
        let mut prepared = self.options.prepare()?;
        prepared.gpu = self.backend.gpu(&prepared)?;
        let places = PlanPlaces::from_toml(&self.plan);
        let stem = format!("{}-montecarlo", prepared.scenario.name);
        let beside = format!("{stem}-sensitivities");
        let mut names = self.options.names(&stem);
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
        let Some(finished) = self.options.run(&prepared, (&plan, places.as_ref()), &stem)? else {
            return Ok(Exit::Violated);
        };
        let mut texts = Vec::new();
        let mut drawn = Vec::new();
        for ((name, field, (unit, size), limit), file) in shown(&prepared).zip(pictures) {
            let sorted = sorted(&finished, field);
            let picture = distribution(&name, (&unit, size), &sorted, limit);
            texts.push((file, picture.file().map_err(|error| other(&error))?));
            drawn.push((format!("{name}: share of samples that do not exceed a value."), picture));
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
        let results = results(&prepared, &plan, &finished);
        let page = CampaignPage {
            subject: "Monte Carlo campaign",
            scenario: &prepared.scenario,
            states: &results.states,
            facts: self.facts(&prepared, &plan),
            tables: vec![
                results.table.clone(),
                percentile_table(&prepared, &finished),
                correlation_table(&correlations),
                derivative_table(&found),
            ],
            pictures: &drawn,
            warnings: warnings(&prepared, &plan, &finished),
            plan: Some(text),
        };
        if !self.options.no_report {
            texts.push((format!("{stem}.html"), page.html().map_err(|error| other(&error))?));
        }
        let files = self.options.files(&stem, texts.len());
        self.options.write(&prepared, &plan, &finished, (&stem, texts), &mut outputs)?;
        let (text, exit) = summary((&prepared, &plan, &finished), &results, &correlations, &found);
        print(&text)?;
        print(&files)?;
        Ok(exit)
    }
}

/// Derivatives of each number, ranked.
type RankedDerivatives = Vec<(String, Vec<Derivative>)>;

impl MonteCarlo {
    /// What was run.
    fn facts(&self, prepared: &Prepared, plan: &Plan) -> Vec<(&'static str, String)> {
        let drawn = if self.latin_hypercube { ", a Latin hypercube" } else { "" };
        vec![
            ("Samples", format!("{}{drawn}", plan.samples.len())),
            ("Seed", self.seed.to_string()),
            ("Keys that vary", plan.labels.len().to_string()),
        ]
        .into_iter()
        .chain(prepared.facts())
        .collect()
    }

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
            let places = PlanPlaces::from_toml(&self.plan);
            let Some(finished) = self.options.run(prepared, (&steps, places.as_ref()), beside)?
            else {
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

/// A rank correlation and what it is of.
#[derive(Clone, Copy)]
struct RankCorrelation {
    value: f64,
    /// Samples that have both numbers.
    pairs: usize,
    /// The probability of one as far from zero by chance; none of few samples.
    by_chance: Option<f64>,
}

impl RankCorrelation {
    fn of(x: &[f64], y: &[f64]) -> Option<Self> {
        let (value, pairs) = (spearman(x, y)?, x.len());
        Some(Self { value, pairs, by_chance: by_chance(value, pairs) })
    }

    /// Whether it is significant at 0.05, one of so many that are looked at together (Bonferroni); none of too few
    /// samples to judge.
    fn is_significant(&self, of: usize) -> Option<bool> {
        self.by_chance.map(|chance| chance * float(of) < 1.0 - LEVEL)
    }
}

/// Rank correlations of each number with each key.
type Correlations = Vec<(String, Vec<(String, Option<RankCorrelation>)>)>;

fn correlations(prepared: &Prepared, plan: &Plan, finished: &Finished) -> Correlations {
    let of = |(name, field, ..): ResultColumn| {
        let numbers = values_of(finished, field);
        let by = plan.labels.iter().enumerate().map(|(key, label)| {
            let pairs = plan.samples.iter().zip(&numbers);
            let pairs =
                pairs.filter_map(|(sample, number)| Some((*sample.values.get(key)?, (*number)?)));
            let (x, y): (Vec<f64>, Vec<f64>) = pairs.unzip();
            (label.clone(), RankCorrelation::of(&x, &y))
        });
        (name, by.collect())
    };
    shown(prepared).map(of).collect()
}

/// The largest rank correlation of a number, and whether none is significant: for the terminal.
fn largest_correlation(name: &str, by: &[(String, Option<RankCorrelation>)]) -> String {
    let known = by.iter().filter_map(|(key, found)| Some((key, (*found)?)));
    let largest = known.max_by(|a, b| a.1.value.abs().total_cmp(&b.1.value.abs()));
    let Some((key, found)) = largest else { return String::new() };
    let RankCorrelation { value, pairs, by_chance } = found;
    let chance = by_chance.map_or_else(
        || "too few to judge".to_owned(),
        |chance| {
            if chance < CHANCE_MIN {
                format!("p < {CHANCE_MIN}")
            } else {
                format!("p = {chance:.4}")
            }
        },
    );
    let which = match found.is_significant(by.len()) {
        Some(false) => "no rank correlation is significant at 0.05 (Bonferroni); largest",
        Some(true) | None => "largest rank correlation",
    };
    format!("{name}: {which} {value:.3}, with {key} ({pairs} samples, {chance})\n")
}

/// For the terminal; and what became of the requirements.
fn summary(
    (prepared, plan, finished): (&Prepared, &Plan, &Finished),
    results: &Results,
    correlations: &Correlations,
    found: &[(String, Vec<Derivative>)],
) -> (String, Exit) {
    let mut text = format!("{}: {} samples\n", prepared.scenario.name, plan.samples.len());
    text.push_str(&aligned(&results.table.text()));
    let _ = writeln!(text, "intervals contain the true value with at least {LEVEL}");
    for (name, by) in correlations {
        text.push_str(&largest_correlation(name, by));
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
    let (rest, exit) = ending((prepared, plan, finished), results);
    (text + &rest, exit)
}
