//! Derivatives of whatever the solver computes, by the solver over [`Dual`](crate::Dual) numbers.

pub(crate) mod column;
pub(crate) mod elimination;
pub(crate) mod evaluation;
pub(crate) mod point;
pub(crate) mod turned;
pub(crate) mod with_numbers;
