//! The promises of docs/promises.md at the points where each has been broken once, in every service.

mod finite;
mod inputs;
mod services;
mod singular;
mod steps;
mod wrapping;
