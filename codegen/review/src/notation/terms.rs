//! Normal forms as LaTeX.

use super::name::{Accent, symbol};
use super::tex::{Binding, Term, Tex, Value, lines};
use precess_codegen::graph::Rational;
use precess_codegen::normal::{Factor, Polynomial, Ring};

/// A normal form as the lines of an aligned display, without alignment marks.
#[must_use]
pub fn terms(ring: &Ring<'_>, polynomial: &Polynomial) -> Vec<String> {
    let summand = |(monomial, coefficient): (_, &Rational)| {
        let negative = *coefficient < Rational::ZERO;
        let size = if negative { -*coefficient } else { *coefficient };
        let factors = ring.factors(monomial);
        let (below, above): (Vec<_>, Vec<_>) = factors.into_iter().partition(|factor| factor.recip);
        let mut set: Vec<Tex> = above.iter().map(power).collect();
        if size != Rational::ONE || set.is_empty() {
            set.insert(0, number(size));
        }
        let mut value = Tex::product(set);
        if !below.is_empty() {
            let below = Tex::product(below.iter().map(power).collect());
            let width = value.width.max(below.width);
            let text = format!("\\frac{{{}}}{{{}}}", value.text, below.text);
            value = Tex::new(text, width, Binding::Atom);
        }
        Term { negative, value: Value::Short(value) }
    };
    let summands: Vec<_> = polynomial.terms().map(summand).collect();
    if summands.is_empty() { vec!["0".to_owned()] } else { lines(&summands) }
}

fn power(factor: &Factor) -> Tex {
    let base = symbol(&factor.name, Accent::Plain);
    let text = match factor.exponent {
        1 => base,
        // The power of a sine is written after the s.
        exponent if base.starts_with("\\mathrm") => {
            base.replacen('}', &format!("}}^{{{exponent}}}"), 1)
        }
        exponent => format!("{base}^{{{exponent}}}"),
    };
    Tex::atom(text)
}

fn number(size: Rational) -> Tex {
    if size.is_integer() {
        return Tex::atom(size.to_string());
    }
    Tex::atom(format!("\\frac{{{}}}{{{}}}", size.numer(), size.denom()))
}
