//! The head of the page, and a summary for the terminal: verdict, end of the run, cost, drifts.

use std::f64::consts::TAU;
use std::fmt::Write as _;

use super::requirements;
use super::settling::Settling;
use crate::pointing::RequirementState;
use crate::record;
use crate::record::{End, Event, Outcome};
use crate::report::blocks::{Fact, Summary, Verdict};
use crate::report::{Report, number};
use crate::scenario::{IntegratorChoice, Member};

/// Requirements that the terminal shows.
const SHOWN_MAX: usize = 12;
/// Events that it shows.
const EVENTS_SHOWN_MAX: usize = 6;

/// The sentence above everything.
pub(in crate::report) fn verdict(report: &Report, outcome: &Outcome) -> Verdict {
    let verdicts = report.verdicts();
    let count =
        |of: fn(&RequirementState) -> bool| verdicts.iter().filter(|v| of(&v.state)).count();
    let violated = count(RequirementState::is_violated);
    let missing = verdicts.len() - violated - count(RequirementState::is_met);
    let reasons = || {
        let unmet = unmet_first(verdicts).into_iter().filter(|verdict| !verdict.is_met());
        unmet.map(requirements::words).collect::<Vec<_>>().join("; ")
    };
    let end = end_words(outcome);
    if let End::Failed(_) | End::Cancelled = outcome.end {
        let word = if matches!(outcome.end, End::Cancelled) { "Cancelled." } else { "Failed." };
        let valid = "Everything up to there is valid.";
        let text = format!("{end} {valid}");
        return Verdict { state: "violated", word: word.to_owned(), text };
    }
    match (verdicts.len(), violated) {
        (0, _) => Verdict {
            state: "",
            word: "Complete.".to_owned(),
            text: format!("{end} The scenario states no requirements."),
        },
        (all, 0) if missing > 0 => Verdict {
            state: "",
            word: match (all, missing) {
                (1, _) => "The requirement is not evaluated:".to_owned(),
                (_, 1) => format!("1 of {all} requirements is not evaluated, the others are met:"),
                _ if missing == all => "No requirement is evaluated:".to_owned(),
                _ => format!(
                    "{missing} of {all} requirements are not evaluated, the others are met:"
                ),
            },
            text: format!("{}. {end}", reasons()),
        },
        (all, 0) => Verdict {
            state: "met",
            word: if all == 1 {
                "The requirement is met.".to_owned()
            } else {
                format!("All {all} requirements are met.")
            },
            text: end,
        },
        (all, some) => Verdict {
            state: "violated",
            word: if all == 1 {
                "The requirement is violated:".to_owned()
            } else if some == 1 {
                format!("1 of {all} requirements is violated:")
            } else {
                format!("{some} of {all} requirements are violated:")
            },
            text: format!("{}. {end}", reasons()),
        },
    }
}

/// Verdicts with those that are violated first, then those that are not evaluated.
fn unmet_first(verdicts: &[record::Verdict]) -> Vec<&record::Verdict> {
    let mut sorted: Vec<_> = verdicts.iter().collect();
    sorted.sort_by_key(|verdict| match verdict.state {
        RequirementState::Violated => 0,
        RequirementState::NotEvaluated(_) => 1,
        RequirementState::Met => 2,
    });
    sorted
}

/// Paragraphs and facts of the first section.
pub(in crate::report) fn summary(report: &Report, outcome: &Outcome) -> Summary {
    let scenario = &report.scenario;
    let mut paragraphs = Vec::new();
    if !scenario.description.trim().is_empty() {
        paragraphs.push(scenario.description.trim().to_owned());
    }
    let base = |member: &Member<'_>| member.on().and_then(|on| scenario.names.get(on));
    let devices: Vec<_> = scenario
        .members()
        .map(|(name, member)| match base(&member) {
            Some(base) => format!("{name} ({} on {base})", member.kind_name()),
            None => format!("{name} ({})", member.kind_name()),
        })
        .collect();
    let platforms = scenario.members().any(|(_, member)| member.platform().is_some());
    let mass = number::short(scenario.hub.m_b, 7);
    let hub = scenario.structure.as_ref().map_or_else(
        || format!("A rigid hub of {mass} kg"),
        |structure| {
            let modes = structure.massive().iter().map(|mode| mode.frequency / TAU);
            let lowest = number::short(modes.clone().fold(f64::INFINITY, f64::min), 4);
            let highest = number::short(modes.fold(0.0, f64::max), 4);
            let count = match structure.massive().len() {
                1 => "one mode".to_owned(),
                count => format!("{count} modes"),
            };
            format!("A structure of {mass} kg with {count}, {lowest} Hz to {highest} Hz,")
        },
    );
    paragraphs.push(match devices.len() {
        0 => format!("{hub} without devices."),
        1 => format!("{hub} with one device: {}.", devices.join(", ")),
        count if platforms => {
            format!("{hub} with {count} devices and platforms: {}.", devices.join(", "))
        }
        count => format!("{hub} with {count} devices: {}.", devices.join(", ")),
    });
    paragraphs.extend(super::controllers::sentences(scenario));
    Summary { paragraphs, facts: facts(report, outcome) }
}

fn facts(report: &Report, outcome: &Outcome) -> Vec<Fact> {
    let settings = &report.scenario.settings;
    let (name, setting) = match settings.integrator {
        IntegratorChoice::Dop853 { tolerance } => {
            ("DOP853", format!("tolerance {}", number::short(tolerance, 3)))
        }
        IntegratorChoice::Rk4 { step } => ("RK4", format!("step {} s", number::short(step, 6))),
    };
    let duration = number::time(settings.duration);
    let steps = &outcome.steps;
    let drift = |drift: Option<f64>| {
        drift.map_or_else(|| "not conserved".to_owned(), |drift| number::significant(drift, 2))
    };
    let events = u64::try_from(outcome.events.len()).unwrap_or(0) + outcome.events_omitted;
    let mut facts = vec![
        Fact::new(
            "Simulated time",
            format!("{} s of {duration} s", number::time(outcome.end_time)),
        ),
        Fact::new("Integrator", format!("{name}, {setting}")),
        Fact::new(
            "Steps accepted, rejected",
            format!("{},\u{a0}{}", number::count(steps.accepted), number::count(steps.rejected)),
        ),
        Fact::new("Evaluations", number::count(steps.evaluations)),
        Fact::new(
            "Samples",
            format!(
                "{} at {} Hz",
                number::count(outcome.samples),
                number::short(report.scenario.output.rate, 6)
            ),
        ),
        Fact::new("Events", number::count(events)),
        Fact::new("Relative drift of energy less work", drift(outcome.drift.energy)),
        Fact::new("Relative drift of linear momentum", drift(outcome.drift.linear)),
        Fact::new("Relative drift of angular momentum", drift(outcome.drift.angular)),
    ];
    if let Some(peak) = omega_peak(report) {
        // It breaks before the time, if at all.
        let whole = peak.replace(' ', "\u{a0}").replace("\u{a0}at", " at");
        facts.push(Fact::new("Largest angular velocity", whole));
    }
    let controllers = report.collected.iter().flat_map(|collected| &collected.settling);
    facts.extend(controllers.flat_map(Settling::facts));
    if outcome.energy_lost != 0.0 {
        let lost = number::with_unit(outcome.energy_lost, 4, "J");
        facts.push(Fact::new("Lost in brakes and end stops", lost));
    }
    facts
}

/// Some ten lines, and the first events.
pub(in crate::report) fn terminal(report: &Report, outcome: &Outcome, files: &[String]) -> String {
    let steps = &outcome.steps;
    let mut lines = vec![
        format!("{}: {}", report.scenario.name, outcome.end),
        format!(
            "{} s simulated, {} steps ({} rejected), {} samples",
            number::time(outcome.end_time),
            steps.accepted,
            steps.rejected,
            outcome.samples
        ),
    ];
    let verdicts = report.verdicts();
    if !verdicts.is_empty() {
        let count = |word: &str| verdicts.iter().filter(|v| v.state.word() == word).count();
        let mut line = format!("requirements: {} of {} met", count("met"), verdicts.len());
        for word in ["violated", "not evaluated"] {
            if count(word) > 0 {
                let _ = write!(line, ", {} {word}", count(word));
            }
        }
        lines.push(line);
        let shown = unmet_first(verdicts).into_iter().take(SHOWN_MAX);
        lines.extend(shown.map(|verdict| format!("  {}", requirements::words(verdict))));
        if verdicts.len() > SHOWN_MAX {
            lines.push(format!("  and {} more", verdicts.len() - SHOWN_MAX));
        }
    }
    lines.extend(event_lines(outcome));
    if let Some(peak) = omega_peak(report) {
        lines.push(format!("largest |omega|: {peak}"));
    }
    let drift = &outcome.drift;
    let parts = [
        ("energy less work", drift.energy),
        ("linear momentum", drift.linear),
        ("angular momentum", drift.angular),
    ];
    let parts = parts.into_iter().filter_map(|(what, drift)| Some((what, drift?)));
    let parts: Vec<_> = parts.map(|(what, drift)| format!("{what} {drift:.1e}")).collect();
    if !parts.is_empty() {
        lines.push(format!("relative drift: {}", parts.join(", ")));
    }
    if !files.is_empty() {
        lines.push(format!("files: {}", files.join(", ")));
    }
    lines.push(String::new());
    lines.join("\n")
}

/// Crossings, stops and changes, with their times.
fn event_lines(outcome: &Outcome) -> Vec<String> {
    let shown = outcome.events.iter().take(EVENTS_SHOWN_MAX);
    let line = |event: &Event| format!("at {} s: {}", number::time(event.time), event.text);
    let mut lines: Vec<String> = shown.map(line).collect();
    let all = u64::try_from(outcome.events.len()).unwrap_or(0) + outcome.events_omitted;
    let more = all.saturating_sub(u64::try_from(lines.len()).unwrap_or(0));
    if more > 0 {
        lines.push(format!("and {more} more events"));
    }
    lines
}

fn omega_peak(report: &Report) -> Option<String> {
    let extremes = report.collected.as_ref()?.omega.as_ref()?.extremes;
    let (peak, time) = (extremes.peak.to_degrees(), number::time(extremes.peak_time));
    Some(format!("{} at {time} s", number::with_unit(peak, 4, "deg/s")))
}

fn end_words(outcome: &Outcome) -> String {
    let time = number::time(outcome.end_time);
    match &outcome.end {
        End::Finished => format!("The run finished at {time} s."),
        End::Cancelled => format!("The run was cancelled at {time} s."),
        End::Failed(error) => format!("The run failed at {time} s: {error}."),
        other => format!("The run was {other}, at {time} s."),
    }
}
