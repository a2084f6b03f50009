//! One expression as Rust tokens: operators, parentheses, and its width in columns.

use proc_macro2::{Ident, Span, TokenStream};
use quote::{format_ident, quote};

use crate::graph::Rational;

/// How tightly an expression binds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Binding {
    Sum,
    Product,
    Unary,
    Call,
    Atom,
}

/// Tokens with their width in columns.
#[derive(Clone, Debug)]
pub(super) struct Rendered {
    pub(super) tokens: TokenStream,
    pub(super) width: usize,
    pub(super) binding: Binding,
}

impl Rendered {
    /// A local name.
    pub(super) fn name(name: &str) -> Self {
        let ident = Ident::new(name, Span::call_site());
        Self { tokens: quote!(#ident), width: name.len(), binding: Binding::Atom }
    }

    /// A field of an argument: `p.m_w`.
    pub(super) fn field(argument: &str, name: &str) -> Self {
        let (argument_ident, ident) = (format_ident!("{argument}"), format_ident!("{name}"));
        Self {
            tokens: quote!(#argument_ident.#ident),
            width: argument.len() + 1 + name.len(),
            binding: Binding::Atom,
        }
    }

    /// A constant of the number type of `witness`, any value at hand: `q.sin_theta.like(0.5)`.
    pub(super) fn constant(witness: &Self, value: Rational) -> Self {
        let literal = proc_macro2::Literal::f64_unsuffixed(crate::graph::float(value));
        let width = witness.width + ".like()".len() + literal.to_string().len();
        let witness = &witness.tokens;
        Self { tokens: quote!(#witness.like(#literal)), width, binding: Binding::Atom }
    }

    pub(super) fn plus(&self, other: &Self) -> Self {
        let (a, b) = (self.inside(Binding::Sum), other.inside(Binding::Product));
        let (left, right) = (&a.tokens, &b.tokens);
        let tokens = quote!(#left + #right);
        Self { tokens, width: a.width + 3 + b.width, binding: Binding::Sum }
    }

    pub(super) fn minus(&self, other: &Self) -> Self {
        let (a, b) = (self.inside(Binding::Sum), other.inside(Binding::Product));
        let (left, right) = (&a.tokens, &b.tokens);
        let tokens = quote!(#left - #right);
        Self { tokens, width: a.width + 3 + b.width, binding: Binding::Sum }
    }

    pub(super) fn times(&self, other: &Self) -> Self {
        let (a, b) = (self.inside(Binding::Product), other.inside(Binding::Unary));
        let (left, right) = (&a.tokens, &b.tokens);
        let tokens = quote!(#left * #right);
        Self { tokens, width: a.width + 3 + b.width, binding: Binding::Product }
    }

    pub(super) fn negated(&self) -> Self {
        let a = self.inside(Binding::Unary);
        let inner = &a.tokens;
        Self { tokens: quote!(-#inner), width: a.width + 1, binding: Binding::Unary }
    }

    pub(super) fn recip(&self) -> Self {
        let a = self.inside(Binding::Call);
        let inner = &a.tokens;
        let width = a.width + ".recip()".len();
        Self { tokens: quote!(#inner.recip()), width, binding: Binding::Call }
    }

    /// In parentheses unless it binds at least as tightly as `outside` requires.
    fn inside(&self, outside: Binding) -> Self {
        if self.binding >= outside {
            return self.clone();
        }
        let tokens = &self.tokens;
        Self { tokens: quote!((#tokens)), width: self.width + 2, binding: Binding::Atom }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parentheses_stand_where_they_must() {
        let [a, b, c] = ["a", "b", "c"].map(Rendered::name);
        let shown = |r: Rendered| r.tokens.to_string();
        assert_eq!(shown(a.plus(&b).times(&c)), "(a + b) * c");
        assert_eq!(shown(c.times(&a.times(&b))), "c * (a * b)");
        assert_eq!(shown(a.minus(&b.minus(&c))), "a - (b - c)");
        assert_eq!(shown(a.minus(&b).minus(&c)), "a - b - c");
        assert_eq!(shown(a.times(&b).negated()), "- (a * b)");
        assert_eq!(shown(a.plus(&b).recip()), "(a + b) . recip ()");
        assert_eq!(shown(a.times(&b).plus(&c.times(&a.negated()))), "a * b + c * - a");
    }

    #[test]
    fn the_width_is_that_of_the_formatted_line() {
        let [a, b] = ["alpha", "beta"].map(Rendered::name);
        let r = Rendered::field("p", "m_w").times(&a.plus(&b)).negated().plus(&b.recip());
        assert_eq!(r.width, "-(p.m_w * (alpha + beta)) + beta.recip()".len());
    }
}
