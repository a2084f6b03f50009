//! Mutation against physics: one term of one emitted function is wrong, and a law of physics shows
//! it. Pure; the engines' stored values are read by the caller.
//!
//! A mutant drops or flips one operand of one sum, or exchanges one sine for its cosine, in what an
//! emitted function computes (the graph it is printed from). Only that function is changed: the laws
//! hold between functions, and the others stay right. What depends on parameters only is computed
//! once, in `prepare`, for all of them: changed there, it is changed in every function.
//!
//! A mutant that no law notices is a hole in the laws, or it is the same function written otherwise,
//! which its normal form shows. The derivation is used for nothing else.

mod device;
mod energy_momentum;
mod equivalence;
mod listing;
mod physics;
mod report;
mod site;
mod state;
mod tape;

pub use listing::Computed;
pub use physics::{EngineError, Engines, Kind, Law};
pub use report::{MutantStatus, Outcome, Report, Tally};
pub use site::{Change, Mutant};

use std::fmt;

use device::{Device, Fault};
use listing::Listing;
use physics::{Trial, residuals};
use site::{Site, sites};
use state::{CaseName, Random};

use precess_codegen::derivation::chain::Chain;
use precess_codegen::graph::Graph;
use precess_codegen::kinds;
use precess_codegen::threads::side_by_side;

/// A residual above this kills. The right functions leave some 1e-12 (rounding over the step of a
/// difference, and the engines' own), a wrong term of order one leaves some 1e-3 and more; the page
/// states both margins.
pub const NOTICED: f64 = 1e-8;

/// How many random states every mutant is put through: one would do but for chance cancellation.
/// What depends on the joints' modes is put through two more.
const TRIALS: u64 = 3;

/// Which mutants to make.
#[derive(Clone, Copy, Debug)]
pub struct Selection<'a> {
    /// Of this function only.
    pub kernel: Option<&'a str>,
    /// Of them, every so many: 1 is all.
    pub every: usize,
}

/// Why there is nothing to report.
#[derive(Debug)]
pub enum MutationError {
    /// No function has this name.
    NoKernel {
        /// The name.
        name: String,
        /// The names there are.
        known: Vec<String>,
    },
    /// The right functions break a law: what the laws say of wrong ones is worth nothing.
    Broken {
        /// The kind.
        kind: &'static str,
        /// The law.
        law: Law,
        /// Its residual.
        residual: f64,
    },
}

impl MutationError {
    fn no_kernel(name: &str, listings: &[Listing<'_>]) -> Self {
        let known = listings.iter().map(|listing| listing.name.clone());
        Self::NoKernel { name: name.to_owned(), known: known.collect() }
    }
}

impl fmt::Display for MutationError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoKernel { name, known } => {
                write!(f, "no function is called `{name}`; choose one of {}", known.join(", "))
            }
            Self::Broken { kind, law, residual } => write!(
                f,
                "unchanged functions of `{kind}` leave {residual:.1e} of `{law}`, above {NOTICED:e}; mend them, \
                 or the law, first"
            ),
        }
    }
}

impl std::error::Error for MutationError {}

/// What is reported on the way, from any of the threads.
#[derive(Clone, Copy, Debug)]
pub enum Progress {
    /// So many more mutants will be made.
    Found(usize),
    /// One is done.
    Done,
}

/// Makes the mutants of several kinds, each on a thread of its own; see [`mutate`].
///
/// # Errors
/// As for one kind; of several, that of the first.
pub fn mutate_all(
    kinds: &[&'static kinds::Kind],
    engines: &Engines,
    selection: &Selection<'_>,
    progress: &(dyn Fn(Progress) + Sync),
) -> Result<Vec<Report>, MutationError> {
    let reports = side_by_side(kinds, |kind| mutate(kind, engines, selection, progress));
    reports.into_iter().collect()
}

/// Makes the mutants of a kind's functions and puts each to every law it can break. The engines'
/// values count where they are of this kind.
///
/// # Errors
/// When a function is not there, chosen or read by a law, or when the unchanged ones break a law.
pub fn mutate(
    kind: &'static kinds::Kind,
    engines: &Engines,
    selection: &Selection<'_>,
    progress: &(dyn Fn(Progress) + Sync),
) -> Result<Report, MutationError> {
    let graph = Graph::new();
    let chain = Chain::new(&graph, kind);
    let device = Device::new(&chain)?;
    let trials = trials(kind);
    let right = Fault::default();
    let floors = residuals(&device, &trials, engines, &right, None);
    if let Some(&(law, residual)) = floors.iter().find(|(_, residual)| *residual > NOTICED) {
        return Err(MutationError::Broken { kind: kind.name, law, residual });
    }
    let chosen = chosen(&device, selection)?;
    let mut outcomes = Vec::with_capacity(chosen.len());
    progress(Progress::Found(chosen.len()));
    for (index, site) in chosen {
        let role = device.role(index);
        let fault = device.fault(&right, index, &site);
        let signals = residuals(&device, &trials, engines, &fault, role);
        let killed = signals.iter().any(|(_, residual)| *residual > NOTICED);
        let status = if killed {
            MutantStatus::Killed
        } else if equivalence::is_the_same(&device, index, &site) {
            MutantStatus::Equivalent
        } else {
            MutantStatus::Survivor
        };
        outcomes.push(Outcome { mutant: site.mutant, signals, status });
        progress(Progress::Done);
    }
    let computed = device.listings.iter().flat_map(Listing::computed);
    let engines = engines.count(kind);
    Ok(Report { kind, outcomes, computed: computed.collect(), floors, engines })
}

/// States with every joint driven, then two with mixed modes in which each joint is once driven and
/// once given its acceleration.
fn trials(kind: &kinds::Kind) -> Vec<Trial> {
    let trial = |seed, mixed| {
        let (mut random, bodies) = (Random::new(seed), kind.links.len());
        let case = random.case(kind, CaseName::Drawn { seed, mixed });
        let any = random.accelerations(bodies);
        let probe = random.probe(bodies);
        (Trial { case, any, mixed, probe }, random)
    };
    let mixed = |(seed, first): (u64, usize)| {
        let (mut trial, mut random) = trial(seed, true);
        trial.case.drive.modes = random.modes(kind, first);
        trial
    };
    let driven = (0..TRIALS).map(|seed| trial(seed, false).0);
    driven.chain([(0, 0), (1, 1)].map(mixed)).collect()
}

/// The sites of a selection, each with the number of its function.
fn chosen(
    device: &Device<'_, '_>,
    selection: &Selection<'_>,
) -> Result<Vec<(usize, Site)>, MutationError> {
    if let Some(name) = selection.kernel
        && !device.listings.iter().any(|listing| listing.name == name)
    {
        return Err(MutationError::no_kernel(name, &device.listings));
    }
    let meant = |name: &str| selection.kernel.is_none_or(|kernel| kernel == name);
    let listings = device.listings.iter().enumerate().filter(|(_, listing)| meant(&listing.name));
    let every = listings.flat_map(|(index, listing)| {
        let found = sites(device.chain.graph, listing);
        found.into_iter().map(move |site| (index, site))
    });
    Ok(every.step_by(selection.every.max(1)).collect())
}
