//! What distinguishes two normal forms, term by term.

use std::cmp::Ordering;
use std::fmt;
use std::iter::from_fn;

use super::{Monomial, Polynomial, Ring};
use crate::graph::Rational;

/// How one term of the checked side differs from the reference.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Term {
    /// The reference has it, the checked side has not.
    Missing(String),
    /// The checked side has it, the reference has not.
    Extra(String),
    /// Both have it, with opposite signs; shown as the reference has it.
    Sign(String),
    /// Both have it; the checked coefficient is this multiple of the reference's.
    Factor(Rational, String),
}

impl fmt::Display for Term {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Missing(term) => write!(f, "missing `{term}`"),
            Self::Extra(term) => write!(f, "extra `{term}`"),
            Self::Sign(term) => write!(f, "wrong sign of `{term}`"),
            Self::Factor(factor, term) => write!(f, "factor {factor} on `{term}`"),
        }
    }
}

/// All differing terms of two normal forms, in a fixed order; empty when they are equal.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Difference {
    /// The terms.
    pub terms: Vec<Term>,
}

impl Difference {
    /// Compares `checked` with `reference`, both expanded in `ring`.
    #[must_use]
    pub fn between(ring: &Ring<'_>, checked: &Polynomial, reference: &Polynomial) -> Self {
        let name = |(monomial, is, ought): (&Monomial, Rational, Rational)| {
            if ought == Rational::ZERO {
                Term::Extra(ring.show(monomial, is))
            } else if is == Rational::ZERO {
                Term::Missing(ring.show(monomial, ought))
            } else if is == -ought {
                Term::Sign(ring.show(monomial, ought))
            } else {
                Term::Factor(is / ought, ring.show(monomial, ought))
            }
        };
        Self { terms: differing(checked, reference).map(name).collect() }
    }

    /// Whether the two sides are equal.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.terms.is_empty()
    }
}

/// The monomials whose coefficients are not the same, with both: one walk along the two listings,
/// which have one order.
fn differing<'a>(
    a: &'a Polynomial,
    b: &'a Polynomial,
) -> impl Iterator<Item = (&'a Monomial, Rational, Rational)> {
    let (mut left, mut right) = (a.terms().peekable(), b.terms().peekable());
    let either = from_fn(move || {
        let order = match (left.peek(), right.peek()) {
            (Some((x, _)), Some((y, _))) => x.cmp(y),
            (Some(_), None) => Ordering::Less,
            (None, _) => Ordering::Greater,
        };
        let is = if order.is_le() { left.next() } else { None };
        let ought = if order.is_ge() { right.next() } else { None };
        let (monomial, _) = is.or(ought)?;
        let coefficient = |term: Option<(_, &Rational)>| term.map_or(Rational::ZERO, |(_, k)| *k);
        Some((monomial, coefficient(is), coefficient(ought)))
    });
    either.filter(|(_, is, ought)| is != ought)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::{Graph, Stage};

    #[test]
    fn each_kind_of_difference_is_named() {
        let g = Graph::new();
        let [a, b, c, d] = ["a", "b", "c", "d"].map(|name| g.symbol(name, Stage::Parameter));
        let mut ring = Ring::new(&g);
        let reference = ring.normal(a + b + c).unwrap();
        let checked = ring.normal(a - b + g.constant(3) * c + d - a).unwrap();
        let shown: Vec<_> = Difference::between(&ring, &checked, &reference)
            .terms
            .iter()
            .map(Term::to_string)
            .collect();
        assert_eq!(shown.len(), 4);
        for line in ["missing `a`", "wrong sign of `b`", "factor 3 on `c`", "extra `d`"] {
            assert!(shown.iter().any(|s| s == line), "{line} not in {shown:?}");
        }
        assert!(Difference::between(&ring, &reference, &reference).is_empty());
    }
}
