//! The requirements of a scenario: what was reached, and what the limit is.

use crate::pointing::{Index, Margin};
use crate::record::Verdict;
use crate::report::blocks::{Block, table};
use crate::report::{Report, number, row_state};
use crate::scenario::Statistic;

/// From so many times the limit on, a margin is stated as such: -60013 % is read as a fault.
const TIMES_MAX: f64 = 10.0;

/// The table; empty where the scenario states no requirements.
pub(in crate::report) fn table_of(report: &Report) -> Vec<Block> {
    let requirements = &report.scenario.requirements;
    if requirements.is_empty() {
        return Vec::new();
    }
    let rows = requirements.iter().zip(report.verdicts()).map(|(requirement, verdict)| {
        let [from, to] = requirement.window.map(number::time);
        let cells = vec![
            requirement.name.clone(),
            verdict.state.to_string(),
            reached(verdict),
            limit(verdict),
            margin(verdict),
            verdict.quantity.clone(),
            statistic(requirement.statistic),
            format!("{from} s to {to} s"),
        ];
        (row_state(&verdict.state), cells)
    });
    let columns = [
        ("Requirement", ""),
        ("State", ""),
        ("Reached", ""),
        ("Limit", ""),
        ("Margin", ""),
        ("Quantity", ""),
        ("Statistic", ""),
        ("Window", ""),
    ];
    // The verdict first: a phone shows the first columns.
    vec![table("Requirements, and what the run reached", &columns, 2..5, rows)]
}

/// A requirement in words: `pointing: 0.0300 deg/s of omega, within the limit 0.100 deg/s`.
pub(in crate::report) fn words(verdict: &Verdict) -> String {
    if let (Some(reason), reached) = (verdict.state.reason(), reached(verdict)) {
        let so_far = match (verdict.value, verdict.complete) {
            (Some(_), false) => format!("; {reached} so far"),
            _ => String::new(),
        };
        return format!("{}: not evaluated: {reason}{so_far}", verdict.name);
    }
    let comparison = if verdict.is_met() { "within" } else { "above" };
    format!(
        "{}: {} of {}, {comparison} the limit {}",
        verdict.name,
        reached(verdict),
        verdict.quantity,
        limit(verdict)
    )
}

fn reached(verdict: &Verdict) -> String {
    let (unit, size) = &verdict.unit;
    verdict.value.map_or_else(|| "–".to_owned(), |value| number::with_unit(value / size, 4, unit))
}

fn limit(verdict: &Verdict) -> String {
    let (unit, size) = &verdict.unit;
    let limit = number::short(verdict.limit / size, 6);
    if unit.is_empty() || unit == "1" { limit } else { format!("{limit} {unit}") }
}

/// What is left of the limit, and limit by value in decibels.
fn margin(verdict: &Verdict) -> String {
    verdict.margin().map_or_else(|| "–".to_owned(), shown_margin)
}

fn shown_margin(margin: Margin) -> String {
    let times = margin.value / margin.limit;
    let left = if times.is_finite() && times > TIMES_MAX {
        format!("{} times the limit", number::short(times, 3))
    } else {
        format!("{} %", number::short(margin.percent(), 3))
    };
    let decibels = margin.decibels();
    if !decibels.is_finite() {
        return left;
    }
    format!("{left}, {} dB", number::short(decibels, 3))
}

fn statistic(statistic: Statistic) -> String {
    match statistic {
        Statistic::Peak => "largest magnitude".to_owned(),
        Statistic::Rms => "RMS".to_owned(),
        Statistic::BandRms([from, to]) => {
            format!("RMS from {} Hz to {} Hz", number::short(from, 6), number::short(to, 6))
        }
        Statistic::Final => "magnitude at the end".to_owned(),
        Statistic::Drift => "largest departure from the start".to_owned(),
        Statistic::Displacement(time) => format!("displacement, RMS over {}", exposures(time)),
        Statistic::Smear(time) => format!("smear, RMS in {}", exposures(time)),
        Statistic::Jitter(time) => format!("jitter, RMS in {}", exposures(time)),
        Statistic::Index { index, level } => {
            let time = |time: f64| number::short(time, 6);
            let windows = match index {
                Index::Ape => String::new(),
                Index::Mpe { window } | Index::Rpe { window } | Index::Pre { window } => {
                    format!(", window {} s", time(window))
                }
                Index::Pde { window, stability } => {
                    format!(", window {} s, stability time {} s", time(window), time(stability))
                }
            };
            let share = number::short(100.0 * level, 6);
            format!("{} not exceeded in {share} % of the time{windows}", index.name())
        }
    }
}

fn exposures(time: f64) -> String {
    format!("exposures of {} s", number::short(time, 6))
}

#[cfg(test)]
mod tests {
    use super::{Margin, shown_margin};

    #[test]
    fn far_above_the_limit_a_margin_is_a_multiple_of_it() {
        let of = |value: f64, limit: f64| shown_margin(Margin { value, limit });
        assert_eq!(of(0.5, 1.0), "50 %, 6.02 dB");
        assert_eq!(of(1.5, 1.0), "−50 %, −3.52 dB");
        assert_eq!(of(601.13, 1.0), "601 times the limit, −55.6 dB");
        assert_eq!(of(0.0, 1.0), "100 %");
        assert_eq!(of(1.0, 0.0), "−inf %");
    }
}
