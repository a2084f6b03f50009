//! `test`: most promises, each once; with `--all` everything; with `--for` what a change can break.
//!
//! Test programs are built first and then run, as many at a time as there are cores. What is built for others (boards,
//! Python, reports) goes on beside them, in build folders of its own. What each suite took is in a table at the
//! end.

mod cost;
mod description;
mod outcome;
mod programs;
mod queue;
mod suites;
mod table;
mod when;

#[cfg(test)]
mod complete;
#[cfg(test)]
mod names;

use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::thread;
use std::time::Instant;

use clap::Args;
use xtask::run::{root, target};
use xtask::say;

use crate::measured::of_children;
use crate::members::Members;
use crate::program::{DERIVE, DISTRIBUTE, SITE};
use outcome::Outcome;
use programs::Program;
pub(crate) use programs::optimisation;
use queue::{Job, Queue, held};
use suites::{How, SUITES, Suite, When};

/// Options of `test`.
#[derive(Args)]
pub(crate) struct Options {
    /// Test everything that is asserted anywhere: every mutant, lanes, boards, Python, engines, reports in a browser
    #[arg(long)]
    all: bool,
    /// Only the suites that a change of this file or folder can break
    #[arg(long = "for", value_name = "PATH")]
    path: Option<PathBuf>,
    /// Print the suites that would run, and stop
    #[arg(long)]
    list: bool,
    /// Write what each suite took to docs/testing.md
    #[arg(long, requires = "all", conflicts_with_all = ["path", "list"])]
    write: bool,
}

/// The variable by which tests take every case, as `all`, and not a tenth.
pub(crate) const CASES: &str = "PRECESS_TESTS";

/// Runs the suites, and prints what each took.
pub(crate) fn test(options: &Options) -> Result<(), String> {
    let chosen = chosen(options)?;
    if options.list {
        for suite in &chosen {
            say!("{}: {}", suite.name(), suite.says());
        }
        return Ok(());
    }
    let begun = Instant::now();
    let notes = notes()?;
    let mut outcomes = run(&chosen, options, &notes)?;
    outcomes.sort_by_key(|outcome| chosen.iter().position(|suite| suite.name() == outcome.name));
    let spent = cost::Spent::measure(begun.elapsed().as_secs_f64(), of_children(), &notes)?;
    table::print(&outcomes, &spent);
    let failed = outcomes.iter().filter(|outcome| outcome.failed()).count();
    if failed > 0 {
        let lines = outcomes.iter().filter(|outcome| outcome.failed());
        let lines =
            lines.map(|outcome| format!("\n  {}: {}", outcome.name, outcome.failures.join("; ")));
        let lines: String = lines.collect();
        return Err(format!("{failed} of {} suites failed:{lines}", outcomes.len()));
    }
    if options.write {
        return cost::write(&outcomes, &spent);
    }
    if options.all && options.path.is_none() { cost::held(&spent) } else { Ok(()) }
}

impl Options {
    /// Whether everything is run that a change there can break.
    fn is_for_a_folder(&self) -> bool {
        self.all && self.path.is_some()
    }
}

/// The suites that the options choose.
fn chosen(options: &Options) -> Result<Vec<&'static Suite>, String> {
    let is_for_a_folder = options.is_for_a_folder();
    // A smaller check than one that runs, too, is left out: a sample of the mutants beside all of them.
    let wanted = |suite: &&Suite| match suite.when {
        When::Always | When::AlwaysShort => true,
        When::All => options.all,
        When::AllFor => is_for_a_folder,
        When::Sample => !is_for_a_folder,
    };
    let Some(path) = &options.path else { return Ok(SUITES.iter().filter(wanted).collect()) };
    let path = from_root(path)?;
    let chosen: Vec<_> =
        SUITES.iter().filter(wanted).filter(|suite| suite.can_break(&path)).collect();
    if chosen.is_empty() {
        return Err(format!("no suite can be broken by a change of {}", path.display()));
    }
    Ok(chosen)
}

/// A path from the repository's root, which it has to be in.
fn from_root(path: &Path) -> Result<PathBuf, String> {
    let wrong = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
    // As the caller sees it, or from the root; a file that is gone has been changed, too.
    for place in [path.to_path_buf(), root().join(path)] {
        let whole = place.canonicalize().or_else(|_| std::path::absolute(&place));
        let whole = whole.map_err(|error| wrong(&error))?;
        if let Ok(inner) = whole.strip_prefix(root()) {
            return Ok(inner.to_path_buf());
        }
    }
    Err(wrong(&format!("not in {}", root().display())))
}

/// The file in which rustc and the suites note what they take: empty.
fn notes() -> Result<PathBuf, String> {
    let file = target()?.join("measured.txt");
    std::fs::write(&file, "").map_err(|error| format!("{}: {error}", file.display()))?;
    Ok(file)
}

/// Runs suites: what checks the generated files before anything compiles them, what is built for others beside the
/// rest.
fn run(chosen: &[&'static Suite], options: &Options, notes: &Path) -> Result<Vec<Outcome>, String> {
    let all = options.all;
    let queue = Queue::new(all);
    let commands = |first: bool| {
        let some = chosen.iter().filter_map(|suite| match suite.how {
            How::Command(words) => Some((suite, words)),
            _ => None,
        });
        let some = some.filter(|(_, words)| FIRST.contains(&words[0]) == first);
        some.map(|(suite, words)| Job::command(suite.name(), words)).collect::<Vec<_>>()
    };
    built_for(chosen, all, notes)?;
    if !commands(true).into_iter().all(|job| queue.run(job)) {
        return Ok(queue.outcomes());
    }
    // Two at a time: the last of them would leave a core without work.
    let others = Mutex::new(commands(false).into_iter());
    let beside = || {
        let next = || held(&others).next();
        while let Some(job) = next() {
            queue.run(job);
        }
    };
    thread::scope(|scope| {
        for _ in 0..thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(|| queue.work());
        }
        let built = [Members::Plain, Members::InLanes].into_iter().try_for_each(
            |members| -> Result<(), String> {
                let of_group = of_group(chosen, members, all);
                let built = programs::build(members, &of_group, all, notes)?;
                // Two libraries of a command are built with all that it selects: what no row names is not run.
                let wanted = |program: &Program| {
                    of_group.iter().any(|suite| suite.is(&program.package, &program.target))
                };
                let is_short = |program: &Program| {
                    let short = of_group.iter().filter(|suite| suite.when == When::AlwaysShort);
                    let mut short = short.map(|suite| suite.is(&program.package, &program.target));
                    !options.is_for_a_folder() && short.any(|is| is)
                };
                let job = |program: Program| {
                    let long = all && !is_short(&program);
                    Job::program(program, long)
                };
                queue.add(built.into_iter().filter(wanted).map(job));
                if members == Members::Plain {
                    if chosen.iter().any(|suite| matches!(suite.how, How::Command(["engines"]))) {
                        // The engine's library, which units are linked with.
                        programs::build_libraries(members, &of_group, all, notes)?;
                    }
                    // They use the desktop tool as it is tested.
                    queue.has_tool(of_group.iter().any(|suite| suite.is_of("precess")));
                    scope.spawn(beside);
                    scope.spawn(beside);
                }
                Ok(())
            },
        );
        if built.is_ok() && chosen.iter().any(|suite| suite.how == How::Documentation) {
            queue.add(Job::documentation(all));
        }
        queue.close();
        built
    })?;
    Ok(queue.outcomes())
}

/// Builds the programs of the commands, so that whoever waits sees cargo's progress.
fn built_for(chosen: &[&'static Suite], all: bool, notes: &Path) -> Result<(), String> {
    [DERIVE, DISTRIBUTE, SITE].into_iter().try_for_each(|program| {
        let needs = |suite: &&Suite| {
            matches!(suite.how, How::Command(words) if program.is_needed_by(words[0]))
        };
        let options = optimisation(all);
        if chosen.iter().any(needs) { program.build(options, Some(notes)) } else { Ok(()) }
    })
}

/// The suites whose programs are built by the command of a group.
fn of_group(chosen: &[&'static Suite], members: Members, all: bool) -> Vec<&'static Suite> {
    let is_of = |suite: &&Suite| matches!(suite.how, How::Target { package, target } if Members::of_target(package, target, all) == members);
    chosen.iter().copied().filter(is_of).collect()
}

/// Commands that everything else waits for.
const FIRST: [&str; 4] = ["lint", "regen", "bake", "mutate"];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_is_taken_from_the_root() {
        let root = root();
        assert_eq!(from_root(&root.join("sim/../docs")), Ok(PathBuf::from("docs")));
        assert_eq!(from_root(&root.join("docs/gone.md")), Ok(PathBuf::from("docs/gone.md")));
        let outside = from_root(&root.join("..")).unwrap_err();
        assert!(outside.contains("not in"), "{outside}");
    }

    #[test]
    fn every_mutant_is_in_all_for_the_generator_and_a_sample_elsewhere() {
        let names = |all: bool, path: Option<&str>| {
            let path = path.map(|path| root().join(path));
            let options = Options { all, path, list: false, write: false };
            chosen(&options).unwrap().iter().map(|suite| suite.name()).collect::<Vec<_>>()
        };
        let (every, sample) = ("mutate --check".to_owned(), "mutate --sample 100".to_owned());
        let (default, all) = (names(false, None), names(true, None));
        assert!(!default.contains(&"flight --check --quick".to_owned()), "{default:?}");
        assert!(all.contains(&"flight --check --quick".to_owned()), "{all:?}");
        for some in [default, all, names(false, Some("codegen"))] {
            assert!(some.contains(&sample) && !some.contains(&every), "{some:?}");
        }
        let whole = names(true, Some("codegen"));
        assert!(whole.contains(&every) && !whole.contains(&sample), "{whole:?}");
    }
}
