//! Scenario files: TOML text into a [`Scenario`](crate::scenario::Scenario), or into every error at once.
//!
//! ```text
//! text -> document (keys and values with their places) -> includes and overrides merged
//!      -> keys read, each by its measure -> Scenario -> checked
//! ```
//!
//! A key that nobody reads is an error; so is a number without a unit. Each error has file, line,
//! the text underlined, and the remedy.

mod budget;
pub mod diagnostic;
mod document;
mod identification;
pub mod identification_example;
mod integrator;
mod keys;
mod load;
mod measurement;
mod overrides;
pub mod read;
mod read_file;
mod sample_errors;
mod structure;
mod template;
mod variations;
mod waterfall;
mod write;
mod write_platform;

pub use budget::{budget_from_toml, budget_overrides, check_budget_names};
pub use diagnostic::{Diagnostic, Diagnostics, Numbers, Severity};
pub use identification::{IdentificationFile, identification_from_toml};
pub use load::{Override, Overrides};
pub use measurement::{MeasurementFile, measurement_from_toml};
pub use overrides::is_key;
pub use read::{Tables, from_file, from_filled, from_program, from_toml};
pub use sample_errors::PlanPlaces;
pub use structure::{StructureReadError, structure_from_file, structure_from_toml};
pub use template::Template;
pub use variations::variations_from_toml;
pub use write::to_toml;
