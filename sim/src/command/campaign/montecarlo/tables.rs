//! The tables of a Monte Carlo campaign on a terminal and a page.

use super::{Correlations, LEVEL, PERCENTILES, RankCorrelation, meets, sorted};
use crate::campaign::{Derivative, Estimate, Finished, Plan, percentile};
use crate::command::campaign::{Prepared, ResultColumn, Results, shown, values_of};
use crate::command::table::six;
use crate::pointing::RequirementState;
use crate::report::campaign::CampaignTable;

/// What became of the requirements, and the table of them and of the columns.
pub(super) fn results(prepared: &Prepared, plan: &Plan, finished: &Finished) -> Results {
    let (mut states, mut rows) = (Vec::new(), Vec::new());
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
        let mut row = vec![name.clone(), shown(at(0.5)), shown(high)];
        row.push(high.map_or_else(String::new, |of| {
            format!("{} to {}", value(of.interval[0]), value(of.interval[1]))
        }));
        let mut word = "";
        if let Some((limit, found)) =
            limit.and_then(|limit| Some((limit, meets(finished, field, limit)?)))
        {
            let state = RequirementState::from_numbers(&values_of(finished, field), limit);
            word = if state.reason().is_some() { "" } else { state.word() };
            states.push((name, state));
            let of_all = format!("{} of {}", found.met, plan.samples.len());
            row.push(format!("{} {unit}", six(limit / size)));
            row.push(match found.not_evaluated {
                0 => of_all,
                some => format!("{of_all}, {some} not evaluated"),
            });
            let [lower, upper] = found.probability.interval;
            row.push(format!("{lower:.4} to {upper:.4}"));
        }
        rows.push((word, row));
    }
    let heads = ["", "median", "95 %", "its interval", "limit", "met by", "probability"];
    let caption = "Requirements and columns: intervals contain the true value with at least 0.95";
    let heads = heads.map(str::to_owned).into();
    Results { states, table: CampaignTable { caption, heads, rows, numbers: 1..7 } }
}

/// Percentiles with their intervals: a row for each.
pub(super) fn percentile_table(prepared: &Prepared, finished: &Finished) -> CampaignTable {
    let rows = |(name, field, (unit, size), _): ResultColumn| {
        let sorted = sorted(finished, field);
        let row = move |share: &f64| {
            let found = percentile(&sorted, *share, LEVEL)?;
            let value = |value: f64| {
                if value.is_finite() { six(value / size) } else { "none".to_owned() }
            };
            let [lower, upper] = found.interval.map(value);
            let share = format!("{} %", six(100.0 * share));
            Some(("", vec![name.clone(), share, value(found.value), lower, upper, unit.clone()]))
        };
        PERCENTILES.iter().filter_map(row).collect::<Vec<_>>()
    };
    let heads = ["Number", "Percentile", "Value", "From", "To", "Unit"];
    CampaignTable {
        caption: "Percentiles, and intervals that contain the true one with at least 0.95",
        heads: heads.map(str::to_owned).into(),
        rows: shown(prepared).flat_map(rows).collect(),
        numbers: 1..5,
    }
}

/// Rank correlations: a row for each number, a column for each key.
pub(super) fn correlation_table(of: &Correlations) -> CampaignTable {
    let keys = of.first().map_or(&[][..], |(_, by)| by);
    let row = |(name, by): &(String, Vec<(String, Option<RankCorrelation>)>)| {
        let cell = |(_, found): &(String, Option<RankCorrelation>)| match found {
            None => "–".to_owned(),
            Some(of) if of.is_significant(by.len()) == Some(false) => format!("({:.3})", of.value),
            Some(of) => format!("{:.3}", of.value),
        };
        ("", std::iter::once(name.clone()).chain(by.iter().map(cell)).collect())
    };
    let heads = keys.iter().map(|(key, _)| key.clone());
    CampaignTable {
        caption: "Rank correlations (Spearman) of each number with each key; in parentheses those that are not significant at \
                  0.05 (Bonferroni: p times the number of keys is 0.05 or more); fewer than ten samples are not judged",
        heads: std::iter::once("Number".to_owned()).chain(heads).collect(),
        rows: of.iter().map(row).collect(),
        numbers: 1..keys.len() + 1,
    }
}

/// Derivatives of each number, ranked by what a standard deviation of the key makes.
pub(super) fn derivative_table(found: &[(String, Vec<Derivative>)]) -> CampaignTable {
    let rows = found.iter().flat_map(|(name, by)| {
        by.iter().map(move |one| {
            let method = if one.exact { "exact" } else { "central difference" };
            let numbers = [six(one.slope), six(one.size())];
            let [slope, size] = numbers;
            ("", vec![name.clone(), one.label.clone(), slope, size, method.to_owned()])
        })
    });
    let heads =
        ["Number", "Key", "Derivative (SI by the key's unit)", "Times deviation (SI)", "Method"];
    CampaignTable {
        caption: "Derivatives about the middle of the plan",
        heads: heads.map(str::to_owned).into(),
        rows: rows.collect(),
        numbers: 2..4,
    }
}
