//! Monomials with packed exponents and polynomials over them.
//!
//! Invariants: no zero coefficient is stored; four bits an exponent, none above fifteen; the order
//! of monomials is that of their packed words, so every listing is the same in every run.

use std::collections::BTreeMap;

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
    terms: BTreeMap<Monomial, Rational>,
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

    /// Adds one term.
    pub(super) fn add(
        &mut self,
        monomial: Monomial,
        coefficient: Rational,
    ) -> Result<(), NormalError> {
        use std::collections::btree_map::Entry;
        if coefficient == Rational::ZERO {
            return Ok(());
        }
        match self.terms.entry(monomial) {
            Entry::Vacant(place) => {
                place.insert(coefficient);
            }
            Entry::Occupied(mut place) => {
                let sum = rational::sum(*place.get(), coefficient);
                match sum.ok_or(NormalError::Coefficient)? {
                    sum if sum == Rational::ZERO => {
                        place.remove();
                    }
                    sum => *place.get_mut() = sum,
                }
            }
        }
        Ok(())
    }

    /// The terms in order.
    #[must_use]
    pub fn terms(&self) -> impl ExactSizeIterator<Item = (&Monomial, &Rational)> {
        self.terms.iter()
    }

    /// The coefficient of a monomial, zero where it does not occur.
    #[must_use]
    pub fn coefficient(&self, monomial: &Monomial) -> Rational {
        self.terms.get(monomial).copied().unwrap_or(Rational::ZERO)
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
        let mut made = self.clone();
        made.accumulate(factor, other)?;
        Ok(made)
    }

    /// Adds `factor * other`.
    pub(super) fn accumulate(&mut self, factor: Rational, other: &Self) -> Result<(), NormalError> {
        other.terms.iter().try_for_each(|(monomial, coefficient)| {
            let scaled = rational::product(factor, *coefficient);
            self.add(*monomial, scaled.ok_or(NormalError::Coefficient)?)
        })
    }

    /// `factor * self`, for a factor that is not zero.
    pub(super) fn scaled(&self, factor: Rational) -> Result<Self, NormalError> {
        let mut made = self.clone();
        for coefficient in made.terms.values_mut() {
            let scaled = rational::product(factor, *coefficient);
            *coefficient = scaled.ok_or(NormalError::Coefficient)?;
        }
        Ok(made)
    }
}
