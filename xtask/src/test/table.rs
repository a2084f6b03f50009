//! The table at the end: what was tested, how many cases, what it took, what was skipped.

use xtask::say;

use super::cost::Spent;
use super::outcome::Outcome;

/// Prints the table, and one line for tools that read the output of tests.
pub(crate) fn print(outcomes: &[Outcome], spent: &Spent) {
    let width = outcomes.iter().map(|outcome| outcome.name.len()).max().unwrap_or(0).max(5);
    say!("\n{:width$}  {:>7}  {:>7}  {:>7}", "suite", "cases", "s", "CPU s");
    for outcome in outcomes {
        let mark = if outcome.failed() { "  FAILED" } else { "" };
        let cases = outcome.cases.map_or_else(|| "-".to_owned(), |cases| cases.to_string());
        let cpu = outcome.cpu.map_or_else(|| "-".to_owned(), |cpu| format!("{cpu:.1}"));
        say!("{:width$}  {cases:>7}  {:>7.1}  {cpu:>7}{mark}", outcome.name, outcome.seconds);
    }
    let skipped: Vec<_> = outcomes.iter().flat_map(|outcome| &outcome.skipped).collect();
    if !skipped.is_empty() {
        say!("\nskipped");
        for what in &skipped {
            say!("  {what}");
        }
    }
    let left: u64 = outcomes.iter().map(|outcome| outcome.left).sum();
    if left > 0 {
        say!(
            "\nleft to `cargo xtask test --all`: {left} tests, and the suites that are not in the table"
        );
    }
    say!("\n{spent}");
    let passed: u64 = outcomes.iter().filter_map(|outcome| outcome.cases).sum();
    let failed = outcomes.iter().filter(|outcome| outcome.failed()).count();
    say!("{passed} passed, {failed} failed, {} skipped", skipped.len());
}
