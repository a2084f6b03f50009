//! Numbers of a case: how one is drawn, and how it is made simpler.
//!
//! A number that a failure does not need becomes its simplest value; one that it needs loses as many
//! digits as the failure allows, so that what is printed can be read.

use std::fmt;
use std::sync::Arc;

use proptest::prelude::Rng;
use proptest::strategy::{NewTree, Strategy, ValueTree};
use proptest::test_runner::TestRunner;

use precess_tests::random::Random;

/// A number drawn by a function of a generator.
#[derive(Clone)]
pub struct Number {
    simplest: f64,
    draw: Arc<dyn Fn(&mut Random) -> f64 + Send + Sync>,
}

impl fmt::Debug for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Number").field("simplest", &self.simplest).finish_non_exhaustive()
    }
}

impl Number {
    /// A number by a function; what is simplest is never drawn unless the function draws it.
    pub fn new(simplest: f64, draw: impl Fn(&mut Random) -> f64 + Send + Sync + 'static) -> Self {
        Self { simplest, draw: Arc::new(draw) }
    }

    /// Uniform between two bounds, simplest at zero.
    #[must_use]
    pub fn within(low: f64, high: f64) -> Self {
        Self::new(0.0, move |random| random.within(low, high))
    }

    /// Log-uniform between two positive bounds, simplest at one.
    #[must_use]
    pub fn log_within(low: f64, high: f64) -> Self {
        Self::new(1.0, move |random| random.log_within(low, high))
    }

    /// The same, but of any magnitude in this share of draws: from the smallest subnormal number to
    /// the largest, and zero.
    #[must_use]
    pub fn or_any(self, share: f64) -> Self {
        let Self { simplest, draw } = self;
        Self::new(simplest, move |random| {
            let number = draw(random);
            if random.within(0.0, 1.0) < share { of_any_size(random, number < 0.0) } else { number }
        })
    }

    /// The same, but infinite or NaN in this share of draws.
    #[must_use]
    pub fn or_not_finite(self, share: f64) -> Self {
        let Self { simplest, draw } = self;
        Self::new(simplest, move |random| {
            if random.within(0.0, 1.0) >= share {
                return draw(random);
            }
            [f64::NAN, f64::INFINITY, f64::NEG_INFINITY][(random.bits() % 3) as usize]
        })
    }
}

/// Numbers at which arithmetic changes: ends of ranges, and what their squares and reciprocals are.
const EDGES: [f64; 16] = [
    0.0,
    5e-324,
    1e-310,
    f64::MIN_POSITIVE,
    1e-200,
    1.5e-162,
    1.5e-154,
    1e-100,
    f64::EPSILON,
    1e9,
    1e17,
    1e100,
    1.3e154,
    1e200,
    1e308,
    f64::MAX,
];

/// A number whose logarithm is uniform over all that there are, or one of the edges.
fn of_any_size(random: &mut Random, negative: bool) -> f64 {
    let size = if random.bits() & 1 == 0 {
        EDGES[(random.bits() % 16) as usize]
    } else {
        libm::pow(10.0, random.within(-323.5, 308.2))
    };
    if negative { -size } else { size }
}

impl Strategy for Number {
    type Tree = NumberTree;
    type Value = f64;

    fn new_tree(&self, runner: &mut TestRunner) -> NewTree<Self> {
        let number = (self.draw)(&mut Random::new(runner.rng().next_u64()));
        Ok(NumberTree::new(number, self.simplest))
    }
}

/// A drawn number and what is simpler.
#[derive(Clone, Debug)]
pub struct NumberTree {
    current: f64,
    /// The simplest number so far that a failure allowed.
    best: f64,
    /// What is still to be tried, the simplest last.
    rest: Vec<f64>,
}

impl NumberTree {
    /// A number that was drawn.
    #[must_use]
    pub fn new(number: f64, simplest: f64) -> Self {
        let mut rest = Vec::new();
        if number.is_finite() {
            for digits in [6, 3, 2, 1] {
                rest.push(rounded(number, digits));
            }
            let unit = if number < 0.0 { -1.0 } else { 1.0 };
            rest.push(unit);
        }
        rest.push(simplest);
        // No simpler: as many digits as there are.
        rest.dedup_by(|later, earlier| same(*later, *earlier));
        Self { current: number, best: number, rest }
    }

    fn next(&mut self) -> Option<f64> {
        while let Some(next) = self.rest.pop() {
            if !same(next, self.best) {
                return Some(next);
            }
            // As simple as it gets.
            self.rest.clear();
        }
        None
    }
}

fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits()
}

/// The number rounded to so many digits; as it is where that overflows.
fn rounded(number: f64, digits: usize) -> f64 {
    let text = format!("{number:.*e}", digits - 1);
    text.parse().ok().filter(|rounded: &f64| rounded.is_finite()).unwrap_or(number)
}

impl ValueTree for NumberTree {
    type Value = f64;

    fn current(&self) -> f64 {
        self.current
    }

    /// The failure allowed the current number: what is left to try is less simple.
    fn simplify(&mut self) -> bool {
        if !same(self.current, self.best) {
            self.best = self.current;
            self.rest.clear();
            return false;
        }
        match self.next() {
            Some(next) => {
                self.current = next;
                true
            }
            None => false,
        }
    }

    /// The failure needs more of the number.
    fn complicate(&mut self) -> bool {
        if same(self.current, self.best) {
            return false;
        }
        self.current = self.next().unwrap_or(self.best);
        true
    }
}
