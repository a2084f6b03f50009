//! Suites that wait to be run: as many at a time as the machine has cores, each captured, one line as each ends.

use std::collections::VecDeque;
use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::sync::{Condvar, Mutex, MutexGuard, OnceLock, PoisonError};
use std::time::Instant;

use xtask::run::{TOOL, built, program, root};

use super::CASES;
use super::cost::{read_page, stated_of};
use super::outcome::Outcome;
use super::programs::{Program, optimisation};
use super::suites::{DOCUMENTATION, How, SUITES};
use crate::measured;
use crate::members::Members;
use crate::program::{self as command, DISTRIBUTE};

/// What is run: a name, a program, its arguments, its folder.
pub(crate) struct Job {
    name: String,
    program: PathBuf,
    arguments: Vec<String>,
    folder: PathBuf,
    is_test: bool,
    /// Whether its long tests are run, too.
    long: bool,
}

impl Job {
    /// A test program, with its long tests or without.
    pub(crate) fn program(built: Program, long: bool) -> Self {
        Self {
            name: format!("{} {}", built.package, built.target),
            program: built.path,
            arguments: Vec::new(),
            folder: built.folder,
            is_test: true,
            long,
        }
    }

    /// A command of the workbench.
    pub(crate) fn command(name: String, words: &[&str]) -> Self {
        let arguments = words.iter().map(|word| (*word).to_owned()).collect();
        // Without cargo: a build of something else is not waited for.
        let here = || std::env::current_exe().unwrap_or_else(|_| PathBuf::from("xtask"));
        let program = words.first().and_then(|word| command::Program::of_command(word));
        let program = program.and_then(|program| program.path().ok()).unwrap_or_else(here);
        Self { name, program, arguments, folder: root(), is_test: false, long: false }
    }

    /// The examples in the documentation; those of the solver by themselves where they are compiled with lanes.
    pub(crate) fn documentation(all: bool) -> Vec<Self> {
        let groups: &[_] =
            if all { &[Members::Plain, Members::InLanes] } else { &[Members::Plain] };
        groups.iter().map(|members| Self::documentation_of(*members, all)).collect()
    }

    fn documentation_of(members: Members, all: bool) -> Self {
        let name = format!("{DOCUMENTATION}{}", members.says());
        let mut arguments: Vec<_> = ["test", "--doc", "--no-fail-fast"].map(str::to_owned).to_vec();
        let libraries =
            libraries().filter(|package| Members::of_target(package, "lib", all) == members);
        arguments.extend(libraries.flat_map(|package| ["--package", package]).map(str::to_owned));
        if all && members == Members::Plain {
            // Its features of `zip` are those that the desktop tool was compiled with for the tests.
            arguments.extend(["--package", DISTRIBUTE.package].map(str::to_owned));
        }
        arguments.extend(members.features(all).iter().map(|word| (*word).to_owned()));
        arguments.extend(optimisation(all).map(str::to_owned));
        Self {
            name,
            program: PathBuf::from(program()),
            arguments,
            folder: root(),
            is_test: false,
            long: false,
        }
    }

    /// Runs it to its end.
    fn ended(self, all: bool, tool: Option<&PathBuf>) -> Outcome {
        let begun = Instant::now();
        // What it takes is noted in a file of its own.
        let notes = tempfile::NamedTempFile::new();
        let mut command = match (std::env::current_exe(), &notes) {
            (Ok(this), Ok(notes)) => {
                let mut command = Command::new(this);
                command.env(measured::VARIABLE, notes.path()).arg(&self.program);
                command
            }
            _ => Command::new(&self.program),
        };
        command.args(&self.arguments).current_dir(&self.folder).stdin(Stdio::null());
        if all {
            command.env(CASES, "all");
        }
        command.envs(tool.map(|tool| (TOOL, tool)));
        if self.is_test {
            command.env("CARGO_MANIFEST_DIR", &self.folder).env("CARGO", program());
            command.args(self.long.then_some("--include-ignored"));
            // `cargo xtask accuracy` runs that one, which writes a file for it.
            command.args(["--skip", "figures_for_the_accuracy_page"]);
        }
        let output = command.output();
        let cpu =
            notes.ok().map(|notes| measured::read(notes.path()).iter().map(|(_, cpu)| cpu).sum());
        let seconds = begun.elapsed().as_secs_f64();
        match output {
            Ok(output) => {
                let outcome = Outcome::from_output(&self.name, &output, seconds, cpu);
                if outcome.failed() {
                    eprintln!(
                        "{}{}",
                        String::from_utf8_lossy(&output.stdout),
                        String::from_utf8_lossy(&output.stderr)
                    );
                }
                outcome
            }
            Err(error) => {
                eprintln!("error: {} did not start: {error}", self.program.display());
                Outcome::not_started(&self.name)
            }
        }
    }
}

/// The packages whose library has tests; their documentation has examples.
fn libraries() -> impl Iterator<Item = &'static str> {
    SUITES.iter().filter_map(|suite| match suite.how {
        How::Target { package, target: "lib" } => Some(package),
        _ => None,
    })
}

/// Jobs that wait, and what became of those that ended.
pub(crate) struct Queue {
    all: bool,
    waiting: Mutex<Waiting>,
    changed: Condvar,
    ended: Mutex<Vec<Outcome>>,
    /// The desktop tool, once it is built: whoever builds it with other settings would replace it under the tests.
    tool: OnceLock<PathBuf>,
}

#[derive(Default)]
struct Waiting {
    jobs: VecDeque<Job>,
    /// Nothing will be added.
    closed: bool,
}

impl Queue {
    pub(crate) fn new(all: bool) -> Self {
        Self {
            all,
            waiting: Mutex::default(),
            changed: Condvar::new(),
            ended: Mutex::default(),
            tool: OnceLock::new(),
        }
    }

    /// Adds jobs for the workers, who begin with what takes longest.
    pub(crate) fn add(&self, jobs: impl IntoIterator<Item = Job>) {
        let page = read_page().unwrap_or_default();
        let stated = |job: Job| (stated_of(&page, &job.name), job);
        let mut jobs: Vec<_> = jobs.into_iter().map(stated).collect();
        jobs.sort_by(|a, b| b.0.total_cmp(&a.0));
        held(&self.waiting).jobs.extend(jobs.into_iter().map(|(_, job)| job));
        self.changed.notify_all();
    }

    /// The desktop tool is built.
    pub(crate) fn has_tool(&self, is_built: bool) {
        if let (true, Ok(tool)) = (is_built, built("precess")) {
            self.tool.get_or_init(|| tool);
        }
    }

    /// Lets the workers end when nothing waits.
    pub(crate) fn close(&self) {
        held(&self.waiting).closed = true;
        self.changed.notify_all();
    }

    /// Runs what is added, until the queue is closed and empty.
    pub(crate) fn work(&self) {
        loop {
            let mut waiting = held(&self.waiting);
            while waiting.jobs.is_empty() && !waiting.closed {
                waiting = self.changed.wait(waiting).unwrap_or_else(PoisonError::into_inner);
            }
            let Some(job) = waiting.jobs.pop_front() else { return };
            drop(waiting);
            self.run(job);
        }
    }

    /// Runs a job, and says how it ended.
    pub(crate) fn run(&self, job: Job) -> bool {
        let outcome = job.ended(self.all, self.tool.get());
        eprintln!("{}", outcome.line());
        let passed = outcome.passed;
        held(&self.ended).push(outcome);
        passed
    }

    /// What became of the jobs.
    pub(crate) fn outcomes(self) -> Vec<Outcome> {
        self.ended.into_inner().unwrap_or_else(PoisonError::into_inner)
    }
}

/// What a lock guards, also after a panic of another thread: an outcome is pushed whole.
pub(super) fn held<T>(lock: &Mutex<T>) -> MutexGuard<'_, T> {
    lock.lock().unwrap_or_else(PoisonError::into_inner)
}
