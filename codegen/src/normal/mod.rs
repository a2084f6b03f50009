//! The normal form: a polynomial with rational coefficients in the symbols of an expression, with
//! `sin^2` replaced by `1 - cos^2`. Two expressions are equal exactly when their normal forms are.
//!
//! The reciprocal of a symbol is a variable of its own, and `y * (1/y)` is reduced to one. The
//! reciprocal of anything else has no normal form: it is named (made a symbol) first.

mod difference;
mod expression;
mod polynomial;
mod ring;

pub use difference::{Difference, Term};
pub use polynomial::{Monomial, Polynomial};
pub use ring::{Factor, NormalError, Ring};
