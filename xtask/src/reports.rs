//! `reports`: builds the script and the style of the report from their sources, compares every file with the committed
//! one, and checks three pages in a browser: the sample, a run of Table 1, and a fit. Of the figures
//! that each command draws, in files and on pages, it measures the texts.

use std::collections::BTreeSet;
use std::env;
use std::fs;
use std::path::Path;
use std::process::Command;

use xtask::files::remove_folder;
use xtask::run::{is_there, output, root, run, run_there, target, tool};
use xtask::say;
use xtask::skip::skip;

/// The sources, with the programs that build and check.
const SOURCES: &str = "sim/report";

/// What the desktop tool contains.
const COMMITTED: &str = "sim/report/dist";

/// How the committed files become those of their sources.
const REMEDY: &str = "in sim/report, run `npm ci && npm run build`, and commit dist";

/// The run whose report is checked: its page has charts, replay and slow motion.
const SCENARIO: &str = "table1-printed-250";

/// The browser, where the variable `CHROMIUM` names no other.
const CHROMIUM: &str = "/usr/bin/chromium";

/// Compares the files, then checks the pages; what needs a program that is missing is skipped.
pub(crate) fn reports() -> Result<(), String> {
    let can_build = is_there("node") && is_there("npm");
    if !can_build {
        skip("script and style of the report against their sources", "apt-get install nodejs npm")?;
    }
    let browser = env::var("CHROMIUM").unwrap_or_else(|_| CHROMIUM.to_owned());
    let can_check = can_build && is_there(&browser);
    if !can_check {
        skip("pages of the report in a browser", "apt-get install nodejs npm chromium")?;
    }
    if !can_build {
        return Ok(());
    }
    let folder = target()?.join("reports");
    // Install scripts of packages are not run: neither the build nor the checks need them.
    // A connection that stalls is given up after half a minute, not five, and tried again.
    let packages = ["ci", "--ignore-scripts", "--no-audit", "--no-fund"];
    let retries = ["--fetch-timeout=30000", "--fetch-retries=5", "--fetch-retry-maxtimeout=10000"];
    run_there(node("npm", &packages).args(retries))?;
    let files = rebuild(&folder.join("dist"))?;
    let files = format!("reports: {files} files are those of their sources");
    if !can_check {
        say!("{files}");
        return Ok(());
    }
    let checks =
        check(&[], &folder.join("sample"))? + check_run(&folder)? + check_figures(&folder)?;
    say!("{files}, {checks} checks in the browser");
    Ok(())
}

/// Builds into a folder and compares with the committed files; returns how many there are.
fn rebuild(folder: &Path) -> Result<usize, String> {
    remove_folder(folder)?;
    run_there(node("node", &["build.mjs", "--out"]).arg(folder))?;
    let committed = root().join(COMMITTED);
    let names: BTreeSet<_> = [names(folder)?, names(&committed)?].into_iter().flatten().collect();
    let differing: Vec<_> = names
        .iter()
        .filter(|name| {
            let [built, there] = [folder, &committed].map(|folder| fs::read(folder.join(name)));
            !matches!((built, there), (Ok(built), Ok(there)) if built == there)
        })
        .map(|name| format!("{COMMITTED}/{name}"))
        .collect();
    if differing.is_empty() {
        return Ok(names.len());
    }
    Err(format!("not what the sources build: {}; {REMEDY}", differing.join(", ")))
}

/// Names of the files of a folder.
fn names(folder: &Path) -> Result<Vec<String>, String> {
    let wrong = |error| format!("cannot read {}: {error}", folder.display());
    let name = |entry: fs::DirEntry| entry.file_name().to_string_lossy().into_owned();
    let entries = fs::read_dir(folder).map_err(wrong)?;
    entries.map(|entry| entry.map(name).map_err(wrong)).collect()
}

/// Runs the scenario and checks its report; returns how many checks passed.
fn check_run(folder: &Path) -> Result<usize, String> {
    let scenario = format!("scenarios/{SCENARIO}.toml");
    let results = folder.join("run");
    let mut tool = Command::new(tool()?);
    run(tool.args(["run", &scenario, "--force", "--out"]).arg(&results))?;
    let page = results.join(format!("{SCENARIO}.html"));
    check(&["--page", &page.to_string_lossy()], &folder.join(SCENARIO))
}

/// Commands that write figures, and one of the files of each.
const PAGES: [(&[&str], &str); 9] = [
    (&["plot", "scenarios/every-kind.toml"], "every-kind-angular-velocity.svg"),
    (
        &["jitter", "scenarios/budgets/imaging-satellite-jitter.toml"],
        "imaging-satellite-jitter.html",
    ),
    (&["jitter", "scenarios/budgets/wheel-data-sheet-jitter.toml"], "wheel-data-sheet-jitter.html"),
    (&["margins", "scenarios/aliased-wheel.toml"], "aliased-wheel-margins.html"),
    (
        &[
            "sweep",
            "scenarios/wheel-data-sheet.toml",
            "--over",
            "device.rw.wheel.rate=600..6000 rpm:3",
        ],
        "wheel-data-sheet-sweep.html",
    ),
    // Three keys at once: their names together are longer than an axis.
    (
        &[
            "sweep",
            "scenarios/bus-three-wheels.toml",
            "--over",
            "device.wheel_x.wheel.rate+device.wheel_y.wheel.rate+device.wheel_z.wheel.rate=600..3000 rpm:2",
        ],
        "bus-three-wheels-sweep.html",
    ),
    (
        &[
            "montecarlo",
            "scenarios/wheel-data-sheet.toml",
            "--plan",
            "scenarios/plans/wheel-imbalance.toml",
            "--samples",
            "4",
        ],
        "wheel-data-sheet-montecarlo.html",
    ),
    (&["accelerance", "scenarios/imaging-satellite-modes.npz", "--at", "camera"], PHASES),
    (&["fit"], FIT),
];

/// Figures with a panel for each phase.
const PHASES: &str = "imaging-satellite-modes-accelerance-camera-translation-by-force.svg";

/// The page whose charts over speed and frequency are checked.
const FIT: &str = "rw-fit.html";

/// Exit codes of a command that has done its work: complete, a requirement is violated or a model does not hold, a
/// requirement could not be evaluated.
const DONE: [i32; 3] = [0, 2, 3];

/// Writes the figures of each command and measures the texts of all, in files and on pages; returns how many there are.
fn check_figures(folder: &Path) -> Result<usize, String> {
    let [results, example] = ["figures", "fit"].map(|name| folder.join(name));
    for folder in [&results, &example] {
        remove_folder(folder)?;
    }
    run(Command::new(tool()?).args(["fit", "--example"]).arg(&example))?;
    for (arguments, page) in PAGES {
        let mut tool = Command::new(tool()?);
        tool.args(arguments);
        if arguments == ["fit"] {
            tool.arg(example.join("wheel-measurement.toml"));
        }
        tool.arg("--out").arg(&results).current_dir(root());
        let ended = tool.output().map_err(|error| format!("{arguments:?}: {error}"))?;
        let page = results.join(page);
        if !(page.is_file() && ended.status.code().is_some_and(|code| DONE.contains(&code))) {
            let errors = String::from_utf8_lossy(&ended.stderr);
            return Err(format!("{arguments:?}, {}: {errors}", ended.status));
        }
    }
    let mut command = node("node", &["check-figures.mjs"]);
    let is_drawn = |name: &String| {
        Path::new(name).extension().is_some_and(|ending| ending == "svg" || ending == "html")
    };
    let mut files: Vec<_> = names(&results)?.into_iter().filter(is_drawn).collect();
    files.sort();
    command.args(files.iter().map(|name| results.join(name)));
    let printed = output(&mut command)?;
    eprint!("{printed}");
    let texts = passed(&printed);
    let texts = texts.ok_or_else(|| format!("check-figures.mjs printed no number: {printed}"))?;
    let page = results.join(FIT);
    Ok(texts + check(&["--page", &page.to_string_lossy()], &folder.join("fit-page"))?)
}

/// Checks a page and writes pictures into a folder; returns how many checks passed.
fn check(page: &[&str], pictures: &Path) -> Result<usize, String> {
    let mut command = node("node", &["check.mjs"]);
    let printed = output(command.args(page).arg("--out").arg(pictures))?;
    eprint!("{printed}");
    passed(&printed).ok_or_else(|| format!("check.mjs printed no number of checks: {printed}"))
}

/// The number that check.mjs prints at its end.
fn passed(printed: &str) -> Option<usize> {
    printed.lines().find_map(|line| line.split_once(" checks passed")?.0.parse().ok())
}

/// A program in the folder of the sources.
fn node(program: &str, arguments: &[&str]) -> Command {
    let mut command = Command::new(program);
    command.args(arguments).current_dir(root().join(SOURCES));
    command
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_number_of_checks_is_read() {
        assert_eq!(passed("416 checks passed; pictures in a folder\n"), Some(416));
        assert_eq!(passed("pictures in a folder\n"), None);
    }
}
