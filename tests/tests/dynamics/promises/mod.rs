//! Regressions: for each promise of docs/promises.md, the cases that once broke it, in every
//! service.

mod finite;
mod inputs;
mod longest_steps;
mod services;
mod singular;
mod steps;
mod wrapping;
