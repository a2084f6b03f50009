//! The campaign: chunks of cases of every property, on every core, until time is up.

use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Instant;

use proptest::test_runner::{Config, RngAlgorithm, TestCaseError, TestError, TestRng, TestRunner};

use super::code;
use super::progress::Progress;
use super::properties::Property;
use super::{Case, Checked, Verdict};
use precess_tests::random::Random;

/// What is called a failure when a property panics.
pub const NEVER_PANICS: &str = "never-panics";

/// After so many failures no more chunks of a property are tried in a run.
const ENOUGH: usize = 3;

/// How many cases were tried, and how many of them the property did not speak of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// Cases.
    pub cases: u64,
    /// Of those, cases that were no use.
    pub rejected: u64,
}

/// A case for which a property does not hold, as simple as it was found.
#[derive(Clone, Debug)]
pub struct Failure {
    /// The property.
    pub property: &'static Property,
    /// Whether it panicked.
    pub panicked: bool,
    /// The campaign's seed.
    pub seed: u64,
    /// The chunk.
    pub chunk: u64,
    /// Why it does not hold.
    pub message: String,
    /// The case.
    pub case: Case,
}

impl Failure {
    /// The property by which the failure is counted.
    #[must_use]
    pub fn name(&self) -> &'static str {
        if self.panicked { NEVER_PANICS } else { self.property.name }
    }

    /// The command that finds the failure again.
    #[must_use]
    pub fn command(&self) -> String {
        let Self { property, seed, chunk, .. } = self;
        format!("cargo xtask attack --property {} --seed {seed} --chunk {chunk}", property.name)
    }

    /// The failure as a file to paste.
    #[must_use]
    pub fn code(&self) -> String {
        let Self { property, seed, chunk, message, case, .. } = self;
        let name = format!("{}_{seed}_{chunk}", self.name().replace('-', "_"));
        let test = code::test(&name, property.function, case);
        let message = message.lines().fold(String::new(), |text, line| {
            text + "// "
                + line
                + "
"
        });
        let imports = code::imports(&test);
        format!(
            "{imports}\n// {}: {}\n// {}\n{message}{test}",
            self.name(),
            property.statement,
            self.command()
        )
    }
}

/// The seed of a chunk.
fn rng(property: &str, seed: u64, chunk: u64) -> TestRng {
    // FNV-1a of the name, so that a chunk's cases do not depend on which properties there are.
    let name = property.bytes().fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    });
    let mut random = Random::new(name ^ Random::new(seed).bits().rotate_left(17));
    let start = random.bits().wrapping_add(chunk);
    let mut random = Random::new(start);
    let bytes: Vec<u8> = (0..4).flat_map(|_| random.bits().to_le_bytes()).collect();
    TestRng::from_seed(RngAlgorithm::ChaCha, &bytes)
}

/// The verdict, a panic as a failure.
fn checked(property: &Property, case: &Case) -> (Verdict, bool) {
    match catch_unwind(AssertUnwindSafe(|| (property.check)(case))) {
        Ok(verdict) => (verdict, false),
        Err(payload) => {
            let text = payload
                .downcast_ref::<String>()
                .cloned()
                .or_else(|| payload.downcast_ref::<&str>().map(|text| (*text).to_owned()));
            (Err(format!("panicked: {}", text.unwrap_or_default())), true)
        }
    }
}

/// Tries a chunk of a property: so many cases of its own seed.
///
/// # Panics
/// If no case can be drawn.
#[must_use]
pub fn chunk(
    property: &'static Property,
    seed: u64,
    chunk: u64,
    cases: u32,
) -> (Tally, Option<Failure>) {
    let config = Config {
        cases,
        failure_persistence: None,
        max_shrink_iters: 20_000,
        max_shrink_time: 20_000,
        verbose: 0,
        ..Config::default()
    };
    let mut runner = TestRunner::new_with_rng(config, rng(property.name, seed, chunk));
    let tally = Mutex::new(Tally::default());
    let tried = runner.run(&(property.draw)(), |case| {
        let (verdict, _) = checked(property, &case);
        if let Ok(mut tally) = tally.lock() {
            tally.cases += 1;
            tally.rejected += u64::from(verdict == Ok(Checked::Rejected));
        }
        verdict.map(|_| ()).map_err(TestCaseError::fail)
    });
    let tally = tally.into_inner().unwrap_or_default();
    let failure = match tried {
        Ok(()) => None,
        Err(TestError::Fail(reason, case)) => {
            let (verdict, panicked) = checked(property, &case);
            let message = verdict.err().unwrap_or_else(|| reason.to_string());
            Some(Failure { property, panicked, seed, chunk, message, case })
        }
        Err(TestError::Abort(reason)) => panic!("{}: {reason}", property.name),
    };
    (tally, failure)
}

/// What is tried, and until when.
#[derive(Clone, Debug)]
pub struct Campaign {
    /// The seed.
    pub seed: u64,
    /// The properties.
    pub properties: Vec<&'static Property>,
    /// When no further chunk is begun.
    pub deadline: Instant,
    /// How many threads.
    pub threads: usize,
}

/// What a campaign found of one property.
#[derive(Clone, Debug, Default)]
pub struct PropertyResult {
    /// Its cases.
    pub tally: Tally,
    /// Its failures.
    pub failures: Vec<Failure>,
}

impl Campaign {
    /// Tries chunk after chunk, each property in turn; `tried` is called after every chunk.
    #[must_use]
    pub fn run(
        &self,
        progress: &Mutex<Progress>,
        tried: impl Fn(&'static Property, Tally, Option<&Failure>) + Sync,
    ) -> BTreeMap<&'static str, PropertyResult> {
        let next = AtomicU64::new(0);
        let rows = Mutex::new(BTreeMap::<&'static str, PropertyResult>::new());
        std::thread::scope(|scope| {
            for _ in 0..self.threads {
                scope.spawn(|| self.work(&next, progress, &rows, &tried));
            }
        });
        rows.into_inner().unwrap_or_default()
    }

    fn work(
        &self,
        next: &AtomicU64,
        progress: &Mutex<Progress>,
        rows: &Mutex<BTreeMap<&'static str, PropertyResult>>,
        tried: &(impl Fn(&'static Property, Tally, Option<&Failure>) + Sync),
    ) {
        let many = self.properties.len() as u64;
        let mut passed_over = 0;
        while Instant::now() < self.deadline && passed_over < many {
            let turn = next.fetch_add(1, Ordering::Relaxed);
            let Some(property) = usize::try_from(turn % many)
                .ok()
                .and_then(|index| self.properties.get(index).copied())
            else {
                return;
            };
            let failed = |rows: &BTreeMap<&'static str, PropertyResult>| {
                rows.get(property.name).map_or(0, |row| row.failures.len())
            };
            if rows.lock().is_ok_and(|rows| failed(&rows) >= ENOUGH) {
                passed_over += 1;
                continue;
            }
            passed_over = 0;
            let Ok(number) = progress.lock().map(|mut all| all.begin(self.seed, property.name))
            else {
                return;
            };
            let (tally, failure) = chunk(property, self.seed, number, property.cases);
            tried(property, tally, failure.as_ref());
            if let Ok(mut rows) = rows.lock() {
                let row = rows.entry(property.name).or_default();
                row.tally.cases += tally.cases;
                row.tally.rejected += tally.rejected;
                row.failures.extend(failure);
            }
            if let Ok(mut all) = progress.lock() {
                all.finish(self.seed, property.name, number);
            }
        }
    }
}
