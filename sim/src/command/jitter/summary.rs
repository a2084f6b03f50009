//! What `jitter` prints: verdicts, worst speeds, the scenario as it is, contributors, agreement.

use std::fmt::Write as _;

use super::{JitterResults, NOT_COMPARED};
use crate::command::table::{aligned, six};
use crate::jitter::budget::{Assessed, Budget, outputs_of};
use crate::jitter::own_speeds::AtOwnSpeeds;
use crate::jitter::weight::Weight;
use crate::margins::closed_noise::CLOSED_NOISE;
use crate::report::jitter::{AGREEMENT, OWN_SPEEDS, intervals, metric, rpm, worst_speed};

/// For the terminal.
pub(super) fn summary(budget: &Budget, found: &JitterResults) -> String {
    let mut text = format!("{}\n", budget.title);
    if found.assessed.is_empty() {
        text.push_str("no requirements\n");
    } else {
        text.push_str(&verdicts(found));
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
    text.push_str(&contributors(budget, found));
    text.push_str(&compared(found));
    text
}

/// A row for each requirement at its worst speed, and one as in the scenario.
fn verdicts(found: &JitterResults) -> String {
    let mut rows = vec![
        ["requirement", "state", "worst", "limit", "margin dB", "at", "keep out of"]
            .map(str::to_owned)
            .to_vec(),
    ];
    for (index, of) in found.assessed.iter().enumerate() {
        let (unit, size) = &of.limit.unit;
        let limit = format!("{} {unit}", six(of.limit.limit / size));
        let mut row = vec![
            format!("{} ({})", of.limit.name, metric(&of.limit.metric)),
            match of.violated_by() {
                Some(by) => format!("{}, but {}", of.state().word(), by.excess()),
                None => of.state().word().to_owned(),
            },
        ];
        if of.no_data.is_some() {
            row.extend(["", &limit, "", "", ""].map(str::to_owned));
        } else {
            row.extend([
                format!("{} {unit}", six(of.margin.value / size)),
                limit.clone(),
                format!("{:.1}", of.margin.decibels()),
                worst_speed(&found.sweep.speeds, of.worst, of.is_flat()),
                intervals(&of.keep_out),
            ]);
        }
        rows.push(row);
        if let Some(own) = found.own().get(index) {
            rows.push(as_in_scenario(own, &limit, (unit, *size)));
        }
    }
    aligned(&rows)
}

/// The row of a requirement with each rotor at its own speed.
fn as_in_scenario(of: &AtOwnSpeeds, limit: &str, (unit, size): (&str, f64)) -> Vec<String> {
    let Some((_, margin)) = of.by_phases.first() else { return Vec::new() };
    let state = of.state(margin);
    let known = |text: String| if state.reason().is_some() { String::new() } else { text };
    vec![
        "  as in the scenario".to_owned(),
        state.word().to_owned(),
        known(format!("{} {unit}", six(margin.value / size))),
        limit.to_owned(),
        known(format!("{:.1}", margin.decibels())),
        OWN_SPEEDS.to_owned(),
        String::new(),
    ]
}

/// The largest contributor to each requirement, and the noise.
fn contributors(budget: &Budget, found: &JitterResults) -> String {
    let mut text = String::new();
    for of in &found.assessed {
        let first = of.shares.first();
        if let Some((index, share)) = first
            && let Some(contributor) = found.sweep.contributors.get(*index)
        {
            let _ = writeln!(
                text,
                "{}: largest contributor {} ({}, order {}), {:.0} % {}",
                of.limit.name,
                contributor.rotor,
                contributor.cause,
                contributor.order,
                100.0 * share,
                budget.phases.share()
            );
        }
    }
    let noisy = |of: &&Assessed| of.noise > 0.0;
    for of in found.assessed.iter().filter(noisy) {
        let _ = writeln!(
            text,
            "{}: broadband noise, {:.0} % of the mean square{}",
            of.limit.name,
            100.0 * of.noise,
            parts_of_noise(found, of)
        );
    }
    text
}

/// What the noise through a loop is of, at the worst speed.
fn parts_of_noise(found: &JitterResults, of: &Assessed) -> String {
    let (Some(parts), Ok(weight)) = (&found.noise, Weight::of_metric(&of.limit.metric)) else {
        return String::new();
    };
    let speed = found.sweep.speeds.get(of.worst).copied().unwrap_or(0.0);
    let outputs = outputs_of(of.sight);
    let squares = parts.each_ref().map(|part| part.mean_square(speed, &outputs, &weight));
    let whole: f64 = squares.iter().sum();
    let shares = CLOSED_NOISE.iter().zip(squares).filter(|(_, square)| *square > 0.0);
    let shares: Vec<String> = shares
        .map(|(name, square)| format!("{name} {:.0} %", 100.0 * square / whole * of.noise))
        .collect();
    format!(" ({})", shares.join("; "))
}

/// How the runs of the coupled equations agree.
fn compared(found: &JitterResults) -> String {
    let mut text = String::new();
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
