//! The services: calls of the solver, each opened for a spacecraft of a file.

#[cfg(feature = "lanes")]
mod baked;
#[cfg(feature = "lanes")]
mod batch;
#[cfg(feature = "lanes")]
mod derivatives;
#[cfg(feature = "lanes")]
mod flexible;
mod imaging;
#[cfg(feature = "lanes")]
mod listed;
mod name;
mod open;
mod parameters;
#[cfg(feature = "lanes")]
mod runs;
mod single_state;
#[cfg(feature = "lanes")]
mod step;

use std::error::Error;

use serde_json::Value;

pub(crate) use name::Name;
pub(crate) use open::{open, open_hub};

/// What a service could not do.
pub(crate) type Rejected = Box<dyn Error>;

/// A spacecraft opened for one of the services.
pub(crate) trait Service {
    /// What is compared: all accelerations in the state of the file, or the motion over some steps.
    fn check(&mut self) -> Result<Value, Rejected>;
    /// Makes so many calls, none of which can be computed before the one before it is done, or
    /// without being made.
    fn run(&mut self, calls: u32) -> Result<(), Rejected>;
    /// Evaluations or steps in a call, of all states.
    fn units(&self) -> u32;
}
