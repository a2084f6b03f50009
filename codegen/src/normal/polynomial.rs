//! Monomials with packed exponents and polynomials over them.
//!
//! Invariants: no zero coefficient is stored; four bits an exponent, none above fifteen; terms are in the order of
//! their monomials' packed words, so every listing is the same in every run.

use super::NormalError;
use crate::graph::{Rational, rational};

const WORDS: usize = 10;
const PER_WORD: usize = 16;

/// How many variables a monomial can hold.
pub(super) const VARIABLES: usize = WORDS * PER_WORD;

/// A product of powers of variables.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Monomial([u64; WORDS]);

impl Monomial {
    /// The single variable `index`.
    pub(super) fn variable(index: usize) -> Self {
        let mut words = [0; WORDS];
        words[index / PER_WORD] = 1 << (4 * (index % PER_WORD));
        Self(words)
    }

    /// The exponent of variable `index`.
    pub(super) fn exponent(&self, index: usize) -> u32 {
        let nibble = (self.0[index / PER_WORD] >> (4 * (index % PER_WORD))) & 0xf;
        u32::try_from(nibble).expect("four bits fit")
    }

    /// The product of two monomials.
    ///
    /// # Errors
    /// When an exponent of it would be above fifteen.
    pub(super) fn times(&self, other: &Self) -> Result<Self, NormalError> {
        const HIGH: u64 = 0x8888_8888_8888_8888;
        let mut carried = 0;
        let product = std::array::from_fn(|word| {
            let (a, b) = (self.0[word], other.0[word]);
            let sum = a.wrapping_add(b);
            // The highest bit of an exponent is carried where both have it, or one has and the sum
            // has lost it.
            carried |= (a & b) | ((a | b) & !sum);
            sum
        });
        if carried & HIGH == 0 { Ok(Self(product)) } else { Err(NormalError::Exponent) }
    }

    /// `self` with the exponent of variable `index` lowered by `by`.
    pub(super) fn lowered(&self, index: usize, by: u32) -> Self {
        let mut words = self.0;
        words[index / PER_WORD] -= u64::from(by) << (4 * (index % PER_WORD));
        Self(words)
    }
}

/// A polynomial: the normal form of an expression.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Polynomial {
    terms: Vec<(Monomial, Rational)>,
}

impl Polynomial {
    /// The constant `k`.
    pub(super) fn constant(k: Rational) -> Self {
        Self::single(Monomial::default(), k)
    }

    /// The polynomial of one term.
    #[must_use]
    pub fn single(monomial: Monomial, coefficient: Rational) -> Self {
        let terms = (coefficient != Rational::ZERO).then_some((monomial, coefficient));
        Self { terms: terms.into_iter().collect() }
    }

    /// The terms in order.
    #[must_use]
    pub fn terms(&self) -> impl ExactSizeIterator<Item = (&Monomial, &Rational)> {
        self.terms.iter().map(|(monomial, coefficient)| (monomial, coefficient))
    }

    /// The coefficient of a monomial, zero where it does not occur.
    #[must_use]
    pub fn coefficient(&self, monomial: &Monomial) -> Rational {
        let place = self.terms.binary_search_by_key(&monomial, |(other, _)| other);
        place.map_or(Rational::ZERO, |place| self.terms[place].1)
    }

    /// How many terms there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.terms.len()
    }

    /// Whether this is the polynomial zero.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.terms.is_empty()
    }

    /// `self + factor * other`.
    ///
    /// # Errors
    /// When a coefficient gets too large.
    pub fn plus(&self, factor: Rational, other: &Self) -> Result<Self, NormalError> {
        Self::sum([(Rational::ONE, self), (factor, other)])
    }

    /// The sum of polynomials, each with a factor.
    ///
    /// # Errors
    /// When a coefficient gets too large.
    pub(super) fn sum<'a>(
        summands: impl IntoIterator<Item = (Rational, &'a Self)>,
    ) -> Result<Self, NormalError> {
        let mut sum = Sum::default();
        for (factor, summand) in summands {
            for (monomial, coefficient) in &summand.terms {
                let scaled = rational::product(factor, *coefficient);
                sum.add(*monomial, scaled.ok_or(NormalError::Coefficient)?)?;
            }
        }
        sum.polynomial()
    }
}

/// How many terms a sum lists before it adds up those that are alike.
const LISTED: usize = 1 << 14;

/// Terms that are added up: listed first, since sorting a list takes a fraction of keeping it sorted.
#[derive(Default)]
pub(super) struct Sum {
    /// What was added up, in order and each monomial once; then what was added since.
    terms: Vec<(Monomial, Rational)>,
    /// How many there were when they were added up.
    added_up: usize,
}

impl Sum {
    /// Adds one term.
    ///
    /// # Errors
    /// When a coefficient gets too large.
    pub(super) fn add(
        &mut self,
        monomial: Monomial,
        coefficient: Rational,
    ) -> Result<(), NormalError> {
        self.terms.push((monomial, coefficient));
        if self.terms.len() > LISTED + 2 * self.added_up { self.add_up() } else { Ok(()) }
    }

    /// The polynomial that they are.
    ///
    /// # Errors
    /// When a coefficient gets too large.
    pub(super) fn polynomial(mut self) -> Result<Polynomial, NormalError> {
        self.add_up()?;
        self.terms.shrink_to_fit();
        Ok(Polynomial { terms: self.terms })
    }

    fn add_up(&mut self) -> Result<(), NormalError> {
        // Stable, since it takes advantage of parts that are in order.
        self.terms.sort_by_key(|(monomial, _)| *monomial);
        let mut is_exact = true;
        self.terms.dedup_by(|(next, taken), (kept, coefficient)| {
            let is_same = next == kept;
            if is_same {
                let sum = rational::sum(*coefficient, *taken);
                is_exact &= sum.is_some();
                *coefficient = sum.unwrap_or(Rational::ZERO);
            }
            is_same
        });
        self.terms.retain(|(_, coefficient)| *coefficient != Rational::ZERO);
        self.added_up = self.terms.len();
        if is_exact { Ok(()) } else { Err(NormalError::Coefficient) }
    }
}
