//! The ten lines that a run prints: one for each variant, the bounds, and where the files are.

use std::fmt::Write as _;
use std::path::Path;

use crate::bound::{BOUND, excesses};
use crate::outcome::Outcome;
use crate::run::Settings;

/// Why a run may show no jitter.
pub(super) const NO_JITTER: &str = "it takes a whole turn of the wheel (0.12 s at 500 rpm) and 8 \
                                    samples in it; run longer or raise the rate";

/// The table of outcomes, as text.
#[must_use]
pub fn summary<const N: usize>(
    outcomes: &[Outcome<N>],
    settings: &Settings,
    folder: &Path,
    files: usize,
) -> String {
    let name = outcomes.iter().map(|o| o.scenario.name.len()).max().unwrap_or(0);
    let mut text = format!(
        "{:name$} {:>10} {:>12} {:>8} {:>7} {:>8} {:>8} {:>8} {:>6}\n\
         {:name$} {:>10} {:>12} {:>8} {:>7} {:>8} {:>8} {:>8}\n",
        "variant",
        "peak omega",
        "jitter omega",
        "jitter r",
        "B moved",
        "energy",
        "linear",
        "angular",
        "steps",
        "",
        "deg/s",
        "deg/s",
        "um",
        "mm",
        "drift",
        "drift",
        "drift",
    );
    for outcome in outcomes {
        let f = outcome.figures();
        let (omega, position) = f.jitter.map_or_else(
            || ("-".to_owned(), "-".to_owned()),
            |(omega, r)| (format!("{:.3e}", omega.to_degrees()), format!("{:.4}", 1e6 * r)),
        );
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "{:name$} {:>10.4} {omega:>12} {position:>8} {:>7.3} {:>8.0e} {:>8.0e} {:>8.0e} {:>6}",
            outcome.scenario.name,
            f.omega_peak.to_degrees(),
            1e3 * f.position_drift,
            f.drift.energy,
            f.drift.linear,
            f.drift.angular,
            outcome.history.steps.accepted,
        );
    }
    if outcomes.iter().any(|o| o.ripple.is_empty()) {
        let _ = writeln!(text, "- for jitter: {NO_JITTER}");
    }
    let Settings { duration, tolerance, rate } = settings;
    let held = outcomes.iter().all(|o| excesses(&o.scenario.name, &o.figures().drift).is_empty());
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
