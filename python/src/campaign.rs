//! Campaigns: plans, the row of one run, and what a sample of rows says, as [`precess::campaign`] has them.

use std::path::PathBuf;

use precess::campaign::{
    Axis, Plan, Selection, central_differences, draw, keep_out as bands, percentile,
    probability_between, run_reduced, spearman, tangents,
};
use precess::engine::SIDE_BY_SIDE;
use precess::file::{Template, variations_from_toml};
use precess::record::{Columns, Header};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::errors;
use crate::scenario::NativeScenario;

/// Labels; and of each sample its values and what sets its keys.
type PlanFacts = (Vec<String>, Vec<(Vec<f64>, Vec<String>)>);

fn facts(plan: Plan) -> PlanFacts {
    let samples = plan.samples.into_iter().map(|sample| (sample.values, sample.overrides));
    (plan.labels, samples.collect())
}

fn wrong(error: &dyn std::fmt::Display) -> PyErr {
    PyValueError::new_err(error.to_string())
}

/// Every combination of values of keys: `hub.mass=100..900 kg:9`.
#[pyfunction]
pub(crate) fn plan_of_axes(axes: Vec<String>) -> PyResult<PlanFacts> {
    let axes: Result<Vec<_>, _> = axes.iter().map(|text| Axis::parse(text)).collect();
    let plan = axes.and_then(|axes| Plan::of_axes(&axes)).map_err(|error| wrong(&error))?;
    Ok(facts(plan))
}

/// Samples drawn from the distributions of a plan file.
#[pyfunction]
pub(crate) fn plan_of_draws(
    path: PathBuf,
    samples: usize,
    seed: u64,
    latin: bool,
) -> PyResult<PlanFacts> {
    let variations = variations_from_toml(&path).map_err(|found| errors::scenario(&found))?;
    Ok(facts(draw(&variations, samples, seed, latin).map_err(|error| wrong(&error))?))
}

/// Samples at given probabilities of the distributions of a plan file: a row for each sample, a number for each key.
#[pyfunction]
pub(crate) fn plan_of_probabilities(
    path: PathBuf,
    probabilities: Vec<Vec<f64>>,
) -> PyResult<PlanFacts> {
    let variations = variations_from_toml(&path).map_err(|found| errors::scenario(&found))?;
    let plan = Plan::of_probabilities(&variations, &probabilities);
    Ok(facts(plan.map_err(|error| wrong(&error))?))
}

/// How many keys a plan file varies.
#[pyfunction]
pub(crate) fn plan_keys(path: PathBuf) -> PyResult<Vec<String>> {
    let variations = variations_from_toml(&path).map_err(|found| errors::scenario(&found))?;
    Ok(variations.into_iter().map(|of| of.key).collect())
}

/// Names and units of the numbers of a row.
#[pyfunction]
pub(crate) fn row_fields(
    scenario: &NativeScenario,
    columns: Vec<String>,
    lines: usize,
) -> PyResult<Vec<(String, String)>> {
    let mut scenario = (*scenario.scenario).clone();
    scenario.output.columns.clone_from(&columns);
    let found = Columns::from_scenario(&scenario).map_err(|error| errors::record(&error))?;
    let header = Header::new(&scenario, &found);
    for name in &columns {
        header.quantity(name).map_err(|error| errors::record(&error))?;
    }
    let selection = Selection { columns, lines, from: 0.0 };
    let fields = selection.fields(&header, &scenario.requirements);
    Ok(fields.into_iter().map(|field| (field.name, field.unit)).collect())
}

/// How many runs take the least time together.
#[pyfunction]
pub(crate) fn side_by_side() -> usize {
    SIDE_BY_SIDE
}

/// The numbers of each run, or why there are none. Nothing is recorded beyond them.
#[pyfunction]
#[expect(clippy::needless_pass_by_value, reason = "as Python passes them")]
pub(crate) fn rows(
    py: Python<'_>,
    scenarios: Vec<PyRef<'_, NativeScenario>>,
    columns: Vec<String>,
    lines: usize,
    start: f64,
) -> Vec<(Option<Vec<f64>>, Option<String>)> {
    let scenarios = scenarios.iter().map(|of| (*of.scenario).clone()).collect();
    let selection = Selection { columns, lines, from: start };
    let found = py.detach(|| run_reduced(scenarios, &selection, &|| false));
    let row = |of: Option<Result<Vec<f64>, String>>| match of {
        Some(Ok(row)) => (Some(row), None),
        Some(Err(message)) => (None, Some(message)),
        None => (None, Some("the run was cancelled".to_owned())),
    };
    found.into_iter().map(row).collect()
}

/// Name and limit, SI, of each requirement of a scenario.
#[pyfunction]
pub(crate) fn limits(scenario: &NativeScenario) -> Vec<(String, f64)> {
    scenario.scenario.requirements.iter().map(|of| (of.name.clone(), of.limit)).collect()
}

/// A percentile of rising numbers and an interval that contains it with a probability of at least `level`.
#[pyfunction]
#[expect(clippy::needless_pass_by_value, reason = "as Python passes them")]
pub(crate) fn estimate_percentile(
    sorted: Vec<f64>,
    share: f64,
    level: f64,
) -> Option<(f64, f64, f64)> {
    percentile(&sorted, share, level).map(|of| (of.value, of.interval[0], of.interval[1]))
}

/// A probability by `met` of `count` trials, and its interval; NaN where it is not known of `unknown` trials whether they are.
#[pyfunction]
pub(crate) fn estimate_probability(
    met: usize,
    count: usize,
    level: f64,
    unknown: usize,
) -> Option<(f64, f64, f64)> {
    let successes = [met, met.saturating_add(unknown)];
    probability_between(successes, count, level)
        .map(|of| (of.value, of.interval[0], of.interval[1]))
}

/// Rank correlation by Spearman.
#[pyfunction]
#[expect(clippy::needless_pass_by_value, reason = "as Python passes them")]
pub(crate) fn rank_correlation(x: Vec<f64>, y: Vec<f64>) -> Option<f64> {
    spearman(&x, &y)
}

/// Intervals of a key in which a statistic exceeds its limit, or of which nothing is known.
#[pyfunction]
#[expect(clippy::needless_pass_by_value, reason = "as Python passes them")]
pub(crate) fn keep_out(
    values: Vec<f64>,
    statistic: Vec<Option<f64>>,
    limit: f64,
) -> Vec<(f64, f64)> {
    bands(&values, &statistic, limit).into_iter().map(<[f64; 2]>::into).collect()
}

/// Labels of the keys that have a derivative, the standard deviation of each; of each number its derivatives, exact; the
/// largest share by which a number of this run differs from that of the scenario's own.
type Sensitivities = (Vec<String>, Vec<f64>, Vec<Option<Vec<f64>>>, f64);

/// Exact derivatives of the requirements, then of RMS and peak of each column, by the keys of a plan file.
#[pyfunction]
#[expect(clippy::needless_pass_by_value, reason = "as Python passes them")]
pub(crate) fn plan_sensitivities(
    py: Python<'_>,
    path: PathBuf,
    overrides: Vec<String>,
    plan: PathBuf,
    columns: Vec<String>,
    start: f64,
) -> PyResult<Sensitivities> {
    py.detach(|| {
        let template = Template::from_file(&path).map_err(|found| errors::scenario(&found))?;
        let variations = variations_from_toml(&plan).map_err(|found| errors::scenario(&found))?;
        let selection = Selection { columns, lines: 0, from: start };
        let found = tangents(&template, &overrides, &variations, &selection);
        let found = found.map_err(errors::class::UnsupportedError::new_err)?;
        let labels = central_differences(&variations).labels;
        let scales = variations.iter().filter_map(|of| of.distribution.scale());
        let deviations = scales.map(|[_, deviation]| deviation).collect();
        Ok((labels, deviations, found.slopes, found.difference))
    })
}
