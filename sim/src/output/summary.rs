//! The ten lines that a run prints: one for each variant, the bounds, and where the files are.

use std::fmt::Write as _;
use std::path::Path;

use super::plates::BOUND;
use crate::outcome::Outcome;
use crate::run::Settings;

/// The table of outcomes, as plain text.
#[must_use]
pub fn summary<const N: usize>(
    outcomes: &[Outcome<N>],
    settings: &Settings,
    folder: &Path,
    files: usize,
) -> String {
    let name = outcomes.iter().map(|o| o.scenario.name.len()).max().unwrap_or(0);
    let mut text = format!(
        "{:name$} {:>9} {:>9} {:>9} {:>8} {:>8} {:>8} {:>8} {:>6}\n\
         {:name$} {:>9} {:>9} {:>9} {:>8} {:>8} {:>8} {:>8} {:>6}\n",
        "variant",
        "peak |w|",
        "jitter w",
        "jitter r",
        "B moved",
        "drift of",
        "linear",
        "angular",
        "steps",
        "",
        "deg/s",
        "deg/s",
        "um",
        "mm",
        "E - W",
        "momentum",
        "momentum",
        "",
    );
    for outcome in outcomes {
        let f = outcome.figures();
        let (omega, position) = f.jitter.map_or_else(
            || ("-".to_owned(), "-".to_owned()),
            |(w, r)| (format!("{:.3e}", w.to_degrees()), format!("{:.4}", 1e6 * r)),
        );
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "{:name$} {:>9.4} {omega:>9} {position:>9} {:>8.3} {:>8.0e} {:>8.0e} {:>8.0e} {:>6}",
            outcome.scenario.name,
            f.omega_peak.to_degrees(),
            1e3 * f.position_drift,
            f.drift.energy,
            f.drift.linear,
            f.drift.angular,
            outcome.history.steps.accepted,
        );
    }
    let Settings { duration, tolerance, rate } = settings;
    let held = outcomes
        .iter()
        .map(|o| o.figures().drift)
        .all(|d| d.energy <= BOUND && d.linear <= BOUND && d.angular <= BOUND);
    let verdict = if held { "all drifts within" } else { "NOT all drifts within" };
    let _ = writeln!(
        text,
        "{duration} s at tolerance {tolerance:e}, {rate} samples/s; {verdict} {BOUND:e}\n\
         {files} files in {}; open {}",
        folder.display(),
        folder.join("report.html").display()
    );
    text
}
