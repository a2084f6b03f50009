//! What became of every mutant, counted by function and by equation.

use super::NOTICED;
use super::listing::Computed;
use super::physics::{Kind, Law};
use super::site::Mutant;
use precess_codegen::kinds;

/// How a mutant ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MutantStatus {
    /// A law shows it.
    Killed,
    /// Its normal form is that of the right function: nothing is wrong with it.
    Equivalent,
    /// No law shows it: a hole.
    Survivor,
}

/// A mutant and what the laws said.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The mutant.
    pub mutant: Mutant,
    /// The largest residual of every law that a change of its function can move.
    pub signals: Vec<(Law, f64)>,
    /// How it ended.
    pub status: MutantStatus,
}

impl Outcome {
    /// Whether a law of this kind shows it.
    #[must_use]
    pub fn killed_by(&self, kind: Kind) -> bool {
        self.signal(kind) > NOTICED
    }

    /// Whether any law shows it.
    #[must_use]
    pub fn killed(&self) -> bool {
        self.status == MutantStatus::Killed
    }

    /// The largest residual of one kind of law; zero where none of the kind can see the function.
    #[must_use]
    pub fn signal(&self, kind: Kind) -> f64 {
        let of_kind = self.signals.iter().filter(|(law, _)| law.kind() == kind);
        of_kind.map(|(_, residual)| *residual).fold(0.0, f64::max)
    }
}

/// Every outcome, and what the unchanged functions leave.
#[derive(Clone, Debug)]
pub struct Report {
    /// The kind of device.
    pub kind: &'static kinds::Kind,
    /// In the order of the emitted text, `prepare` first.
    pub outcomes: Vec<Outcome>,
    /// What every function computes, in the same order, whether or not it can be made wrong.
    pub computed: Vec<Computed>,
    /// Residuals of the unchanged functions.
    pub floors: Vec<(Law, f64)>,
    /// How many spacecraft of the engines were compared with.
    pub engines: usize,
}

/// Numbers of mutants.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// All of them.
    pub mutants: usize,
    /// Shown by each kind of law, in the order of [`Kind::ALL`].
    pub killed: [usize; 3],
    /// Shown by any law.
    pub any: usize,
    /// With the normal form of the right function.
    pub equivalent: usize,
    /// Not shown by any law.
    pub survivors: usize,
}

impl Tally {
    /// Counts one more.
    fn count(&mut self, outcome: &Outcome) {
        self.mutants += 1;
        for (killed, kind) in self.killed.iter_mut().zip(Kind::ALL) {
            *killed += usize::from(outcome.killed_by(kind));
        }
        let count = match outcome.status {
            MutantStatus::Killed => &mut self.any,
            MutantStatus::Equivalent => &mut self.equivalent,
            MutantStatus::Survivor => &mut self.survivors,
        };
        *count += 1;
    }
}

impl Report {
    /// All of it.
    #[must_use]
    pub fn total(&self) -> Tally {
        let mut tally = Tally::default();
        self.outcomes.iter().for_each(|outcome| tally.count(outcome));
        tally
    }

    /// One tally per function, in the order of the emitted file.
    #[must_use]
    pub fn by_kernel(&self) -> Vec<(String, Tally)> {
        self.grouped(|mutant| Some(mutant.kernel.clone()))
    }

    /// One tally per equation, over all functions: by number, single ones before several, those of
    /// our own, (D1) to (D18), after the paper's, what has none last.
    #[must_use]
    pub fn by_tag(&self) -> Vec<(String, Tally)> {
        let mut tags = self.grouped(|mutant| mutant.tag.clone());
        tags.sort_by_cached_key(|(tag, _)| (number(tag), tag.contains(", "), tag.clone()));
        tags
    }

    /// How many mutants are under no number: in what `prepare` shares between equations.
    #[must_use]
    pub fn unnumbered(&self) -> usize {
        self.outcomes.iter().filter(|outcome| outcome.mutant.tag.is_none()).count()
    }

    /// What is neither shown by a law nor equivalent.
    pub fn survivors(&self) -> impl Iterator<Item = &Outcome> {
        self.outcomes.iter().filter(|outcome| outcome.status == MutantStatus::Survivor)
    }

    /// Tallies by a key, in the order in which the keys first occur.
    fn grouped<K: PartialEq>(&self, key: impl Fn(&Mutant) -> Option<K>) -> Vec<(K, Tally)> {
        let mut groups: Vec<(K, Tally)> = Vec::new();
        for outcome in &self.outcomes {
            let Some(key) = key(&outcome.mutant) else { continue };
            let place = groups.iter().position(|(known, _)| *known == key).unwrap_or_else(|| {
                groups.push((key, Tally::default()));
                groups.len() - 1
            });
            groups[place].1.count(outcome);
        }
        groups
    }
}

/// The first number of a tag, the paper's before our own: 49 of `(49)-(52)`, 3 of `(D3)`.
fn number(tag: &str) -> (bool, usize) {
    let inside = tag.trim_start_matches('(');
    let own = inside.strip_prefix('D');
    let digits = own.unwrap_or(inside).split(|c: char| !c.is_ascii_digit()).next();
    let number = digits.and_then(|digits| digits.parse().ok());
    (own.is_some() || number.is_none(), number.unwrap_or(usize::MAX))
}
