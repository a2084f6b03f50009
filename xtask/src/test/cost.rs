//! What a run took: CPU time, disk, and which crates; the page that states it, and the bound that follows.

use std::fmt;
use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use xtask::files::write as write_files;
use xtask::run::{root, target};

use super::outcome::Outcome;
use super::suites::{SUITES, When};
use crate::measured;

/// The page.
const PAGE: &str = "docs/testing.md";
/// Its part that is written by `--write`, between these lines.
const BEGIN: &str = "<!-- Written by `cargo xtask test --all --write`. -->";
const END: &str = "<!-- End of what is written. -->";
/// The row of the page that states the budget.
const BUDGET: &str = "| `cargo xtask test --all` |";
/// The budget may be exceeded by this factor.
const MARGIN: f64 = 1.2;
/// Crates that take less are not on the page, CPU s.
const SMALL: f64 = 5.0;
/// Crates of others that are on the page: nobody here makes them grow, so what they take tells how slow the machine is.
const OF_OTHERS: [&str; 5] = ["nalgebra", "pulp", "simba", "syn", "wide"];
/// A machine is taken to be so many times as slow as that of the page at most.
const SLOWEST: f64 = 1.5;

/// What a run took.
#[derive(Clone, Debug)]
pub(crate) struct Spent {
    /// s.
    wall: f64,
    /// CPU time of everything that was started, s; none where the operating system does not tell.
    cpu: Option<f64>,
    /// Size of the build folder, bytes.
    disk: u64,
    /// CPU time of rustc by crate, s, largest first.
    crates: Vec<(String, f64)>,
}

impl Spent {
    /// Measures what is left to be measured.
    pub(crate) fn measure(wall: f64, cpu: Option<f64>, notes: &Path) -> Result<Self, String> {
        Ok(Self { wall, cpu, disk: size(&target()?), crates: measured::read(notes) })
    }
}

impl fmt::Display for Spent {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:.1} min", self.wall / 60.0)?;
        if let Some(cpu) = self.cpu {
            let compiled: f64 = self.crates.iter().map(|(_, cpu)| cpu).sum();
            write!(f, ", {:.1} CPU min ({:.1} of them rustc)", cpu / 60.0, compiled / 60.0)?;
        }
        write!(f, ", {:.1} GB in the build folder", gigabytes(self.disk))
    }
}

#[expect(clippy::cast_precision_loss, reason = "printed to a tenth")]
fn gigabytes(bytes: u64) -> f64 {
    bytes as f64 / 1e9
}

/// Bytes of all files below a folder. A file with several names counts once for each.
fn size(folder: &Path) -> u64 {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let sizes = entries.map(|entry| match entry.metadata() {
        Ok(data) if data.is_dir() => size(&entry.path()),
        Ok(data) => data.len(),
        Err(_) => 0,
    });
    sizes.sum()
}

/// Budget of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Budget {
    /// CPU min.
    cpu: f64,
    /// GB.
    disk: f64,
}

impl Budget {
    /// As the page states it: minutes, CPU minutes, GB in the cells after the command.
    fn read(page: &str) -> Option<Self> {
        let row = page.lines().find(|line| line.starts_with(BUDGET))?;
        let mut cells =
            row.strip_prefix(BUDGET)?.split('|').skip(1).map(|cell| cell.trim().parse::<f64>());
        Some(Self { cpu: cells.next()?.ok()?, disk: cells.next()?.ok()? })
    }
}

/// Fails where the budget of the page is exceeded by more than a fifth.
pub(crate) fn held(spent: &Spent) -> Result<(), String> {
    let page = read_page()?;
    let budget = Budget::read(&page).ok_or_else(|| format!("{PAGE} has no row `{BUDGET} ...`"))?;
    compare(spent, budget, &stated(&page))
}

fn compare(spent: &Spent, budget: Budget, stated: &[(String, f64)]) -> Result<(), String> {
    let disk = gigabytes(spent.disk);
    let cpu = spent.cpu.unwrap_or(0.0) / 60.0;
    let slow = slowness(&spent.crates, stated);
    let (what, value, bound) = if cpu > MARGIN * slow * budget.cpu {
        ("CPU minutes", cpu / slow, budget.cpu)
    } else if disk > MARGIN * budget.disk {
        ("GB of disk", disk, budget.disk)
    } else {
        return Ok(());
    };
    Err(format!(
        "the tests took {value:.1} {what}, a fifth more than the budget of {bound:.1} on {PAGE}; what grew: {}. Take \
         as much out elsewhere, or raise the budget with its reason",
        grown(&spent.crates, stated)
    ))
}

/// How many times the page's CPU seconds crates of others took: one for a machine that is as fast, or has none of them.
fn slowness(crates: &[(String, f64)], stated: &[(String, f64)]) -> f64 {
    let of = |list: &[(String, f64)], name: &str| {
        list.iter().find(|(known, _)| known == name).map(|(_, cpu)| *cpu)
    };
    let both = OF_OTHERS.iter().filter_map(|name| Some([of(crates, name)?, of(stated, name)?]));
    let [spent, stated] = both.fold([0.0, 0.0], |sum, row| [sum[0] + row[0], sum[1] + row[1]]);
    if stated > 0.0 { (spent / stated).clamp(1.0, SLOWEST) } else { 1.0 }
}

/// The crates that took most beyond what the page states.
fn grown(crates: &[(String, f64)], stated: &[(String, f64)]) -> String {
    let before =
        |name: &str| stated.iter().find(|(known, _)| known == name).map_or(0.0, |(_, cpu)| *cpu);
    let mut grown: Vec<_> = crates.iter().map(|(name, cpu)| (cpu - before(name), name)).collect();
    grown.sort_by(|a, b| b.0.total_cmp(&a.0));
    let first = grown.iter().take(3).filter(|(more, _)| *more > SMALL);
    let first: Vec<_> = first.map(|(more, name)| format!("{name} by {more:.0} CPU s")).collect();
    if first.is_empty() {
        "no crate by itself; see the table of suites".to_owned()
    } else {
        first.join(", ")
    }
}

/// The crates of the page and their CPU seconds.
fn stated(page: &str) -> Vec<(String, f64)> {
    let written = page.split_once(BEGIN).map_or("", |(_, rest)| rest);
    let rows =
        written.lines().filter_map(|line| line.strip_prefix("| rustc: ")?.strip_suffix(" |"));
    rows.filter_map(|row| {
        row.split_once(" | ").and_then(|(name, cpu)| Some((name.to_owned(), cpu.parse().ok()?)))
    })
    .collect()
}

/// CPU seconds of a suite as the page states them, so that what takes longest is begun first; 0 if it has no row.
pub(crate) fn stated_of(page: &str, suite: &str) -> f64 {
    let begin = format!("| `{suite}` |");
    let row = page.lines().find_map(|line| line.strip_prefix(&begin));
    let cell = row.and_then(|row| row.split(" | ").nth(2)).map(str::trim);
    cell.and_then(|cell| cell.parse().ok()).unwrap_or(0.0)
}

/// Writes what a run took to the page.
pub(crate) fn write(outcomes: &[Outcome], spent: &Spent) -> Result<(), String> {
    let page = read_page()?;
    let (before, rest) =
        page.split_once(BEGIN).ok_or_else(|| format!("{PAGE} has no line `{BEGIN}`"))?;
    let (_, after) = rest.split_once(END).ok_or_else(|| format!("{PAGE} has no line `{END}`"))?;
    let text = format!("{before}{BEGIN}\n\n{}\n{END}{after}", tables(outcomes, spent));
    write_files([(PAGE, text.as_str())], &root())
}

/// One row for each suite, and one for each large crate.
fn tables(outcomes: &[Outcome], spent: &Spent) -> String {
    let mut text = String::from(
        "| suite | what it tests | cases | CPU s | in `cargo xtask test` |\n|---|---|--:|--:|---|\n",
    );
    // A sample has no row beside the whole.
    for suite in SUITES.iter().filter(|suite| suite.when != When::Sample) {
        let outcome = outcomes.iter().find(|outcome| outcome.name == suite.name());
        let cases = outcome
            .and_then(|outcome| outcome.cases)
            .map_or_else(String::new, |cases| cases.to_string());
        let cpu = outcome
            .and_then(|outcome| outcome.cpu)
            .map_or_else(String::new, |cpu| format!("{cpu:.0}"));
        let (name, says, when) = (suite.name(), suite.says(), suite.when.says());
        // A string takes any line.
        let _ = writeln!(text, "| `{name}` | {says} | {cases} | {cpu} | {when} |");
    }
    text += "\n| crate | CPU s |\n|---|--:|\n";
    for (name, cpu) in spent.crates.iter().filter(|(_, cpu)| *cpu >= SMALL) {
        let _ = writeln!(text, "| rustc: {name} | {cpu:.0} |");
    }
    text
}

/// The page as it is.
pub(crate) fn read_page() -> Result<String, String> {
    fs::read_to_string(root().join(PAGE)).map_err(|error| format!("cannot read {PAGE}: {error}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spent(cpu: f64, disk: u64) -> Spent {
        let crates = vec![("precess".to_owned(), 40.0), ("syn".to_owned(), 6.0)];
        Spent { wall: 60.0, cpu: Some(60.0 * cpu), disk, crates }
    }

    #[test]
    fn a_fifth_more_than_the_budget_is_an_error_that_names_what_grew() {
        let page = "| `cargo xtask test --all` | 30 | 50 | 10 | all |\n";
        let budget = Budget::read(page).unwrap();
        assert_eq!(budget, Budget { cpu: 50.0, disk: 10.0 });
        let stated = stated(&format!("{BEGIN}\n| rustc: precess | 30 |\n| rustc: syn | 6 |\n"));
        assert_eq!(compare(&spent(59.0, 11_000_000_000), budget, &stated), Ok(()));
        let message = compare(&spent(61.0, 0), budget, &stated).unwrap_err();
        assert!(message.contains("61.0 CPU minutes"), "{message}");
        assert!(message.contains("precess by 10 CPU s"), "{message}");
        assert!(!message.contains("syn"), "{message}");
        let message = compare(&spent(1.0, 12_100_000_000), budget, &stated).unwrap_err();
        assert!(message.contains("12.1 GB of disk"), "{message}");
    }

    #[test]
    fn a_slow_machine_may_take_as_much_more_as_crates_of_others_take() {
        let budget = Budget { cpu: 50.0, disk: 10.0 };
        let stated = |syn: f64| vec![("precess".to_owned(), 1.0), ("syn".to_owned(), syn)];
        // Six seconds where the page has five.
        assert_eq!(compare(&spent(71.0, 0), budget, &stated(5.0)), Ok(()));
        let message = compare(&spent(73.0, 0), budget, &stated(5.0)).unwrap_err();
        assert!(message.contains("60.8 CPU minutes"), "{message}");
        assert!(message.contains("precess by 39 CPU s"), "{message}");
        // Never less than the budget, never more than half more.
        assert_eq!(compare(&spent(59.0, 0), budget, &stated(60.0)), Ok(()));
        assert!(compare(&spent(91.0, 0), budget, &stated(0.1)).is_err());
    }

    #[test]
    fn the_page_states_a_budget_and_every_suite() {
        let page = read_page().unwrap();
        assert!(Budget::read(&page).is_some());
        for suite in SUITES.iter().filter(|suite| suite.when != When::Sample) {
            let row = format!("| `{}` | {} |", suite.name(), suite.says());
            assert!(
                page.contains(&row),
                "{PAGE} lacks `{row}`: run `cargo xtask test --all --write`"
            );
        }
    }
}
